!> Candidate list of the contact search (a Verlet list), and a bound on the approach of the bodies.
!>
!> The list holds every facet within the search distance of the impactor. It is rebuilt, with twice
!> that distance, when another facet comes within. A bound from the largest nodal displacement says
!> when all facets must be tested; in other steps the positions of listed points are enough. No gap
!> to a listed facet shrinks by more than the approach bound grows: a node with the gap g is due
!> again when the bound has grown by g.
module plydyn_contact_search_candidate_list
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_revolved_body, only : revolved_body_type
   use plydyn_contact_search_surface, only : surface_type
   use plydyn_fem_shape, only : bilinear_nodes
   implicit none
   private

   public :: distance_bound, new_candidate_list

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
      !> The surface without neighbours beyond the listed facets: the impactor cannot touch those
      type(surface_type) :: patch
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
      procedure :: save
      procedure :: restore
   end type candidate_list_type

contains

   !> Start with an empty list
   pure subroutine new_candidate_list(self, surface, body)
      !> The list
      type(candidate_list_type), intent(out) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> The impactor
      type(revolved_body_type), intent(in) :: body

      integer :: facets

      facets = size(surface%facet, 2)
      self%body = body
      self%search_distance = relative_search_distance*body%radius
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
      !> Centre of the impactor, length
      real(wp), intent(in) :: centre(3)

      self%slack = self%slack - (interpolation_bound*displacement + norm2(centre - self%centre))
      self%centre(:) = centre
      self%needs_all = self%slack < round_off*self%body%radius
   end subroutine update_slack

   !> Update list and approach bound after a step
   pure subroutine update(self, surface, position, centre, rebuilt)
      !> The list
      class(candidate_list_type), intent(inout) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Surface points, all of them if `needs_all`, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the impactor, length
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
         self%slack = min(self%slack, distance_bound(position(:, surface%facet(:, f)), centre, &
            & self%body) - self%body%rounding - self%search_distance)
      end do
   end subroutine reset_slack

   !> List every facet within twice the search distance
   pure subroutine rebuild(self, surface, position, centre)
      type(candidate_list_type), intent(inout) :: self
      type(surface_type), intent(in) :: surface
      !> All surface points and the centre of the impactor, length
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)

      integer :: f, i

      do f = 1, size(self%listed)
         self%listed(f) = distance_bound(position(:, surface%facet(:, f)), centre, self%body) &
            & < self%body%rounding + 2.0_wp*self%search_distance
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

   !> Lower bound on the distance from a core to a facet, length
   !>
   !> A facet lies within the convex hull of its control points in Bernstein's form. The bounding
   !> sphere of these points bounds the distance from below; so does their bounding box where the
   !> core is a point.
   pure real(wp) function distance_bound(node, centre, body) result(distance)
      !> Points of the facet, (3, 4 or 9), length
      real(wp), intent(in) :: node(:, :)
      !> Centre of the body, length
      real(wp), intent(in) :: centre(3)
      !> The body
      type(revolved_body_type), intent(in) :: body

      real(wp) :: control(3, size(node, 2)), middle(3), outside(3), hull_radius
      integer :: i

      control(:, :) = control_points(node)
      middle(:) = node(:, size(node, 2))
      hull_radius = 0.0_wp
      do i = 1, size(node, 2)
         hull_radius = max(hull_radius, norm2(control(:, i) - middle))
      end do
      distance = body%core_distance(centre - middle) - hull_radius
      if (size(body%corner, 2) > 1) return
      outside(:) = max(minval(control, 2) - centre, centre - maxval(control, 2), 0.0_wp)
      distance = max(norm2(outside), distance)
   end function distance_bound

   !> Bernstein control points of a facet
   pure function control_points(node) result(control)
      real(wp), intent(in) :: node(:, :)
      real(wp) :: control(3, size(node, 2))

      control(:, :) = node
      if (size(node, 2) == bilinear_nodes) return
      control(:, 5) = control_point(node(:, 1), node(:, 5), node(:, 2))
      control(:, 6) = control_point(node(:, 2), node(:, 6), node(:, 3))
      control(:, 7) = control_point(node(:, 3), node(:, 7), node(:, 4))
      control(:, 8) = control_point(node(:, 4), node(:, 8), node(:, 1))
      control(:, 9) = control_point(control(:, 5), &
         & control_point(node(:, 8), node(:, 9), node(:, 6)), control(:, 7))
   end function control_points

   !> Middle control point of the parabola through points at -1, 0 and 1
   pure function control_point(first, middle, last) result(control)
      real(wp), intent(in), dimension(3) :: first, middle, last
      real(wp) :: control(3)

      control(:) = 2.0_wp*middle - 0.5_wp*(first + last)
   end function control_point

end module plydyn_contact_search_candidate_list
