!> Contact nodes on the impactor: positions, closest points on the facets, and search timers.
!>
!> A node above the surface by g is projected again when the approach bound of the candidate list
!> has grown by g. A node below the surface makes a row in every step.
module plydyn_contact_search_contact_nodes
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : lanes, wp
   use plydyn_base_text, only : text
   use plydyn_contact_solve_constraint, only : constraints_type
   use plydyn_contact_search_candidate_list, only : candidate_list_type
   use plydyn_contact_search_neighbours, only : sides
   use plydyn_contact_search_search_timers, only : new_search_timers, search_timers_type
   use plydyn_contact_bodies_sphere, only : sphere_nodes
   use plydyn_contact_search_surface, only : closest_point_type, surface_type
   use plydyn_fem_shape, only : bilinear_nodes, shape_functions
   implicit none
   private

   public :: new_nodes, point_distance

   !> Default spacing over the distance between points of the plate
   real(wp), parameter :: relative_spacing = 0.5_wp

   !> Distance from the axis, over the radius, of facets that give the distance between points
   real(wp), parameter :: relative_zone = 0.5_wp

   !> Cosine of the largest angle, 60 degrees, between facet and sphere: larger ones are folded over
   real(wp), parameter :: least_facing_cosine = 0.5_wp

   !> Distance from a side, in local coordinates, within which a point is at the kink
   real(wp), parameter :: kink_width = 1.0e-4_wp

   !> Largest distance of nodes from the axis over that of points of the plate: nodes farther out
   !> touch only after the impactor has moved sideways by half of that
   real(wp), parameter :: axis_distance_factor = 2.0_wp

   real(wp), parameter :: two_pi = 4.0_wp*acos(0.0_wp)

   !> Most contact nodes on an impactor
   integer, parameter :: most_nodes = 1000000

   !> Contact nodes with their search data and multipliers of the last step
   type, public :: node_set_type
      !> Positions relative to the centre, (3, nodes), ring after ring from the pole, length
      real(wp), allocatable :: position(:, :)
      !> Multiplier times the step squared, mass times length
      real(wp), allocatable :: multiplier(:)
      !> Facet below each node; negative where the node is outside the free edge or the candidates;
      !> 0 when unknown
      integer, allocatable :: facet(:)
      !> Local coordinates in that facet, (2, nodes)
      real(wp), allocatable, private :: local(:, :)
      !> When each node must be projected again
      type(search_timers_type) :: timers
   contains
      procedure :: collect
      procedure :: reset
      procedure :: save
      procedure :: restore
      procedure :: least_gap
   end type node_set_type

contains

   !> Place the contact nodes
   subroutine new_nodes(self, surface, position, centre, radius, spacing, error)
      !> The nodes
      type(node_set_type), intent(out) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Surface points at the start, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the impactor at the start, length
      real(wp), intent(in) :: centre(3)
      !> Radius of the sphere, length
      real(wp), intent(in) :: radius
      !> Distance between nodes, length; 0 for one derived from the mesh
      real(wp), intent(in) :: spacing
      !> Input error: more than `most_nodes` nodes
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: cap_height, axis_distance, node_spacing
      integer :: nodes

      node_spacing = spacing
      if (node_spacing <= 0.0_wp) then
         node_spacing = relative_spacing*point_distance(surface, position, centre, radius)
      end if
      axis_distance = axis_distance_factor*largest_axis_distance(surface, position, centre)
      ! area 2 pi r h of a spherical cap; a square of the spacing for each node
      cap_height = radius - sqrt(max(0.0_wp, radius**2 - axis_distance**2))
      if (two_pi*radius*cap_height/node_spacing**2 > most_nodes) then
         call fail(error, exit_input, "a spacing of "//text(node_spacing)//" gives more than " &
            & //text(most_nodes)//" contact nodes on a sphere of radius "//text(radius) &
            & //": set SPACING to at least " &
            & //text(1.01_wp*sqrt(two_pi*radius*cap_height/most_nodes), 3)//", or use METHOD 2")
         return
      end if
      call sphere_nodes(radius, node_spacing, axis_distance, nint(surface%side), self%position)
      nodes = size(self%position, 2)
      allocate (self%facet(nodes), source=0)
      allocate (self%local(2, nodes), source=0.0_wp)
      allocate (self%multiplier(nodes), source=0.0_wp)
      call new_search_timers(self%timers, nodes)
   end subroutine new_nodes

   !> Distance from the axis of the impactor to the farthest point of the surface, length
   pure real(wp) function largest_axis_distance(surface, position, centre)
      type(surface_type), intent(in) :: surface
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)

      integer :: f, s

      largest_axis_distance = 0.0_wp
      do f = 1, size(surface%facet, 2)
         do s = 1, surface%nodes
            largest_axis_distance = max(largest_axis_distance, &
               & norm2(position(:2, surface%facet(s, f)) - centre(:2)))
         end do
      end do
   end function largest_axis_distance

   !> Smallest distance between points along the sides of facets below the impactor, length
   pure real(wp) function point_distance(surface, position, centre, radius)
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Surface points at the start, length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the impactor at the start, length
      real(wp), intent(in) :: centre(3)
      !> Radius of the sphere, length
      real(wp), intent(in) :: radius

      real(wp), allocatable :: away(:)
      integer :: f, s

      allocate (away(size(surface%facet, 2)))
      do f = 1, size(away)
         away(f) = norm2(position(:2, surface%facet(surface%nodes, f)) - centre(:2))
      end do
      point_distance = huge(1.0_wp)
      do f = 1, size(away)
         if (away(f) > max(relative_zone*radius, minval(away))) cycle
         do s = 1, sides
            point_distance = min(point_distance, norm2(position(:, surface%facet(s, f)) &
               & - position(:, surface%facet(modulo(s, sides) + 1, f))))
         end do
      end do
      if (surface%nodes > bilinear_nodes) point_distance = 0.5_wp*point_distance
   end function point_distance

   !> Smallest gap of any contact node, negative when one penetrates, length
   pure real(wp) function least_gap(self, surface, position, centre)
      !> The nodes
      class(node_set_type), intent(in) :: self
      !> The surface
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
      !> The nodes
      class(node_set_type), intent(inout) :: self

      self%facet(:) = 0
      self%timers%due_at(:size(self%facet)) = 0.0_wp
      call self%timers%restart_groups()
   end subroutine reset

   !> Append search data and multipliers for a restart
   pure subroutine save(self, integers, reals)
      !> The nodes
      class(node_set_type), intent(in) :: self
      !> Facet of each node
      integer, allocatable, intent(inout) :: integers(:)
      !> Multiplier, approach bound at which it is due, and local coordinates of each node
      real(wp), allocatable, intent(inout) :: reals(:)

      integers = [integers, self%facet]
      reals = [reals, self%multiplier, self%timers%due_at(:size(self%facet)), &
         & reshape(self%local, [size(self%local)])]
   end subroutine save

   !> Restore what `save` appended
   pure subroutine restore(self, integers, reals, good)
      !> The nodes
      class(node_set_type), intent(inout) :: self
      !> As from `save`
      integer, intent(in) :: integers(:)
      real(wp), intent(in) :: reals(:)
      !> Whether they are for as many nodes
      logical, intent(out) :: good

      associate (nodes => size(self%facet))
         good = size(integers) == nodes .and. size(reals) == 4*nodes
         if (.not. good) return
         self%facet(:) = integers
         self%multiplier(:) = reals(:nodes)
         self%timers%due_at(:nodes) = reals(nodes + 1:2*nodes)
         self%local(:, :) = reshape(reals(2*nodes + 1:), shape(self%local))
      end associate
      call self%timers%restart_groups()
   end subroutine restore

   !> Make a row of every node below the surface; only nodes that are due are projected
   pure subroutine collect(self, surface, candidates, position, centre, rows)
      !> The nodes
      class(node_set_type), intent(inout) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Facets near the sphere
      type(candidate_list_type), intent(in) :: candidates
      !> Trial positions of the surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Trial centre of the impactor, length
      real(wp), intent(in) :: centre(3)
      !> The constraints
      type(constraints_type), intent(inout) :: rows

      integer :: first

      if (size(candidates%facet) == 0) return
      call self%timers%find_due(candidates%approach_bound)
      do first = 1, self%timers%count, lanes
         call project_nodes(self, surface, candidates, position, centre, self%timers%due( &
            & first:min(first + lanes - 1, self%timers%count)), rows)
      end do
   end subroutine collect

   !> Project some nodes, no more than lanes, and make rows of those below the surface
   pure subroutine project_nodes(self, surface, candidates, position, centre, node, rows)
      class(node_set_type), intent(inout) :: self
      type(surface_type), intent(in) :: surface
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
            closest(i) = surface%start_point(position, point(:, i), candidates%facet)
         else
            closest(i)%facet = self%facet(node(i))
            closest(i)%local(:) = self%local(:, node(i))
         end if
      end do
      call surface%project_some(position, point, closest)
      do i = 1, size(node)
         call check_free_edge(self, surface, node(i), closest(i))
         call store_projection(self, candidates%approach_bound, node(i), closest(i))
         if (closest(i)%is_outside .or. closest(i)%gap >= 0.0_wp) cycle
         if (.not. faces_sphere(self, closest(i), node(i))) cycle
         call add_row(self, surface, closest(i), node(i), rows)
      end do
   end subroutine project_nodes

   !> Treat a node below the surface as outside only if the sphere's radius through it misses, too
   pure subroutine check_free_edge(self, surface, node, closest)
      type(node_set_type), intent(in) :: self
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: node
      !> Its closest point on the surface
      type(closest_point_type), intent(inout) :: closest

      if (.not. closest%is_outside .or. closest%gap >= 0.0_wp) return
      if (.not. faces_sphere(self, closest, node)) return
      closest%is_outside = surface%line_misses(closest, self%position(:, node))
   end subroutine check_free_edge

   !> Store facet and local coordinates of a node, and when it is due again
   pure subroutine store_projection(self, approach_bound, node, closest)
      class(node_set_type), intent(inout) :: self
      !> Bound on the approach of sphere and listed facets since the start, length
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

   !> Whether the facet faces the sphere, and the centre lies on its outer side
   !>
   !> A facet of crushed material that has folded over would pull the sphere in. A sphere that has
   !> slipped down past a free edge has its centre on the inner side.
   pure logical function faces_sphere(self, closest, node)
      type(node_set_type), intent(in) :: self
      !> Closest point of the node
      type(closest_point_type), intent(in) :: closest
      integer, intent(in) :: node

      real(wp) :: height

      associate (arm => self%position(:, node))
         height = -dot_product(closest%normal, arm)
         faces_sphere = height >= least_facing_cosine*norm2(arm) .and. height + closest%gap > 0.0_wp
      end associate
   end function faces_sphere

   !> Make a row of a node below the surface
   !>
   !> At the kink between facets the normal of the surface is not unique. The row then acts on the
   !> point of the kink along the normal of the sphere, which preserves symmetry. The gap is that to
   !> the closest point, so that it is continuous across the kink.
   pure subroutine add_row(self, surface, closest, node, rows)
      type(node_set_type), intent(in) :: self
      type(surface_type), intent(in) :: surface
      !> Closest point of the node
      type(closest_point_type), intent(in) :: closest
      integer, intent(in) :: node
      type(constraints_type), intent(inout) :: rows

      real(wp) :: slope(2, surface%nodes), local(2)
      logical :: at_kink(2)
      integer :: row

      at_kink(:) = abs(closest%local) > 1.0_wp - kink_width
      local(:) = merge(sign(1.0_wp, closest%local), closest%local, at_kink)
      call rows%add(node, self%multiplier(node))
      row = rows%count
      rows%point(:, row) = surface%facet(:, closest%facet)
      rows%normal(:, row) = closest%normal
      rows%gap(row) = closest%gap
      call shape_functions(surface%nodes, local(1), local(2), rows%weight(:, row), slope)
      if (any(at_kink)) then
         rows%normal(:, row) = -self%position(:, node)/norm2(self%position(:, node))
         rows%gap(row) = dot_product(rows%normal(:, row), closest%gap_vector)
      end if
   end subroutine add_row

end module plydyn_contact_search_contact_nodes
