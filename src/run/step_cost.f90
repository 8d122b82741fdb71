!> The cost of a step, measured before a run.
module plydyn_run_step_cost
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_method_observer, only : observers_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_run_loop, only : run
   implicit none
   private

   public :: seconds_per_step

   !> Steps of a trial: those that warm up, and the most that are measured
   integer, parameter :: first_steps = 3, most_steps = 40
   !> Processor time that a trial should take on each thread, seconds
   real(wp), parameter :: enough = 0.1_wp

contains

   !> Processor time of a thread in a step, of some steps from the state on without any output. It
   !> is that on the clock where the threads have a core each, and other jobs do not disturb it
   real(wp) function seconds_per_step(simulation) result(seconds)
      !> As it was, on return
      class(simulation_type), intent(inout) :: simulation

      integer :: steps

      seconds = seconds_of_steps(simulation, first_steps)
      steps = min(most_steps, int(enough/max(seconds, tiny(seconds))))
      if (steps > first_steps) seconds = seconds_of_steps(simulation, steps)
   end function seconds_per_step

   !> Mean processor time of a thread in some steps, which are not kept: that of the slowest rank
   real(wp) function seconds_of_steps(simulation, steps) result(seconds)
      class(simulation_type), intent(inout) :: simulation
      !> Steps from the state on; fewer where the run ends before
      integer, intent(in) :: steps

      type(error_type), allocatable :: error
      type(observers_type) :: observers
      type(simulation_type) :: trial
      real(wp) :: most(1), now, then

      call observers%start("")
      trial%contacts = simulation%contacts
      trial%state = simulation%state
      trial%state%end%cycle = trial%state%cycle + steps
      call move_alloc(simulation%domain, trial%domain)
      call cpu_time(then)
      call run(trial, observers, error)
      call cpu_time(now)
      call move_alloc(trial%domain, simulation%domain)
      ! all ranks must make the same number of steps in the next trial
      most(1) = now - then
      call simulation%domain%comm%max(most)
      seconds = most(1)/real(max(1, trial%state%cycle - simulation%state%cycle) &
         & *simulation%domain%control%threads, wp)
   end function seconds_of_steps

end module plydyn_run_step_cost
