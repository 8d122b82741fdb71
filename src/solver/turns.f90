!> Whose turn it is: which thread takes which of a list of chunks.
!>
!> Every thread begins with a stretch of the list that is the same in all steps, so that what it
!> needs is still in the cache of its core. One that has come to the end of its own takes of what
!> the others have left. The chunks say where their forces go: who takes them changes no bit.
!>
!> Some chunks may have to wait. They are the first of their stretch once they need not any more,
!> and are passed over until then.
module plydyn_solver_turns
   use omp_lib, only : omp_get_max_threads
   implicit none
   private

   !> Integers in a line of the cache: threads do not wait for each other's counters
   integer, parameter :: line = 16
   !> Parts of a stretch: chunks that wait, and the others
   integer, parameter :: waiting = 1, free = 2

   !> What is left of a list
   type, public :: turns_type
      private
      !> The list; first in each stretch what waits
      integer, allocatable :: list(:)
      !> Places before and at the end of either part of each thread's stretch, (2, threads)
      integer, allocatable :: before(:, :), last(:, :)
      !> Last place taken of either part, (line, threads)
      integer, allocatable :: taken(:, :)
   contains
      procedure :: arrange
      procedure :: begin
      procedure :: take
      procedure :: own
   end type turns_type

contains

   !> Give each thread of the coming parallel regions a stretch of a list; then `begin`
   subroutine arrange(self, list, waits)
      class(turns_type), intent(out) :: self
      !> The chunks
      integer, intent(in) :: list(:)
      !> Whether each of all chunks waits
      logical, intent(in) :: waits(:)

      integer :: first, last, t, threads

      threads = omp_get_max_threads()
      allocate (self%before(2, 0:threads - 1), self%last(2, 0:threads - 1))
      allocate (self%taken(line, 0:threads - 1))
      self%list = list
      last = 0
      do t = 0, threads - 1
         first = last + 1
         ! as with `schedule(static)`
         last = last + size(list)/threads + merge(1, 0, t < mod(size(list), threads))
         associate (own => list(first:last))
            self%list(first:last) = [pack(own, waits(own)), pack(own, .not. waits(own))]
            self%before(:, t) = first - 1 + [0, count(waits(own))]
         end associate
         self%last(:, t) = [self%before(free, t), last]
      end do
   end subroutine arrange

   !> Nothing is taken any more
   pure subroutine begin(self)
      class(turns_type), intent(inout) :: self

      self%taken(:2, :) = self%before
   end subroutine begin

   !> The next chunk for a thread; 0 when nothing is left
   integer function take(self, thread, is_open) result(chunk)
      class(turns_type), intent(inout) :: self
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
            chunk = self%list(place)
            return
         end do
      end do
      chunk = 0
   end function take

   !> Some chunk of the stretch of a thread, taken or not; 0 behind the last
   pure integer function own(self, thread, k) result(chunk)
      class(turns_type), intent(in) :: self
      !> The thread, from 0
      integer, intent(in) :: thread
      !> Which, from 1
      integer, intent(in) :: k

      chunk = 0
      associate (place => self%before(waiting, thread) + k)
         if (place <= self%last(free, thread)) chunk = self%list(place)
      end associate
   end function own

end module plydyn_solver_turns
