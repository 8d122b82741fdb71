!> The explicit impact solver: the loop.
module plydyn_run_loop
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_accelerations, only : begin_accelerations, can_go_ahead, &
      & count_accelerations, find_accelerations
   use plydyn_method_contact_step, only : contacts_type
   use plydyn_method_thread_team, only : thread_team_type, new_thread_team
   use plydyn_method_energy, only : balance, begin_work, change_step
   use plydyn_run_stability_monitor, only : check_health
   use plydyn_run_output_manager, only : output_manager_type
   use plydyn_method_central_difference, only : advance, step_back
   use plydyn_method_supports, only : move_supports
   use plydyn_run_run_control, only : run_control_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: run, seconds_per_step

   !> Share of a step by which the last one may be stretched to end the run on time
   real(wp), parameter :: stretch = 1.0e-6_wp

contains

   !> From the state at time zero, or from where a run was left, to the end
   subroutine run(domain, contacts, state, journal, run_control, error)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Contacts and their work space
      type(contacts_type), intent(inout) :: contacts
      !> The state
      type(state_type), intent(inout) :: state
      !> What writes the results
      type(output_manager_type), intent(inout) :: journal
      !> What looks after the run
      type(run_control_type), intent(inout) :: run_control
      !> What stopped the run
      type(error_type), allocatable, intent(out) :: error

      type(thread_team_type) :: team

      call new_thread_team(domain, team)
      if (state%cycle == 0) then
         call begin_accelerations(domain, state)
         call balance(domain, state)
         state%energies%start = state%energies%kinetic + state%energies%impactor
         call journal%begin(domain, state, error)
         if (allocated(error)) return
      end if
      ! nobody has said yet what is due after the first step
      state%halts = .true.

      do while (.not. state%is_finished())
         call begin_step(domain, contacts, team, state)
         !$omp parallel default(shared)
         !$omp master
         call team%close()
         !$omp end master
         !$omp barrier
         ! motion, where it was not made with the accelerations
         if (.not. state%is_ahead) call advance(domain, state)
         !$omp master
         call move_supports(domain, state)
         ! contact: trial position, multipliers, correction (the paper's eqs 12 to 17)
         call contacts%enforce(domain, state)
         call begin_work(domain, state)
         call end_step(state)
         call team%open()
         !$omp end master
         ! forces over masses (eq. 6); of chunks that contact does not reach beside it
         call find_accelerations(domain, team, state%step, state)
         !$omp end parallel
         call count_accelerations(domain, state)
         state%is_ahead = state%goes_ahead

         ! energies, and what is to be written
         call journal%announce(state)
         call run_control%announce(state)
         call balance(domain, state)
         call journal%record(domain, state, error)
         if (allocated(error)) exit
         call check_health(domain, state, error)
         if (allocated(error)) then
            call step_back(domain, state)
            call journal%conclude(domain, state)
            exit
         end if
         call run_control%look(domain, contacts, state, journal, error)
         if (allocated(error)) exit
      end do
      if (allocated(error)) call step_back(domain, state)
   end subroutine run

   !> What is known of a step before it: how long it is, and the one after it; the impactors without
   !> contact; the chunks that must wait for contact
   subroutine begin_step(domain, contacts, team, state)
      !> As in `run`
      type(domain_type), intent(in) :: domain
      type(contacts_type), intent(inout) :: contacts
      !> The threads
      type(thread_team_type), intent(inout) :: team
      type(state_type), intent(inout) :: state

      state%step = next_step(domain, state, state%time, state%cycle)
      if (state%cycle == 0) state%first_step = state%step
      state%step_after = next_step(domain, state, state%time + state%step, state%cycle + 1)
      state%goes_ahead = can_go_ahead(domain) .and. .not. state%halts
      call change_step(domain, state)
      call contacts%approach(domain, state)
      call team%let_wait(domain, contacts%reached)
      call team%begin(contacts%reaches_all)
   end subroutine begin_step

   !> The step to come is made
   pure subroutine end_step(state)
      !> Time, number of steps, and the step just made
      type(state_type), intent(inout) :: state

      state%time = state%time + state%step
      state%cycle = state%cycle + 1
      state%step_before = state%step
   end subroutine end_step

   !> The share of the stable step that the deck allows, and no step beyond the end. The last two
   !> steps share what is left: contact that closes a gap within a tiny step would push too hard.
   real(wp) function next_step(domain, state, time, cycle) result(step)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The state; says when the run ends
      type(state_type), intent(in) :: state
      !> Time at which the step begins, and number of steps before it
      real(wp), intent(in) :: time
      integer, intent(in) :: cycle

      real(wp) :: left

      associate (control => domain%control)
         step = domain%step
         if (cycle == 0 .and. control%first_step > 0.0_wp) then
            step = min(step, control%first_step)
         end if
         if (control%step_curve > 0) then
            step = min(step, domain%curves(control%step_curve)%at(time))
         end if
         left = state%end_time - time
         if (left <= step*(1.0_wp + stretch)) then
            step = left
         else if (left < 2.0_wp*step) then
            step = 0.5_wp*left
         end if
      end associate
   end function next_step

   !> Time on the wall of one evaluation of the accelerations, the better of a few
   real(wp) function seconds_per_step(domain, state) result(seconds)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The state at the start
      type(state_type), intent(in) :: state

      integer, parameter :: tries = 3
      type(state_type) :: copy
      integer(int64) :: now, rate, then
      integer :: i

      copy = state
      seconds = huge(1.0_wp)
      do i = 1, tries
         call system_clock(then, rate)
         call begin_accelerations(domain, copy)
         call system_clock(now)
         seconds = min(seconds, real(now - then, wp)/real(rate, wp))
      end do
   end function seconds_per_step

end module plydyn_run_loop
