!> Keywords of linear constraints between displacements.
module plydyn_input_constraint
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_declaration, only : extension, standard
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_constraint, a_curve, a_node
   use plydyn_input_keyword_row, only : for_plates, keyword_list_type, stage_constraint
   use plydyn_input_load, only : of_loads, visit_direction
   use plydyn_model_support, only : constraint_term_type, constraint_type, &
      & prescribes_displacement, share_points
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_constraints, led_node

   !> What both say
   character(*), parameter :: in_common = "A point is in one constraint at most, is not held or " &
      & //"moved in the same direction, and not on a face that an impactor or a fixture meets. " &
      & //"With *DATABASE_SPCFORC `JOB.constraints.csv` has sum and force of each. IMPL must be " &
      & //"0, and a restart keeps the constraints."

contains

   !> Add these keywords
   subroutine add_constraints(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("CONSTRAINED_LINEAR_GLOBAL", constrained_linear_global, stage_constraint)
      call list%add("CONSTRAINED_FACE_LINEAR", constrained_face_linear, stage_constraint, &
         & for_plates)
   end subroutine add_constraints

   !> Constraint of LS-DYNA
   subroutine constrained_linear_global(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(constraint_type) :: constraint

      call card%keyword(standard, "The sum of COEF times displacement over all rows is zero.")
      call card%remark("Above a node of a plate it is the mean displacement over the thickness, " &
         & //"by mass, that counts; *CONSTRAINED_FACE_LINEAR takes the points of a face. " &
         & //in_common)
      call card%example(of_loads, "1|7, 3, 1.0|8, 3, -2.0")
      call card%define(a_constraint, "LCID", "number of the constraint", constraint%id)
      call visit_terms(card, .false., model, constraint)
   end subroutine constrained_linear_global

   !> Constraint between points of faces, which may be led
   subroutine constrained_face_linear(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(constraint_type) :: constraint

      call card%keyword(extension, "The sum of COEF times displacement over all rows is zero, or " &
         & //"follows a curve.")
      call card%remark("A lever without mass is such a sum: its end is at (1 + c/L) of the " &
         & //"displacement under it less c/L of that at its hinge, and the load that moves the " &
         & //"end is the force of the constraint. "//in_common)
      call card%example(of_loads, "1, 2, 1, -0.5|7, -1, 3, -0.4|13, -1, 3, 1.4")
      call card%define(a_constraint, "ID", "number of the constraint", constraint%id)
      call card%integer("VAD", "what LCID leads: 0 rate of the sum, 2 the sum", &
         & constraint%quantity, default=2, allowed=[0, 2])
      call card%refer(a_curve, "LCID", "curve; 0 for a sum of zero", constraint%curve, default=0, &
         & least=0)
      call card%real("SF", "any", "factor on the curve", constraint%scale, default=1.0_wp)
      if (card%reads) call check_right_side(card, model, constraint)
      call visit_terms(card, .true., model, constraint)
   end subroutine constrained_face_linear

   !> A factor needs a curve, and a sum begins at 0
   subroutine check_right_side(card, model, constraint)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(in) :: model
      type(constraint_type), intent(in) :: constraint

      real(wp) :: jump

      if (card%whole("LCID") == 0) then
         if (.not. card%is_fine("SF")) return
         if (any(abs(constraint%scale - [0.0_wp, 1.0_wp]) <= 0.0_wp)) return
         call card%refuse("SF", "a factor is given without a curve", &
            & "a curve in LCID, or no SF for a sum of zero")
         return
      end if
      if (constraint%curve == 0 .or. constraint%quantity /= prescribes_displacement) return
      ! the points of a restart are somewhere
      if (card%catalogue%stored_lines > 0) return
      jump = constraint%scale*model%curves(constraint%curve)%at(0.0_wp)
      if (abs(jump) > 0.0_wp) call card%warn("LCID", "the sum jumps by "//text(jump) &
         & //" in the first step", "a curve that is 0 at time 0")
   end subroutine check_right_side

   !> Node, face, direction and coefficient of each row
   subroutine visit_terms(card, has_faces, model, constraint)
      class(card_visitor_type), intent(inout) :: card
      !> Whether the rows have faces
      logical, intent(in) :: has_faces
      !> Gets the constraint
      type(model_type), intent(inout) :: model
      type(constraint_type), intent(inout) :: constraint

      allocate (constraint%terms(max(1, card%sets())))
      do while (card%next())
         associate (term => constraint%terms(card%nth))
            call card%refer(a_node, "NID", "node", term%node)
            if (has_faces) call card%integer("FACE", "-1 bottom face, 1 top face, 2 mean over " &
               & //"the thickness", term%face, allowed=[-1, 1, 2])
            call visit_direction(card, term%direction)
            call card%real("COEF", "-", "coefficient, not 0", term%coefficient)
            if (.not. card%reads) cycle
            if (card%has("COEF") .and. .not. abs(term%coefficient) > 0.0_wp) call card%refuse( &
               & "COEF", "a coefficient of 0 constrains nothing", &
               & "another number, or no row for the node")
            if (term%node > 0 .and. term%direction > 0) call check_term(card, model, constraint)
         end associate
      end do
      if (.not. card%reads) return
      if (card%sets() == 0) call card%catalogue%report%refuse(card%head(), &
         & "the constraint has no rows", "a row with NID, DOF and COEF for each displacement")
      model%constraints = [model%constraints, constraint]
   end subroutine visit_terms

   !> A displacement is in one row of one constraint, and nothing else leads it
   subroutine check_term(card, model, constraint)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(in) :: model
      !> The rows so far
      type(constraint_type), intent(in) :: constraint

      character(:), allocatable :: node
      integer :: i

      associate (term => constraint%terms(card%nth))
         node = "node "//text(card%catalogue%registers(a_node)%id(term%node))
         if (any_shares(constraint%terms(:card%nth - 1), term)) call card%refuse("NID", node &
            & //" is in the constraint twice in this direction", &
            & "a single row with the sum of the coefficients")
         do i = 1, size(model%constraints)
            if (any_shares(model%constraints(i)%terms, term)) call card%refuse("NID", &
               & "constraint "//text(model%constraints(i)%id)//" has "//node &
               & //" in this direction already", "each node and direction in one constraint only")
         end do
         if (led_node(model, term%direction, term%face, [term%node]) > 0) call card%refuse( &
            & "DOF", "the displacement of "//node//" in this direction is prescribed by a " &
            & //"*BOUNDARY keyword already", "a node that is free in this direction: leave the " &
            & //"row out, or the *BOUNDARY keyword")
         ! bricks have no planes
         if (.not. any(share_points([model%contacts%face, model%fixtures%face], term%face))) return
         call card%refuse("NID", node//" lies on the contact face of an impactor or a fixture, " &
            & //"where a constraint is not possible", "*CONSTRAINED_FACE_LINEAR with the FACE " &
            & //"that has no contact, or another node")
      end associate
   end subroutine check_term

   !> Whether any term has a point and a direction in common with another
   pure logical function any_shares(terms, term)
      type(constraint_term_type), intent(in) :: terms(:), term

      any_shares = any(terms%node == term%node .and. terms%direction == term%direction &
         & .and. share_points(terms%face, term%face))
   end function any_shares

   !> One of some nodes at which a support or a motion leads a point in a direction; 0 for none
   pure integer function led_node(model, direction, face, nodes) result(node)
      type(model_type), intent(in) :: model
      !> Direction, face or planes of the points, and indices of the nodes
      integer, intent(in) :: direction, face, nodes(:)

      integer :: i

      do i = 1, size(model%supports)
         associate (support => model%supports(i))
            if (.not. (support%direction(direction) .and. share_points(support%face, face))) cycle
            node = common_node(support%nodes, nodes)
         end associate
         if (node > 0) return
      end do
      do i = 1, size(model%motions)
         associate (motion => model%motions(i))
            if (motion%direction /= direction .or. .not. share_points(motion%face, face)) cycle
            node = common_node(motion%nodes, nodes)
         end associate
         if (node > 0) return
      end do
      node = 0
   end function led_node

   !> A node that is in both of two sets; 0 when there is none
   pure integer function common_node(one, other) result(node)
      !> Indices of nodes
      integer, intent(in) :: one(:), other(:)

      logical, allocatable :: inside(:)
      integer :: i

      node = 0
      if (size(one) == 0 .or. size(other) == 0) return
      if (max(minval(one), minval(other)) > min(maxval(one), maxval(other))) return
      allocate (inside(max(maxval(one), maxval(other))))
      inside(:) = .false.
      inside(one) = .true.
      do i = 1, size(other)
         if (inside(other(i))) node = other(i)
         if (node > 0) return
      end do
   end function common_node

end module plydyn_input_constraint
