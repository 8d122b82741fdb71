!> Contact of a rigid sphere with a face of the plate, by forward increment Lagrange multipliers.
!>
!> The paper's eqs 12 to 18: the solver moves plate and impactor without contact; where the trial
!> positions penetrate, multipliers push both apart until the gaps are closed; none ever pulls.
!> The gaps are linearised at the trial positions, once per step. There is no friction.
!>
!> Two discretisations. Contact nodes on the impactor against the facets of the plate, as in the
!> paper, and its border where the impactor hangs over it; or the points of the plate against the
!> exact sphere. In both the plate is nothing but surface points with inverse masses: contact knows
!> no layers.
module plydyn_contact_contact
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_contact_solve_constraint, only : constraints_type, new_constraints, opening
   use plydyn_contact_solve_correction, only : correction_type, new_correction
   use plydyn_contact_solve_multiplier, only : active_set_type, new_active_set
   use plydyn_contact_search_active_facets, only : active_facets_type, new_active_facets
   use plydyn_contact_search_candidate_list, only : candidate_list_type, new_candidate_list
   use plydyn_contact_search_contact_nodes, only : new_nodes, node_set_type, point_distance
   use plydyn_contact_search_free_edge, only : collect_rim, rim_gap
   use plydyn_contact_solve_diagonal_multiplier, only : is_separate, solve_separate
   use plydyn_contact_bodies_sphere, only : sphere_gap
   use plydyn_contact_search_surface, only : new_surface, surface_type
   implicit none
   private

   public :: new_contact

   !> What touches what, and how
   type, public :: contact_setup_type
      !> Radius of the sphere, length
      real(wp) :: radius = 0.0_wp
      !> Mass of the impactor
      real(wp) :: mass = 0.0_wp
      !> The impactor moves along z only
      logical :: guided = .false.
      !> 1 for the top face of the plate, -1 for the bottom face
      integer :: side = 1
      !> Points of the plate against the exact sphere, in place of contact nodes on the impactor
      logical :: exact_sphere = .false.
      !> Distance between contact nodes, length; 0 for one made from the mesh
      real(wp) :: spacing = 0.0_wp
   end type contact_setup_type

   !> What contact did in a step
   type, public :: contact_result_type
      !> Force on the impactor; the guide takes what acts across it
      real(wp) :: force(3) = 0.0_wp
      !> Contact nodes, or points of the plate, that press
      integer :: active = 0
      !> Largest penetration left by the linearised gaps, length
      real(wp) :: penetration = 0.0_wp
   end type contact_result_type

   !> An impactor against a face
   type, public :: contact_pair_type
      !> What of the surface is near the impactor: nothing else is pushed
      type(candidate_list_type) :: near
      !> Facets that can be pushed in the coming step, as long as the former are not listed anew
      type(active_facets_type) :: ground
      !> What the last step added to the surface points
      type(correction_type) :: correction
      type(contact_setup_type), private :: setup
      !> Inverse mass of the impactor along x, y, z, zero where held
      real(wp), private :: impactor_inverse(3) = 0.0_wp
      type(surface_type), private :: surface
      !> None for the exact sphere
      type(node_set_type), private :: nodes
      type(constraints_type), private :: rows
      type(active_set_type), private :: active_set
   contains
      procedure :: enforce
      procedure :: initial_gap
      procedure :: remember
      procedure :: recall
   end type contact_pair_type

contains

   !> Build a contact pair
   subroutine new_contact(self, setup, facet, position, centre, error)
      !> The pair
      type(contact_pair_type), intent(out) :: self
      !> What touches what
      type(contact_setup_type), intent(in) :: setup
      !> Surface points of each facet, (4 or 9, facets), counter-clockwise from above
      integer, intent(in) :: facet(:, :)
      !> Surface points at the start, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the impactor at the start, length
      real(wp), intent(in) :: centre(3)
      !> Set when the spacing makes too many nodes, or when a small sphere would pass the points
      type(error_type), allocatable, intent(out) :: error

      self%setup = setup
      self%impactor_inverse(:) = 1.0_wp/setup%mass
      if (setup%guided) self%impactor_inverse(:2) = 0.0_wp
      call new_surface(self%surface, facet, size(position, 2), setup%side)
      call new_candidate_list(self%near, self%surface, setup%radius)
      call new_active_facets(self%ground, size(facet, 2))
      call new_constraints(self%rows, merge(1, size(facet, 1), setup%exact_sphere))
      call new_active_set(self%active_set, size(position, 2))
      call new_correction(self%correction, size(position, 2))
      if (setup%exact_sphere) then
         call refuse_passage(setup%radius, &
            & point_distance(self%surface, position, centre, setup%radius), error)
      else
         call new_nodes(self%nodes, self%surface, position, centre, setup%radius, setup%spacing, &
            & error)
      end if
   end subroutine new_contact

   !> Refuse a sphere that fits between four points of the plate: it would pass them unseen
   subroutine refuse_passage(radius, distance, error)
      !> Radius of the sphere; distance between points of the plate under it, length
      real(wp), intent(in) :: radius, distance
      type(error_type), allocatable, intent(out) :: error

      if (radius > sqrt(0.5_wp)*distance) return
      call fail(error, exit_input, "a sphere of radius "//text(radius)//" passes between points " &
         & //"of the plate that are "//text(distance)//" apart: make the mesh finer there, or " &
         & //"use METHOD 1")
   end subroutine refuse_passage

   !> Gap between impactor and plate, negative when they penetrate, huge when nothing is under it
   pure real(wp) function initial_gap(self, position, centre)
      !> The pair
      class(contact_pair_type), intent(in) :: self
      !> Surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the impactor, length
      real(wp), intent(in) :: centre(3)

      integer :: i
      real(wp) :: gap, normal(3)

      initial_gap = huge(1.0_wp)
      if (self%setup%exact_sphere) then
         do i = 1, size(position, 2)
            call sphere_gap(position(:, i), centre, self%setup%radius, self%setup%side, gap, normal)
            initial_gap = min(initial_gap, gap)
         end do
      else
         initial_gap = min(self%nodes%least_gap(self%surface, position, centre), &
            & rim_gap(self%surface, [(i, i=1, size(self%surface%facet, 2))], position, centre, &
            & self%setup%radius, 0.0_wp))
      end if
   end function initial_gap

   !> What the pair knows from the last step: with it, the next one gives the same bits elsewhere
   pure subroutine remember(self, places, numbers)
      !> The pair
      class(contact_pair_type), intent(in) :: self
      !> Facets; travel, positions, pushes
      integer, allocatable, intent(out) :: places(:)
      real(wp), allocatable, intent(out) :: numbers(:)

      allocate (places(0), numbers(0))
      call self%near%remember(places, numbers)
      if (.not. self%setup%exact_sphere) call self%nodes%remember(places, numbers)
   end subroutine remember

   !> Take back what `remember` gave
   pure subroutine recall(self, places, numbers, good)
      !> The pair, new
      class(contact_pair_type), intent(inout) :: self
      !> As from `remember`
      integer, intent(in) :: places(:)
      real(wp), intent(in) :: numbers(:)
      !> False when they are those of another pair
      logical, intent(out) :: good

      integer :: used(2)

      call self%near%recall(self%surface, places, numbers, used)
      good = used(1) >= 0
      if (.not. good) return
      if (self%setup%exact_sphere) then
         good = used(1) == size(places) .and. used(2) == size(numbers)
         call self%ground%take(self%near%facet)
      else
         call self%nodes%recall(places(used(1) + 1:), numbers(used(2) + 1:), good)
      end if
   end subroutine recall

   !> Push impactor and plate apart where their trial positions penetrate
   pure subroutine enforce(self, position, inverse_mass, dt, centre, centre_correction, result)
      !> The pair
      class(contact_pair_type), intent(inout) :: self
      !> Trial positions of the surface points, of all if `near%needs_all`, else of those in
      !> `near%point`, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Of the surface points along x, y, z, (3, points), zero where held
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      !> Time step
      real(wp), intent(in) :: dt
      !> Trial centre of the impactor, length
      real(wp), intent(in) :: centre(3)
      !> To add to the centre, length
      real(wp), intent(out) :: centre_correction(3)
      !> Force and more
      type(contact_result_type), intent(out) :: result

      integer :: of_nodes
      logical :: rebuilt

      centre_correction(:) = 0.0_wp
      of_nodes = 0
      self%rows%count = 0
      call self%near%update(self%surface, position, centre, rebuilt)
      call self%correction%clear()
      if (self%setup%exact_sphere) then
         if (rebuilt) call self%ground%take(self%near%facet)
         call collect_points(self, position, centre)
      else
         if (rebuilt) call self%nodes%forget()
         call collect_nodes(self, position, centre, rebuilt, of_nodes)
      end if
      if (self%rows%count == 0) return

      call self%correction%list(self%rows)
      if (is_separate(self%rows, inverse_mass, self%impactor_inverse)) then
         call solve_separate(self%rows, inverse_mass, self%impactor_inverse, &
            & self%correction%move, centre_correction)
      else
         call self%active_set%solve_unilateral(self%rows, inverse_mass, self%impactor_inverse, &
            & self%correction%move, centre_correction)
      end if
      call self%near%shift(self%correction%farthest())
      if (of_nodes > 0) then
         self%nodes%push(self%rows%source(:of_nodes)) = self%rows%push(:of_nodes)
      end if
      call report(self%rows, dt, self%correction%move, centre_correction, result)
   end subroutine enforce

   !> Make rows of contact nodes, then of the border; it presses where the whole plate may be
   !> pushed, which it sees to as soon as the impactor comes near it
   pure subroutine collect_nodes(self, position, centre, rebuilt, of_nodes)
      !> The pair
      class(contact_pair_type), intent(inout) :: self
      !> Trial positions of the surface points, length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Trial centre of the impactor, length
      real(wp), intent(in) :: centre(3)
      !> Whether the facets near the impactor have been listed anew
      logical, intent(in) :: rebuilt
      !> Rows of contact nodes: the first ones
      integer, intent(out) :: of_nodes

      logical :: pushes_all

      pushes_all = self%ground%is_all .or. rebuilt
      self%ground%is_all = pushes_all
      call self%nodes%collect(self%near%patch, self%near, position, centre, self%rows)
      call self%ground%follow(self%surface, self%near%travel, self%nodes, self%rows)
      of_nodes = self%rows%count
      if (pushes_all) then
         call collect_rim(self%surface, self%near%facet, position, centre, self%setup%radius, &
            & self%rows)
      end if
      if (rim_gap(self%surface, self%near%facet, position, centre, self%setup%radius, &
         & self%near%reach) < self%near%reach) self%ground%is_all = .true.
   end subroutine collect_nodes

   !> Make a row of every point of the plate inside the sphere
   pure subroutine collect_points(self, position, centre)
      !> The pair
      class(contact_pair_type), intent(inout) :: self
      !> Trial positions of the surface points, length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Trial centre of the impactor, length
      real(wp), intent(in) :: centre(3)

      integer :: i, k
      real(wp) :: arm(3), distance

      do i = 1, size(self%near%point)
         k = self%near%point(i)
         arm(:) = centre - position(:, k)
         if (arm(1)**2 + arm(2)**2 + arm(3)**2 >= self%setup%radius**2) cycle
         distance = norm2(arm)
         call self%rows%add(k, 0.0_wp)
         associate (rows => self%rows, row => self%rows%count)
            rows%point(1, row) = k
            rows%weight(1, row) = 1.0_wp
            rows%gap(row) = distance - self%setup%radius
            rows%normal(:, row) = arm/distance
         end associate
      end do
   end subroutine collect_points

   !> What contact did
   pure subroutine report(rows, dt, correction, centre_correction, result)
      !> The constraints with their pushes
      type(constraints_type), intent(in) :: rows
      !> Time step
      real(wp), intent(in) :: dt
      !> Of the surface points, length
      real(wp), contiguous, intent(in) :: correction(:, :)
      !> Of the centre, length
      real(wp), intent(in) :: centre_correction(3)
      !> Force and more
      type(contact_result_type), intent(out) :: result

      integer :: row

      do row = 1, rows%count
         if (rows%push(row) > 0.0_wp) result%active = result%active + 1
         result%force(:) = result%force + rows%push(row)/dt**2*rows%normal(:, row)
         result%penetration = max(result%penetration, -rows%gap(row) &
            & - opening(rows, row, correction, centre_correction))
      end do
   end subroutine report

end module plydyn_contact_contact
