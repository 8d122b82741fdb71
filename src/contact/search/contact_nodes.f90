!> Contact nodes on the impactor: positions, closest points on the facets, and search timers.
!>
!> A node above the surface by g is projected again when the approach bound of the candidate list
!> has grown by g. A node below the surface makes a row in every step. Nodes high above the lowest
!> point of the impactor are made when the plate comes up to them.
module plydyn_contact_search_contact_nodes
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : lanes, wp
   use plydyn_base_text, only : text
   use plydyn_contact_solve_constraint, only : constraints_type, correction_type, gap_change
   use plydyn_contact_search_candidate_list, only : candidate_list_type, new_search_timers, &
      & search_timers_type
   use plydyn_contact_bodies_body_nodes, only : append_nodes, count_nodes, first_range, &
      & largest_spacing, node_range_type
   use plydyn_contact_bodies_revolved_body, only : revolved_body_type
   use plydyn_contact_search_facet_row, only : set_row
   use plydyn_contact_search_surface, only : closest_point_type, surface_type
   implicit none
   private

   public :: new_nodes

   !> Factor by which the height up to which there are nodes grows, and the share of it that the
   !> plate reaches at most
   real(wp), parameter :: height_growth = 2.0_wp, filled_share = 0.75_wp

   !> Cosine of the largest angle, 60 degrees, between facet and body: larger ones are folded over
   real(wp), parameter :: least_facing_cosine = 0.5_wp

   !> How often nodes are added at most: up to a thousand radii
   integer, parameter :: most_growths = 13

   !> Most contact nodes on an impactor at the start, and most rings of them in all
   integer, parameter :: most_nodes = 1000000

   !> Contact nodes with their search data and multipliers of the last step
   type, public :: node_set_type
      !> Positions relative to the centre, (3, nodes), ring after ring from the tip, length
      real(wp), allocatable :: position(:, :)
      !> Outward unit normals, (3, nodes)
      real(wp), allocatable, private :: outward(:, :)
      !> Multiplier times the step squared, mass times length
      real(wp), allocatable :: multiplier(:)
      !> Facet below each node; negative where the node is outside the free edge or the candidates;
      !> 0 when unknown
      integer, allocatable :: facet(:)
      !> Local coordinates in that facet, (2, nodes)
      real(wp), allocatable, private :: local(:, :)
      !> When each node must be projected again
      type(search_timers_type) :: timers
      !> The impactor, and which of its nodes were made last
      type(revolved_body_type), private :: body
      type(node_range_type) :: range
      !> How often nodes were added, and the approach bound at which more may be needed, length
      integer, private :: growths = 0
      real(wp), private :: grows_at = 0.0_wp
   contains
      procedure :: make_rows
      procedure :: linearise_again
      procedure :: reset
      procedure :: save
      procedure :: restore
      procedure :: least_gap
   end type node_set_type

contains

   !> Place the contact nodes
   subroutine new_nodes(self, surface, position, centre, body, spacing, error)
      type(node_set_type), intent(out) :: self
      type(surface_type), intent(in) :: surface
      !> Surface points at the start, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the impactor at the start, length
      real(wp), intent(in) :: centre(3)
      !> The impactor
      type(revolved_body_type), intent(in) :: body
      !> Distance between nodes, length; 0 for one derived from the mesh
      real(wp), intent(in) :: spacing
      !> Input error: more than `most_nodes` nodes, or too few
      type(error_type), allocatable, intent(out) :: error

      integer :: nodes

      self%body = body
      self%range = first_range(body, nint(surface%side), surface%facet, position, centre, spacing)
      self%range%most = most_nodes
      nodes = count_nodes(body, self%range)
      self%range%most = huge(1)
      if (nodes > most_nodes) then
         call fail(error, exit_input, "a spacing of "//text(self%range%spacing)//" gives more " &
            & //"than "//text(most_nodes)//" contact nodes or rings of them where an impactor of " &
            & //"radius "//text(body%radius)//" touches first: set a larger SPACING or METHOD 2")
      else if (self%range%spacing > largest_spacing*body%radius) then
         call fail(error, exit_input, "a spacing of "//text(spacing)//" leaves too few contact " &
            & //"nodes on an impactor of radius "//text(body%radius)//": set SPACING to at most " &
            & //text(largest_spacing*body%radius)//", or to 0 for one made from the mesh")
      else
         allocate (self%position(3, 0), self%outward(3, 0), self%local(2, 0))
         allocate (self%facet(0), self%multiplier(0))
         call new_search_timers(self%timers, 0)
         call add_nodes(self)
      end if
   end subroutine new_nodes

   !> Append the nodes of the range; all of them are due and their facets unknown
   pure subroutine add_nodes(self)
      type(node_set_type), intent(inout) :: self

      integer :: before

      before = size(self%facet)
      call append_nodes(self%body, self%range, self%position, self%outward)
      associate (added => size(self%position, 2) - before)
         self%facet = [self%facet, spread(0, 1, added)]
         self%multiplier = [self%multiplier, spread(0.0_wp, 1, added)]
         self%local = reshape([self%local, spread(0.0_wp, 1, 2*added)], [2, before + added])
         call self%timers%enlarge(before, before + added)
      end associate
   end subroutine add_nodes

   !> Add the nodes of the next heights
   pure subroutine grow(self)
      type(node_set_type), intent(inout) :: self

      self%growths = self%growths + 1
      self%range%height(:) = [1.0_wp, height_growth]*self%range%height(2)
      call add_nodes(self)
   end subroutine grow

   !> Add nodes as long as listed points of the plate lie near the highest ones
   pure subroutine grow_to_plate(self, candidates, position, centre)
      type(node_set_type), intent(inout) :: self
      type(candidate_list_type), intent(in) :: candidates
      !> Trial positions of the surface points and of the centre, length
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)

      real(wp) :: highest
      integer :: i

      highest = -huge(1.0_wp)
      do i = 1, size(candidates%point)
         highest = max(highest, self%range%side*(position(3, candidates%point(i)) - centre(3)))
      end do
      highest = highest - self%body%lowest_height(self%range%side)
      do while (highest > filled_share*self%range%height(2) &
         & .and. self%growths < most_growths)
         call grow(self)
      end do
      self%grows_at = candidates%approach_bound + filled_share*self%range%height(2) - highest
   end subroutine grow_to_plate

   !> Smallest gap of any contact node, negative when one penetrates, length
   pure real(wp) function least_gap(self, surface, position, centre)
      class(node_set_type), intent(in) :: self
      type(surface_type), intent(in) :: surface
      !> Surface points, length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the impactor, length
      real(wp), intent(in) :: centre(3)

      integer :: f, s
      integer, allocatable :: facets(:)
      real(wp) :: point(3)
      type(closest_point_type) :: closest

      allocate (facets(size(surface%facet, 2)))
      facets(:) = [(f, f=1, size(facets))]
      least_gap = huge(1.0_wp)
      closest%is_outside = .true.
      do s = 1, size(self%position, 2)
         point(:) = centre + self%position(:, s)
         if (closest%is_outside) then
            closest = surface%start_point(position, point, facets)
         end if
         call surface%project(position, point, closest)
         if (.not. closest%is_outside) least_gap = min(least_gap, closest%gap)
      end do
   end function least_gap

   !> Void the search data: every node is due and its facet unknown
   pure subroutine reset(self)
      class(node_set_type), intent(inout) :: self

      self%facet(:) = 0
      self%grows_at = 0.0_wp
      self%timers%due_at(:size(self%facet)) = 0.0_wp
      call self%timers%restart_groups()
   end subroutine reset

   !> Append search data and multipliers for a restart
   pure subroutine save(self, integers, reals)
      class(node_set_type), intent(in) :: self
      !> How often nodes were added, and the facet of each
      integer, allocatable, intent(inout) :: integers(:)
      !> Approach bound at which more may be needed; multiplier, approach bound at which it is due,
      !> and local coordinates of each node
      real(wp), allocatable, intent(inout) :: reals(:)

      integers = [integers, self%growths, self%facet]
      reals = [reals, self%grows_at, self%multiplier, self%timers%due_at(:size(self%facet)), &
         & reshape(self%local, [size(self%local)])]
   end subroutine save

   !> Restore what `save` appended
   pure subroutine restore(self, integers, reals, good)
      class(node_set_type), intent(inout) :: self
      !> As from `save`
      integer, intent(in) :: integers(:)
      real(wp), intent(in) :: reals(:)
      !> Whether they are for as many nodes
      logical, intent(out) :: good

      integer :: i

      good = size(integers) > 0
      if (.not. good) return
      do i = 1, min(integers(1), most_growths)
         call grow(self)
      end do
      associate (nodes => size(self%facet))
         good = size(integers) == 1 + nodes .and. size(reals) == 1 + 4*nodes
         if (.not. good) return
         self%facet(:) = integers(2:)
         self%grows_at = reals(1)
         self%multiplier(:) = reals(2:nodes + 1)
         self%timers%due_at(:nodes) = reals(nodes + 2:2*nodes + 1)
         self%local(:, :) = reshape(reals(2*nodes + 2:), shape(self%local))
      end associate
      call self%timers%restart_groups()
   end subroutine restore

   !> Make a row of every node below the surface; only nodes that are due are projected
   pure subroutine make_rows(self, candidates, position, centre, rows)
      class(node_set_type), intent(inout) :: self
      !> Facets near the impactor
      type(candidate_list_type), intent(in) :: candidates
      !> Trial positions of the surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Trial centre of the impactor, length
      real(wp), intent(in) :: centre(3)
      type(constraints_type), intent(inout) :: rows

      integer :: first

      if (size(candidates%facet) == 0) return
      if (candidates%approach_bound >= self%grows_at) then
         call grow_to_plate(self, candidates, position, centre)
      end if
      call self%timers%find_due(candidates%approach_bound)
      do first = 1, self%timers%count, lanes
         call project_nodes(self, candidates, position, centre, self%timers%due( &
            & first:min(first + lanes - 1, self%timers%count)), rows)
      end do
   end subroutine make_rows

   !> Project some nodes, no more than lanes, and make rows of those below the surface
   pure subroutine project_nodes(self, candidates, position, centre, node, rows)
      class(node_set_type), intent(inout) :: self
      type(candidate_list_type), intent(in) :: candidates
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)
      !> Numbers of the nodes
      integer, intent(in) :: node(:)
      type(constraints_type), intent(inout) :: rows

      type(closest_point_type) :: closest(size(node))
      real(wp) :: point(3, size(node))
      integer :: i

      do i = 1, size(node)
         point(:, i) = centre + self%position(:, node(i))
         if (self%facet(node(i)) <= 0) then
            closest(i) = candidates%patch%start_point(position, point(:, i), candidates%facet)
         else
            closest(i)%facet = self%facet(node(i))
            closest(i)%local(:) = self%local(:, node(i))
         end if
      end do
      call candidates%patch%project_some(position, point, closest)
      do i = 1, size(node)
         call check_free_edge(self, candidates%patch, node(i), closest(i))
         call store_projection(self, candidates%approach_bound, node(i), closest(i))
         if (closest(i)%is_outside .or. closest(i)%gap >= 0.0_wp) cycle
         if (.not. faces_impactor(self, closest(i), node(i))) cycle
         call rows%add(node(i), self%multiplier(node(i)))
         call set_row(candidates%patch, position, closest(i), rows, rows%count)
      end do
   end subroutine project_nodes

   !> Treat a node below the surface as outside only if the normal of the impactor misses, too
   pure subroutine check_free_edge(self, surface, node, closest)
      type(node_set_type), intent(in) :: self
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: node
      !> Its closest point on the surface
      type(closest_point_type), intent(inout) :: closest

      if (.not. closest%is_outside .or. closest%gap >= 0.0_wp) return
      if (.not. faces_impactor(self, closest, node)) return
      closest%is_outside = surface%line_misses(closest, self%outward(:, node))
   end subroutine check_free_edge

   !> Store facet and local coordinates of a node, and when it is due again
   pure subroutine store_projection(self, approach_bound, node, closest)
      class(node_set_type), intent(inout) :: self
      !> Bound on the approach of impactor and listed facets since the start, length
      real(wp), intent(in) :: approach_bound
      integer, intent(in) :: node
      !> Its closest point on the surface
      type(closest_point_type), intent(in) :: closest

      self%facet(node) = merge(-closest%facet, closest%facet, closest%is_outside)
      self%local(:, node) = closest%local
      if (closest%gap >= 0.0_wp) then
         self%timers%due_at(node) = approach_bound &
            & + sqrt(dot_product(closest%gap_vector, closest%gap_vector))
      else if (closest%is_outside) then
         ! below the free edge: distance beyond it
         self%timers%due_at(node) = approach_bound &
            & + norm2(closest%gap_vector - closest%gap*closest%normal)
      end if
      if (closest%gap >= 0.0_wp .or. closest%is_outside) self%multiplier(node) = 0.0_wp
   end subroutine store_projection

   !> Whether the facet faces the impactor, and the centre lies on its outer side
   !>
   !> A facet of crushed material that has folded over would pull the impactor in. An impactor that
   !> has slipped down past a free edge has its centre on the inner side.
   pure logical function faces_impactor(self, closest, node)
      type(node_set_type), intent(in) :: self
      !> Closest point of the node
      type(closest_point_type), intent(in) :: closest
      integer, intent(in) :: node

      faces_impactor = -dot_product(closest%normal, self%outward(:, node)) >= least_facing_cosine &
         & .and. closest%gap - dot_product(closest%normal, self%position(:, node)) > 0.0_wp
   end function faces_impactor

   !> Linearise the gaps of the rows again, at the corrected positions
   !>
   !> A facet that is not pressed down yet is inclined; a force along its normal does work on an
   !> impactor that slides.
   pure subroutine linearise_again(self, surface, position, centre, correction, rows)
      class(node_set_type), intent(in) :: self
      !> Facets near the impactor
      type(surface_type), intent(in) :: surface
      !> Corrected positions of the surface points, (3, points), and of the centre; corrections
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)
      type(correction_type), intent(in) :: correction
      !> Constraints of contact nodes, then others; get the gaps of the trial positions
      type(constraints_type), intent(inout) :: rows

      type(closest_point_type) :: closest
      integer :: node, row

      do row = 1, rows%count
         node = rows%source(row)
         if (node == 0) return
         closest%facet = self%facet(node)
         closest%local(:) = self%local(:, node)
         call surface%project(position, centre + self%position(:, node), closest)
         call set_row(surface, position, closest, rows, row)
         rows%gap(row) = rows%gap(row) - gap_change(rows, row, correction)
      end do
   end subroutine linearise_again

end module plydyn_contact_search_contact_nodes
