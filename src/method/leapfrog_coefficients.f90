!> Coefficients of the motion over a step (the paper's eq. 15, with damping).
module plydyn_method_leapfrog_coefficients
   use plydyn_base_precision, only : wp
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: coefficients_of_step, new_leapfrog_coefficients

   !> A step takes velocity and displacement to v = decay v + mean_step a, u = u + step v
   type, public :: leapfrog_coefficients_type
      !> Damping over half of the mean step, and the share of the velocity that it leaves
      real(wp) :: damping = 0.0_wp, decay = 1.0_wp
      !> Time from the middle of the step before to the middle of this one, reduced by damping
      real(wp) :: mean_step = 0.0_wp
      !> The step
      real(wp) :: step = 0.0_wp
   contains
      procedure :: mean_velocity
   end type leapfrog_coefficients_type

contains

   !> Coefficients of the step under way
   pure type(leapfrog_coefficients_type) function coefficients_of_step(damping, state) result(self)
      !> Damping force per mass and velocity that the deck gives, 1/time
      real(wp), intent(in) :: damping
      !> Has the step and the damping of dynamic relaxation; the clock is that of its beginning
      type(state_type), intent(in) :: state

      self = new_leapfrog_coefficients(damping + state%relaxation%damping_at(state%cycle + 1), &
         & state%step_before, state%step)
   end function coefficients_of_step

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
   end function new_leapfrog_coefficients

   !> Mean of the velocities before a step and after it, without contact: the velocity that damping
   !> sees
   elemental real(wp) function mean_velocity(self, after, acceleration)
      class(leapfrog_coefficients_type), intent(in) :: self
      !> Velocity after the step, and acceleration in it
      real(wp), intent(in) :: after, acceleration

      mean_velocity = (after - 0.5_wp*self%step*acceleration)/(1.0_wp - self%damping)
   end function mean_velocity

end module plydyn_method_leapfrog_coefficients
