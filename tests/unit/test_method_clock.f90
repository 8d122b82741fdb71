!> When something is due, and how its instants go on after a restart.
program test_method_clock
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_precision, only : wp
   use plydyn_method_clock, only : clock_type, every_interval, every_steps
   use plydyn_state_file_positions, only : file_position_type
   use testing, only : begin, check, finish
   implicit none

   call instants()
   call multiples()
   call goes_on()
   call finish()

contains

   !> Instants against steps that do not divide the interval
   subroutine instants()
      type(clock_type) :: clock
      real(wp) :: time
      integer :: k, used

      call begin("every_interval")
      clock = every_interval(0.1_wp)
      call check(clock%has_come(0.0_wp, 0), "the first call is due")
      call clock%advance(0.0_wp)
      call check(.not. clock%has_come(0.05_wp, 1), "nothing between two instants")
      call check(clock%has_come(0.1_wp*(1.0_wp - 1.0e-12_wp), 2), "round-off does not delay")
      call clock%advance(0.1_wp*(1.0_wp - 1.0e-12_wp))
      call check(.not. clock%has_come(0.1_wp, 3), "round-off does not repeat")
      call check(clock%has_come(0.57_wp, 4), "a long step is due once")
      call clock%advance(0.57_wp)
      call check(.not. clock%has_come(0.58_wp, 5), "instants passed over are not caught up")
      call check(clock%has_come(0.6_wp, 6), "the next multiple is due")

      ! a thousand steps, summed, are ten intervals
      clock = every_interval(1.0_wp)
      time = 0.0_wp
      used = 0
      do k = 0, 1000
         if (clock%has_come(time, k)) then
            used = used + 1
            call clock%advance(time)
         end if
         time = time + 0.01_wp
      end do
      call check(used, 11, "first and last instants are met")
      clock = every_interval(0.0_wp)
      call clock%advance(1.0_wp)
      call check(clock%has_come(1.0_wp, 1), "an interval of 0 is every call")
   end subroutine instants

   !> Steps whose numbers are multiples
   subroutine multiples()

      call begin("every_steps")
      associate (clock => every_steps(16))
         call check(.not. clock%has_come(0.0_wp, 15), "the step before a multiple")
         call check(clock%has_come(0.0_wp, 16), "a multiple")
         call check(.not. clock%has_come(1.0e9_wp, 17), "whatever the time")
      end associate
   end subroutine multiples

   !> The instants of an earlier run
   subroutine goes_on()
      type(file_position_type) :: position
      type(clock_type) :: clock, other

      call begin("resume")
      clock = every_interval(2.0_wp)
      call clock%advance(3.0_wp)
      position = clock%mark(13_int64)
      call check(int(position%amount), 13, "the amount is kept")
      other = every_interval(2.0_wp)
      call other%resume(position)
      call check(.not. other%has_come(3.5_wp, 1) .and. other%has_come(4.0_wp, 2), &
         & "the instants go on")
      other = every_interval(0.5_wp)
      call other%resume(position)
      call check(.not. other%has_come(2.0_wp, 1) .and. other%has_come(3.0_wp, 2), &
         & "another interval counts from the last instant on")
      other = every_interval(2.0_wp)
      call other%resume(file_position_type())
      call check(other%has_come(0.0_wp, 0), "without an earlier run the first step is due")
   end subroutine goes_on

end program test_method_clock
