!> The history of energies and momentum of the whole model, JOB.energy.csv.
module plydyn_io_csv_energy_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_element_least_volume, only : least_volume_type
   use plydyn_io_csv_history_file, only : row_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_law_law, only : mechanism_names
   use plydyn_method_element_balance, only : balance_of, element_balance_type
   use plydyn_method_observer, only : requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_method_step_control, only : find_least_volume
   implicit none
   private

   !> The history
   type, public, extends(history_recorder_type) :: energy_history_type
      private
      !> Energies of the elements in the last line
      type(element_balance_type) :: balance
      !> Least ratio of volumes there
      real(wp) :: least_volume = 1.0_wp
   contains
      procedure :: put_columns
      procedure :: begin => begin_energies
      procedure :: record => record_energies
      procedure :: notify => notify_energies
   end type energy_history_type

contains

   subroutine put_columns(self, simulation, row)
      class(energy_history_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      type(row_type), intent(inout) :: row

      character(*), parameter :: axis(3) = ["momentum x", "momentum y", "momentum z"]

      associate (unit => simulation%model%control%units, balance => self%balance, &
         & state => simulation%state, e => simulation%state%energies)
         call row%put("cycle", "-", real(state%cycle, wp))
         call row%put("time", unit%time, state%time)
         call row%put("step", unit%time, state%step_before)
         call row%put("kinetic", unit%energy, e%kinetic)
         call row%put("internal", unit%energy, e%internal)
         call row%put("stored", unit%energy, balance%stored)
         call row%put("dissipated", unit%energy, sum(balance%dissipated))
         call row%put("impactor", unit%energy, e%impactor)
         call row%put("damping", unit%energy, e%damping)
         call row%put("external", unit%energy, e%external)
         call row%put("contact", unit%energy, e%contact)
         call row%put("contact friction", unit%energy, e%friction)
         call row%put(mechanism_names, unit%energy, balance%dissipated)
         call row%put("hourglass", unit%energy, balance%hourglass)
         call row%put("half-step correction", unit%energy, &
            & e%half_step_correction - e%step_change - e%added)
         call row%put("total", unit%energy, e%total())
         call row%put("error", "-", e%error())
         call row%put("stored error", "-", balance%error())
         call row%put(axis, unit%impulse(), e%momentum)
         ! where every step has a line, volumes are looked at less often
         call row%put("least volume", "-", merge(self%least_volume, state%least_volume, &
            & self%interval > 0.0_wp))
      end associate
   end subroutine put_columns

   !> The first line: after a restart the plate is deformed already
   subroutine begin_energies(self, simulation, error)
      class(energy_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      type(least_volume_type) :: least

      if (.not. self%is_due(simulation%state)) return
      least = find_least_volume(simulation%domain, simulation%state%displacement)
      self%least_volume = least%ratio
      call self%record_due(simulation, error)
   end subroutine begin_energies

   !> Add a line
   subroutine record_energies(self, simulation, error)
      class(energy_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      self%balance = balance_of(simulation%domain, simulation%state)
      call self%record_row(simulation, error)
   end subroutine record_energies

   !> Add a line if it is due, and hand the energies of the elements to their monitor
   subroutine notify_energies(self, simulation, requests, error)
      class(energy_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      if (.not. self%is_due(simulation%state)) return
      self%least_volume = requests%least_volume
      call self%record_due(simulation, error)
      requests%balance = self%balance
   end subroutine notify_energies

end module plydyn_io_csv_energy_history
