!> Signals of the operating system that ask a run to end: they are caught and looked at later.
!>
!> This module has the only variable of the program outside of any procedure: a handler of signals
!> has no other place to leave its mark.
module plydyn_base_signals
   use, intrinsic :: iso_c_binding, only : c_funloc, c_funptr, c_int
   implicit none
   private

   public :: caught_signal, catch_signals, has_caught_signal

   !> Numbers of the signals on Linux, and their names
   integer(c_int), parameter :: numbers(3) = [15_c_int, 10_c_int, 12_c_int]
   character(*), parameter :: names(3) = [character(7) :: "SIGTERM", "SIGUSR1", "SIGUSR2"]
   !> SIGXFSZ: a file has come to the largest size that is allowed, which whoever writes is told
   integer(c_int), parameter :: file_is_full = 25_c_int

   !> The signal caught last; 0 for none
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

   !> From now on the signals leave a mark, and do nothing else
   subroutine catch_signals()
      type(c_funptr) :: before
      integer :: i

      do i = 1, size(numbers)
         before = c_signal(numbers(i), c_funloc(note_signal))
      end do
      before = c_signal(file_is_full, c_funloc(do_nothing))
   end subroutine catch_signals

   !> Called by the operating system where somebody else hears of it, too
   subroutine do_nothing(number) bind(c)
      !> The signal
      integer(c_int), value :: number

      associate (unused => number)
      end associate
   end subroutine do_nothing

   !> Called by the operating system at any moment
   subroutine note_signal(number) bind(c)
      !> The signal
      integer(c_int), value :: number

      latest = number
   end subroutine note_signal

   !> Whether there was a signal
   logical function has_caught_signal()
      has_caught_signal = latest /= 0
   end function has_caught_signal

   !> Name of the signal caught last, empty without one
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
