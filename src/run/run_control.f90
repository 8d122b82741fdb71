!> Looks after a run from outside of it: restart files, and requests to stop.
module plydyn_run_run_control
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_stopped, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_signals, only : caught_signal, has_caught_signal
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_control, only : request_type
   use plydyn_io_job, only : job_type
   use plydyn_io_checkpoint_file_positions, only : file_positions_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_method_contact_step, only : contacts_type
   use plydyn_run_output_manager, only : output_manager_type
   use plydyn_run_control_file, only : control_requests_type, take_requests
   use plydyn_state_state, only : attention_sum, halt_sum, state_type
   implicit none
   private

   !> What looks after a run
   type, public :: run_control_type
      private
      !> The job; counts its restart files
      type(job_type) :: job
      !> Steps between two restart files that are kept, and between two that replace each other, 0
      !> for none; how many there are of the latter
      integer :: kept_cycles = 0, running_cycles = 0, running_files = 1
      !> Seconds on the wall that the run may take; huge for any number
      real(wp) :: most_seconds = huge(1.0_wp)
      !> Clock at the start, and at the last look for requests
      integer(int64) :: started = 0_int64, looked = 0_int64
      !> Whether this rank looks at the clock and for files
      logical :: is_root = .true.
      !> What was found in this step: whether anything, who asks the run to stop, and what else
      logical :: is_asked = .false.
      character(:), allocatable :: asked_by
      type(control_requests_type) :: requests
   contains
      procedure :: start
      procedure :: announce
      procedure :: look
   end type run_control_type

   !> Seconds between two looks for requests in a file
   real(wp), parameter :: seconds_per_look = 0.25_wp

contains

   !> Begin to look after a run
   subroutine start(self, comm, job, request, most_seconds)
      class(run_control_type), intent(inout) :: self
      !> The ranks
      type(comm_type), intent(in) :: comm
      !> The job, the same on all ranks
      type(job_type), intent(in) :: job
      !> What the deck asks for
      type(request_type), intent(in) :: request
      !> Seconds on the wall that the run may take
      real(wp), intent(in) :: most_seconds

      self%is_root = comm%is_root()
      self%asked_by = ""
      self%job = job
      self%kept_cycles = request%kept_cycles
      self%running_cycles = request%running_cycles
      self%running_files = request%running_files
      self%most_seconds = most_seconds
      call system_clock(self%started)
      self%looked = self%started
   end subroutine start

   !> Before the sums of a step are made: let all ranks know that this one is asked for something,
   !> or that a restart file will be due after the next
   subroutine announce(self, state)
      class(run_control_type), intent(inout) :: self
      !> The state; the sums are counted
      type(state_type), intent(inout) :: state

      logical :: is_last

      call find_requests(self, state)
      if (has_caught_signal() .or. self%is_asked) call state%tally%add(attention_sum, 1.0_wp)
      is_last = state%ends_after(state%step_after)
      if (is_due(self%kept_cycles, state%cycle + 1, is_last) &
         & .or. is_due(self%running_cycles, state%cycle + 1, is_last)) then
         call state%tally%add(halt_sum, 1.0_wp)
      end if
   end subroutine announce

   !> After a step: write the restart files that are due, and do what is asked for. Where the points
   !> have gone ahead nothing is due, and what is asked for is done after the next step
   subroutine look(self, domain, contacts, state, journal, error)
      class(run_control_type), intent(inout) :: self
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Contacts, which put their memory into the state
      type(contacts_type), intent(in) :: contacts
      !> The state; says whether any rank is asked for something
      type(state_type), intent(inout) :: state
      !> What writes the results
      type(output_manager_type), intent(inout) :: journal
      !> The run is to stop, or a restart file could not be written; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: asked_by, path
      type(control_requests_type) :: requests
      logical :: is_running, keep

      if (state%is_ahead) return
      keep = is_due(self%kept_cycles, state%cycle, state%is_finished())
      is_running = is_due(self%running_cycles, state%cycle, state%is_finished())
      if (.not. (state%attention .or. keep .or. is_running)) return
      asked_by = ""
      if (state%attention) call take_orders(self, domain%comm, asked_by, requests)
      if (requests%end_time > 0.0_wp) then
         state%end_time = requests%end_time
         ! which may be the end of the next step
         state%halts = .true.
      end if
      if (requests%plot) call journal%plot(domain, state, error)
      if (allocated(error)) return
      if (requests%status) call journal%tell(state)
      if (state%is_finished()) asked_by = ""
      keep = keep .or. len(asked_by) > 0 .or. requests%dump
      if (keep) then
         self%job%dumps = self%job%dumps + 1
         path = kept_path(self%job)
      else if (is_running) then
         path = running_path(self, state)
      else
         if (requests%flush) call flush_all(self, journal, error)
         return
      end if
      call contacts%remember(state)
      call journal%dump(path, self%job, state, error)
      if (allocated(error)) return
      if (keep) call self%job%note("restart file "//path//" at cycle "//text(state%cycle) &
         & //", time "//text(state%time))
      if (len(asked_by) > 0) call fail(error, exit_stopped, "stopped by "//asked_by &
         & //" at cycle "//text(state%cycle)//", time "//text(state%time) &
         & //"; to go on: plydyn restart "//path)
   end subroutine look

   !> Look for signals, at the clock, and for a file of requests, all but the first on the root
   subroutine find_requests(self, state)
      class(run_control_type), intent(inout) :: self
      type(state_type), intent(in) :: state

      integer(int64) :: now, rate
      logical :: found

      ! what was found before is still to be done
      if (self%is_asked .or. .not. self%is_root) return
      call system_clock(now, rate)
      if (real(now - self%started, wp)/rate > self%most_seconds) then
         self%asked_by = "the limit of "//text(self%most_seconds)//" s on the wall"
         self%is_asked = .true.
      end if
      if (now - self%looked < seconds_per_look*rate) return
      self%looked = now
      call take_requests(self%job%path//".ctl", state%time, self%requests, found)
      if (.not. found) return
      self%is_asked = .true.
      call self%job%note(self%requests%answer)
      if (self%requests%stop .and. len(self%asked_by) == 0) self%asked_by = self%job%path//".ctl"
   end subroutine find_requests

   !> What the root was asked for, and who asks the run to stop, a signal to any rank too
   subroutine take_orders(self, comm, asked_by, requests)
      class(run_control_type), intent(inout) :: self
      type(comm_type), intent(in) :: comm
      !> Empty when nobody does
      character(:), allocatable, intent(out) :: asked_by
      type(control_requests_type), intent(out) :: requests

      integer :: orders(5)
      real(wp) :: end_time(1)

      asked_by = self%asked_by
      if (has_caught_signal()) asked_by = caught_signal()
      if (self%is_asked) requests = self%requests
      call comm%broadcast(asked_by)
      orders(:) = merge(1, 0, [requests%dump, requests%plot, requests%status, requests%flush, &
         & self%is_asked])
      self%is_asked = .false.
      end_time(1) = requests%end_time
      call comm%broadcast(orders)
      call comm%broadcast(end_time)
      requests%dump = orders(1) == 1
      requests%plot = orders(2) == 1
      requests%status = orders(3) == 1
      requests%flush = orders(4) == 1
      requests%end_time = end_time(1)
      ! attention, but not the root's
      if (len(asked_by) == 0 .and. sum(orders) == 0) asked_by = "a signal to one of the ranks"
   end subroutine take_orders

   !> Whether a restart file is due: at every so many steps, and at the end
   pure logical function is_due(cycles, cycle, is_last)
      !> Steps between two files, 0 for none
      integer, intent(in) :: cycles
      !> Steps made, and whether that is the end
      integer, intent(in) :: cycle
      logical, intent(in) :: is_last

      is_due = .false.
      if (cycles > 0) is_due = mod(cycle, cycles) == 0 .or. is_last
   end function is_due

   !> Path of the restart file that is to be kept
   function kept_path(job) result(path)
      type(job_type), intent(in) :: job
      character(:), allocatable :: path

      integer, parameter :: two_digits = 10

      path = job%path//".dump"//repeat("0", merge(1, 0, job%dumps < two_digits))//text(job%dumps)
   end function kept_path

   !> Path of the restart file that replaces an older one
   function running_path(self, state) result(path)
      type(run_control_type), intent(in) :: self
      type(state_type), intent(in) :: state
      character(:), allocatable :: path

      path = self%job%path//".runrsf"
      if (self%running_files > 1) path = path &
         & //text(modulo(state%cycle/self%running_cycles - 1, self%running_files) + 1)
   end function running_path

   !> Bring all results to the disk
   subroutine flush_all(self, journal, error)
      type(run_control_type), intent(in) :: self
      type(output_manager_type), intent(inout) :: journal
      type(error_type), allocatable, intent(out) :: error

      type(file_positions_type) :: places

      call journal%keep(places, error)
      if (.not. allocated(error)) call self%job%note("all results are on the disk")
   end subroutine flush_all

end module plydyn_run_run_control
