!> Linear constraints as sums over places in the arrays of motion.
module plydyn_domain_constraints
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_domain_domain, only : constraints_type, domain_type
   use plydyn_domain_local_to_global, only : local_to_global_type
   use plydyn_domain_supports, only : points_of
   use plydyn_model_support, only : constraint_term_type, constraint_type
   implicit none
   private

   public :: build_constraints

contains

   !> Place all constraints on the points that a rank has. All ranks must come here
   subroutine build_constraints(constraints, numbering, owner, domain)
      !> As the deck says
      type(constraint_type), intent(in) :: constraints(:)
      !> The rank's numbers of columns
      type(local_to_global_type), intent(in) :: numbering
      !> Rank that counts each column
      integer, intent(in) :: owner(:)
      !> Has its masses; gets the constraints
      type(domain_type), intent(inout) :: domain

      integer, allocatable :: rank_of(:)
      integer :: before, i, k, r

      allocate (rank_of(0))
      do i = 1, size(constraints)
         rank_of = [rank_of, owner(numbering%column_of(constraints(i)%terms%node))]
      end do
      associate (self => domain%constraints, comm => domain%comm)
         call list_terms(constraints, self)
         allocate (self%counts(0:comm%ranks - 1))
         self%counts(:) = [(count(rank_of == r), r=0, comm%ranks - 1)]
         self%of_ranks = sorted_order(rank_of)
         before = 0
         do i = 1, size(constraints)
            call place_terms(constraints(i)%terms, before, numbering, domain)
            before = before + size(constraints(i)%terms)
         end do
         call comm%merge(rank_of == comm%rank, self%inverse_mass)
         do k = 1, size(self%constraint)
            associate (whole => self%list(self%constraint(k))%inverse_mass)
               whole = whole + self%coefficient(k)**2*self%inverse_mass(k)
            end associate
         end do
      end associate
   end subroutine build_constraints

   !> Right-hand sides, and coefficients of all terms
   pure subroutine list_terms(constraints, self)
      type(constraint_type), intent(in) :: constraints(:)
      !> Gets the lists, without points
      type(constraints_type), intent(out) :: self

      integer :: i

      allocate (self%list(size(constraints)))
      self%list%quantity = constraints%quantity
      self%list%curve = constraints%curve
      self%list%scale = constraints%scale
      allocate (self%constraint(0), self%coefficient(0))
      do i = 1, size(constraints)
         associate (terms => constraints(i)%terms)
            self%constraint = [self%constraint, spread(i, 1, size(terms))]
            self%coefficient = [self%coefficient, terms%coefficient]
         end associate
      end do
      allocate (self%inverse_mass(size(self%coefficient)), source=0.0_wp)
      allocate (self%freedom(0), self%term(0), self%share(0))
   end subroutine list_terms

   !> Points of the terms that the rank has, and the mass that moves with each term
   pure subroutine place_terms(terms, before, numbering, domain)
      !> Terms of one constraint, and how many terms are before them
      type(constraint_term_type), intent(in) :: terms(:)
      integer, intent(in) :: before
      type(local_to_global_type), intent(in) :: numbering
      type(domain_type), intent(inout) :: domain

      real(wp), allocatable :: mass(:)
      integer, allocatable :: points(:, :)
      integer :: i, k, node

      do k = 1, size(terms)
         node = numbering%node(terms(k)%node)
         if (node == 0) cycle
         points = points_of(domain%layers, terms(k)%face, 0.0_wp)
         associate (self => domain%constraints, columns => domain%columns)
            mass = [(domain%inertia%mass(columns%mass_of(points(1, i), points(2, i), node)), &
               & i=1, size(points, 2))]
            self%freedom = [self%freedom, (columns%freedom(points(1, i), points(2, i), &
               & terms(k)%direction, node), i=1, size(points, 2))]
            self%term = [self%term, spread(before + k, 1, size(mass))]
            self%share = [self%share, mass/sum(mass)]
            self%inverse_mass(before + k) = 1.0_wp/sum(mass)
         end associate
      end do
   end subroutine place_terms

end module plydyn_domain_constraints
