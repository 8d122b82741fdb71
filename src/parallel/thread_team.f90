!> Synchronisation of the threads of a step: assignment of chunks, contact event, progress flags.
!>
!> Thread 0 does contact while the others compute forces of chunks that contact cannot change in the
!> step. Chunks that contact may change wait for the contact event. The accelerations of a chunk are
!> updated as soon as all forces on its points are there: no thread is idle while there is such a
!> chunk.
!>
!> Loops in which all threads share the chunks run from the last chunk down, since thread 0, which
!> is late, then gets the last chunks in all of them: a chunk sums nodes shared with later chunks,
!> and the last ones have the fewest.
!>
!> Every thread begins with a range of the list that is the same in all steps, so that its data are
!> still in the cache of its core. A thread that has finished its range takes chunks that other
!> threads have left. Results do not depend on it: each chunk has its own places for its forces.
!>
!> A list that is taken backward in every second step begins with the chunks used last, which are
!> still in the cache where the whole range does not fit.
!>
!> Some chunks may have to wait. They come first in their range once they need not wait any more,
!> and are passed over until then.
module plydyn_parallel_thread_team
   use omp_lib, only : omp_get_max_threads, omp_get_thread_num, omp_init_lock, omp_lock_kind, &
      & omp_set_lock, omp_unset_lock
   use plydyn_parallel_halo, only : messages_type
   implicit none
   private

   public :: new_thread_team

   !> Integers in a line of the cache: counters in different lines avoid false sharing
   integer, parameter :: line = 16
   !> Parts of a range: chunks that wait, and the others
   integer, parameter :: waiting = 1, free = 2

   !> A list of chunks, and how far each thread has come in its range
   type, public :: work_queue_type
      private
      !> The list; in each range the chunks that wait come first
      integer, allocatable :: list(:)
      !> Places before and at the end of either part of each thread's range, (2, threads)
      integer, allocatable :: before(:, :), last(:, :)
      !> Last place taken of either part, (line, threads)
      integer, allocatable :: taken(:, :)
      !> Whether the parts are taken from their ends
      logical :: is_backward = .false.
   contains
      procedure :: arrange => arrange_queue
      procedure :: begin => begin_queue
      procedure :: take => take_from_queue
      procedure :: own => own_of_queue
   end type work_queue_type

   !> Queues of chunks: those whose forces other ranks need, and the others
   integer, parameter, public :: outer = 1, inner = 2
   integer, parameter :: queues = 2

   !> Progress of a chunk, each in a cache line of its own
   integer, parameter :: forces_done = 1, is_updated = 2

   !> Threads and their chunks
   type, public :: thread_team_type
      !> Chunks whose forces are to be computed, and chunks whose accelerations are to be updated
      type(work_queue_type) :: force_queue(queues), update_queue
      !> Number of threads
      integer, private :: threads = 1
      !> Chunks in the order in which their forces are best computed; so many of them are `outer`
      integer, allocatable, private :: order(:)
      integer, private :: outer_chunks = 0
      !> Whether each chunk waits for contact
      logical, allocatable, private :: waits(:)
      !> Forces, and strains that are averaged, on their way to and from other ranks
      type(messages_type) :: messages, strain_messages
      !> Number of the step, and of the last step in which each chunk has reached `forces_done` and
      !> `is_updated`, (line, 0:chunks); chunk 0 stands for other ranks, which never reach it: all
      !> threads wait for their forces
      integer, private :: step = 0
      integer, allocatable, private :: progress(:, :)
      !> Whether contact is done in this step, and whether all chunks wait for it
      logical, private :: contact_done = .true., all_wait = .false.
      !> Held by thread 0 until contact is done
      integer(omp_lock_kind), private :: contact_event
   contains
      procedure :: set_waiting
      procedure :: begin_step
      procedure :: expect_contact
      procedure :: signal_contact
      procedure :: wait_for_contact
      procedure :: contact_is_done
      procedure :: take
      procedure :: own_chunk
      procedure :: take_update
      procedure :: note_forces
      procedure :: has_forces
      procedure :: note_update
      procedure :: has_update
   end type thread_team_type

contains

   !> Threads with all chunks to do, and no contact to wait for
   subroutine new_thread_team(order, outer_chunks, self)
      !> All chunks, in the order in which their forces are best computed
      integer, intent(in) :: order(:)
      !> How many of them come first because other ranks need their forces
      integer, intent(in) :: outer_chunks
      !> The threads of the coming parallel regions
      type(thread_team_type), intent(out) :: self

      integer :: c, chunks

      chunks = size(order)
      self%threads = omp_get_max_threads()
      self%order = order
      self%outer_chunks = outer_chunks
      allocate (self%progress(line, 0:chunks), source=0)
      allocate (self%waits(chunks), source=.false.)
      call omp_init_lock(self%contact_event)
      call self%update_queue%arrange([(c, c=chunks, 1, -1)], self%waits, self%threads)
      call arrange(self)
      call self%begin_step(.false.)
      self%contact_done = .true.
   end subroutine new_thread_team

   !> Choose the chunks that wait for contact; outside of parallel regions
   pure subroutine set_waiting(self, waits)
      class(thread_team_type), intent(inout) :: self
      !> Whether each chunk waits
      logical, intent(in) :: waits(:)

      ! a single thread does contact before it takes a chunk
      if (self%threads == 1 .or. all(self%waits .eqv. waits)) return
      self%waits(:) = waits
      call arrange(self)
   end subroutine set_waiting

   !> Assign the chunks to the threads
   pure subroutine arrange(self)
      type(thread_team_type), intent(inout) :: self

      associate (first => self%order(self%outer_chunks:1:-1), &
         & rest => self%order(size(self%order):self%outer_chunks + 1:-1))
         call self%force_queue(outer)%arrange(first, self%waits, self%threads)
         call self%force_queue(inner)%arrange(rest, self%waits, self%threads)
      end associate
   end subroutine arrange

   !> Begin a step; outside of parallel regions
   pure subroutine begin_step(self, all_wait)
      class(thread_team_type), intent(inout) :: self
      !> Whether all chunks wait for contact
      logical, intent(in) :: all_wait

      logical :: is_backward

      self%step = self%step + 1
      ! the chunks used last are still in the cache
      is_backward = mod(self%step, 2) == 0
      call self%force_queue(outer)%begin(is_backward)
      call self%force_queue(inner)%begin(is_backward)
      call self%update_queue%begin(is_backward)
      self%contact_done = .false.
      self%all_wait = all_wait
   end subroutine begin_step

   !> This thread will do contact; to be followed by a barrier
   subroutine expect_contact(self)
      class(thread_team_type), intent(inout) :: self

      call omp_set_lock(self%contact_event)
   end subroutine expect_contact

   !> Contact is done
   subroutine signal_contact(self)
      class(thread_team_type), intent(inout) :: self

      !$omp atomic write seq_cst
      self%contact_done = .true.
      call omp_unset_lock(self%contact_event)
   end subroutine signal_contact

   !> Wait until contact is done
   subroutine wait_for_contact(self)
      class(thread_team_type), intent(inout) :: self

      call omp_set_lock(self%contact_event)
      call omp_unset_lock(self%contact_event)
   end subroutine wait_for_contact

   !> Whether contact is done
   logical function contact_is_done(self)
      class(thread_team_type), intent(in) :: self

      !$omp atomic read seq_cst
      contact_is_done = self%contact_done
   end function contact_is_done

   !> The next chunk of a queue of forces for this thread; waits for contact when no other chunk is
   !> left. 0 when there is none
   integer function take(self, queue) result(chunk)
      class(thread_team_type), intent(inout) :: self
      !> `outer` or `inner`
      integer, intent(in) :: queue

      if (.not. self%contact_is_done()) then
         chunk = 0
         if (.not. self%all_wait) then
            chunk = self%force_queue(queue)%take(omp_get_thread_num(), .false.)
         end if
         if (chunk > 0) return
         call self%wait_for_contact()
      end if
      chunk = self%force_queue(queue)%take(omp_get_thread_num(), .true.)
   end function take

   !> A chunk that this thread is the first to update, taken or not; 0 behind the last
   integer function own_chunk(self, k) result(chunk)
      class(thread_team_type), intent(in) :: self
      !> Which, from 1
      integer, intent(in) :: k

      chunk = self%update_queue%own(omp_get_thread_num(), k)
   end function own_chunk

   !> The next chunk to update for this thread, once contact is done; 0 when there is none
   integer function take_update(self) result(chunk)
      class(thread_team_type), intent(inout) :: self

      chunk = self%update_queue%take(omp_get_thread_num(), .true.)
   end function take_update

   !> The forces of a chunk are computed
   subroutine note_forces(self, chunk)
      class(thread_team_type), intent(inout) :: self
      !> The chunk
      integer, intent(in) :: chunk

      integer :: step

      step = self%step
      !$omp atomic write seq_cst
      self%progress(forces_done, chunk) = step
   end subroutine note_forces

   !> Whether the forces of some chunks are computed
   logical function has_forces(self, chunks)
      class(thread_team_type), intent(in) :: self
      !> The chunks; 0 for those of other ranks
      integer, intent(in) :: chunks(:)

      integer :: i, step

      do i = 1, size(chunks)
         !$omp atomic read seq_cst
         step = self%progress(forces_done, chunks(i))
         has_forces = step == self%step
         if (.not. has_forces) return
      end do
   end function has_forces

   !> A chunk is updated before the forces of all others are computed
   pure subroutine note_update(self, chunk)
      class(thread_team_type), intent(inout) :: self
      !> The chunk
      integer, intent(in) :: chunk

      self%progress(is_updated, chunk) = self%step
   end subroutine note_update

   !> Whether a chunk is; once the forces of all chunks are computed
   pure logical function has_update(self, chunk)
      class(thread_team_type), intent(in) :: self
      !> The chunk
      integer, intent(in) :: chunk

      has_update = self%progress(is_updated, chunk) == self%step
   end function has_update

   !> Assign a range of a list to each thread of the coming parallel regions; `begin` follows
   pure subroutine arrange_queue(self, list, waits, threads)
      class(work_queue_type), intent(inout) :: self
      !> The chunks
      integer, intent(in) :: list(:)
      !> Whether each of all chunks waits
      logical, intent(in) :: waits(:)
      !> How many threads there are; the same at all calls
      integer, intent(in) :: threads

      integer :: first, last, t

      if (.not. allocated(self%list)) then
         allocate (self%before(2, 0:threads - 1), self%last(2, 0:threads - 1))
         allocate (self%taken(line, 0:threads - 1), self%list(size(list)))
      end if
      last = 0
      do t = 0, threads - 1
         first = last + 1
         ! as with `schedule(static)`
         last = last + size(list)/threads + merge(1, 0, t < mod(size(list), threads))
         ! those that wait in front, all in their order
         associate (own => list(first:last))
            self%list(first:last) = [pack(own, waits(own)), pack(own, .not. waits(own))]
            self%before(:, t) = first - 1 + [0, count(waits(own))]
         end associate
         self%last(:, t) = [self%before(free, t), last]
      end do
   end subroutine arrange_queue

   !> Begin with all chunks in the queue
   pure subroutine begin_queue(self, is_backward)
      class(work_queue_type), intent(inout) :: self
      !> Take the parts from their ends
      logical, intent(in) :: is_backward

      self%taken(:2, :) = self%before
      self%is_backward = is_backward
   end subroutine begin_queue

   !> The next chunk for a thread; 0 when none is left
   integer function take_from_queue(self, thread, take_waiting) result(chunk)
      class(work_queue_type), intent(inout) :: self
      !> The thread, from 0
      integer, intent(in) :: thread
      !> Whether the chunks that wait may be taken too
      logical, intent(in) :: take_waiting

      integer :: k, part, place, t

      do k = 0, size(self%last, 2) - 1
         t = mod(thread + k, size(self%last, 2))
         do part = merge(waiting, free, take_waiting), free
            !$omp atomic capture
            self%taken(part, t) = self%taken(part, t) + 1
            place = self%taken(part, t)
            !$omp end atomic
            if (place > self%last(part, t)) cycle
            if (self%is_backward) place = self%before(part, t) + 1 + self%last(part, t) - place
            chunk = self%list(place)
            return
         end do
      end do
      chunk = 0
   end function take_from_queue

   !> A chunk of the range of a thread, taken or not; 0 behind the last
   pure integer function own_of_queue(self, thread, k) result(chunk)
      class(work_queue_type), intent(in) :: self
      !> The thread, from 0
      integer, intent(in) :: thread
      !> Which, from 1
      integer, intent(in) :: k

      integer :: place

      chunk = 0
      place = self%before(waiting, thread) + k
      if (place > self%last(free, thread)) return
      if (self%is_backward) place = self%last(free, thread) + 1 - k
      chunk = self%list(place)
   end function own_of_queue

end module plydyn_parallel_thread_team
