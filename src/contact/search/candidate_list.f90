!> Candidate list of the contact search (a Verlet list), and a bound on the approach of the bodies.
!>
!> The list holds every facet within the search distance of the impactor. It is rebuilt, with twice
!> that distance, when another facet comes within. A bound from the largest nodal displacement says
!> when all facets must be tested; in other steps the positions of listed points are enough. No gap
!> to a listed facet shrinks by more than the approach bound grows: a node with the gap g must be
!> projected again when the bound has grown by g. Search timers tell which nodes are due: these are
!> grouped, so that a group without a due node costs one comparison.
module plydyn_contact_search_candidate_list
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_revolved_body, only : revolved_body_type
   use plydyn_contact_solve_constraint, only : constraints_type
   use plydyn_contact_search_closest_point, only : distance_bound
   use plydyn_contact_search_surface, only : surface_type
   implicit none
   private

   public :: new_candidate_list, new_search_timers

   !> Search distance over the radius of the impactor
   real(wp), parameter :: relative_search_distance = 0.03125_wp

   !> Largest displacement within a facet over the largest of its nodes: the Lebesgue constant of
   !> biquadratic interpolation, 1.25 along either direction
   real(wp), parameter :: interpolation_bound = 1.5625_wp

   !> Round-off of distances over the radius of the impactor
   real(wp), parameter :: round_off = 1.0e-9_wp

   !> Facets near the impactor
   type, public :: candidate_list_type
      !> Every facet within this distance of the impactor is listed, length
      real(wp) :: search_distance = 0.0_wp
      !> Listed facets
      integer, allocatable :: facet(:)
      !> Points of the listed facets, each once
      integer, allocatable :: point(:)
      !> The surface, and the same without neighbours beyond the listed facets: the impactor cannot
      !> touch those
      type(surface_type) :: surface, patch
      !> How often the list has been rebuilt
      integer :: rebuilds = 0
      !> Whether the next update needs the positions of all points, or of those listed only
      logical :: needs_all = .true.
      !> Bound on the approach of impactor and listed facets since the start, length
      real(wp) :: approach_bound = 0.0_wp
      !> The impactor
      type(revolved_body_type), private :: body
      !> Which facets are listed
      logical, allocatable, private :: listed(:)
      !> Approach of impactor and unlisted facets after which one may come within the search
      !> distance; negative when unknown, length
      real(wp), private :: slack = -1.0_wp
      !> Centre at the last step, length
      real(wp), private :: centre(3) = 0.0_wp
      !> Listed points relative to the centre at the last step, (3, points), length
      real(wp), allocatable, private :: previous(:, :)
   contains
      procedure :: update_slack
      procedure :: update
      procedure :: add_correction
      procedure :: make_point_rows
      procedure :: save
      procedure :: restore
   end type candidate_list_type

   !> Nodes of a group
   integer, parameter :: group_size = 32

   !> Nodes that are due when the approach bound has reached a value of their own
   type, public :: search_timers_type
      !> Approach bound at which each node is due, length; huge for padding of the last group
      real(wp), allocatable :: due_at(:)
      !> Nodes that are due, in ascending order, in the first `count` entries
      integer, allocatable :: due(:)
      !> Number of due nodes
      integer :: count = 0
      !> Lower bound of `due_at` in each group, length
      real(wp), allocatable, private :: group_due_at(:)
   contains
      procedure :: enlarge
      procedure :: find_due
      procedure :: restart_groups
   end type search_timers_type

contains

   !> Start with an empty list
   pure subroutine new_candidate_list(self, surface, body)
      type(candidate_list_type), intent(out) :: self
      type(surface_type), intent(in) :: surface
      !> The impactor
      type(revolved_body_type), intent(in) :: body

      integer :: facets

      facets = size(surface%facet, 2)
      self%body = body
      self%search_distance = relative_search_distance*body%radius
      allocate (self%facet(0), self%point(0), self%previous(3, 0))
      allocate (self%listed(facets), source=.false.)
      self%surface = surface
      self%patch = surface
   end subroutine new_candidate_list

   !> Reduce the slack by the motion of a step without contact; decide if all points are needed
   pure subroutine update_slack(self, displacement, centre)
      class(candidate_list_type), intent(inout) :: self
      !> Bound on the displacement of surface points in the step, length
      real(wp), intent(in) :: displacement
      !> Centre of the impactor, length
      real(wp), intent(in) :: centre(3)

      self%slack = self%slack - (interpolation_bound*displacement + norm2(centre - self%centre))
      self%centre(:) = centre
      self%needs_all = self%slack < round_off*self%body%radius
   end subroutine update_slack

   !> Update list and approach bound after a step
   pure subroutine update(self, position, centre, rebuilt)
      class(candidate_list_type), intent(inout) :: self
      !> Surface points, all of them if `needs_all`, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the impactor, length
      real(wp), intent(in) :: centre(3)
      !> Whether the list is new: gaps of earlier steps are void
      logical, intent(out) :: rebuilt

      rebuilt = .false.
      if (self%needs_all) then
         call reset_slack(self, position, centre)
         rebuilt = self%slack < 0.0_wp
      end if
      if (rebuilt) then
         call rebuild(self, position, centre)
         call reset_slack(self, position, centre)
      else
         call add_approach(self, position, centre)
      end if
   end subroutine update

   !> Rows of the listed points inside the exact body
   pure subroutine make_point_rows(self, position, centre, rows)
      class(candidate_list_type), intent(in) :: self
      !> Trial positions of the surface points, (3, points), and of the centre, length
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)
      type(constraints_type), intent(inout) :: rows

      integer :: i, k
      real(wp) :: gap, normal(3)

      do i = 1, size(self%point)
         k = self%point(i)
         call self%body%find_gap(centre - position(:, k), gap, normal)
         if (gap >= 0.0_wp) cycle
         call rows%add(k, 0.0_wp)
         rows%point(1, rows%count) = k
         rows%weight(1, rows%count) = 1.0_wp
         rows%gap(rows%count) = gap
         rows%normal(:, rows%count) = normal
      end do
   end subroutine make_point_rows

   !> Reduce the slack by the contact correction of listed points
   pure subroutine add_correction(self, largest)
      class(candidate_list_type), intent(inout) :: self
      !> Largest correction, length
      real(wp), intent(in) :: largest

      self%slack = self%slack - interpolation_bound*largest
   end subroutine add_correction

   !> Distance of the nearest unlisted facet, less the search distance
   pure subroutine reset_slack(self, position, centre)
      type(candidate_list_type), intent(inout) :: self
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)

      integer :: f

      self%slack = huge(1.0_wp)
      do f = 1, size(self%listed)
         if (self%listed(f)) cycle
         self%slack = min(self%slack, distance_bound(position(:, self%surface%facet(:, f)), &
            & centre, self%body) - self%body%rounding - self%search_distance)
      end do
   end subroutine reset_slack

   !> List every facet within twice the search distance
   pure subroutine rebuild(self, position, centre)
      type(candidate_list_type), intent(inout) :: self
      !> All surface points and the centre of the impactor, length
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)

      integer :: f, i

      do f = 1, size(self%listed)
         self%listed(f) = distance_bound(position(:, self%surface%facet(:, f)), centre, &
            & self%body) < self%body%rounding + 2.0_wp*self%search_distance
      end do
      call list_points(self)
      do i = 1, size(self%point)
         self%previous(:, i) = position(:, self%point(i)) - centre
      end do
   end subroutine rebuild

   !> List the facets that are marked, and their points
   pure subroutine list_points(self)
      type(candidate_list_type), intent(inout) :: self

      integer :: f, i
      logical, allocatable :: used(:)

      self%rebuilds = self%rebuilds + 1
      self%facet = pack([(f, f=1, size(self%listed))], self%listed)
      allocate (used(maxval(self%surface%facet)), source=.false.)
      do f = 1, size(self%facet)
         used(self%surface%facet(:, self%facet(f))) = .true.
      end do
      self%point = pack([(i, i=1, size(used))], used)
      deallocate (self%previous)
      allocate (self%previous(3, size(self%point)))
      self%patch%neighbour(:, :) = self%surface%neighbour
      do f = 1, size(self%listed)
         do i = 1, size(self%surface%neighbour, 1)
            if (self%surface%neighbour(i, f) == 0) cycle
            if (.not. self%listed(self%surface%neighbour(i, f))) self%patch%neighbour(i, f) = 0
         end do
      end do
   end subroutine list_points

   !> Append the list, the approach bound and the positions for a restart
   pure subroutine save(self, integers, reals)
      class(candidate_list_type), intent(in) :: self
      !> Number of listed facets, and the facets
      integer, allocatable, intent(inout) :: integers(:)
      !> Approach bound, and positions of the last step
      real(wp), allocatable, intent(inout) :: reals(:)

      integers = [integers, size(self%facet), self%facet]
      reals = [reals, self%approach_bound, reshape(self%previous, [size(self%previous)])]
   end subroutine save

   !> Restore what `save` appended
   pure subroutine restore(self, integers, reals, used)
      class(candidate_list_type), intent(inout) :: self
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
      call list_points(self)
      if (size(reals) < 1 + size(self%previous)) return
      self%approach_bound = reals(1)
      self%previous(:, :) = reshape(reals(2:size(self%previous) + 1), shape(self%previous))
      used(:) = [count, size(self%previous)] + 1
   end subroutine restore

   !> Add the largest displacement of a listed point relative to the impactor in the step
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

   !> Timers of nodes that are all due
   pure subroutine new_search_timers(self, nodes)
      type(search_timers_type), intent(out) :: self
      !> Number of nodes
      integer, intent(in) :: nodes

      allocate (self%group_due_at((nodes + group_size - 1)/group_size), source=0.0_wp)
      allocate (self%due_at(group_size*size(self%group_due_at)), source=huge(1.0_wp))
      allocate (self%due(size(self%due_at) + 1), source=0)
      self%due_at(:nodes) = 0.0_wp
   end subroutine new_search_timers

   !> Add nodes, all of them due
   pure subroutine enlarge(self, before, nodes)
      class(search_timers_type), intent(inout) :: self
      !> Number of nodes so far, and with the new ones
      integer, intent(in) :: before, nodes

      type(search_timers_type) :: larger

      call new_search_timers(larger, nodes)
      larger%due_at(:before) = self%due_at(:before)
      call move_alloc(larger%due_at, self%due_at)
      call move_alloc(larger%due, self%due)
      call move_alloc(larger%group_due_at, self%group_due_at)
   end subroutine enlarge

   !> Void the bounds of the groups: nodes may be due earlier than before
   pure subroutine restart_groups(self)
      class(search_timers_type), intent(inout) :: self

      self%group_due_at(:) = 0.0_wp
   end subroutine restart_groups

   !> Find the nodes that are due
   pure subroutine find_due(self, approach_bound)
      class(search_timers_type), intent(inout) :: self
      !> Approach bound of impactor and surface, length
      real(wp), intent(in) :: approach_bound

      integer :: before, count, g, i
      real(wp) :: bound, least

      ! nodes that fill the last group are never due, whatever the motion
      bound = min(approach_bound, 0.5_wp*huge(1.0_wp))
      count = 0
      do g = 1, size(self%group_due_at)
         if (self%group_due_at(g) > bound) cycle
         before = group_size*(g - 1)
         least = huge(1.0_wp)
         !$omp simd reduction(min:least)
         do i = 1, group_size
            least = merge(self%due_at(before + i), least, self%due_at(before + i) < least)
         end do
         self%group_due_at(g) = least
         if (least > bound) cycle
         do i = 1, group_size
            self%due(count + 1) = before + i
            count = count + merge(1, 0, self%due_at(before + i) <= bound)
         end do
      end do
      self%count = count
   end subroutine find_due

end module plydyn_contact_search_candidate_list
