!> Fields: an observer that writes states of the whole model to VTKHDF files.
module plydyn_io_vtkhdf_field_output
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_run
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_io_job, only : job_type
   use plydyn_io_output, only : output_type
   use plydyn_io_schedule, only : schedule_type
   use plydyn_io_vtkhdf_element_fields, only : element_fields_type
   use plydyn_io_vtkhdf_interface_fields, only : interface_fields_type
   use plydyn_method_contact_step, only : contacts_type
   use plydyn_method_observer, only : requests_type
   use plydyn_model_model, only : model_type
   use plydyn_state_file_positions, only : file_positions_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> The files; each rank writes its part of them
   type, public, extends(output_type) :: field_output_type
      private
      type(element_fields_type) :: fields
      type(interface_fields_type) :: interfaces
      !> Instants of the states
      type(schedule_type) :: schedule
      !> Time of the last state in the files
      real(wp) :: time = -1.0_wp
      !> Name of the position that holds the instants
      character(:), allocatable :: instants
   contains
      procedure :: open => open_files
      procedure :: due
      procedure :: begin
      procedure :: notify
      procedure :: mark
      procedure :: close => close_files
   end type field_output_type

   !> Endings of the files, and of the position that holds their instants
   character(*), parameter :: fields_ending = ".vtkhdf", interfaces_ending = ".interfaces.vtkhdf", &
      & schedule_ending = ".vtkhdf instants"

contains

   !> Create all files, or go on with those of an earlier run
   subroutine open_files(self, job, model, domain, error)
      class(field_output_type), intent(inout) :: self
      !> As in `output_type`
      type(job_type), intent(in) :: job
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      self%instants = job%path//schedule_ending
      self%schedule%interval = model%request%field_interval
      call self%schedule%resume(job%places%at(self%instants))
      call self%fields%open(job%path//fields_ending, job%deck, job%version, model, domain, &
         & job%places, error)
      if (allocated(error)) return
      call self%interfaces%open(job%path//interfaces_ending, job%deck, job%version, model, domain, &
         & job%places, error)
   end subroutine open_files

   !> Whether a state is due at the end of a step
   pure logical function due(self, time, cycle, is_last)
      class(field_output_type), intent(in) :: self
      !> As in `observer_type`
      real(wp), intent(in) :: time
      integer, intent(in) :: cycle
      logical, intent(in) :: is_last

      due = is_last .or. self%schedule%due(time)
   end function due

   !> Add the state to the files, if it is due
   subroutine begin(self, domain, contacts, state, error)
      class(field_output_type), intent(inout) :: self
      !> As in `observer_type`
      type(domain_type), intent(in) :: domain
      type(contacts_type), intent(in) :: contacts
      type(state_type), intent(inout) :: state
      type(error_type), allocatable, intent(out) :: error

      if (.not. self%due(state%time, state%cycle, state%is_finished())) return
      call self%schedule%advance(state%time)
      call write_state(self, domain, state, error)
   end subroutine begin

   !> Add the state to the files, if it is due or requested
   subroutine notify(self, domain, contacts, state, requests, error)
      class(field_output_type), intent(inout) :: self
      !> As in `observer_type`
      type(domain_type), intent(in) :: domain
      type(contacts_type), intent(in) :: contacts
      type(state_type), intent(inout) :: state
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      call self%begin(domain, contacts, state, error)
      if (allocated(error)) return
      if (requests%fields .and. state%time > self%time) call write_state(self, domain, state, error)
   end subroutine notify

   !> Add the state to the files
   subroutine write_state(self, domain, state, error)
      type(field_output_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      type(error_type), allocatable, intent(out) :: error

      self%time = state%time
      call self%fields%write(domain, state, error)
      if (.not. allocated(error)) call self%interfaces%write(domain, state, error)
   end subroutine write_state

   !> Bring all files to the disk, and add how far each of them has been written
   subroutine mark(self, positions, error)
      class(field_output_type), intent(inout) :: self
      !> As in `observer_type`
      type(file_positions_type), intent(inout) :: positions
      type(error_type), allocatable, intent(out) :: error

      call positions%add(self%instants, self%schedule%mark(0_int64))
      call self%fields%mark(positions, error)
      if (.not. allocated(error)) call self%interfaces%mark(positions, error)
   end subroutine mark

   !> Close all files. A run that the method ended leaves its last state in them, if this can be
   !> written: the reason for the end is more important than a failure here
   subroutine close_files(self, domain, state, outcome, error)
      class(field_output_type), intent(inout) :: self
      !> As in `observer_type`
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      type(error_type), allocatable, intent(in) :: outcome
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: each

      if (allocated(outcome)) then
         if (outcome%code == exit_run .and. state%time > self%time) then
            call write_state(self, domain, state, each)
         end if
      end if
      call self%fields%close(error)
      call self%interfaces%close(each)
      if (.not. allocated(error)) call move_alloc(each, error)
   end subroutine close_files

end module plydyn_io_vtkhdf_field_output
