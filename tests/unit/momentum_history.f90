!> Momentum of the impactors along z, JOB.momentum.csv.
module momentum_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_method_contact_step, only : contacts_type
   use plydyn_model_model, only : model_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> The history
   type, public, extends(history_recorder_type) :: momentum_history_type
   contains
      procedure :: open => open_momentum
      procedure :: record => record_momentum
   end type momentum_history_type

contains

   !> Create the file, or go on with it, where there is an impactor
   subroutine open_momentum(self, job, model, domain, error)
      class(momentum_history_type), intent(inout) :: self
      !> As in `output_type`
      type(job_type), intent(in) :: job
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      character(20) :: columns(2, 2)

      if (size(model%impactors) == 0) return
      self%reads_motion = .false.
      columns(:, 1) = [character(20) :: "time", "momentum"]
      columns(:, 2) = [character(20) :: model%control%units%time, &
         & trim(model%control%units%force)//" "//model%control%units%time]
      call self%open_file(job, domain%comm, job%path//".momentum.csv", columns, &
         & model%request%impactor_interval, error)
   end subroutine open_momentum

   !> Add a line
   subroutine record_momentum(self, domain, contacts, state, error)
      class(momentum_history_type), intent(inout) :: self
      !> As in `history_recorder_type`
      type(domain_type), intent(in) :: domain
      type(contacts_type), intent(in) :: contacts
      type(state_type), intent(in) :: state
      type(error_type), allocatable, intent(out) :: error

      call self%write_line([state%time, &
         & sum(domain%contact%impactors%mass*state%impactors%velocity(3))], error)
   end subroutine record_momentum

end module momentum_history
