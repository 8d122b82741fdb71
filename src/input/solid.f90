!> Keywords of bricks.
module plydyn_input_solid
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_declaration, only : standard
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_brick, a_curve, a_material, a_node, a_part, &
      & a_solid_section, an_hourglass
   use plydyn_input_keyword_row, only : for_bricks, keyword_list_type, stage_definition, &
      & stage_element, stage_load, stage_part
   use plydyn_input_load, only : check_times
   use plydyn_model_layup, only : brick_section_type, part_type, ply_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : segment_load_type
   implicit none
   private

   public :: add_solids

   !> Columns of the fields of an element, and of a vector
   integer, parameter :: element_width = 8, vector_width = 16
   !> Nodes of a brick and of a segment
   integer, parameter :: corners = 8, segment = 4
   !> ELFORM of bricks of one point, and the least one of cohesive bricks
   integer, parameter :: one_point = 1, cohesive = 19

contains

   !> Add these keywords
   subroutine add_solids(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("ELEMENT_SOLID", element_solid, stage_element)
      call list%add("ELEMENT_SOLID_ORTHO", element_solid_ortho, stage_element)
      call list%add("PART", part_of_bricks, stage_part, for_bricks)
      call list%add("SECTION_SOLID", section_solid, stage_definition, for_bricks)
      call list%add("HOURGLASS", hourglass, stage_definition, for_bricks)
      call list%add("CONTROL_HOURGLASS", control_hourglass, stage_definition, for_bricks, &
         & check_control)
      call list%add("LOAD_SEGMENT", load_segment, stage_load, for_bricks, check_times)
   end subroutine add_solids

   !> Bricks
   subroutine element_solid(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      integer :: brick, part

      call card%keyword(standard, "Bricks of eight nodes.")
      call card%remark("Four nodes of a face, counter-clockwise seen from the opposite face, " &
         & //"then the four of that face in the same order. A deck has plates or bricks, not " &
         & //"both. Bricks take no keyword that needs plies, faces or quads, and no " &
         & //"*DATABASE_PROFILE. Every part of bricks has one material, whose axis angle is that " &
         & //"of the fibres: *MAT_ORTHOTROPIC_ELASTIC with AOPT 2 for each direction; or the " &
         & //"bricks have their own in *ELEMENT_SOLID_ORTHO.")
      call card%example("bricks", "1, 1, 1, 2, 3, 4, 5, 6, 7, 8")
      if (card%reads) call add_bricks(model%mesh, card%sets())
      do while (card%next())
         call visit_brick(card, model%mesh, brick, part)
         if (.not. card%reads .or. part == 0) cycle
         model%mesh%brick_angle(brick) = model%parts(part)%plies(1)%angle
      end do
   end subroutine element_solid

   !> Bricks with axes of their own
   subroutine element_solid_ortho(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      integer :: brick, i, part
      real(wp) :: a(3), d(3)

      call card%keyword(standard, "Bricks of eight nodes with fibres in directions of their own.")
      call card%remark("As *ELEMENT_SOLID, with the axes of the ply in each brick: they take the " &
         & //"place of those of its material. Plies lie in planes of constant z.")
      call card%example("bricks", "1, 1, 1, 2, 3, 4, 5, 6, 7, 8|1.0, 0, 0|0, 1.0, 0")
      if (card%reads) call add_bricks(model%mesh, card%sets())
      do while (card%next())
         call visit_brick(card, model%mesh, brick, part)
         call card%card()
         call card%width(vector_width)
         do i = 1, 3
            call card%real("A"//text(i), "-", "vector along the fibres, component "//text(i), &
               & a(i), default=0.0_wp)
         end do
         call card%card()
         do i = 1, 3
            call card%real("D"//text(i), "-", "vector in the plane of the ply, to the left of A, " &
               & //"component "//text(i), d(i), default=0.0_wp)
         end do
         if (card%reads) model%mesh%brick_angle(brick) = angle_of(card, a, d)
      end do
   end subroutine element_solid_ortho

   !> The card of a brick
   subroutine visit_brick(card, mesh, brick, part)
      class(card_visitor_type), intent(inout) :: card
      !> Has room for the bricks of the keyword at its end
      type(mesh_type), intent(inout) :: mesh
      !> Its place in the mesh, and its part
      integer, intent(inout) :: brick, part

      integer :: i, id, node(corners)

      call card%width(element_width)
      call card%define(a_brick, "EID", "number of the brick", id)
      call card%refer(a_part, "PID", "part", part)
      do i = 1, corners
         call card%refer(a_node, "N"//text(i), "node", node(i))
         if (.not. card%reads) cycle
         if (node(i) > 0 .and. any(node(:i - 1) == node(i))) call card%refuse("N"//text(i), &
            & "node "//text(card%whole("N"//text(i)))//" is in the brick twice", &
            & "eight different nodes; there are no wedges and tetrahedra")
      end do
      if (.not. card%reads) return
      brick = size(mesh%brick_id) - card%sets() + card%nth
      mesh%brick_id(brick) = id
      mesh%brick_part(brick) = part
      mesh%brick_node(:, brick) = node
      if (any(node == 0)) card%catalogue%mesh_is_sound = .false.
   end subroutine visit_brick

   !> Direction of the fibres of a brick, degrees from the x axis: along A, with D to its left
   real(wp) function angle_of(card, a, d) result(angle)
      class(card_visitor_type), intent(inout) :: card
      !> The vectors
      real(wp), intent(in) :: a(3), d(3)

      real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp, flat = 1.0e-6_wp

      angle = 0.0_wp
      if (abs(a(3)) > flat*norm2(a) .or. abs(d(3)) > flat*norm2(d)) then
         call card%refuse("A3", "the axes do not lie in the x-y plane", &
            & "A along the fibres and D across them, both with 0 along z")
      else if (a(1)*d(2) - a(2)*d(1) <= flat*norm2(a)*norm2(d)) then
         call card%refuse("D1", "D does not lie to the left of A, seen from above", &
            & "A along the fibres, such as 1, 0, 0, and D across them, such as 0, 1, 0")
      else
         angle = atan2(a(2), a(1))/degree
      end if
   end function angle_of

   !> A part of bricks
   subroutine part_of_bricks(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(part_type) :: part
      integer :: control, section

      call card%keyword(standard, "Bricks of one material.")
      call card%remark("Laminates have their plies in *PART_COMPOSITE.")
      call card%example("bricks", "block|1, 1, 1")
      call card%text_line("TITLE", "title of the part", part%title)
      call card%card()
      allocate (part%plies(1), part%joint(0))
      part%plies(1) = ply_type(id=1, order=0)
      call card%define(a_part, "PID", "number of the part", part%id)
      call card%refer(a_solid_section, "SECID", "*SECTION_SOLID", section)
      call card%refer(a_material, "MID", "material", part%plies(1)%material)
      call card%unused("EOSID")
      call card%refer(an_hourglass, "HGID", "*HOURGLASS; 0 for *CONTROL_HOURGLASS", control, &
         & default=0, least=0)
      call card%unused("GRAV ADPOPT TMID")
      if (.not. card%reads) return
      if (part%plies(1)%material > 0) part%plies(1)%angle = &
         & model%materials(part%plies(1)%material)%axis_angle
      part%brick = card%catalogue%usual_hourglass
      if (control > 0) part%brick = card%catalogue%hourglasses(control)
      part%brick%points = corners
      if (section > 0) part%brick%points = card%catalogue%solid_sections(section)%points
      if (control > 0 .and. part%brick%points /= one_point) call card%warn_idle("HGID", &
         & "ELFORM 1 on *SECTION_SOLID")
      model%parts = [model%parts, part]
   end subroutine part_of_bricks

   !> Integration of bricks
   subroutine section_solid(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(brick_section_type) :: section
      integer :: form, id

      call card%keyword(standard, "How bricks are integrated.", suffixes="TITLE")
      call card%remark("ELFORM 1: one point, with the mean gradients of the brick, which need " &
         & //"hourglass control. ELFORM 2: eight points that share the mean of their volume " &
         & //"strain, but in plies that are damaged. 19 and 20, cohesive bricks, are refused: " &
         & //"*INTERFACE_COHESIVE joins plies of one part.")
      call card%example("bricks", "1, 1")
      call card%define(a_solid_section, "SECID", "number of the section", id)
      call card%integer("ELFORM", "1 one point, 2 eight points", form, default=1, &
         & allowed=[1, 2, 19, 20])
      call card%unused("AET")
      if (.not. card%reads) return
      section%points = merge(1, corners, form == one_point)
      if (form >= cohesive) then
         card%catalogue%has_other_solids = .true.
         call card%refuse("ELFORM", "there are no cohesive bricks", "plies of one " &
            & //"*PART_COMPOSITE with *INTERFACE_COHESIVE between them and the material there; " &
            & //"plydyn-pre translate makes them of stacked shells")
      end if
      card%catalogue%solid_sections = [card%catalogue%solid_sections, section]
   end subroutine section_solid

   !> Hourglass control of some parts
   subroutine hourglass(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(brick_section_type) :: control
      integer :: id

      call card%keyword(standard, "Hourglass control of parts that name it.", suffixes="TITLE")
      call card%example("bricks", "1, 6, 0.1")
      call card%define(an_hourglass, "HGID", "number of the control", id)
      call visit_control(card, "QM", control)
      call card%unused("IBQ Q1 Q2 QB QW")
      if (card%reads) card%catalogue%hourglasses = [card%catalogue%hourglasses, control]
   end subroutine hourglass

   !> Hourglass control of all other parts
   subroutine control_hourglass(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(brick_section_type) :: control

      call card%keyword(standard, "Hourglass control of parts that name none.", once=.true.)
      call card%remark("Without the keyword: IHQ 6 and QH 0.1.")
      call card%example("bricks", "6, 0.1")
      call visit_control(card, "QH", control)
      if (card%reads) card%catalogue%usual_hourglass = control
   end subroutine control_hourglass

   !> Warn of hourglass control where no brick has one point
   subroutine check_control(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      if (any(model%parts%brick%points == one_point)) return
      call card%warn("IHQ", "no brick needs hourglass control", "ELFORM 1 on *SECTION_SOLID, or " &
         & //"not this keyword")
   end subroutine check_control

   !> Kind and coefficient of hourglass control
   subroutine visit_control(card, coefficient, control)
      class(card_visitor_type), intent(inout) :: card
      !> Name of the coefficient
      character(*), intent(in) :: coefficient
      type(brick_section_type), intent(inout) :: control

      call card%integer("IHQ", "3 viscous, after Flanagan and Belytschko; 6 stiffness, by " &
         & //"assumed strain after Belytschko and Bindeman", control%control, allowed=[3, 6])
      call card%real(coefficient, "-", "coefficient; with IHQ 6 and 1 elastic bricks bend as " &
         & //"they should", control%coefficient, default=0.1_wp, least=0.0_wp, most=1.0_wp)
      call card%zero_is_default()
   end subroutine visit_control

   !> Pressure on faces of bricks
   subroutine load_segment(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(segment_load_type) :: new(max(1, card%sets()))
      integer, allocatable :: around(:), first(:)
      integer :: i

      call card%keyword(standard, "Pressure on faces between four nodes.", change="loads")
      call card%remark("The pressure acts against the normal that the nodes turn around " &
         & //"counter-clockwise, in the undeformed shape.")
      call card%example("8-supports-motions-and-loads", "1, 2.0, 0, 5, 6, 7, 8")
      if (card%reads .and. card%catalogue%mesh_is_sound) call list_bricks(model%mesh, first, around)
      do while (card%next())
         associate (load => new(card%nth))
            call card%refer(a_curve, "LCID", "curve", load%curve)
            call card%real("SF", "stress", "factor on the curve", load%scale, default=1.0_wp)
            call card%zero_is_default()
            call card%unused("AT")
            do i = 1, segment
               call card%refer(a_node, "N"//text(i), "node", load%node(i))
            end do
            if (.not. allocated(first) .or. any(load%node == 0)) cycle
            if (any([(is_around_face(model%mesh%brick_node(:, around(i)), load%node), &
               & i=first(load%node(1)), first(load%node(1) + 1) - 1)])) cycle
            call card%refuse("N1", "the four nodes are no face of a brick", &
               & "the nodes of one face of a brick, in their order around it")
         end associate
      end do
      if (card%reads) model%segment_loads = [model%segment_loads, new(:card%sets())]
   end subroutine load_segment

   !> Whether four nodes go around a face of a brick, in either sense
   pure logical function is_around_face(brick, node) result(is_around)
      !> Nodes of the brick, and the four
      integer, intent(in) :: brick(corners), node(segment)

      !> Nodes around the faces of a brick
      integer, parameter :: faces(segment, 6) = reshape([1, 2, 3, 4, 5, 6, 7, 8, 1, 2, 6, 5, &
         & 2, 3, 7, 6, 3, 4, 8, 7, 4, 1, 5, 8], [segment, 6])
      integer :: f, k

      is_around = .false.
      do f = 1, size(faces, 2)
         associate (face => brick(faces(:, f)))
            do k = 0, segment - 1
               is_around = is_around .or. all(cshift(face, k) == node) &
                  & .or. all(cshift(face(segment:1:-1), k) == node)
            end do
         end associate
      end do
   end function is_around_face

   !> The bricks at each node
   pure subroutine list_bricks(mesh, first, around)
      type(mesh_type), intent(in) :: mesh
      !> Where the bricks of a node begin in the list, one more than there are nodes
      integer, allocatable, intent(out) :: first(:)
      !> The bricks of the first node, those of the second and so on
      integer, allocatable, intent(out) :: around(:)

      integer :: e, k, n

      allocate (first(size(mesh%node_id) + 1), source=0)
      allocate (around(size(mesh%brick_node)))
      do e = 1, size(mesh%brick_id)
         do k = 1, corners
            n = mesh%brick_node(k, e)
            first(n) = first(n) + 1
         end do
      end do
      ! behind the last brick of each node, then backwards to its first
      do n = 2, size(first)
         first(n) = first(n) + first(n - 1)
      end do
      first(:) = first + 1
      do e = size(mesh%brick_id), 1, -1
         do k = 1, corners
            n = mesh%brick_node(k, e)
            first(n) = first(n) - 1
            around(first(n)) = e
         end do
      end do
   end subroutine list_bricks

   !> Make room for bricks
   pure subroutine add_bricks(mesh, more)
      type(mesh_type), intent(inout) :: mesh
      !> How many
      integer, intent(in) :: more

      integer :: n

      n = size(mesh%brick_id) + more
      mesh%brick_id = reshape(mesh%brick_id, [n], pad=[0])
      mesh%brick_part = reshape(mesh%brick_part, [n], pad=[0])
      mesh%brick_node = reshape(mesh%brick_node, [corners, n], pad=[0])
      mesh%brick_angle = reshape(mesh%brick_angle, [n], pad=[0.0_wp])
   end subroutine add_bricks

end module plydyn_input_solid
