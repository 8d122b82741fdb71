!> Monitors a quasi-static run. Warns of the first step whose kinetic energy is too large a share of
!> the internal one, and tells the largest share at the end; ends the run after the largest load.
module plydyn_run_quasi_static_monitor
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_io_job, only : job_type
   use plydyn_method_observer, only : observer_type, requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: new_quasi_static_monitor

   !> Share of the time with the present loads that passes before energies are compared and a run
   !> may end: nothing is stored when motion begins
   real(wp), parameter :: start_share = 0.1_wp
   !> Share of that time over which the power of the loads is averaged
   real(wp), parameter :: look_share = 0.01_wp

   !> Looks at the energies of every step
   type, public, extends(observer_type) :: quasi_static_monitor_type
      private
      !> Where messages go
      type(job_type) :: job
      !> Unit of time
      character(:), allocatable :: unit
      !> Largest share of the kinetic energy so far, and its time
      real(wp) :: largest = 0.0_wp, time = 0.0_wp
      !> Whether there was a warning
      logical :: has_warned = .false.
   contains
      procedure :: notify
   end type quasi_static_monitor_type

contains

   !> A monitor
   function new_quasi_static_monitor(job, unit) result(self)
      type(job_type), intent(in) :: job
      !> Name of the unit of time
      character(*), intent(in) :: unit
      type(quasi_static_monitor_type) :: self

      self%job = job
      self%unit = unit
      self%next%cycle = 0
      self%reads_motion = .false.
   end function new_quasi_static_monitor

   !> Look at a step
   subroutine notify(self, simulation, requests, error)
      class(quasi_static_monitor_type), intent(inout) :: self
      class(simulation_type), intent(inout) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      logical :: is_root

      is_root = simulation%domain%comm%is_root()
      associate (control => simulation%domain%control, state => simulation%state)
         if (control%load_share > 0.0_wp) then
            call look_at_load(self, control%load_share, is_root, state)
         end if
         if (control%kinetic_limit > 0.0_wp) then
            call look_at_kinetic(self, control%kinetic_limit, is_root, state)
         end if
      end associate
   end subroutine notify

   !> Compare the kinetic with the internal energy
   subroutine look_at_kinetic(self, limit, is_root, state)
      class(quasi_static_monitor_type), intent(inout) :: self
      !> Share above which there is a warning
      real(wp), intent(in) :: limit
      !> Whether this rank writes messages
      logical, intent(in) :: is_root
      type(state_type), intent(in) :: state

      real(wp) :: share

      if (in_first_share(state)) return
      share = state%energies%kinetic_share()
      if (share > self%largest) then
         self%largest = share
         self%time = state%time
      end if
      if (share > limit .and. .not. self%has_warned) then
         self%has_warned = .true.
         if (is_root) call self%job%note("warning: the kinetic energy is " &
            & //text(share, 2)//" of the internal one at time "//text(state%time, 3)//" " &
            & //self%unit//", more than SHARE of *CONTROL_QUASI_STATIC: load more slowly")
      end if
      if (state%is_finished() .and. is_root) call self%job%note("quasi-static: the kinetic " &
         & //"energy was at most "//text(self%largest, 2)//" of the internal one, at time " &
         & //text(self%time, 3)//" "//self%unit)
   end subroutine look_at_kinetic

   !> Whether the loads have only begun to move
   pure logical function in_first_share(state)
      type(state_type), intent(in) :: state

      associate (end => state%end)
         in_first_share = state%time < end%begin + start_share*(end%time - end%begin)
      end associate
   end function in_first_share

   !> End the run with the next step where the power of the loads has fallen
   subroutine look_at_load(self, least, is_root, state)
      class(quasi_static_monitor_type), intent(in) :: self
      !> Share of the largest power below which the run ends
      real(wp), intent(in) :: least
      !> Whether this rank writes messages
      logical, intent(in) :: is_root
      type(state_type), intent(inout) :: state

      real(wp) :: power

      associate (end => state%end, work => state%energies%external)
         if (state%time - end%look_time < look_share*(end%time - end%begin)) return
         power = (work - end%look_work)/(state%time - end%look_time)
         end%look_time = state%time
         end%look_work = work
         end%largest_power = max(end%largest_power, power)
         ! a plate that still moves may push its supports before they load it
         if (end%largest_power <= 0.0_wp .or. in_first_share(state)) return
         if (power >= least*end%largest_power .or. state%is_finished()) return
         end%cycle = state%cycle + 1
         if (is_root) call self%job%note("end after the largest load: the power of the loads " &
            & //"fell to "//text(power/end%largest_power, 2)//" of its largest value")
      end associate
   end subroutine look_at_load

end module plydyn_run_quasi_static_monitor
