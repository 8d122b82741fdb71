!> Looks after a run from outside of it: restart files, and requests to stop.
module plydyn_solver_watch
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_stopped, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_signals, only : caught_signal, has_caught_signal
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_control, only : request_type
   use plydyn_output_dump, only : write_dump
   use plydyn_output_job, only : job_type
   use plydyn_output_places, only : places_type
   use plydyn_output_writer, only : writer_type
   use plydyn_solver_contacts, only : contacts_type
   use plydyn_solver_requests, only : requests_type, take_requests
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> What looks after a run
   type, public :: watch_type
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
   contains
      procedure :: start
      procedure :: look
   end type watch_type

   !> Seconds between two looks for requests in a file
   real(wp), parameter :: seconds_per_look = 0.25_wp

contains

   !> Begin to look after a run
   subroutine start(self, job, request, most_seconds)
      class(watch_type), intent(inout) :: self
      !> The job
      type(job_type), intent(in) :: job
      !> What the deck asks for
      type(request_type), intent(in) :: request
      !> Seconds on the wall that the run may take
      real(wp), intent(in) :: most_seconds

      self%job = job
      self%kept_cycles = request%kept_cycles
      self%running_cycles = request%running_cycles
      self%running_files = request%running_files
      self%most_seconds = most_seconds
      call system_clock(self%started)
      self%looked = self%started
   end subroutine start

   !> After a step: write the restart files that are due, and do what is asked for
   subroutine look(self, domain, contacts, state, writer, error)
      class(watch_type), intent(inout) :: self
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Contacts, which put their memory into the state
      type(contacts_type), intent(in) :: contacts
      !> The state
      type(state_type), intent(inout) :: state
      !> What writes the results
      type(writer_type), intent(inout) :: writer
      !> The run is to stop, or a restart file could not be written
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: asked_by, path
      type(requests_type) :: requests
      logical :: keep

      call find_requests(self, state, asked_by, requests)
      if (requests%end_time > 0.0_wp) state%end_time = requests%end_time
      if (requests%plot) call writer%plot(domain, state, error)
      if (allocated(error)) return
      if (requests%status) call writer%tell(state)
      if (allocated(asked_by) .and. state%is_finished()) deallocate (asked_by)
      keep = allocated(asked_by) .or. requests%dump .or. is_due(self%kept_cycles, state)
      if (keep) then
         self%job%dumps = self%job%dumps + 1
         path = kept_path(self%job)
      else if (is_due(self%running_cycles, state)) then
         path = running_path(self, state)
      else
         if (requests%flush) call flush_all(self, writer, error)
         return
      end if
      call save_run(self, path, contacts, state, writer, error)
      if (allocated(error)) return
      if (keep) call self%job%note("restart file "//path//" at cycle "//text(state%cycle) &
         & //", time "//text(state%time))
      if (allocated(asked_by)) call fail(error, exit_stopped, "stopped by "//asked_by &
         & //" at cycle "//text(state%cycle)//", time "//text(state%time) &
         & //"; to go on: plydyn restart "//path)
   end subroutine look

   !> Who asks the run to stop, and what else is asked for
   subroutine find_requests(self, state, asked_by, requests)
      class(watch_type), intent(inout) :: self
      type(state_type), intent(in) :: state
      !> Not allocated when nobody does
      character(:), allocatable, intent(out) :: asked_by
      type(requests_type), intent(out) :: requests

      integer(int64) :: now, rate
      logical :: found

      if (has_caught_signal()) asked_by = caught_signal()
      call system_clock(now, rate)
      if (.not. allocated(asked_by) &
         & .and. real(now - self%started, wp)/rate > self%most_seconds) then
         asked_by = "the limit of "//text(self%most_seconds)//" s on the wall"
      end if
      if (now - self%looked < seconds_per_look*rate) return
      self%looked = now
      call take_requests(self%job%path//".ctl", state%time, requests, found)
      if (.not. found) return
      call self%job%note(requests%answer)
      if (requests%stop .and. .not. allocated(asked_by)) asked_by = self%job%path//".ctl"
   end subroutine find_requests

   !> Whether a restart file is due: at every so many steps, and at the end
   pure logical function is_due(cycles, state)
      !> Steps between two files, 0 for none
      integer, intent(in) :: cycles
      type(state_type), intent(in) :: state

      is_due = .false.
      if (cycles > 0) is_due = mod(state%cycle, cycles) == 0 .or. state%is_finished()
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
      type(watch_type), intent(in) :: self
      type(state_type), intent(in) :: state
      character(:), allocatable :: path

      path = self%job%path//".runrsf"
      if (self%running_files > 1) path = path &
         & //text(modulo(state%cycle/self%running_cycles - 1, self%running_files) + 1)
   end function running_path

   !> Write a restart file
   subroutine save_run(self, path, contacts, state, writer, error)
      type(watch_type), intent(inout) :: self
      character(*), intent(in) :: path
      type(contacts_type), intent(in) :: contacts
      type(state_type), intent(inout) :: state
      type(writer_type), intent(inout) :: writer
      type(error_type), allocatable, intent(out) :: error

      type(places_type) :: places

      call contacts%remember(state)
      call writer%keep(places, error)
      if (allocated(error)) return
      call write_dump(path, self%job, places, state, error)
   end subroutine save_run

   !> Bring all results to the disk
   subroutine flush_all(self, writer, error)
      type(watch_type), intent(in) :: self
      type(writer_type), intent(inout) :: writer
      type(error_type), allocatable, intent(out) :: error

      type(places_type) :: places

      call writer%keep(places, error)
      if (.not. allocated(error)) call self%job%note("all results are on the disk")
   end subroutine flush_all

end module plydyn_solver_watch
