!> Readers of bricks.
module plydyn_input_read_solid
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : a_brick, a_curve, a_material, a_node, a_part, &
      & a_solid_section, an_hourglass, catalogue_type
   use plydyn_model_layup, only : brick_section_type, part_type, ply_type
   use plydyn_model_load, only : segment_load_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_control_hourglass, read_element_solid, read_hourglass, read_load_segment, &
      & read_part_of_bricks, read_section_solid

   !> Nodes of a brick and of a segment, and their names
   integer, parameter :: corners = 8, segment = 4
   character(2), parameter :: names(corners) = ["N1", "N2", "N3", "N4", "N5", "N6", "N7", "N8"]
   !> ELFORM of bricks of one point
   integer, parameter :: one_point = 1
   !> Least ELFORM of cohesive bricks
   integer, parameter :: cohesive = 19

contains

   !> *SECTION_SOLID: integration
   subroutine read_section_solid(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(brick_section_type) :: section

      call catalogue%define(a_solid_section, cards, "SECID")
      section%points = merge(1, corners, cards%integer("ELFORM") == one_point)
      if (cards%integer("ELFORM") >= cohesive) then
         catalogue%has_other_solids = .true.
         call catalogue%refuse(cards, "ELFORM", "there are no cohesive bricks", "plies of one " &
            & //"*PART_COMPOSITE with *INTERFACE_COHESIVE between them and the material there; " &
            & //"plydyn-pre translate makes them of stacked shells")
      end if
      catalogue%solid_sections = [catalogue%solid_sections, section]
   end subroutine read_section_solid

   !> *HOURGLASS: hourglass control of some parts
   subroutine read_hourglass(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(brick_section_type) :: control

      call catalogue%define(an_hourglass, cards, "HGID")
      control%control = cards%integer("IHQ")
      control%coefficient = cards%real("QM")
      catalogue%hourglasses = [catalogue%hourglasses, control]
   end subroutine read_hourglass

   !> *CONTROL_HOURGLASS: hourglass control of all other parts
   subroutine read_control_hourglass(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      catalogue%usual_hourglass%control = cards%integer("IHQ")
      catalogue%usual_hourglass%coefficient = cards%real("QH")
   end subroutine read_control_hourglass

   !> *PART: bricks of one material
   subroutine read_part_of_bricks(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(part_type) :: part
      integer :: control, section

      call catalogue%define(a_part, cards, "PID")
      part%id = cards%integer("PID")
      part%title = cards%word("TITLE")
      allocate (part%plies(1), part%joint(0))
      part%plies(1) = ply_type(id=1, order=0)
      call catalogue%find(a_material, cards, "MID", part%plies(1)%material)
      if (part%plies(1)%material > 0) then
         part%plies(1)%angle = model%materials(part%plies(1)%material)%axis_angle
      end if
      part%brick = catalogue%usual_hourglass
      if (cards%integer("HGID") > 0) then
         call catalogue%find(an_hourglass, cards, "HGID", control)
         if (control > 0) part%brick = catalogue%hourglasses(control)
      end if
      call catalogue%find(a_solid_section, cards, "SECID", section)
      part%brick%points = corners
      if (section > 0) part%brick%points = catalogue%solid_sections(section)%points
      model%parts = [model%parts, part]
   end subroutine read_part_of_bricks

   !> *ELEMENT_SOLID, *ELEMENT_SOLID_ORTHO: bricks, and the directions of their fibres
   subroutine read_element_solid(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      integer :: k, n, nth

      n = size(model%mesh%brick_id)
      call add_bricks(model%mesh, cards%sets())
      do nth = 1, cards%sets()
         call catalogue%define(a_brick, cards, "EID", nth)
         call catalogue%find(a_part, cards, "PID", model%mesh%brick_part(n + nth), nth)
         model%mesh%brick_id(n + nth) = cards%integer("EID", nth)
         associate (angle => model%mesh%brick_angle(n + nth), &
            & part => model%mesh%brick_part(n + nth))
            if (cards%name == "ELEMENT_SOLID_ORTHO") then
               angle = read_axes(cards, catalogue, nth)
            else if (part > 0) then
               angle = model%parts(part)%plies(1)%angle
            end if
         end associate
         associate (node => model%mesh%brick_node(:, n + nth))
            do k = 1, corners
               call catalogue%find(a_node, cards, names(k), node(k), nth)
               if (node(k) == 0 .or. all(node(:k - 1) /= node(k))) cycle
               call catalogue%refuse(cards, names(k), "node " &
                  & //text(cards%integer(names(k), nth))//" is in the brick twice", &
                  & "eight different nodes; there are no wedges and tetrahedra", nth)
            end do
            if (any(node == 0)) catalogue%mesh_is_sound = .false.
         end associate
      end do
   end subroutine read_element_solid

   !> Direction of the fibres of a brick, degrees from the x axis: along A, with D to its left
   real(wp) function read_axes(cards, catalogue, nth) result(angle)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      integer, intent(in) :: nth

      real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp, flat = 1.0e-6_wp
      real(wp) :: a(3), d(3)
      integer :: k

      do k = 1, 3
         a(k) = cards%real("A"//text(k), nth)
         d(k) = cards%real("D"//text(k), nth)
      end do
      angle = 0.0_wp
      if (abs(a(3)) > flat*norm2(a) .or. abs(d(3)) > flat*norm2(d)) then
         call catalogue%refuse(cards, "A3", "the axes do not lie in the x-y plane", &
            & "A along the fibres and D across them, both with 0 along z", nth)
      else if (a(1)*d(2) - a(2)*d(1) <= flat*norm2(a)*norm2(d)) then
         call catalogue%refuse(cards, "D1", "D does not lie to the left of A, seen from above", &
            & "A along the fibres, such as 1, 0, 0, and D across them, such as 0, 1, 0", nth)
      else
         angle = atan2(a(2), a(1))/degree
      end if
   end function read_axes

   !> *LOAD_SEGMENT: pressure on faces of bricks
   subroutine read_load_segment(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(segment_load_type) :: new(cards%sets())
      integer :: k, nth

      do nth = 1, cards%sets()
         call catalogue%find(a_curve, cards, "LCID", new(nth)%curve, nth)
         new(nth)%scale = cards%real("SF", nth)
         do k = 1, segment
            call catalogue%find(a_node, cards, names(k), new(nth)%node(k), nth)
         end do
      end do
      if (catalogue%mesh_is_sound) call check_segments(cards, model%mesh, new, catalogue)
      model%segment_loads = [model%segment_loads, new]
   end subroutine read_load_segment

   !> The nodes of a segment go around a face of a brick
   subroutine check_segments(cards, mesh, loads, catalogue)
      type(cards_type), intent(in) :: cards
      type(mesh_type), intent(in) :: mesh
      !> The segments of the keyword
      type(segment_load_type), intent(in) :: loads(:)
      type(catalogue_type), intent(inout) :: catalogue

      integer, allocatable :: around(:), first(:)
      logical :: is_right
      integer :: i, nth

      call list_bricks(mesh, first, around)
      do nth = 1, size(loads)
         associate (node => loads(nth)%node)
            if (any(node == 0)) cycle
            is_right = .false.
            do i = first(node(1)), first(node(1) + 1) - 1
               is_right = is_right .or. is_around_face(mesh%brick_node(:, around(i)), node)
            end do
         end associate
         if (is_right) cycle
         call catalogue%refuse(cards, names(1), "the four nodes are no face of a brick", &
            & "the nodes of one face of a brick, in their order around it", nth)
      end do
   end subroutine check_segments

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

      integer, allocatable :: id(:), node(:, :), part(:)
      real(wp), allocatable :: angle(:)
      integer :: n

      n = size(mesh%brick_id)
      allocate (id(n + more), part(n + more), node(corners, n + more), angle(n + more))
      id(:n) = mesh%brick_id
      part(:n) = mesh%brick_part
      node(:, :n) = mesh%brick_node
      node(:, n + 1:) = 0
      angle(:n) = mesh%brick_angle
      angle(n + 1:) = 0.0_wp
      call move_alloc(id, mesh%brick_id)
      call move_alloc(part, mesh%brick_part)
      call move_alloc(node, mesh%brick_node)
      call move_alloc(angle, mesh%brick_angle)
   end subroutine add_bricks

end module plydyn_input_read_solid
