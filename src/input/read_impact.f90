!> Readers of impactors and contacts.
module plydyn_input_read_impact
   use plydyn_base_precision, only : wp
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : a_contact, a_part, an_impactor, catalogue_type
   use plydyn_model_impactor, only : contact_type, impactor_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_impactor_sphere, read_contact_impactor

contains

   !> *IMPACTOR_SPHERE: a rigid sphere
   subroutine read_impactor_sphere(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(impactor_type) :: impactor

      call catalogue%define(an_impactor, cards, "IID")
      impactor%id = cards%integer("IID")
      impactor%title = cards%word("TITLE")
      impactor%radius = cards%real("RADIUS")
      impactor%mass = cards%real("MASS")
      impactor%centre(:) = cards%reals(["XC", "YC", "ZC"])
      impactor%velocity(:) = cards%reals(["VX", "VY", "VZ"])
      impactor%guided = cards%integer("DOF") == 1
      impactor%gravity = cards%real("GRAVZ")
      impactor%hemisphere = cards%integer("SHAPE") == 1
      if (impactor%guided .and. any(abs(impactor%velocity(:2)) > 0.0_wp)) then
         call catalogue%refuse(cards, "VX", "a guided impactor moves along z only", &
            & "VX = VY = 0, or DOF 0 for a free impactor")
      end if
      model%impactors = [model%impactors, impactor]
   end subroutine read_impactor_sphere

   !> *CONTACT_IMPACTOR: an impactor against a face of a part
   subroutine read_contact_impactor(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(contact_type) :: contact

      call catalogue%define(a_contact, cards, "CID")
      call catalogue%find(an_impactor, cards, "IID", contact%impactor)
      call catalogue%find(a_part, cards, "PID", contact%part)
      if (contact%impactor > 0 .and. any(model%contacts%impactor == contact%impactor)) then
         call catalogue%refuse(cards, "IID", "the impactor has a contact already", &
            & "one contact for each impactor")
      end if
      contact%id = cards%integer("CID")
      contact%face = cards%integer("FACE")
      contact%method = cards%integer("METHOD")
      contact%spacing = cards%real("SPACING")
      contact%line = cards%line_of("METHOD")
      model%contacts = [model%contacts, contact]
   end subroutine read_contact_impactor

end module plydyn_input_read_impact
