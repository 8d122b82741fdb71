!> An observer that writes a history: a line whenever its instant has come, and at the end.
module plydyn_io_csv_history_recorder
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_io_csv_history_file, only : history_file_type, new_row, row_type
   use plydyn_io_job, only : job_type, output_type
   use plydyn_method_clock, only : every_interval
   use plydyn_method_observer, only : requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_model_symmetry, only : copies
   use plydyn_parallel_comm, only : comm_type
   use plydyn_state_file_positions, only : file_positions_type
   implicit none
   private

   !> A history: an extension says in `put_columns` what its columns are, and in `prepare` what the
   !> deck asks for, unless it is made with that
   type, abstract, public, extends(output_type) :: history_recorder_type
      !> What the path of the file has behind that of the results; not allocated where the deck asks
      !> for no such history
      character(:), allocatable :: ending
      !> Time between two instants, 0 for every step, and the lines at each: the same on all ranks
      real(wp) :: interval = 0.0_wp
      integer :: lines = 1
      !> The ranks
      type(comm_type) :: comm
      !> Columns of a line; 0 before it is opened
      integer, private :: columns = 0
      !> The file, open on the root
      type(history_file_type), private :: file
   contains
      procedure :: prepare
      procedure(put_columns), deferred :: put_columns
      procedure, non_overridable :: fill
      procedure :: open => open_recorder
      procedure :: open_recorder
      procedure :: record => record_row
      procedure :: record_row
      procedure :: begin => record_due
      procedure :: record_due
      procedure :: notify
      procedure :: mark => mark_file
      procedure :: mark_file
      procedure :: close => close_recorder
   end type history_recorder_type

   abstract interface
      !> Put all columns into a row: names and units, or values. All ranks come here for values
      subroutine put_columns(self, simulation, row)
         import :: history_recorder_type, row_type, simulation_type
         implicit none
         class(history_recorder_type), intent(in) :: self
         !> The simulation at the end of a step
         class(simulation_type), intent(in) :: simulation
         !> The row
         type(row_type), intent(inout) :: row
      end subroutine put_columns
   end interface

contains

   !> Set ending, interval and lines, if the deck asks for the history and they are not set. Any
   !> rank may come here
   subroutine prepare(self, simulation)
      class(history_recorder_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
   end subroutine prepare

   !> Let the root create the file, or append to the one of the restart. All ranks come here
   subroutine open_recorder(self, job, simulation, error)
      class(history_recorder_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      !> The simulation, which has the ranks
      class(simulation_type), intent(in) :: simulation
      !> Why it could not be created; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      type(row_type) :: heading

      if (.not. allocated(self%ending)) call self%prepare(simulation)
      if (.not. allocated(self%ending)) return
      self%comm = simulation%domain%comm
      call self%fill(simulation, heading)
      self%columns = heading%columns
      self%clocks = [every_interval(self%interval)]
      associate (path => job%path//self%ending)
         associate (position => job%places%at(path))
            if (position%amount >= 0) call self%clocks%resume(position)
         end associate
         if (self%comm%is_root()) call self%file%open(path, heading, job%places, error)
      end associate
      call self%comm%broadcast(error)
   end subroutine open_recorder

   !> Put all columns into a row, and in a model of a part of the plate what share it is
   subroutine fill(self, simulation, row)
      class(history_recorder_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      !> The row
      type(row_type), intent(inout) :: row

      call self%put_columns(simulation, row)
      if (copies(simulation%model) > 1) then
         call row%put("share of the whole plate", "-", 1.0_wp/copies(simulation%model))
      end if
   end subroutine fill

   !> Write the lines of this time. All ranks come here
   subroutine record_row(self, simulation, error)
      class(history_recorder_type), intent(inout) :: self
      !> The simulation at the end of a step
      class(simulation_type), intent(in) :: simulation
      !> Why they could not be written; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      type(row_type) :: row

      row = new_row(self%columns)
      call self%fill(simulation, row)
      if (self%comm%is_root()) call self%file%write_line(row, error)
      call self%comm%broadcast(error)
   end subroutine record_row

   !> Write the lines, if they are due
   subroutine record_due(self, simulation, error)
      class(history_recorder_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      if (self%is_due(simulation%state)) call self%record(simulation, error)
   end subroutine record_due

   !> The lines of a step
   subroutine notify(self, simulation, requests, error)
      class(history_recorder_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      call self%record_due(simulation, error)
   end subroutine notify

   !> Put all lines on the disk, and add how far the file has been written
   subroutine mark_file(self, positions, error)
      class(history_recorder_type), intent(inout) :: self
      !> Positions in all files
      type(file_positions_type), intent(inout) :: positions
      !> Why the lines are not all there; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      if (self%columns == 0) return
      if (self%comm%is_root()) call self%file%mark(self%clocks(1), positions, error)
      call self%comm%broadcast(error)
   end subroutine mark_file

   !> Close the file
   subroutine close_recorder(self, simulation, outcome, error)
      class(history_recorder_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(in) :: outcome
      !> Why it could not be closed; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      if (self%columns == 0) return
      if (self%comm%is_root()) call self%file%close(error)
      call self%comm%broadcast(error)
   end subroutine close_recorder

end module plydyn_io_csv_history_recorder
