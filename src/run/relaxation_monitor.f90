!> Dynamic relaxation: damping by the lowest frequency that moves, until the plate is at rest.
!>
!> The frequency is that of Rayleigh's quotient of the velocities, v K v / v M v (Underwood, 1983;
!> Papadrakakis, 1981). Over a step the internal forces change by dt K v, so that v K v is their
!> change of power with the velocity over the step, which the energy balance has. What loads,
!> damping and contact do to the accelerations is not in it. Damping is critical for this
!> frequency. High frequencies dominate at first and are damped first; then the quotient falls to
!> the lowest one.
!>
!> A small kinetic energy alone is no rest. A swing that turns has none: the damping must have been
!> about critical for the motion that is left, over a period of it. And damping for a high frequency
!> hardly lets the plate bend: a mode of the frequency w that creeps has (damping/w)**2 times its
!> kinetic energy left, for which w is that of the slowest bending that the plate may have.
module plydyn_run_relaxation_monitor
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_sheet, only : beam_period
   use plydyn_io_job, only : job_type
   use plydyn_method_observer, only : observer_type, requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_model_model, only : model_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: new_relaxation_monitor

   real(wp), parameter :: two_pi = 8.0_wp*atan(1.0_wp)
   !> Steps between two changes of the damping
   integer, parameter :: steps_per_change = 50
   !> Steps from a decision to the step that it bears on: the next one may be computed in advance
   integer, parameter :: steps_ahead = 2
   !> Damping over the critical one, or the inverse, up to which it is about critical
   real(wp), parameter :: about_critical = 2.0_wp

   !> Looks at the energies of every step, and ends a run that is at rest
   type, public, extends(observer_type) :: relaxation_monitor_type
      private
      !> Where the note of the end goes
      type(job_type) :: job
      !> Unit of time
      character(:), allocatable :: unit
      !> Of the slowest bending, inverse of the angular frequency
      real(wp) :: bending_time = 0.0_wp
   contains
      procedure :: notify
   end type relaxation_monitor_type

contains

   !> A monitor
   function new_relaxation_monitor(job, model) result(self)
      type(job_type), intent(in) :: job
      !> Has the plates and the unit of time
      type(model_type), intent(in) :: model
      type(relaxation_monitor_type) :: self

      self%job = job
      self%unit = trim(model%control%units%time)
      self%bending_time = beam_period(model)/two_pi
      self%next%cycle = 0
      self%reads_motion = .false.
   end function new_relaxation_monitor

   !> Look at the energies of every step
   subroutine notify(self, simulation, requests, error)
      class(relaxation_monitor_type), intent(inout) :: self
      class(simulation_type), intent(inout) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: frequency, kinetic, left

      associate (control => simulation%domain%control, state => simulation%state, &
         & own => simulation%state%relaxation, &
         & largest => simulation%state%relaxation%largest_kinetic)
         if (state%is_finished()) return
         kinetic = 0.5_wp*twice_half_step_kinetic(state)
         call add_integrals(kinetic, state)
         if (mod(state%cycle, steps_per_change) /= 0) return
         left = kinetic*(1.0_wp + (own%damping_at(state%cycle)*self%bending_time)**2)
         call change_damping(state, frequency)
         if (left > control%rest_share*largest .or. own%damped_time*frequency < 1.0_wp) return
         state%end%cycle = state%cycle + 1
         if (simulation%domain%comm%is_root()) call self%job%note("at rest: the kinetic energy " &
            & //"is "//text(kinetic/largest, 2)//" of its largest value; the motion that is left " &
            & //"has a frequency of "//text(frequency, 3)//" per "//self%unit)
      end associate
   end subroutine notify

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

end module plydyn_run_relaxation_monitor
