!> Schedules and writes restart files.
module plydyn_run_checkpoint_writer
   use plydyn_base_error, only : error_type, exit_stopped, fail
   use plydyn_base_text, only : text
   use plydyn_io_checkpoint_dump, only : write_dump
   use plydyn_io_checkpoint_state_layout, only : state_layout_type
   use plydyn_io_job, only : broadcast_file_positions, job_type
   use plydyn_method_clock, only : every_steps
   use plydyn_method_observer, only : observer_type, requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_model_control, only : request_type
   use plydyn_state_file_positions, only : file_positions_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: new_checkpoint_writer

   !> Writes restart files
   type, public, extends(observer_type) :: checkpoint_writer_type
      private
      !> The job; counts its restart files that are kept
      type(job_type) :: job
      !> Layout of the arrays of the whole model
      type(state_layout_type) :: layout
      !> Has the steps between two restart files that are kept, and between two that replace older
      !> ones, 0 for none; how many there are of the latter
      type(request_type) :: request
      !> Whether another observer asks for a restart file of this step
      logical :: is_requested = .false.
   contains
      procedure :: notify
      procedure :: save
   end type checkpoint_writer_type

contains

   !> Restart files of a job
   function new_checkpoint_writer(job, layout, request) result(self)
      !> The job, the same on all ranks
      type(job_type), intent(in) :: job
      !> Layout of the arrays of the whole model
      type(state_layout_type), intent(in) :: layout
      !> Output that the deck asks for
      type(request_type), intent(in) :: request
      type(checkpoint_writer_type) :: self

      integer :: cycles(2)

      self%job = job
      self%layout = layout
      self%request = request
      cycles(:) = [request%kept_cycles, request%running_cycles]
      self%clocks = every_steps(pack(cycles, cycles > 0))
   end function new_checkpoint_writer

   !> Ask for the positions of all files when a restart file is due
   subroutine notify(self, simulation, requests, error)
      class(checkpoint_writer_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      self%is_requested = requests%checkpoint
      requests%checkpoint = requests%checkpoint .or. self%is_due(simulation%state)
   end subroutine notify

   !> Write the restart file, and end the run if that is requested
   subroutine save(self, state, positions, requests, error)
      class(checkpoint_writer_type), intent(inout) :: self
      type(state_type), intent(inout) :: state
      type(file_positions_type), intent(inout) :: positions
      type(requests_type), intent(in) :: requests
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: path, when
      logical :: is_kept

      if (.not. requests%checkpoint) return
      is_kept = self%is_requested .or. is_kept_at(self%request%kept_cycles, state)
      if (is_kept) then
         self%job%dumps = self%job%dumps + 1
         path = kept_path(self%job)
      else
         path = running_path(self, state%cycle)
      end if
      call broadcast_file_positions(self%layout%comm, self%job%path, positions)
      call write_dump(path, self%job, positions, self%layout, state, error)
      if (allocated(error)) return
      when = " at cycle "//text(state%cycle)//", time "//text(state%time)
      if (is_kept) call self%job%note("restart file "//path//when)
      if (.not. allocated(requests%stopped_by)) return
      call fail(error, exit_stopped, "stopped by "//requests%stopped_by//when &
         & //"; continue with: plydyn restart "//path)
   end subroutine save

   !> Whether a restart file is one of those that are kept: at every so many steps, and at the end
   pure logical function is_kept_at(cycles, state)
      !> Steps between two files, 0 for none
      integer, intent(in) :: cycles
      !> The state at the end of a step
      type(state_type), intent(in) :: state

      is_kept_at = .false.
      if (cycles > 0) is_kept_at = mod(state%cycle, cycles) == 0 .or. state%is_finished()
   end function is_kept_at

   !> Path of a restart file that is kept
   pure function kept_path(job) result(path)
      type(job_type), intent(in) :: job
      character(:), allocatable :: path

      integer, parameter :: two_digits = 10

      path = job%path//".dump"//repeat("0", merge(1, 0, job%dumps < two_digits))//text(job%dumps)
   end function kept_path

   !> Path of a restart file that replaces an older one
   pure function running_path(self, cycle) result(path)
      type(checkpoint_writer_type), intent(in) :: self
      integer, intent(in) :: cycle
      character(:), allocatable :: path

      path = self%job%path//".runrsf"
      if (self%request%running_files > 1) path = path &
         & //text(modulo(cycle/self%request%running_cycles - 1, self%request%running_files) + 1)
   end function running_path

end module plydyn_run_checkpoint_writer
