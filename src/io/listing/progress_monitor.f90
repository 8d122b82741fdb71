!> The progress line on the screen.
module plydyn_io_listing_progress_monitor
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_io_job, only : job_type, no_unit, output_type
   use plydyn_io_listing_progress_line, only : progress_headers, progress_line, progress_type, &
      & progress_timer_type
   use plydyn_method_clock, only : every_steps
   use plydyn_method_observer, only : requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> Writes the line, on the root
   type, public, extends(output_type) :: progress_monitor_type
      private
      !> Unit of the screen
      integer :: screen = no_unit
      type(progress_type) :: progress
      type(progress_timer_type) :: timer
      !> Largest step without regard of a curve that bounds it, and its cause
      real(wp) :: largest = 0.0_wp
      character(:), allocatable :: cause
      !> Whether a curve bounds the step
      logical :: has_curve = .false.
   contains
      procedure :: open => open_monitor
      procedure :: notify
   end type progress_monitor_type

   !> Steps between two looks at the clock
   integer, parameter :: steps_per_look = 16

contains

   !> Start the clock, and write the headers
   subroutine open_monitor(self, job, simulation, error)
      class(progress_monitor_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      self%reads_motion = .false.
      self%screen = job%screen
      self%progress%start_time = job%start_time
      self%progress%has_kinetic_share = simulation%domain%control%kinetic_limit > 0.0_wp
      call find_cause(self, simulation%domain)
      call self%timer%start()
      self%clocks = [every_steps(steps_per_look)]
      if (self%screen == no_unit) return
      associate (units => simulation%model%control%units)
         write (self%screen, "(a)") progress_headers(units%time, units%force, &
            & self%progress%has_kinetic_share)
      end associate
   end subroutine open_monitor

   !> Find the cause of the step
   subroutine find_cause(self, domain)
      class(progress_monitor_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain

      associate (control => domain%control, limit => domain%limit)
         associate (group => domain%groups(limit%slowest(1)%group)%item)
            self%cause = group%element_kind//" "//text(limit%element_id)//" " &
               & //group%layer_kind//" "//text(limit%slowest(1)%layer)
         end associate
         if (limit%interface_rest > limit%slowest(1)%rate) self%cause = "interfaces"
         if (limit%unscaled_step < limit%step) self%cause = "DT2MS"
         self%largest = control%step_share()*limit%step
         self%has_curve = control%step_curve > 0
         if (control%largest_step > 0.0_wp .and. control%largest_step < self%largest) then
            self%largest = control%largest_step
            self%cause = "DTMAX"
         end if
      end associate
   end subroutine find_cause

   !> Write the line when its time has come, at the end, and on request
   subroutine notify(self, simulation, requests, error)
      class(progress_monitor_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      logical :: has_come

      associate (state => simulation%state)
         if (self%screen == no_unit) return
         has_come = self%is_due(state)
         if (has_come .and. .not. state%is_finished()) then
            has_come = self%timer%due(self%timer%elapsed())
         end if
         if (has_come .or. requests%progress) call write_line(self, state)
      end associate
   end subroutine notify

   !> Write the line
   subroutine write_line(self, state)
      type(progress_monitor_type), intent(inout) :: self
      type(state_type), intent(in) :: state

      real(wp) :: seconds

      seconds = self%timer%elapsed()
      call self%timer%advance(seconds)
      self%progress%cycle = state%cycle
      self%progress%time = state%time
      self%progress%end_time = state%end%time
      self%progress%step = state%step_before
      self%progress%cause = self%cause
      if (self%has_curve .and. state%step_before < self%largest) self%progress%cause = "LCTM"
      self%progress%energy_error = state%energies%error()
      self%progress%force = 0.0_wp
      self%progress%kinetic_share = state%energies%kinetic_share()
      if (size(state%impactors) > 0) self%progress%force = &
         & 2**count(state%supports%planes /= 0)*sum(state%impactors%force(3))
      write (self%screen, "(a)") progress_line(self%progress, seconds)
      flush (self%screen)
   end subroutine write_line

end module plydyn_io_listing_progress_monitor
