!> Monitors a quasi-static run. Warns of the first step whose kinetic energy is too large a share of
!> the internal one, tells the largest share at the end, and why a run ends before its time.
module plydyn_run_quasi_static_monitor
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_io_job, only : job_type
   use plydyn_method_clock, only : every_steps
   use plydyn_method_observer, only : observer_type, requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_method_step_control, only : at_rest, contact_has_ended, early_end_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: new_quasi_static_monitor

   !> Looks at the energies of every step
   type, public, extends(observer_type) :: quasi_static_monitor_type
      private
      !> Where messages go
      type(job_type) :: job
      !> Largest share of the kinetic energy so far, and its time
      real(wp) :: largest = 0.0_wp, time = 0.0_wp
      !> Whether there was a warning
      logical :: has_warned = .false.
   contains
      procedure :: notify
   end type quasi_static_monitor_type

contains

   !> A monitor
   function new_quasi_static_monitor(job) result(self)
      type(job_type), intent(in) :: job
      type(quasi_static_monitor_type) :: self

      self%job = job
      self%clocks = [every_steps(1)]
      self%reads_motion = .false.
   end function new_quasi_static_monitor

   !> Look at a step
   subroutine notify(self, simulation, requests, error)
      class(quasi_static_monitor_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      associate (control => simulation%domain%control, state => simulation%state, &
         & unit => simulation%model%control%units%time)
         if (simulation%early_end%cycle == state%cycle) then
            call note_end(self, unit, simulation%early_end)
         end if
         if (control%kinetic_limit > 0.0_wp) then
            call look_at_kinetic(self, control%kinetic_limit, unit, state)
         end if
      end associate
   end subroutine notify

   !> Say why the run ends with the next step
   subroutine note_end(self, unit, early_end)
      class(quasi_static_monitor_type), intent(in) :: self
      !> Unit of time
      character(*), intent(in) :: unit
      type(early_end_type), intent(in) :: early_end

      select case (early_end%reason)
      case (at_rest)
         call self%job%note("at rest: the kinetic energy is "//text(early_end%share, 2) &
            & //" of its largest value; the motion that is left has a frequency of " &
            & //text(early_end%frequency, 3)//" per "//trim(unit))
      case (contact_has_ended)
         call self%job%note("end after the contact: no impactor has touched the plate since " &
            & //"time "//text(early_end%last_contact, 4)//" "//trim(unit))
      case default
         call self%job%note("end after the largest load: the power of the loads fell to " &
            & //text(early_end%share, 2)//" of its largest value")
      end select
   end subroutine note_end

   !> Compare the kinetic with the internal energy
   subroutine look_at_kinetic(self, limit, unit, state)
      class(quasi_static_monitor_type), intent(inout) :: self
      !> Share above which there is a warning, and unit of time
      real(wp), intent(in) :: limit
      character(*), intent(in) :: unit
      type(state_type), intent(in) :: state

      real(wp) :: share

      if (state%end%has_just_begun(state%time)) return
      share = state%energies%kinetic_share()
      if (share > self%largest) then
         self%largest = share
         self%time = state%time
      end if
      if (share > limit .and. .not. self%has_warned) then
         self%has_warned = .true.
         call self%job%note("warning: the kinetic energy is "//text(share, 2)//" of the internal " &
            & //"one at time "//text(state%time, 3)//" "//trim(unit) &
            & //", more than SHARE of *CONTROL_QUASI_STATIC: load more slowly, unless a collapse " &
            & //"is under way")
      end if
      if (state%is_finished()) call self%job%note("quasi-static: the kinetic " &
         & //"energy was at most "//text(self%largest, 2)//" of the internal one, at time " &
         & //text(self%time, 3)//" "//trim(unit))
   end subroutine look_at_kinetic

end module plydyn_run_quasi_static_monitor
