!> Displacement gradients at the Gauss points of plates, as sums over the nodes of a quad: for what
!> is not in the time loop.
module plydyn_element_plate_gradients
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_plate_layers, only : first_degree, layer_batch_type, plate_type
   implicit none
   private

   public :: find_gradients, gauss_metric

contains

   !> Displacement gradients of a block of layers at the Gauss points of a quad
   pure subroutine find_gradients(plate, batch, block, quad, displacement, gradient)
      !> The plate and one of its batches
      type(plate_type), intent(in) :: plate
      type(layer_batch_type), intent(in) :: batch
      !> Block of layers, quad of the plate
      integer, intent(in) :: block, quad
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> (lanes, component, direction, points of the thickness, points of the plane)
      real(wp), intent(out) :: gradient(lanes, 3, 3, batch%expansion%order + 1, &
         & size(plate%node, 1))

      real(wp) :: value(lanes, batch%expansion%order + 1, 3, size(plate%node, 1))
      real(wp) :: above(lanes, batch%expansion%order + 1, 3, 3)
      integer :: q

      call find_values(batch, block, plate%node(:, quad), displacement, value)
      do q = 1, size(gradient, 5)
         call differentiate_plane(plate, quad, q, size(above)/3, value, above)
         call differentiate_height(batch, block, above, gradient(:, :, :, :, q))
      end do
   end subroutine find_gradients

   !> d(xi, eta)/d(x, y) at a Gauss point, (x or y, xi or eta)
   pure function gauss_metric(plate, quad, q) result(metric)
      !> The plate
      type(plate_type), intent(in) :: plate
      !> Quad of the plate, and Gauss point of the plane
      integer, intent(in) :: quad, q
      real(wp) :: metric(2, 2)

      metric(:, 1) = 2.0_wp*plate%gauss_abscissa*plate%metric(1:2, q, quad)
      metric(:, 2) = 2.0_wp*plate%gauss_abscissa*plate%metric(3:4, q, quad)
   end function gauss_metric

   !> Displacement at the Gauss points of the thickness above the nodes of a quad
   pure subroutine find_values(batch, block, node, displacement, value)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block
      !> Nodes of the quad
      integer, intent(in) :: node(:)
      real(wp), intent(in), contiguous :: displacement(:)
      !> (lanes, points of the thickness, directions, nodes)
      real(wp), intent(out) :: value(lanes, batch%expansion%order + 1, 3, size(node))

      integer :: c, first, i, l, m, t

      value(:, :, :, :) = 0.0_wp
      do i = 1, size(node)
         do c = 1, 3
            do t = 1, size(value, 2)
               first = first_degree(batch, block, node(i), t, c) - 1
               do m = 1, size(value, 2)
                  !$omp simd
                  do l = 1, lanes
                     value(l, m, c, i) = value(l, m, c, i) + batch%expansion%to_gauss(m, t) &
                        & *displacement(first + l)
                  end do
               end do
            end do
         end do
      end do
   end subroutine find_values

   !> Derivatives along x and y, and values, above a Gauss point of the plane
   pure subroutine differentiate_plane(plate, quad, q, numbers, value, above)
      type(plate_type), intent(in) :: plate
      !> Quad, Gauss point of the plane, and numbers of a node: lanes, thickness and directions
      integer, intent(in) :: quad, q, numbers
      !> From `find_values`
      real(wp), intent(in) :: value(numbers, size(plate%node, 1))
      !> The last index is 1 and 2 for the derivatives, 3 for the values
      real(wp), intent(out) :: above(numbers, 3)

      real(wp) :: metric(2, 2), shape, x, y
      integer :: i, k

      metric(:, :) = gauss_metric(plate, quad, q)
      above(:, :) = 0.0_wp
      do i = 1, size(value, 2)
         x = metric(1, 1)*plate%slope(1, i, q) + metric(1, 2)*plate%slope(2, i, q)
         y = metric(2, 1)*plate%slope(1, i, q) + metric(2, 2)*plate%slope(2, i, q)
         shape = plate%shape(q, i)
         !$omp simd
         do k = 1, numbers
            above(k, 1) = above(k, 1) + x*value(k, i)
            above(k, 2) = above(k, 2) + y*value(k, i)
            above(k, 3) = above(k, 3) + shape*value(k, i)
         end do
      end do
   end subroutine differentiate_plane

   !> Displacement gradients above a Gauss point of the plane
   pure subroutine differentiate_height(batch, block, above, gradient)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block
      !> From `differentiate_plane`
      real(wp), intent(in) :: above(lanes, batch%expansion%order + 1, 3, 3)
      !> (lanes, components, directions, points of the thickness)
      real(wp), intent(out) :: gradient(lanes, 3, 3, batch%expansion%order + 1)

      integer :: c, l, m, t

      gradient(:, :, 3, :) = 0.0_wp
      do m = 1, size(gradient, 4)
         do c = 1, 3
            do t = 1, size(above, 2)
               !$omp simd
               do l = 1, lanes
                  gradient(l, c, 3, m) = gradient(l, c, 3, m) + batch%expansion%gauss_slope(m, t) &
                     & *above(l, t, c, 3)
               end do
            end do
            !$omp simd
            do l = 1, lanes
               gradient(l, c, 1, m) = above(l, m, c, 1)
               gradient(l, c, 2, m) = above(l, m, c, 2)
               gradient(l, c, 3, m) = gradient(l, c, 3, m)*batch%two_over_h(l, block)
            end do
         end do
      end do
   end subroutine differentiate_height

end module plydyn_element_plate_gradients
