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
      integer :: m, q

      value(:, :, :, :) = values_at_levels(batch, block, plate%node(:, quad), displacement)
      do q = 1, size(gradient, 5)
         call differentiate_plane(plate, quad, q, value, above)
         do m = 1, size(gradient, 4)
            gradient(:, :, :, m, q) = gradient_at(batch, block, m, above)
         end do
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

   !> Displacement at the Gauss points of the thickness above the nodes of a quad,
   !> (lanes, points of the thickness, directions, nodes)
   pure function values_at_levels(batch, block, node, displacement) result(value)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block
      !> Nodes of the quad
      integer, intent(in) :: node(:)
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp) :: value(lanes, size(batch%expansion%weight), 3, size(node))

      integer :: c, first, i, m, t

      value(:, :, :, :) = 0.0_wp
      do i = 1, size(node)
         do c = 1, 3
            do t = 1, size(value, 2)
               first = first_degree(batch, block, node(i), t, c)
               do m = 1, size(value, 2)
                  value(:, m, c, i) = value(:, m, c, i) + batch%expansion%to_gauss(m, t) &
                     & *displacement(first:first + lanes - 1)
               end do
            end do
         end do
      end do
   end function values_at_levels

   !> Derivatives along x and y, and values, above a Gauss point of the plane
   pure subroutine differentiate_plane(plate, quad, q, value, above)
      type(plate_type), intent(in) :: plate
      !> Quad, Gauss point of the plane
      integer, intent(in) :: quad, q
      !> From `values_at_levels`
      real(wp), intent(in), contiguous :: value(:, :, :, :)
      !> The last index is 1 and 2 for the derivatives, 3 for the values
      real(wp), intent(out), contiguous :: above(:, :, :, :)

      real(wp) :: metric(2, 2), slope(2, size(value, 4))
      integer :: i

      metric(:, :) = gauss_metric(plate, quad, q)
      slope(:, :) = matmul(metric, plate%slope(:, :, q))
      above(:, :, :, :) = 0.0_wp
      do i = 1, size(value, 4)
         above(:, :, :, 1) = above(:, :, :, 1) + slope(1, i)*value(:, :, :, i)
         above(:, :, :, 2) = above(:, :, :, 2) + slope(2, i)*value(:, :, :, i)
         above(:, :, :, 3) = above(:, :, :, 3) + plate%shape(q, i)*value(:, :, :, i)
      end do
   end subroutine differentiate_plane

   !> Displacement gradient at a Gauss point, (lanes, components, directions)
   pure function gradient_at(batch, block, m, above) result(gradient)
      type(layer_batch_type), intent(in) :: batch
      !> Block of layers, and Gauss point of the thickness
      integer, intent(in) :: block, m
      !> From `differentiate_plane`
      real(wp), intent(in), contiguous :: above(:, :, :, :)
      real(wp) :: gradient(lanes, 3, 3)

      integer :: c, t

      do c = 1, 3
         gradient(:, c, 1) = above(:, m, c, 1)
         gradient(:, c, 2) = above(:, m, c, 2)
         gradient(:, c, 3) = 0.0_wp
         do t = 1, size(above, 2)
            gradient(:, c, 3) = gradient(:, c, 3) + batch%expansion%gauss_slope(m, t) &
               & *above(:, t, c, 3)
         end do
         gradient(:, c, 3) = gradient(:, c, 3)*batch%two_over_h(:, block)
      end do
   end function gradient_at

end module plydyn_element_plate_gradients
