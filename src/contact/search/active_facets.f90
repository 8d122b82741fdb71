!> Active facets: the facets that contact may load in the coming step, known before the step.
!>
!> Contact nodes that could close their gap if impactor and surface approached twice as fast as in
!> the last step make the facets below them active, with two rings of neighbours. A node that is
!> found over another facet, as crushed material allows, exerts no force until the next step.
!> Internal forces of all other facets can therefore be computed before contact has been solved.
module plydyn_contact_search_active_facets
   use plydyn_base_precision, only : wp
   use plydyn_contact_search_candidate_list, only : candidate_list_type
   use plydyn_contact_solve_constraint, only : constraints_type
   use plydyn_contact_search_contact_nodes, only : node_set_type
   use plydyn_contact_search_surface, only : sides, surface_type
   implicit none
   private

   public :: new_active_facets

   !> Ratio of the assumed approach of the coming step to that of the last step
   real(wp), parameter :: growth_factor = 2.0_wp

   !> Facets that contact may load
   type, public :: active_facets_type
      !> Whether every facet is active
      logical :: is_all = .true.
      !> Active facets, each once, in the first `count` entries
      integer, allocatable :: facet(:)
      !> Number of active facets
      integer :: count = 0
      !> Approach bound of the last step and its increment in that step, length
      real(wp), private :: approach_bound = 0.0_wp, increment = 0.0_wp
      !> Whether each facet is active, and whether it lies below a node that may touch
      logical, allocatable, private :: is_active(:), is_below_node(:)
   contains
      procedure :: set
      procedure :: update
   end type active_facets_type

contains

   !> Start with all facets
   pure subroutine new_active_facets(self, facets)
      type(active_facets_type), intent(out) :: self
      !> Number of facets of the surface
      integer, intent(in) :: facets

      allocate (self%facet(facets), source=0)
      allocate (self%is_active(facets), self%is_below_node(facets), source=.false.)
   end subroutine new_active_facets

   !> Make some facets active, and no others
   pure subroutine set(self, facet)
      class(active_facets_type), intent(inout) :: self
      integer, intent(in) :: facet(:)

      self%is_all = .false.
      self%count = size(facet)
      self%facet(:self%count) = facet
   end subroutine set

   !> Remove rows on inactive facets, then find the active facets of the next step
   pure subroutine update(self, candidates, nodes, rows)
      class(active_facets_type), intent(inout) :: self
      !> With the approach in this step
      type(candidate_list_type), intent(in) :: candidates
      !> Contact nodes, projected in this step
      type(node_set_type), intent(inout) :: nodes
      !> The constraints of this step
      type(constraints_type), intent(inout) :: rows

      integer :: row

      if (.not. self%is_all) then
         do row = rows%count, 1, -1
            if (.not. self%is_active(nodes%facet(rows%source(row)))) call rows%remove(row)
         end do
      end if
      associate (bound => candidates%approach_bound)
         if (bound > self%approach_bound) self%increment = bound - self%approach_bound
         self%approach_bound = bound
      end associate
      self%is_active(self%facet(:self%count)) = .false.
      self%is_below_node(self%facet(:self%count)) = .false.
      self%count = 0
      self%is_all = self%increment <= 0.0_wp
      if (self%is_all) return
      call find_facets(self, candidates%surface, &
         & self%approach_bound + growth_factor*self%increment, nodes)
   end subroutine update

   !> Facets below nodes that are due up to an approach bound, and their neighbours
   pure subroutine find_facets(self, surface, approach_bound, nodes)
      type(active_facets_type), intent(inout) :: self
      type(surface_type), intent(in) :: surface
      real(wp), intent(in) :: approach_bound
      type(node_set_type), intent(inout) :: nodes

      integer :: f, i

      call nodes%timers%find_due(approach_bound)
      do i = 1, nodes%timers%count
         f = abs(nodes%facet(nodes%timers%due(i)))
         ! the facet of the node is unknown
         self%is_all = f == 0
         if (self%is_all) return
         if (self%is_below_node(f)) cycle
         self%is_below_node(f) = .true.
         call add_neighbours(self, surface, f)
      end do
   end subroutine find_facets

   !> Add a facet and two rings of neighbours
   pure subroutine add_neighbours(self, surface, facet)
      type(active_facets_type), intent(inout) :: self
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: facet

      integer :: i, k

      call add(self, facet)
      do i = 1, sides
         associate (next => surface%neighbour(i, facet))
            call add(self, next)
            if (next == 0) cycle
            do k = 1, sides
               call add(self, surface%neighbour(k, next))
            end do
         end associate
      end do
   end subroutine add_neighbours

   !> Add a facet; 0 stands for none
   pure subroutine add(self, facet)
      type(active_facets_type), intent(inout) :: self
      integer, intent(in) :: facet

      if (facet == 0) return
      if (self%is_active(facet)) return
      self%is_active(facet) = .true.
      self%count = self%count + 1
      self%facet(self%count) = facet
   end subroutine add

end module plydyn_contact_search_active_facets
