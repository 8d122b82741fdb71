!> Whose turn it is: which thread takes which of a list of chunks.
!>
!> Every thread begins with a stretch of the list that is the same in all steps, so that what it
!> needs is still in the cache of its core. One that has come to the end of its own takes of what
!> the others have left. The chunks say where their forces go: who takes them changes no bit.
module plydyn_solver_turns
   use omp_lib, only : omp_get_max_threads
   implicit none
   private

   public :: deal

   !> Integers in a line of the cache: threads do not wait for each other's counters
   integer, parameter :: line = 16

   !> What is left of a list
   type, public :: turns_type
      private
      !> Last one taken of the stretch of each thread, (line, threads), and the last there is
      integer, allocatable :: taken(:, :), last(:)
   contains
      procedure :: take
   end type turns_type

contains

   !> Deal a list out to the threads of the next parallel region
   subroutine deal(self, first, last)
      !> The turns; allocated at the first call with so many threads
      type(turns_type), intent(inout) :: self
      !> First and last place in the list
      integer, intent(in) :: first, last

      integer :: length, t, threads

      threads = omp_get_max_threads()
      if (allocated(self%last)) then
         if (size(self%last) /= threads) deallocate (self%taken, self%last)
      end if
      if (.not. allocated(self%last)) then
         allocate (self%taken(line, 0:threads - 1), self%last(0:threads - 1))
      end if
      length = max(last - first + 1, 0)
      do t = 0, threads - 1
         self%taken(1, t) = first - 1 + stretch(length, threads, t)
         self%last(t) = first - 1 + stretch(length, threads, t + 1)
      end do
   end subroutine deal

   !> Where the stretch of a thread ends, those before it: as with `schedule(static)`
   pure integer function stretch(length, threads, t)
      integer, intent(in) :: length, threads, t

      stretch = (length/threads)*t + min(t, mod(length, threads))
   end function stretch

   !> The next place for a thread; 0 when nothing is left
   integer function take(self, thread) result(place)
      class(turns_type), intent(inout) :: self
      !> The thread, from 0
      integer, intent(in) :: thread

      integer :: k, t

      do k = 0, size(self%last) - 1
         t = mod(thread + k, size(self%last))
         !$omp atomic capture
         self%taken(1, t) = self%taken(1, t) + 1
         place = self%taken(1, t)
         !$omp end atomic
         if (place <= self%last(t)) return
      end do
      place = 0
   end function take

end module plydyn_solver_turns
