!> Keywords of nodes, elements, sets and curves.
module plydyn_input_declare_mesh
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : keyword_type, new_keyword, extension, standard
   implicit none
   private

   public :: node, element_shell, element_plate_q9, set_node_list, set_node_general, &
      & set_shell_list, define_box, define_curve

   !> Columns of the fields of an element, of a coordinate and of a point of a curve
   integer, parameter :: element_width = 8, coordinate_width = 16, curve_width = 20
   !> Members of a set on a card
   integer, parameter :: list_fields = 8

contains

   !> Nodes
   function node() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("NODE", standard, &
         & "Nodes of the reference plane of the laminate, all at the same z.", repeated=.true.)
      keyword%width = element_width
      call keyword%add_integer("NID", "number of the node", least=1)
      keyword%width = coordinate_width
      call keyword%add_real("X", "length", "x", default=0.0_wp)
      call keyword%add_real("Y", "length", "y", default=0.0_wp)
      call keyword%add_real("Z", "length", "z, the same for all nodes", default=0.0_wp)
      keyword%width = element_width
      call keyword%add_unused("TC RC")
   end function node

   !> Quads with four nodes, and with nine as gmsh writes them
   function element_shell() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("ELEMENT_SHELL", standard, "Plate elements.", repeated=.true.)
      keyword%remark = "Four nodes counter-clockwise seen from above (+z), or nine on one line " &
         & //"with commas, as gmsh writes them: corners, mid-sides, centre. All elements of a " &
         & //"deck have the same number of nodes. Quads of four nodes are stiff in bending " &
         & //"unless they are shorter than the plate is thick. Triangles and " &
         & //"8-node elements are refused."
      keyword%width = element_width
      call keyword%add_integer("EID", "number of the element", least=1)
      call keyword%add_integer("PID", "part", least=1)
      call keyword%add_integer("N1", "first corner", least=1)
      call keyword%add_integer("N2", "second corner", least=1)
      call keyword%add_integer("N3", "third corner", least=1)
      call keyword%add_integer("N4", "fourth corner", least=1)
      call keyword%add_integer("N5", "mid-side between N1 and N2; 0 for a quad of four nodes", &
         & default=0, least=0)
      call keyword%add_integer("N6", "mid-side between N2 and N3", default=0, least=0)
      call keyword%add_integer("N7", "mid-side between N3 and N4", default=0, least=0)
      call keyword%add_integer("N8", "mid-side between N4 and N1", default=0, least=0)
      call keyword%add_integer("N9", "centre", default=0, least=0)
   end function element_shell

   !> Quads with nine nodes
   function element_plate_q9() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("ELEMENT_PLATE_Q9", extension, "Plate elements of nine nodes.", &
         & repeated=.true.)
      keyword%remark = "Corners counter-clockwise seen from above (+z), then the mid-sides from " &
         & //"the one between N1 and N2 on, then the centre: the order of gmsh and of VTK."
      keyword%width = element_width
      call keyword%add_integer("EID", "number of the element", least=1)
      call keyword%add_integer("PID", "part", least=1)
      call keyword%add_card()
      call keyword%add_integer("N1", "first corner", least=1)
      call keyword%add_integer("N2", "second corner", least=1)
      call keyword%add_integer("N3", "third corner", least=1)
      call keyword%add_integer("N4", "fourth corner", least=1)
      call keyword%add_integer("N5", "mid-side between N1 and N2", least=1)
      call keyword%add_integer("N6", "mid-side between N2 and N3", least=1)
      call keyword%add_integer("N7", "mid-side between N3 and N4", least=1)
      call keyword%add_integer("N8", "mid-side between N4 and N1", least=1)
      call keyword%add_integer("N9", "centre", least=1)
   end function element_plate_q9

   !> A set of nodes by their numbers
   function set_node_list() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("SET_NODE_LIST", standard, "A set of nodes by their numbers.", &
         & suffixes="TITLE", alias="SET_NODE")
      call add_set_card(keyword)
      call keyword%add_card(repeated=.true.)
      call keyword%add_list("NID", list_fields, "node")
   end function set_node_list

   !> A set of nodes by rules
   function set_node_general() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("SET_NODE_GENERAL", standard, &
         & "A set of nodes by rules; a node that several rules name is in the set once.", &
         & suffixes="TITLE")
      call add_set_card(keyword)
      call keyword%add_card(repeated=.true.)
      call keyword%add_word("OPTION", "ALL nodes, NODE by number, BOX by box", "ALL NODE BOX", &
         & required=.true.)
      call keyword%add_integer("E1", "node or box", default=0, least=1)
      call keyword%add_integer("E2", "node or box", default=0, least=1)
      call keyword%add_integer("E3", "node or box", default=0, least=1)
      call keyword%add_integer("E4", "node or box", default=0, least=1)
      call keyword%add_integer("E5", "node or box", default=0, least=1)
      call keyword%add_integer("E6", "node or box", default=0, least=1)
      call keyword%add_integer("E7", "node or box", default=0, least=1)
   end function set_node_general

   !> A set of elements by their numbers
   function set_shell_list() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("SET_SHELL_LIST", standard, &
         & "A set of plate elements by their numbers.", suffixes="TITLE", alias="SET_SHELL")
      call add_set_card(keyword)
      call keyword%add_card(repeated=.true.)
      call keyword%add_list("EID", list_fields, "element")
   end function set_shell_list

   !> First card of a set
   subroutine add_set_card(keyword)
      !> The keyword of the set
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_integer("SID", "number of the set", least=1)
      call keyword%add_unused("DA1 DA2 DA3 DA4")
      call keyword%add_unused("SOLVER", word="MECH")
      call keyword%add_unused("ITS", neutral=[0.0_wp, 1.0_wp])
   end subroutine add_set_card

   !> A box along the axes
   function define_box() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("DEFINE_BOX", standard, "A box along the axes, its faces included.", &
         & suffixes="TITLE")
      call keyword%add_integer("BOXID", "number of the box", least=1)
      call keyword%add_real("XMN", "length", "smallest x")
      call keyword%add_real("XMX", "length", "largest x")
      call keyword%add_real("YMN", "length", "smallest y")
      call keyword%add_real("YMX", "length", "largest y")
      call keyword%add_real("ZMN", "length", "smallest z")
      call keyword%add_real("ZMX", "length", "largest z")
   end function define_box

   !> A curve
   function define_curve() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("DEFINE_CURVE", standard, &
         & "A curve, over time or of a material, linear between its points.", &
         & suffixes="TITLE")
      keyword%remark = "The abscissa is SFA (A1 + OFFA), the ordinate SFO (O1 + OFFO). The " &
         & //"points are used directly, without resampling. A curve over time is constant before " &
         & //"its first point and after its last point. For curves of materials see the page of " &
         & //"the material."
      call keyword%add_integer("LCID", "number of the curve", least=1)
      call keyword%add_unused("SIDR")
      call keyword%add_real("SFA", "-", "factor on the abscissa", default=1.0_wp)
      call keyword%zero_is_default()
      call keyword%add_real("SFO", "-", "factor on the ordinate", default=1.0_wp)
      call keyword%zero_is_default()
      call keyword%add_real("OFFA", "any", "offset of the abscissa", default=0.0_wp)
      call keyword%add_real("OFFO", "any", "offset of the ordinate", default=0.0_wp)
      call keyword%add_unused("DATTYP LCINT")
      keyword%width = curve_width
      call keyword%add_card(repeated=.true.)
      call keyword%add_real("A1", "any", "abscissa, increasing from line to line")
      call keyword%add_real("O1", "any", "ordinate")
   end function define_curve

end module plydyn_input_declare_mesh
