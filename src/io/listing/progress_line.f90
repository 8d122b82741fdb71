!> The progress line of a run: time reached, step and its cause, time left.
module plydyn_io_listing_progress_line
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : padded
   implicit none
   private

   public :: progress_headers, progress_line, duration_text

   !> Widths of the columns, and blanks between two
   integer, parameter :: cycle_width = 9, number_width = 10, share_width = 6, cause_width = 24, &
      & error_width = 8, duration_width = 10, share_column = 8
   character(*), parameter :: gap = "  "
   !> Share of the elapsed time that passes between two lines of a long run
   real(wp), parameter :: share_between = 0.02_wp

   !> Progress of a run
   type, public :: progress_type
      !> Steps done
      integer :: cycle = 0
      !> Time reached, and the first and the last of this run
      real(wp) :: time = 0.0_wp, start_time = 0.0_wp, end_time = 0.0_wp
      !> Size of the step
      real(wp) :: step = 0.0_wp
      !> Cause of the step, in short
      character(cause_width) :: cause = ""
      !> Share of the energy that is out of balance
      real(wp) :: energy_error = 0.0_wp
      !> Force on the impactor
      real(wp) :: force = 0.0_wp
      !> Whether the line has the kinetic energy as a share of the internal one, and this share
      logical :: has_kinetic_share = .false.
      real(wp) :: kinetic_share = 0.0_wp
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

contains

   !> Start the clock; the first line is due at once
   subroutine start(self)
      !> The clock
      class(progress_timer_type), intent(inout) :: self

      call system_clock(self%started)
      self%next = 0.0_wp
   end subroutine start

   !> Seconds since the start; none before it
   real(wp) function elapsed(self)
      !> The clock
      class(progress_timer_type), intent(in) :: self

      integer(int64) :: now, rate

      elapsed = 0.0_wp
      if (self%started == 0_int64) return
      call system_clock(now, rate)
      elapsed = real(now - self%started, wp)/rate
   end function elapsed

   !> True when a line should be written
   elemental logical function due(self, seconds)
      !> The clock
      class(progress_timer_type), intent(in) :: self
      !> Seconds since the start
      real(wp), intent(in) :: seconds

      due = seconds >= self%next
   end function due

   !> Note that a line was written
   elemental subroutine advance(self, seconds)
      !> The clock
      class(progress_timer_type), intent(inout) :: self
      !> Seconds since the start
      real(wp), intent(in) :: seconds

      self%next = seconds + max(self%interval, share_between*seconds)
   end subroutine advance

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
   pure function progress_line(progress, seconds) result(line)
      !> Progress of the run
      type(progress_type), intent(in) :: progress
      !> Seconds since the start of the run
      real(wp), intent(in) :: seconds
      character(:), allocatable :: line

      character(cycle_width) :: cycle
      character(number_width) :: time, step, force
      character(share_width) :: done
      character(error_width) :: error
      character(share_column) :: kinetic

      write (cycle, "(i9)") progress%cycle
      write (time, "(es10.4)") progress%time
      write (done, "(f5.1,a)") 100.0_wp*share_done(progress), "%"
      write (step, "(es10.4)") progress%step
      ! rounded, and with no sign where nothing is left of it
      write (error, "(f7.2,a)") 0.01_wp*anint(1.0e4_wp*progress%energy_error) + 0.0_wp, "%"
      write (force, "(es10.3)") progress%force
      line = cycle//gap//time//gap//done//gap//step//gap//progress%cause//gap//error//gap &
         & //force//gap//right(duration_text(seconds), duration_width)//gap &
         & //right(duration_text(remaining(progress, seconds)), duration_width)
      if (progress%has_kinetic_share) then
         write (kinetic, "(f7.2,a)") min(100.0_wp*progress%kinetic_share, 9999.0_wp), "%"
         line = line//gap//kinetic
      end if
   end function progress_line

   !> Share of this run that is done, 0 to 1
   pure real(wp) function share_done(progress)
      !> Progress of the run
      type(progress_type), intent(in) :: progress

      real(wp) :: span

      share_done = 0.0_wp
      span = progress%end_time - progress%start_time
      if (span > 0.0_wp) share_done = min(1.0_wp, (progress%time - progress%start_time)/span)
   end function share_done

   !> Seconds still to go at the present pace; negative when unknown
   pure real(wp) function remaining(progress, seconds)
      !> Progress of the run
      type(progress_type), intent(in) :: progress
      !> Seconds since the start of the run
      real(wp), intent(in) :: seconds

      real(wp) :: done

      remaining = -1.0_wp
      done = share_done(progress)
      if (done > tiny(1.0_wp)*huge(1)) remaining = seconds*(1.0_wp - done)/done
   end function remaining

   !> A duration as `h:mm:ss`; `-` when it is negative or beyond a year
   pure function duration_text(seconds) result(string)
      !> Seconds
      real(wp), intent(in) :: seconds
      character(:), allocatable :: string

      integer, parameter :: minute = 60, hour = 3600
      real(wp), parameter :: year = 365.0_wp*24.0_wp*hour
      character(duration_width) :: word
      integer :: whole

      string = "-"
      if (seconds < 0.0_wp .or. seconds > year) return
      whole = nint(seconds)
      write (word, "(i0,2(a,i2.2))") whole/hour, ":", mod(whole, hour)/minute, ":", &
         & mod(whole, minute)
      string = trim(word)
   end function duration_text

   !> A text at the right of its column
   pure function right(string, width) result(cell)
      !> The text
      character(*), intent(in) :: string
      !> Width of the column
      integer, intent(in) :: width
      character(:), allocatable :: cell

      cell = repeat(" ", max(0, width - len(string)))//string
   end function right

end module plydyn_io_listing_progress_line
