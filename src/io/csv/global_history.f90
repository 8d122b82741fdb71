!> Columns of the histories of energies and of impactors, and the lines under them.
!>
!> The names of columns are constants: gfortran 12 may blank the first word of a list of texts that
!> is an actual argument.
module plydyn_io_csv_global_history
   use plydyn_base_precision, only : wp
   use plydyn_domain_brick_energies, only : held_energy
   use plydyn_domain_delamination, only : can_fail, delamination, delamination_type, projected_area
   use plydyn_domain_dissipation, only : dissipated_energies
   use plydyn_domain_domain, only : domain_type
   use plydyn_law_law, only : mechanism_names, mechanisms
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: impactor_row, new_global_history

   !> Columns of the energies
   character(16), parameter, public :: energy_names(*) = [character(16) :: "cycle", "time", &
      & "step", "kinetic", "internal", "dissipated", "impactor", "damping", "external", &
      & "contact", mechanism_names, "hourglass", "ripple", "total", "error", "momentum x", &
      & "momentum y", "momentum z"]
   !> Columns of an impactor
   character(12), parameter, public :: impactor_names(*) = [character(12) :: "time", "force", &
      & "displacement", "velocity", "kinetic", "absorbed", "force x", "force y", "contacts", &
      & "penetration"]

   !> What the lines of the whole model are made of
   type, public :: global_history_type
      !> The line of the energies
      real(wp), allocatable :: energy(:)
      !> Energy that all mechanisms have dissipated together
      real(wp) :: dissipated = 0.0_wp
      !> What each interface has lost, and the area over which any has failed; none where none can
      type(delamination_type), allocatable :: lost(:)
      real(wp) :: projected_area = 0.0_wp
   end type global_history_type

contains

   !> All that histories tell of the whole model; all ranks must come here
   function new_global_history(domain, state) result(rows)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The state
      type(state_type), intent(in) :: state
      type(global_history_type) :: rows

      real(wp) :: lost(mechanisms)

      allocate (rows%lost(0))
      if (can_fail(domain)) then
         rows%lost = delamination(domain, state%history)
         rows%projected_area = projected_area(domain, state%history)
      end if
      lost(:) = dissipated_energies(domain, state%history, rows%lost)
      rows%dissipated = sum(lost)
      rows%energy = energy_row(domain, state, lost)
   end function new_global_history

   !> One line of the energies
   function energy_row(domain, state, lost) result(row)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The state
      type(state_type), intent(in) :: state
      !> What each mechanism has dissipated
      real(wp), intent(in) :: lost(mechanisms)
      real(wp) :: row(size(energy_names))

      associate (e => state%energies)
         row(:) = [real(state%cycle, wp), state%time, state%step_before, e%kinetic, e%internal, &
            & sum(lost), e%impactor, e%damping, e%external, e%contact, lost, &
            & held_energy(domain, state%displacement, state%history), &
            & e%ripple - e%shift - e%added, e%total(), e%error(), e%momentum]
      end associate
   end function energy_row

   !> One line of an impactor
   pure function impactor_row(domain, state, i) result(row)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The state
      type(state_type), intent(in) :: state
      !> Index of the impactor
      integer, intent(in) :: i
      real(wp) :: row(size(impactor_names))

      real(wp) :: kinetic, start

      associate (own => state%impactors(i), impactor => domain%contact%impactors(i))
         kinetic = 0.5_wp*impactor%mass*sum(own%velocity**2)
         start = 0.5_wp*impactor%mass*sum(impactor%velocity**2)
         row(:) = [state%time, own%force(3), own%displacement(3), own%velocity(3), kinetic, &
            & start - kinetic, own%force(1:2), real(own%contacts, wp), own%penetration]
      end associate
   end function impactor_row

end module plydyn_io_csv_global_history
