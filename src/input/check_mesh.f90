!> Checks of a mesh: quads in one plane, counter-clockwise and not folded, or bricks; no strays.
module plydyn_input_check_mesh
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_report, only : deck_location_type
   use plydyn_fem_quadrature, only : gauss_points
   use plydyn_fem_shape, only : shape_functions
   use plydyn_input_catalogue, only : a_brick, a_node, a_quad, catalogue_type
   use plydyn_model_material, only : material_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_base_sort, only : sorted_order
   implicit none
   private

   public :: check_bricks, check_joined, check_mesh, refuse_averages

   !> Corners of a quad
   integer, parameter :: corners = 4
   !> Share of the size of the mesh within which two nodes are at one place
   real(wp), parameter :: tolerance = 1.0e-6_wp
   !> Steps into which the mesh is divided to find them
   real(wp), parameter :: steps = 1.0e9_wp

   !> Share of the size of the mesh by which nodes may leave the plane
   real(wp), parameter :: flat = 1.0e-6_wp
   !> Smallest sine of a corner of a quad
   real(wp), parameter :: least_sine = 1.0e-3_wp
   !> Smallest share of the longest side that a side of a quad may be
   real(wp), parameter :: least_side = 1.0e-6_wp
   !> Share of the edge by which a mid-side node may lie off the middle
   real(wp), parameter :: most_off_middle = 0.25_wp
   !> Centre of a quad with nine nodes
   integer, parameter :: centre = 9

contains

   !> Check a mesh whose references are all resolved
   subroutine check_mesh(mesh, catalogue)
      type(mesh_type), intent(in) :: mesh
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i

      call check_plane(mesh, catalogue)
      if (.not. catalogue%report%has_errors()) call check_strays(mesh%quad_node, mesh%node_id, &
         & catalogue)
      do i = 1, size(mesh%quad_id)
         call check_quad(mesh%position(:, mesh%quad_node(:, i)), i, catalogue)
      end do
   end subroutine check_mesh

   !> All nodes have the same z
   subroutine check_plane(mesh, catalogue)
      type(mesh_type), intent(in) :: mesh
      type(catalogue_type), intent(inout) :: catalogue

      real(wp) :: extent
      integer :: i

      if (size(mesh%node_id) == 0) return
      extent = maxval(maxval(mesh%position, dim=2) - minval(mesh%position, dim=2))
      do i = 2, size(mesh%node_id)
         if (abs(mesh%position(3, i) - mesh%position(3, 1)) <= flat*extent) cycle
         call catalogue%report%refuse(catalogue%location(a_node, i), &
            & "node "//text(mesh%node_id(i)) &
            & //" lies at z = "//text(mesh%position(3, i))//", the first node at z = " &
            & //text(mesh%position(3, 1)), "a laminate in one plane z = const", &
            & catalogue%registers(a_node)%line(1))
      end do
   end subroutine check_plane

   !> Every node belongs to an element: one that does not would have no mass
   subroutine check_strays(element_node, node_id, catalogue)
      !> Indices of the nodes of all elements, and numbers of all nodes
      integer, intent(in) :: element_node(:, :), node_id(:)
      type(catalogue_type), intent(inout) :: catalogue

      logical :: met(size(node_id))
      integer :: i

      met(:) = .false.
      do i = 1, size(element_node, 2)
         met(element_node(:, i)) = .true.
      end do
      do i = 1, size(met)
         if (.not. met(i)) call catalogue%report%refuse(catalogue%location(a_node, i), "node " &
            & //text(node_id(i))//" belongs to no element", "only nodes of elements in the deck")
      end do
   end subroutine check_strays

   !> Corners turn to the left, mid-sides lie near the middle of their sides
   subroutine check_quad(x, i, catalogue)
      !> Positions of its nodes
      real(wp), intent(in) :: x(:, :)
      !> Index of the quad
      integer, intent(in) :: i
      type(catalogue_type), intent(inout) :: catalogue

      real(wp) :: edge(2, corners), length(corners), sine(corners)
      integer :: k

      do k = 1, corners
         edge(:, k) = x(:2, modulo(k, corners) + 1) - x(:2, k)
         length(k) = norm2(edge(:, k))
      end do
      do k = 1, corners
         associate (before => modulo(k - 2, corners) + 1)
            sine(k) = (edge(1, before)*edge(2, k) - edge(2, before)*edge(1, k)) &
               & /max(length(before)*length(k), tiny(1.0_wp))
         end associate
      end do
      if (minval(length) < least_side*maxval(length)) then
         call blame(i, "has a side of "//text(minval(length))//" beside one of " &
            & //text(maxval(length)), "corners at four places", catalogue)
      else if (minval(sine) > least_sine) then
         if (size(x, 2) == centre) call check_middles(x, length, i, catalogue)
      else if (maxval(sine) < -least_sine) then
         call blame(i, "is clockwise seen from above", &
            & "its nodes counter-clockwise seen from +z", catalogue)
      else
         call blame(i, "has no area, or is folded at a corner", &
            & "four corners that all turn to the left", catalogue)
      end if
   end subroutine check_quad

   !> Mid-sides and centre of a quad with nine nodes
   subroutine check_middles(x, length, i, catalogue)
      !> Positions of its nodes, and lengths of its sides
      real(wp), intent(in) :: x(:, :), length(corners)
      !> Index of the quad
      integer, intent(in) :: i
      type(catalogue_type), intent(inout) :: catalogue

      real(wp) :: curved(2), middle(2)
      integer :: k

      do k = 1, corners
         middle(:) = 0.5_wp*(x(:2, k) + x(:2, modulo(k, corners) + 1))
         if (norm2(x(:2, corners + k) - middle) <= most_off_middle*length(k)) cycle
         call blame(i, "has its node "//text(corners + k)//" far from the middle of its side", &
            & "corners, then the middles of sides 1-2, 2-3, 3-4, 4-1, then the centre", catalogue)
         return
      end do
      ! between the corners, or where curved sides take it
      middle(:) = 0.25_wp*sum(x(:2, :corners), dim=2)
      curved(:) = 0.5_wp*sum(x(:2, corners + 1:2*corners), dim=2) - middle
      if (min(norm2(x(:2, centre) - middle), norm2(x(:2, centre) - curved)) &
         & > most_off_middle*minval(length)) then
         call blame(i, "has its node 9 far from its centre", &
            & "corners, then the middles of sides 1-2, 2-3, 3-4, 4-1, then the centre", catalogue)
      else if (is_folded(x)) then
         call blame(i, "is folded: its Jacobian is not positive everywhere", &
            & "mid-sides and centre nearer to the middles, or a quad nearer to a square", catalogue)
      end if
   end subroutine check_middles

   !> Whether the Jacobian of a quad with nine nodes is not positive at a node or a Gauss point
   pure logical function is_folded(x)
      !> Positions of its nodes
      real(wp), intent(in) :: x(:, :)

      real(wp) :: jacobian(2, 2), place(5), shape(centre), slope(2, centre)
      integer :: k, l

      is_folded = .true.
      place(:3) = gauss_points(3)
      place(4:) = [-1.0_wp, 1.0_wp]
      do l = 1, size(place)
         do k = 1, size(place)
            call shape_functions(centre, place(k), place(l), shape, slope)
            jacobian(:, :) = matmul(x(:2, :), transpose(slope))
            if (jacobian(1, 1)*jacobian(2, 2) <= jacobian(1, 2)*jacobian(2, 1)) return
         end do
      end do
      is_folded = .false.
   end function is_folded

   !> Report an error of a quad
   subroutine blame(i, wrong, right, catalogue)
      !> Index of the quad
      integer, intent(in) :: i
      !> What is wrong, and what would be right
      character(*), intent(in) :: wrong, right
      type(catalogue_type), intent(inout) :: catalogue

      call catalogue%report%refuse(catalogue%location(a_quad, i), "element " &
         & //text(catalogue%registers(a_quad)%id(i))//" "//wrong, right)
   end subroutine blame

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

   !> Refuse averages over neighbours: bricks belong to no layer
   subroutine refuse_averages(materials, catalogue)
      !> Materials of bricks
      type(material_type), intent(in) :: materials(:)
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i

      do i = 1, size(materials)
         if (.not. materials(i)%law%averages()) cycle
         call catalogue%report%refuse(deck_location_type(line=materials(i)%radius_line), &
            & "R1 of material "//text(materials(i)%id)//": an average over neighbours does not " &
            & //"go with bricks", "plies of plates, or no radii")
      end do
   end subroutine refuse_averages

   !> Every node belongs to a brick, and no brick is turned inside out
   subroutine check_bricks(mesh, catalogue)
      type(mesh_type), intent(in) :: mesh
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i

      call check_strays(mesh%brick_node, mesh%node_id, catalogue)
      do i = 1, size(mesh%brick_id)
         if (is_right(mesh%position(:, mesh%brick_node(:, i)))) cycle
         call catalogue%report%refuse(catalogue%location(a_brick, i), "brick " &
            & //text(mesh%brick_id(i))//" is folded at a corner, or inside out", "four nodes " &
            & //"counter-clockwise seen from the opposite face, then the four of that face in " &
            & //"the same order")
      end do
   end subroutine check_bricks

   !> Whether the three edges at every corner of a brick make a volume
   pure logical function is_right(x)
      !> Positions of the nodes, (3, 8)
      real(wp), intent(in) :: x(:, :)

      !> Neighbours of the corners, in the order that makes a volume positive
      integer, parameter :: next(3, 8) = reshape([2, 4, 5, 3, 1, 6, 4, 2, 7, 1, 3, 8, 8, 6, 1, &
         & 5, 7, 2, 6, 8, 3, 7, 5, 4], [3, 8])
      real(wp) :: e(3, 3)
      integer :: k

      is_right = .true.
      do k = 1, 8
         e(:, :) = x(:, next(:, k)) - spread(x(:, k), 2, 3)
         is_right = is_right .and. e(1, 1)*(e(2, 2)*e(3, 3) - e(3, 2)*e(2, 3)) &
            & - e(2, 1)*(e(1, 2)*e(3, 3) - e(3, 2)*e(1, 3)) &
            & + e(3, 1)*(e(1, 2)*e(2, 3) - e(2, 2)*e(1, 3)) > 0.0_wp
      end do
   end function is_right

end module plydyn_input_check_mesh
