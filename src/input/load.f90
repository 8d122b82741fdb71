!> Keywords of loads.
module plydyn_input_load
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : lower_case, text
   use plydyn_deck_declaration, only : extension, standard
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_curve, a_node, a_node_set, a_quad_set
   use plydyn_input_keyword_row, only : for_plates, keyword_list_type, stage_load
   use plydyn_model_curve, only : curve_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : body_load_type, holds_all, line_load_type, point_load_type, &
      & pressure_type, support_type
   implicit none
   private

   public :: add_loads, check_times, visit_curve, visit_direction, visit_face, visit_factor

   !> Heading of the theory on loads
   character(*), parameter, public :: of_loads = "8-supports-motions-and-loads"
   !> What they are among the changes of a restart
   character(*), parameter :: change = "loads"

contains

   !> Add these keywords
   subroutine add_loads(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("LOAD_NODE_SET", load_node, stage_load, check=check_times)
      call list%add("LOAD_NODE_POINT", load_node, stage_load, check=check_times)
      call list%add("LOAD_FACE_POINT", load_face_point, stage_load, for_plates, check_times)
      call list%add("LOAD_FACE_LINE", load_face_line, stage_load, for_plates, check_times)
      call list%add("LOAD_SHELL_SET", load_shell_set, stage_load, for_plates, check_times)
      call list%add("LOAD_FACE_PRESSURE", load_face_pressure, stage_load, for_plates, check_times)
      call list%add("LOAD_BODY_X", load_body, stage_load, check=check_times)
      call list%add("LOAD_BODY_Y", load_body, stage_load, check=check_times)
      call list%add("LOAD_BODY_Z", load_body, stage_load, check=check_times)
   end subroutine add_loads

   !> Forces at nodes, shared over the thickness
   subroutine load_node(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(point_load_type) :: new(max(1, card%sets()))
      logical :: is_set

      is_set = card%name == "LOAD_NODE_SET"
      call card%keyword(standard, "A force at each node, shared by the thickness in proportion " &
         & //"to mass.", change=change)
      call card%example(of_loads, trim(merge("2 ", "13", is_set))//", 3, 1, -10.0")
      do while (card%next())
         associate (load => new(card%nth))
            if (is_set) call card%members(a_node_set, "NSID", "node set", load%nodes)
            if (.not. is_set) call visit_node(card, load%nodes)
            call visit_direction(card, load%direction)
            call card%refer(a_curve, "LCID", "curve", load%curve)
            call visit_factor(card, load%scale)
            call check_held(card, model%supports, load)
         end associate
         call card%unused("CID M1 M2 M3")
      end do
      if (card%reads) model%point_loads = [model%point_loads, new(:card%sets())]
   end subroutine load_node

   !> Forces at nodes of a face
   subroutine load_face_point(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(point_load_type) :: new(max(1, card%sets()))

      call card%keyword(extension, "A force at a node of a face.", change=change)
      call card%example(of_loads, "13, 1, 3, 1, -10.0")
      do while (card%next())
         associate (load => new(card%nth))
            call visit_node(card, load%nodes)
            call visit_face(card, load%face)
            call visit_direction(card, load%direction)
            call visit_curve(card, "curve; 0 for the constant 1", model%curves, load%curve)
            call visit_factor(card, load%scale)
            call check_held(card, model%supports, load)
         end associate
      end do
      if (card%reads) model%point_loads = [model%point_loads, new(:card%sets())]
   end subroutine load_face_point

   !> Forces along a line of a face
   subroutine load_face_line(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(line_load_type) :: new(max(1, card%sets()))

      call card%keyword(extension, "A force per length along the element edges between the nodes " &
         & //"of a set.", change=change)
      call card%remark("Every element edge with all its nodes in the set carries the load.")
      call card%example(of_loads, "2, 1, 3, 1, -2.0")
      do while (card%next())
         associate (load => new(card%nth))
            call card%members(a_node_set, "NSID", "node set", load%nodes)
            call card%integer("FACE", "-1 bottom face, 1 top face", load%face, allowed=[-1, 1])
            call visit_direction(card, load%direction)
            call visit_curve(card, "curve; 0 for the constant 1", model%curves, load%curve)
            call visit_factor(card, load%scale)
            if (.not. card%reads) cycle
            if (size(load%nodes) == 0 .or. .not. card%catalogue%mesh_is_sound) cycle
            if (.not. has_edge(model%mesh, load%nodes)) call card%refuse("NSID", &
               & "no element has an edge with all its nodes in the set", &
               & "the nodes along an edge of the elements, mid-side nodes among them")
         end associate
      end do
      if (card%reads) model%line_loads = [model%line_loads, new(:card%sets())]
   end subroutine load_face_line

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

   !> Pressure of LS-DYNA
   subroutine load_shell_set(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(pressure_type) :: new(max(1, card%sets()))

      call card%keyword(standard, "A pressure against the normal of some elements: onto the top " &
         & //"face, downwards.", suffixes="ID", change=change)
      call card%example(of_loads, "1, 1, 2.0")
      do while (card%next())
         associate (load => new(card%nth))
            call card%members(a_quad_set, "ESID", "shell set", load%quads)
            call card%refer(a_curve, "LCID", "curve", load%curve)
            call visit_factor(card, load%scale)
         end associate
         call card%unused("AT")
      end do
      if (card%reads) model%pressures = [model%pressures, new(:card%sets())]
   end subroutine load_shell_set

   !> Pressure onto a face
   subroutine load_face_pressure(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(pressure_type) :: new(max(1, card%sets()))
      integer :: i

      call card%keyword(extension, "A pressure onto a face: down onto the top one, up onto the " &
         & //"bottom one.", change=change)
      call card%example(of_loads, "0, 1, 1, 2.0")
      do while (card%next())
         associate (load => new(card%nth))
            call card%members(a_quad_set, "SSID", "shell set; 0 for all elements", load%quads, &
               & least=0)
            call card%integer("FACE", "-1 bottom face, 1 top face", load%face, allowed=[-1, 1])
            call visit_curve(card, "curve; 0 for the constant 1", model%curves, load%curve)
            call visit_factor(card, load%scale)
         end associate
         if (.not. card%reads) cycle
         if (.not. allocated(new(card%nth)%quads)) new(card%nth)%quads = &
            & [(i, i=1, size(model%mesh%quad_id))]
      end do
      if (card%reads) model%pressures = [model%pressures, new(:card%sets())]
   end subroutine load_face_pressure

   !> Acceleration of the frame
   subroutine load_body(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      character(:), allocatable :: name
      type(body_load_type) :: load

      name = card%name
      name = name(len(name):)
      load%direction = index("XYZ", name)
      call card%keyword(standard, "An acceleration of the frame along "//lower_case(name) &
         & //": the body force is against it.", once=.true., change=change)
      call card%example(of_loads, "1, 9810.0")
      call card%refer(a_curve, "LCID", "curve", load%curve)
      call visit_factor(card, load%scale)
      call card%unused("LCIDDR XC YC ZC CID")
      if (.not. card%reads) return
      load%line = card%line_of("SF")
      model%body_loads = [model%body_loads, load]
   end subroutine load_body

   !> A single node
   subroutine visit_node(card, nodes)
      class(card_visitor_type), intent(inout) :: card
      !> Its index
      integer, allocatable, intent(inout) :: nodes(:)

      if (.not. allocated(nodes)) allocate (nodes(1))
      call card%refer(a_node, "NID", "node", nodes(1))
   end subroutine visit_node

   !> Face that something acts on, or all planes
   subroutine visit_face(card, face)
      class(card_visitor_type), intent(inout) :: card
      integer, intent(inout) :: face

      call card%integer("FACE", "-1 bottom face, 1 top face, 2 all planes", face, &
         & allowed=[-1, 1, 2])
   end subroutine visit_face

   !> Direction of a load or motion
   subroutine visit_direction(card, direction)
      class(card_visitor_type), intent(inout) :: card
      integer, intent(inout) :: direction

      call card%integer("DOF", "1, 2, 3 for x, y, z", direction, allowed=[1, 2, 3])
   end subroutine visit_direction

   !> Factor on a curve
   subroutine visit_factor(card, scale)
      class(card_visitor_type), intent(inout) :: card
      real(wp), intent(inout) :: scale

      call card%real("SF", "any", "factor on the curve", scale, default=1.0_wp)
   end subroutine visit_factor

   !> Warn of loads and motions that do nothing from the start of the run, or of its stage, to the
   !> end
   subroutine check_times(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      real(wp) :: begin
      integer :: curve

      ! the end of an old deck may be another by now
      if (card%line <= card%catalogue%stored_lines) return
      begin = card%catalogue%start(card%root)
      associate (last => model%control%end_time)
         if (last <= begin) return
         do while (card%next())
            curve = findloc(model%curves%id, card%whole("LCID"), 1)
            if (card%name == "BOUNDARY_PRESCRIBED_MOTION_SET") then
               if (card%number("BIRTH") > 0.0_wp .and. card%number("BIRTH") &
                  & + card%catalogue%origin(card%root) >= last) call card%warn("BIRTH", &
                  & "the motion begins behind the end of the run", "a time before that of ENDTIM")
            end if
            if (curve == 0) cycle
            if (maxval(abs(model%curves(curve)%y)) <= 0.0_wp) cycle
            if (model%curves(curve)%largest(begin, last) > 0.0_wp) cycle
            call card%warn("LCID", "curve "//text(card%whole("LCID"))//" is 0 from the start to " &
               & //"the end of the run", "points between "//text(begin)//" and "//text(last) &
               & //", in the unit of ENDTIM")
         end do
      end associate
   end subroutine check_times

   !> Warn of forces none of whose points can move along them
   subroutine check_held(card, supports, load)
      class(card_visitor_type), intent(inout) :: card
      !> All supports of the run
      type(support_type), intent(in) :: supports(:)
      type(point_load_type), intent(in) :: load

      if (.not. card%reads .or. load%direction == 0 .or. .not. allocated(load%nodes)) return
      if (card%catalogue%report%has_errors()) return
      if (holds_all(supports, load%nodes, load%direction, load%face)) call card%warn("DOF", &
         & "all points of the load are held in this direction: it moves nothing", &
         & "another DOF, or nodes that are free")
   end subroutine check_held

   !> Curve of plydyn's own keywords, where 0 is the constant 1
   subroutine visit_curve(card, sentence, curves, curve, default)
      class(card_visitor_type), intent(inout) :: card
      !> What it means
      character(*), intent(in) :: sentence
      !> Gets the constant when it is needed first
      type(curve_type), allocatable, intent(inout) :: curves(:)
      !> Index of the curve
      integer, intent(inout) :: curve
      !> Value of a blank
      integer, intent(in), optional :: default

      call card%refer(a_curve, "LCID", sentence, curve, default, least=0)
      if (.not. card%reads .or. curve > 0 .or. card%whole("LCID") > 0) return
      do curve = size(curves), 1, -1
         if (curves(curve)%id == 0) return
      end do
      curves = [curves, curve_type(x=[0.0_wp], y=[1.0_wp])]
      curve = size(curves)
   end subroutine visit_curve

end module plydyn_input_load
