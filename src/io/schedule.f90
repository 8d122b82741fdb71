!> Instants of output at equal intervals.
module plydyn_io_schedule
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_precision, only : wp
   use plydyn_state_file_positions, only : file_position_type
   implicit none
   private

   !> Share of an interval by which an instant may come too early
   real(wp), parameter :: slack = 1.0e-6_wp

   !> Instants: the first step, then the first step at or after each multiple of the interval
   type, public :: schedule_type
      !> Time between two instants; 0 for every step
      real(wp) :: interval = 0.0_wp
      !> Multiple of the interval that comes next; negative before the first instant
      integer(int64), private :: next = -1_int64
   contains
      procedure :: next_time
      procedure :: advance
      procedure :: mark
      procedure :: resume
   end type schedule_type

contains

   !> Time from which on the next instant has come
   elemental real(wp) function next_time(self)
      class(schedule_type), intent(in) :: self

      next_time = -huge(1.0_wp)
      if (self%interval > 0.0_wp .and. self%next >= 0) then
         next_time = (self%next - slack)*self%interval
      end if
   end function next_time

   !> The instant was used: the next one is later than this time
   elemental subroutine advance(self, time)
      class(schedule_type), intent(inout) :: self
      !> Time now
      real(wp), intent(in) :: time

      if (self%interval > 0.0_wp) self%next = floor(time/self%interval + slack, int64) + 1
   end subroutine advance

   !> Interval and next instant, beside the amount written so far
   elemental type(file_position_type) function mark(self, amount) result(position)
      class(schedule_type), intent(in) :: self
      !> Bytes or states written so far
      integer(int64), intent(in) :: amount

      position = file_position_type(amount=amount, interval=self%interval, next=self%next)
   end function mark

   !> Go on with the instants of an earlier run; with another interval, from its last instant on
   elemental subroutine resume(self, position)
      !> The instants, with their interval
      class(schedule_type), intent(inout) :: self
      !> As from `mark`
      type(file_position_type), intent(in) :: position

      if (abs(position%interval - self%interval) <= 0.0_wp) then
         self%next = position%next
      else if (position%next >= 0) then
         call self%advance(position%interval*(position%next - 1))
      end if
   end subroutine resume

end module plydyn_io_schedule
