!> The progress line on the screen: time reached, step and its cause, time left.
module plydyn_io_listing_progress_monitor
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : duration_text, padded, text
   use plydyn_domain_domain, only : domain_type
   use plydyn_io_job, only : job_type, no_unit, output_type
   use plydyn_method_clock, only : every_steps
   use plydyn_method_observer, only : requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: progress_headers, progress_line

   !> Widths of the columns, and blanks between two
   integer, parameter :: cycle_width = 9, number_width = 10, share_width = 6, cause_width = 24, &
      & error_width = 8, duration_width = 10, share_column = 8
   character(*), parameter :: gap = "  "
   !> Share of the elapsed time that passes between two lines of a long run
   real(wp), parameter :: share_between = 0.02_wp
   !> Steps between two looks at the clock
   integer, parameter :: steps_per_look = 16

   !> What a line has beside the state
   type, public :: progress_type
      !> Time at which this run began
      real(wp) :: start_time = 0.0_wp
      !> Cause of the step, in short
      character(cause_width) :: cause = ""
      !> Force on the impactors
      real(wp) :: force = 0.0_wp
      !> Whether the line has the kinetic energy as a share of the internal one
      logical :: has_kinetic_share = .false.
   end type progress_type

   !> Decides by the wall clock when a line is due: at first each `interval`, then with
   !> growing distance, so that a run of days leaves a few hundred lines
   type, public :: progress_timer_type
      !> Least seconds between two lines
      real(wp) :: interval = 1.0_wp
      !> Clock at the start
      integer(int64), private :: started = 0_int64
      !> Seconds after the start at which the next line is due
      real(wp), private :: next = 0.0_wp
   contains
      procedure :: start
      procedure :: elapsed
      procedure :: due
      procedure :: advance
   end type progress_timer_type

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
      self%progress%cause = self%cause
      if (self%has_curve .and. state%step_before < self%largest) self%progress%cause = "LCTM"
      self%progress%force = 0.0_wp
      if (size(state%impactors) > 0) self%progress%force = &
         & 2**count(state%supports%planes /= 0)*sum(state%impactors%force(3))
      write (self%screen, "(a)") progress_line(self%progress, state, seconds)
      flush (self%screen)
   end subroutine write_line

   !> Headers of the columns
   pure function progress_headers(time_unit, force_unit, has_kinetic_share) result(line)
      !> Name of the unit of time, and name of the unit of force
      character(*), intent(in) :: time_unit, force_unit
      !> Whether there is a column of the kinetic energy
      logical, intent(in) :: has_kinetic_share
      character(:), allocatable :: line

      line = right("cycle", cycle_width)//gap &
         & //right("time ["//trim(time_unit)//"]", number_width)//gap &
         & //right("done", share_width)//gap &
         & //right("step ["//trim(time_unit)//"]", number_width)//gap &
         & //padded("controlled by", cause_width)//gap &
         & //right("error", error_width)//gap &
         & //right("force ["//trim(force_unit)//"]", number_width)//gap &
         & //right("elapsed", duration_width)//gap &
         & //right("left", duration_width)
      if (has_kinetic_share) line = line//gap//right("kinetic", share_column)
   end function progress_headers

   !> The line
   pure function progress_line(progress, state, seconds) result(line)
      !> What it has beside the state, and the state
      type(progress_type), intent(in) :: progress
      type(state_type), intent(in) :: state
      !> Seconds since the start of the run
      real(wp), intent(in) :: seconds
      character(:), allocatable :: line

      character(cycle_width) :: cycle
      character(number_width) :: time, step, force
      character(share_width) :: done
      character(error_width) :: error
      character(share_column) :: kinetic
      real(wp) :: left, share

      share = 0.0_wp
      associate (span => state%end%time - progress%start_time)
         if (span > 0.0_wp) share = min(1.0_wp, (state%time - progress%start_time)/span)
      end associate
      ! at the present pace; unknown at the start
      left = -1.0_wp
      if (share > tiny(1.0_wp)*huge(1)) left = seconds*(1.0_wp - share)/share
      write (cycle, "(i9)") state%cycle
      write (time, "(es10.4)") state%time
      write (done, "(f5.1,a)") 100.0_wp*share, "%"
      write (step, "(es10.4)") state%step_before
      ! rounded, and with no sign where nothing is left of it
      write (error, "(f7.2,a)") 0.01_wp*anint(1.0e4_wp*state%energies%error()) + 0.0_wp, "%"
      write (force, "(es10.3)") progress%force
      line = cycle//gap//time//gap//done//gap//step//gap//progress%cause//gap//error//gap &
         & //force//gap//right(duration_text(seconds), duration_width)//gap &
         & //right(duration_text(left), duration_width)
      if (progress%has_kinetic_share) then
         write (kinetic, "(f7.2,a)") min(100.0_wp*state%energies%kinetic_share(), 9999.0_wp), "%"
         line = line//gap//kinetic
      end if
   end function progress_line

   !> A text at the right of its column
   pure function right(string, width) result(cell)
      !> The text
      character(*), intent(in) :: string
      !> Width of the column
      integer, intent(in) :: width
      character(:), allocatable :: cell

      cell = repeat(" ", max(0, width - len(string)))//string
   end function right

   !> Start the clock; the first line is due at once
   subroutine start(self)
      class(progress_timer_type), intent(inout) :: self

      call system_clock(self%started)
      self%next = 0.0_wp
   end subroutine start

   !> Seconds since the start; none before it
   real(wp) function elapsed(self)
      class(progress_timer_type), intent(in) :: self

      integer(int64) :: now, rate

      elapsed = 0.0_wp
      if (self%started == 0_int64) return
      call system_clock(now, rate)
      elapsed = real(now - self%started, wp)/rate
   end function elapsed

   !> True when a line should be written
   elemental logical function due(self, seconds)
      class(progress_timer_type), intent(in) :: self
      !> Seconds since the start
      real(wp), intent(in) :: seconds

      due = seconds >= self%next
   end function due

   !> Note that a line was written
   elemental subroutine advance(self, seconds)
      class(progress_timer_type), intent(inout) :: self
      !> Seconds since the start
      real(wp), intent(in) :: seconds

      self%next = seconds + max(self%interval, share_between*seconds)
   end subroutine advance

end module plydyn_io_listing_progress_monitor
