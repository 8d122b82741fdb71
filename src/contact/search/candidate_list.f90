!> Candidate list of the contact search (a Verlet list), and a bound on the approach of the bodies.
!>
!> The list holds every facet within the search distance of the sphere. It is rebuilt, with twice
!> that distance, when another facet comes within. A bound from the largest nodal displacement says
!> when all facets must be tested; in other steps the positions of listed points are enough. No gap
!> to a listed facet shrinks by more than the approach bound grows: a node with the gap g is due
!> again when the bound has grown by g.
module plydyn_contact_search_candidate_list
   use plydyn_base_precision, only : wp
   use plydyn_contact_search_hull, only : distance_bound
   use plydyn_contact_search_surface, only : surface_type
   implicit none
   private

   public :: new_candidate_list

   !> Search distance over the radius of the sphere
   real(wp), parameter :: relative_search_distance = 0.03125_wp

   !> Largest displacement within a facet over the largest of its nodes: the Lebesgue constant of
   !> biquadratic interpolation, 1.25 along either direction
   real(wp), parameter :: interpolation_bound = 1.5625_wp

   !> Round-off of distances over the radius of the sphere
   real(wp), parameter :: round_off = 1.0e-9_wp

   !> Facets near the sphere
   type, public :: candidate_list_type
      !> Every facet within this distance of the sphere is listed, length
      real(wp) :: search_distance = 0.0_wp
      !> Listed facets
      integer, allocatable :: facet(:)
      !> Points of the listed facets, each once
      integer, allocatable :: point(:)
      !> The surface without neighbours beyond the listed facets: the sphere cannot touch those
      type(surface_type) :: patch
      !> How often the list has been rebuilt
      integer :: rebuilds = 0
      !> Whether the next update needs the positions of all points, or of those listed only
      logical :: needs_all = .true.
      !> Bound on the approach of sphere and listed facets since the start, length
      real(wp) :: approach_bound = 0.0_wp
      !> Radius of the sphere, length
      real(wp), private :: radius = 0.0_wp
      !> Which facets are listed
      logical, allocatable, private :: listed(:)
      !> Approach of sphere and unlisted facets after which one may come within the search distance;
      !> negative when unknown, length
      real(wp), private :: slack = -1.0_wp
      !> Centre at the last step, length
      real(wp), private :: centre(3) = 0.0_wp
      !> Listed points relative to the centre at the last step, (3, points), length
      real(wp), allocatable, private :: previous(:, :)
   contains
      procedure :: update_slack
      procedure :: update
      procedure :: add_correction
      procedure :: save
      procedure :: restore
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
      self%search_distance = relative_search_distance*radius
      allocate (self%facet(0), self%point(0), self%previous(3, 0))
      allocate (self%listed(facets), source=.false.)
      self%patch = surface
   end subroutine new_candidate_list

   !> Reduce the slack by the motion of a step without contact; decide if all points are needed
   pure subroutine update_slack(self, displacement, centre)
      !> The list
      class(candidate_list_type), intent(inout) :: self
      !> Bound on the displacement of surface points in the step, length
      real(wp), intent(in) :: displacement
      !> Centre of the sphere, length
      real(wp), intent(in) :: centre(3)

      self%slack = self%slack - (interpolation_bound*displacement + norm2(centre - self%centre))
      self%centre(:) = centre
      self%needs_all = self%slack < round_off*self%radius
   end subroutine update_slack

   !> Update list and approach bound after a step
   pure subroutine update(self, surface, position, centre, rebuilt)
      !> The list
      class(candidate_list_type), intent(inout) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Surface points, all of them if `needs_all`, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the sphere, length
      real(wp), intent(in) :: centre(3)
      !> Whether the list is new: gaps of earlier steps are void
      logical, intent(out) :: rebuilt

      rebuilt = .false.
      if (self%needs_all) then
         call reset_slack(self, surface, position, centre)
         rebuilt = self%slack < 0.0_wp
      end if
      if (rebuilt) then
         call rebuild(self, surface, position, centre)
         call reset_slack(self, surface, position, centre)
      else
         call add_approach(self, position, centre)
      end if
   end subroutine update

   !> Reduce the slack by the contact correction of listed points
   pure subroutine add_correction(self, largest)
      !> The list
      class(candidate_list_type), intent(inout) :: self
      !> Largest correction, length
      real(wp), intent(in) :: largest

      self%slack = self%slack - interpolation_bound*largest
   end subroutine add_correction

   !> Distance of the nearest unlisted facet, less the search distance
   pure subroutine reset_slack(self, surface, position, centre)
      type(candidate_list_type), intent(inout) :: self
      type(surface_type), intent(in) :: surface
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)

      integer :: f

      self%slack = huge(1.0_wp)
      do f = 1, size(self%listed)
         if (self%listed(f)) cycle
         self%slack = min(self%slack, distance_bound(position(:, surface%facet(:, f)), centre) &
            & - self%radius - self%search_distance)
      end do
   end subroutine reset_slack

   !> List every facet within twice the search distance
   pure subroutine rebuild(self, surface, position, centre)
      type(candidate_list_type), intent(inout) :: self
      type(surface_type), intent(in) :: surface
      !> All surface points and the centre of the sphere, length
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)

      integer :: f, i

      do f = 1, size(self%listed)
         self%listed(f) = distance_bound(position(:, surface%facet(:, f)), centre) &
            & < self%radius + 2.0_wp*self%search_distance
      end do
      call list_points(self, surface)
      do i = 1, size(self%point)
         self%previous(:, i) = position(:, self%point(i)) - centre
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
      deallocate (self%previous)
      allocate (self%previous(3, size(self%point)))
      self%patch%neighbour(:, :) = surface%neighbour
      do f = 1, size(self%listed)
         do i = 1, size(surface%neighbour, 1)
            if (surface%neighbour(i, f) == 0) cycle
            if (.not. self%listed(surface%neighbour(i, f))) self%patch%neighbour(i, f) = 0
         end do
      end do
   end subroutine list_points

   !> Append the list, the approach bound and the positions for a restart
   pure subroutine save(self, integers, reals)
      !> The list
      class(candidate_list_type), intent(in) :: self
      !> Number of listed facets, and the facets
      integer, allocatable, intent(inout) :: integers(:)
      !> Approach bound, and positions of the last step
      real(wp), allocatable, intent(inout) :: reals(:)

      integers = [integers, size(self%facet), self%facet]
      reals = [reals, self%approach_bound, reshape(self%previous, [size(self%previous)])]
   end subroutine save

   !> Restore what `save` appended
   pure subroutine restore(self, surface, integers, reals, used)
      !> The list
      class(candidate_list_type), intent(inout) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> As from `save`, followed by data of others
      integer, intent(in) :: integers(:)
      real(wp), intent(in) :: reals(:)
      !> Number of integers and reals that belong to this list; negative when they do not fit
      integer, intent(out) :: used(2)

      integer :: count

      used(:) = -1
      if (size(integers) == 0) return
      count = integers(1)
      if (count < 0 .or. count > size(integers) - 1) return
      if (any(integers(2:count + 1) < 1 .or. integers(2:count + 1) > size(self%listed))) return
      self%listed(:) = .false.
      self%listed(integers(2:count + 1)) = .true.
      call list_points(self, surface)
      if (size(reals) < 1 + size(self%previous)) return
      self%approach_bound = reals(1)
      self%previous(:, :) = reshape(reals(2:size(self%previous) + 1), shape(self%previous))
      used(:) = [count, size(self%previous)] + 1
   end subroutine restore

   !> Add the largest displacement of a listed point relative to the sphere in the step
   pure subroutine add_approach(self, position, centre)
      type(candidate_list_type), intent(inout) :: self
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)

      integer :: i
      real(wp) :: largest, x, y, z

      largest = 0.0_wp
      !$omp simd private(x, y, z) reduction(max:largest)
      do i = 1, size(self%point)
         x = position(1, self%point(i)) - centre(1)
         y = position(2, self%point(i)) - centre(2)
         z = position(3, self%point(i)) - centre(3)
         largest = max(largest, (x - self%previous(1, i))**2 + (y - self%previous(2, i))**2 &
            & + (z - self%previous(3, i))**2)
         self%previous(1, i) = x
         self%previous(2, i) = y
         self%previous(3, i) = z
      end do
      self%approach_bound = self%approach_bound + interpolation_bound*sqrt(largest)
   end subroutine add_approach

end module plydyn_contact_search_candidate_list
