!> Fields that plies with damage share: strengths, width of the crack band, shear by points.
module plydyn_input_ply
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_curve
   use plydyn_law_law, only : law_constants_type
   use plydyn_law_ply_crack_band, only : rule_band, rule_gauss_point, rule_root_point, &
      & rule_root_quad
   use plydyn_law_ply_shear_curve, only : check_law_curve => check_curve, new_table_curve, &
      & shear_curve_type
   use plydyn_model_curve, only : curve_type
   implicit none
   private

   public :: check_curve, check_idle, check_strengths, take_shear_points, visit_band, &
      & visit_band_rule, visit_line_shares, visit_strengths

contains

   !> Card that begins with the strengths along the fibres and across them
   subroutine visit_strengths(card, fibre, matrix)
      class(card_visitor_type), intent(inout) :: card
      !> Strengths in tension and in compression
      real(wp), intent(inout) :: fibre(2), matrix(2)

      call card%card()
      call card%positive("XT", "stress", "strength of fibres in tension", fibre(1))
      call card%positive("XC", "stress", "strength of fibres in compression", fibre(2))
      call card%positive("YT", "stress", "strength of matrix in tension", matrix(1))
      call card%positive("YC", "stress", "strength of matrix in compression", matrix(2))
   end subroutine visit_strengths

   !> Width of the crack band, and what broken points keep of their stiffness
   subroutine visit_band(card, width, residual)
      class(card_visitor_type), intent(inout) :: card
      !> The width, and the share of the stiffness
      real(wp), intent(inout) :: width, residual

      real(wp) :: damage

      call card%nonnegative("LSTAR", "length", "width of the crack band; 0 for LRULE", width)
      call card%positive("DMAX", "-", "largest damage: a share of 1 - DMAX of the stiffness " &
         & //"remains", damage, default=0.999_wp, most=0.999999_wp)
      call card%zero_is_default()
      if (card%reads) residual = 1.0_wp - damage
   end subroutine visit_band

   !> Shares of the two laws by which fibres soften, by the names of CompDam_DGD: both below 1, or
   !> both 1
   subroutine visit_line_shares(card, strength, toughness, plateau)
      class(card_visitor_type), intent(inout) :: card
      !> Shares of strength and of energy, in tension and in compression
      real(wp), intent(inout) :: strength(2), toughness(2)
      !> Share of the strength that crushed fibres keep
      real(wp), intent(in) :: plateau

      character(*), parameter :: senses(2) = [character(11) :: "tension", "compression"]
      character(3), parameter :: strengths(2) = ["FXT", "FXC"]
      character(4), parameter :: energies(2) = ["FGXT", "FGXC"]
      integer :: i

      do i = 1, size(senses)
         call card%positive(strengths(i), "-", "share of the strength of fibres in " &
            & //trim(senses(i))//" in one of two laws of softening; 1 for one line", strength(i), &
            & default=1.0_wp, most=1.0_wp)
         call card%zero_is_default()
         call card%positive(energies(i), "-", "share of their fracture energy in that law", &
            & toughness(i), default=1.0_wp, most=1.0_wp)
         call card%zero_is_default()
         if (.not. card%reads) cycle
         if (.not. (card%is_fine(strengths(i)) .and. card%is_fine(energies(i)))) cycle
         if (strength(i) < 1.0_wp .neqv. toughness(i) < 1.0_wp) call card%refuse(energies(i), &
            & strengths(i)//" = "//text(strength(i))//" and "//energies(i)//" = " &
            & //text(toughness(i))//" leave a law of softening without strength or energy", &
            & "shares below 1 in both, or 1 in both for one line")
      end do
      if (.not. card%reads) return
      if (plateau > 0.0_wp .and. strength(2) < 1.0_wp) call card%refuse("FXC", "crushed fibres " &
         & //"that keep a share of their strength (PLATEAU) soften on one line", &
         & "1 in FXC and FGXC, or PLATEAU 0")
   end subroutine visit_line_shares

   !> Rule for the width of the crack band
   subroutine visit_band_rule(card, rule)
      class(card_visitor_type), intent(inout) :: card
      integer, intent(inout) :: rule

      call card%choice("LRULE", "width of the crack band: 0 share of the length of the quad " &
         & //"along the direction, 13/18 with 9 nodes; 1 length of the Gauss point along it; 2 " &
         & //"root of the area of the Gauss point; 3 root of the area of the quad", rule, &
         & [rule_band, rule_gauss_point, rule_root_point, rule_root_quad])
   end subroutine visit_band_rule

   !> A strain of onset of 1 and more is a strength in other units than its modulus
   subroutine check_strengths(card, ply)
      class(card_visitor_type), intent(inout) :: card
      class(law_constants_type), intent(in) :: ply

      character(2), parameter :: names(5) = ["XT", "XC", "YT", "YC", "SL"]
      character(3), parameter :: moduli(5) = ["E1 ", "E1 ", "E2 ", "E2 ", "G12"]
      real(wp) :: modulus(5)
      integer :: i

      modulus(:) = [ply%young([1, 1, 2, 2]), ply%shear(1)]
      do i = 1, size(names)
         if (.not. (card%has(names(i)) .and. card%has(trim(moduli(i))))) cycle
         associate (strength => card%number(names(i)))
            if (strength >= modulus(i)) call card%refuse(names(i), names(i)//" is " &
               & //text(strength)//": damage would start at a strain of " &
               & //text(strength/modulus(i)), "a strength far below "//trim(moduli(i))//" = " &
               & //text(modulus(i))//", in the same unit")
         end associate
      end do
   end subroutine check_strengths

   !> Constants of another curve of shear mean nothing, nor does a rule beside a width
   subroutine check_idle(card, names, wanted)
      class(card_visitor_type), intent(inout) :: card
      !> Fields of the constants, and the values of SHEAR that they are for
      character(*), intent(in) :: names(:)
      integer, intent(in) :: wanted(:)

      integer :: i

      do i = 1, size(names)
         if (card%whole("SHEAR") == wanted(i)) cycle
         if (card%number(trim(names(i))) > 0.0_wp) call card%warn_idle(trim(names(i)), &
            & "SHEAR "//text(wanted(i)))
      end do
      if (card%number("LSTAR") > 0.0_wp .and. card%whole("LRULE") > 0) call card%warn_idle( &
         & "LRULE", "LSTAR 0")
   end subroutine check_idle

   !> The curve LCID of SHEAR 2; a line where there is none, and it has been refused
   subroutine take_shear_points(card, curves, modulus, strength, shear)
      class(card_visitor_type), intent(inout) :: card
      !> Curves of the deck
      type(curve_type), intent(in) :: curves(:)
      !> G12 and SL
      real(wp), intent(in) :: modulus, strength
      !> Shear stress over shear strain
      type(shear_curve_type), intent(inout) :: shear

      integer :: curve

      curve = 0
      if (.not. card%is_fine("LCID")) return
      if (card%whole("LCID") == 0) then
         call card%refuse("LCID", "LCID is missing", "the curve that SHEAR 2 needs")
      else
         call card%look_up(a_curve, "LCID", curve)
      end if
      if (curve == 0) return
      shear = new_table_curve(curves(curve)%x, curves(curve)%y)
      call check_curve(card, "LCID", shear, [modulus, strength], "stress over strain from 0, 0, " &
         & //"rising with a slope of G12 = "//text(modulus)//" at most")
   end subroutine take_shear_points

   !> What the law has to say about a shear curve
   subroutine check_curve(card, name, shear, limits, right)
      class(card_visitor_type), intent(inout) :: card
      !> Field to blame
      character(*), intent(in) :: name
      !> Its curve
      type(shear_curve_type), intent(in) :: shear
      !> G12 and SL
      real(wp), intent(in) :: limits(2)
      !> What would be right
      character(*), intent(in) :: right

      type(error_type), allocatable :: error

      call check_law_curve(shear, limits(1), limits(2), error)
      if (allocated(error)) call card%refuse(name, error%message, right)
   end subroutine check_curve

end module plydyn_input_ply
