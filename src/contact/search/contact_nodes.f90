!> Contact nodes on the impactor: where they are, which facet is under each, and when to look again.
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

   !> Spacing made from the mesh, as a share of the distance between points of the plate
   real(wp), parameter :: spacing_share = 0.5_wp

   !> Facets within this share of the radius from the axis give the distance between points
   real(wp), parameter :: zone_share = 0.5_wp

   !> A facet turned farther than 60 degrees from the sphere over it has folded
   real(wp), parameter :: faced_cosine = 0.5_wp

   !> Distance from a side, in local coordinates, that counts as on the fold
   real(wp), parameter :: fold_width = 1.0e-4_wp

   !> Nodes farther from the axis than this many times the farthest point of the plate are left
   !> out: the impactor would have to travel sideways by as much again to bring them to the plate
   real(wp), parameter :: travel_share = 2.0_wp

   real(wp), parameter :: two_pi = 4.0_wp*acos(0.0_wp)

   !> Most contact nodes on an impactor
   integer, parameter :: most_nodes = 1000000

   !> Contact nodes, and what is remembered of them from step to step
   type, public :: node_set_type
      !> Positions relative to the centre, (3, nodes), ring after ring from the pole, length
      real(wp), allocatable :: position(:, :)
      !> Multiplier times the step squared, mass times length
      real(wp), allocatable :: push(:)
      !> Facet under each node; less than 0 where the node is beside it, beyond the border or what
      !> is listed; 0 when unknown
      integer, allocatable :: facet(:)
      !> Place in that facet, (2, nodes)
      real(wp), allocatable, private :: place(:, :)
      !> Until when they sleep: nodes far above the surface need not be looked at
      type(search_timers_type) :: sleepers
   contains
      procedure :: collect
      procedure :: forget
      procedure :: remember
      procedure :: recall
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
      !> Distance between nodes, length; 0 for one made from the mesh
      real(wp), intent(in) :: spacing
      !> Set when there would be too many nodes
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: cap, reach, used
      integer :: nodes

      used = spacing
      if (used <= 0.0_wp) used = spacing_share*point_distance(surface, position, centre, radius)
      reach = travel_share*farthest(surface, position, centre)
      ! a cap of the sphere has 2 pi r h of surface, each node takes a square of the spacing
      cap = radius - sqrt(max(0.0_wp, radius**2 - reach**2))
      if (two_pi*radius*cap/used**2 > most_nodes) then
         call fail(error, exit_input, "contact nodes "//text(used)//" apart are too many for a " &
            & //"sphere of radius "//text(radius)//": give a spacing (SPACING) of " &
            & //text(1.01_wp*sqrt(two_pi*radius*cap/most_nodes), 3)//" or more, or use METHOD 2")
         return
      end if
      call sphere_nodes(radius, used, reach, nint(surface%side), self%position)
      nodes = size(self%position, 2)
      allocate (self%facet(nodes), source=0)
      allocate (self%place(2, nodes), source=0.0_wp)
      allocate (self%push(nodes), source=0.0_wp)
      call new_search_timers(self%sleepers, nodes)
   end subroutine new_nodes

   !> Distance from the axis of the impactor to the farthest point of the surface, length
   pure real(wp) function farthest(surface, position, centre)
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Surface points at the start, length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the impactor at the start, length
      real(wp), intent(in) :: centre(3)

      integer :: f, s

      farthest = 0.0_wp
      do f = 1, size(surface%facet, 2)
         do s = 1, surface%nodes
            farthest = max(farthest, norm2(position(:2, surface%facet(s, f)) - centre(:2)))
         end do
      end do
   end function farthest

   !> Least distance between points along the sides of the facets under the impactor, length
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
         if (away(f) > max(zone_share*radius, minval(away))) cycle
         do s = 1, sides
            point_distance = min(point_distance, norm2(position(:, surface%facet(s, f)) &
               & - position(:, surface%facet(modulo(s, sides) + 1, f))))
         end do
      end do
      if (surface%nodes > bilinear_nodes) point_distance = 0.5_wp*point_distance
   end function point_distance

   !> Least gap of any contact node over the surface, negative when one penetrates
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
      type(closest_point_type) :: foot

      allocate (facets(size(surface%facet, 2)))
      facets(:) = [(f, f=1, size(facets))]
      least_gap = huge(1.0_wp)
      foot%beside = .true.
      do s = 1, size(self%position, 2)
         point(:) = centre + self%position(:, s)
         if (foot%beside) then
            foot = surface%start_candidate_list(position, point, facets)
         end if
         call surface%project(position, point, foot)
         if (.not. foot%beside) least_gap = min(least_gap, foot%gap)
      end do
   end function least_gap

   !> Forget where the nodes were
   pure subroutine forget(self)
      !> The nodes
      class(node_set_type), intent(inout) :: self

      self%facet(:) = 0
      self%sleepers%wake(:size(self%facet)) = 0.0_wp
      call self%sleepers%renew()
   end subroutine forget

   !> Append what is remembered from step to step
   pure subroutine remember(self, places, numbers)
      !> The nodes
      class(node_set_type), intent(in) :: self
      !> Facet under each node
      integer, allocatable, intent(inout) :: places(:)
      !> Push, travel at which to look again, and place in the facet of each node
      real(wp), allocatable, intent(inout) :: numbers(:)

      places = [places, self%facet]
      numbers = [numbers, self%push, self%sleepers%wake(:size(self%facet)), &
         & reshape(self%place, [size(self%place)])]
   end subroutine remember

   !> Take back what `remember` gave
   pure subroutine recall(self, places, numbers, good)
      !> The nodes
      class(node_set_type), intent(inout) :: self
      !> As from `remember`
      integer, intent(in) :: places(:)
      real(wp), intent(in) :: numbers(:)
      !> False when they are not for as many nodes
      logical, intent(out) :: good

      associate (nodes => size(self%facet))
         good = size(places) == nodes .and. size(numbers) == 4*nodes
         if (.not. good) return
         self%facet(:) = places
         self%push(:) = numbers(:nodes)
         self%sleepers%wake(:nodes) = numbers(nodes + 1:2*nodes)
         self%place(:, :) = reshape(numbers(2*nodes + 1:), shape(self%place))
      end associate
      call self%sleepers%renew()
   end subroutine recall

   !> Make a row of every node below the surface, looking only at those that can be
   pure subroutine collect(self, surface, near, position, centre, rows)
      !> The nodes
      class(node_set_type), intent(inout) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Facets near the sphere
      type(candidate_list_type), intent(in) :: near
      !> Trial positions of the surface points, length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Trial centre of the impactor, length
      real(wp), intent(in) :: centre(3)
      !> The constraints
      type(constraints_type), intent(inout) :: rows

      integer :: first

      if (size(near%facet) == 0) return
      call self%sleepers%find_awake(near%travel)
      do first = 1, self%sleepers%count, lanes
         call look(self, surface, near, position, centre, self%sleepers%awake( &
            & first:min(first + lanes - 1, self%sleepers%count)), rows)
      end do
   end subroutine collect

   !> Look where some nodes are, no more than lanes, and make rows of those below the surface
   pure subroutine look(self, surface, near, position, centre, node, rows)
      !> The nodes
      class(node_set_type), intent(inout) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Facets near the sphere
      type(candidate_list_type), intent(in) :: near
      !> Trial positions of the surface points, length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Trial centre of the impactor, length
      real(wp), intent(in) :: centre(3)
      !> Their numbers
      integer, intent(in) :: node(:)
      !> The constraints
      type(constraints_type), intent(inout) :: rows

      type(closest_point_type) :: foot(size(node))
      real(wp) :: point(3, size(node))
      integer :: i

      do i = 1, size(node)
         point(:, i) = centre + self%position(:, node(i))
         if (self%facet(node(i)) <= 0) then
            foot(i) = surface%start_candidate_list(position, point(:, i), near%facet)
         else
            foot(i)%facet = self%facet(node(i))
            foot(i)%place(:) = self%place(:, node(i))
         end if
      end do
      call surface%project_some(position, point, foot)
      do i = 1, size(node)
         call see_border(self, surface, node(i), foot(i))
         call note(self, near%travel, node(i), foot(i))
         if (foot(i)%beside .or. foot(i)%gap >= 0.0_wp) cycle
         if (.not. is_faced(self, foot(i), node(i))) cycle
         call add_row(self, surface, foot(i), node(i), rows)
      end do
   end subroutine look

   !> A node below the surface is beside it only where the radius of the sphere through it is, too
   pure subroutine see_border(self, surface, node, foot)
      !> The nodes
      type(node_set_type), intent(in) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Its number
      integer, intent(in) :: node
      !> Its foot on the surface
      type(closest_point_type), intent(inout) :: foot

      if (.not. foot%beside .or. foot%gap >= 0.0_wp) return
      if (is_faced(self, foot, node)) foot%beside = surface%is_missed(foot, self%position(:, node))
   end subroutine see_border

   !> Note where a node is; above the surface it then sleeps
   pure subroutine note(self, travel, node, foot)
      !> The nodes
      class(node_set_type), intent(inout) :: self
      !> Bound on the approach of sphere and listed facets since the start, length
      real(wp), intent(in) :: travel
      !> Its number
      integer, intent(in) :: node
      !> Its foot on the surface
      type(closest_point_type), intent(in) :: foot

      self%facet(node) = merge(-foot%facet, foot%facet, foot%beside)
      self%place(:, node) = foot%place
      if (foot%gap >= 0.0_wp) then
         self%sleepers%wake(node) = travel + sqrt(dot_product(foot%gap_vector, foot%gap_vector))
      else if (foot%beside) then
         ! below the border: how far beyond it
         self%sleepers%wake(node) = travel + norm2(foot%gap_vector - foot%gap*foot%normal)
      end if
      if (foot%gap >= 0.0_wp .or. foot%beside) self%push(node) = 0.0_wp
   end subroutine note

   !> Whether the plate faces the sphere there, with the centre on its outside. Where crushed matter
   !> has folded over it does not, and its normal would pull the sphere in; where the sphere has
   !> slipped down beside the border the centre is not, and its nodes come in under the face
   pure logical function is_faced(self, foot, node)
      !> The nodes
      type(node_set_type), intent(in) :: self
      !> Foot of the node
      type(closest_point_type), intent(in) :: foot
      !> Its number
      integer, intent(in) :: node

      real(wp) :: height

      associate (arm => self%position(:, node))
         height = -dot_product(foot%normal, arm)
         is_faced = height >= faced_cosine*norm2(arm) .and. height + foot%gap > 0.0_wp
      end associate
   end function is_faced

   !> Make a row of a node below the surface
   !>
   !> Where facets meet they fold, and the closest point has no normal, or more than one: there
   !> the point on the fold is taken with the normal of the sphere, which keeps what is symmetric.
   !> The gap is that to the closest point itself: beside the fold it must not jump.
   pure subroutine add_row(self, surface, foot, node, rows)
      !> The nodes
      type(node_set_type), intent(in) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Foot of the node
      type(closest_point_type), intent(in) :: foot
      !> Its number
      integer, intent(in) :: node
      !> The constraints
      type(constraints_type), intent(inout) :: rows

      real(wp) :: slope(2, surface%nodes), place(2)
      logical :: folded(2)
      integer :: row

      folded(:) = abs(foot%place) > 1.0_wp - fold_width
      place(:) = merge(sign(1.0_wp, foot%place), foot%place, folded)
      call rows%add(node, self%push(node))
      row = rows%count
      rows%point(:, row) = surface%facet(:, foot%facet)
      rows%normal(:, row) = foot%normal
      rows%gap(row) = foot%gap
      call shape_functions(surface%nodes, place(1), place(2), rows%weight(:, row), slope)
      if (any(folded)) then
         rows%normal(:, row) = -self%position(:, node)/norm2(self%position(:, node))
         rows%gap(row) = dot_product(rows%normal(:, row), foot%gap_vector)
      end if
   end subroutine add_row

end module plydyn_contact_search_contact_nodes
