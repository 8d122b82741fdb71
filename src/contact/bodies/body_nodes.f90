!> Contact nodes on a body of revolution, with its outward normals.
!>
!> Rings around the node at the tip, along arcs and straight sides of the outline: at most a spacing
!> apart along it, about a spacing between nodes of a ring. No node of an upright body lies on the x
!> or y axis, where sides of facets often are. The pattern is symmetric under rotations by 90
!> degrees to the last bit, and under reflection to round-off.
module plydyn_contact_bodies_body_nodes
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_revolved_body, only : revolved_body_type
   implicit none
   private

   public :: append_nodes, count_nodes

   !> Which nodes of a body are wanted
   type, public :: node_range_type
      !> Distance between nodes, length
      real(wp) :: spacing = 0.0_wp
      !> Largest horizontal distance of a ring from the centre, length
      real(wp) :: horizontal = huge(1.0_wp)
      !> Heights above the lowest point of the body: above the first, up to the second, length
      real(wp) :: height(2) = [-huge(1.0_wp), huge(1.0_wp)]
      !> 1 when the plate lies below the body, -1 when above
      integer :: side = 1
      !> About how many nodes to count at most; rings of an arc or side beyond count as more
      integer :: most = huge(1)
   end type node_range_type

   !> Radians
   real(wp), parameter :: right_angle = acos(0.0_wp)

   !> Quarters of a ring
   integer, parameter :: quarters = 4

   !> Cosine between the outward normal and the plate that is round-off
   real(wp), parameter :: round_off = 1.0e-9_wp

   !> Nodes being made: only counted where the arrays are not allocated
   type :: node_list_type
      integer :: count = 0
      real(wp), allocatable :: position(:, :), outward(:, :)
   end type node_list_type

contains

   !> How many nodes there are in a range
   pure integer function count_nodes(body, range) result(nodes)
      type(revolved_body_type), intent(in) :: body
      !> What is wanted
      type(node_range_type), intent(in) :: range

      type(node_list_type) :: list

      call make_nodes(body, range, list)
      nodes = list%count
   end function count_nodes

   !> Append the nodes in a range
   pure subroutine append_nodes(body, range, position, outward)
      type(revolved_body_type), intent(in) :: body
      !> What is wanted
      type(node_range_type), intent(in) :: range
      !> Positions relative to the centre, and unit normals, (3, nodes), ring after ring
      real(wp), allocatable, intent(inout) :: position(:, :), outward(:, :)

      type(node_list_type) :: list
      integer :: before

      before = size(position, 2)
      list%count = count_nodes(body, range)
      allocate (list%position(3, before + list%count), list%outward(3, before + list%count))
      list%position(:, :before) = position
      list%outward(:, :before) = outward
      list%count = before
      call make_nodes(body, range, list)
      call move_alloc(list%position, position)
      call move_alloc(list%outward, outward)
   end subroutine append_nodes

   !> Run along the outline from the tip to the back
   pure subroutine make_nodes(body, range, list)
      type(revolved_body_type), intent(in) :: body
      type(node_range_type), intent(in) :: range
      type(node_list_type), intent(inout) :: list

      real(wp) :: angle(2), edge(2)
      integer :: c, last

      last = size(body%corner, 2)
      call add_ring(body, range, body%corner(:, 1), 0.0_wp, list)
      angle(:) = 0.0_wp
      do c = 1, last
         ! the arc around a corner, from the normal of the side before it to that of the one behind
         angle(1) = angle(2)
         angle(2) = 2.0_wp*right_angle
         edge(:) = 0.0_wp
         if (c < last) then
            edge(:) = body%corner(:, c + 1) - body%corner(:, c)
            angle(2) = atan2(edge(1), edge(2))
         end if
         call add_arc(body, range, body%corner(:, c), [angle(1), min(angle(2), right_angle)], list)
         call add_arc(body, range, body%corner(:, c), [max(angle(1), right_angle), angle(2)], list)
         if (c < last) call add_side(body, range, body%corner(:, c), edge, angle(2), list)
      end do
   end subroutine make_nodes

   !> Rings along an arc of the outline, without its first point
   pure subroutine add_arc(body, range, corner, angle, list)
      type(revolved_body_type), intent(in) :: body
      type(node_range_type), intent(in) :: range
      !> Corner of the core
      real(wp), intent(in) :: corner(2)
      !> Angles of the normal from the axis at both ends, radians
      real(wp), intent(in) :: angle(2)
      type(node_list_type), intent(inout) :: list

      integer :: r, rings

      if (angle(2) <= angle(1) .or. body%rounding <= 0.0_wp) return
      call count_rings(range, (angle(2) - angle(1))*body%rounding, rings, list)
      do r = 1, rings
         call add_ring(body, range, corner, angle(1) + r*((angle(2) - angle(1))/rings), list)
      end do
   end subroutine add_arc

   !> Rings along a straight side of the outline, without its first point
   pure subroutine add_side(body, range, corner, edge, angle, list)
      type(revolved_body_type), intent(in) :: body
      type(node_range_type), intent(in) :: range
      !> First corner of the core, and from there to the next one, length
      real(wp), intent(in) :: corner(2), edge(2)
      !> Of the normal from the axis, radians
      real(wp), intent(in) :: angle
      type(node_list_type), intent(inout) :: list

      real(wp) :: steepest, upward
      integer :: r, rings

      upward = range%side*body%axis(3)
      steepest = cos(angle)*upward + sin(angle)*sqrt(max(0.0_wp, 1.0_wp - upward**2))
      if (steepest <= round_off) return
      associate (length => min(norm2(edge), abs(corner(1)) + 2.0_wp*range%horizontal))
         call count_rings(range, length, rings, list)
         do r = 1, rings
            call add_ring(body, range, corner + edge*(length/norm2(edge)*r/rings), angle, list)
         end do
      end associate
   end subroutine add_side

   !> Number of rings along a length of the outline; none, and too many nodes, where they are
   !> more than may be counted
   pure subroutine count_rings(range, length, rings, list)
      type(node_range_type), intent(in) :: range
      real(wp), intent(in) :: length
      integer, intent(out) :: rings
      type(node_list_type), intent(inout) :: list

      rings = 0
      if (length > range%most*range%spacing) then
         list%count = huge(list%count)
      else
         rings = max(1, ceiling(length/range%spacing))
      end if
   end subroutine count_rings

   !> Nodes evenly spaced on a circle around the axis, half a spacing from the first direction:
   !> those that face the plate and lie in the range
   pure subroutine add_ring(body, range, corner, angle, list)
      type(revolved_body_type), intent(in) :: body
      type(node_range_type), intent(in) :: range
      !> Point of the core, along the axis and across, length
      real(wp), intent(in) :: corner(2)
      !> Of the normal from the axis, radians
      real(wp), intent(in) :: angle
      type(node_list_type), intent(inout) :: list

      real(wp) :: direction(3), normal(3), place(2), turn
      integer :: i, in_quarter, q

      place(:) = corner + body%rounding*[-cos(angle), sin(angle)]
      if (list%count > range%most) return
      if (.not. may_be_wanted(body, range, place)) return
      if (place(2) <= round_off*body%radius) then
         direction(:) = -sign(1.0_wp, cos(angle))*body%axis
         call add_node(body, range, place(1)*body%axis, direction, list)
         return
      end if
      in_quarter = max(1, nint(right_angle*place(2)/range%spacing))
      do q = 0, quarters - 1
         do i = 1, in_quarter
            turn = (i - 0.5_wp)*right_angle/in_quarter
            direction(:) = radial_direction(body%axis, quarter_turned([cos(turn), sin(turn)], q))
            normal(:) = sin(angle)*direction - cos(angle)*body%axis
            call add_node(body, range, place(2)*direction + place(1)*body%axis, normal, list)
         end do
      end do
   end subroutine add_ring

   !> Whether a ring may have nodes in the range
   pure logical function may_be_wanted(body, range, place)
      type(revolved_body_type), intent(in) :: body
      type(node_range_type), intent(in) :: range
      !> Along the axis and across, length
      real(wp), intent(in) :: place(2)

      real(wp) :: lean, upward

      upward = range%side*body%axis(3)
      lean = sqrt(max(0.0_wp, 1.0_wp - upward**2))
      associate (height => upward*place(1) - body%lowest_height(range%side))
         may_be_wanted = height - lean*place(2) <= range%height(2) &
            & .and. height + lean*place(2) > range%height(1) &
            & .and. abs(upward)*place(2) - lean*abs(place(1)) <= range%horizontal
      end associate
   end function may_be_wanted

   !> Add a node, if it faces the plate and lies in the range
   pure subroutine add_node(body, range, position, outward, list)
      type(revolved_body_type), intent(in) :: body
      type(node_range_type), intent(in) :: range
      !> Relative to the centre, and unit normal
      real(wp), intent(in) :: position(3), outward(3)
      type(node_list_type), intent(inout) :: list

      if (range%side*outward(3) > round_off) return
      associate (height => range%side*position(3) - body%lowest_height(range%side))
         if (height <= range%height(1) .or. height > range%height(2)) return
      end associate
      list%count = list%count + 1
      if (.not. allocated(list%position)) return
      list%position(:, list%count) = position
      list%outward(:, list%count) = outward
      ! of a sphere to the last bit along its radius
      if (size(body%corner, 2) == 1) list%outward(:, list%count) = position/norm2(position)
   end subroutine add_node

   !> A direction of the plane after some rotations by 90 degrees, exactly
   pure function quarter_turned(direction, quarter_turns) result(turned)
      real(wp), intent(in) :: direction(2)
      !> From 0 to 3
      integer, intent(in) :: quarter_turns
      real(wp) :: turned(2)

      turned(:) = direction
      if (modulo(quarter_turns, 2) == 1) turned(:) = [-direction(2), direction(1)]
      if (quarter_turns >= 2) turned(:) = -turned
   end function quarter_turned

   !> Direction across an axis: along x and y for an upright one
   pure function radial_direction(axis, plane) result(direction)
      real(wp), intent(in) :: axis(3)
      !> Unit vector in the plane across the axis
      real(wp), intent(in) :: plane(2)
      real(wp) :: direction(3)

      real(wp) :: level(2)

      level(:) = [1.0_wp, 0.0_wp]
      if (any(abs(axis(:2)) > 0.0_wp)) level(:) = [-axis(2), axis(1)]/norm2(axis(:2))
      ! the first direction is level, the second one upright to it and to the axis
      direction(:2) = plane(1)*level
      direction(3) = 0.0_wp
      if (any(abs(axis(:2)) > 0.0_wp)) then
         direction(1) = direction(1) - plane(2)*axis(3)*level(2)
         direction(2) = direction(2) + plane(2)*axis(3)*level(1)
         direction(3) = plane(2)*(axis(1)*level(2) - axis(2)*level(1))
      else
         direction(2) = plane(2)
      end if
   end function radial_direction

end module plydyn_contact_bodies_body_nodes
