!> Keywords of nodes and plate elements.
module plydyn_input_mesh
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : is_wrong
   use plydyn_deck_declaration, only : extension, standard
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_node, a_part, a_quad
   use plydyn_input_keyword_row, only : for_plates, keyword_list_type, stage_definition, &
      & stage_element
   use plydyn_input_set, only : add_sets
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_mesh, new_mesh

   !> Columns of the fields of an element, and of a coordinate
   integer, parameter :: element_width = 8, coordinate_width = 16
   !> Nodes of a quad without and with mid-sides and centre, and of one without centre
   integer, parameter :: four_nodes = 4, eight_nodes = 8, nine_nodes = 9
   !> Names of the nodes on a card, and what they are
   character(2), parameter :: node_names(nine_nodes) = &
      & ["N1", "N2", "N3", "N4", "N5", "N6", "N7", "N8", "N9"]
   character(*), parameter :: node_sentences(nine_nodes) = [character(26) :: "first corner", &
      & "second corner", "third corner", "fourth corner", "mid-side between N1 and N2", &
      & "mid-side between N2 and N3", "mid-side between N3 and N4", "mid-side between N4 and N1", &
      & "centre"]

contains

   !> Add these keywords
   subroutine add_mesh(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("NODE", node, stage_definition)
      call list%add("ELEMENT_SHELL", element_shell, stage_element, for_plates)
      call list%add("ELEMENT_PLATE_Q9", element_plate_q9, stage_element, for_plates)
      call add_sets(list)
   end subroutine add_mesh

   !> A mesh without nodes and elements
   pure type(mesh_type) function new_mesh() result(mesh)
      allocate (mesh%node_id(0), mesh%position(3, 0), mesh%quad_id(0), mesh%quad_part(0), &
         & mesh%quad_node(0, 0), mesh%brick_id(0), mesh%brick_part(0), mesh%brick_node(8, 0), &
         & mesh%brick_angle(0))
   end function new_mesh

   !> Nodes
   subroutine node(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      integer :: id, n
      real(wp) :: x(3)

      call card%keyword(standard, "Nodes of the reference plane of the laminate, all at the " &
         & //"same z.")
      call card%example("2-layer-wise-kinematics", "1, 0, 0, 0|2, 10, 0, 0")
      if (card%reads) then
         n = size(model%mesh%node_id)
         if (any(card%state == is_wrong)) card%catalogue%mesh_is_sound = .false.
         associate (mesh => model%mesh, total => n + card%sets())
            mesh%node_id = reshape(mesh%node_id, [total], pad=[0])
            mesh%position = reshape(mesh%position, [3, total], pad=[0.0_wp])
         end associate
      end if
      do while (card%next())
         call card%width(element_width)
         call card%define(a_node, "NID", "number of the node", id)
         call card%width(coordinate_width)
         call card%real("X", "length", "x", x(1), default=0.0_wp)
         call card%real("Y", "length", "y", x(2), default=0.0_wp)
         call card%real("Z", "length", "z, the same for all nodes", x(3), default=0.0_wp)
         call card%width(element_width)
         call card%unused("TC RC")
         if (.not. card%reads) cycle
         model%mesh%node_id(n + card%nth) = id
         model%mesh%position(:, n + card%nth) = x
      end do
   end subroutine node

   !> Quads with four nodes, and with nine as gmsh writes them
   subroutine element_shell(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      integer :: given(nine_nodes), id, k, part

      call card%keyword(standard, "Plate elements.")
      call card%remark("Four nodes counter-clockwise seen from above (+z), or nine on one line " &
         & //"with commas, as gmsh writes them: corners, mid-sides, centre. All elements of a " &
         & //"deck have the same number of nodes. Quads of four nodes are stiff in bending " &
         & //"unless they are shorter than the plate is thick. Triangles and " &
         & //"8-node elements are refused.")
      call card%example("2-layer-wise-kinematics", "1, 1, 1, 2, 7, 6|2, 1, 2, 3, 8, 7")
      call card%width(element_width)
      if (card%reads) call add_quads(model%mesh, card%sets())
      do while (card%next())
         call card%define(a_quad, "EID", "number of the element", id)
         call card%refer(a_part, "PID", "part", part)
         do k = 1, four_nodes
            call card%integer(node_names(k), trim(node_sentences(k)), given(k), least=1)
         end do
         do k = four_nodes + 1, nine_nodes
            call card%integer(node_names(k), trim(node_sentences(k))//trim(merge( &
               & "; 0 for a quad of four nodes", repeat(" ", 28), k == four_nodes + 1)), given(k), &
               & default=0, least=0)
         end do
         if (card%reads) call set_quad(card, id, part, nodes_of(card, given), model%mesh)
      end do
   end subroutine element_shell

   !> Quads with nine nodes
   subroutine element_plate_q9(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      integer :: id, k, number, part

      call card%keyword(extension, "Plate elements of nine nodes.")
      call card%remark("Corners counter-clockwise seen from above (+z), then the mid-sides from " &
         & //"the one between N1 and N2 on, then the centre: the order of gmsh and of VTK.")
      call card%example("2-layer-wise-kinematics", "1, 1|1, 3, 13, 11, 2, 8, 12, 6, 7")
      call card%width(element_width)
      if (card%reads) call add_quads(model%mesh, card%sets())
      do while (card%next())
         call card%define(a_quad, "EID", "number of the element", id)
         call card%refer(a_part, "PID", "part", part)
         call card%card()
         do k = 1, nine_nodes
            call card%integer(node_names(k), trim(node_sentences(k)), number, least=1)
         end do
         if (card%reads) call set_quad(card, id, part, nine_nodes, model%mesh)
      end do
   end subroutine element_plate_q9

   !> One quad: number, part and nodes
   subroutine set_quad(card, id, part, nodes, mesh)
      class(card_visitor_type), intent(inout) :: card
      !> Its number, part, and number of nodes; 0 if that is wrong, which has been reported
      integer, intent(in) :: id, part, nodes
      !> Has room for the quads of the keyword at its end
      type(mesh_type), intent(inout) :: mesh

      integer :: k, quad

      quad = size(mesh%quad_id) - card%sets() + card%nth
      mesh%quad_id(quad) = id
      mesh%quad_part(quad) = part
      ! the first quad has as many nodes as all of them
      if (size(mesh%quad_node, 1) == 0 .and. nodes > 0) mesh%quad_node = &
         & spread([(0, k=1, nodes)], 2, size(mesh%quad_id))
      if (nodes == 0 .or. nodes /= size(mesh%quad_node, 1)) card%catalogue%mesh_is_sound = .false.
      if (nodes == 0) return
      if (nodes /= size(mesh%quad_node, 1)) then
         call card%refuse("N1", "an element of "//text(nodes)//" nodes in a mesh of " &
            & //text(size(mesh%quad_node, 1))//"-node elements", &
            & "the same number of nodes for all elements, 4 or 9")
         return
      end if
      associate (node => mesh%quad_node(:, quad))
         do k = 1, nodes
            call card%look_up(a_node, node_names(k), node(k))
            if (node(k) == 0 .or. all(node(:k - 1) /= node(k))) cycle
            call card%refuse(node_names(k), "node "//text(card%whole(node_names(k))) &
               & //" is in the element twice", "as many different nodes as the element has")
         end do
         if (any(node == 0)) card%catalogue%mesh_is_sound = .false.
      end associate
   end subroutine set_quad

   !> Number of nodes of an element of *ELEMENT_SHELL; 0 and a report when there is no such element
   integer function nodes_of(card, given) result(nodes)
      class(card_visitor_type), intent(inout) :: card
      !> Numbers on the card
      integer, intent(in) :: given(nine_nodes)

      nodes = four_nodes
      if (all(given(four_nodes + 1:) == 0)) then
         if (given(3) /= given(4)) return
         call card%refuse("N4", "a triangle", "four different nodes; there are no triangles")
      else if (all(given > 0)) then
         nodes = nine_nodes
         return
      else if (all(given(:eight_nodes) > 0)) then
         call card%refuse("N9", "a quad of eight nodes", &
            & "four or nine nodes; the ninth is the centre")
      else
         call card%refuse("N5", "some mid-side nodes are missing", "four or nine nodes")
      end if
      nodes = 0
   end function nodes_of

   !> Make room for quads
   pure subroutine add_quads(mesh, more)
      type(mesh_type), intent(inout) :: mesh
      !> How many
      integer, intent(in) :: more

      integer :: n

      n = size(mesh%quad_id) + more
      mesh%quad_id = reshape(mesh%quad_id, [n], pad=[0])
      mesh%quad_part = reshape(mesh%quad_part, [n], pad=[0])
      mesh%quad_node = reshape(mesh%quad_node, [size(mesh%quad_node, 1), n], pad=[0])
   end subroutine add_quads

end module plydyn_input_mesh
