!> Readers of boxes, sets and curves.
module plydyn_input_read_set
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : a_box, a_curve, a_node, a_node_set, a_quad, a_quad_set, &
      & box_type, catalogue_type
   use plydyn_model_curve, only : curve_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_set_list, read_set_node_general, read_define_box, read_define_curve

   !> Fields of a rule of *SET_NODE_GENERAL
   character(2), parameter :: rule_fields(*) = ["E1", "E2", "E3", "E4", "E5", "E6", "E7"]
   !> Points of the shortest curve
   integer, parameter :: fewest_points = 2

contains

   !> *SET_NODE_LIST, *SET_SHELL_LIST: nodes or quads by number
   subroutine read_set_list(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      integer :: kind, set
      integer, allocatable :: members(:)
      logical :: is_of_nodes

      is_of_nodes = cards%name == "SET_NODE_LIST"
      set = merge(a_node_set, a_quad_set, is_of_nodes)
      kind = merge(a_node, a_quad, is_of_nodes)
      call catalogue%define(set, cards, "SID")
      call catalogue%find_all(kind, cards, merge("NID", "EID", is_of_nodes), members)
      call drop_repeated(cards, merge("NID1", "EID1", is_of_nodes), members, catalogue)
      call catalogue%add_set(set, members)
   end subroutine read_set_list

   !> *SET_NODE_GENERAL: nodes by rules
   subroutine read_set_node_general(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      logical :: member(size(model%mesh%node_id))
      integer :: i, nth

      call catalogue%define(a_node_set, cards, "SID")
      member(:) = .false.
      do nth = 1, cards%sets()
         select case (cards%word("OPTION", nth))
         case ("ALL")
            call check_lonely(cards, nth, catalogue)
            member(:) = .true.
         case ("NODE")
            call add_nodes(cards, nth, catalogue, member)
         case ("BOX")
            call add_boxes(cards, nth, catalogue, model%mesh, member)
         case default
            continue
         end select
      end do
      if (.not. any(member) .and. .not. catalogue%report%has_errors()) then
         call catalogue%refuse(cards, "SID", "the set is empty", &
            & "rules that name at least one node")
      end if
      call catalogue%add_set(a_node_set, pack([(i, i=1, size(member))], member))
   end subroutine read_set_node_general

   !> *DEFINE_BOX: a box along the axes
   subroutine read_define_box(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      character(3), parameter :: low(3) = ["XMN", "YMN", "ZMN"], high(3) = ["XMX", "YMX", "ZMX"]
      type(box_type) :: box
      integer :: i

      call catalogue%define(a_box, cards, "BOXID")
      box%low(:) = cards%reals(low)
      box%high(:) = cards%reals(high)
      do i = 1, size(low)
         if (box%low(i) <= box%high(i) .or. .not. cards%has(high(i))) cycle
         call catalogue%refuse(cards, high(i), high(i)//" = "//text(box%high(i)) &
            & //" is less than "//low(i)//" = "//text(box%low(i)), "the larger coordinate in " &
            & //high(i)//", the smaller one in "//low(i))
      end do
      catalogue%boxes = [catalogue%boxes, box]
   end subroutine read_define_box

   !> *DEFINE_CURVE: a curve over time
   subroutine read_define_curve(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(curve_type) :: curve
      integer :: nth

      call catalogue%define(a_curve, cards, "LCID")
      curve%id = cards%integer("LCID")
      curve%x = cards%real("SFA")*([(cards%real("A1", nth), nth=1, cards%sets())] &
         & + cards%real("OFFA")) + catalogue%times%of_line(cards%line_of("LCID"))
      curve%y = cards%real("SFO")*([(cards%real("O1", nth), nth=1, cards%sets())] &
         & + cards%real("OFFO"))
      do nth = 2, size(curve%x)
         if (curve%x(nth) > curve%x(nth - 1) .or. .not. cards%has("A1", nth)) cycle
         call catalogue%refuse(cards, "A1", "the abscissa does not increase", &
            & "more than the "//text(cards%real("A1", nth - 1)) &
            & //" of the point before", nth)
      end do
      if (size(curve%x) > 0 .and. size(curve%x) < fewest_points) then
         call catalogue%refuse(cards, "A1", "the curve has one point", "at least two points")
      end if
      model%curves = [model%curves, curve]
   end subroutine read_define_curve

   !> A rule without numbers
   subroutine check_lonely(cards, nth, catalogue)
      type(cards_type), intent(in) :: cards
      !> Which rule
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue

      if (.not. cards%has("E1", nth)) return
      call catalogue%refuse(cards, "E1", "ALL takes no numbers", "ALL alone on the line", nth)
   end subroutine check_lonely

   !> A rule that names nodes
   subroutine add_nodes(cards, nth, catalogue, member)
      type(cards_type), intent(in) :: cards
      !> Which rule
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue
      !> Nodes of the set
      logical, intent(inout) :: member(:)

      integer :: i, node

      call check_named(cards, nth, catalogue)
      do i = 1, size(rule_fields)
         call catalogue%find(a_node, cards, rule_fields(i), node, nth)
         if (node > 0) member(node) = .true.
      end do
   end subroutine add_nodes

   !> A rule that names boxes
   subroutine add_boxes(cards, nth, catalogue, mesh, member)
      type(cards_type), intent(in) :: cards
      !> Which rule
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue
      type(mesh_type), intent(in) :: mesh
      !> Nodes of the set
      logical, intent(inout) :: member(:)

      integer :: box, i, node

      call check_named(cards, nth, catalogue)
      do i = 1, size(rule_fields)
         call catalogue%find(a_box, cards, rule_fields(i), box, nth)
         if (box == 0) cycle
         do node = 1, size(member)
            if (is_inside(mesh%position(:, node), catalogue%boxes(box))) member(node) = .true.
         end do
      end do
   end subroutine add_boxes

   !> A rule that names nothing
   subroutine check_named(cards, nth, catalogue)
      type(cards_type), intent(in) :: cards
      !> Which rule
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue

      if (cards%has("E1", nth)) return
      call catalogue%refuse(cards, "E1", "the rule names nothing", "at least one number", nth)
   end subroutine check_named

   !> A point in a box, or on its faces
   pure logical function is_inside(position, box)
      !> The point
      real(wp), intent(in) :: position(3)
      type(box_type), intent(in) :: box

      is_inside = all(position >= box%low .and. position <= box%high)
   end function is_inside

   !> A member that a set names twice is in it once
   subroutine drop_repeated(cards, name, members, catalogue)
      type(cards_type), intent(in) :: cards
      !> Field to name in the warning
      character(*), intent(in) :: name
      !> Members of the set
      integer, allocatable, intent(inout) :: members(:)
      type(catalogue_type), intent(inout) :: catalogue

      logical, allocatable :: met(:)
      integer :: i, kept

      if (size(members) == 0) return
      allocate (met(maxval(members)))
      met(:) = .false.
      kept = 0
      do i = 1, size(members)
         if (met(members(i))) cycle
         met(members(i)) = .true.
         kept = kept + 1
         members(kept) = members(i)
      end do
      if (kept == size(members)) return
      call catalogue%warn(cards, name, text(size(members) - kept) &
         & //" numbers are in the set twice", "each number once; it counts once")
      members = members(:kept)
   end subroutine drop_repeated

end module plydyn_input_read_set
