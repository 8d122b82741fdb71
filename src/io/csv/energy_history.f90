!> The history of energies and momentum of the whole model, JOB.energy.csv.
module plydyn_io_csv_energy_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_delamination, only : can_fail, delamination, delamination_type
   use plydyn_domain_dissipation, only : dissipated_energies, hourglass_energy
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_law_law, only : mechanism_names, mechanisms
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

   !> Create the file, or append to the one of the restart
   subroutine open_energies(self, job, simulation, error)
      class(energy_history_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      character(20) :: units(size(names))

      associate (u => simulation%model%control%units)
         units(:) = u%energy
         units(1:3) = [character(20) :: "-", u%time, u%time]
         units(size(names) - 4) = "-"
         units(size(names) - 3:size(names) - 1) = trim(u%force)//" "//u%time
         units(size(names)) = "-"
      end associate
      call self%open_file(job, simulation, ".energy.csv", names, units, &
         & simulation%model%request%energy_interval, error)
   end subroutine open_energies

   !> Add a line
   subroutine record_energies(self, simulation, error)
      class(energy_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: dissipated(mechanisms), hourglass
      type(delamination_type), allocatable :: lost(:)

      allocate (lost(0))
      associate (domain => simulation%domain, state => simulation%state, &
         & e => simulation%state%energies)
         if (can_fail(domain)) lost = delamination(domain, state%history)
         dissipated(:) = dissipated_energies(domain, state%history, lost)
         hourglass = hourglass_energy(domain, state%displacement, state%history)
         call self%write_line([real(state%cycle, wp), state%time, state%step_before, e%kinetic, &
            & e%internal, sum(dissipated), e%impactor, e%damping, e%external, e%contact, &
            & e%friction, dissipated, hourglass, e%half_step_correction - e%step_change - e%added, &
            & e%total(), e%error(), e%momentum, state%least_volume], error)
      end associate
   end subroutine record_energies

end module plydyn_io_csv_energy_history
