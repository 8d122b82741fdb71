!> An observer that writes a history: a line whenever its instant has come, and at the end.
module plydyn_io_csv_history_recorder
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_io_csv_history_file, only : history_file_type
   use plydyn_io_job, only : job_type
   use plydyn_io_output, only : output_type
   use plydyn_io_schedule, only : schedule_type
   use plydyn_method_observer, only : requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_model_symmetry, only : copies
   use plydyn_parallel_comm, only : comm_type
   use plydyn_state_file_positions, only : file_positions_type
   implicit none
   private

   !> A history; an extension calls `open_file` and `write_line`
   type, abstract, public, extends(output_type) :: history_recorder_type
      !> The ranks
      type(comm_type) :: comm
      !> Whether the deck asks for the history, and the instants of its lines: the same on all ranks
      logical :: is_active = .false.
      type(schedule_type) :: schedule
      !> How many times the model makes up the plate; above 1 the last column says so
      integer :: copies = 1
      !> The file, open on the root
      type(history_file_type), private :: file
   contains
      procedure(record_lines), deferred :: record
      procedure :: begin => record_due
      procedure :: record_due
      procedure :: notify
      procedure :: mark => mark_file
      procedure :: mark_file
      procedure :: close => close_recorder
      procedure :: open_file
      procedure :: write_line
   end type history_recorder_type

   abstract interface
      !> Write the lines of this time. All ranks come here
      subroutine record_lines(self, simulation, error)
         import :: error_type, history_recorder_type, simulation_type
         implicit none
         class(history_recorder_type), intent(inout) :: self
         !> The simulation at the end of a step
         class(simulation_type), intent(in) :: simulation
         !> Why they could not be written; the same on all ranks
         type(error_type), allocatable, intent(out) :: error
      end subroutine record_lines
   end interface

contains

   !> Write the lines, if they are due
   subroutine record_due(self, simulation, error)
      class(history_recorder_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      if (.not. self%is_due(simulation%state)) return
      call self%record(simulation, error)
      call self%schedule%advance(simulation%state%time)
      self%next%time = self%schedule%next_time()
   end subroutine record_due

   !> The lines of a step
   subroutine notify(self, simulation, requests, error)
      class(history_recorder_type), intent(inout) :: self
      class(simulation_type), intent(inout) :: simulation
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

      if (.not. self%is_active) return
      if (self%comm%is_root()) call self%file%mark(self%schedule, positions, error)
      call self%comm%broadcast(error)
   end subroutine mark_file

   !> Close the file
   subroutine close_recorder(self, simulation, outcome, error)
      class(history_recorder_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(in) :: outcome
      !> Why it could not be closed; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      if (.not. self%is_active) return
      if (self%comm%is_root()) call self%file%close(error)
      call self%comm%broadcast(error)
   end subroutine close_recorder

   !> Let the root create the file, or append to the one of the restart. All ranks come here
   subroutine open_file(self, job, simulation, ending, names, units, interval, error)
      class(history_recorder_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      !> The simulation, which has the ranks
      class(simulation_type), intent(in) :: simulation
      !> What the path of the file has behind that of the results
      character(*), intent(in) :: ending
      !> Name and unit of each column
      character(*), intent(in) :: names(:), units(:)
      !> Time between two lines; 0 for every step
      real(wp), intent(in) :: interval
      !> Why it could not be created; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      character(40), allocatable :: all_names(:), all_units(:)

      self%comm = simulation%domain%comm
      self%is_active = .true.
      self%copies = copies(simulation%model)
      all_names = names
      all_units = units
      if (self%copies > 1) then
         all_names = [character(40) :: all_names, "share of the whole plate"]
         all_units = [character(40) :: all_units, "-"]
      end if
      self%schedule = schedule_type(interval)
      associate (path => job%path//ending)
         associate (position => job%places%at(path))
            if (position%amount >= 0) call self%schedule%resume(position)
         end associate
         self%next%time = self%schedule%next_time()
         if (self%comm%is_root()) call self%file%open(path, all_names, all_units, &
            & job%places, error)
      end associate
      call self%comm%broadcast(error)
   end subroutine open_file

   !> Let the root write a line. All ranks come here
   subroutine write_line(self, values, error)
      class(history_recorder_type), intent(inout) :: self
      !> All columns; of use on the root alone
      real(wp), intent(in) :: values(:)
      !> Why it could not be written; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      if (self%comm%is_root()) then
         if (self%copies > 1) then
            call self%file%write_line([values, 1.0_wp/self%copies], error)
         else
            call self%file%write_line(values, error)
         end if
      end if
      call self%comm%broadcast(error)
   end subroutine write_line

end module plydyn_io_csv_history_recorder
