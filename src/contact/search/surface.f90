!> A face of the plate as facets, and the closest point on it.
!>
!> A facet is a quad of surface points, counter-clockwise from above on both faces. The closest
!> point is found by Newton's method with second derivatives inside one facet and by walking to
!> the neighbour when the point lies beyond a side. The surface is taken to be locally a graph:
!> the walk ends in the facet under the point, as it does for anything but a folded plate.
module plydyn_contact_search_surface
   use plydyn_base_precision, only : lanes, wp
   use plydyn_contact_search_closest_point, only : closest_points
   use plydyn_contact_search_facet, only : frame_eta, frame_size, frame_value, frame_xi
   use plydyn_contact_search_neighbours, only : find_neighbours, sides
   implicit none
   private

   public :: new_surface

   !> Facets walked through before giving up
   integer, parameter :: most_walks = 100

   !> Local coordinate from which a place is on a side
   real(wp), parameter :: at_side = 1.0_wp - 1.0e-12_wp

   !> Distance beyond a side that counts as beyond, relative to the size of the facet
   real(wp), parameter :: side_tolerance = 1.0e-10_wp

   !> Share of the distance that a walk must gain to go on
   real(wp), parameter :: least_gain = 1.0e-12_wp

   !> Facets of one face of the plate
   type, public :: surface_type
      !> Points of a facet, 4 or 9
      integer :: nodes = 0
      !> Points of each facet, (nodes, facets), indices into the surface points
      integer, allocatable :: facet(:, :)
      !> Facet beyond each side, (4, facets), 0 at the border
      integer, allocatable :: neighbour(:, :)
      !> 1 when the outward normal of the plate is that of the facets (top), -1 when opposite
      real(wp) :: side = 1.0_wp
   contains
      procedure :: start_candidate_list
      procedure :: project
      procedure :: project_some
      procedure :: is_missed
   end type surface_type

   !> Foot of the perpendicular from a point to the surface
   type, public :: closest_point_type
      !> Facet on which it lies
      integer :: facet = 0
      !> Place in the facet, each from -1 to 1
      real(wp) :: place(2) = 0.0_wp
      !> Tangents of the facet there, along xi and eta, length
      real(wp) :: tangent(3, 2) = 0.0_wp
      !> From the surface to the point, length
      real(wp) :: gap_vector(3) = 0.0_wp
      !> Unit normal of the facet there, outward of the plate
      real(wp) :: normal(3) = 0.0_wp
      !> Distance along the normal, negative when the point penetrates
      real(wp) :: gap = huge(1.0_wp)
      !> The point lies beyond the border of the surface: nothing is under it along the normal
      logical :: beside = .false.
   end type closest_point_type

contains

   !> Build the surface from its facets
   subroutine new_surface(self, facet, points, side)
      !> The surface
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

   !> Start of a projection: the facet whose last point is nearest
   pure function start_candidate_list(self, position, point, facets) result(foot)
      !> The surface
      class(surface_type), intent(in) :: self
      !> Surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Any point, length
      real(wp), intent(in) :: point(3)
      !> Facets to look at
      integer, intent(in) :: facets(:)
      type(closest_point_type) :: foot

      integer :: i
      real(wp) :: arm(3), least

      least = huge(1.0_wp)
      do i = 1, size(facets)
         arm(:) = position(:, self%facet(self%nodes, facets(i))) - point
         if (sum(arm**2) >= least) cycle
         least = sum(arm**2)
         foot%facet = facets(i)
      end do
   end function start_candidate_list

   !> Closest point of the surface, starting from the facet and place in `foot`
   pure subroutine project(self, position, point, foot)
      !> The surface
      class(surface_type), intent(in) :: self
      !> Surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Any point, length
      real(wp), intent(in) :: point(3)
      !> Start in, foot out
      type(closest_point_type), intent(inout) :: foot

      real(wp) :: points(3, 1)
      type(closest_point_type) :: feet(1)

      points(:, 1) = point
      feet(1) = foot
      call self%project_some(position, points, feet)
      foot = feet(1)
   end subroutine project

   !> The same for some points at once
   pure subroutine project_some(self, position, point, foot)
      !> The surface
      class(surface_type), intent(in) :: self
      !> Surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Any points, no more than lanes, (3, points), length
      real(wp), intent(in) :: point(:, :)
      !> Of each the start in, foot out
      type(closest_point_type), intent(inout) :: foot(:)

      type(closest_point_type) :: trial(size(foot))
      integer :: i, side(size(foot)), walk
      logical :: walks(size(foot))
      real(wp) :: distance, least(size(foot))

      trial(:) = foot
      least(:) = huge(1.0_wp)
      walks(:) = .true.
      do walk = 1, most_walks
         call descend(self, position, point, trial, side)
         do i = 1, size(foot)
            if (.not. walks(i)) cycle
            distance = sqrt(dot_product(trial(i)%gap_vector, trial(i)%gap_vector))
            walks(i) = distance <= (1.0_wp - least_gain)*least(i)
            if (.not. walks(i)) cycle
            foot(i) = trial(i)
            walks(i) = side(i) > 0
            least(i) = distance
            if (walks(i)) call cross(self, side(i), trial(i))
         end do
         if (.not. any(walks)) return
      end do
   end subroutine project_some

   !> Start in the neighbour, at the same point of the common side
   pure subroutine cross(self, side, foot)
      !> The surface
      type(surface_type), intent(in) :: self
      !> Side of the facet that is left
      integer, intent(in) :: side
      !> On a facet in, on its neighbour out
      type(closest_point_type), intent(inout) :: foot

      real(wp) :: along, from_side(sides)
      integer :: entry_side, next

      from_side(:) = [foot%place(1), foot%place(2), -foot%place(1), -foot%place(2)]
      along = -from_side(side)
      next = self%neighbour(side, foot%facet)
      entry_side = findloc(self%neighbour(:, next), foot%facet, dim=1)
      select case (entry_side)
      case (1)
         foot%place(:) = [along, -1.0_wp]
      case (2)
         foot%place(:) = [1.0_wp, along]
      case (3)
         foot%place(:) = [-along, 1.0_wp]
      case default
         foot%place(:) = [-1.0_wp, -along]
      end select
      foot%facet = next
   end subroutine cross

   !> Closest points of one facet each, and the sides over which the points lie
   pure subroutine descend(self, position, point, foot, side)
      !> The surface
      type(surface_type), intent(in) :: self
      !> Surface points, length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Any points, no more than lanes, (3, points), length
      real(wp), intent(in) :: point(:, :)
      !> Of each facet and start in, foot out
      type(closest_point_type), intent(inout) :: foot(:)
      !> Side with a neighbour beyond which the point lies, 0 for none
      integer, intent(out) :: side(:)

      real(wp) :: frame(lanes, 3, frame_size), place(lanes, 2), x(lanes, 3, self%nodes)
      integer :: i, k, l, p

      do l = 1, lanes
         ! what is over does as the last one
         i = min(l, size(foot))
         !GCC$ novector
         do k = 1, self%nodes
            p = self%facet(k, foot(i)%facet)
            x(l, 1, k) = position(1, p) - point(1, i)
            x(l, 2, k) = position(2, p) - point(2, i)
            x(l, 3, k) = position(3, p) - point(3, i)
         end do
         place(l, :) = foot(i)%place
      end do
      call closest_points(self%nodes, x, place, frame)
      do i = 1, size(foot)
         foot(i)%place(:) = place(i, :)
         foot(i)%gap_vector(:) = -frame(i, :, frame_value)
         foot(i)%tangent(:, :) = frame(i, :, frame_xi:frame_eta)
         call finish_foot(self, foot(i), side(i))
      end do
   end subroutine descend

   !> Normal and gap at the closest point, and the side over which the point lies
   pure subroutine finish_foot(self, foot, side)
      !> The surface
      type(surface_type), intent(in) :: self
      !> Facet, place, tangents and gap vector in, all out
      type(closest_point_type), intent(inout) :: foot
      !> Side with a neighbour beyond which the point lies, 0 for none
      integer, intent(out) :: side

      real(wp) :: over(sides)
      integer :: s

      foot%normal(:) = self%side*unit_normal(foot%tangent(:, 1), foot%tangent(:, 2))
      foot%gap = dot_product(foot%gap_vector, foot%normal)
      foot%beside = .false.
      side = 0
      if (all(abs(foot%place) < at_side)) return

      over(:) = beyond(foot, foot%gap_vector)
      do s = 1, sides
         if (over(s) <= side_tolerance) cycle
         if (self%neighbour(s, foot%facet) == 0) then
            foot%beside = .true.
         else if (side == 0) then
            side = s
         else if (over(s) > over(side)) then
            side = s
         end if
      end do
   end subroutine finish_foot

   !> How far beyond each side of the facet an arm from the foot ends, in local coordinates; zero
   !> for sides on which the foot is not
   pure function beyond(foot, arm) result(over)
      !> The foot
      type(closest_point_type), intent(in) :: foot
      !> From the foot, length
      real(wp), intent(in) :: arm(3)
      real(wp) :: over(sides)

      real(wp) :: towards(sides)

      towards(:) = [-foot%place(2), foot%place(1), foot%place(2), -foot%place(1)]
      over(2) = dot_product(arm, foot%tangent(:, 1))/sum(foot%tangent(:, 1)**2)
      over(3) = dot_product(arm, foot%tangent(:, 2))/sum(foot%tangent(:, 2)**2)
      over(1) = -over(3)
      over(4) = -over(2)
      over(:) = merge(over, 0.0_wp, towards >= at_side)
   end function beyond

   !> Whether a line through the point of a foot misses the surface beyond its border
   !>
   !> Under a dent that a plane of symmetry cuts, the normal of the facet leans out over the
   !> border: the point is beside the surface along that normal, but not along the plane.
   pure logical function is_missed(self, foot, direction)
      !> The surface
      class(surface_type), intent(in) :: self
      !> The foot
      type(closest_point_type), intent(in) :: foot
      !> Along the line, not along the facet
      real(wp), intent(in) :: direction(3)

      real(wp) :: arm(3)

      ! from the foot to where the line meets the plane of the facet
      arm(:) = foot%gap_vector - foot%gap/dot_product(direction, foot%normal)*direction
      is_missed = any(beyond(foot, arm) > side_tolerance &
         & .and. self%neighbour(:, foot%facet) == 0)
   end function is_missed

   !> Unit vector across two tangents
   pure function unit_normal(along_xi, along_eta) result(normal)
      !> Tangents, length
      real(wp), intent(in) :: along_xi(3), along_eta(3)
      real(wp) :: normal(3)

      normal(1) = along_xi(2)*along_eta(3) - along_xi(3)*along_eta(2)
      normal(2) = along_xi(3)*along_eta(1) - along_xi(1)*along_eta(3)
      normal(3) = along_xi(1)*along_eta(2) - along_xi(2)*along_eta(1)
      normal(:) = normal/sqrt(dot_product(normal, normal))
   end function unit_normal

end module plydyn_contact_search_surface
