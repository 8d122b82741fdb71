!> What the threads of a step tell each other: who takes which chunk, what is done, and whether
!> contact is.
!>
!> The first thread does contact, and so takes the last chunks: a chunk adds up the borders to later
!> ones, and these have the fewest. Loops in which all threads share the chunks go from the last one
!> down, too: each thread gets those that it has here.
!>
!> Chunks that contact may reach wait for it; the others need not. A chunk moves its points as soon
!> as the forces on them are there, whoever makes them: no thread waits while there is such a chunk.
module plydyn_method_thread_team
   use omp_lib, only : omp_get_max_threads, omp_get_thread_num, omp_init_lock, omp_lock_kind, &
      & omp_set_lock, omp_unset_lock
   use plydyn_domain_domain, only : domain_type
   use plydyn_parallel_halo, only : messages_type
   use plydyn_method_work_queue, only : line, work_queue_type
   implicit none
   private

   public :: new_thread_team

   !> Lists of chunks: those whose forces other ranks need, and the others
   integer, parameter, public :: outer = 1, inner = 2, lists = 2

   !> What is noted of a chunk, in a line of the cache of its own
   integer, parameter :: made = 1, moved = 2

   !> Threads and their chunks
   type, public :: thread_team_type
      !> Lists of chunks to make the forces of, and all of them to move
      type(work_queue_type) :: makers(lists), movers
      !> How many threads there are
      integer, private :: threads = 1
      !> Whether each chunk waits for contact
      logical, allocatable, private :: waits(:)
      !> Forces on their way to and from other ranks
      type(messages_type) :: messages
      !> Number of the step, and that of the last one in which each chunk has made its forces, and
      !> has moved its points ahead of the others, (line, 0:chunks); in place 0 the forces of other
      !> ranks: never, as all threads wait for them
      integer, private :: step = 0
      integer, allocatable, private :: done(:, :)
      !> Whether contact is done in this step, and whether all chunks wait for it
      logical, private :: is_open = .true., all_wait = .false.
      !> Held by the thread that does it until it is
      integer(omp_lock_kind), private :: gate
   contains
      procedure :: let_wait
      procedure :: begin
      procedure :: close => close_gate
      procedure :: open => open_gate
      procedure :: take
      procedure :: await_contact
      procedure :: has_opened
      procedure :: note_made
      procedure :: has_forces
      procedure :: note_moved
      procedure :: has_moved
   end type thread_team_type

contains

   !> Threads with all chunks before them, and no contact
   subroutine new_thread_team(domain, self)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The threads of the coming parallel regions
      type(thread_team_type), intent(out) :: self

      integer :: c, chunks

      chunks = size(domain%chunks%list)
      self%threads = omp_get_max_threads()
      allocate (self%done(line, 0:chunks), source=0)
      allocate (self%waits(chunks), source=.false.)
      call omp_init_lock(self%gate)
      call self%movers%arrange([(c, c=chunks, 1, -1)], self%waits, self%threads)
      call arrange(self, domain)
      call self%begin(.false.)
      self%is_open = .true.
   end subroutine new_thread_team

   !> Let other chunks wait for contact than in the step before; no other thread may be at work
   pure subroutine let_wait(self, domain, waits)
      class(thread_team_type), intent(inout) :: self
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Whether each chunk waits
      logical, intent(in) :: waits(:)

      ! one thread has done contact before it takes a chunk
      if (self%threads == 1 .or. all(self%waits .eqv. waits)) return
      self%waits(:) = waits
      call arrange(self, domain)
   end subroutine let_wait

   !> Give the chunks to the threads
   pure subroutine arrange(self, domain)
      type(thread_team_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain

      associate (first => domain%chunks%order(domain%chunks%outer:1:-1), &
         & rest => domain%chunks%order(size(domain%chunks%order):domain%chunks%outer + 1:-1))
         call self%makers(outer)%arrange(first, self%waits, self%threads)
         call self%makers(inner)%arrange(rest, self%waits, self%threads)
      end associate
   end subroutine arrange

   !> A new step; no other thread may be at work
   pure subroutine begin(self, all_wait)
      class(thread_team_type), intent(inout) :: self
      !> Whether all chunks wait for contact
      logical, intent(in) :: all_wait

      logical :: is_backward

      self%step = self%step + 1
      ! what the last step used last is still in the cache
      is_backward = mod(self%step, 2) == 0
      call self%makers(outer)%begin(is_backward)
      call self%makers(inner)%begin(is_backward)
      call self%movers%begin(is_backward)
      self%is_open = .false.
      self%all_wait = all_wait
   end subroutine begin

   !> Contact is to be done by this thread; no other may ask yet whether it is
   subroutine close_gate(self)
      class(thread_team_type), intent(inout) :: self

      call omp_set_lock(self%gate)
   end subroutine close_gate

   !> Contact is done
   subroutine open_gate(self)
      class(thread_team_type), intent(inout) :: self

      !$omp atomic write seq_cst
      self%is_open = .true.
      call omp_unset_lock(self%gate)
   end subroutine open_gate

   !> Whether contact is done
   logical function has_opened(self)
      class(thread_team_type), intent(in) :: self

      !$omp atomic read seq_cst
      has_opened = self%is_open
   end function has_opened

   !> The next of a list of chunks for this thread; waits for contact when nothing else is left. 0
   !> when nothing is
   integer function take(self, list) result(chunk)
      class(thread_team_type), intent(inout) :: self
      !> `outer` or `inner`
      integer, intent(in) :: list

      if (.not. self%has_opened()) then
         chunk = 0
         if (.not. self%all_wait) chunk = self%makers(list)%take(omp_get_thread_num(), .false.)
         if (chunk > 0) return
         call self%await_contact()
      end if
      chunk = self%makers(list)%take(omp_get_thread_num(), .true.)
   end function take

   !> Wait until contact is done
   subroutine await_contact(self)
      class(thread_team_type), intent(inout) :: self

      call omp_set_lock(self%gate)
      call omp_unset_lock(self%gate)
   end subroutine await_contact

   !> The forces of a chunk are made
   subroutine note_made(self, chunk)
      class(thread_team_type), intent(inout) :: self
      !> The chunk
      integer, intent(in) :: chunk

      integer :: step

      step = self%step
      !$omp atomic write seq_cst
      self%done(made, chunk) = step
   end subroutine note_made

   !> Whether all forces of some chunks are there
   logical function has_forces(self, makers)
      class(thread_team_type), intent(in) :: self
      !> The chunks; 0 for those of other ranks
      integer, intent(in) :: makers(:)

      integer :: i, step

      do i = 1, size(makers)
         !$omp atomic read seq_cst
         step = self%done(made, makers(i))
         has_forces = step == self%step
         if (.not. has_forces) return
      end do
   end function has_forces

   !> A chunk has moved its points ahead of the others
   pure subroutine note_moved(self, chunk)
      class(thread_team_type), intent(inout) :: self
      !> The chunk
      integer, intent(in) :: chunk

      self%done(moved, chunk) = self%step
   end subroutine note_moved

   !> Whether a chunk has; when all forces are made
   pure logical function has_moved(self, chunk)
      class(thread_team_type), intent(in) :: self
      !> The chunk
      integer, intent(in) :: chunk

      has_moved = self%done(moved, chunk) == self%step
   end function has_moved

end module plydyn_method_thread_team
