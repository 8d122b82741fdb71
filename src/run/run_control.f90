!> Handles requests to a run: signals, the control file, the wall-clock limit.
module plydyn_run_run_control
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_signals, only : caught_signal, has_caught_signal
   use plydyn_base_text, only : text
   use plydyn_io_job, only : job_type
   use plydyn_method_observer, only : observer_type, requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_run_control_file, only : control_requests_type, take_requests
   use plydyn_state_file_positions, only : file_positions_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: new_run_control

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
      type(control_requests_type) :: requests
   contains
      procedure :: look_for_requests
      procedure :: pass_requests
      procedure :: save
   end type run_control_type

   !> Seconds between two looks for the control file
   real(wp), parameter :: seconds_per_look = 0.25_wp

contains

   !> Start the clock
   function new_run_control(comm, job, most_seconds) result(self)
      !> The ranks
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

   !> Pass the requests that were found to the others
   subroutine pass_requests(self, simulation, requests)
      class(run_control_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(requests_type), intent(inout) :: requests

      character(:), allocatable :: asked_by
      type(control_requests_type) :: asked

      call share_requests(self, simulation%domain%comm, asked_by, asked)
      requests%end_time = asked%end_time
      requests%fields = asked%plot
      requests%progress = asked%status
      requests%flush = asked%flush
      requests%checkpoint = asked%dump
      if (len(asked_by) > 0 .and. .not. simulation%state%is_finished()) then
         requests%checkpoint = .true.
         requests%stopped_by = asked_by
      end if
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

      integer(int64) :: now, rate
      logical :: found

      call system_clock(now, rate)
      if (real(now - self%started, wp)/rate > self%most_seconds) then
         self%asked_by = "the wall-clock limit of "//text(self%most_seconds)//" s"
         self%has_request = .true.
      end if
      if (now - self%looked < seconds_per_look*rate) return
      self%looked = now
      call take_requests(self%job%path//".ctl", time, self%requests, found)
      if (.not. found) return
      self%has_request = .true.
      call self%job%note(self%requests%answer)
      if (self%requests%stop .and. len(self%asked_by) == 0) self%asked_by = self%job%path//".ctl"
   end subroutine look_at_root

   !> Let all ranks have the requests of the root, and a signal to any rank
   subroutine share_requests(self, comm, asked_by, requests)
      class(run_control_type), intent(inout) :: self
      type(comm_type), intent(in) :: comm
      !> Reason for a stop, empty for none
      character(:), allocatable, intent(out) :: asked_by
      type(control_requests_type), intent(out) :: requests

      integer :: flags(5)
      real(wp) :: end_time(1)

      asked_by = self%asked_by
      if (has_caught_signal()) asked_by = caught_signal()
      if (self%has_request) requests = self%requests
      call comm%broadcast(asked_by)
      flags(:) = merge(1, 0, [requests%dump, requests%plot, requests%status, requests%flush, &
         & self%has_request])
      self%has_request = .false.
      end_time(1) = requests%end_time
      call comm%broadcast(flags)
      call comm%broadcast(end_time)
      requests%dump = flags(1) == 1
      requests%plot = flags(2) == 1
      requests%status = flags(3) == 1
      requests%flush = flags(4) == 1
      requests%end_time = end_time(1)
      ! a request, but not at the root
      if (len(asked_by) == 0 .and. sum(flags) == 0) asked_by = "a signal to one of the ranks"
   end subroutine share_requests

end module plydyn_run_run_control
