!> The cost of a step, measured before a run.
module plydyn_run_step_cost
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_accelerations, only : begin_accelerations
   use plydyn_method_global_reduction, only : global_reduction_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: seconds_per_step

contains

   !> Wall-clock time of one evaluation of the accelerations, the best of a few
   real(wp) function seconds_per_step(domain, state) result(seconds)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The state at the start
      type(state_type), intent(in) :: state

      integer, parameter :: tries = 3
      integer(int64) :: now, rate, then
      integer :: i
      type(global_reduction_type) :: reduction
      type(state_type) :: copy

      copy = state
      seconds = huge(1.0_wp)
      do i = 1, tries
         call system_clock(then, rate)
         call begin_accelerations(domain, copy, reduction)
         call system_clock(now)
         seconds = min(seconds, real(now - then, wp)/real(rate, wp))
      end do
   end function seconds_per_step

end module plydyn_run_step_cost
