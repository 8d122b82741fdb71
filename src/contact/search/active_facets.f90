!> The ground of contact: facets whose points it may push in a step, known before the step is made.
!>
!> They are the facets under those contact nodes that may touch, or beside them, were sphere and
!> surface to come nearer by twice as much as in the step before, and those around them. A node
!> that finds itself on another one all the same, where crushed matter lets it jump, enters in the
!> next step. So forces on the rest of the plate need not wait for contact.
module plydyn_contact_search_active_facets
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : constraints_type
   use plydyn_contact_search_neighbours, only : sides
   use plydyn_contact_search_contact_nodes, only : node_set_type
   use plydyn_contact_search_surface, only : surface_type
   implicit none
   private

   public :: new_active_facets

   !> How much faster than in the step before sphere and surface may come nearer
   real(wp), parameter :: ahead = 2.0_wp

   !> Facets that may be pushed
   type, public :: active_facets_type
      !> Whether any facet may be
      logical :: is_all = .true.
      !> Those that may be, each once, in the first `count` places
      integer, allocatable :: facet(:)
      !> How many these are
      integer :: count = 0
      !> Travel at the last step, and how much of it was made then, length
      real(wp), private :: travel = 0.0_wp, growth = 0.0_wp
      !> Whether each facet is one of these, and whether a node is over it
      logical, allocatable, private :: is_part(:), is_under(:)
   contains
      procedure :: take
      procedure :: follow
   end type active_facets_type

contains

   !> Start with all facets
   pure subroutine new_active_facets(self, facets)
      !> The ground
      type(active_facets_type), intent(out) :: self
      !> How many facets there are
      integer, intent(in) :: facets

      allocate (self%facet(facets), source=0)
      allocate (self%is_part(facets), self%is_under(facets), source=.false.)
   end subroutine new_active_facets

   !> These facets and no others
   pure subroutine take(self, facet)
      class(active_facets_type), intent(inout) :: self
      !> The facets
      integer, intent(in) :: facet(:)

      self%is_all = .false.
      self%count = size(facet)
      self%facet(:self%count) = facet
   end subroutine take

   !> Leave out the rows of nodes that have left the ground, and find that of the next step
   pure subroutine follow(self, surface, travel, nodes, rows)
      class(active_facets_type), intent(inout) :: self
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Bound on the approach of sphere and facets since the start, length
      real(wp), intent(in) :: travel
      !> Contact nodes, which have looked where they are; those that wake soon are found
      type(node_set_type), intent(inout) :: nodes
      !> The constraints of this step
      type(constraints_type), intent(inout) :: rows

      integer :: row

      if (.not. self%is_all) then
         do row = rows%count, 1, -1
            if (.not. self%is_part(nodes%facet(rows%source(row)))) call rows%drop(row)
         end do
      end if
      if (travel > self%travel) self%growth = travel - self%travel
      self%travel = travel
      self%is_part(self%facet(:self%count)) = .false.
      self%is_under(self%facet(:self%count)) = .false.
      self%count = 0
      self%is_all = self%growth <= 0.0_wp
      if (.not. self%is_all) call find(self, surface, travel + ahead*self%growth, nodes)
   end subroutine follow

   !> Facets under nodes that wake up to some travel, and around these
   pure subroutine find(self, surface, travel, nodes)
      type(active_facets_type), intent(inout) :: self
      type(surface_type), intent(in) :: surface
      real(wp), intent(in) :: travel
      type(node_set_type), intent(inout) :: nodes

      integer :: f, i

      call nodes%sleepers%find_awake(travel)
      do i = 1, nodes%sleepers%count
         f = abs(nodes%facet(nodes%sleepers%awake(i)))
         ! it may come from anywhere
         self%is_all = f == 0
         if (self%is_all) return
         if (self%is_under(f)) cycle
         self%is_under(f) = .true.
         call add_around(self, surface, f)
      end do
   end subroutine find

   !> Add a facet, those beyond its sides, and those beyond theirs
   pure subroutine add_around(self, surface, facet)
      type(active_facets_type), intent(inout) :: self
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: facet

      integer :: i, k

      call add(self, facet)
      do i = 1, sides
         associate (beside => surface%neighbour(i, facet))
            call add(self, beside)
            if (beside == 0) cycle
            do k = 1, sides
               call add(self, surface%neighbour(k, beside))
            end do
         end associate
      end do
   end subroutine add_around

   !> Add a facet, if there is one
   pure subroutine add(self, facet)
      type(active_facets_type), intent(inout) :: self
      integer, intent(in) :: facet

      if (facet == 0) return
      if (self%is_part(facet)) return
      self%is_part(facet) = .true.
      self%count = self%count + 1
      self%facet(self%count) = facet
   end subroutine add

end module plydyn_contact_search_active_facets
