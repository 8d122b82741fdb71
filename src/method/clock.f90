!> When something is due: at equal intervals of time, or every so many steps.
module plydyn_method_clock
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_precision, only : wp
   use plydyn_state_file_positions, only : file_position_type
   implicit none
   private

   public :: every_interval, every_steps

   !> Share of an interval by which an instant may come too early
   real(wp), parameter :: slack = 1.0e-6_wp

   !> Instants: the first step, then the first step at or after each multiple of the interval; or
   !> the steps whose number is a multiple
   type, public :: clock_type
      private
      !> Time between two instants; 0 for every step
      real(wp) :: interval = 0.0_wp
      !> Multiple of the interval that comes next; negative before the first instant
      integer(int64) :: next = -1_int64
      !> Steps between two instants; 0 where an interval counts
      integer :: steps = 0
   contains
      procedure :: has_come
      procedure :: advance
      procedure :: mark
      procedure :: resume
   end type clock_type

contains

   !> A clock of time
   elemental type(clock_type) function every_interval(interval) result(self)
      !> Time between two instants; 0 for every step
      real(wp), intent(in) :: interval

      self%interval = interval
   end function every_interval

   !> A clock of steps
   elemental type(clock_type) function every_steps(steps) result(self)
      !> Steps between two instants
      integer, intent(in) :: steps

      self%steps = steps
   end function every_steps

   !> Whether an instant has come
   elemental logical function has_come(self, time, cycle)
      class(clock_type), intent(in) :: self
      !> Time at the end of a step, and number of the step
      real(wp), intent(in) :: time
      integer, intent(in) :: cycle

      if (self%steps > 0) then
         has_come = mod(cycle, self%steps) == 0
      else
         has_come = self%interval <= 0.0_wp .or. self%next < 0
         if (.not. has_come) has_come = time >= (self%next - slack)*self%interval
      end if
   end function has_come

   !> The instant was used: the next one is later than this time
   elemental subroutine advance(self, time)
      class(clock_type), intent(inout) :: self
      !> Time now
      real(wp), intent(in) :: time

      if (self%interval > 0.0_wp) self%next = floor(time/self%interval + slack, int64) + 1
   end subroutine advance

   !> Interval and next instant, beside the amount written so far
   elemental type(file_position_type) function mark(self, amount) result(position)
      class(clock_type), intent(in) :: self
      !> Bytes or states written so far
      integer(int64), intent(in) :: amount

      position = file_position_type(amount=amount, interval=self%interval, next=self%next)
   end function mark

   !> Go on with the instants of an earlier run; with another interval, from its last instant on
   elemental subroutine resume(self, position)
      !> The instants, with their interval
      class(clock_type), intent(inout) :: self
      !> As from `mark`
      type(file_position_type), intent(in) :: position

      if (abs(position%interval - self%interval) <= 0.0_wp) then
         self%next = position%next
      else if (position%next >= 0) then
         call self%advance(position%interval*(position%next - 1))
      end if
   end subroutine resume

end module plydyn_method_clock
