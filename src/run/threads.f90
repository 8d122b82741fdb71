!> Threads of a run. Results are the same to the last bit for any number of them.
module plydyn_run_threads
   use omp_lib, only : omp_get_max_threads, omp_get_num_procs, omp_set_dynamic, &
      & omp_set_num_threads
   implicit none
   private

   public :: choose_threads, most_threads, set_threads

contains

   !> Number of threads: from the command line, else the deck, else OMP_NUM_THREADS, else one
   integer function choose_threads(command, deck) result(threads)
      !> Threads that the command line and the deck ask for; 0 for no request
      integer, intent(in) :: command, deck

      integer :: length

      threads = 1
      call get_environment_variable("OMP_NUM_THREADS", length=length)
      if (length > 0) threads = omp_get_max_threads()
      if (deck > 0) threads = deck
      if (command > 0) threads = command
   end function choose_threads

   !> Most threads that a run may ask for: more take memory and only slow each other down
   integer function most_threads()
      !> For each processor, and on machines of few
      integer, parameter :: per_processor = 16, at_least = 256

      most_threads = max(at_least, per_processor*omp_get_num_procs())
   end function most_threads

   !> Let the loops run on so many threads
   subroutine set_threads(threads)
      !> How many
      integer, intent(in) :: threads

      call omp_set_dynamic(.false.)
      call omp_set_num_threads(threads)
   end subroutine set_threads

end module plydyn_run_threads
