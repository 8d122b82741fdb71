!> Momentum of the impactors along z, JOB.momentum.csv.
module momentum_history
   use plydyn_io_csv_history_file, only : row_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_method_simulation, only : simulation_type
   implicit none
   private

   !> The history
   type, public, extends(history_recorder_type) :: momentum_history_type
   contains
      procedure :: prepare
      procedure :: put_columns
   end type momentum_history_type

contains

   !> If there is an impactor
   subroutine prepare(self, simulation)
      class(momentum_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation

      if (size(simulation%model%impactors) == 0) return
      self%ending = ".momentum.csv"
      self%interval = simulation%model%request%impactor_interval
      self%reads_motion = .false.
   end subroutine prepare

   !> Names, units and values of all columns
   subroutine put_columns(self, simulation, row)
      class(momentum_history_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      type(row_type), intent(inout) :: row

      associate (unit => simulation%model%control%units, state => simulation%state, &
         & impactors => simulation%domain%contact%impactors)
         call row%put("time", unit%time, state%time)
         call row%put("momentum", unit%impulse(), &
            & sum(impactors%mass*state%impactors%velocity(3)))
      end associate
   end subroutine put_columns

end module momentum_history
