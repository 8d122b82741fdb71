!> Checks between the quads of a mesh: no two at one place, no unconnected nodes at one place.
module plydyn_input_check_joined
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_base_text, only : text
   use plydyn_input_catalogue, only : a_node, a_quad, catalogue_type
   use plydyn_model_mesh, only : mesh_type
   implicit none
   private

   public :: check_joined

   !> Corners of a quad
   integer, parameter :: corners = 4
   !> Share of the size of the mesh within which two nodes are at one place
   real(wp), parameter :: tolerance = 1.0e-6_wp
   !> Steps into which the mesh is divided to find them
   real(wp), parameter :: steps = 1.0e9_wp

contains

   !> Check a mesh whose references are all resolved
   subroutine check_joined(mesh, catalogue)
      type(mesh_type), intent(in) :: mesh
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      call check_twins(mesh, catalogue)
      if (.not. catalogue%report%has_errors()) call check_places(mesh, catalogue)
   end subroutine check_joined

   !> No two quads have the same corners
   subroutine check_twins(mesh, catalogue)
      type(mesh_type), intent(in) :: mesh
      type(catalogue_type), intent(inout) :: catalogue

      integer, allocatable :: before(:), latest(:)
      integer :: i, k, least, other

      ! quads by their smallest corner: the latest one, and before each the one before
      allocate (latest(size(mesh%node_id)), before(size(mesh%quad_id)), source=0)
      do i = 1, size(mesh%quad_id)
         associate (corner => mesh%quad_node(:corners, i))
            least = minval(corner)
            other = latest(least)
            do while (other > 0)
               if (all([(any(mesh%quad_node(:corners, other) == corner(k)), k=1, corners)])) exit
               other = before(other)
            end do
            before(i) = latest(least)
            latest(least) = i
         end associate
         if (other > 0) call catalogue%report%refuse(catalogue%location(a_quad, i), "element " &
            & //text(mesh%quad_id(i))//" has the corners of element "//text(mesh%quad_id(other)), &
            & "each element once", catalogue%registers(a_quad)%line(other))
      end do
   end subroutine check_twins

   !> Two nodes at one place tear the plate: a warning, as they may be meant to
   subroutine check_places(mesh, catalogue)
      type(mesh_type), intent(in) :: mesh
      type(catalogue_type), intent(inout) :: catalogue

      integer, allocatable :: key(:), order(:)
      real(wp) :: extent, low(2)
      integer :: i, k

      if (size(mesh%node_id) == 0) return
      low(:) = minval(mesh%position(:2, :), dim=2)
      extent = maxval(maxval(mesh%position(:2, :), dim=2) - low)
      ! by distance along a line on which the nodes of no grid fall together
      key = nint(steps/extent*(cos(1.0_wp)*(mesh%position(1, :) - low(1)) &
         & + sin(1.0_wp)*(mesh%position(2, :) - low(2))))
      order = sorted_order(key)
      do i = 2, size(order)
         do k = i - 1, 1, -1
            if (key(order(i)) - key(order(k)) > 2.0_wp*tolerance*steps) exit
            if (norm2(mesh%position(:, order(i)) - mesh%position(:, order(k))) &
               & > tolerance*extent) cycle
            call catalogue%report%warn(catalogue%location(a_node, maxval(order([i, k]))), "node " &
               & //text(mesh%node_id(maxval(order([i, k]))))//" lies where node " &
               & //text(mesh%node_id(minval(order([i, k]))))//" does: nothing joins them", &
               & "one node in place of both, unless the plate is cut there")
            exit
         end do
      end do
   end subroutine check_places

end module plydyn_input_check_joined
