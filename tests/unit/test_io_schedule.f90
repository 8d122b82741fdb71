!> Instants of output: when they are due, and how they go on after a restart.
program test_io_schedule
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_precision, only : wp
   use plydyn_io_schedule, only : schedule_type
   use plydyn_state_file_positions, only : file_position_type
   use testing, only : begin, check, finish
   implicit none

   call instants()
   call goes_on()
   call finish()

contains

   !> Instants of a schedule against steps that do not divide its interval
   subroutine instants()
      type(schedule_type) :: schedule
      real(wp) :: time
      integer :: k, used

      call begin("schedule")
      schedule = schedule_type(0.1_wp)
      call check(0.0_wp >= schedule%next_time(), "the first call is due")
      call schedule%advance(0.0_wp)
      call check(0.05_wp < schedule%next_time(), "nothing between two instants")
      call check(0.1_wp*(1.0_wp - 1.0e-12_wp) >= schedule%next_time(), "round-off does not delay")
      call schedule%advance(0.1_wp*(1.0_wp - 1.0e-12_wp))
      call check(0.1_wp < schedule%next_time(), "round-off does not repeat")
      call check(0.57_wp >= schedule%next_time(), "a long step is due once")
      call schedule%advance(0.57_wp)
      call check(0.58_wp < schedule%next_time(), "instants passed over are not caught up")
      call check(0.6_wp >= schedule%next_time(), "the next multiple is due")

      ! a thousand steps, summed, are ten intervals
      schedule = schedule_type(1.0_wp)
      time = 0.0_wp
      used = 0
      do k = 0, 1000
         if (time >= schedule%next_time()) then
            used = used + 1
            call schedule%advance(time)
         end if
         time = time + 0.01_wp
      end do
      call check(used, 11, "first and last instants are met")
      schedule = schedule_type(0.0_wp)
      call schedule%advance(1.0_wp)
      call check(1.0_wp >= schedule%next_time(), "an interval of 0 is every call")
   end subroutine instants

   !> The instants of an earlier run
   subroutine goes_on()
      type(file_position_type) :: position
      type(schedule_type) :: other, schedule

      call begin("resume")
      schedule = schedule_type(2.0_wp)
      call schedule%advance(3.0_wp)
      position = schedule%mark(13_int64)
      call check(int(position%amount), 13, "the amount is kept")
      other = schedule_type(2.0_wp)
      call other%resume(position)
      call check(3.5_wp < other%next_time() .and. 4.0_wp >= other%next_time(), "the instants go on")
      other = schedule_type(0.5_wp)
      call other%resume(position)
      call check(2.0_wp < other%next_time() .and. 3.0_wp >= other%next_time(), &
         & "another interval counts from the last instant on")
      other = schedule_type(2.0_wp)
      call other%resume(file_position_type())
      call check(0.0_wp >= other%next_time(), "without an earlier run the first step is due")
   end subroutine goes_on

end program test_io_schedule
