!> The history of the linear constraints, JOB.constraints.csv: the sum of displacements and the
!> force along it.
module plydyn_io_csv_constraint_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_method_simulation, only : simulation_type
   implicit none
   private

   !> Most characters of a header
   integer, parameter :: header_length = 30

   !> The history
   type, public, extends(history_recorder_type) :: constraint_history_type
      private
      !> The line
      real(wp), allocatable :: row(:)
   contains
      procedure :: open => open_constraints
      procedure :: record => record_constraints
   end type constraint_history_type

contains

   !> Create the file, or append to that of the restart, if the deck has constraints and asks for
   !> forces of supports
   subroutine open_constraints(self, job, simulation, error)
      class(constraint_history_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      character(header_length), dimension(1 &
         & + 2*size(simulation%model%constraints)) :: names, units
      integer :: i

      associate (model => simulation%model, u => simulation%model%control%units)
         if (size(model%constraints) == 0 .or. model%request%support_interval < 0.0_wp) return
         self%reads_motion = .false.
         names(1) = "time"
         units(1) = u%time
         do i = 1, size(model%constraints)
            names(2*i) = "displacement "//text(model%constraints(i)%id)
            names(2*i + 1) = "force "//text(model%constraints(i)%id)
            units(2*i:2*i + 1) = [u%length, u%force]
         end do
         allocate (self%row(size(names)))
         call self%open_file(job, simulation, ".constraints.csv", names, units, &
            & model%request%support_interval, error)
      end associate
   end subroutine open_constraints

   !> Add a line; all ranks have its numbers
   subroutine record_constraints(self, simulation, error)
      class(constraint_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      associate (constraints => simulation%state%supports%constraints)
         self%row(1) = simulation%state%time
         self%row(2::2) = constraints%displacement
         self%row(3::2) = constraints%force
      end associate
      call self%write_line(self%row, error)
   end subroutine record_constraints

end module plydyn_io_csv_constraint_history
