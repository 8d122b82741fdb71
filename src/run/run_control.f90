!> Handles requests to a run: signals, words in the control file JOB.ctl, the wall-clock limit.
module plydyn_run_run_control
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type
   use plydyn_base_file_identity, only : file_identity_type, identity_of, no_file, regular_file
   use plydyn_base_files, only : rename_file
   use plydyn_base_precision, only : wp
   use plydyn_base_signals, only : caught_signal, has_caught_signal
   use plydyn_base_text, only : lower_case, text
   use plydyn_io_job, only : job_type
   use plydyn_method_observer, only : observer_type, requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_state_file_positions, only : file_positions_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: new_run_control, take_requests

   !> Passes requests to the other observers
   type, public, extends(observer_type) :: run_control_type
      private
      !> Path of the results, and units of screen and listing
      type(job_type) :: job
      !> Wall-clock limit, seconds
      real(wp) :: most_seconds = huge(1.0_wp)
      !> Clock at the start, and at the last look for the control file
      integer(int64) :: started = 0_int64, looked = 0_int64
      !> Whether this rank looks at the clock and for the control file
      logical :: is_root = .true.
      !> Requests that this rank has found: whether any, the reason for a stop, and the others
      logical :: has_request = .false.
      character(:), allocatable :: asked_by
      type(requests_type) :: requests
   contains
      procedure :: look_for_requests
      procedure :: pass_requests
      procedure :: save
   end type run_control_type

   !> Seconds between two looks for the control file
   real(wp), parameter :: seconds_per_look = 0.25_wp
   !> Behind the name of a control file that was read
   character(*), parameter :: was_read = ".read"
   !> Longest line, most lines that are read, and most that are answered one by one
   integer, parameter :: longest = 200, most = 100000, most_answers = 100
   character(*), parameter :: words = "stop, dump, plot, status, flush, end-time TIME " &
      & //"(or sw1, sw3, sw4, sw2, d3kil)"

contains

   !> Start the clock
   function new_run_control(comm, job, most_seconds) result(self)
      type(comm_type), intent(in) :: comm
      !> The job, the same on all ranks
      type(job_type), intent(in) :: job
      !> Wall-clock limit, seconds
      real(wp), intent(in) :: most_seconds
      type(run_control_type) :: self

      self%is_root = comm%is_root()
      self%asked_by = ""
      self%job = job
      self%most_seconds = most_seconds
      call system_clock(self%started)
      self%looked = self%started
   end function new_run_control

   !> Pass the requests that the root has found, and a signal to any rank, to all others
   subroutine pass_requests(self, simulation, requests)
      class(run_control_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(requests_type), intent(inout) :: requests

      character(:), allocatable :: asked_by
      integer :: flags(5)
      real(wp) :: end_time(1)

      asked_by = self%asked_by
      if (has_caught_signal()) asked_by = caught_signal()
      associate (found => self%requests, comm => simulation%domain%comm)
         flags(:) = merge(1, 0, [found%checkpoint, found%fields, found%progress, found%flush, &
            & self%has_request])
         end_time(1) = found%end_time
         call comm%broadcast(asked_by)
         call comm%broadcast(flags)
         call comm%broadcast(end_time)
      end associate
      self%has_request = .false.
      self%requests = requests_type()
      requests%checkpoint = flags(1) == 1
      requests%fields = flags(2) == 1
      requests%progress = flags(3) == 1
      requests%flush = flags(4) == 1
      requests%end_time = end_time(1)
      ! a request, but not at the root
      if (len(asked_by) == 0 .and. sum(flags) == 0) asked_by = "a signal to one of the ranks"
      if (len(asked_by) == 0 .or. simulation%state%is_finished()) return
      requests%checkpoint = .true.
      requests%stopped_by = asked_by
   end subroutine pass_requests

   !> Answer a request to flush all results to the disk
   subroutine save(self, state, positions, requests, error)
      class(run_control_type), intent(inout) :: self
      type(state_type), intent(inout) :: state
      type(file_positions_type), intent(inout) :: positions
      type(requests_type), intent(in) :: requests
      type(error_type), allocatable, intent(out) :: error

      if (requests%flush) call self%job%note("all results are on the disk")
   end subroutine save

   !> Look for signals on every rank, for the rest on the root
   subroutine look_for_requests(self, time, found)
      class(run_control_type), intent(inout) :: self
      real(wp), intent(in) :: time
      logical, intent(inout) :: found

      if (self%is_root .and. .not. self%has_request) call look_at_root(self, time)
      found = found .or. self%has_request .or. has_caught_signal()
   end subroutine look_for_requests

   !> Look at the clock and for the control file
   subroutine look_at_root(self, time)
      type(run_control_type), intent(inout) :: self
      real(wp), intent(in) :: time

      character(:), allocatable :: answer
      integer(int64) :: now, rate
      logical :: found

      call system_clock(now, rate)
      if (real(now - self%started, wp)/rate > self%most_seconds) then
         self%asked_by = "the wall-clock limit of "//text(self%most_seconds)//" s"
         self%has_request = .true.
      end if
      if (now - self%looked < seconds_per_look*rate) return
      self%looked = now
      call take_requests(self%job%path//".ctl", time, self%requests, answer, found)
      if (.not. found) return
      self%has_request = .true.
      call self%job%note(answer)
      if (allocated(self%requests%stopped_by) .and. len(self%asked_by) == 0) then
         self%asked_by = self%requests%stopped_by
      end if
   end subroutine look_at_root

   !> Read the control file, if there is one, and set it aside
   subroutine take_requests(path, time, requests, answer, found)
      !> Path of the file
      character(*), intent(in) :: path
      !> Time now
      real(wp), intent(in) :: time
      !> Its requests: an end time, fields, a progress line, a restart file, to flush, to stop
      type(requests_type), intent(out) :: requests
      !> Answer to the file, a line for each of its lines
      character(:), allocatable, intent(out) :: answer
      !> Whether there was such a file
      logical, intent(out) :: found

      type(file_identity_type) :: identity
      logical :: good

      answer = ""
      identity = identity_of(path, follow=.true.)
      found = identity%kind /= no_file
      if (.not. found) return
      ! renamed it is no longer written to, and is read once
      call rename_file(path, path//was_read, good)
      if (good .and. identity%kind == regular_file) then
         call take_lines(path, time, requests, answer, good)
      end if
      if (.not. good) then
         answer = path//": cannot be read and is ignored"
      else if (identity%kind /= regular_file) then
         answer = path//": ignored, since it is no regular file"
      end if
   end subroutine take_requests

   !> All lines of the file that was set aside
   subroutine take_lines(path, time, requests, answer, good)
      !> Path that the file had
      character(*), intent(in) :: path
      real(wp), intent(in) :: time
      type(requests_type), intent(inout) :: requests
      character(:), allocatable, intent(inout) :: answer
      !> Whether it could be read
      logical, intent(out) :: good

      character(longest + 1) :: line
      character(:), allocatable :: answers
      integer :: i, status, unit

      answers = ""
      open (newunit=unit, file=path//was_read, status="old", action="read", iostat=status)
      good = status == 0
      if (.not. good) return
      do i = 1, most
         read (unit, "(a)", iostat=status) line
         if (status /= 0) exit
         if (len_trim(line) > 0) call take_line(path, trim(adjustl(line)), time, &
            & requests, answer)
         if (i == most_answers) answers = answer
         if (i > most_answers) answer = answers
      end do
      close (unit)
      if (i > most_answers + 1) answer = answers//path//": and " &
         & //text(i - 1 - most_answers)//" more lines, which are read too"//new_line("a")
      if (i > most) answer = answer//path//": lines beyond " &
         & //text(most)//" are not read"//new_line("a")
   end subroutine take_lines

   !> One line
   subroutine take_line(path, line, time, requests, answers)
      character(*), intent(in) :: path, line
      real(wp), intent(in) :: time
      type(requests_type), intent(inout) :: requests
      !> Answers to the lines; gets that to this one
      character(:), allocatable, intent(inout) :: answers

      character(:), allocatable :: answer
      integer :: blank

      blank = scan(line//" ", " =")
      answer = "taken"
      select case (lower_case(line(:blank - 1)))
      case ("stop", "sw1", "d3kil"); requests%stopped_by = path
      case ("dump", "sw3"); requests%checkpoint = .true.
      case ("plot", "sw4"); requests%fields = .true.
      case ("status", "sw2"); requests%progress = .true.
      case ("flush"); requests%flush = .true.
      case ("end-time")
         call take_end_time(line(blank + verify(line(blank:)//"x", " =") - 1:), time, &
            & requests%end_time, answer)
         blank = len(line) + 1
      case default
         answer = "not understood and ignored; right would be "//words
      end select
      if (len(line) > longest .and. answer == "taken") then
         answer = "taken; ignored is what follows column "//text(longest)
      else if (answer == "taken" .and. blank < len(line)) then
         answer = "taken; ignored is what follows the first word"
      end if
      answers = answers//path//": '"//printable(line)//"' "//answer//new_line("a")
   end subroutine take_line

   !> A text with question marks in place of characters that are not printable
   pure function printable(line) result(shown)
      character(*), intent(in) :: line
      character(len(line)) :: shown
      integer :: i

      do i = 1, len(line)
         shown(i:i) = merge(line(i:i), "?", line(i:i) >= " " .and. line(i:i) <= "~")
      end do
   end function printable

   !> A new end time, not before now
   subroutine take_end_time(word, time, end_time, answer)
      character(*), intent(in) :: word
      real(wp), intent(in) :: time
      real(wp), intent(inout) :: end_time
      character(:), allocatable, intent(inout) :: answer

      real(wp) :: wanted
      integer :: status

      status = verify(trim(word), "0123456789.eEdD+-")
      if (status == 0) read (word, *, iostat=status) wanted
      if (status == 0) status = merge(0, 1, ieee_is_finite(wanted))
      if (status /= 0) then
         answer = "not understood and ignored; right would be a time, as in end-time 0.005"
      else if (wanted <= time) then
         answer = "ignored: the run is at time "//text(time)//" already"
      else
         end_time = wanted
      end if
   end subroutine take_end_time

end module plydyn_run_run_control
