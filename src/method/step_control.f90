!> The size of a step, the coefficients of the motion over it (the paper's eq. 15 with damping), and
!> what steers a run from step to step: the step follows the stiffness of compressed layers, the
!> damping of dynamic relaxation the frequency that moves, and a run ends at rest, after the largest
!> load or after the contact of the impactors.
!>
!> The frequency is that of Rayleigh's quotient of the velocities, v K v / v M v (Underwood, 1983;
!> Papadrakakis, 1981). Over a step the internal forces change by dt K v, so that v K v is their
!> change of power with the velocity over the step, which the energy balance has. What loads,
!> damping and contact do to the accelerations is not in it. Damping is critical for this
!> frequency. High frequencies dominate at first and are damped first; then the quotient falls to
!> the lowest one.
!>
!> A small kinetic energy alone is no rest. A swing at its largest deflection has none: the damping
!> must have been about critical for the motion that is left, over a period of it. And damping for a
!> high frequency hardly lets the plate bend: a mode of the frequency w that creeps has
!> (damping/w)**2 times its kinetic energy left, for which w is that of the slowest bending that the
!> plate may have.
module plydyn_method_step_control
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_least_volume, only : least_volume_type
   use plydyn_law_compression_barrier, only : barrier_ratio, barrier_stiffness
   use plydyn_model_control, only : total_lagrangian
   use plydyn_model_mesh, only : mesh_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: choose_step, coefficients_after, coefficients_of_step, control_step, &
      & find_least_volume, looks_at_volumes

   !> Why a run ends before its time
   integer, parameter, public :: no_reason = 0, at_rest = 1, load_has_fallen = 2, &
      & contact_has_ended = 3

   !> A decision to end a run with the next step
   type, public :: early_end_type
      !> The reason, and the step in which it was found
      integer :: reason = no_reason, cycle = -1
      !> The kinetic energy at rest, or the power of the loads, as a share of its largest value
      real(wp) :: share = 0.0_wp
      !> Of the motion that is left at rest, per time
      real(wp) :: frequency = 0.0_wp
      !> Time of the last contact of an impactor
      real(wp) :: last_contact = 0.0_wp
   end type early_end_type

   real(wp), parameter :: two_pi = 8.0_wp*atan(1.0_wp)
   !> Steps between two looks at volumes, and between two changes of the damping
   integer, parameter :: steps_per_look = 200, steps_per_change = 50
   !> Steps from a decision to the step that it bears on: the next one may be computed in advance
   integer, parameter :: steps_ahead = 2
   !> Damping over the critical one, or the inverse, up to which it is about critical
   real(wp), parameter :: about_critical = 2.0_wp
   !> Share of the time with the present loads over which their power is averaged
   real(wp), parameter :: look_share = 0.01_wp

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
      type(domain_type), intent(in) :: domain
      !> Gets the step
      type(state_type), intent(inout) :: state

      state%step = next_step(domain, state, state%time, state%cycle)
      if (state%cycle == 0) state%first_step = state%step
   end subroutine choose_step

   !> The share of the stable step that the deck allows, and no step beyond the end. The last two
   !> steps share the rest: contact that closes a gap within a tiny step would push too hard.
   real(wp) function next_step(domain, state, time, cycle) result(step)
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

   !> Steer the steps to come, once the clock shows the end of a step
   subroutine control_step(domain, end_time, state, early_end)
      type(domain_type), intent(in) :: domain
      !> End that the user asks for now; negative for none
      real(wp), intent(in) :: end_time
      !> Gets the end of the run, the damping and the least volume
      type(state_type), intent(inout) :: state
      !> Gets why the run ends before its time, if it does
      type(early_end_type), intent(inout) :: early_end

      type(least_volume_type) :: least

      associate (control => domain%control)
         if (end_time > 0.0_wp) state%end%time = end_time
         if (control%rest_share > 0.0_wp .and. .not. state%is_finished()) then
            call relax(control%rest_share, domain%limit%bending_period, state, early_end)
         end if
         if (control%load_share > 0.0_wp) then
            call look_at_load(control%load_share, state, early_end)
         end if
         if (control%contact_pause > 0.0_wp .and. .not. state%is_finished()) then
            call look_at_contact(control%contact_pause, state, early_end)
         end if
         if (looks_at_volumes(state%cycle) .or. state%is_finished()) then
            least = find_least_volume(domain, state%displacement)
            state%least_volume = least%ratio
         end if
      end associate
   end subroutine control_step

   !> Whether the step follows the volumes at the end of a step
   pure logical function looks_at_volumes(cycle)
      !> Number of the step
      integer, intent(in) :: cycle

      looks_at_volumes = mod(cycle, steps_per_look) == 0
   end function looks_at_volumes

   !> The least ratio of volumes, det F, of all ranks; the same on all of them, which come together
   function find_least_volume(domain, displacement, mesh) result(least)
      type(domain_type), intent(in) :: domain
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> The mesh, to look at the corners of elements in place of their Gauss points
      type(mesh_type), intent(in), optional :: mesh
      type(least_volume_type) :: least

      type(least_volume_type) :: own
      real(wp) :: greatest
      integer :: g, place(2)

      do g = 1, size(domain%groups)
         own = least_volume_type()
         call domain%groups(g)%item%find_volume(displacement, own, mesh)
         own%group = g
         if (own%ratio < least%ratio .or. (own%ratio <= least%ratio &
            & .and. own%element < least%element)) least = own
      end do
      greatest = -least%ratio
      place(:) = [least%layer, least%group]
      call domain%comm%keep_largest(greatest, least%element, place)
      least%ratio = -greatest
      least%layer = place(1)
      least%group = place(2)
   end function find_least_volume

   !> Damp by the lowest frequency that moves, until the plate is at rest
   pure subroutine relax(rest_share, bending_period, state, early_end)
      !> Share of the largest kinetic energy that is rest
      real(wp), intent(in) :: rest_share
      !> Period of the slowest bending
      real(wp), intent(in) :: bending_period
      type(state_type), intent(inout) :: state
      !> Gets why the run ends, if it does
      type(early_end_type), intent(inout) :: early_end

      real(wp) :: frequency, kinetic, left

      kinetic = 0.5_wp*twice_half_step_kinetic(state)
      call add_integrals(kinetic, state)
      if (mod(state%cycle, steps_per_change) /= 0) return
      associate (own => state%relaxation)
         left = kinetic*(1.0_wp + (own%damping_at(state%cycle)*(bending_period/two_pi))**2)
         call change_damping(state, frequency)
         if (left > rest_share*own%largest_kinetic .or. own%damped_time*frequency < 1.0_wp) return
         state%end%cycle = state%cycle + 1
         early_end = early_end_type(at_rest, state%cycle, kinetic/own%largest_kinetic, frequency)
      end associate
   end subroutine relax

   !> Add the step that was made to the integrals over time
   pure subroutine add_integrals(kinetic, state)
      !> Kinetic energy of the plate over the step
      real(wp), intent(in) :: kinetic
      !> Gets the sums
      type(state_type), intent(inout) :: state

      associate (own => state%relaxation)
         own%twice_kinetic = own%twice_kinetic + 2.0_wp*state%step_before*kinetic
         own%stiffness_square = own%stiffness_square + own%stiffening
         own%largest_kinetic = max(own%largest_kinetic, kinetic)
         own%damped_time = own%damped_time + state%step_before
      end associate
   end subroutine add_integrals

   !> Damping that is critical for the frequency of the motion since the last change
   pure subroutine change_damping(state, frequency)
      type(state_type), intent(inout) :: state
      !> The frequency, per time; 0 where nothing moves
      real(wp), intent(out) :: frequency

      real(wp) :: critical

      frequency = 0.0_wp
      associate (own => state%relaxation)
         if (own%stiffness_square > 0.0_wp .and. own%twice_kinetic > 0.0_wp) then
            frequency = sqrt(own%stiffness_square/own%twice_kinetic)/two_pi
         end if
         critical = 2.0_wp*two_pi*frequency
         own%damping = own%damping_at(state%cycle + 1)
         if (max(own%damping, critical) > about_critical*min(own%damping, critical)) then
            own%damped_time = 0.0_wp
         end if
         own%next_damping = critical
         own%change_cycle = state%cycle + steps_ahead
         own%twice_kinetic = 0.0_wp
         own%stiffness_square = 0.0_wp
      end associate
   end subroutine change_damping

   !> Twice the kinetic energy of the plate with the velocity over the step that was made. That at
   !> the full step has the accelerations in it, which points in contact keep at rest
   pure real(wp) function twice_half_step_kinetic(state) result(twice)
      type(state_type), intent(in) :: state

      associate (sums => state%sums, step => state%step_before)
         twice = sums%twice_kinetic + sums%twice_added &
            & - step*(sums%power + 0.25_wp*step*sums%acceleration_square)
      end associate
   end function twice_half_step_kinetic

   !> End the run with the next step where the power of the loads has fallen
   pure subroutine look_at_load(least, state, early_end)
      !> Share of the largest power below which the run ends
      real(wp), intent(in) :: least
      type(state_type), intent(inout) :: state
      !> Gets why the run ends, if it does
      type(early_end_type), intent(inout) :: early_end

      real(wp) :: power

      associate (end => state%end, work => state%energies%external)
         if (state%time - end%look_time < look_share*(end%time - end%begin)) return
         power = (work - end%look_work)/(state%time - end%look_time)
         end%look_time = state%time
         end%look_work = work
         end%largest_power = max(end%largest_power, power)
         ! a plate that still moves may push its supports before they load it
         if (end%largest_power <= 0.0_wp .or. end%has_just_begun(state%time)) return
         if (power >= least*end%largest_power .or. state%is_finished()) return
         end%cycle = state%cycle + 1
         early_end = early_end_type(load_has_fallen, state%cycle, power/end%largest_power)
      end associate
   end subroutine look_at_load

   !> End the run with the next step where no impactor has touched the plate for a time, and each of
   !> them has touched it before
   pure subroutine look_at_contact(pause, state, early_end)
      !> The time
      real(wp), intent(in) :: pause
      type(state_type), intent(inout) :: state
      !> Gets why the run ends, if it does
      type(early_end_type), intent(inout) :: early_end

      real(wp) :: last

      if (size(state%impactors) == 0) return
      if (minval(state%impactors%last_contact) < 0.0_wp) return
      last = maxval(state%impactors%last_contact)
      if (state%time - last < pause) return
      state%end%cycle = state%cycle + 1
      early_end = early_end_type(contact_has_ended, state%cycle, last_contact=last)
   end subroutine look_at_contact

end module plydyn_method_step_control
