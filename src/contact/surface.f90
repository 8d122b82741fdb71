!> A face of the plate as facets, and the closest point on it.
!>
!> A facet is a quad of surface points, counter-clockwise from above on both faces. The closest
!> point is found by Newton's method with second derivatives inside one facet and by walking to
!> the neighbour when the point lies beyond a side. The surface is taken to be locally a graph:
!> the walk ends in the facet under the point, as it does for anything but a folded plate.
module plydyn_contact_surface
   use plydyn_base_precision, only : wp
   use plydyn_contact_facet, only : facet_polynomial, frame_at, frame_eta, frame_eta_eta, &
      & frame_size, frame_value, frame_xi, frame_xi_eta, frame_xi_xi, wide
   use plydyn_contact_neighbours, only : find_neighbours, sides
   implicit none
   private

   public :: new_surface

   !> Steps of Newton's method in one facet, and facets walked through, before giving up
   integer, parameter :: most_steps = 30, most_walks = 100

   !> A step this small, in local coordinates, is the last: the error after it is its square, and
   !> that of the gap the square of this
   real(wp), parameter :: last_step = 1.0e-4_wp

   !> Local coordinate from which a place is on a side
   real(wp), parameter :: at_side = 1.0_wp - 1.0e-12_wp

   !> Distance beyond a side that counts as beyond, relative to the size of the facet
   real(wp), parameter :: side_tolerance = 1.0e-10_wp

   !> Share of the distance that a walk must gain to go on
   real(wp), parameter :: least_gain = 1.0e-12_wp

   !> Growth of a squared distance that may be round-off
   real(wp), parameter :: round_off = 1.0e-14_wp

   !> Share of the product of the tangents' squares that a regular determinant exceeds
   real(wp), parameter :: regular = 1.0e-6_wp

   !> Facets of one face of the plate
   type, public :: surface_type
      !> Points of a facet, 4 or 9
      integer :: nodes = 0
      !> Points of each facet, (nodes, facets), indices into the surface points
      integer, allocatable :: facet(:, :)
      !> Facet beyond each side, (4, facets), 0 at the border
      integer, allocatable :: neighbour(:, :)
      !> Distance from the last point of each facet to the others at the start, length
      real(wp), allocatable :: radius(:)
      !> 1 when the outward normal of the plate is that of the facets (top), -1 when opposite
      real(wp) :: side = 1.0_wp
   contains
      procedure :: start_near
      procedure :: project
   end type surface_type

   !> Foot of the perpendicular from a point to the surface
   type, public :: foot_type
      !> Facet on which it lies
      integer :: facet = 0
      !> Place in the facet, each from -1 to 1
      real(wp) :: place(2) = 0.0_wp
      !> From the surface to the point, length
      real(wp) :: gap_vector(3) = 0.0_wp
      !> Unit normal of the facet there, outward of the plate
      real(wp) :: normal(3) = 0.0_wp
      !> Distance along the normal, negative when the point penetrates
      real(wp) :: gap = huge(1.0_wp)
      !> The point lies beyond the border of the surface: nothing is under it
      logical :: beside = .false.
   end type foot_type

contains

   !> Build the surface from its facets
   subroutine new_surface(self, facet, position, side)
      !> The surface
      type(surface_type), intent(out) :: self
      !> Points of each facet, (4 or 9, facets)
      integer, intent(in) :: facet(:, :)
      !> Surface points at the start, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> 1 for the top face of the plate, -1 for the bottom face
      integer, intent(in) :: side

      integer :: f, i
      real(wp) :: arm(3)

      self%nodes = size(facet, 1)
      self%side = real(side, wp)
      self%facet = facet
      allocate (self%radius(size(facet, 2)), source=0.0_wp)
      do f = 1, size(facet, 2)
         do i = 1, self%nodes - 1
            arm(:) = position(:, facet(i, f)) - position(:, facet(self%nodes, f))
            self%radius(f) = max(self%radius(f), norm2(arm))
         end do
      end do
      call find_neighbours(facet, size(position, 2), self%neighbour)
   end subroutine new_surface

   !> Start of a projection: the facet whose last point is nearest
   pure function start_near(self, position, point, facets) result(foot)
      !> The surface
      class(surface_type), intent(in) :: self
      !> Surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Any point, length
      real(wp), intent(in) :: point(3)
      !> Facets to look at
      integer, intent(in) :: facets(:)
      type(foot_type) :: foot

      integer :: i
      real(wp) :: arm(3), least

      least = huge(1.0_wp)
      do i = 1, size(facets)
         arm(:) = position(:, self%facet(self%nodes, facets(i))) - point
         if (sum(arm**2) >= least) cycle
         least = sum(arm**2)
         foot%facet = facets(i)
      end do
   end function start_near

   !> Closest point of the surface, starting from the facet and place in `foot`
   pure subroutine project(self, position, point, foot)
      !> The surface
      class(surface_type), intent(in) :: self
      !> Surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Any point, length
      real(wp), intent(in) :: point(3)
      !> Start in, foot out
      type(foot_type), intent(inout) :: foot

      type(foot_type) :: trial
      integer :: side, walk
      real(wp) :: distance, least

      trial = foot
      least = huge(1.0_wp)
      do walk = 1, most_walks
         call descend(self, position, point, trial, side)
         distance = sqrt(dot_product(trial%gap_vector, trial%gap_vector))
         if (distance > (1.0_wp - least_gain)*least) return
         foot = trial
         if (side == 0) return
         least = distance
         call cross(self, side, trial)
      end do
   end subroutine project

   !> Start in the neighbour, at the same point of the common side
   pure subroutine cross(self, side, foot)
      !> The surface
      type(surface_type), intent(in) :: self
      !> Side of the facet that is left
      integer, intent(in) :: side
      !> On a facet in, on its neighbour out
      type(foot_type), intent(inout) :: foot

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

   !> Closest point of one facet, and the side over which the point lies
   pure subroutine descend(self, position, point, foot, side)
      !> The surface
      type(surface_type), intent(in) :: self
      !> Surface points, length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Any point, length
      real(wp), intent(in) :: point(3)
      !> Facet and start in, foot out
      type(foot_type), intent(inout) :: foot
      !> Side with a neighbour beyond which the point lies, 0 for none
      integer, intent(out) :: side

      real(wp) :: frame(wide, frame_size), last, polynomial(wide, 0:2, 0:2), squared, step(2)
      integer :: iteration

      call see_facet(self, position, point, foot%facet, polynomial)
      last = 0.5_wp*huge(1.0_wp)
      step(:) = 1.0_wp
      do iteration = 1, most_steps
         call frame_at(polynomial, foot%place, frame)
         foot%gap_vector(:) = -frame(:3, frame_value)
         if (maxval(abs(step)) <= last_step .or. iteration == most_steps) exit
         squared = dot_product(foot%gap_vector, foot%gap_vector)
         if (squared > (1.0_wp + round_off)*last) then
            ! too far: go half of the way back
            step(:) = 0.5_wp*step
            foot%place(:) = foot%place - step
         else
            last = squared
            step(:) = newton_step(frame, foot%gap_vector, foot%place)
            foot%place(:) = foot%place + step
         end if
      end do
      call finish_foot(self, frame, foot, side)
   end subroutine descend

   !> A facet as a polynomial, seen from a point
   pure subroutine see_facet(self, position, point, facet, polynomial)
      !> The surface
      type(surface_type), intent(in) :: self
      !> Surface points, length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Any point, length
      real(wp), intent(in) :: point(3)
      !> Which facet
      integer, intent(in) :: facet
      !> The facet relative to the point
      real(wp), intent(out) :: polynomial(wide, 0:2, 0:2)

      real(wp) :: x(wide, self%nodes)
      integer :: i

      do i = 1, self%nodes
         x(:3, i) = position(:, self%facet(i, facet)) - point
         x(wide, i) = 0.0_wp
      end do
      call facet_polynomial(self%nodes, x, polynomial)
   end subroutine see_facet

   !> Newton step towards the closest point, kept inside the facet
   pure function newton_step(frame, gap_vector, place) result(step)
      !> The facet at the place
      real(wp), intent(in) :: frame(wide, frame_size)
      !> From there to the point, length
      real(wp), intent(in) :: gap_vector(3)
      !> Place in the facet
      real(wp), intent(in) :: place(2)
      real(wp) :: step(2)

      real(wp) :: along_gap(frame_size), curve(3), determinant, metric(3)

      along_gap(:) = frame(1, :)*gap_vector(1) + frame(2, :)*gap_vector(2) &
         & + frame(3, :)*gap_vector(3)
      metric(1) = dot_product(frame(:3, frame_xi), frame(:3, frame_xi))
      metric(2) = dot_product(frame(:3, frame_eta), frame(:3, frame_eta))
      metric(3) = dot_product(frame(:3, frame_xi), frame(:3, frame_eta))
      curve(:) = metric - along_gap(frame_xi_xi:frame_xi_eta)
      determinant = curve(1)*curve(2) - curve(3)**2
      if (any(curve(:2) < regular*metric(:2)) .or. determinant < regular*metric(1)*metric(2)) then
         ! not convex here: Gauss-Newton
         curve(:) = metric
         determinant = curve(1)*curve(2) - curve(3)**2
      end if
      associate (slope => along_gap(frame_xi:frame_eta))
         step(1) = (curve(2)*slope(1) - curve(3)*slope(2))/determinant
         step(2) = (curve(1)*slope(2) - curve(3)*slope(1))/determinant
         call keep_inside(place, slope, curve, step)
      end associate
   end function newton_step

   !> Cut a step at the side that it crosses first, and go on along that side
   pure subroutine keep_inside(place, slope, curve, step)
      !> Place in the facet
      real(wp), intent(in) :: place(2)
      !> Slope of the squared distance there, downhill
      real(wp), intent(in) :: slope(2)
      !> Its second derivatives
      real(wp), intent(in) :: curve(3)
      !> Newton step, free in, inside out
      real(wp), intent(inout) :: step(2)

      real(wp) :: room(2)
      integer :: first, other

      room(:) = max(0.0_wp, merge(1.0_wp - place, 1.0_wp + place, step > 0.0_wp))
      if (all(abs(step) <= room)) return
      first = merge(1, 2, room(1)*abs(step(2)) <= room(2)*abs(step(1)))
      other = 3 - first
      step(first) = sign(room(first), step(first))
      step(other) = (slope(other) - curve(3)*step(first))/curve(other)
      step(other) = max(-1.0_wp - place(other), min(1.0_wp - place(other), step(other)))
   end subroutine keep_inside

   !> Normal and gap at the closest point, and the side over which the point lies
   pure subroutine finish_foot(self, frame, foot, side)
      !> The surface
      type(surface_type), intent(in) :: self
      !> The facet at the foot
      real(wp), intent(in) :: frame(wide, frame_size)
      !> Facet, place and gap vector in, all out
      type(foot_type), intent(inout) :: foot
      !> Side with a neighbour beyond which the point lies, 0 for none
      integer, intent(out) :: side

      real(wp) :: over(sides), towards(sides)
      integer :: s

      foot%normal(:) = self%side*unit_normal(frame(:3, frame_xi), frame(:3, frame_eta))
      foot%gap = dot_product(foot%gap_vector, foot%normal)
      foot%beside = .false.
      side = 0
      towards(:) = [-foot%place(2), foot%place(1), foot%place(2), -foot%place(1)]
      if (all(towards < at_side)) return

      ! how far beyond each side the point lies, in local coordinates
      over(2) = dot_product(foot%gap_vector, frame(:3, frame_xi))/sum(frame(:3, frame_xi)**2)
      over(3) = dot_product(foot%gap_vector, frame(:3, frame_eta))/sum(frame(:3, frame_eta)**2)
      over(1) = -over(3)
      over(4) = -over(2)
      over(:) = merge(over, 0.0_wp, towards >= at_side)
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

end module plydyn_contact_surface
