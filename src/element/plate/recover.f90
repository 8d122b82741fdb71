!> Strain, stress and what laws show of their histories in a layer at its Gauss points.
module plydyn_element_plate_recover
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_group, only : recovered, scalars_at
   use plydyn_element_material_batch, only : point_values
   use plydyn_element_plate_gradients, only : find_gradients
   use plydyn_element_plate_layers, only : layer_batch_type, plate_type
   use plydyn_fem_kinematics, only : find_strain
   use plydyn_law_law, only : scalars
   implicit none
   private

   public :: layer_scalars, layer_values, point_history

contains

   !> Strain, stress and the scalars of the law of one layer of one quad at its Gauss points; see
   !> `point_values`
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

      real(wp) :: h(lanes, 3, 3, size(values, 3), size(values, 2)), all_lanes(lanes, scalars_at), &
         & strain(lanes, 6)
      integer :: m, q

      call find_gradients(plate, plate%batches(b), block, quad, displacement, h)
      values(scalars_at + 1:, :, :) = layer_scalars(plate, b, block, lane, quad, history)
      do m = 1, size(values, 3)
         do q = 1, size(values, 2)
            call find_strain(h(:, :, :, m, q), large, strain)
            all_lanes(:, :) = point_values(plate%batches(b), block, large, h(:, :, :, m, q), &
               & strain, point_history(plate, plate%batches(b), block, quad, q, m, history))
            values(:scalars_at, q, m) = all_lanes(lane, :)
         end do
      end do
   end function layer_values

   !> Scalars of the law of one layer of one quad at its Gauss points; 0 in elastic layers
   pure function layer_scalars(plate, b, block, lane, quad, history) result(values)
      !> The plate; batch of layers, block and lane in it; quad of the plate
      type(plate_type), intent(in) :: plate
      integer, intent(in) :: b, block, lane, quad
      !> History of all Gauss points
      real(wp), intent(in), contiguous :: history(:)
      !> (scalars, points of the plane, points of the thickness)
      real(wp) :: values(scalars, size(plate%metric, 2), plate%batches(b)%expansion%order + 1)

      real(wp) :: point(lanes, plate%batches(b)%histories)
      integer :: k, m, q

      values(:, :, :) = 0.0_wp
      do k = 1, size(plate%batches(b)%laws)
         associate (entry => plate%batches(b)%laws(k))
            if (entry%block /= block .or. .not. entry%law%owns(lane)) cycle
            if (entry%law%histories == 0) cycle
            do m = 1, size(values, 3)
               do q = 1, size(values, 2)
                  point(:, :) = point_history(plate, plate%batches(b), block, quad, q, m, history)
                  values(:, q, m) = entry%law%output_variables(lane, point)
               end do
            end do
         end associate
      end do
   end function layer_scalars

   !> History of one Gauss point, (lanes, histories)
   pure function point_history(plate, batch, block, quad, q, m, history) result(point)
      !> The plate and one of its batches
      type(plate_type), intent(in) :: plate
      type(layer_batch_type), intent(in) :: batch
      !> Block of layers, quad, Gauss point of the plane and of the thickness
      integer, intent(in) :: block, quad, q, m
      !> History of all Gauss points
      real(wp), intent(in), contiguous :: history(:)
      real(wp) :: point(lanes, batch%histories)

      integer :: first, k, row

      row = m - 1 + (batch%expansion%order + 1)*(q - 1 + size(plate%metric, 2)*(block - 1 &
         & + batch%blocks*(quad - 1)))
      do k = 1, batch%histories
         first = batch%first_history + lanes*(row + batch%pitch*(k - 1))
         point(:, k) = history(first:first + lanes - 1)
      end do
   end function point_history

end module plydyn_element_plate_recover
