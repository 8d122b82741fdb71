!> Readers of linear constraints between displacements.
module plydyn_input_read_constraint
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : a_constraint, a_curve, a_node, catalogue_type
   use plydyn_model_support, only : all_planes, constraint_term_type, constraint_type, &
      & prescribes_displacement, share_points
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_constrained_linear

contains

   !> *CONSTRAINED_LINEAR_GLOBAL, *CONSTRAINED_FACE_LINEAR: a sum of displacements that is zero, or
   !> led
   subroutine read_constrained_linear(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(constraint_type) :: constraint
      integer :: nth

      if (cards%name == "CONSTRAINED_FACE_LINEAR") then
         call read_right_side(cards, catalogue, model, constraint)
      else
         call catalogue%define(a_constraint, cards, "LCID")
         constraint%id = cards%integer("LCID")
      end if
      allocate (constraint%terms(cards%sets()))
      do nth = 1, cards%sets()
         call read_term(cards, nth, catalogue, constraint%terms(nth))
         if (constraint%terms(nth)%node == 0 .or. constraint%terms(nth)%direction == 0) cycle
         call check_term(cards, nth, catalogue, model, constraint)
      end do
      if (size(constraint%terms) == 0) call catalogue%report%refuse(cards%head(), &
         & "the constraint has no rows", "a row with NID, DOF and COEF for each displacement")
      model%constraints = [model%constraints, constraint]
   end subroutine read_constrained_linear

   !> Number, and what leads the sum
   subroutine read_right_side(cards, catalogue, model, constraint)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(in) :: model
      type(constraint_type), intent(inout) :: constraint

      real(wp) :: jump

      call catalogue%define(a_constraint, cards, "ID")
      constraint%id = cards%integer("ID")
      constraint%quantity = cards%integer("VAD")
      constraint%scale = cards%real("SF")
      if (cards%integer("LCID") == 0) then
         if (.not. cards%is_fine("SF")) return
         if (any(abs(constraint%scale - [0.0_wp, 1.0_wp]) <= 0.0_wp)) return
         call catalogue%refuse(cards, "SF", "a factor is given without a curve", &
            & "a curve in LCID, or no SF for a sum of zero")
         return
      end if
      call catalogue%find(a_curve, cards, "LCID", constraint%curve)
      if (constraint%curve == 0 .or. constraint%quantity /= prescribes_displacement) return
      ! the points of a restart are somewhere
      if (catalogue%stored_lines > 0) return
      jump = constraint%scale*model%curves(constraint%curve)%at(0.0_wp)
      if (abs(jump) > 0.0_wp) call catalogue%warn(cards, "LCID", "the sum jumps by " &
         & //text(jump)//" in the first step", "a curve that is 0 at time 0")
   end subroutine read_right_side

   !> Node, face, direction and coefficient of a row
   subroutine read_term(cards, nth, catalogue, term)
      type(cards_type), intent(in) :: cards
      !> Which row
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue
      type(constraint_term_type), intent(out) :: term

      call catalogue%find(a_node, cards, "NID", term%node, nth)
      term%direction = cards%integer("DOF", nth)
      term%coefficient = cards%real("COEF", nth)
      if (cards%name == "CONSTRAINED_FACE_LINEAR") term%face = cards%integer("FACE", nth)
      if (cards%has("COEF", nth) .and. .not. abs(term%coefficient) > 0.0_wp) then
         call catalogue%refuse(cards, "COEF", "a coefficient of 0 constrains nothing", &
            & "another number, or no row for the node", nth)
      end if
   end subroutine read_term

   !> A displacement is in one row of one constraint, and nothing else leads it
   subroutine check_term(cards, nth, catalogue, model, constraint)
      type(cards_type), intent(in) :: cards
      !> Which row
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(in) :: model
      !> The rows so far
      type(constraint_type), intent(in) :: constraint

      character(:), allocatable :: node
      integer :: i

      associate (term => constraint%terms(nth))
         node = "node "//text(catalogue%registers(a_node)%id(term%node))
         if (any_shares(constraint%terms(:nth - 1), term)) then
            call catalogue%refuse(cards, "NID", node//" is in the constraint twice in this " &
               & //"direction", "a single row with the sum of the coefficients", nth)
         end if
         do i = 1, size(model%constraints)
            if (.not. any_shares(model%constraints(i)%terms, term)) cycle
            call catalogue%refuse(cards, "NID", "constraint " &
               & //text(model%constraints(i)%id)//" has "//node//" in this direction already", &
               & "each node and direction in one constraint only", nth)
         end do
         if (is_led(model, term)) call catalogue%refuse(cards, "DOF", "the displacement of "//node &
            & //" in this direction is prescribed by a *BOUNDARY keyword already", "a node that " &
            & //"is free in this direction: leave the row out, or the *BOUNDARY keyword", nth)
         if (is_touched(model, term)) call catalogue%refuse(cards, "NID", node//" lies on the " &
            & //"contact face of an impactor or a fixture, where a constraint is not possible", &
            & "*CONSTRAINED_FACE_LINEAR with the FACE that has no contact, or another node", nth)
      end associate
   end subroutine check_term

   !> Whether any term has a point and a direction in common with another
   pure logical function any_shares(terms, term)
      type(constraint_term_type), intent(in) :: terms(:), term
      integer :: i

      any_shares = .false.
      do i = 1, size(terms)
         if (terms(i)%node /= term%node .or. terms(i)%direction /= term%direction) cycle
         if (share_points(terms(i)%face, term%face)) any_shares = .true.
      end do
   end function any_shares

   !> Whether a support or a motion leads a point of a term in its direction
   pure logical function is_led(model, term)
      type(model_type), intent(in) :: model
      type(constraint_term_type), intent(in) :: term
      integer :: i

      is_led = .true.
      do i = 1, size(model%supports)
         associate (support => model%supports(i))
            if (.not. support%direction(term%direction)) cycle
            if (.not. share_points(support%face, term%face)) cycle
            if (any(support%nodes == term%node)) return
         end associate
      end do
      do i = 1, size(model%motions)
         associate (motion => model%motions(i))
            if (motion%direction /= term%direction) cycle
            if (.not. share_points(motion%face, term%face)) cycle
            if (any(motion%nodes == term%node)) return
         end associate
      end do
      is_led = .false.
   end function is_led

   !> Whether an impactor or a fixture may meet a point of a term
   pure logical function is_touched(model, term)
      type(model_type), intent(in) :: model
      type(constraint_term_type), intent(in) :: term

      integer :: i

      is_touched = .true.
      do i = 1, size(model%contacts)
         if (meets(model%contacts(i)%face)) return
      end do
      do i = 1, size(model%fixtures)
         if (meets(model%fixtures(i)%face)) return
      end do
      is_touched = .false.

   contains

      !> Whether the term has a point on a face; bricks have no planes
      pure logical function meets(face)
         integer, intent(in) :: face

         meets = term%face == all_planes .or. term%face == face
      end function meets

   end function is_touched

end module plydyn_input_read_constraint
