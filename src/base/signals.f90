!> Handling of signals that request the end of a run.
!>
!> A handler only stores the number of the signal; run control reads it between steps. The module
!> variable is the only one of the program: a signal handler takes no other arguments.
module plydyn_base_signals
   use, intrinsic :: iso_c_binding, only : c_funloc, c_funptr, c_int, c_intptr_t
   implicit none
   private

   public :: caught_signal, catch_signals, has_caught_signal

   !> The terminal was closed
   integer(c_int), parameter :: hung_up = 1_c_int
   !> Numbers of the signals on Linux, and their names
   integer(c_int), parameter :: numbers(4) = [15_c_int, 10_c_int, 12_c_int, hung_up]
   character(*), parameter :: names(4) = [character(7) :: "SIGTERM", "SIGUSR1", "SIGUSR2", "SIGHUP"]
   !> SIG_IGN: how a signal is ignored
   integer(c_intptr_t), parameter :: ignored = 1_c_intptr_t
   !> SIGXFSZ: a file has reached the largest size allowed; the write fails with an error
   integer(c_int), parameter :: file_size_exceeded = 25_c_int
   !> SIGPIPE: the reader of what the run prints has ended, as in `plydyn run DECK | head`; results
   !> do not depend on it
   integer(c_int), parameter :: broken_pipe = 13_c_int

   !> Last signal caught; 0 for none
   integer(c_int), volatile :: latest = 0_c_int

   interface
      type(c_funptr) function c_signal(number, handler) bind(c, name="signal")
         import :: c_funptr, c_int
         implicit none
         integer(c_int), value :: number
         type(c_funptr), value :: handler
      end function c_signal
   end interface

contains

   !> Install the signal handlers. A closed terminal means nothing to a run that nohup has started
   subroutine catch_signals()
      type(c_funptr) :: previous
      integer :: i

      do i = 1, size(numbers)
         previous = c_signal(numbers(i), c_funloc(store_signal))
         if (numbers(i) == hung_up .and. transfer(previous, ignored) == ignored) then
            previous = c_signal(hung_up, previous)
         end if
      end do
      previous = c_signal(file_size_exceeded, transfer(ignored, previous))
      previous = c_signal(broken_pipe, transfer(ignored, previous))
   end subroutine catch_signals

   !> Handler: store the signal
   subroutine store_signal(number) bind(c)
      !> The signal
      integer(c_int), value :: number

      latest = number
   end subroutine store_signal

   !> Whether a signal has been caught
   logical function has_caught_signal()
      has_caught_signal = latest /= 0
   end function has_caught_signal

   !> Name of the last signal caught, empty without one
   function caught_signal() result(name)
      character(:), allocatable :: name

      integer(c_int) :: now
      integer :: i

      name = ""
      now = latest
      if (now == 0) return
      do i = 1, size(numbers)
         if (numbers(i) == now) name = trim(names(i))
      end do
   end function caught_signal

end module plydyn_base_signals
