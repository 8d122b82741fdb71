!> Contact nodes on a body of revolution, with its outward normals.
!>
!> Rings around the node at the tip, along arcs and straight sides of the outline: at most a spacing
!> apart along it, about a spacing between nodes of a ring. No node of an upright body lies on the x
!> or y axis, where sides of facets often are. The pattern is symmetric under rotations by 90
!> degrees to the last bit, and under reflection to round-off.
module plydyn_contact_bodies_body_nodes
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_revolved_body, only : revolved_body_type
   use plydyn_fem_shape, only : bilinear_nodes
   implicit none
   private

   public :: append_nodes, count_nodes, distances_below, first_range

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

   !> Default spacing over the distance between points of the plate, and largest spacing over the
   !> radius: with a larger one hardly more than the lowest node would touch
   real(wp), parameter :: relative_spacing = 0.5_wp
   real(wp), parameter, public :: largest_spacing = 0.75_wp

   !> Height over the radius up to which nodes are made at the start
   real(wp), parameter :: first_height = 0.125_wp

   !> Largest distance of nodes from the axis over that of points of the plate: nodes farther out
   !> touch only after the impactor has moved sideways by half of that
   real(wp), parameter :: axis_distance_factor = 2.0_wp

   !> Distance from the axis, over the radius, of facets that lie below a body
   real(wp), parameter :: relative_zone = 0.5_wp

   !> Radians
   real(wp), parameter :: right_angle = acos(0.0_wp)

   !> Quarters of a ring
   integer, parameter :: quarters = 4

   !> Cosine between the outward normal and the plate that is round-off
   real(wp), parameter :: round_off = 1.0e-9_wp

   !> Nodes being made of a body in a range: only counted where the arrays are not allocated
   type :: node_list_type
      type(revolved_body_type) :: body
      type(node_range_type) :: range
      integer :: count = 0
      real(wp), allocatable :: position(:, :), outward(:, :)
   end type node_list_type

contains

   !> Range of the nodes that a face of the plate may touch first
   pure type(node_range_type) function first_range(body, side, facet, position, centre, spacing) &
      & result(range)
      type(revolved_body_type), intent(in) :: body
      !> 1 for the top face of the plate, -1 for the bottom face
      integer, intent(in) :: side
      !> Points of each facet, (4 or 9, facets)
      integer, intent(in) :: facet(:, :)
      !> Surface points, (3, points), and centre of the body at the start, length
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)
      !> Distance between nodes, length; 0 for one derived from the mesh
      real(wp), intent(in) :: spacing

      integer :: k

      range%side = side
      range%horizontal = 0.0_wp
      do k = 1, size(position, 2)
         range%horizontal = max(range%horizontal, &
            & axis_distance_factor*norm2(position(:2, k) - centre(:2)))
      end do
      range%height(2) = first_height*body%radius
      range%spacing = spacing
      if (spacing > 0.0_wp) return
      associate (apart => distances_below(facet, position, centre, body%radius))
         range%spacing = min(largest_spacing*body%radius, relative_spacing*apart(1))
      end associate
   end function first_range

   !> Smallest distance between points along the sides of facets below a body, and largest distance
   !> across four neighbouring points there, length
   pure function distances_below(facet, position, centre, radius) result(distance)
      !> As in `first_range`
      integer, intent(in) :: facet(:, :)
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)
      !> Radius of the body, length
      real(wp), intent(in) :: radius
      real(wp) :: distance(2)

      real(wp), allocatable :: away(:)
      real(wp) :: most
      integer :: f, s

      ! not on the stack
      allocate (away(size(facet, 2)))
      do f = 1, size(away)
         away(f) = norm2(position(:2, facet(size(facet, 1), f)) - centre(:2))
      end do
      most = max(relative_zone*radius, minval(away))
      distance(:) = [huge(1.0_wp), 0.0_wp]
      do f = 1, size(away)
         if (away(f) > most) cycle
         associate (corner => position(:, facet(:bilinear_nodes, f)))
            do s = 1, bilinear_nodes
               distance(1) = min(distance(1), &
                  & norm2(corner(:, s) - corner(:, modulo(s, bilinear_nodes) + 1)))
            end do
            distance(2) = max(distance(2), norm2(corner(:, 1) - corner(:, 3)), &
               & norm2(corner(:, 2) - corner(:, 4)))
         end associate
      end do
      if (size(facet, 1) > bilinear_nodes) distance(:) = 0.5_wp*distance
   end function distances_below

   !> How many nodes there are in a range
   pure integer function count_nodes(body, range) result(nodes)
      type(revolved_body_type), intent(in) :: body
      !> What is wanted
      type(node_range_type), intent(in) :: range

      type(node_list_type) :: list

      list%body = body
      list%range = range
      call make_nodes(list)
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

      list%body = body
      list%range = range
      list%count = size(position, 2)
      associate (before => size(position, 2), all => size(position, 2) + count_nodes(body, range))
         allocate (list%position(3, all), list%outward(3, all))
         list%position(:, :before) = position
         list%outward(:, :before) = outward
      end associate
      call make_nodes(list)
      call move_alloc(list%position, position)
      call move_alloc(list%outward, outward)
   end subroutine append_nodes

   !> Run along the outline from the tip to the back
   pure subroutine make_nodes(self)
      type(node_list_type), intent(inout) :: self

      real(wp) :: angle(2), edge(2)
      integer :: c, last

      last = size(self%body%corner, 2)
      call add_ring(self, self%body%corner(:, 1), 0.0_wp)
      angle(:) = 0.0_wp
      do c = 1, last
         ! the arc around a corner, from the normal of the side before it to that of the one behind
         angle(1) = angle(2)
         angle(2) = 2.0_wp*right_angle
         edge(:) = 0.0_wp
         if (c < last) then
            edge(:) = self%body%corner(:, c + 1) - self%body%corner(:, c)
            angle(2) = atan2(edge(1), edge(2))
         end if
         call add_arc(self, self%body%corner(:, c), [angle(1), min(angle(2), right_angle)])
         call add_arc(self, self%body%corner(:, c), [max(angle(1), right_angle), angle(2)])
         if (c < last) call add_side(self, self%body%corner(:, c), edge, angle(2))
      end do
   end subroutine make_nodes

   !> Rings along an arc of the outline, without its first point
   pure subroutine add_arc(self, corner, angle)
      type(node_list_type), intent(inout) :: self
      !> Corner of the core
      real(wp), intent(in) :: corner(2)
      !> Angles of the normal from the axis at both ends, radians
      real(wp), intent(in) :: angle(2)

      integer :: r, rings

      if (angle(2) <= angle(1) .or. self%body%rounding <= 0.0_wp) return
      call count_rings(self, (angle(2) - angle(1))*self%body%rounding, rings)
      do r = 1, rings
         call add_ring(self, corner, angle(1) + r*((angle(2) - angle(1))/rings))
      end do
   end subroutine add_arc

   !> Rings along a straight side of the outline, without its first point
   pure subroutine add_side(self, corner, edge, angle)
      type(node_list_type), intent(inout) :: self
      !> First corner of the core, and from there to the next one, length
      real(wp), intent(in) :: corner(2), edge(2)
      !> Of the normal from the axis, radians
      real(wp), intent(in) :: angle

      real(wp) :: steepest, upward
      integer :: r, rings

      upward = self%range%side*self%body%axis(3)
      steepest = cos(angle)*upward + sin(angle)*sqrt(max(0.0_wp, 1.0_wp - upward**2))
      if (steepest <= round_off) return
      associate (length => min(norm2(edge), abs(corner(1)) + 2.0_wp*self%range%horizontal))
         call count_rings(self, length, rings)
         do r = 1, rings
            call add_ring(self, corner + edge*(length/norm2(edge)*r/rings), angle)
         end do
      end associate
   end subroutine add_side

   !> Number of rings along a length of the outline; none, and too many nodes, where they are
   !> more than may be counted
   pure subroutine count_rings(self, length, rings)
      type(node_list_type), intent(inout) :: self
      real(wp), intent(in) :: length
      integer, intent(out) :: rings

      rings = 0
      if (length > self%range%most*self%range%spacing) then
         self%count = huge(self%count)
      else
         rings = max(1, ceiling(length/self%range%spacing))
      end if
   end subroutine count_rings

   !> Nodes evenly spaced on a circle around the axis, half a spacing from the first direction:
   !> those that face the plate and lie in the range
   pure subroutine add_ring(self, corner, angle)
      type(node_list_type), intent(inout) :: self
      !> Point of the core, along the axis and across, length
      real(wp), intent(in) :: corner(2)
      !> Of the normal from the axis, radians
      real(wp), intent(in) :: angle

      real(wp) :: direction(3), normal(3), place(2), turn
      integer :: i, in_quarter, q

      place(:) = corner + self%body%rounding*[-cos(angle), sin(angle)]
      if (self%count > self%range%most) return
      if (.not. may_be_wanted(self, place)) return
      if (place(2) <= round_off*self%body%radius) then
         direction(:) = -sign(1.0_wp, cos(angle))*self%body%axis
         call add_node(self, place(1)*self%body%axis, direction)
         return
      end if
      in_quarter = max(1, nint(right_angle*place(2)/self%range%spacing))
      do q = 0, quarters - 1
         do i = 1, in_quarter
            turn = (i - 0.5_wp)*right_angle/in_quarter
            direction(:) = radial_direction(self%body%axis, &
               & quarter_turned([cos(turn), sin(turn)], q))
            normal(:) = sin(angle)*direction - cos(angle)*self%body%axis
            call add_node(self, place(2)*direction + place(1)*self%body%axis, normal)
         end do
      end do
   end subroutine add_ring

   !> Whether a ring may have nodes in the range
   pure logical function may_be_wanted(self, place)
      type(node_list_type), intent(in) :: self
      !> Along the axis and across, length
      real(wp), intent(in) :: place(2)

      real(wp) :: lean, upward

      upward = self%range%side*self%body%axis(3)
      lean = sqrt(max(0.0_wp, 1.0_wp - upward**2))
      associate (height => upward*place(1) - self%body%lowest_height(self%range%side))
         may_be_wanted = height - lean*place(2) <= self%range%height(2) &
            & .and. height + lean*place(2) > self%range%height(1) &
            & .and. abs(upward)*place(2) - lean*abs(place(1)) <= self%range%horizontal
      end associate
   end function may_be_wanted

   !> Add a node, if it faces the plate and lies in the range
   pure subroutine add_node(self, position, outward)
      type(node_list_type), intent(inout) :: self
      !> Relative to the centre, and unit normal
      real(wp), intent(in) :: position(3), outward(3)

      if (self%range%side*outward(3) > round_off) return
      associate (height => self%range%side*position(3) - self%body%lowest_height(self%range%side))
         if (height <= self%range%height(1) .or. height > self%range%height(2)) return
      end associate
      self%count = self%count + 1
      if (.not. allocated(self%position)) return
      self%position(:, self%count) = position
      self%outward(:, self%count) = outward
      ! of a sphere to the last bit along its radius
      if (size(self%body%corner, 2) == 1) self%outward(:, self%count) = position/norm2(position)
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

      if (any(abs(axis(:2)) > 0.0_wp)) then
         ! the first direction is level, the second one upright to it and to the axis
         level(:) = [-axis(2), axis(1)]/norm2(axis(:2))
         direction(1) = plane(1)*level(1) - plane(2)*axis(3)*level(2)
         direction(2) = plane(1)*level(2) + plane(2)*axis(3)*level(1)
         direction(3) = plane(2)*(axis(1)*level(2) - axis(2)*level(1))
      else
         direction(:) = [plane, 0.0_wp]
      end if
   end function radial_direction

end module plydyn_contact_bodies_body_nodes
