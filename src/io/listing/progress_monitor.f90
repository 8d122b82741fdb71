!> The line of life on the screen, as a run goes on.
module plydyn_io_listing_progress_monitor
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_control, only : units_type
   use plydyn_io_job, only : job_type, no_unit
   use plydyn_io_listing_progress_line, only : progress_heads, progress_line, progress_type, &
      & progress_sample_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> What writes the line
   type, public :: progress_monitor_type
      private
      !> Unit of the screen
      integer :: screen = no_unit
      type(progress_type) :: progress
      type(progress_sample_type) :: pulse
      !> Largest step but for a curve that bounds it; what it comes from; whether there is a curve
      real(wp) :: largest = 0.0_wp
      character(:), allocatable :: cause
      logical :: has_curve = .false.
   contains
      procedure :: begin
      procedure :: show
      procedure :: tell
      procedure :: elapsed
   end type progress_monitor_type

   !> Steps between two looks at the clock
   integer, parameter :: steps_per_look = 16

contains

   !> Start the clock, and write the heads
   subroutine begin(self, job, units, domain)
      class(progress_monitor_type), intent(inout) :: self
      !> The job
      type(job_type), intent(in) :: job
      !> Names of the units
      type(units_type), intent(in) :: units
      !> The domain
      type(domain_type), intent(in) :: domain

      self%screen = job%screen
      self%progress%start_time = job%start_time
      call find_cause(self, domain)
      call self%pulse%start()
      if (self%screen == no_unit) return
      write (self%screen, "(a)") progress_heads(units%time, units%force)
   end subroutine begin

   !> What the step comes from
   subroutine find_cause(self, domain)
      class(progress_monitor_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain

      associate (control => domain%control, limit => domain%limit)
         self%cause = "quad "//text(limit%quad)//" ply "//text(limit%ply)
         if (size(domain%bricks) > 0) self%cause = "brick "//text(limit%quad)
         if (limit%interface_rest > limit%ply_rate) self%cause = "interfaces"
         self%largest = control%step_factor*limit%step
         self%has_curve = control%step_curve > 0
         if (control%largest_step > 0.0_wp .and. control%largest_step < self%largest) then
            self%largest = control%largest_step
            self%cause = "DTMAX"
         end if
      end associate
   end subroutine find_cause

   !> Write the line when its time has come
   subroutine show(self, state)
      class(progress_monitor_type), intent(inout) :: self
      !> The state
      type(state_type), intent(in) :: state

      real(wp) :: seconds

      if (self%screen == no_unit) return
      if (.not. state%is_finished()) then
         if (mod(state%cycle, steps_per_look) /= 0) return
         seconds = self%pulse%elapsed()
         if (.not. self%pulse%due(seconds)) return
      end if
      call self%tell(state)
   end subroutine show

   !> Write the line, due or not
   subroutine tell(self, state)
      class(progress_monitor_type), intent(inout) :: self
      !> The state
      type(state_type), intent(in) :: state

      real(wp) :: seconds

      if (self%screen == no_unit) return
      seconds = self%pulse%elapsed()
      call self%pulse%advance(seconds)
      self%progress%cycle = state%cycle
      self%progress%time = state%time
      self%progress%end_time = state%end_time
      self%progress%step = state%step_before
      self%progress%cause = self%cause
      if (self%has_curve .and. state%step_before < self%largest) self%progress%cause = "LCTM"
      self%progress%energy_error = state%energies%error()
      self%progress%force = 0.0_wp
      if (size(state%impactors) > 0) self%progress%force = sum(state%impactors%force(3))
      write (self%screen, "(a)") progress_line(self%progress, seconds)
      flush (self%screen)
   end subroutine tell

   !> Seconds since the start of the run
   real(wp) function elapsed(self)
      class(progress_monitor_type), intent(in) :: self

      elapsed = self%pulse%elapsed()
   end function elapsed

end module plydyn_io_listing_progress_monitor
