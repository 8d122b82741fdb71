!> Readers of loads.
module plydyn_input_read_load
   use plydyn_base_precision, only : wp
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : a_curve, a_node, a_node_set, a_quad_set, catalogue_type
   use plydyn_model_curve, only : curve_type
   use plydyn_model_load, only : body_load_type, line_load_type, point_load_type, pressure_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_support, only : top_face
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_load_node, read_load_face_line, read_load_pressure, read_load_body, find_curve

contains

   !> *LOAD_NODE_SET, *LOAD_NODE_POINT, *LOAD_FACE_POINT: a force at each node of a set, at a node,
   !> at a node of a face
   subroutine read_load_node(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(point_load_type) :: new(cards%sets())
      integer :: nth

      do nth = 1, cards%sets()
         if (cards%name == "LOAD_NODE_SET") then
            call catalogue%find_set(a_node_set, cards, "NSID", new(nth)%nodes, nth)
         else
            allocate (new(nth)%nodes(1))
            call catalogue%find(a_node, cards, "NID", new(nth)%nodes(1), nth)
         end if
         new(nth)%direction = cards%integer("DOF", nth)
         new(nth)%scale = cards%real("SF", nth)
         if (cards%name == "LOAD_FACE_POINT") then
            call find_curve(cards, nth, catalogue, model%curves, new(nth)%curve)
            new(nth)%face = cards%integer("FACE", nth)
         else
            call catalogue%find(a_curve, cards, "LCID", new(nth)%curve, nth)
         end if
      end do
      model%point_loads = [model%point_loads, new]
   end subroutine read_load_node

   !> *LOAD_FACE_LINE: a force per length along element edges
   subroutine read_load_face_line(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(line_load_type) :: new(cards%sets())
      integer :: nth

      do nth = 1, cards%sets()
         call catalogue%find_set(a_node_set, cards, "NSID", new(nth)%nodes, nth)
         call find_curve(cards, nth, catalogue, model%curves, new(nth)%curve)
         new(nth)%direction = cards%integer("DOF", nth)
         new(nth)%scale = cards%real("SF", nth)
         new(nth)%face = cards%integer("FACE", nth)
         if (size(new(nth)%nodes) == 0 .or. .not. catalogue%mesh_is_sound) cycle
         if (has_edge(model%mesh, new(nth)%nodes)) cycle
         call catalogue%refuse(cards, "NSID", "no element has an edge with all its nodes in the " &
            & //"set", "the nodes along an edge of the elements, mid-side nodes among them", nth)
      end do
      model%line_loads = [model%line_loads, new]
   end subroutine read_load_face_line

   !> True when all nodes of an element's edge are among some nodes
   pure logical function has_edge(mesh, nodes)
      type(mesh_type), intent(in) :: mesh
      !> Indices of the nodes
      integer, intent(in) :: nodes(:)

      integer, parameter :: corners = 4
      logical, allocatable :: inside(:)
      integer :: e, k

      allocate (inside(size(mesh%node_id)))
      inside(:) = .false.
      inside(nodes) = .true.
      has_edge = .true.
      do e = 1, size(mesh%quad_id)
         associate (met => inside(mesh%quad_node(:, e)))
            do k = 1, corners
               ! a quad of nine nodes has one in the middle of each edge
               if (met(k) .and. met(modulo(k, corners) + 1) &
                  & .and. met(merge(k, corners + k, size(met) == corners))) return
            end do
         end associate
      end do
      has_edge = .false.
   end function has_edge

   !> *LOAD_SHELL_SET, *LOAD_FACE_PRESSURE: a pressure onto the top face, onto a face
   subroutine read_load_pressure(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(pressure_type) :: new(cards%sets())
      integer :: i, nth

      do nth = 1, cards%sets()
         new(nth)%scale = cards%real("SF", nth)
         if (cards%name == "LOAD_SHELL_SET") then
            call catalogue%find_set(a_quad_set, cards, "ESID", new(nth)%quads, nth)
            call catalogue%find(a_curve, cards, "LCID", new(nth)%curve, nth)
            new(nth)%face = top_face
            cycle
         end if
         if (cards%integer("SSID", nth) == 0) then
            new(nth)%quads = [(i, i=1, size(model%mesh%quad_id))]
         else
            call catalogue%find_set(a_quad_set, cards, "SSID", new(nth)%quads, nth)
         end if
         call find_curve(cards, nth, catalogue, model%curves, new(nth)%curve)
         new(nth)%face = cards%integer("FACE", nth)
      end do
      model%pressures = [model%pressures, new]
   end subroutine read_load_pressure

   !> *LOAD_BODY_X, _Y, _Z: an acceleration of the frame
   subroutine read_load_body(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(body_load_type) :: load

      load%direction = index("XYZ", cards%name(len(cards%name):))
      load%scale = cards%real("SF")
      call catalogue%find(a_curve, cards, "LCID", load%curve)
      model%body_loads = [model%body_loads, load]
   end subroutine read_load_body

   !> Curve of our own keywords, where 0 is the constant 1
   subroutine find_curve(cards, nth, catalogue, curves, curve)
      type(cards_type), intent(in) :: cards
      !> Which set of cards
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue
      !> Gets the constant when it is needed first
      type(curve_type), allocatable, intent(inout) :: curves(:)
      !> Index of the curve
      integer, intent(out) :: curve

      type(curve_type) :: constant

      if (cards%integer("LCID", nth) /= 0) then
         call catalogue%find(a_curve, cards, "LCID", curve, nth)
         return
      end if
      do curve = size(curves), 1, -1
         if (curves(curve)%id == 0) return
      end do
      constant%x = [0.0_wp]
      constant%y = [1.0_wp]
      curves = [curves, constant]
      curve = size(curves)
   end subroutine find_curve

end module plydyn_input_read_load
