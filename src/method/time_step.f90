!> The size of a step, and the coefficients of the motion over it: the paper's eq. 15 with damping.
module plydyn_method_time_step
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_law_compression_barrier, only : barrier_ratio, barrier_stiffness
   use plydyn_model_control, only : total_lagrangian
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: choose_step, coefficients_after, coefficients_of_step

   !> Share of a step by which the last one may be stretched to end the run on time
   real(wp), parameter :: stretch = 1.0e-6_wp

   !> A step takes velocity and displacement to v = decay v + mean_step a, u = u + step v
   type, public :: leapfrog_coefficients_type
      !> Damping over half of the mean step, and the share of the velocity that it leaves
      real(wp) :: damping = 0.0_wp, decay = 1.0_wp
      !> Time from the middle of the step before to the middle of this one, reduced by damping
      real(wp) :: mean_step = 0.0_wp
      !> The step, and the step before less it
      real(wp) :: step = 0.0_wp, shortening = 0.0_wp
   contains
      procedure :: mean_velocity
   end type leapfrog_coefficients_type

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

   !> Coefficients of the step under way
   pure type(leapfrog_coefficients_type) function coefficients_of_step(damping, state) result(self)
      !> Damping force per mass and velocity that the deck gives, 1/time
      real(wp), intent(in) :: damping
      !> Has the step and the damping of dynamic relaxation; the clock is that of its beginning
      type(state_type), intent(in) :: state

      self = new_leapfrog_coefficients(damping + state%relaxation%damping_at(state%cycle + 1), &
         & state%step_before, state%step)
   end function coefficients_of_step

   !> Coefficients of the step after the one under way
   type(leapfrog_coefficients_type) function coefficients_after(domain, state) result(self)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Has the step under way; the clock is that of its beginning
      type(state_type), intent(in) :: state

      self = new_leapfrog_coefficients(domain%control%damping &
         & + state%relaxation%damping_at(state%cycle + 2), state%step, &
         & next_step(domain, state, state%time + state%step, state%cycle + 1))
   end function coefficients_after

   !> Coefficients of a step, with the damping force at the velocity of the full step
   pure type(leapfrog_coefficients_type) function new_leapfrog_coefficients(damping, step_before, &
      & step) result(self)
      !> Damping force per mass and velocity, 1/time
      real(wp), intent(in) :: damping
      !> The step before, and this one
      real(wp), intent(in) :: step_before, step

      real(wp) :: mean_step

      mean_step = 0.5_wp*(step_before + step)
      self%damping = 0.5_wp*damping*mean_step
      self%decay = (1.0_wp - self%damping)/(1.0_wp + self%damping)
      self%mean_step = mean_step/(1.0_wp + self%damping)
      self%step = step
      self%shortening = step_before - step
   end function new_leapfrog_coefficients

   !> Mean of the velocities before a step and after it, without contact: the velocity that damping
   !> sees
   elemental real(wp) function mean_velocity(self, after, acceleration)
      class(leapfrog_coefficients_type), intent(in) :: self
      !> Velocity after the step, and acceleration in it
      real(wp), intent(in) :: after, acceleration

      mean_velocity = (after - (0.5_wp*self%step + 0.25_wp*self%shortening)*acceleration) &
         & /(1.0_wp - self%damping)
   end function mean_velocity

end module plydyn_method_time_step
