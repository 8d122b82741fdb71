!> All files of field states of a job, which all ranks write together when their time has come.
module plydyn_io_vtkhdf_field_output
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_model, only : model_type
   use plydyn_io_vtkhdf_brick_fields, only : brick_fields_type
   use plydyn_io_vtkhdf_plate_fields, only : fields_type
   use plydyn_io_csv_history_file, only : schedule_type
   use plydyn_io_vtkhdf_interface_fields, only : interface_fields_type
   use plydyn_io_job, only : job_type
   use plydyn_io_checkpoint_file_positions, only : file_positions_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> The files; all ranks have their part of each, and come to every procedure
   type, public :: field_output_type
      private
      type(fields_type) :: fields
      type(interface_fields_type) :: interfaces
      type(brick_fields_type) :: bricks
      !> When a state is due
      type(schedule_type) :: schedule
      !> Time of the last state in the files
      real(wp) :: time = -1.0_wp
      !> What the instants are kept under
      character(:), allocatable :: instants
   contains
      procedure :: open => open_files
      procedure :: due
      procedure :: record
      procedure :: plot
      procedure :: mark
      procedure :: close => close_files
   end type field_output_type

   !> Endings of the files, and what their instants are kept under
   character(*), parameter :: fields_ending = ".vtkhdf", interfaces_ending = ".interfaces.vtkhdf", &
      & schedule_ending = ".vtkhdf instants"

contains

   !> Create all files, or go on with those of an earlier run
   subroutine open_files(self, job, model, domain, error)
      class(field_output_type), intent(inout) :: self
      !> The job, the same on all ranks
      type(job_type), intent(in) :: job
      !> The model
      type(model_type), intent(in) :: model
      !> The domain of this rank
      type(domain_type), intent(in) :: domain
      !> Why a file could not be created; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      self%instants = job%path//schedule_ending
      self%schedule%interval = model%request%field_interval
      call self%schedule%resume(job%places%at(self%instants))
      call self%fields%open(job%path//fields_ending, job%deck, job%version, model, domain, &
         & job%places, error)
      if (allocated(error)) return
      call self%bricks%open(job%path//fields_ending, job%deck, job%version, model, domain, &
         & job%places, error)
      if (allocated(error)) return
      call self%interfaces%open(job%path//interfaces_ending, job%deck, job%version, model, domain, &
         & job%places, error)
   end subroutine open_files

   !> Add the state to the files if it is due, or the last
   subroutine record(self, domain, state, error)
      class(field_output_type), intent(inout) :: self
      !> The domain of this rank
      type(domain_type), intent(in) :: domain
      !> Its state
      type(state_type), intent(in) :: state
      !> Why it could not be written; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      if (.not. self%due(state%time, state%is_finished())) return
      call self%schedule%advance(state%time)
      call write_state(self, domain, state, error)
   end subroutine record

   !> Whether `record` will have a state to write at some time
   pure logical function due(self, time, is_last)
      class(field_output_type), intent(in) :: self
      !> The time, and whether it is the end
      real(wp), intent(in) :: time
      logical, intent(in) :: is_last

      due = is_last .or. self%schedule%due(time)
   end function due

   !> Add the state to the files, if it is not there already
   subroutine plot(self, domain, state, error)
      class(field_output_type), intent(inout) :: self
      !> The domain of this rank
      type(domain_type), intent(in) :: domain
      !> Its state
      type(state_type), intent(in) :: state
      !> Why it could not be written; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      if (state%time > self%time) call write_state(self, domain, state, error)
   end subroutine plot

   !> Add the state to the files
   subroutine write_state(self, domain, state, error)
      type(field_output_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      type(error_type), allocatable, intent(out) :: error

      self%time = state%time
      call self%fields%write(domain, state, error)
      if (.not. allocated(error)) call self%bricks%write(domain, state, error)
      if (.not. allocated(error)) call self%interfaces%write(domain, state, error)
   end subroutine write_state

   !> Bring all files to the disk, and note how far each of them goes
   subroutine mark(self, places, error)
      class(field_output_type), intent(inout) :: self
      !> Places in all files
      type(file_positions_type), intent(inout) :: places
      !> Why something is not on the disk; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      call places%add(self%instants, self%schedule%mark(0_int64))
      call self%fields%mark(places, error)
      if (.not. allocated(error)) call self%bricks%mark(places, error)
      if (.not. allocated(error)) call self%interfaces%mark(places, error)
   end subroutine mark

   !> Close all files, also after an error
   subroutine close_files(self, error)
      class(field_output_type), intent(inout) :: self
      !> The first file that could not be closed; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: each

      call self%fields%close(error)
      call self%bricks%close(each)
      if (.not. allocated(error)) call move_alloc(each, error)
      call self%interfaces%close(each)
      if (.not. allocated(error)) call move_alloc(each, error)
   end subroutine close_files

end module plydyn_io_vtkhdf_field_output
