!> Stresses at the points of wedges from displacement gradients, elastic or by the laws of the
!> plies; and the energy that the plies have stored.
module plydyn_element_cracked_stresses
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_cracked_cells, only : cells_type, wedges
   use plydyn_element_cracked_wedges, only : faces, find_gradients, wedge_points
   use plydyn_element_material_batch, only : c33, elastic_stress
   use plydyn_element_plate_energies, only : point_energy
   use plydyn_element_plate_layers, only : plate_type
   use plydyn_element_plate_recover, only : point_history
   use plydyn_fem_kinematics, only : find_piola, find_strain, turn_strain, turn_stress_back
   use plydyn_law_compression_barrier, only : add_barrier_stress
   implicit none
   private

   public :: add_wedge_energy, find_stresses

contains

   !> First Piola-Kirchhoff stresses times volume at the points of a block of layers over a quad
   pure subroutine find_stresses(plate, block, quad, large, step, gradient, history, piola)
      !> The plate, block of layers, quad
      type(plate_type), intent(in) :: plate
      integer, intent(in) :: block, quad
      !> Large displacement; time step
      logical, intent(in) :: large
      real(wp), intent(in) :: step
      !> Displacement gradients
      real(wp), intent(in) :: gradient(lanes, 3, 3, wedge_points)
      !> History from the first point of the block on
      real(wp), intent(inout) :: history(lanes, plate%batches(1)%pitch, *)
      !> Component and direction
      real(wp), intent(out) :: piola(lanes, 3, 3, wedge_points)

      real(wp) :: strain(lanes, 6, wedge_points), stress(lanes, 6, wedge_points), weight(lanes)
      integer :: i, k, p

      associate (batch => plate%batches(1))
         do p = 1, wedge_points
            call find_strain(gradient(:, :, :, p), large, strain(:, :, p))
         end do
         if (size(batch%laws) > 0) then
            do p = 1, wedge_points
               call turn_strain(batch%rotation(:, :, block), strain(:, :, p))
            end do
            stress(:, :, :) = 0.0_wp
            do k = 1, size(batch%laws)
               if (batch%laws(k)%block /= block) cycle
               call batch%laws(k)%law%update_points(wedge_points, batch%pitch, step, strain, &
                  & history, stress)
            end do
            do p = 1, wedge_points
               do i = 1, 6
                  stress(:, i, p) = batch%half_thickness(:, block)*stress(:, i, p)
               end do
               call turn_stress_back(batch%rotation(:, :, block), stress(:, :, p))
            end do
         else
            do p = 1, wedge_points
               call elastic_stress(batch%stiffness(:, :, block), strain(:, :, p), stress(:, :, p))
            end do
         end if
         do k = 1, wedges
            do p = faces*(k - 1) + 1, faces*k
               weight(:) = plate%metric(5, k, quad)*batch%expansion%weight(p - faces*(k - 1))
               call find_piola(gradient(:, :, :, p), stress(:, :, p), weight, large, &
                  & piola(:, :, :, p))
               if (large) call add_barrier_stress(weight*batch%stiffness(:, c33, block), &
                  & gradient(:, :, :, p), piola(:, :, :, p))
            end do
         end do
      end associate
   end subroutine find_stresses

   !> Add the stored energy of all layers over some quads, quad by quad
   pure subroutine add_wedge_energy(plate, cells, elements, large, displacement, history, sums)
      !> The plate and its division
      type(plate_type), intent(in) :: plate
      type(cells_type), intent(in) :: cells
      !> First and last quad; large displacement
      integer, intent(in) :: elements(2)
      logical, intent(in) :: large
      !> Motion and history of all points
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      !> Sums, the first of which gets the energies
      type(exact_sums_type), intent(inout) :: sums

      real(wp) :: energy, gradient(lanes, 3, 3, wedge_points)
      integer :: b, e, m, w

      associate (batch => plate%batches(1))
         do e = elements(1), elements(2)
            energy = 0.0_wp
            do b = 1, batch%blocks
               call find_gradients(plate, cells, b, e, displacement, gradient)
               do w = 1, wedges
                  do m = 1, faces
                     energy = energy + plate%metric(5, w, e)*batch%expansion%weight(m) &
                        & *sum(point_energy(batch, b, large, &
                        & gradient(:, :, :, m + faces*(w - 1)), point_history(plate, batch, b, e, &
                        & w, m, history)), mask=batch%layer(:, b) > 0)
                  end do
               end do
            end do
            call sums%add(1, energy)
         end do
      end associate
   end subroutine add_wedge_energy

end module plydyn_element_cracked_stresses
