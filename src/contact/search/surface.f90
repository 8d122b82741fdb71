!> A face of the plate as facets, and closest-point projection on it.
!>
!> A facet is a quad of surface points, counter-clockwise from above on both faces. Newton's method
!> with second derivatives finds the closest point of one facet; where the point lies beyond a side
!> the projection walks to the neighbour. The walk ends in the facet below the point as long as the
!> surface is locally a graph, which holds unless the plate is folded.
module plydyn_contact_search_surface
   use plydyn_base_matrix, only : cross
   use plydyn_base_precision, only : lanes, wp
   use plydyn_contact_search_closest_point, only : closest_points, frame_eta, frame_size, &
      & frame_value, frame_xi
   implicit none
   private

   public :: new_surface, on_sides, point_of_side

   !> Sides of a facet; side s runs from corner s to the next
   integer, parameter, public :: sides = 4

   !> Most facets of a walk
   integer, parameter :: max_walks = 100

   !> Local coordinate above which a point is on a side
   real(wp), parameter :: at_side = 1.0_wp - 1.0e-12_wp

   !> Distance beyond a side that counts as zero, relative to the size of the facet
   real(wp), parameter :: side_tolerance = 1.0e-10_wp

   !> Relative decrease of the distance that a walk needs to go on
   real(wp), parameter :: relative_gain = 1.0e-12_wp

   !> Facets of one face of the plate
   type, public :: surface_type
      !> Points of a facet, 4 or 9
      integer :: nodes = 0
      !> Points of each facet, (nodes, facets), indices into the surface points
      integer, allocatable :: facet(:, :)
      !> Facet across each side, (4, facets), 0 at a free edge
      integer, allocatable :: neighbour(:, :)
      !> 1 when the outward normal of the plate is that of the facets (top), -1 when opposite
      real(wp) :: side = 1.0_wp
   contains
      procedure :: start_point
      procedure :: project
      procedure :: project_some
      procedure :: line_misses
      procedure :: enter_neighbour
   end type surface_type

   !> Closest point of the surface to a point
   type, public :: closest_point_type
      !> Facet on which it lies
      integer :: facet = 0
      !> Local coordinates in the facet, each from -1 to 1
      real(wp) :: local(2) = 0.0_wp
      !> Tangents of the facet there, along xi and eta, length
      real(wp) :: tangent(3, 2) = 0.0_wp
      !> From the surface to the point, length
      real(wp) :: gap_vector(3) = 0.0_wp
      !> Unit normal of the facet there, outward of the plate
      real(wp) :: normal(3) = 0.0_wp
      !> Distance along the normal, negative when the point penetrates
      real(wp) :: gap = huge(1.0_wp)
      !> Whether the point lies beyond a free edge: there is no surface below it along the normal
      logical :: is_outside = .false.
   end type closest_point_type

contains

   !> Build the surface from its facets
   subroutine new_surface(self, facet, points, side)
      type(surface_type), intent(out) :: self
      !> Points of each facet, (4 or 9, facets)
      integer, intent(in) :: facet(:, :)
      !> Number of surface points
      integer, intent(in) :: points
      !> 1 for the top face of the plate, -1 for the bottom face
      integer, intent(in) :: side

      self%nodes = size(facet, 1)
      self%side = real(side, wp)
      self%facet = facet
      call find_neighbours(facet, points, self%neighbour)
   end subroutine new_surface

   !> Find the facet across each side
   subroutine find_neighbours(facet, points, neighbour)
      !> Points of each facet
      integer, intent(in) :: facet(:, :)
      !> Number of surface points
      integer, intent(in) :: points
      !> Facet across each side, 0 at a free edge
      integer, allocatable, intent(out) :: neighbour(:, :)

      integer, allocatable :: around(:), before(:)
      integer :: f, s

      call list_facets(facet, points, before, around)
      allocate (neighbour(sides, size(facet, 2)), source=0)
      do f = 1, size(facet, 2)
         do s = 1, sides
            associate (from => facet(s, f), to => facet(modulo(s, sides) + 1, f))
               neighbour(s, f) = facet_across(facet, around(before(from) + 1:before(from + 1)), &
                  & from, to)
            end associate
         end do
      end do
   end subroutine find_neighbours

   !> List the facets around each corner point
   subroutine list_facets(facet, points, before, around)
      !> As in `find_neighbours`
      integer, intent(in) :: facet(:, :), points
      !> Facets point after point; how many there are before those of each point, and in all
      integer, allocatable, intent(out) :: before(:), around(:)

      integer :: f, p, s

      allocate (before(points + 1), around(sides*size(facet, 2)), source=0)
      do f = 1, size(facet, 2)
         before(facet(:sides, f)) = before(facet(:sides, f)) + 1
      end do
      do p = 1, points
         before(p + 1) = before(p + 1) + before(p)
      end do
      ! each point gives its places from the last to the first
      do f = size(facet, 2), 1, -1
         do s = 1, sides
            associate (place => before(facet(s, f)))
               around(place) = f
               place = place - 1
            end associate
         end do
      end do
   end subroutine list_facets

   !> Facet across the side between two corners: the one that has them in the opposite order
   pure integer function facet_across(facet, around, from, to)
      !> Points of each facet
      integer, intent(in) :: facet(:, :)
      !> Facets to search
      integer, intent(in) :: around(:)
      !> Corners of the side
      integer, intent(in) :: from, to

      integer :: i, s

      facet_across = 0
      do i = 1, size(around)
         do s = 1, sides
            if (facet(s, around(i)) == to .and. facet(modulo(s, sides) + 1, around(i)) == from) then
               facet_across = around(i)
            end if
         end do
      end do
   end function facet_across

   !> Local coordinates of a point of a side
   pure function point_of_side(side, along) result(local)
      !> Side of the facet
      integer, intent(in) :: side
      !> Coordinate along it, from -1 to 1 counter-clockwise
      real(wp), intent(in) :: along
      real(wp) :: local(2)

      select case (side)
      case (1)
         local(:) = [along, -1.0_wp]
      case (2)
         local(:) = [1.0_wp, along]
      case (3)
         local(:) = [-along, 1.0_wp]
      case default
         local(:) = [-1.0_wp, -along]
      end select
   end function point_of_side

   !> Start of a projection: the facet whose last point is closest
   pure function start_point(self, position, point, facets) result(closest)
      class(surface_type), intent(in) :: self
      !> Surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Any point, length
      real(wp), intent(in) :: point(3)
      !> Facets to choose from
      integer, intent(in) :: facets(:)
      type(closest_point_type) :: closest

      integer :: i
      real(wp) :: arm(3), least

      least = huge(1.0_wp)
      ! also of a motion that is about to end the run, whose distances are infinite
      if (size(facets) > 0) closest%facet = facets(1)
      do i = 1, size(facets)
         arm(:) = position(:, self%facet(self%nodes, facets(i))) - point
         if (sum(arm**2) >= least) cycle
         least = sum(arm**2)
         closest%facet = facets(i)
      end do
   end function start_point

   !> Closest point of the surface, starting from facet and local coordinates in `closest`
   pure subroutine project(self, position, point, closest)
      class(surface_type), intent(in) :: self
      !> Positions of its points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Any point, length
      real(wp), intent(in) :: point(3)
      !> Start in, closest point out
      type(closest_point_type), intent(inout) :: closest

      real(wp) :: points(3, 1)
      type(closest_point_type) :: results(1)

      points(:, 1) = point
      results(1) = closest
      call self%project_some(position, points, results)
      closest = results(1)
   end subroutine project

   !> Closest points of some points at once
   pure subroutine project_some(self, position, point, closest)
      class(surface_type), intent(in) :: self
      !> Surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Any points, no more than lanes, (3, points), length
      real(wp), intent(in) :: point(:, :)
      !> Start of each in, closest point out
      type(closest_point_type), intent(inout) :: closest(:)

      type(closest_point_type) :: trial(size(closest))
      integer :: i, side(size(closest)), walk
      logical :: is_walking(size(closest))
      real(wp) :: distance, least(size(closest))

      trial(:) = closest
      least(:) = huge(1.0_wp)
      is_walking(:) = .true.
      do walk = 1, max_walks
         call project_on_facets(self, position, point, trial, side)
         do i = 1, size(closest)
            if (.not. is_walking(i)) cycle
            distance = sqrt(dot_product(trial(i)%gap_vector, trial(i)%gap_vector))
            is_walking(i) = distance <= (1.0_wp - relative_gain)*least(i)
            if (.not. is_walking(i)) cycle
            closest(i) = trial(i)
            is_walking(i) = side(i) > 0
            least(i) = distance
            if (is_walking(i)) call self%enter_neighbour(side(i), trial(i))
         end do
         if (.not. any(is_walking)) return
      end do
   end subroutine project_some

   !> Change to the neighbour, at the same point of the common side
   pure subroutine enter_neighbour(self, side, closest)
      class(surface_type), intent(in) :: self
      !> Side that is crossed
      integer, intent(in) :: side
      !> On a facet in, on its neighbour out
      type(closest_point_type), intent(inout) :: closest

      real(wp) :: from_side(sides)
      integer :: next

      from_side(:) = [closest%local(1), closest%local(2), -closest%local(1), -closest%local(2)]
      next = self%neighbour(side, closest%facet)
      closest%local(:) = point_of_side(findloc(self%neighbour(:, next), closest%facet, dim=1), &
         & -from_side(side))
      closest%facet = next
   end subroutine enter_neighbour

   !> Closest points of one facet each, and the sides beyond which the points lie
   pure subroutine project_on_facets(self, position, point, closest, side)
      type(surface_type), intent(in) :: self
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Any points, no more than lanes, (3, points), length
      real(wp), intent(in) :: point(:, :)
      !> Facet and start of each in, closest point out
      type(closest_point_type), intent(inout) :: closest(:)
      !> Side with a neighbour beyond which the point lies, 0 for none
      integer, intent(out) :: side(:)

      real(wp) :: frame(lanes, 3, frame_size), local(lanes, 2), x(lanes, 3, self%nodes)
      integer :: i, k, l, p

      do l = 1, lanes
         ! spare lanes repeat the last point
         i = min(l, size(closest))
         !GCC$ novector
         do k = 1, self%nodes
            p = self%facet(k, closest(i)%facet)
            x(l, 1, k) = position(1, p) - point(1, i)
            x(l, 2, k) = position(2, p) - point(2, i)
            x(l, 3, k) = position(3, p) - point(3, i)
         end do
         local(l, :) = closest(i)%local
      end do
      call closest_points(self%nodes, x, local, frame)
      do i = 1, size(closest)
         closest(i)%local(:) = local(i, :)
         closest(i)%gap_vector(:) = -frame(i, :, frame_value)
         closest(i)%tangent(:, :) = frame(i, :, frame_xi:frame_eta)
         call finish_projection(self, closest(i), side(i))
      end do
   end subroutine project_on_facets

   !> Normal and gap at the closest point, and the side beyond which the point lies
   pure subroutine finish_projection(self, closest, side)
      type(surface_type), intent(in) :: self
      !> Facet, local coordinates, tangents and gap vector in, all out
      type(closest_point_type), intent(inout) :: closest
      !> Side with a neighbour beyond which the point lies, 0 for none
      integer, intent(out) :: side

      real(wp) :: along(2), distance_over(sides)
      integer :: c, s

      closest%normal(:) = cross(closest%tangent(:, 1), closest%tangent(:, 2))
      closest%normal(:) = self%side*(closest%normal/sqrt(dot_product(closest%normal, &
         & closest%normal)))
      closest%gap = dot_product(closest%gap_vector, closest%normal)
      closest%is_outside = .false.
      side = 0
      if (all(abs(closest%local) < at_side)) return

      do c = 1, 2
         along(c) = dot_product(closest%gap_vector, closest%tangent(:, c)) &
            & /sum(closest%tangent(:, c)**2)
      end do
      distance_over(:) = overshoot(closest, along)
      do s = 1, sides
         if (distance_over(s) <= side_tolerance) cycle
         if (self%neighbour(s, closest%facet) == 0) then
            closest%is_outside = .true.
         else if (side == 0) then
            side = s
         else if (distance_over(s) > distance_over(side)) then
            side = s
         end if
      end do
   end subroutine finish_projection

   !> Distance beyond each side, in local coordinates; zero for sides on which the closest point is
   !> not
   pure function overshoot(closest, along) result(distance_over)
      type(closest_point_type), intent(in) :: closest
      !> Distance from the closest point along xi and eta, in local coordinates
      real(wp), intent(in) :: along(2)
      real(wp) :: distance_over(sides)

      distance_over(:) = merge(towards_sides(along), 0.0_wp, on_sides(closest%local))
   end function overshoot

   !> On which sides of its facet a point lies
   pure function on_sides(local)
      !> Local coordinates
      real(wp), intent(in) :: local(2)
      logical :: on_sides(sides)

      on_sides(:) = towards_sides(local) >= at_side
   end function on_sides

   !> Share of a vector in local coordinates towards each side
   pure function towards_sides(along) result(towards)
      real(wp), intent(in) :: along(2)
      real(wp) :: towards(sides)

      towards(:) = [-along(2), along(1), along(2), -along(1)]
   end function towards_sides

   !> Whether a line through the projected point passes the surface beyond a free edge
   !>
   !> At a plane of symmetry through an indentation the normal of the facet is inclined across the
   !> edge: the point is outside along that normal, but not along a line in the plane.
   pure logical function line_misses(self, closest, direction)
      class(surface_type), intent(in) :: self
      type(closest_point_type), intent(in) :: closest
      !> Direction of the line, not tangential to the facet
      real(wp), intent(in) :: direction(3)

      real(wp) :: along(2), arm(3), metric(2, 2)

      ! from the closest point to the intersection of the line with the tangent plane
      arm(:) = closest%gap_vector - closest%gap/dot_product(direction, closest%normal)*direction
      ! its parts along the tangents, which need not be perpendicular
      along(:) = matmul(arm, closest%tangent)
      metric(:, :) = matmul(transpose(closest%tangent), closest%tangent)
      along(:) = [metric(2, 2)*along(1) - metric(1, 2)*along(2), &
         & metric(1, 1)*along(2) - metric(1, 2)*along(1)]/(metric(1, 1)*metric(2, 2) &
         & - metric(1, 2)**2)
      line_misses = any(overshoot(closest, along) > side_tolerance &
         & .and. self%neighbour(:, closest%facet) == 0)
   end function line_misses

end module plydyn_contact_search_surface
