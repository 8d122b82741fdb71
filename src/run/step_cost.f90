!> The costs of a step and of a line of energies, measured before a run.
module plydyn_run_step_cost
   use plydyn_base_error, only : error_type
   use plydyn_base_memory, only : copy_pages
   use plydyn_base_precision, only : wp
   use plydyn_io_listing_effort, only : cost_type
   use plydyn_method_element_balance, only : balance_of, element_balance_type
   use plydyn_method_observer, only : observers_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_run_loop, only : run
   implicit none
   private

   public :: measure_cost

   !> Steps of a short trial, and the least and the most that a long one has more
   integer, parameter :: short = 3, least_more = 4, most_more = 400
   !> Processor time that the others should take on each thread, seconds
   real(wp), parameter :: enough = 0.2_wp
   !> Lines of energies that are timed, the first of them to warm up
   integer, parameter :: lines = 3

contains

   !> What a step and a line of energies take
   type(cost_type) function measure_cost(simulation) result(cost)
      !> As it was, on return
      class(simulation_type), intent(inout) :: simulation

      cost%step = seconds_per_step(simulation)
      cost%energies = seconds_per_line(simulation)
   end function measure_cost

   !> Processor time of a thread in a line of energies, whose sums run over all Gauss points
   real(wp) function seconds_per_line(simulation) result(seconds)
      class(simulation_type), intent(in) :: simulation

      type(element_balance_type) :: balance
      integer :: i
      real(wp) :: most(1), now, then

      do i = 1, lines
         if (i == 2) call cpu_time(then)
         balance = balance_of(simulation%domain, simulation%state)
      end do
      call cpu_time(now)
      most(1) = now - then
      call simulation%domain%comm%max(most)
      seconds = most(1)/((lines - 1)*simulation%domain%control%threads)
   end function seconds_per_line

   !> Processor time of a thread in a step, of some steps from the state on without any output. It
   !> is that on the clock where the threads have a core each, and other jobs do not disturb it
   real(wp) function seconds_per_step(simulation) result(seconds)
      !> As it was, on return
      class(simulation_type), intent(inout) :: simulation

      integer :: made(2)
      real(wp) :: spent(2)

      ! what begins a trial takes as long as some steps: it is in both, and the first one warms up
      call try_steps(simulation, short, made(1), spent(1))
      call try_steps(simulation, short, made(1), spent(1))
      seconds = spent(1)/max(1, made(1))
      call try_steps(simulation, short + min(most_more, max(least_more, &
         & int(enough/max(seconds, tiny(seconds))))), made(2), spent(2))
      seconds = spent(2)/max(1, made(2))
      if (made(2) > made(1) .and. spent(2) > spent(1)) then
         seconds = (spent(2) - spent(1))/(made(2) - made(1))
      end if
   end function seconds_per_step

   !> Make some steps that are not kept
   subroutine try_steps(simulation, steps, made, seconds)
      class(simulation_type), intent(inout) :: simulation
      !> Steps from the state on, and how many there are before the run ends
      integer, intent(in) :: steps
      integer, intent(out) :: made
      !> Processor time of a thread, of the slowest rank
      real(wp), intent(out) :: seconds

      type(error_type), allocatable :: error
      type(observers_type) :: observers
      type(simulation_type) :: trial
      real(wp), allocatable :: history(:)
      real(wp) :: most(1), now, then

      call observers%start("")
      trial%contacts = simulation%contacts
      call move_alloc(simulation%state%history, history)
      trial%state = simulation%state
      call copy_pages(history, trial%state%history)
      call move_alloc(history, simulation%state%history)
      trial%state%end%cycle = trial%state%cycle + steps
      call move_alloc(simulation%domain, trial%domain)
      call cpu_time(then)
      call run(trial, observers, error)
      call cpu_time(now)
      call move_alloc(trial%domain, simulation%domain)
      ! all ranks must make the same number of steps in the next trial
      most(1) = now - then
      call simulation%domain%comm%max(most)
      made = trial%state%cycle - simulation%state%cycle
      seconds = most(1)/simulation%domain%control%threads
   end subroutine try_steps

end module plydyn_run_step_cost
