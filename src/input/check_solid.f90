!> Checks of a mesh of bricks.
module plydyn_input_check_solid
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_report, only : deck_location_type, report_type
   use plydyn_input_catalogue, only : a_brick, a_node, catalogue_type
   use plydyn_model_material, only : material_type
   use plydyn_model_mesh, only : mesh_type
   implicit none
   private

   public :: check_bricks, refuse_averages, refuse_kind

contains

   !> Refuse a keyword of plates in a deck with bricks, or one of bricks in a deck without them
   subroutine refuse_kind(name, place, has_bricks, report)
      !> Name of the keyword
      character(*), intent(in) :: name
      !> Where it is
      type(deck_location_type), intent(in) :: place
      !> Whether the deck has bricks
      logical, intent(in) :: has_bricks
      !> Gets the finding
      type(report_type), intent(inout) :: report

      if (has_bricks) then
         call report%refuse(place, "*"//name//" does not go with bricks", "plates alone, or " &
            & //"bricks alone and no keyword that needs plies, faces or quads")
      else
         call report%refuse(place, "*"//name//" needs bricks", "bricks (*ELEMENT_SOLID), or a " &
            & //"laminate with its plies in *PART_COMPOSITE, and *SECTION_LAYERWISE")
      end if
   end subroutine refuse_kind

   !> Refuse averages over neighbours: bricks belong to no layer
   subroutine refuse_averages(materials, catalogue)
      !> Materials of bricks
      type(material_type), intent(in) :: materials(:)
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      type(deck_location_type) :: place
      integer :: i

      do i = 1, size(materials)
         if (.not. materials(i)%law%averages()) cycle
         place%line = materials(i)%radius_line
         call catalogue%report%refuse(place, "R1 of material "//text(materials(i)%id)//": an " &
            & //"average over neighbours does not go with bricks", "plies of plates, or no radii")
      end do
   end subroutine refuse_averages

   !> Every node belongs to a brick, and no brick is turned inside out
   subroutine check_bricks(mesh, catalogue)
      type(mesh_type), intent(in) :: mesh
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      logical :: met(size(mesh%node_id))
      type(deck_location_type) :: place
      integer :: i

      met(:) = .false.
      do i = 1, size(mesh%brick_id)
         met(mesh%brick_node(:, i)) = .true.
         if (is_right(mesh%position(:, mesh%brick_node(:, i)))) cycle
         place%line = catalogue%registers(a_brick)%line(i)
         call catalogue%report%refuse(place, "brick "//text(mesh%brick_id(i)) &
            & //" is folded at a corner, or inside out", "four nodes counter-clockwise seen from " &
            & //"the opposite face, then the four of that face in the same order")
      end do
      do i = 1, size(met)
         if (met(i)) cycle
         place%line = catalogue%registers(a_node)%line(i)
         call catalogue%report%refuse(place, "node "//text(mesh%node_id(i)) &
            & //" belongs to no element", "only nodes of elements in the deck")
      end do
   end subroutine check_bricks

   !> Whether the three edges at every corner of a brick make a volume
   pure logical function is_right(x)
      !> Positions of the nodes, (3, 8)
      real(wp), intent(in) :: x(:, :)

      !> Neighbours of the corners, in the order that makes a volume positive
      integer, parameter :: next(3, 8) = reshape([2, 4, 5, 3, 1, 6, 4, 2, 7, 1, 3, 8, 8, 6, 1, &
         & 5, 7, 2, 6, 8, 3, 7, 5, 4], [3, 8])
      real(wp) :: e(3, 3)
      integer :: k

      is_right = .true.
      do k = 1, 8
         e(:, :) = x(:, next(:, k)) - spread(x(:, k), 2, 3)
         is_right = is_right .and. e(1, 1)*(e(2, 2)*e(3, 3) - e(3, 2)*e(2, 3)) &
            & - e(2, 1)*(e(1, 2)*e(3, 3) - e(3, 2)*e(1, 3)) &
            & + e(3, 1)*(e(1, 2)*e(2, 3) - e(2, 2)*e(1, 3)) > 0.0_wp
      end do
   end function is_right

end module plydyn_input_check_solid
