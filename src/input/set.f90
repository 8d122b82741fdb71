!> Keywords of sets, boxes, curves and tables.
module plydyn_input_set
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : number_of, text
   use plydyn_deck_declaration, only : standard
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_box, a_curve, a_node, a_node_set, a_quad, a_quad_set, &
      & a_table, box_type, table_type
   use plydyn_input_keyword_row, only : for_plates, keyword_list_type, stage_definition, &
      & stage_set, stage_table
   use plydyn_model_curve, only : curve_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_sets, add_tables

   !> Members of a set on a card, and numbers of a rule
   integer, parameter :: list_fields = 8, rule_fields = 7
   !> Columns of a point of a curve, and of a value of a table
   integer, parameter :: curve_width = 20
   !> Points of the shortest curve
   integer, parameter :: fewest_points = 2
   !> Heading of the manual, and what they are among the changes of a restart
   character(*), parameter :: of_sets = "decks.md#includes-parameters-and-sets", &
      & change = "sets, boxes, curves"

contains

   !> Add these keywords
   subroutine add_sets(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("SET_NODE_LIST", set_list, stage_set)
      call list%add("SET_NODE_GENERAL", set_node_general, stage_set)
      call list%add("SET_SHELL_LIST", set_list, stage_set, for_plates)
      call list%add("DEFINE_BOX", define_box, stage_definition)
      call list%add("DEFINE_CURVE", define_curve, stage_definition)
   end subroutine add_sets

   !> Add the keywords of tables
   subroutine add_tables(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("DEFINE_TABLE", define_table, stage_table)
      call list%add("DEFINE_TABLE_2D", define_table, stage_table)
   end subroutine add_tables

   !> A set of nodes or of elements by their numbers
   subroutine set_list(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      if (card%name == "SET_NODE_LIST") then
         call card%keyword(standard, "A set of nodes by their numbers.", suffixes="TITLE", &
            & alias="SET_NODE", change=change)
         call card%example(of_sets, "1|1, 2, 3, 4, 5, 6, 10, 11|15, 16, 20, 21, 22, 23, 24, 25")
         call visit_list(card, a_node_set, a_node, "NID", "node")
      else
         call card%keyword(standard, "A set of plate elements by their numbers.", &
            & suffixes="TITLE", alias="SET_SHELL", change=change)
         call card%example(of_sets, "1|1, 2")
         call visit_list(card, a_quad_set, a_quad, "EID", "element")
      end if
   end subroutine set_list

   !> Number and members of a set, in which a member that it names twice is once
   subroutine visit_list(card, kind, member_kind, name, what)
      class(card_visitor_type), intent(inout) :: card
      !> `a_node_set` or `a_quad_set`, and `a_node` or `a_quad`
      integer, intent(in) :: kind, member_kind
      !> Name of the fields of members without number, and what a member is
      character(*), intent(in) :: name, what

      integer, allocatable :: members(:)
      logical, allocatable :: met(:)
      integer :: i, kept

      call visit_head(card, kind)
      call card%card(repeated=.true.)
      call card%list(member_kind, name, list_fields, what, members)
      if (.not. card%reads) return
      allocate (met(max(0, maxval(members))), source=.false.)
      kept = 0
      do i = 1, size(members)
         if (met(members(i))) cycle
         met(members(i)) = .true.
         kept = kept + 1
         members(kept) = members(i)
      end do
      if (kept < size(members)) call card%warn(name//"1", "the set names "//number_of( &
         & size(members) - kept, "number")//" twice", "each number once; it counts once")
      call card%catalogue%add_set(kind, members(:kept))
   end subroutine visit_list

   !> First card of a set
   subroutine visit_head(card, kind)
      class(card_visitor_type), intent(inout) :: card
      !> `a_node_set` or `a_quad_set`
      integer, intent(in) :: kind

      integer :: id

      call card%define(kind, "SID", "number of the set", id)
      call card%unused("DA1 DA2 DA3 DA4")
      call card%unused("SOLVER", word="MECH")
      call card%unused("ITS", neutral=[0.0_wp, 1.0_wp])
   end subroutine visit_head

   !> A set of nodes by rules
   subroutine set_node_general(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      character(:), allocatable :: option
      integer :: i, numbers(rule_fields)
      logical, allocatable :: member(:)

      call card%keyword(standard, "A set of nodes by rules; a node that several rules name is in " &
         & //"the set once.", suffixes="TITLE", change=change)
      call card%example(of_sets, "1|BOX, 1|NODE, 13")
      call visit_head(card, a_node_set)
      if (card%reads) allocate (member(size(model%mesh%node_id)), source=.false.)
      do while (card%next())
         call card%word("OPTION", "ALL nodes, NODE by number, BOX by box", option, "ALL NODE BOX", &
            & required=.true.)
         do i = 1, rule_fields
            call card%integer("E"//text(i), "node or box", numbers(i), default=0, least=1)
         end do
         if (.not. card%reads) cycle
         if (option == "ALL") then
            member(:) = .true.
            if (card%has("E1")) call card%refuse("E1", "ALL takes no numbers", &
               & "ALL alone on the line")
         else if (option == "NODE" .or. option == "BOX") then
            if (.not. card%has("E1")) call card%refuse("E1", "the rule names nothing", &
               & "at least one number")
            call take_members(card, option, model%mesh%position, member)
         end if
      end do
      if (.not. card%reads) return
      if (.not. any(member) .and. .not. card%catalogue%report%has_errors()) call card%refuse( &
         & "SID", "the set is empty", "rules that name at least one node")
      call card%catalogue%add_set(a_node_set, pack([(i, i=1, size(member))], member))
   end subroutine set_node_general

   !> Nodes that a rule names, or in the boxes that it names
   subroutine take_members(card, option, position, member)
      class(card_visitor_type), intent(inout) :: card
      !> NODE or BOX
      character(*), intent(in) :: option
      !> Positions of all nodes, (3, nodes)
      real(wp), intent(in) :: position(:, :)
      !> Whether each node is in the set
      logical, intent(inout) :: member(:)

      integer :: i, found, n

      do i = 1, rule_fields
         call card%look_up(merge(a_node, a_box, option == "NODE"), "E"//text(i), found)
         if (found == 0) cycle
         if (option == "NODE") then
            member(found) = .true.
            cycle
         end if
         associate (box => card%catalogue%boxes(found))
            do n = 1, size(member)
               member(n) = member(n) .or. all(position(:, n) >= box%low .and. &
                  & position(:, n) <= box%high)
            end do
         end associate
      end do
   end subroutine take_members

   !> A box along the axes
   subroutine define_box(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(box_type) :: box
      character(*), parameter :: axes(3) = ["x", "y", "z"], letters(3) = ["X", "Y", "Z"]
      integer :: i, id

      call card%keyword(standard, "A box along the axes, its faces included.", suffixes="TITLE", &
         & change=change)
      call card%example(of_sets, "1, -1.0, 1.0, -1.0, 41.0, -1.0, 1.0")
      call card%define(a_box, "BOXID", "number of the box", id)
      do i = 1, size(axes)
         associate (low => letters(i)//"MN", high => letters(i)//"MX")
            call card%real(low, "length", "smallest "//axes(i), box%low(i))
            call card%real(high, "length", "largest "//axes(i), box%high(i))
            if (.not. card%reads .or. box%low(i) <= box%high(i)) cycle
            if (card%has(high)) call card%refuse(high, high//" = "//text(box%high(i)) &
               & //" is less than "//low//" = "//text(box%low(i)), "the larger coordinate in " &
               & //high//", the smaller one in "//low)
         end associate
      end do
      if (card%reads) card%catalogue%boxes = [card%catalogue%boxes, box]
   end subroutine define_box

   !> A curve
   subroutine define_curve(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(curve_type) :: curve
      real(wp) :: factor(2), given, offset(2), point(2)

      call card%keyword(standard, "A curve, over time or of a material, linear between its " &
         & //"points.", suffixes="TITLE", change=change)
      call card%remark("The abscissa is SFA (A1 + OFFA), the ordinate SFO (O1 + OFFO). The " &
         & //"points are used directly, without resampling. A curve over time is constant before " &
         & //"its first point and after its last point. For curves of materials see the page of " &
         & //"the material.")
      call card%example(of_sets, "1|0.0, 0.0|1.0e-4, 1.0")
      call card%define(a_curve, "LCID", "number of the curve", curve%id)
      call card%unused("SIDR")
      call card%real("SFA", "-", "factor on the abscissa", factor(1), default=1.0_wp)
      call card%zero_is_default()
      call card%real("SFO", "-", "factor on the ordinate", factor(2), default=1.0_wp)
      call card%zero_is_default()
      call card%real("OFFA", "any", "offset of the abscissa", offset(1), default=0.0_wp)
      call card%real("OFFO", "any", "offset of the ordinate", offset(2), default=0.0_wp)
      call card%unused("DATTYP LCINT")
      call card%width(curve_width)
      allocate (curve%x(card%sets()), curve%y(card%sets()))
      do while (card%next())
         call card%real("A1", "any", "abscissa, increasing from line to line", point(1))
         call card%real("O1", "any", "ordinate", point(2))
         if (.not. card%reads) cycle
         curve%x(card%nth) = factor(1)*(point(1) + offset(1)) + card%catalogue%origin(card%root)
         curve%y(card%nth) = factor(2)*(point(2) + offset(2))
         if (card%nth > 1) then
            if (curve%x(card%nth) <= curve%x(card%nth - 1) .and. card%has("A1")) call card%refuse( &
               & "A1", "the abscissa does not increase", "more than the "//text(given) &
               & //" of the point before")
         end if
         given = point(1)
      end do
      if (.not. card%reads) return
      if (size(curve%x) > 0 .and. size(curve%x) < fewest_points) call card%refuse("A1", &
         & "the curve has one point", "at least two points")
      model%curves = [model%curves, curve]
   end subroutine define_curve

   !> A table whose curves follow, or that names them
   subroutine define_table(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      integer :: first, i
      logical :: names_curves
      type(table_type) :: table

      names_curves = card%name == "DEFINE_TABLE_2D"
      if (names_curves) then
         call card%keyword(standard, "A curve for each of some values, by the numbers of the " &
            & //"curves.", suffixes="TITLE")
         call card%remark("The values are SFA (VALUE + OFFA).")
         call card%example("metals-that-yield", "1|10.0, 2|4.0e4, 3")
      else
         call card%keyword(standard, "A curve for each of some values; the curves follow the " &
            & //"table in the deck.", suffixes="TITLE")
         call card%remark("The first *DEFINE_CURVE behind the table belongs to its first value, " &
            & //"the next to its second, and so on. The values are SFA (VALUE + OFFA).")
         call card%example("metals-that-yield", "1|10.0|4.0e4")
      end if
      call visit_table(card, names_curves, table)
      if (.not. card%reads) return
      associate (register => card%catalogue%registers(a_curve), curves => size(model%curves))
         first = 1
         if (curves > 0) first = count(register%line(:curves) < card%line) + 1
         do i = 1, merge(0, min(card%sets(), curves - first + 1), names_curves)
            table%curve(i) = first + i - 1
            register%used(table%curve(i)) = .true.
         end do
      end associate
      if (any(table%curve == 0) .and. card%sets() > 0 .and. .not. names_curves) call card%refuse( &
         & "TBID", "the table has "//number_of(card%sets(), "value")//", but "//number_of( &
         & count(table%curve > 0), "curve")//" behind it", "a *DEFINE_CURVE behind the table for " &
         & //"each of its values")
      card%catalogue%tables = [card%catalogue%tables, table]
   end subroutine define_table

   !> Number of a table, its values, and where it names them its curves
   subroutine visit_table(card, names_curves, table)
      class(card_visitor_type), intent(inout) :: card
      logical, intent(in) :: names_curves
      type(table_type), intent(inout) :: table

      integer :: id
      real(wp) :: factor, offset, value

      call card%define(a_table, "TBID", "number of the table, none that a curve has", id)
      call card%real("SFA", "-", "factor on the values", factor, default=1.0_wp)
      call card%zero_is_default()
      call card%real("OFFA", "any", "offset of the values", offset, default=0.0_wp)
      call card%width(curve_width)
      allocate (table%curve(max(1, card%sets())), table%value(max(1, card%sets())))
      table%curve(:) = 0
      do while (card%next())
         associate (n => card%nth)
            call card%real("VALUE", "any", "value, increasing from line to line", value)
            if (names_curves) call card%refer(a_curve, "CURVEID", "curve of this value", &
               & table%curve(n))
            if (.not. card%reads) cycle
            table%value(n) = factor*(value + offset)
            if (n == 1) cycle
            if (table%value(n) <= table%value(n - 1)) call card%refuse("VALUE", "the value does " &
               & //"not increase", "more than the "//text(table%value(n - 1))//" of the line " &
               & //"before")
         end associate
      end do
   end subroutine visit_table

end module plydyn_input_set
