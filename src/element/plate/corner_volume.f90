!> Ratios of volumes at the corners of the cells of plates, where the polynomials of a layer deviate
!> most from their Gauss points: a cell may be inside out there alone.
module plydyn_element_plate_corner_volume
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_least_volume, only : least_volume_type
   use plydyn_element_plate_layers, only : first_degree, layer_batch_type, plate_type
   use plydyn_element_quad, only : quad_node_metric, tensor_order
   use plydyn_fem_expansion, only : lagrange
   use plydyn_fem_kinematics, only : volume_ratios
   use plydyn_model_mesh, only : mesh_type
   implicit none
   private

   public :: find_corner_volumes

contains

   !> Find the least ratio of volumes at the corners of all layers, with the index of the layer
   pure subroutine find_corner_volumes(plate, mesh, displacement, least)
      !> The plate
      type(plate_type), intent(in) :: plate
      !> The mesh, which has its positions
      type(mesh_type), intent(in) :: mesh
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> The least so far
      type(least_volume_type), intent(inout) :: least

      integer :: b

      do b = 1, size(plate%batches)
         call look_at_batch(plate, plate%batches(b), mesh, displacement, least)
      end do
   end subroutine find_corner_volumes

   !> The same of the layers of one order
   pure subroutine look_at_batch(plate, batch, mesh, displacement, least)
      type(plate_type), intent(in) :: plate
      type(layer_batch_type), intent(in) :: batch
      type(mesh_type), intent(in) :: mesh
      real(wp), intent(in), contiguous :: displacement(:)
      type(least_volume_type), intent(inout) :: least

      real(wp) :: metric(5, plate%side**2), ratio(lanes), unused(batch%expansion%order + 1)
      real(wp) :: slope(batch%expansion%order + 1, 2)
      integer :: block, e, l

      call lagrange(batch%expansion%node, -1.0_wp, unused, slope(:, 1))
      call lagrange(batch%expansion%node, 1.0_wp, unused, slope(:, 2))
      do e = 1, size(plate%quad)
         metric(:, :) = quad_node_metric(plate%side, mesh%position(1:2, &
            & mesh%quad_node(tensor_order(plate%side), plate%quad(e))))
         do block = 1, batch%blocks
            ratio(:) = block_ratio(batch, block, slope, metric, node_values(batch, block, &
               & plate%side, plate%node(:, e), displacement))
            do l = 1, lanes
               if (batch%layer(l, block) == 0) cycle
               call least%take(ratio(l), plate%quad(e), batch%layer(l, block))
            end do
         end do
      end do
   end subroutine look_at_batch

   !> Least ratio of volumes of each layer of a block at the corners of its bottom and top
   pure function block_ratio(batch, block, slope, metric, u) result(ratio)
      type(layer_batch_type), intent(in) :: batch
      !> Block of layers
      integer, intent(in) :: block
      !> Slopes of the expansion at the bottom and at the top
      real(wp), intent(in) :: slope(:, :)
      !> Geometry at the nodes
      real(wp), intent(in) :: metric(:, :)
      !> From `node_values`
      real(wp), intent(in) :: u(:, :, :, :, :)
      real(wp) :: ratio(lanes)

      real(wp) :: h(lanes, 3, 3)
      integer :: face, i, j, side

      side = size(u, 2)
      ratio(:) = huge(1.0_wp)
      do face = 1, 2
         do j = 1, side, side - 1
            do i = 1, side, side - 1
               h(:, :, :) = corner_gradient(u, [i, j, merge(1, size(slope, 1), face == 1)], &
                  & metric(:, i + side*(j - 1)), slope(:, face), batch%two_over_h(:, block))
               ratio(:) = min(ratio, volume_ratios(h))
            end do
         end do
      end do
   end function block_ratio

   !> Displacement of a block at the nodes of a quad at all levels
   pure function node_values(batch, block, side, node, displacement) result(u)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block, side, node(:)
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp) :: u(lanes, side, side, batch%expansion%order + 1, 3)

      integer :: c, first, i, j, t

      do c = 1, 3
         do t = 1, size(u, 4)
            do j = 1, side
               do i = 1, side
                  first = first_degree(batch, block, node(i + side*(j - 1)), t, c)
                  u(:, i, j, t, c) = displacement(first:first + lanes - 1)
               end do
            end do
         end do
      end do
   end function node_values

   !> Displacement gradient at a corner, (lanes, components, directions)
   pure function corner_gradient(u, place, metric, slope, two_over_h) result(h)
      !> From `node_values`
      real(wp), intent(in) :: u(:, :, :, :, :)
      !> Of the corner along xi and eta, and its level
      integer, intent(in) :: place(3)
      !> Geometry of the corner, slopes of the expansion, 2 over the thickness
      real(wp), intent(in) :: metric(5), slope(:), two_over_h(lanes)
      real(wp) :: h(lanes, 3, 3)

      real(wp) :: along(lanes, 2)
      integer :: c, t

      do c = 1, 3
         along(:, 1) = twice_slope(u(:, :, place(2), place(3), c), place(1))
         along(:, 2) = twice_slope(u(:, place(1), :, place(3), c), place(2))
         h(:, c, 1) = along(:, 1)*metric(1) + along(:, 2)*metric(3)
         h(:, c, 2) = along(:, 1)*metric(2) + along(:, 2)*metric(4)
         h(:, c, 3) = 0.0_wp
         do t = 1, size(slope)
            h(:, c, 3) = h(:, c, 3) + slope(t)*u(:, place(1), place(2), t, c)
         end do
         h(:, c, 3) = h(:, c, 3)*two_over_h
      end do
   end function corner_gradient

   !> Twice the derivative along a line of two or three nodes at one of its ends
   pure function twice_slope(line, at) result(slope)
      !> (lanes, nodes)
      real(wp), intent(in) :: line(:, :)
      !> The first or the last node
      integer, intent(in) :: at
      real(wp) :: slope(lanes)

      associate (n => size(line, 2))
         slope(:) = line(:, n) - line(:, 1)
         if (n == 3) slope(:) = slope + real(2*(at - 2), wp)*(line(:, 3) + line(:, 1) &
            & - 2.0_wp*line(:, 2))
      end associate
   end function twice_slope

end module plydyn_element_plate_corner_volume
