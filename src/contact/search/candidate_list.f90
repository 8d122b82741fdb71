!> The part of the surface near the sphere, and how far both have moved towards each other.
!>
!> Detection is exact and cheap. A list holds every facet within `reach` of the sphere; it is
!> rebuilt, with twice that reach, only when a facet outside comes within. All facets are looked at
!> only when one of those outside can have come so far, as the fastest point tells (`approach`);
!> in other steps the positions of listed points are enough. `travel` grows at every step by more
!> than the gap of any contact node to the listed facets can have changed. So a node whose gap is g
!> need not be looked at again before the travel has grown by g.
module plydyn_contact_search_candidate_list
   use plydyn_base_precision, only : wp
   use plydyn_contact_search_hull, only : distance_bound
   use plydyn_contact_search_surface, only : surface_type
   implicit none
   private

   public :: new_candidate_list

   !> Reach as a share of the sphere's radius
   real(wp), parameter :: reach_share = 0.03125_wp

   !> A point of a facet moves at most this much more than the farthest moving of its nodes: sum of
   !> the magnitudes of the biquadratic shape functions, 1.25 along either direction
   real(wp), parameter :: largest_share = 1.5625_wp

   !> Share of the sphere's radius that is room for round-off in distances
   real(wp), parameter :: round_off = 1.0e-9_wp

   !> Facets near the sphere
   type, public :: candidate_list_type
      !> Every facet at most this far from the sphere is listed, length
      real(wp) :: reach = 0.0_wp
      !> Listed facets
      integer, allocatable :: facet(:)
      !> Points of the listed facets, each once
      integer, allocatable :: point(:)
      !> The surface with no neighbours beyond the listed facets: the sphere is out of reach there
      type(surface_type) :: patch
      !> How often the list has been renewed
      integer :: rebuilds = 0
      !> Whether the next update needs the positions of all points, or of those listed only
      logical :: needs_all = .true.
      !> Bound on the approach of sphere and listed facets since the start, length
      real(wp) :: travel = 0.0_wp
      !> Radius of the sphere, length
      real(wp), private :: radius = 0.0_wp
      !> Which facets are listed
      logical, allocatable, private :: listed(:)
      !> What facets that are not listed, and the sphere, can approach each other before one of them
      !> must be: less than nothing where that is not known, length
      real(wp), private :: slack = -1.0_wp
      !> Centre at the last step, length
      real(wp), private :: centre(3) = 0.0_wp
      !> Listed points relative to the centre at the last step, (3, points), length
      real(wp), allocatable, private :: seen(:, :)
   contains
      procedure :: approach
      procedure :: update
      procedure :: shift
      procedure :: remember
      procedure :: recall
   end type candidate_list_type

contains

   !> Start with an empty list
   pure subroutine new_candidate_list(self, surface, radius)
      !> The list
      type(candidate_list_type), intent(out) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Radius of the sphere, length
      real(wp), intent(in) :: radius

      integer :: facets

      facets = size(surface%facet, 2)
      self%radius = radius
      self%reach = reach_share*radius
      allocate (self%facet(0), self%point(0), self%seen(3, 0))
      allocate (self%listed(facets), source=.false.)
      self%patch = surface
   end subroutine new_candidate_list

   !> Sphere and surface move without contact: can a facet that is not listed come within reach?
   pure subroutine approach(self, move, centre)
      !> The list
      class(candidate_list_type), intent(inout) :: self
      !> Most that a point of the surface has moved in the step, length
      real(wp), intent(in) :: move
      !> Centre of the sphere, length
      real(wp), intent(in) :: centre(3)

      self%slack = self%slack - (largest_share*move + norm2(centre - self%centre))
      self%centre(:) = centre
      self%needs_all = self%slack < round_off*self%radius
   end subroutine approach

   !> Follow the motion by a step
   pure subroutine update(self, surface, position, centre, rebuilt)
      !> The list
      class(candidate_list_type), intent(inout) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Surface points, all of them if `needs_all`, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the sphere, length
      real(wp), intent(in) :: centre(3)
      !> The list is new: what was known of gaps is void
      logical, intent(out) :: rebuilt

      rebuilt = .false.
      if (self%needs_all) then
         call find_slack(self, surface, position, centre)
         rebuilt = self%slack < 0.0_wp
      end if
      if (rebuilt) then
         call rebuild(self, surface, position, centre)
         call find_slack(self, surface, position, centre)
      else
         call add_travel(self, position, centre)
      end if
   end subroutine update

   !> Listed points have been pushed besides
   pure subroutine shift(self, farthest)
      !> The list
      class(candidate_list_type), intent(inout) :: self
      !> At most so far, length
      real(wp), intent(in) :: farthest

      self%slack = self%slack - largest_share*farthest
   end subroutine shift

   !> How far the nearest facet that is not listed is from having to be
   pure subroutine find_slack(self, surface, position, centre)
      !> The list
      type(candidate_list_type), intent(inout) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Surface points, length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the sphere, length
      real(wp), intent(in) :: centre(3)

      integer :: f

      self%slack = huge(1.0_wp)
      do f = 1, size(self%listed)
         if (self%listed(f)) cycle
         self%slack = min(self%slack, distance_bound(position(:, surface%facet(:, f)), centre) &
            & - self%radius - self%reach)
      end do
   end subroutine find_slack

   !> List every facet within twice the reach
   pure subroutine rebuild(self, surface, position, centre)
      !> The list
      type(candidate_list_type), intent(inout) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Surface points, length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the sphere, length
      real(wp), intent(in) :: centre(3)

      integer :: f, i

      do f = 1, size(self%listed)
         self%listed(f) = distance_bound(position(:, surface%facet(:, f)), centre) &
            & < self%radius + 2.0_wp*self%reach
      end do
      call list_points(self, surface)
      do i = 1, size(self%point)
         self%seen(:, i) = position(:, self%point(i)) - centre
      end do
   end subroutine rebuild

   !> List the facets that are marked, and their points
   pure subroutine list_points(self, surface)
      !> The list
      type(candidate_list_type), intent(inout) :: self
      !> The surface
      type(surface_type), intent(in) :: surface

      integer :: f, i
      logical, allocatable :: used(:)

      self%rebuilds = self%rebuilds + 1
      self%facet = pack([(f, f=1, size(self%listed))], self%listed)
      allocate (used(maxval(surface%facet)), source=.false.)
      do f = 1, size(self%facet)
         used(surface%facet(:, self%facet(f))) = .true.
      end do
      self%point = pack([(i, i=1, size(used))], used)
      deallocate (self%seen)
      allocate (self%seen(3, size(self%point)))
      self%patch%neighbour(:, :) = surface%neighbour
      do f = 1, size(self%listed)
         do i = 1, size(surface%neighbour, 1)
            if (surface%neighbour(i, f) == 0) cycle
            if (.not. self%listed(surface%neighbour(i, f))) self%patch%neighbour(i, f) = 0
         end do
      end do
   end subroutine list_points

   !> Append what is remembered from step to step
   pure subroutine remember(self, places, numbers)
      !> The list
      class(candidate_list_type), intent(in) :: self
      !> How many facets are listed, and which
      integer, allocatable, intent(inout) :: places(:)
      !> Travel and positions seen
      real(wp), allocatable, intent(inout) :: numbers(:)

      places = [places, size(self%facet), self%facet]
      numbers = [numbers, self%travel, reshape(self%seen, [size(self%seen)])]
   end subroutine remember

   !> Take back what `remember` gave
   pure subroutine recall(self, surface, places, numbers, used)
      !> The list
      class(candidate_list_type), intent(inout) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> As from `remember`, with more behind it
      integer, intent(in) :: places(:)
      real(wp), intent(in) :: numbers(:)
      !> How many places and numbers were for this list; negative when they do not fit it
      integer, intent(out) :: used(2)

      integer :: count

      used(:) = -1
      if (size(places) == 0) return
      count = places(1)
      if (count < 0 .or. count > size(places) - 1) return
      if (any(places(2:count + 1) < 1 .or. places(2:count + 1) > size(self%listed))) return
      self%listed(:) = .false.
      self%listed(places(2:count + 1)) = .true.
      call list_points(self, surface)
      if (size(numbers) < 1 + size(self%seen)) return
      self%travel = numbers(1)
      self%seen(:, :) = reshape(numbers(2:size(self%seen) + 1), shape(self%seen))
      used(:) = [count, size(self%seen)] + 1
   end subroutine recall

   !> Add the largest move of a listed point relative to the sphere since the last step
   pure subroutine add_travel(self, position, centre)
      !> The list
      type(candidate_list_type), intent(inout) :: self
      !> Surface points, length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the sphere, length
      real(wp), intent(in) :: centre(3)

      integer :: i
      real(wp) :: farthest, x, y, z

      farthest = 0.0_wp
      !$omp simd private(x, y, z) reduction(max:farthest)
      do i = 1, size(self%point)
         x = position(1, self%point(i)) - centre(1)
         y = position(2, self%point(i)) - centre(2)
         z = position(3, self%point(i)) - centre(3)
         farthest = max(farthest, (x - self%seen(1, i))**2 + (y - self%seen(2, i))**2 &
            & + (z - self%seen(3, i))**2)
         self%seen(1, i) = x
         self%seen(2, i) = y
         self%seen(3, i) = z
      end do
      self%travel = self%travel + largest_share*sqrt(farthest)
   end subroutine add_travel

end module plydyn_contact_search_candidate_list
