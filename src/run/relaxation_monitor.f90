!> Dynamic relaxation: damping by the lowest frequency that moves, until the plate is at rest.
!>
!> The frequency is that of Rayleigh's quotient of the velocities, v K v / v M v (Underwood, 1983;
!> Papadrakakis, 1981). Over a step the internal forces change by dt K v, so that v K v is their
!> change of power with the velocity over the step, which the energy balance has. What loads,
!> damping and contact do to the accelerations is not in it. Damping is critical for this
!> frequency. High frequencies dominate at first and are damped first; then the quotient falls to
!> the lowest one.
module plydyn_run_relaxation_monitor
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_io_job, only : job_type
   use plydyn_method_observer, only : observer_type, requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: new_relaxation_monitor

   !> Steps between two changes of the damping
   integer, parameter :: steps_per_change = 50
   !> Steps from a decision to the step that it bears on: the next one may be computed in advance
   integer, parameter :: steps_ahead = 2

   !> Looks at the energies of every step, and ends a run that is at rest
   type, public, extends(observer_type) :: relaxation_monitor_type
      private
      !> Where the note of the end goes
      type(job_type) :: job
      !> Unit of time
      character(:), allocatable :: unit
   contains
      procedure :: notify
   end type relaxation_monitor_type

contains

   !> A monitor
   function new_relaxation_monitor(job, unit) result(self)
      type(job_type), intent(in) :: job
      !> Name of the unit of time
      character(*), intent(in) :: unit
      type(relaxation_monitor_type) :: self

      self%job = job
      self%unit = unit
      self%next%cycle = 0
      self%reads_motion = .false.
   end function new_relaxation_monitor

   !> Look at the energies of every step
   subroutine notify(self, simulation, requests, error)
      class(relaxation_monitor_type), intent(inout) :: self
      class(simulation_type), intent(inout) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: frequency, kinetic

      associate (control => simulation%domain%control, state => simulation%state, &
         & largest => simulation%state%relaxation%largest_kinetic)
         if (state%is_finished()) return
         kinetic = 0.5_wp*twice_half_step_kinetic(state)
         call add_integrals(kinetic, state)
         if (mod(state%cycle, steps_per_change) /= 0) return
         call change_damping(state, frequency)
         if (kinetic > control%rest_share*largest .or. frequency <= 0.0_wp) return
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
      end associate
   end subroutine add_integrals

   !> Damping that is critical for the frequency of the motion since the last change
   pure subroutine change_damping(state, frequency)
      type(state_type), intent(inout) :: state
      !> The frequency, per time; 0 where nothing moves
      real(wp), intent(out) :: frequency

      real(wp), parameter :: two_pi = 8.0_wp*atan(1.0_wp)

      frequency = 0.0_wp
      associate (own => state%relaxation)
         if (own%stiffness_square > 0.0_wp .and. own%twice_kinetic > 0.0_wp) then
            frequency = sqrt(own%stiffness_square/own%twice_kinetic)/two_pi
         end if
         own%damping = own%damping_at(state%cycle + 1)
         own%next_damping = 2.0_wp*two_pi*frequency
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
