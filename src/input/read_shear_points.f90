!> Reader of the shear of a ply as a curve by points, which several laws have.
module plydyn_input_read_shear_points
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : a_curve, catalogue_type
   use plydyn_law_ply_shear_curve, only : check_curve, new_table_curve, shear_curve_type
   use plydyn_model_curve, only : curve_type
   implicit none
   private

   public :: check_shear, read_shear_points

contains

   !> The curve LCID of SHEAR 2; a line where there is none, and it has been refused
   subroutine read_shear_points(cards, catalogue, curves, modulus, strength, shear)
      !> The material
      type(cards_type), intent(in) :: cards
      !> Gets the findings
      type(catalogue_type), intent(inout) :: catalogue
      !> Curves of the deck
      type(curve_type), intent(in) :: curves(:)
      !> G12 and SL
      real(wp), intent(in) :: modulus, strength
      !> Shear stress over shear strain
      type(shear_curve_type), intent(inout) :: shear

      integer :: curve

      curve = 0
      if (.not. cards%is_fine("LCID")) return
      if (cards%integer("LCID") == 0) then
         call catalogue%refuse(cards, "LCID", "LCID is missing", "the curve that SHEAR 2 needs")
      else
         call catalogue%find(a_curve, cards, "LCID", curve)
      end if
      if (curve == 0) return
      shear = new_table_curve(curves(curve)%x, curves(curve)%y)
      call check_shear(cards, "LCID", shear, [modulus, strength], "stress over strain from 0, 0, " &
         & //"rising with a slope of G12 = "//text(modulus)//" at most", catalogue)
   end subroutine read_shear_points

   !> What the law has to say about a shear curve
   subroutine check_shear(cards, name, shear, limits, right, catalogue)
      !> The material
      type(cards_type), intent(in) :: cards
      !> Field to blame
      character(*), intent(in) :: name
      !> Its curve
      type(shear_curve_type), intent(in) :: shear
      !> G12 and SL
      real(wp), intent(in) :: limits(2)
      !> What would be right
      character(*), intent(in) :: right
      !> Gets the finding
      type(catalogue_type), intent(inout) :: catalogue

      type(error_type), allocatable :: error

      call check_curve(shear, limits(1), limits(2), error)
      if (.not. allocated(error)) return
      call catalogue%refuse(cards, trim(name), error%message, right)
   end subroutine check_shear

end module plydyn_input_read_shear_points
