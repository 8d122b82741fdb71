!> Supports, prescribed motions and linear constraints as places in the arrays of motion.
module plydyn_domain_supports
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_fem_columns, only : columns_type
   use plydyn_domain_domain, only : constraints_type, domain_type, prescribed_type
   use plydyn_domain_local_to_global, only : local_to_global_type
   use plydyn_model_layers, only : layers_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : bottom_face, constraint_term_type, constraint_type, &
      & motion_type, one_plane, support_type, top_face
   implicit none
   private

   public :: build_constraints, build_supports, face_point, points_of

contains

   !> Layer and level of the points on a face of the laminate
   pure function face_point(layers, face) result(point)
      type(layers_type), intent(in) :: layers
      !> `bottom_face` or `top_face`
      integer, intent(in) :: face
      integer :: point(2)

      point(:) = [1, 1]
      if (face == top_face) point(:) = [size(layers%order), layers%order(size(layers%order)) + 1]
   end function face_point

   !> Layers and levels of the points on a face, a plane or everywhere, (2, points)
   pure function points_of(layers, face, height) result(points)
      type(layers_type), intent(in) :: layers
      !> `bottom_face`, `top_face`, `one_plane` or `all_planes`
      integer, intent(in) :: face
      !> Height of the plane above the nodes, length; for `one_plane`
      real(wp), intent(in) :: height
      integer, allocatable :: points(:, :)

      integer :: k, t

      if (face == bottom_face .or. face == top_face) then
         points = reshape(face_point(layers, face), [2, 1])
         return
      end if
      allocate (points(2, 0))
      do k = 1, size(layers%order)
         do t = 1, layers%order(k) + 1
            ! the node of a brick has no height within a layer
            if (face == one_plane) then
               if (.not. layers%coincide(layers%height(k, t), height)) cycle
            end if
            points = reshape([points, k, t], [2, size(points, 2) + 1])
         end do
      end do
   end function points_of

   !> Held places, prescribed motions, and velocities at time zero
   subroutine build_supports(model, numbering, domain)
      type(model_type), intent(in) :: model
      type(local_to_global_type), intent(in) :: numbering
      !> Gets them
      type(domain_type), intent(inout) :: domain
      integer :: i

      call find_held(model%supports, numbering, domain%layers, domain%columns, &
         & domain%supports%held, domain%supports%support)
      allocate (domain%supports%motions(size(model%motions)))
      do i = 1, size(model%motions)
         domain%supports%motions(i) = new_prescribed(model%motions(i), numbering, domain)
      end do
      domain%supports%initial_velocities = model%initial_velocities
      do i = 1, size(model%initial_velocities)
         domain%supports%initial_velocities(i)%nodes = &
            & numbering%only(model%initial_velocities(i)%nodes)
      end do
   end subroutine build_supports

   !> Places in the arrays of motion that do not move, each once, in rising order
   pure subroutine find_held(supports, numbering, layers, columns, held, support)
      type(support_type), intent(in) :: supports(:)
      type(local_to_global_type), intent(in) :: numbering
      type(layers_type), intent(in) :: layers
      type(columns_type), intent(in) :: columns
      !> The places, and the first support of each of them
      integer, allocatable, intent(out) :: held(:), support(:)

      integer, allocatable :: nodes(:), points(:, :)
      integer :: c, first(columns%freedoms), h, i, k

      first(:) = 0
      ! the first support writes last
      do h = size(supports), 1, -1
         points = points_of(layers, supports(h)%face, supports(h)%height)
         nodes = numbering%only(supports(h)%nodes)
         do c = 1, 3
            if (.not. supports(h)%direction(c)) cycle
            do k = 1, size(points, 2)
               first(columns%freedom(points(1, k), points(2, k), c, nodes)) = h
            end do
         end do
      end do
      held = pack([(i, i=1, size(first))], first > 0)
      support = first(held)
   end subroutine find_held

   !> A prescribed motion on its points
   pure function new_prescribed(motion, numbering, domain) result(self)
      !> As the deck says
      type(motion_type), intent(in) :: motion
      type(local_to_global_type), intent(in) :: numbering
      !> Has layers and columns
      type(domain_type), intent(in) :: domain
      type(prescribed_type) :: self

      integer :: i, k
      integer, allocatable :: here(:), nodes(:), points(:, :)

      self%quantity = motion%quantity
      self%curve = motion%curve
      self%scale = motion%scale
      self%birth = motion%birth
      self%death = motion%death
      points = points_of(domain%layers, motion%face, 0.0_wp)
      nodes = numbering%node(motion%nodes)
      here = pack([(i, i=1, size(nodes))], nodes > 0)
      associate (columns => domain%columns, planes => size(points, 2))
         self%freedom = [(columns%freedom(points(1, k), points(2, k), motion%direction, &
            & nodes(here)), k=1, planes)]
         self%mass = [(columns%mass_of(points(1, k), points(2, k), nodes(here)), k=1, planes)]
         self%number = [((k - 1)*size(nodes) + here, k=1, planes)]
         self%all = planes*size(nodes)
      end associate
   end function new_prescribed

   !> Place all constraints on the points that a rank has. All ranks must come here
   subroutine build_constraints(constraints, numbering, domain)
      !> As the deck says
      type(constraint_type), intent(in) :: constraints(:)
      type(local_to_global_type), intent(in) :: numbering
      !> Has its masses; gets the constraints
      type(domain_type), intent(inout) :: domain

      integer, allocatable :: rank_of(:)
      integer :: before, i, k, r

      rank_of = numbering%owner(numbering%column_of([(constraints(i)%terms%node, &
         & i=1, size(constraints))]))
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
         call comm%merge(size(rank_of), rank_of == comm%rank, self%inverse_mass)
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
      self%constraint = [(spread(i, 1, size(constraints(i)%terms)), i=1, size(constraints))]
      self%coefficient = [(constraints(i)%terms%coefficient, i=1, size(constraints))]
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
      integer :: k, node

      do k = 1, size(terms)
         node = numbering%node(terms(k)%node)
         if (node == 0) cycle
         points = points_of(domain%layers, terms(k)%face, 0.0_wp)
         associate (self => domain%constraints, columns => domain%columns)
            mass = domain%inertia%mass(columns%mass_of(points(1, :), points(2, :), node))
            self%freedom = [self%freedom, columns%freedom(points(1, :), points(2, :), &
               & terms(k)%direction, node)]
            self%term = [self%term, spread(before + k, 1, size(mass))]
            self%share = [self%share, mass/sum(mass)]
            self%inverse_mass(before + k) = 1.0_wp/sum(mass)
         end associate
      end do
   end subroutine place_terms

end module plydyn_domain_supports
