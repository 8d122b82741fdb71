!> The history of energies and momentum of the whole model, JOB.energy.csv.
module plydyn_io_csv_energy_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_delamination, only : can_fail, delamination, delamination_type
   use plydyn_domain_dissipation, only : dissipated_energies, hourglass_energy
   use plydyn_domain_domain, only : domain_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_law_law, only : mechanism_names, mechanisms
   use plydyn_method_contact_step, only : contacts_type
   use plydyn_model_model, only : model_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> Columns. A constant: gfortran 12 may blank the first word of a list of texts that is an actual
   !> argument
   character(20), parameter :: names(*) = [character(20) :: "cycle", "time", "step", "kinetic", &
      & "internal", "dissipated", "impactor", "damping", "external", "contact", &
      & "contact friction", mechanism_names, "hourglass", "half-step correction", "total", &
      & "error", "momentum x", "momentum y", "momentum z", "least volume"]

   !> The history
   type, public, extends(history_recorder_type) :: energy_history_type
   contains
      procedure :: open => open_energies
      procedure :: record => record_energies
   end type energy_history_type

contains

   !> Create the file, or go on with it
   subroutine open_energies(self, job, model, domain, error)
      class(energy_history_type), intent(inout) :: self
      !> As in `output_type`
      type(job_type), intent(in) :: job
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      character(20) :: columns(size(names), 2)

      associate (u => model%control%units)
         columns(:, 1) = names
         columns(:, 2) = u%energy
         columns(1:3, 2) = [character(20) :: "-", u%time, u%time]
         columns(size(names) - 4, 2) = "-"
         columns(size(names) - 3:size(names) - 1, 2) = trim(u%force)//" "//u%time
         columns(size(names), 2) = "-"
      end associate
      call self%open_file(job, domain%comm, job%path//".energy.csv", columns, &
         & model%request%energy_interval, error)
   end subroutine open_energies

   !> Add a line
   subroutine record_energies(self, domain, contacts, state, error)
      class(energy_history_type), intent(inout) :: self
      !> As in `history_recorder_type`
      type(domain_type), intent(in) :: domain
      type(contacts_type), intent(in) :: contacts
      type(state_type), intent(in) :: state
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: dissipated(mechanisms), hourglass
      type(delamination_type), allocatable :: lost(:)

      allocate (lost(0))
      if (can_fail(domain)) lost = delamination(domain, state%history)
      dissipated(:) = dissipated_energies(domain, state%history, lost)
      hourglass = hourglass_energy(domain, state%displacement, state%history)
      associate (e => state%energies)
         call self%write_line([real(state%cycle, wp), state%time, state%step_before, e%kinetic, &
            & e%internal, sum(dissipated), e%impactor, e%damping, e%external, e%contact, &
            & e%friction, dissipated, hourglass, e%half_step_correction - e%step_change - e%added, &
            & e%total(), e%error(), e%momentum, state%least_volume], error)
      end associate
   end subroutine record_energies

end module plydyn_io_csv_energy_history
