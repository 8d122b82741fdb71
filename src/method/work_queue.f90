!> Whose turn it is: which thread takes which of a list of chunks.
!>
!> Every thread begins with a stretch of the list that is the same in all steps, so that what it
!> needs is still in the cache of its core. One that has come to the end of its own takes of what
!> the others have left. The chunks say where their forces go: who takes them changes no bit.
!>
!> A list that is taken backward in every second step begins with what was used last, which is in
!> the cache still where the whole stretch does not fit.
!>
!> Some chunks may have to wait. They are the first of their stretch once they need not any more,
!> and are passed over until then.
module plydyn_method_work_queue
   implicit none
   private

   !> Integers in a line of the cache: threads do not wait for each other's counters
   integer, parameter, public :: line = 16
   !> Parts of a stretch: chunks that wait, and the others
   integer, parameter :: waiting = 1, free = 2

   !> What is left of a list
   type, public :: work_queue_type
      private
      !> The list; first in each stretch what waits
      integer, allocatable :: list(:)
      !> Places before and at the end of either part of each thread's stretch, (2, threads)
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

   !> Give each thread of the coming parallel regions a stretch of a list; then `begin`
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

   !> Put those that wait in front, in their order
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

   !> Nothing is taken any more
   pure subroutine begin(self, is_backward)
      class(work_queue_type), intent(inout) :: self
      !> Take the parts from their ends
      logical, intent(in) :: is_backward

      self%taken(:2, :) = self%before
      self%is_backward = is_backward
   end subroutine begin

   !> The next chunk for a thread; 0 when nothing is left
   integer function take(self, thread, is_open) result(chunk)
      class(work_queue_type), intent(inout) :: self
      !> The thread, from 0
      integer, intent(in) :: thread
      !> Whether the chunks that wait may be taken too
      logical, intent(in) :: is_open

      integer :: k, part, place, t

      do k = 0, size(self%last, 2) - 1
         t = mod(thread + k, size(self%last, 2))
         do part = merge(waiting, free, is_open), free
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

   !> Some chunk of the stretch of a thread, taken or not; 0 behind the last
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

end module plydyn_method_work_queue
