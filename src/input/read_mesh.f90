!> Readers of nodes and elements.
module plydyn_input_read_mesh
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type, is_wrong
   use plydyn_input_catalogue, only : a_node, a_part, a_quad, catalogue_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: new_mesh, read_node, read_element_quad

   !> Nodes of a quad without and with mid-sides and centre, and of one without centre
   integer, parameter :: four_nodes = 4, eight_nodes = 8, nine_nodes = 9
   !> Names of the nodes on a card
   character(2), parameter :: node_names(nine_nodes) = &
      & ["N1", "N2", "N3", "N4", "N5", "N6", "N7", "N8", "N9"]

contains

   !> A mesh without nodes and quads
   pure type(mesh_type) function new_mesh() result(mesh)
      allocate (mesh%node_id(0), mesh%position(3, 0), mesh%quad_id(0), mesh%quad_part(0), &
         & mesh%quad_node(0, 0), mesh%brick_id(0), mesh%brick_part(0), mesh%brick_node(8, 0), &
         & mesh%brick_angle(0))
   end function new_mesh

   !> *NODE: nodes of the reference plane
   subroutine read_node(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      integer :: n, nth

      n = size(model%mesh%node_id)
      if (any(cards%state == is_wrong)) catalogue%mesh_is_sound = .false.
      call add_nodes(model%mesh, cards%sets())
      do nth = 1, cards%sets()
         call catalogue%define(a_node, cards, "NID", nth)
         model%mesh%node_id(n + nth) = cards%integer("NID", nth)
         model%mesh%position(:, n + nth) = cards%reals(["X", "Y", "Z"], nth)
      end do
   end subroutine read_node

   !> *ELEMENT_SHELL, *ELEMENT_PLATE_Q9: quads of four or nine nodes, of nine
   subroutine read_element_quad(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      integer :: n, nodes, nth

      n = size(model%mesh%quad_id)
      call add_quads(model%mesh, cards%sets())
      nodes = nine_nodes
      do nth = 1, cards%sets()
         if (cards%name == "ELEMENT_SHELL") call check_node_count(cards, nth, catalogue, nodes)
         call read_quad(cards, nth, nodes, n + nth, catalogue, model%mesh)
      end do
   end subroutine read_element_quad

   !> One quad: number, part and nodes
   subroutine read_quad(cards, nth, nodes, quad, catalogue, mesh)
      type(cards_type), intent(in) :: cards
      !> Which set of cards
      integer, intent(in) :: nth
      !> Number of its nodes; 0 if that is wrong, which has been reported
      integer, intent(in) :: nodes
      !> Its place in the mesh
      integer, intent(in) :: quad
      type(catalogue_type), intent(inout) :: catalogue
      type(mesh_type), intent(inout) :: mesh

      integer :: k

      call catalogue%define(a_quad, cards, "EID", nth)
      call catalogue%find(a_part, cards, "PID", mesh%quad_part(quad), nth)
      mesh%quad_id(quad) = cards%integer("EID", nth)
      if (size(mesh%quad_node, 1) == 0 .and. nodes > 0) call reshape_quads(mesh, nodes)
      if (nodes == 0 .or. nodes /= size(mesh%quad_node, 1)) catalogue%mesh_is_sound = .false.
      if (nodes == 0) return
      if (nodes /= size(mesh%quad_node, 1)) then
         call catalogue%refuse(cards, "N1", "an element of "//text(nodes)//" nodes in a mesh of " &
            & //text(size(mesh%quad_node, 1))//"-node elements", &
            & "the same number of nodes for all elements, 4 or 9", nth)
         return
      end if
      do k = 1, nodes
         call catalogue%find(a_node, cards, node_names(k), mesh%quad_node(k, quad), nth)
         call check_repeated(cards, nth, k, mesh%quad_node(:k, quad), catalogue)
      end do
      if (any(mesh%quad_node(:, quad) == 0)) catalogue%mesh_is_sound = .false.
   end subroutine read_quad

   !> Number of nodes of an element of *ELEMENT_SHELL; 0 and a report when there is no such element
   subroutine check_node_count(cards, nth, catalogue, nodes)
      type(cards_type), intent(in) :: cards
      !> Which set of cards
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue
      !> 4, 9, or 0
      integer, intent(out) :: nodes

      integer :: given(nine_nodes)

      given(:) = cards%integers(node_names, nth)
      nodes = four_nodes
      if (all(given(four_nodes + 1:) == 0)) then
         if (given(3) /= given(4)) return
         call catalogue%refuse(cards, "N4", "a triangle", &
            & "four different nodes; there are no triangles", nth)
      else if (all(given > 0)) then
         nodes = nine_nodes
         return
      else if (all(given(:eight_nodes) > 0)) then
         call catalogue%refuse(cards, "N9", "a quad of eight nodes", &
            & "four or nine nodes; the ninth is the centre", nth)
      else
         call catalogue%refuse(cards, "N5", "some mid-side nodes are missing", &
            & "four or nine nodes", nth)
      end if
      nodes = 0
   end subroutine check_node_count

   !> A node that an element has already
   subroutine check_repeated(cards, nth, k, nodes, catalogue)
      type(cards_type), intent(in) :: cards
      !> Which set of cards, and place of the node in the element
      integer, intent(in) :: nth, k
      !> Nodes up to that place
      integer, intent(in) :: nodes(:)
      type(catalogue_type), intent(inout) :: catalogue

      if (nodes(k) == 0 .or. all(nodes(:k - 1) /= nodes(k))) return
      call catalogue%refuse(cards, node_names(k), "node " &
         & //text(cards%integer(node_names(k), nth))//" is in the element twice", &
         & "as many different nodes as the element has", nth)
   end subroutine check_repeated

   !> Make room for nodes
   pure subroutine add_nodes(mesh, more)
      type(mesh_type), intent(inout) :: mesh
      !> How many
      integer, intent(in) :: more

      integer, allocatable :: id(:)
      real(wp), allocatable :: position(:, :)
      integer :: n

      n = size(mesh%node_id)
      allocate (id(n + more), position(3, n + more))
      id(:n) = mesh%node_id
      position(:, :n) = mesh%position
      call move_alloc(id, mesh%node_id)
      call move_alloc(position, mesh%position)
   end subroutine add_nodes

   !> Make room for quads
   pure subroutine add_quads(mesh, more)
      type(mesh_type), intent(inout) :: mesh
      !> How many
      integer, intent(in) :: more

      integer, allocatable :: id(:), node(:, :), part(:)
      integer :: n

      n = size(mesh%quad_id)
      allocate (id(n + more), part(n + more), node(size(mesh%quad_node, 1), n + more))
      id(:n) = mesh%quad_id
      part(:n) = mesh%quad_part
      node(:, :n) = mesh%quad_node
      node(:, n + 1:) = 0
      call move_alloc(id, mesh%quad_id)
      call move_alloc(part, mesh%quad_part)
      call move_alloc(node, mesh%quad_node)
   end subroutine add_quads

   !> Give the quads their number of nodes, which is that of the first one
   pure subroutine reshape_quads(mesh, nodes)
      type(mesh_type), intent(inout) :: mesh
      !> 4 or 9
      integer, intent(in) :: nodes

      deallocate (mesh%quad_node)
      allocate (mesh%quad_node(nodes, size(mesh%quad_id)))
      mesh%quad_node(:, :) = 0
   end subroutine reshape_quads

end module plydyn_input_read_mesh
