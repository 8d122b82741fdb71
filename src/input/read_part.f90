!> Readers of laminates: plies and their expansion through the thickness.
module plydyn_input_read_part
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : a_material, a_part, a_section, catalogue_type
   use plydyn_model_layup, only : faces_tied, part_type, ply_type
   use plydyn_model_material, only : material_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_part_composite, read_section_layerwise

   !> Order without *SECTION_LAYERWISE
   integer, parameter :: usual_order = 2
   !> Nodes of the larger of the two quads, and quadrature points along an edge of either
   integer, parameter :: nine_nodes = 9, points_of_nine = 3, points_of_four = 2

contains

   !> *PART_COMPOSITE, *PART_COMPOSITE_LONG: a laminate, two plies on a card, or one
   subroutine read_part_composite(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(part_type) :: part
      integer :: nth

      call begin_part(cards, catalogue, part)
      do nth = 1, cards%sets()
         if (cards%name == "PART_COMPOSITE_LONG") then
            call add_ply(cards, nth, ["MID  ", "THICK", "B    "], catalogue, model%materials, part)
            if (cards%integer("PLYID", nth) /= 0) part%plies(nth)%id = cards%integer("PLYID", nth)
            cycle
         end if
         call add_ply(cards, nth, ["MID1  ", "THICK1", "B1    "], catalogue, model%materials, part)
         if (cards%integer("MID2", nth) == 0) then
            call check_no_second(cards, nth, catalogue)
         else
            call add_ply(cards, nth, ["MID2  ", "THICK2", "B2    "], catalogue, &
               & model%materials, part)
         end if
      end do
      if (cards%name == "PART_COMPOSITE_LONG") call check_numbers(cards, part, catalogue)
      call end_part(part, model%parts)
   end subroutine read_part_composite

   !> Each ply has a number of its own
   subroutine check_numbers(cards, part, catalogue)
      type(cards_type), intent(in) :: cards
      type(part_type), intent(in) :: part
      type(catalogue_type), intent(inout) :: catalogue

      integer :: nth

      do nth = 2, size(part%plies)
         if (all(part%plies(:nth - 1)%id /= part%plies(nth)%id)) cycle
         call catalogue%refuse(cards, "PLYID", "ply "//text(part%plies(nth)%id) &
            & //" is in the part twice", "a number of its own, or 0 for its place in the stack", &
            & nth)
      end do
   end subroutine check_numbers

   !> *SECTION_LAYERWISE: expansion through the thickness
   subroutine read_section_layerwise(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      logical, allocatable :: taken(:)
      integer :: first, last, nth, part

      call catalogue%define(a_section, cards, "PID")
      call check_quadrature(cards, catalogue, model%mesh)
      call catalogue%find(a_part, cards, "PID", part)
      if (part == 0) return
      model%parts(part)%lobatto = cards%integer("BASIS") == 1
      model%parts(part)%plies%order = cards%integer("ORDER")
      allocate (taken(size(model%parts(part)%plies)))
      taken(:) = .false.
      do nth = 1, cards%sets()
         call find_ply(cards, "PLYID1", nth, model%parts(part)%plies, catalogue, first)
         call find_ply(cards, "PLYID2", nth, model%parts(part)%plies, catalogue, last)
         if (min(first, last) == 0) cycle
         if (last < first) then
            call catalogue%refuse(cards, "PLYID2", "PLYID2 lies below PLYID1 in the stack", &
               & "a range of plies from the bottom up", nth)
         else if (any(taken(first:last))) then
            call catalogue%refuse(cards, "PLYID1", "some of these plies are in a range already", &
               & "each ply in one range at most", nth)
         end if
         taken(first:last) = .true.
         model%parts(part)%plies(first:last)%order = cards%integer("PLYORDER", nth)
         model%parts(part)%plies(first:last)%layers = cards%integer("NSUB", nth)
      end do
   end subroutine read_section_layerwise

   !> Number, title and reference surface of a part
   subroutine begin_part(cards, catalogue, part)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(part_type), intent(inout) :: part

      call catalogue%define(a_part, cards, "PID")
      part%id = cards%integer("PID")
      part%title = cards%word("TITLE")
      part%bottom_offset = -0.5_wp*(1.0_wp + cards%real("NLOC"))
      if (cards%integer("ELFORM") /= 0) then
         call catalogue%report%note(cards%place("ELFORM"), "ELFORM is without effect", &
            & "all plates are layer-wise, see *SECTION_LAYERWISE")
      end if
      allocate (part%plies(0))
   end subroutine begin_part

   !> One ply on top of the others
   subroutine add_ply(cards, nth, names, catalogue, materials, part)
      type(cards_type), intent(in) :: cards
      !> Which row of plies
      integer, intent(in) :: nth
      !> Fields of material, thickness and angle
      character(*), intent(in) :: names(3)
      type(catalogue_type), intent(inout) :: catalogue
      type(material_type), intent(in) :: materials(:)
      type(part_type), intent(inout) :: part

      type(ply_type) :: ply

      call catalogue%find(a_material, cards, trim(names(1)), ply%material, nth)
      ply%id = size(part%plies) + 1
      ply%thickness = cards%real(names(2), nth)
      ply%angle = cards%real(names(3), nth)
      ply%order = usual_order
      if (ply%material > 0) ply%angle = ply%angle + materials(ply%material)%axis_angle
      if (ply%thickness <= 0.0_wp .and. cards%is_fine(names(2), nth)) then
         call catalogue%refuse(cards, trim(names(2)), "the ply has no thickness", &
            & "a thickness above 0", nth)
      end if
      part%plies = [part%plies, ply]
   end subroutine add_ply

   !> A card with one ply has nothing where the second one would be
   subroutine check_no_second(cards, nth, catalogue)
      type(cards_type), intent(in) :: cards
      !> Which row of plies
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue

      if (cards%real("THICK2", nth) > 0.0_wp) then
         call catalogue%refuse(cards, "MID2", "the second ply has no material", &
            & "a ply material, or nothing in the four fields of the ply", nth)
      else if (nth < cards%sets()) then
         call catalogue%refuse(cards, "MID2", "a ply is missing within the stack", &
            & "two plies on each card but the last", nth)
      end if
   end subroutine check_no_second

   !> All interfaces tied at first, and the part into the list
   subroutine end_part(part, parts)
      type(part_type), intent(inout) :: part
      !> Parts so far
      type(part_type), allocatable, intent(inout) :: parts(:)

      allocate (part%joint(max(size(part%plies) - 1, 0)))
      part%joint(:) = faces_tied
      parts = [parts, part]
   end subroutine end_part

   !> Quadrature is full
   subroutine check_quadrature(cards, catalogue, mesh)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(mesh_type), intent(in) :: mesh

      integer :: plane

      plane = merge(points_of_nine, points_of_four, size(mesh%quad_node, 1) == nine_nodes)
      call check_full(cards, "NQPLAN", plane, catalogue)
      call check_full(cards, "NQTHK", cards%integer("ORDER") + 1, catalogue)
   end subroutine check_quadrature

   !> A field holds 0 or the full number
   subroutine check_full(cards, name, full, catalogue)
      type(cards_type), intent(in) :: cards
      !> Name of the field
      character(*), intent(in) :: name
      !> The full number
      integer, intent(in) :: full
      type(catalogue_type), intent(inout) :: catalogue

      if (cards%integer(name) == 0 .or. cards%integer(name) == full) return
      call catalogue%refuse(cards, name, name//" = "//text(cards%integer(name)) &
         & //" is not supported", "0, or the "//text(full)//" points of full quadrature")
   end subroutine check_full

   !> Place of a ply in the stack; 0 and a report when there is none of that number
   subroutine find_ply(cards, name, nth, plies, catalogue, place)
      type(cards_type), intent(in) :: cards
      !> Name of the field
      character(*), intent(in) :: name
      !> Which row
      integer, intent(in) :: nth
      !> The stack
      type(ply_type), intent(in) :: plies(:)
      type(catalogue_type), intent(inout) :: catalogue
      !> Place from the bottom
      integer, intent(out) :: place

      do place = size(plies), 1, -1
         if (plies(place)%id == cards%integer(name, nth)) return
      end do
      if (.not. cards%has(name, nth)) return
      call catalogue%refuse(cards, name, "the part has no ply "//text(cards%integer(name, nth)), &
         & "the number of one of its "//text(size(plies))//" plies", nth)
   end subroutine find_ply

end module plydyn_input_read_part
