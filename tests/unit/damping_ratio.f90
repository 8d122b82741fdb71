!> *DAMPING_RATIO: mass-proportional damping by a share of the critical one at a frequency.
module damping_ratio
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : extension
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: visit_damping_ratio

   !> Of a circle over its radius
   real(wp), parameter :: circumference = 2.0_wp*acos(-1.0_wp)

contains

   !> Damping of one mode
   subroutine visit_damping_ratio(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      real(wp) :: frequency, ratio

      call card%keyword(extension, "Damping by a share of the critical one.", once=.true., &
         & change="damping")
      call card%example("9-central-differences", "0.02, 500.0")
      call card%real("RATIO", "-", "share of the critical damping; 0 for none", ratio, &
         & default=0.0_wp, least=0.0_wp, most=1.0_wp)
      call card%positive("FREQ", "1/time", "frequency of the mode", frequency)
      if (.not. card%reads) return
      if (ratio > 0.0_wp .and. model%control%rest_share > 0.0_wp) call card%refuse("RATIO", &
         & "*DAMPING_RELAXATION has damping of its own", "0, or no *DAMPING_RELAXATION")
      model%control%damping = 2.0_wp*ratio*circumference*frequency
   end subroutine visit_damping_ratio

end module damping_ratio
