!> The history of energies and momentum of the whole model, JOB.energy.csv.
module plydyn_io_csv_energy_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_method_element_balance, only : balance_of, element_balance_type
   use plydyn_method_observer, only : requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_law_law, only : mechanism_names
   implicit none
   private

   !> Columns. A constant: gfortran 12 may blank the first word of a list of texts that is an actual
   !> argument
   character(20), parameter :: names(*) = [character(20) :: "cycle", "time", "step", "kinetic", &
      & "internal", "stored", "dissipated", "impactor", "damping", "external", "contact", &
      & "contact friction", mechanism_names, "hourglass", "half-step correction", "total", &
      & "error", "stored error", "momentum x", "momentum y", "momentum z", "least volume"]

   !> The history
   type, public, extends(history_recorder_type) :: energy_history_type
      private
      !> Energies of the elements in the last line
      type(element_balance_type) :: balance
   contains
      procedure :: open => open_energies
      procedure :: notify => notify_energies
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
         units(size(names) - 5:size(names) - 4) = "-"
         units(size(names) - 3:size(names) - 1) = trim(u%force)//" "//u%time
         units(size(names)) = "-"
      end associate
      call self%open_file(job, simulation, ".energy.csv", names, units, &
         & simulation%model%request%energy_interval, error)
   end subroutine open_energies

   !> Add a line if it is due, and hand the energies of the elements to their monitor
   subroutine notify_energies(self, simulation, requests, error)
      class(energy_history_type), intent(inout) :: self
      class(simulation_type), intent(inout) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      if (.not. self%is_due(simulation%state)) return
      call self%record_due(simulation, error)
      requests%balance = self%balance
   end subroutine notify_energies

   !> Add a line
   subroutine record_energies(self, simulation, error)
      class(energy_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: least_volume

      ! where every step has a line, volumes are looked at less often
      least_volume = merge(simulation%least_volume, simulation%state%least_volume, &
         & self%schedule%interval > 0.0_wp)
      self%balance = balance_of(simulation%domain, simulation%state)
      associate (balance => self%balance, state => simulation%state, &
         & e => simulation%state%energies)
         call self%write_line([real(state%cycle, wp), state%time, state%step_before, e%kinetic, &
            & e%internal, balance%stored, sum(balance%dissipated), e%impactor, e%damping, &
            & e%external, e%contact, e%friction, balance%dissipated, balance%hourglass, &
            & e%half_step_correction - e%step_change - e%added, e%total(), e%error(), &
            & balance%error(), e%momentum, least_volume], error)
      end associate
   end subroutine record_energies

end module plydyn_io_csv_energy_history
