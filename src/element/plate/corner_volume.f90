!> Ratios of volumes at the corners of the cells of plates, where the polynomials of a layer deviate
!> most from their Gauss points: a cell may be inside out there alone.
module plydyn_element_plate_corner_volume
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_least_volume, only : least_volume_type
   use plydyn_element_plate_gradients, only : find_gradients
   use plydyn_element_plate_layers, only : layer_batch_type, plate_type
   use plydyn_element_quad, only : plane_tables, quad_node_metric, tensor_order
   use plydyn_fem_expansion, only : lagrange
   use plydyn_fem_kinematics, only : volume_ratios
   use plydyn_fem_quadrature, only : equal_points
   use plydyn_model_mesh, only : mesh_type
   implicit none
   private

   public :: find_corner_volumes

contains

   !> Find the least ratio of volumes at the corners of the layers of a batch, with the index of the
   !> layer
   pure subroutine find_corner_volumes(plate, batch, mesh, displacement, least)
      !> The plate and one of its batches
      type(plate_type), intent(in) :: plate
      type(layer_batch_type), intent(in) :: batch
      !> The mesh, which has its positions
      type(mesh_type), intent(in) :: mesh
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> The least so far
      type(least_volume_type), intent(inout) :: least

      type(layer_batch_type) :: layers
      type(plate_type) :: quad
      real(wp) :: h(lanes, 3, 3, batch%expansion%order + 1, plate%side**2), ratio(lanes)
      integer :: block, e, l

      call set_nodal(plate%side, batch, quad, layers)
      do e = 1, size(plate%quad)
         quad%node(:, 1) = plate%node(:, e)
         quad%metric(:, :, 1) = quad_node_metric(plate%side, mesh%position(1:2, &
            & mesh%quad_node(tensor_order(plate%side), plate%quad(e))))
         do block = 1, batch%blocks
            call find_gradients(quad, layers, block, 1, displacement, h)
            ratio(:) = least_ratio(plate%side, h)
            do l = 1, lanes
               if (batch%layer(l, block) == 0) cycle
               call least%take(ratio(l), plate%quad(e), batch%layer(l, block))
            end do
         end do
      end do
   end subroutine find_corner_volumes

   !> A quad, still without nodes, and the layers of a batch, with points at the nodes in the place
   !> of Gauss points
   pure subroutine set_nodal(side, batch, quad, layers)
      !> Nodes along a side
      integer, intent(in) :: side
      type(layer_batch_type), intent(in) :: batch
      type(plate_type), intent(out) :: quad
      type(layer_batch_type), intent(out) :: layers

      integer :: k

      allocate (quad%node(side**2, 1), quad%metric(5, side**2, 1))
      quad%gauss_abscissa = 1.0_wp
      call plane_tables(equal_points(side), quad%shape, quad%slope)
      layers%blocks = batch%blocks
      layers%first = batch%first
      layers%height = batch%height
      layers%two_over_h = batch%two_over_h
      layers%expansion = batch%expansion
      associate (table => layers%expansion)
         do k = 1, size(table%node)
            call lagrange(table%node, table%node(k), table%to_gauss(k, :), table%gauss_slope(k, :))
         end do
      end associate
   end subroutine set_nodal

   !> Least ratio of volumes of each lane at the corners of bottom and top, from the gradients at
   !> all nodes
   pure function least_ratio(side, h) result(ratio)
      integer, intent(in) :: side
      real(wp), intent(in) :: h(:, :, :, :, :)
      real(wp) :: ratio(lanes)

      integer :: i, j, m

      ratio(:) = huge(1.0_wp)
      do j = 1, side, side - 1
         do i = 1, side, side - 1
            do m = 1, size(h, 4), size(h, 4) - 1
               ratio(:) = min(ratio, volume_ratios(h(:, :, :, m, i + side*(j - 1))))
            end do
         end do
      end do
   end function least_ratio

end module plydyn_element_plate_corner_volume
