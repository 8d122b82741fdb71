!> The history of force and motion of an impactor, JOB.impactor_ID.csv.
module plydyn_io_csv_impactor_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_method_simulation, only : simulation_type
   implicit none
   private

   public :: new_impactor_history

   !> Columns
   character(20), parameter :: names(*) = [character(20) :: "time", "force", "displacement", &
      & "velocity", "kinetic", "absorbed", "force x", "force y", "contacts", "penetration", &
      & "displacement x", "displacement y", "velocity x", "velocity y", "angular velocity x", &
      & "angular velocity y", "angular velocity z", "impulse x", "impulse y", "impulse z", &
      & "friction"]

   !> The history
   type, public, extends(history_recorder_type) :: impactor_history_type
      private
      !> Index of the impactor
      integer :: impactor = 0
   contains
      procedure :: open => open_impactor
      procedure :: record => record_impactor
   end type impactor_history_type

contains

   !> The history of an impactor
   pure type(impactor_history_type) function new_impactor_history(impactor) result(self)
      !> Index of the impactor
      integer, intent(in) :: impactor

      self%impactor = impactor
      self%reads_motion = .false.
   end function new_impactor_history

   !> Create the file, or append to the one of the restart
   subroutine open_impactor(self, job, simulation, error)
      class(impactor_history_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      character(20) :: units(size(names)), velocity
      integer :: c

      associate (u => simulation%model%control%units)
         velocity = trim(u%length)//"/"//u%time
         units(:) = [character(20) :: u%time, u%force, u%length, velocity, u%energy, &
            & u%energy, u%force, u%force, "-", u%length, u%length, u%length, velocity, velocity, &
            & ("1/"//u%time, c=1, 3), (trim(u%force)//" "//u%time, c=1, 3), u%energy]
      end associate
      call self%open_file(job, simulation, ".impactor_" &
         & //text(simulation%model%impactors(self%impactor)%id)//".csv", names, units, &
         & simulation%model%request%impactor_interval, error)
   end subroutine open_impactor

   !> Add a line, from numbers that all ranks have alike
   subroutine record_impactor(self, simulation, error)
      class(impactor_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: kinetic, start

      associate (own => simulation%state%impactors(self%impactor), &
         & impactor => simulation%domain%contact%impactors(self%impactor))
         kinetic = 0.5_wp*impactor%mass*sum(own%velocity**2)
         if (impactor%rotates) kinetic = kinetic + 0.5_wp*impactor%inertia*sum(own%spin**2)
         start = 0.5_wp*impactor%mass*sum(impactor%velocity**2)
         call self%write_line([simulation%state%time, own%force(3), own%displacement(3), &
            & own%velocity(3), kinetic, start + own%work - kinetic, own%force(1:2), &
            & real(own%contacts, wp), own%penetration, own%displacement(:2), own%velocity(:2), &
            & own%spin, own%impulse, own%friction], error)
      end associate
   end subroutine record_impactor

end module plydyn_io_csv_impactor_history
