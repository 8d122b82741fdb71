!> Keywords of damping and dynamic relaxation.
module plydyn_input_damping
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_declaration, only : extension, standard
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_keyword_row, only : keyword_list_type, stage_control
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_damping

   !> Share of the largest kinetic energy above which a plate still moves as one sees it
   real(wp), parameter :: largest_rest = 0.1_wp

contains

   !> Add these keywords
   subroutine add_damping(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("DAMPING_GLOBAL", damping_global, stage_control)
      call list%add("DAMPING_RELAXATION", damping_relaxation, stage_control, check=check_impactors)
   end subroutine add_damping

   !> Damping in proportion to mass
   subroutine damping_global(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      call card%keyword(standard, "Mass-proportional damping: forces against the velocity of " &
         & //"every point of the plate.", once=.true., change="damping")
      call card%example("9-central-differences", "0, 2.0e3")
      call card%unused("LCID")
      call card%nonnegative("VALDMP", "1/time", "force per mass and velocity", &
         & model%control%damping)
      if (card%reads) model%control%damping_line = card%line_of("VALDMP")
      call card%unused("STX STY STZ SRX SRY SRZ")
   end subroutine damping_global

   !> Dynamic relaxation
   subroutine damping_relaxation(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      call card%keyword(extension, "Brings the plate to rest by dynamic relaxation, and ends the " &
         & //"run there.", once=.true., change="dynamic relaxation")
      call card%remark("Damping forces act against the velocity of every point of the plate. " &
         & //"The damping is critical for the lowest frequency of the present motion, which is " &
         & //"estimated every 50 steps. The deck of a restart may begin dynamic relaxation or, " &
         & //"with DRTOL 0, end it. Impactors are not damped. A message says when the plate is " &
         & //"at rest. See the theory, Dynamic relaxation.")
      call card%example("9-central-differences", "1.0e-4")
      call card%real("DRTOL", "-", "the run ends normally when the kinetic energy is below this " &
         & //"share of the largest since dynamic relaxation began; 0 for no dynamic relaxation", &
         & model%control%rest_share, default=1.0e-4_wp, least=0.0_wp, most=1.0_wp)
      if (.not. card%reads) return
      if (model%control%rest_share >= 1.0_wp) then
         call card%refuse("DRTOL", "every motion has this share of the largest kinetic energy: " &
            & //"the run would end where it begins", "a small share, such as 1e-4")
      else if (model%control%rest_share > largest_rest) then
         call card%warn("DRTOL", "a plate with "//text(model%control%rest_share)//" of its " &
            & //"largest kinetic energy is not at rest", "a small share, such as 1e-4")
      end if
   end subroutine damping_relaxation

   !> Warn of impactors in a run that is to come to rest
   subroutine check_impactors(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      integer :: i

      if (model%control%rest_share <= 0.0_wp) return
      do i = 1, size(model%contacts)
         if (model%contacts(i)%impactor == 0) cycle
         associate (own => model%impactors(model%contacts(i)%impactor))
            if (own%motion(3) > 0) cycle
            call card%warn("DRTOL", "impactor "//text(own%id)//" is not damped: a plate that it " &
               & //"touches does not come to rest", "no dynamic relaxation before a stage with " &
               & //"*DELETE_IMPACTOR, or a curve along z for the impactor")
         end associate
      end do
   end subroutine check_impactors

end module plydyn_input_damping
