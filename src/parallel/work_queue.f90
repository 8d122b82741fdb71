!> Work queue: assigns chunks to threads, with static affinity and stealing.
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
module plydyn_parallel_work_queue
   implicit none
   private

   !> Integers in a line of the cache: counters in different lines avoid false sharing
   integer, parameter, public :: line = 16
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
      procedure :: arrange
      procedure :: begin
      procedure :: take
      procedure :: own
   end type work_queue_type

contains

   !> Assign a range of a list to each thread of the coming parallel regions; `begin` follows
   pure subroutine arrange(self, list, waits, threads)
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
         call put_first(list(first:last), waits, self%list(first:last), self%before(free, t))
         self%before(:, t) = first - 1 + [0, self%before(free, t)]
         self%last(:, t) = [self%before(free, t), last]
      end do
   end subroutine arrange

   !> Put the chunks that wait in front, in their order
   pure subroutine put_first(list, waits, sorted, count)
      integer, intent(in) :: list(:)
      logical, intent(in) :: waits(:)
      integer, intent(out) :: sorted(:)
      !> How many wait
      integer, intent(out) :: count

      integer :: i, next

      next = 0
      do i = 1, size(list)
         if (.not. waits(list(i))) cycle
         next = next + 1
         sorted(next) = list(i)
      end do
      count = next
      do i = 1, size(list)
         if (waits(list(i))) cycle
         next = next + 1
         sorted(next) = list(i)
      end do
   end subroutine put_first

   !> Begin with all chunks in the queue
   pure subroutine begin(self, is_backward)
      class(work_queue_type), intent(inout) :: self
      !> Take the parts from their ends
      logical, intent(in) :: is_backward

      self%taken(:2, :) = self%before
      self%is_backward = is_backward
   end subroutine begin

   !> The next chunk for a thread; 0 when none is left
   integer function take(self, thread, take_waiting) result(chunk)
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
   end function take

   !> A chunk of the range of a thread, taken or not; 0 behind the last
   pure integer function own(self, thread, k) result(chunk)
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
   end function own

end module plydyn_parallel_work_queue
