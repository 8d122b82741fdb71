!> The size of a step, and its preparation.
module plydyn_method_time_step
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_law_compression_barrier, only : barrier_ratio, barrier_stiffness
   use plydyn_method_accelerations, only : can_predict
   use plydyn_method_contact_step, only : contacts_type
   use plydyn_method_leapfrog_coefficients, only : new_leapfrog_coefficients
   use plydyn_model_control, only : total_lagrangian
   use plydyn_method_workspace, only : workspace_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: choose_step, prepare_step

   !> Share of a step by which the last one may be stretched to end the run on time
   real(wp), parameter :: stretch = 1.0e-6_wp

contains

   !> Choose the step to be made now
   subroutine choose_step(domain, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Gets the step
      type(state_type), intent(inout) :: state

      state%step = next_step(domain, state, state%time, state%cycle)
      if (state%cycle == 0) state%first_step = state%step
   end subroutine choose_step

   !> Prepare the threads for a step, and choose whether the motion of the step after it is computed
   !> in advance: only if the motion at the end of this step is not read
   subroutine prepare_step(domain, contacts, state, motion_is_read, work)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Contacts, with the chunks that they may change
      type(contacts_type), intent(in) :: contacts
      !> Has the step
      type(state_type), intent(in) :: state
      !> Whether an observer reads the motion at the end of the step
      logical, intent(in) :: motion_is_read
      !> The work space
      type(workspace_type), intent(inout) :: work

      work%time = state%time + state%step
      work%step = state%step
      work%next = new_leapfrog_coefficients(domain%control%damping &
         & + state%relaxation%damping_at(state%cycle + 2), state%step, &
         & next_step(domain, state, work%time, state%cycle + 1))
      work%is_predicted = work%predicts_next
      work%predicts_next = can_predict(domain) .and. .not. motion_is_read &
         & .and. .not. state%ends_after()
      call work%team%set_waiting(contacts%reached)
      call work%team%begin_step(contacts%reaches_all)
   end subroutine prepare_step

   !> The share of the stable step that the deck allows, and no step beyond the end. The last two
   !> steps share the rest: contact that closes a gap within a tiny step would push too hard.
   real(wp) function next_step(domain, state, time, cycle) result(step)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Has the end of the run
      type(state_type), intent(in) :: state
      !> Time at which the step begins, and number of steps before it
      real(wp), intent(in) :: time
      integer, intent(in) :: cycle

      real(wp) :: left

      associate (control => domain%control)
         step = domain%step
         if (control%kinematics == total_lagrangian) then
            step = step*compression_share(state%least_volume)
         end if
         if (cycle == 0 .and. control%first_step > 0.0_wp) then
            step = min(step, control%first_step)
         end if
         if (control%step_curve > 0) then
            step = min(step, domain%curves(control%step_curve)%at(time))
         end if
         left = state%end%time - time
         if (left <= step*(1.0_wp + stretch)) then
            step = left
         else if (left < 2.0_wp*step) then
            step = 0.5_wp*left
         end if
      end associate
   end function next_step

   !> Share of the stable step that is left where the compression barrier acts: the stiffness
   !> of a layer along its thickness is at most 1 + b''(J) times C33. The ratio may fall somewhat
   !> until the next look
   pure real(wp) function compression_share(ratio) result(share)
      !> Least ratio of volumes at the last look
      real(wp), intent(in) :: ratio

      real(wp), parameter :: fall = 0.95_wp

      share = 1.0_wp
      if (ratio < barrier_ratio) share = 1.0_wp/sqrt(1.0_wp + barrier_stiffness(fall*ratio))
   end function compression_share

end module plydyn_method_time_step
