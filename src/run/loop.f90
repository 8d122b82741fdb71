!> The explicit impact solver: the loop over the steps (de Borst et al., 2012).
module plydyn_run_loop
   use plydyn_base_error, only : error_type
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_accelerations, only : add_motion_sums, begin_accelerations, prepare_step, &
      & update_accelerations
   use plydyn_method_central_difference, only : predict, undo_prediction
   use plydyn_method_energy, only : global_reduction_type, measure_energies, update_bodies, &
      & update_energies
   use plydyn_method_forces, only : add_external_power
   use plydyn_method_observer, only : observers_type, requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_method_step_control, only : choose_step, control_step
   use plydyn_method_supports, only : prescribe_motion
   use plydyn_method_workspace, only : new_workspace, workspace_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: run

contains

   !> From the state at time zero, or of a restart file, to the end
   subroutine run(simulation, observers, error)
      !> Its state and its contacts change
      class(simulation_type), intent(inout) :: simulation
      !> Observers of the run
      type(observers_type), intent(inout) :: observers
      !> Reason for an end before its time
      type(error_type), allocatable, intent(out) :: error

      type(global_reduction_type) :: reduction
      type(requests_type) :: requests
      type(workspace_type) :: work

      associate (domain => simulation%domain, contacts => simulation%contacts, &
         & state => simulation%state)
         if (state%cycle == 0) then
            call start(domain, state, reduction)
            call observers%begin(simulation, error)
            if (allocated(error)) return
         end if
         call reduction%expect_bodies(domain%contact)
         call new_workspace(domain, state, work)

         do while (.not. state%is_finished())
            call choose_step(domain, state)
            call contacts%predict(domain, reduction, state)   ! impactors
            call prepare_step(domain, contacts, state, observers%read_motion(state), work)
            call reduction%clear()

            !$omp parallel default(shared)
            call predict(domain, work, state)                             ! eq. 15
            !$omp master
            call prescribe_motion(domain, state, work%constraints, reduction)
            call contacts%correct(domain, state, reduction)               ! eqs 12-13, 16-17
            call add_external_power(domain, state, reduction%external_power_before)
            call work%team%signal_contact()
            !$omp end master
            call update_accelerations(domain, work, state)                ! eq. 6
            !$omp end parallel

            call add_motion_sums(domain, work, state, reduction)
            call observers%look_for_requests(state, reduction%requests)
            call reduction%sum(domain%comm)
            call update_energies(domain, reduction, state)
            call update_bodies(reduction, state)
            call state%advance_clock()
            call observers%pass_requests(simulation, reduction%requests > 0, requests)
            call control_step(domain, requests%end_time, state, simulation%early_end)
            call observers%notify(simulation, requests, error)
            if (allocated(error)) exit
         end do
         if (allocated(error)) call undo_prediction(work, state)
      end associate
   end subroutine run

   !> Accelerations and energies at time zero
   subroutine start(domain, state, reduction)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(inout) :: state
      !> Sums over all points
      type(global_reduction_type), intent(out) :: reduction

      call begin_accelerations(domain, state, reduction)
      call measure_energies(domain, reduction, state%step_before, state)
      associate (e => state%energies)
         e%start = e%kinetic + e%impactor
      end associate
   end subroutine start

end module plydyn_run_loop
