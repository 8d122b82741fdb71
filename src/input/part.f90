!> Keywords of laminates: plies and their expansion through the thickness.
module plydyn_input_part
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_declaration, only : extension, standard
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_material, a_part, a_section
   use plydyn_input_keyword_row, only : for_plates, keyword_list_type, stage_laminate, stage_part
   use plydyn_model_layup, only : faces_tied, part_type, ply_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_parts

   !> Order without *SECTION_LAYERWISE
   integer, parameter :: usual_order = 2
   !> Nodes of the larger of the two quads, and quadrature points along an edge of either
   integer, parameter :: nine_nodes = 9, points_of_nine = 3, points_of_four = 2
   !> Heading of the theory on laminates
   character(*), parameter :: of_laminates = "2-layer-wise-kinematics"

contains

   !> Add these keywords
   subroutine add_parts(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("PART_COMPOSITE", part_composite, stage_part, for_plates)
      call list%add("PART_COMPOSITE_LONG", part_composite_long, stage_part, for_plates)
      call list%add("SECTION_LAYERWISE", section_layerwise, stage_laminate, for_plates)
   end subroutine add_parts

   !> A laminate, two plies on a card
   subroutine part_composite(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(part_type) :: part
      type(ply_type) :: lower, upper

      call card%keyword(standard, "A laminate: its plies from the bottom up, two on a card.")
      call card%remark("A ply is numbered by its place in the stack. The angle is added to the " &
         & //"axis angle of the material.")
      call card%example(of_laminates, "plate|1|1, 0.25, 0.0, 0, 1, 0.25, 90.0|" &
         & //"1, 0.25, 90.0, 0, 1, 0.25, 0.0")
      call visit_head(card, part)
      do while (card%next())
         call card%refer(a_material, "MID1", "ply material", lower%material)
         call card%positive("THICK1", "length", "thickness", lower%thickness)
         call card%real("B1", "degrees", "angle of the fibres from x", lower%angle, default=0.0_wp)
         call card%unused("TMID1")
         call card%refer(a_material, "MID2", "ply material; blank or 0 for no second ply", &
            & upper%material, default=0, least=0)
         call card%nonnegative("THICK2", "length", "thickness", upper%thickness)
         call card%real("B2", "degrees", "angle of the fibres from x", upper%angle, default=0.0_wp)
         call card%unused("TMID2")
         if (.not. card%reads) cycle
         call add_ply(card, "THICK1", lower, model, part)
         if (card%whole("MID2") > 0) then
            call add_ply(card, "THICK2", upper, model, part)
         else if (upper%thickness > 0.0_wp) then
            call card%refuse("MID2", "the second ply has no material", &
               & "a ply material, or nothing in the four fields of the ply")
         else if (card%nth < card%sets()) then
            call card%refuse("MID2", "a ply is missing within the stack", &
               & "two plies on each card but the last")
         end if
      end do
      if (card%reads) call end_part(part, model%parts)
   end subroutine part_composite

   !> A laminate, one ply on a card
   subroutine part_composite_long(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      integer :: id
      type(part_type) :: part
      type(ply_type) :: ply

      call card%keyword(standard, "A laminate: its plies from the bottom up, one on a card.")
      call card%remark("The angle is added to the axis angle of the material.")
      call card%example(of_laminates, "plate|1|1, 0.25, 0.0|1, 0.25, 90.0|1, 0.25, 90.0|" &
         & //"1, 0.25, 0.0")
      call visit_head(card, part)
      do while (card%next())
         call card%refer(a_material, "MID", "ply material", ply%material)
         call card%positive("THICK", "length", "thickness", ply%thickness)
         call card%real("B", "degrees", "angle of the fibres from x", ply%angle, default=0.0_wp)
         call card%unused("TMID")
         call card%integer("PLYID", "number of the ply; 0 for its place in the stack", id, &
            & default=0, least=0)
         call card%unused("SHRFAC", neutral=[0.0_wp, 1.0_wp])
         if (.not. card%reads) cycle
         call add_ply(card, "THICK", ply, model, part)
         if (id > 0) part%plies(card%nth)%id = id
         associate (plies => part%plies)
            if (any(plies(:card%nth - 1)%id == plies(card%nth)%id)) call card%refuse("PLYID", &
               & "ply "//text(plies(card%nth)%id)//" is in the part twice", &
               & "a number of its own, or 0 for its place in the stack")
         end associate
      end do
      if (card%reads) call end_part(part, model%parts)
   end subroutine part_composite_long

   !> Title, number and reference surface of a laminate
   subroutine visit_head(card, part)
      class(card_visitor_type), intent(inout) :: card
      type(part_type), intent(inout) :: part

      integer :: form
      real(wp) :: reference, shear_factor

      call card%text_line("TITLE", "title of the part", part%title)
      call card%card()
      call card%define(a_part, "PID", "number of the part", part%id)
      call card%integer("ELFORM", "without effect: all plates are layer-wise, see " &
         & //"*SECTION_LAYERWISE", form, default=0)
      call card%real("SHRF", "-", "without effect: layer-wise plates need no shear factor", &
         & shear_factor, default=1.0_wp)
      call card%real("NLOC", "-", "where the nodes are: -1 bottom face, 0 mid-plane, 1 top face", &
         & reference, default=0.0_wp, least=-1.0_wp, most=1.0_wp)
      call card%unused("MAREA HGID ADPOPT THSHEL")
      if (.not. card%reads) return
      part%bottom_offset = -0.5_wp*(1.0_wp + reference)
      if (form /= 0) call card%note("ELFORM", "ELFORM is without effect", &
         & "all plates are layer-wise, see *SECTION_LAYERWISE")
      allocate (part%plies(0))
   end subroutine visit_head

   !> One ply on top of the others
   subroutine add_ply(card, thickness, read_ply, model, part)
      class(card_visitor_type), intent(inout) :: card
      !> Field of its thickness
      character(*), intent(in) :: thickness
      !> Material, thickness and angle as on the card
      type(ply_type), intent(in) :: read_ply
      !> Has the materials
      type(model_type), intent(in) :: model
      type(part_type), intent(inout) :: part

      type(ply_type) :: ply

      ply = read_ply
      ply%id = size(part%plies) + 1
      ply%order = usual_order
      if (ply%material > 0) ply%angle = ply%angle + model%materials(ply%material)%axis_angle
      if (ply%thickness <= 0.0_wp .and. card%is_fine(thickness)) call card%refuse(thickness, &
         & "the ply has no thickness", "a thickness above 0")
      part%plies = [part%plies, ply]
   end subroutine add_ply

   !> All interfaces tied at first, and the part into the list
   subroutine end_part(part, parts)
      type(part_type), intent(inout) :: part
      !> Parts so far
      type(part_type), allocatable, intent(inout) :: parts(:)

      allocate (part%joint(max(size(part%plies) - 1, 0)))
      part%joint(:) = faces_tied
      parts = [parts, part]
   end subroutine end_part

   !> Expansion through the thickness
   subroutine section_layerwise(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      integer :: id, ids(2), layers, order, part, plane, theory, through(2)
      logical :: lobatto
      logical, allocatable :: taken(:)

      call card%keyword(extension, "Expansion of the displacement through the thickness of a " &
         & //"laminate.")
      call card%remark("Without the keyword: order 2 and one numerical layer per ply.")
      call card%example(of_laminates, "1, 0, 3")
      call card%define(a_section, "PID", "part", id)
      call card%integer("THEORY", "0 layer-wise Lagrange polynomials", theory, default=0, &
         & allowed=[0])
      call card%integer("ORDER", "order of the polynomials in each numerical layer", order, &
         & default=2, least=1, most=4)
      call card%flag("BASIS", "points: 0 equally spaced, 1 Gauss-Lobatto", lobatto)
      plane = points_of_four
      if (card%reads) plane = merge(points_of_nine, points_of_four, &
         & size(model%mesh%quad_node, 1) == nine_nodes)
      call visit_quadrature(card, "NQPLAN", "quadrature points along an edge", plane)
      call visit_quadrature(card, "NQTHK", "quadrature points through a layer", order + 1)
      call card%integer("LUMP", "0 diagonal mass", theory, default=0, allowed=[0])
      part = 0
      if (card%reads) call card%look_up(a_part, "PID", part)
      if (part > 0) then
         model%parts(part)%lobatto = lobatto
         model%parts(part)%plies%order = order
         allocate (taken(size(model%parts(part)%plies)), source=.false.)
      end if
      do while (card%next(optional=.true.))
         call card%integer("PLYID1", "first ply of a range", ids(1), least=1)
         call card%integer("PLYID2", "last ply of the range", ids(2), least=1)
         call card%integer("PLYORDER", "order of the polynomials in these plies", order, least=1, &
            & most=4)
         call card%integer("NSUB", "numerical layers in each of these plies", layers, default=1, &
            & least=1, most=100)
         if (part == 0) cycle
         associate (plies => model%parts(part)%plies)
            through(:) = [find_ply(card, "PLYID1", ids(1), plies), &
               & find_ply(card, "PLYID2", ids(2), plies)]
            if (minval(through) == 0) cycle
            if (through(2) < through(1)) then
               call card%refuse("PLYID2", "PLYID2 lies below PLYID1 in the stack", &
                  & "a range of plies from the bottom up")
            else if (any(taken(through(1):through(2)))) then
               call card%refuse("PLYID1", "some of these plies are in a range already", &
                  & "each ply in one range at most")
            end if
            taken(through(1):through(2)) = .true.
            plies(through(1):through(2))%order = order
            plies(through(1):through(2))%layers = layers
         end associate
      end do
   end subroutine section_layerwise

   !> A number of quadrature points is 0 or that of full quadrature
   subroutine visit_quadrature(card, name, sentence, full)
      class(card_visitor_type), intent(inout) :: card
      !> Name and meaning of the field
      character(*), intent(in) :: name, sentence
      !> The full number
      integer, intent(in) :: full

      integer :: points

      call card%integer(name, sentence//"; 0 for full quadrature", points, default=0, least=0)
      if (.not. card%reads) return
      if (points /= 0 .and. points /= full) call card%refuse(name, name//" = "//text(points) &
         & //" is not supported", "0, or the "//text(full)//" points of full quadrature")
   end subroutine visit_quadrature

   !> Place of a ply in the stack; 0 and a report when there is none of that number
   integer function find_ply(card, name, id, plies) result(place)
      class(card_visitor_type), intent(inout) :: card
      !> Name of the field, and what it holds
      character(*), intent(in) :: name
      integer, intent(in) :: id
      type(ply_type), intent(in) :: plies(:)

      do place = size(plies), 1, -1
         if (plies(place)%id == id) return
      end do
      if (card%has(name)) call card%refuse(name, "the part has no ply "//text(id), &
         & "the number of one of its "//text(size(plies))//" plies")
   end function find_ply

end module plydyn_input_part
