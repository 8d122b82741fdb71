!> A simulation: what is computed, and how far it has come.
module plydyn_method_simulation
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_contact_step, only : contacts_type
   use plydyn_method_step_control, only : early_end_type
   use plydyn_model_model, only : model_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> Model, domain, contacts and state
   type, public :: simulation_type
      !> The deck's model
      type(model_type) :: model
      !> The domain of this rank, its contacts and its state
      type(domain_type), allocatable :: domain
      type(contacts_type) :: contacts
      type(state_type) :: state
      !> Why the run ends before its time
      type(early_end_type) :: early_end
   end type simulation_type

end module plydyn_method_simulation
