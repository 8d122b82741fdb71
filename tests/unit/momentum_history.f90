!> Momentum of the impactors along z, JOB.momentum.csv.
module momentum_history
   use plydyn_base_error, only : error_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_method_simulation, only : simulation_type
   implicit none
   private

   !> The history
   type, public, extends(history_recorder_type) :: momentum_history_type
   contains
      procedure :: open => open_momentum
      procedure :: record => record_momentum
   end type momentum_history_type

contains

   !> Create the file, or append to the one of the restart, if there is an impactor
   subroutine open_momentum(self, job, simulation, error)
      class(momentum_history_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      character(20) :: names(2), units(2)

      associate (model => simulation%model, u => simulation%model%control%units)
         if (size(model%impactors) == 0) return
         self%reads_motion = .false.
         names(:) = [character(20) :: "time", "momentum"]
         units(:) = [character(20) :: u%time, trim(u%force)//" "//u%time]
         call self%open_file(job, simulation, ".momentum.csv", names, units, &
            & model%request%impactor_interval, error)
      end associate
   end subroutine open_momentum

   !> Add a line
   subroutine record_momentum(self, simulation, error)
      class(momentum_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      associate (state => simulation%state, impactors => simulation%domain%contact%impactors)
         call self%write_line([state%time, sum(impactors%mass*state%impactors%velocity(3))], error)
      end associate
   end subroutine record_momentum

end module momentum_history
