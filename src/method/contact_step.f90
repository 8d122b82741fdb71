!> Impactors and their contact with the plate, step by step.
module plydyn_method_contact_step
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : wp
   use plydyn_contact_contact, only : contact_pair_type, contact_result_type
   use plydyn_contact_patch, only : contact_patch_type
   use plydyn_contact_search_near_points, only : near_points_type, unknown_move
   use plydyn_domain_domain, only : domain_type, face_type
   use plydyn_contact_solve_sliding, only : step_motion_type
   use plydyn_method_contact_correction, only : contact_work_type, correct_impactor, &
      & correct_plate, count_impactor, move_impactor
   use plydyn_method_fixture_step, only : approach_fixtures, correct_fixtures
   use plydyn_method_energy, only : global_reduction_type
   use plydyn_method_supports, only : is_active
   use plydyn_state_state, only : impactor_state_type, state_type
   implicit none
   private

   public :: find_positions

   !> Chunks that must wait until contact has pushed a facet, or a point
   type, public :: chunk_list_type
      !> Last place of each facet or point in the list, after that of none; the list
      integer, allocatable :: last(:), list(:)
   end type chunk_list_type

   !> One contact: the pair and its work space
   type, public :: pair_type
      !> Geometry and multipliers
      type(contact_pair_type) :: pair
      !> Trial positions of the surface points, (3, points)
      real(wp), allocatable :: position(:, :)
      !> Their inverse mass, zero in directions that do not give way now, (3, points)
      real(wp), allocatable :: inverse_mass(:, :)
      !> Motion over the step, for friction: not allocated without
      type(step_motion_type), allocatable :: motion
      !> Listed points near the impactor, rank by rank, and how many of them each rank counts
      integer, allocatable :: listed(:), counts(:)
      !> How often these were listed anew
      integer :: rebuilds = -1
      !> Chunks at the points of each facet
      type(chunk_list_type) :: chunks
      !> Positions of the points that this rank counts, and of those of all ranks
      real(wp), allocatable :: sent(:), received(:)
      !> How many numbers of each point: its position, and with friction its motion
      integer :: sent_each = 3
   end type pair_type

   !> All contacts
   type, public :: contacts_type
      !> In the order of `domain%contact%contacts`
      type(pair_type), allocatable :: pairs(:)
      !> Whether contact may push a point of each chunk in the coming step; whether of any chunk
      logical, allocatable :: reached(:)
      logical :: reaches_all = .true.
      !> Each impactor after the step before
      type(impactor_state_type), allocatable :: before(:)
      !> Points near each fixture, and the chunks at the points of each face that fixtures meet
      type(near_points_type), allocatable :: near(:)
      type(chunk_list_type), allocatable :: face_chunks(:)
      !> Whether each prescribed motion acts now; the first, 0, is that of no motion
      logical, allocatable :: is_moved(:)
      !> Impulses of the step
      type(contact_work_type) :: work
   contains
      procedure :: predict
      procedure :: correct
      procedure :: patch
      procedure :: save
      procedure :: restore
   end type contacts_type

contains

   !> Put the memory of the contacts into the state
   subroutine save(self, state)
      class(contacts_type), intent(in) :: self
      !> Gets the memory
      type(state_type), intent(inout) :: state
      integer :: i

      do i = 1, size(self%pairs)
         call self%pairs(i)%pair%save(state%contacts(i)%places, state%contacts(i)%numbers)
      end do
   end subroutine save

   !> Take it back from there
   subroutine restore(self, state, error)
      class(contacts_type), intent(inout) :: self
      !> Has the memory
      type(state_type), intent(in) :: state
      !> The memory is that of another contact
      type(error_type), allocatable, intent(out) :: error

      logical :: good
      integer :: i

      do i = 1, size(self%pairs)
         call self%pairs(i)%pair%restore(state%contacts(i)%places, state%contacts(i)%numbers, good)
         if (good) cycle
         call fail(error, exit_input, "the contact in the restart file is not that of the deck " &
            & //"in it: it must have been written by the same version of plydyn")
         return
      end do
   end subroutine restore

   !> Move the impactors over the coming step without contact, and find where contact may be
   subroutine predict(self, domain, reduction, state)
      class(contacts_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      !> Has bounds on the motion of the plate, of the step before
      type(global_reduction_type), intent(in) :: reduction
      !> Impactors; the plate is not predicted yet
      type(state_type), intent(inout) :: state

      real(wp) :: move
      integer :: i
      logical :: is_due

      self%before = state%impactors
      do i = 1, size(domain%contact%impactors)
         call move_impactor(domain, i, state)
      end do
      move = largest_move(domain, state%step, reduction)
      self%reaches_all = size(domain%supports%motions) + size(domain%constraints%list) > 0
      if (size(self%near) > 0) then
         ! joints, and inertia that points share, pass on what contact moves
         call approach_fixtures(domain, merge(unknown_move, move, domain%inertia%thickness%active &
            & .or. size(domain%constraints%list) > 0), state, self%near, is_due)
         self%reaches_all = self%reaches_all .or. is_due
      end if
      do i = 1, size(self%pairs)
         associate (pair => self%pairs(i)%pair, impactor => domain%contact%contacts(i)%impactor)
            call pair%candidates%update_slack(move, state%impactors(impactor)%centre)
            self%reaches_all = self%reaches_all .or. pair%candidates%needs_all &
               & .or. pair%active_facets%is_all
         end associate
      end do
   end subroutine predict

   !> Mark the chunks at some facets or points
   pure subroutine mark_reached(chunks, items, reached)
      type(chunk_list_type), intent(in) :: chunks
      !> The facets, or the points
      integer, intent(in) :: items(:)
      logical, intent(inout) :: reached(:)

      integer :: i, k

      do i = 1, size(items)
         do k = chunks%last(items(i) - 1) + 1, chunks%last(items(i))
            reached(chunks%list(k)) = .true.
         end do
      end do
   end subroutine mark_reached

   !> Push the impactors and the plate apart where they meet, then the plate out of the fixtures:
   !> these do not give way, so that their condition is the one that holds at the end of the step.
   !> Then count the work of all of them
   subroutine correct(self, domain, state, reduction)
      class(contacts_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      !> Impactors, displacement and velocity of the plate, already predicted without contact
      type(state_type), intent(inout) :: state
      !> Gets the work of contact
      type(global_reduction_type), intent(inout) :: reduction

      real(wp) :: pushed
      integer :: i

      do i = 1, size(domain%supports%motions)
         self%is_moved(i) = is_active(domain%supports%motions(i), state%time)
      end do
      self%reached(:) = .false.
      pushed = 0.0_wp
      call self%work%clear()
      do i = 1, size(self%pairs)
         call correct_pair(self%pairs(i), domain, i, self%is_moved, state, self%work)
         associate (pair => self%pairs(i)%pair)
            call mark_reached(self%pairs(i)%chunks, &
               & pair%active_facets%facet(:pair%active_facets%count), self%reached)
            pushed = pushed + pair%correction%largest_displacement()
         end associate
      end do
      if (size(domain%contact%fixtures) > 0) then
         call correct_fixtures(domain, self%is_moved, pushed, self%near, state, self%work, &
            & reduction)
         do i = 1, size(self%near)
            call mark_reached(self%face_chunks(domain%contact%fixtures(i)%surface), &
               & self%near(i)%point(:self%near(i)%count), self%reached)
         end do
      end if
      call self%work%count_work(domain, state, reduction)
      do i = 1, size(self%pairs)
         associate (impactor => domain%contact%contacts(i)%impactor)
            call count_impactor(domain%contact%impactors(impactor), self%before(impactor), &
               & state%step_before, state%step, state%impactors(impactor), state%energies, &
               & self%pairs(i)%motion)
         end associate
      end do
   end subroutine correct

   !> The patch in contact with an impactor at the end of the last step
   pure type(contact_patch_type) function patch(self, domain, impactor, step)
      class(contacts_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      !> Index of the impactor
      integer, intent(in) :: impactor
      !> The last step
      real(wp), intent(in) :: step

      integer :: i

      do i = 1, size(self%pairs)
         if (domain%contact%contacts(i)%impactor == impactor) then
            patch = self%pairs(i)%pair%patch(self%pairs(i)%position, step)
         end if
      end do
   end function patch

   !> Contact of one pair
   subroutine correct_pair(self, domain, i, is_moved, state, work)
      type(pair_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: i
      !> As in `contacts_type`
      logical, contiguous, intent(in) :: is_moved(0:)
      type(state_type), intent(inout) :: state
      !> Gets the impulses on the plate
      type(contact_work_type), intent(inout) :: work

      type(contact_result_type) :: found
      integer :: k

      associate (surface => domain%contact%surfaces(i), &
         & own => state%impactors(domain%contact%contacts(i)%impactor))
         if (self%pair%candidates%needs_all) then
            call find_positions(domain, surface, surface%of_ranks, surface%counts, state, self)
         else
            if (self%rebuilds /= self%pair%candidates%rebuilds) call list_by_rank(surface, self)
            call find_positions(domain, surface, self%listed, self%counts, state, self)
         end if
         if (size(domain%supports%motions) > 0) then
            do k = 1, size(self%inverse_mass, 2)
               self%inverse_mass(:, k) = merge(0.0_wp, surface%inverse_mass(:, k), &
                  & is_moved(surface%motion(:, k)))
            end do
         end if
         if (allocated(self%motion)) then
            self%motion%centre(:) = state%step*own%velocity
            self%motion%rotation(:) = state%step*own%spin
         end if
         call self%pair%enforce(self%position, self%inverse_mass, state%step, own%centre, found, &
            & self%motion)
         own%contacts = found%active
         own%penetration = found%penetration
         if (found%active == 0) return
         own%last_contact = state%time + state%step
         call correct_plate(domain, surface, self%inverse_mass, self%pair%correction, state, work, &
            & domain%contact%contacts(i)%impactor, self%motion)
         call correct_impactor(self%pair%correction%impactor, found%force, state%step, own, &
            & self%motion)
      end associate
   end subroutine correct_pair

   !> Bound on the displacement of a point of the plate in the step; `unknown_move` where
   !> motions are prescribed
   pure real(wp) function largest_move(domain, step, reduction) result(move)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: step
      type(global_reduction_type), intent(in) :: reduction

      move = unknown_move
      if (size(domain%supports%motions) > 0 .or. reduction%speed_bound > move) return
      ! fixtures moved points at the end of the last step, when impactors had seen them
      move = sqrt(3.0_wp)*(step*reduction%speed_bound &
         & + size(domain%contact%fixtures)*reduction%largest_push)
   end function largest_move

   !> Sort the listed points by the ranks that count them
   pure subroutine list_by_rank(surface, self)
      type(face_type), intent(in) :: surface
      type(pair_type), intent(inout) :: self

      logical :: is_listed(size(surface%position, 2))
      integer :: first, r

      self%rebuilds = self%pair%candidates%rebuilds
      is_listed(:) = .false.
      is_listed(self%pair%candidates%point) = .true.
      self%listed = pack(surface%of_ranks, is_listed(surface%of_ranks))
      self%counts = surface%counts
      first = 0
      do r = 1, size(surface%counts)
         self%counts(r) = count(is_listed(surface%of_ranks(first + 1:first + surface%counts(r))))
         first = first + surface%counts(r)
      end do
   end subroutine list_by_rank

   !> Where some points of the face are, those of other ranks too, and with friction their motion
   subroutine find_positions(domain, surface, points, counts, state, self)
      type(domain_type), intent(in) :: domain
      type(face_type), intent(in) :: surface
      !> The points, rank by rank, and how many of them each rank counts
      integer, intent(in) :: points(:), counts(:)
      !> Displacement and velocity
      type(state_type), intent(in) :: state
      type(pair_type), intent(inout) :: self

      integer :: c, i, k, sent

      sent = 0
      do i = 1, size(points)
         k = points(i)
         if (.not. surface%own(k)) cycle
         do c = 1, 3
            self%position(c, k) = surface%position(c, k) + state%displacement(surface%freedom(c, k))
         end do
         if (allocated(self%motion)) then
            self%motion%point(:, k) = state%step*state%velocity(surface%freedom(:, k))
         end if
         if (domain%comm%ranks == 1) cycle
         self%sent(sent + 1:sent + 3) = self%position(:, k)
         if (allocated(self%motion)) self%sent(sent + 4:sent + 6) = self%motion%point(:, k)
         sent = sent + self%sent_each
      end do
      if (domain%comm%ranks == 1) return
      call domain%comm%allgather(self%sent(:sent), self%sent_each*counts, self%received)
      do i = 1, size(points)
         associate (first => self%sent_each*(i - 1))
            self%position(:, points(i)) = self%received(first + 1:first + 3)
            if (allocated(self%motion)) then
               self%motion%point(:, points(i)) = self%received(first + 4:first + 6)
            end if
         end associate
      end do
   end subroutine find_positions

end module plydyn_method_contact_step
