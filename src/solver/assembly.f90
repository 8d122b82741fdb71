!> The state of the whole model on the root, put together from those of all ranks, and taken apart
!> again for a run that goes on.
module plydyn_solver_assembly
   use plydyn_base_precision, only : wp
   use plydyn_domain_columns, only : front
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_share, only : share_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_parallel_pieces, only : new_pieces, pieces_type
   use plydyn_state_exchange, only : exchange_state, exchange_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: new_assembly

   !> How the parts of the ranks make the whole; all ranks take part in everything
   type, public :: assembly_type
      private
      type(comm_type) :: comm
      !> Places that one rank counts, and all that this rank has, of motion and of supports
      type(pieces_type) :: counted, had, support_counted, support_had, moved_counted, moved_had
      !> Histories
      type(pieces_type) :: history
      !> Lengths of the arrays of the whole model: motion, histories, supports, prescribed points
      integer :: freedoms = 0, histories = 0, supports = 0, moved = 0
   contains
      procedure :: gather
      procedure :: scatter
   end type assembly_type

   !> Tells other ranks what all of them have alike
   type, extends(exchange_type) :: teller_type
      type(comm_type) :: comm
   contains
      procedure :: reals => tell_reals
      procedure :: integers => tell_integers
   end type teller_type

   !> What ranks have parts of
   character(*), parameter :: divided(6) = [character(16) :: "displacement", "velocity", &
      & "acceleration", "history", "support_force", "support_velocity"]

contains

   !> Prepare for a domain. All ranks must come here
   function new_assembly(domain, share) result(self)
      !> The domain of this rank
      type(domain_type), intent(in) :: domain
      !> What this rank has of the whole model
      type(share_type), intent(in) :: share
      type(assembly_type) :: self

      integer :: held, i
      integer, allocatable :: number(:), support(:, :)
      logical, allocatable :: own(:)

      self%comm = domain%comm
      self%freedoms = front + domain%columns%height*share%columns
      self%histories = share%histories
      associate (comm => self%comm, all => column_pieces(domain%columns%height, share%column))
         self%had = new_pieces(comm, all)
         self%counted = new_pieces(comm, chosen(all, share%own))
      end associate
      self%history = new_pieces(self%comm, share%history)
      call number_supports(domain, share, number, own, held)
      self%moved = sum(domain%motions%all)
      self%supports = held + self%moved
      allocate (support(3, size(number)))
      support(1, :) = [(i, i=1, size(number))]
      support(2, :) = number
      support(3, :) = 1
      self%support_had = new_pieces(self%comm, support)
      self%support_counted = new_pieces(self%comm, chosen(support, own))
      associate (here => size(domain%held))
         support(1, :) = support(1, :) - here
         support(2, :) = support(2, :) - held
         self%moved_had = new_pieces(self%comm, support(:, here + 1:))
         self%moved_counted = new_pieces(self%comm, chosen(support(:, here + 1:), own(here + 1:)))
      end associate
   end function new_assembly

   !> Places of supports in the list of the whole model: held points column by column, then those of
   !> each motion
   subroutine number_supports(domain, share, number, own, held)
      type(domain_type), intent(in) :: domain
      type(share_type), intent(in) :: share
      !> Place of each
      integer, allocatable, intent(out) :: number(:)
      !> Whether it is counted here
      logical, allocatable, intent(out) :: own(:)
      !> Held points of the whole model
      integer, intent(out) :: held

      integer :: before(share%columns + 1), c, column(size(domain%held)), i, m
      real(wp) :: points(share%columns)

      column(:) = domain%columns%column_of(domain%held)
      points(:) = 0.0_wp
      do i = 1, size(column)
         associate (there => share%column(column(i)))
            points(there) = points(there) + 1.0_wp
         end associate
      end do
      call domain%comm%find_greatest(points)
      before(1) = 0
      do c = 1, size(points)
         before(c + 1) = before(c) + nint(points(c))
      end do
      held = before(size(before))
      allocate (number(size(column)))
      do i = 1, size(column)
         associate (next => before(share%column(column(i))))
            next = next + 1
            number(i) = next
         end associate
      end do
      own = share%own(column)
      i = held
      do m = 1, size(domain%motions)
         number = [number, i + domain%motions(m)%number]
         own = [own, domain%motions(m)%own]
         i = i + domain%motions(m)%all
      end do
   end subroutine number_supports

   !> Pieces of the arrays of motion, a column each
   pure function column_pieces(height, column) result(piece)
      integer, intent(in) :: height, column(:)
      integer :: piece(3, size(column))
      integer :: i

      do i = 1, size(column)
         piece(:, i) = [front + height*(i - 1) + 1, front + height*(column(i) - 1) + 1, height]
      end do
   end function column_pieces

   !> Some pieces
   pure function chosen(piece, mask)
      integer, intent(in) :: piece(:, :)
      logical, intent(in) :: mask(:)
      integer, allocatable :: chosen(:, :)
      integer :: i

      chosen = piece(:, pack([(i, i=1, size(mask))], mask))
   end function chosen

   !> Bring the state of the whole model to the root
   subroutine gather(self, state, whole)
      class(assembly_type), intent(in) :: self
      !> The state of this rank
      type(state_type), intent(in) :: state
      !> That of the whole model, on the root
      type(state_type), intent(inout) :: whole

      if (.not. allocated(whole%displacement)) call allocate_whole(self, whole)
      call copy_common(state, whole)
      call self%counted%gather(state%displacement, whole%displacement)
      call self%counted%gather(state%velocity, whole%velocity)
      call self%counted%gather(state%acceleration, whole%acceleration)
      call self%history%gather(state%history, whole%history)
      call self%support_counted%gather(state%support_force, whole%support_force)
      call self%moved_counted%gather(state%support_velocity, whole%support_velocity)
   end subroutine gather

   !> Make room for the whole model; none on ranks other than the root
   subroutine allocate_whole(self, whole)
      type(assembly_type), intent(in) :: self
      type(state_type), intent(inout) :: whole

      associate (here => merge(1, 0, self%comm%is_root()))
         allocate (whole%displacement(here*self%freedoms), whole%velocity(here*self%freedoms), &
            & whole%acceleration(here*self%freedoms), whole%history(here*self%histories), &
            & whole%support_force(here*self%supports), whole%support_velocity(here*self%moved), &
            & source=0.0_wp)
      end associate
   end subroutine allocate_whole

   !> What all ranks have alike
   subroutine copy_common(from, to)
      type(state_type), intent(in) :: from
      type(state_type), intent(inout) :: to

      to%time = from%time
      to%cycle = from%cycle
      to%end_time = from%end_time
      to%end_cycle = from%end_cycle
      to%step = from%step
      to%step_before = from%step_before
      to%first_step = from%first_step
      to%impactors = from%impactors
      to%contacts = from%contacts
      to%load_factor = from%load_factor
      to%sums = from%sums
      to%energies = from%energies
   end subroutine copy_common

   !> Take the state of the whole model from the root
   subroutine scatter(self, whole, supports, state)
      class(assembly_type), intent(in) :: self
      !> The state of the whole model, on the root
      type(state_type), intent(inout) :: whole
      !> Whether supports are among it
      logical, intent(in) :: supports
      !> That of this rank, allocated
      type(state_type), intent(inout) :: state

      type(teller_type) :: teller

      if (self%comm%is_root()) call copy_common(whole, state)
      if (.not. allocated(whole%displacement)) call allocate_whole(self, whole)
      teller%comm = self%comm
      call exchange_state(teller, state)
      call self%had%scatter(whole%displacement, state%displacement)
      call self%had%scatter(whole%velocity, state%velocity)
      call self%had%scatter(whole%acceleration, state%acceleration)
      call self%history%scatter(whole%history, state%history)
      if (.not. supports) return
      call self%support_had%scatter(whole%support_force, state%support_force)
      call self%moved_had%scatter(whole%support_velocity, state%support_velocity)
   end subroutine scatter

   !> Tell an array of the root
   subroutine tell_reals(self, name, values)
      class(teller_type), intent(inout) :: self
      character(*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: values(:)

      integer :: length(1)

      if (any(divided == name)) return
      length(1) = 0
      if (allocated(values)) length(1) = size(values)
      call self%comm%tell(length)
      if (.not. self%comm%is_root()) then
         if (allocated(values)) deallocate (values)
         allocate (values(length(1)))
      end if
      call self%comm%tell(values)
   end subroutine tell_reals

   !> Tell an array of the root
   subroutine tell_integers(self, name, values)
      class(teller_type), intent(inout) :: self
      character(*), intent(in) :: name
      integer, allocatable, intent(inout) :: values(:)

      integer :: length(1)

      length(1) = 0
      if (allocated(values)) length(1) = size(values)
      call self%comm%tell(length)
      if (.not. self%comm%is_root()) then
         if (allocated(values)) deallocate (values)
         allocate (values(length(1)))
      end if
      call self%comm%tell(values)
   end subroutine tell_integers

end module plydyn_solver_assembly
