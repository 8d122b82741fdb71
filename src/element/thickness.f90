!> Stiffness of layers through their thickness, one column of points at a time.
!>
!> Of the strain energy of a layer these are the terms in which only derivatives along z appear:
!> C33 (dw/dz)**2 and the shear across the plate, G (du/dz)**2 and G (dv/dz)**2, integrated exactly
!> along z and by the area of the node in the plane. Both shear directions get the larger of the two
!> stiffnesses, so that x, y and z do not couple and nothing is stiffer than this.
module plydyn_element_thickness
   use plydyn_base_precision, only : wp
   use plydyn_element_plate_layers, only : layer_batch_type
   use plydyn_fem_expansion, only : expansion_type
   implicit none
   private

   public :: layer_springs, level_table

   !> Places of C33, C55, C56 and C66 among the constants of a layer
   integer, parameter :: c33 = 8, c55 = 11, c56 = 12, c66 = 13

contains

   !> Stiffness of a layer per area along x, y, z; times `level_table` it acts on the levels
   pure function layer_springs(batch, lane, block) result(spring)
      !> The layers
      type(layer_batch_type), intent(in) :: batch
      !> Which one
      integer, intent(in) :: lane, block
      real(wp) :: spring(3)

      associate (c => batch%stiffness(lane, :, block))
         spring(1:2) = 0.5_wp*(c(c55) + c(c66)) + hypot(0.5_wp*(c(c55) - c(c66)), c(c56))
         spring(3) = c(c33)
      end associate
      ! the constants are times half of the thickness
      spring(:) = spring*batch%two_over_h(lane, block)**2
   end function layer_springs

   !> Integrals of the products of the derivatives of the polynomials from -1 to 1
   pure function level_table(expansion) result(table)
      !> The expansion
      type(expansion_type), intent(in) :: expansion
      real(wp) :: table(expansion%order + 1, expansion%order + 1)

      real(wp) :: slope(expansion%order + 1, expansion%order + 1)

      slope(:, :) = matmul(expansion%gauss_slope, expansion%to_gauss)
      table(:, :) = matmul(transpose(slope), spread(expansion%weight, 2, size(slope, 2))*slope)
   end function level_table

end module plydyn_element_thickness
