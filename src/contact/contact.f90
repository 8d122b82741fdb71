!> Contact of a rigid impactor with a face of the plate by Lagrange multipliers.
!>
!> Forward increment Lagrange multipliers (the paper's eqs 12 to 18; Carpenter, Taylor and Katona,
!> 1991): plate and impactor are predicted without contact, and non-negative multipliers close the
!> gaps that are negative there; those of contact nodes are linearised again when corrected.
!> Friction and normal multipliers are found in turn, until friction moves no gap any more.
!>
!> Two discretisations: contact nodes on the impactor against the facets of the plate and their free
!> edges (METHOD 1, as in the paper); points of the plate against the exact body (METHOD 2). They
!> differ in where rows come from and in the gap at the start; all else is one, and so is the type.
!> The plate is given by its surface points and their inverse masses only.
module plydyn_contact_contact
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_contact_patch, only : contact_patch_type, new_patch, point_areas
   use plydyn_contact_solve_constraint, only : constraints_type, correction_type, gap_change, &
      & new_constraints, new_correction
   use plydyn_contact_solve_coulomb, only : friction_type
   use plydyn_contact_solve_multiplier, only : active_set_type
   use plydyn_contact_search_active_facets, only : active_facets_type, new_active_facets
   use plydyn_contact_search_candidate_list, only : candidate_list_type, new_candidate_list
   use plydyn_contact_search_contact_nodes, only : new_nodes, node_set_type
   use plydyn_contact_search_free_edge, only : collect_edges
   use plydyn_contact_solve_diagonal_multiplier, only : is_diagonal, solve_diagonal
   use plydyn_contact_solve_sliding, only : new_sliding, sliding_type, step_motion_type
   use plydyn_contact_bodies_revolved_body, only : revolved_body_type
   use plydyn_contact_search_surface, only : new_surface, surface_type
   implicit none
   private

   public :: new_contact

   !> Most passes over normal multipliers and friction
   integer, parameter :: most_passes = 10
   !> Change of a gap by friction in the last pass over the largest penetration
   real(wp), parameter :: last_shift = 1.0e-11_wp

   !> Properties of a contact pair
   type, public :: contact_setup_type
      !> Body of the impactor
      type(revolved_body_type) :: body
      !> Inverse mass of the impactor along x, y, z, 0 where it is held or led, and inverse moment
      !> of inertia about its centre, 0 where it does not rotate
      real(wp) :: inverse_mass(3) = 0.0_wp, inverse_inertia = 0.0_wp
      !> Friction coefficients
      type(friction_type) :: friction
      !> 1 for the top face of the plate, -1 for the bottom face
      integer :: side = 1
      !> Whether points of the plate meet the exact body, else contact nodes of it the facets
      logical :: exact_body = .false.
      !> Distance between contact nodes, length; 0 for one derived from the mesh
      real(wp) :: spacing = 0.0_wp
   end type contact_setup_type

   !> Contact force and penetration of a step
   type, public :: contact_result_type
      !> Force on the impactor, including the part that a guide carries
      real(wp) :: force(3) = 0.0_wp
      !> Number of rows with a positive multiplier
      integer :: active = 0
      !> Largest penetration that remains of the linearised gaps, length
      real(wp) :: penetration = 0.0_wp
   end type contact_result_type

   !> An impactor and a face of the plate
   type, public :: contact_pair_type
      !> Facets and points of the surface near the impactor: all others are out of contact
      type(candidate_list_type) :: candidates
      !> Facets that can be loaded in the coming step, unless the candidates are listed anew
      type(active_facets_type) :: active_facets
      !> Displacement corrections in the last step
      type(correction_type) :: correction
      !> Contact nodes; not allocated for the exact body
      type(node_set_type), allocatable :: nodes
      type(contact_setup_type), private :: setup
      type(constraints_type), private :: rows
      type(active_set_type), private :: active_set
      type(sliding_type), private :: sliding
      !> Tributary area of the surface points at the start, length squared
      real(wp), allocatable, private :: point_area(:)
      !> Corrected positions of the candidates, (3, points), length; unused for the exact body
      real(wp), allocatable, private :: corrected(:, :)
   contains
      procedure :: enforce
      procedure :: initial_gap
      procedure :: patch => last_patch
      procedure :: save
      procedure :: restore
   end type contact_pair_type

contains

   !> Build a contact pair
   subroutine new_contact(self, setup, facet, position, centre, error)
      type(contact_pair_type), intent(out) :: self
      !> Properties of the pair
      type(contact_setup_type), intent(in) :: setup
      !> Surface points of each facet, (4 or 9, facets), counter-clockwise from above
      integer, intent(in) :: facet(:, :)
      !> Surface points at the start, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the impactor at the start, length
      real(wp), intent(in) :: centre(3)
      !> Input error: too many contact nodes or too few
      type(error_type), allocatable, intent(out) :: error

      type(surface_type) :: surface

      self%setup = setup
      call new_sliding(self%sliding, setup%friction, setup%body%radius, setup%inverse_inertia, &
         & size(position, 2))
      call new_surface(surface, facet, size(position, 2), setup%side)
      call new_candidate_list(self%candidates, surface, setup%body)
      call new_active_facets(self%active_facets, size(facet, 2))
      call new_constraints(self%rows, merge(1, size(facet, 1), setup%exact_body))
      self%rows%impactor_inverse(:) = setup%inverse_mass
      call new_correction(self%correction, size(position, 2))
      self%point_area = point_areas(facet, position)
      if (setup%exact_body) return
      self%corrected = position
      allocate (self%nodes)
      call new_nodes(self%nodes, surface, position, centre, setup%body, setup%spacing, error)
   end subroutine new_contact

   !> The patch in contact at the end of the last step
   pure type(contact_patch_type) function last_patch(self, position, dt) result(patch)
      class(contact_pair_type), intent(in) :: self
      !> Trial positions of the last step, as for `enforce`
      real(wp), contiguous, intent(in) :: position(:, :)
      !> The last step
      real(wp), intent(in) :: dt

      patch = new_patch(self%rows, self%point_area, position, self%correction, dt)
   end function last_patch

   !> Gap between impactor and plate, negative when they penetrate, huge where there is no facet
   pure real(wp) function initial_gap(self, position, centre)
      class(contact_pair_type), intent(in) :: self
      !> Surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the impactor, length
      real(wp), intent(in) :: centre(3)

      real(wp) :: of_edges
      integer :: i

      initial_gap = huge(1.0_wp)
      if (self%setup%exact_body) then
         do i = 1, size(position, 2)
            initial_gap = min(initial_gap, &
               & self%setup%body%vertical_gap(centre - position(:, i), self%setup%side))
         end do
      else
         associate (surface => self%candidates%surface)
            call collect_edges(surface, [(i, i=1, size(surface%facet, 2))], position, centre, &
               & self%setup%body, 0.0_wp, of_edges)
            initial_gap = min(self%nodes%least_gap(surface, position, centre), of_edges)
         end associate
      end if
   end function initial_gap

   !> Search data of the last step for the restart file: with them a restart gives the same bits
   pure subroutine save(self, integers, reals)
      class(contact_pair_type), intent(in) :: self
      !> Facets of the candidates and of the nodes
      integer, allocatable, intent(out) :: integers(:)
      !> Approach bound, positions, multipliers, due times and local coordinates
      real(wp), allocatable, intent(out) :: reals(:)

      allocate (integers(0), reals(0))
      call self%candidates%save(integers, reals)
      if (.not. self%setup%exact_body) call self%nodes%save(integers, reals)
   end subroutine save

   !> Restore the search data of a restart file
   pure subroutine restore(self, integers, reals, good)
      !> The pair, new
      class(contact_pair_type), intent(inout) :: self
      !> As from `save`
      integer, intent(in) :: integers(:)
      real(wp), intent(in) :: reals(:)
      !> Whether they fit this pair
      logical, intent(out) :: good

      integer :: used(2)

      call self%candidates%restore(integers, reals, used)
      good = used(1) >= 0
      if (.not. good) return
      if (self%setup%exact_body) then
         good = used(1) == size(integers) .and. used(2) == size(reals)
         call self%active_facets%set(self%candidates%facet)
      else
         call self%nodes%restore(integers(used(1) + 1:), reals(used(2) + 1:), good)
      end if
   end subroutine restore

   !> Find the displacement corrections that close the gaps of the trial positions
   pure subroutine enforce(self, position, inverse_mass, dt, centre, result, motion)
      class(contact_pair_type), intent(inout) :: self
      !> Trial positions of the surface points, of all if `candidates%needs_all`, else of those in
      !> `candidates%point`, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Inverse mass of the surface points along x, y, z, (3, points), zero where held
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      !> Time step
      real(wp), intent(in) :: dt
      !> Trial centre of the impactor, length
      real(wp), intent(in) :: centre(3)
      !> Contact force and penetration
      type(contact_result_type), intent(out) :: result
      !> Motion over the step, for friction; gets what friction does to it
      type(step_motion_type), optional, intent(inout) :: motion

      integer :: node_rows
      logical :: rebuilt

      node_rows = 0
      self%rows%count = 0
      call self%candidates%update(position, centre, rebuilt)
      call self%correction%clear()
      if (self%setup%exact_body) then
         if (rebuilt) call self%active_facets%set(self%candidates%facet)
         call self%candidates%make_point_rows(position, centre, self%rows)
      else
         if (rebuilt) call self%nodes%reset()
         call make_node_rows(self, position, centre, rebuilt, node_rows)
      end if
      if (self%rows%count == 0) return

      call close_gaps(self, inverse_mass)
      if (node_rows > 0) then
         call follow_facets(self, position, centre)
         call close_gaps(self, inverse_mass)
      end if
      if (self%sliding%is_active .and. present(motion)) then
         call add_friction(self, inverse_mass, dt, motion)
      end if
      call self%candidates%add_correction(self%correction%largest_displacement())
      if (node_rows > 0) then
         self%nodes%multiplier(self%rows%source(:node_rows)) = self%rows%multiplier(:node_rows)
      end if
      call summarise(self%rows, self%sliding%is_active, dt, self%correction, result)
   end subroutine enforce

   !> Linearise the gaps of contact nodes again, where the facets are with their corrections
   pure subroutine follow_facets(self, position, centre)
      class(contact_pair_type), intent(inout) :: self
      !> As in `enforce`
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)

      integer :: i, k

      do i = 1, size(self%candidates%point)
         k = self%candidates%point(i)
         self%corrected(:, k) = position(:, k) + self%correction%displacement(:, k)
      end do
      call self%nodes%linearise_again(self%candidates%patch, self%corrected, &
         & centre + self%correction%impactor, self%correction, self%rows)
   end subroutine follow_facets

   !> Multipliers that close the gaps of the rows, and their corrections. Rows of contact nodes
   !> share points, those of an exact body have one each
   pure subroutine close_gaps(self, inverse_mass)
      class(contact_pair_type), intent(inout) :: self
      !> As in `enforce`
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)

      logical :: is_apart

      call self%correction%clear()
      call self%correction%list_points(self%rows)
      is_apart = self%setup%exact_body
      if (is_apart) is_apart = is_diagonal(self%rows, inverse_mass)
      if (is_apart) then
         call solve_diagonal(self%rows, inverse_mass, self%correction)
      else
         call self%active_set%solve_unilateral(self%rows, inverse_mass, self%correction)
      end if
   end subroutine close_gaps

   !> Friction of the rows, and what it changes of their normal multipliers
   pure subroutine add_friction(self, inverse_mass, dt, motion)
      class(contact_pair_type), intent(inout) :: self
      !> As in `enforce`
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      real(wp), intent(in) :: dt
      type(step_motion_type), intent(inout) :: motion

      real(wp) :: shift
      integer :: pass

      associate (rows => self%rows, sliding => self%sliding)
         call sliding%start(rows, inverse_mass, motion)
         do pass = 1, most_passes
            call sliding%find_slips(rows, self%correction, motion)
            call sliding%limit_rows(rows, inverse_mass, dt, motion)
            call sliding%shift_gaps(rows, shift)
            if (shift <= last_shift) exit
            call close_gaps(self, inverse_mass)
         end do
         call sliding%finish(rows, self%correction, motion)
      end associate
   end subroutine add_friction

   !> Rows of contact nodes, then of free edges
   !>
   !> Edge rows are made in steps in which every facet is active. Every facet is active from the
   !> step after the one in which the impactor comes within the search distance of a free edge.
   pure subroutine make_node_rows(self, position, centre, rebuilt, node_rows)
      class(contact_pair_type), intent(inout) :: self
      !> Trial positions of surface points and centre, length
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)
      !> Whether the candidates have been listed anew
      logical, intent(in) :: rebuilt
      !> Number of rows of contact nodes: they come first
      integer, intent(out) :: node_rows

      real(wp) :: gap_of_edges
      logical :: is_everywhere

      is_everywhere = self%active_facets%is_all .or. rebuilt
      self%active_facets%is_all = is_everywhere
      call self%nodes%make_rows(self%candidates, position, centre, self%rows)
      call self%active_facets%update(self%candidates, self%nodes, self%rows)
      node_rows = self%rows%count
      associate (distance => self%candidates%search_distance)
         call collect_edges(self%candidates%surface, self%candidates%facet, position, centre, &
            & self%setup%body, distance, gap_of_edges, self%rows)
         if (gap_of_edges < distance) self%active_facets%is_all = .true.
      end associate
      if (.not. is_everywhere) self%rows%count = node_rows
   end subroutine make_node_rows

   !> Contact force, active rows and remaining penetration
   pure subroutine summarise(rows, rubs, dt, correction, result)
      !> The constraints with their multipliers
      type(constraints_type), intent(in) :: rows
      !> Whether there is friction
      logical, intent(in) :: rubs
      !> Time step
      real(wp), intent(in) :: dt
      type(correction_type), intent(in) :: correction
      type(contact_result_type), intent(out) :: result

      integer :: row

      do row = 1, rows%count
         if (rows%multiplier(row) > 0.0_wp) result%active = result%active + 1
         result%force(:) = result%force + rows%multiplier(row)/dt**2*rows%normal(:, row)
         if (rubs) result%force(:) = result%force + rows%friction(:, row)/dt**2
         result%penetration = max(result%penetration, -rows%gap(row) &
            & - gap_change(rows, row, correction))
      end do
   end subroutine summarise

end module plydyn_contact_contact
