!> Signals are caught and named.
program test_base_signals
   use, intrinsic :: iso_c_binding, only : c_int
   use plydyn_base_signals, only : catch_signals, caught_signal, has_caught_signal
   use testing, only : begin, check, finish
   implicit none

   interface
      integer(c_int) function c_raise(number) bind(c, name="raise")
         import :: c_int
         implicit none
         integer(c_int), value :: number
      end function c_raise
   end interface

   integer(c_int) :: status

   call begin("catch_signals")
   call catch_signals()
   call check(caught_signal() == "" .and. .not. has_caught_signal(), "none at first")
   status = c_raise(10_c_int)
   call check(status == 0 .and. caught_signal() == "SIGUSR1", "the one that batch systems send")
   status = c_raise(15_c_int)
   call check(status == 0 .and. caught_signal() == "SIGTERM", "the one of kill")
   call finish()

end program test_base_signals
