!> Strain and stress of a layer at its Gauss points.
module plydyn_element_recover
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_layer_scalars, only : layer_scalars, point_history
   use plydyn_element_plate_gradients, only : find_gradients
   use plydyn_element_plate_layers, only : c33, elastic_stress, layer_batch_type, plate_type
   use plydyn_element_recovered, only : ply_strain_at, ply_stress_at, recovered, scalars_at, &
      & strain_at, stress_at
   use plydyn_fem_kinematics, only : find_cauchy, find_strain, turn_strain, turn_stress, &
      & turn_stress_back, volume_ratios
   use plydyn_law_compression_barrier, only : barrier_stress
   implicit none
   private

   public :: layer_values, point_values

contains

   !> Strain, stress and the scalars of the law of one layer of one quad at its Gauss points.
   !> With large displacement the strain is Green-Lagrange; stress is Cauchy in the axes of the
   !> plate and second Piola-Kirchhoff in those of the ply, which turn with the material.
   pure function layer_values(plate, b, block, lane, quad, large, displacement, history) &
      & result(values)
      !> The plate
      type(plate_type), intent(in) :: plate
      !> Batch of layers, block and lane in it
      integer, intent(in) :: b, block, lane
      !> Quad of the plate
      integer, intent(in) :: quad
      !> Large displacement
      logical, intent(in) :: large
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      !> (recovered, points of the plane, points of the thickness)
      real(wp) :: values(recovered, size(plate%node, 1), plate%batches(b)%expansion%order + 1)

      real(wp) :: h(lanes, 3, 3, size(values, 3), size(values, 2)), all_lanes(lanes, scalars_at)
      integer :: m, q

      call find_gradients(plate, plate%batches(b), block, quad, displacement, h)
      values(scalars_at + 1:, :, :) = layer_scalars(plate, b, block, lane, quad, history)
      do m = 1, size(values, 3)
         do q = 1, size(values, 2)
            all_lanes(:, :) = point_values(plate%batches(b), block, large, h(:, :, :, m, q), &
               & point_history(plate, plate%batches(b), block, quad, q, m, history))
            values(:scalars_at, q, m) = all_lanes(lane, :)
         end do
      end do
   end function layer_values

   !> Strain and stress of a block of layers at a Gauss point, from the displacement gradients there
   pure function point_values(batch, block, large, h, history) result(values)
      !> A batch of the plate, block in it
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block
      !> As in `layer_values`
      logical, intent(in) :: large
      !> Displacement gradients; history of the point
      real(wp), intent(in) :: h(lanes, 3, 3), history(:, :)
      !> (lanes, values)
      real(wp) :: values(lanes, scalars_at)

      real(wp) :: strain(lanes, 6), stress(lanes, 6), turned(lanes, 6)

      associate (rotation => batch%rotation(:, :, block))
         call find_strain(h, large, strain)
         turned(:, :) = strain
         call turn_strain(rotation, turned)
         values(:, strain_at + 1:stress_at) = strain
         values(:, ply_strain_at + 1:ply_stress_at) = turned
         if (size(batch%laws) > 0) then
            stress(:, :) = law_stress(batch, block, turned, history)
            call turn_stress_back(rotation, stress)
         else
            call elastic_stress(batch%stiffness(:, :, block), strain, stress)
            stress(:, :) = stress*spread(batch%two_over_h(:, block), 2, 6)
         end if
         turned(:, :) = stress
         call turn_stress(rotation, turned)
         values(:, ply_stress_at + 1:scalars_at) = turned
         if (large) then
            call find_cauchy(h, stress)
            stress(:, :3) = stress(:, :3) + spread(barrier_stress(batch%two_over_h(:, block) &
               & *batch%stiffness(:, c33, block), volume_ratios(h)), 2, 3)
         end if
         values(:, stress_at + 1:ply_strain_at) = stress
      end associate
   end function point_values

   !> Stress of the laws of a block in ply axes
   pure function law_stress(batch, block, strain, history) result(stress)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block
      real(wp), intent(in) :: strain(lanes, 6), history(:, :)
      real(wp) :: stress(lanes, 6)

      integer :: k

      stress(:, :) = 0.0_wp
      do k = 1, size(batch%laws)
         if (batch%laws(k)%block /= block) cycle
         call batch%laws(k)%law%stress_at(strain, history, stress)
      end do
   end function law_stress

end module plydyn_element_recover
