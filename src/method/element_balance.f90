!> What the work of the internal forces has become.
!>
!> The energy balance of the scheme is an identity: it takes the internal energy from the work of
!> the forces. Here the elements tell what they have stored, from strains and stresses, and what
!> they have dissipated, from their histories. Forces that do not belong to a stored energy, steps
!> that are too long for a law, and histories that lose energy show as the work that is missing.
module plydyn_method_element_balance
   use plydyn_base_precision, only : wp
   use plydyn_domain_delamination, only : can_fail, delamination, delamination_type
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_element_energies, only : dissipated_energies, stored_energies
   use plydyn_law_law, only : mechanism_names, mechanisms
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: balance_of, mechanism_names, mechanisms

   !> Energies of all elements
   type, public :: element_balance_type
      !> Work of the internal forces
      real(wp) :: internal = 0.0_wp
      !> What unloading gives back; what hourglass control has stored or taken
      real(wp) :: stored = 0.0_wp, hourglass = 0.0_wp
      !> The part of it by viscous forces, which is summed to the first order of the step only
      real(wp) :: viscous = 0.0_wp
      !> Dissipated, in the order of `mechanism_names`
      real(wp) :: dissipated(mechanisms) = 0.0_wp
      !> The largest energy that went into the model so far
      real(wp) :: reference = 0.0_wp
   contains
      procedure :: error => balance_error
   end type element_balance_type

contains

   !> Energies of all elements at the end of a step. All ranks must come here, and get those of the
   !> whole model
   function balance_of(domain, state) result(self)
      type(domain_type), intent(in) :: domain
      !> The state, whose displacements are those of its time
      type(state_type), intent(in) :: state
      type(element_balance_type) :: self

      real(wp) :: stored(3)
      type(delamination_type), allocatable :: lost(:)

      allocate (lost(0))
      if (can_fail(domain)) lost = delamination(domain, state%history)
      self%internal = state%energies%internal
      self%reference = state%energies%reference
      stored(:) = stored_energies(domain, state%displacement, state%history)
      self%stored = stored(1)
      self%hourglass = stored(2)
      self%viscous = stored(3)
      self%dissipated(:) = dissipated_energies(domain, state%history, lost)
   end function balance_of

   !> Work of the internal forces that is neither stored nor dissipated, as a share of the energy
   !> that went in
   pure real(wp) function balance_error(self) result(error)
      class(element_balance_type), intent(in) :: self

      error = 0.0_wp
      if (self%reference > 0.0_wp) error = (self%internal - self%stored - self%hourglass &
         & - sum(self%dissipated))/self%reference
   end function balance_error

end module plydyn_method_element_balance
