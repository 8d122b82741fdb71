!> Keyword of plies whose matrix cracks on planes of fracture.
module plydyn_input_fracture
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_declaration, only : extension
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_material, only : visit_ply
   use plydyn_input_ply, only : check_idle, check_strengths, take_shear_points, visit_band, &
      & visit_band_rule, visit_line_shares, visit_strengths
   use plydyn_law_ply_fracture_constants, only : fracture_constants_type
   use plydyn_law_ply_shear_curve, only : new_hardening_curve, new_power_curve
   use plydyn_model_material, only : add_material, material_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: mat_ply_fracture_3d

   !> Kinds of permanent shear as on the card
   integer, parameter :: points = 2, power = 3, hardening = 4

contains

   !> Ply with cracks on planes of fracture
   subroutine mat_ply_fracture_3d(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(material_type) :: material
      type(fracture_constants_type) :: ply

      call card%keyword(extension, "Ply with matrix cracks on planes of fracture, found by all " &
         & //"six stresses, friction of closed cracks, and permanent shear.")
      call card%remark("1 along the fibres, 2 across in the plane, 3 normal. The matrix cracks " &
         & //"on the plane parallel to the fibres with the largest failure index of tension, " &
         & //"shear and pressure, and softens there over the width of the crack band. Closed " &
         & //"cracks carry pressure and friction. If the band is too wide for the fracture " &
         & //"energy, damage starts below the strength, and the fracture energy is right. DEBRIS " &
         & //"and SHARE are fitted to the dent of a test.")
      call card%example("plies-that-crack-on-planes-of-fracture", "1, 1.58e-9, 171.42e3, 9.08e3," &
         & //" 9.08e3, 0.32, 0.32, 0.45|5.29e3, 5.29e3, 3.131e3|2326.2, 1200.1, 62.3, 199.8, " &
         & //"92.3|97.8, 106.3, 0.277, 0.788|4, 0, 0, 66.9, 0.05|0.3")
      call visit_ply(card, material, ply)
      call visit_strengths(card, ply%fibre_strength, ply%matrix_strength)
      call card%positive("SL", "stress", "shear strength along the fibres", ply%shear_strength)
      call card%positive("ALPHA0", "degrees", "angle of the plane of fracture in compression " &
         & //"across, above 45 and at most 60; with YC it gives the shear strength across", &
         & ply%fracture_angle, default=53.0_wp, above=45.0_wp, most=60.0_wp)
      call card%zero_is_default()
      call card%card()
      call card%positive("G1T", "energy/length2", "fracture energy of fibres in tension", &
         & ply%fibre_toughness(1))
      call card%positive("G1C", "energy/length2", "fracture energy of fibres in compression", &
         & ply%fibre_toughness(2))
      call card%positive("G2T", "energy/length2", "fracture energy of opened matrix cracks", &
         & ply%matrix_toughness(1))
      call card%positive("G2S", "energy/length2", "fracture energy of sheared matrix cracks", &
         & ply%matrix_toughness(2))
      call visit_band(card, ply%band_width, ply%residual)
      call card%positive("BK", "-", "exponent of Benzeggagh and Kenane between G2T and G2S", &
         & ply%mode_exponent, default=1.45_wp)
      call card%zero_is_default()
      call visit_shear(card, model, ply)
      call visit_contact(card, ply)
      call card%card(optional=.true.)
      call visit_line_shares(card, ply%line_strength, ply%line_toughness, ply%plateau)
      if (.not. card%reads) return
      call check_strengths(card, ply)
      call check_idle(card, ["ALPHA", "N    ", "SP   ", "KP   ", "LCID "], &
         & [power, power, hardening, hardening, points])
      material%line = card%line_of("MID")
      call add_material(model%materials, material, ply)
   end subroutine mat_ply_fracture_3d

   !> Permanent shear
   subroutine visit_shear(card, model, ply)
      class(card_visitor_type), intent(inout) :: card
      !> Has the curves
      type(model_type), intent(in) :: model
      type(fracture_constants_type), intent(inout) :: ply

      integer :: curve, kind_number
      real(wp) :: coefficient, exponent, slope, yield

      call card%card(optional=.true.)
      call card%integer("SHEAR", "permanent shear 12, 13 and 23 until the matrix cracks: 0 none; " &
         & //"2 curve LCID; 3 of Ramberg and Osgood, ALPHA stress**N; 4 linear hardening from SP " &
         & //"on. That of 23 is at stresses in the ratio of the shear strengths", kind_number, &
         & default=0, allowed=[0, 2, 3, 4])
      call card%nonnegative("ALPHA", "1/stress**N", "coefficient of Ramberg and Osgood", &
         & coefficient)
      call card%nonnegative("N", "-", "exponent of Ramberg and Osgood, above 1", exponent)
      call card%nonnegative("SP", "stress", "shear stress 12 at first yield, below SL", yield)
      call card%nonnegative("KP", "-", "slope of the yield stress over the permanent strain, as " &
         & //"a share of the shear modulus", slope)
      call card%integer("LCID", "curve of shear stress 12 over total shear strain in monotone " &
         & //"loading from 0, 0, rising by G12 at most; its last line goes on", curve, default=0, &
         & least=0)
      if (.not. card%reads) return
      select case (kind_number)
      case (points)
         if (.not. (card%is_fine("G12") .and. card%is_fine("SL"))) return
         call take_shear_points(card, model%curves, ply%shear(1), ply%shear_strength, ply%curve)
      case (power)
         if (.not. (card%is_fine("ALPHA") .and. card%is_fine("N"))) return
         if (coefficient <= 0.0_wp) then
            call card%refuse("ALPHA", "ALPHA is missing", "ALPHA such that ALPHA SL**N is the " &
               & //"permanent strain at the strength, above 0")
         else if (exponent <= 1.0_wp) then
            call card%refuse("N", "N is "//text(exponent)//", with which the stress of SHEAR " &
               & //"3 would not level off", "an exponent above 1")
         else
            ply%curve = new_power_curve(ply%shear(1)*coefficient, exponent)
         end if
      case (hardening)
         if (.not. (card%is_fine("SP") .and. card%is_fine("KP") .and. card%is_fine("SL"))) return
         if (yield <= 0.0_wp .or. yield >= ply%shear_strength) then
            call card%refuse("SP", "SP = "//text(yield)//", where permanent shear " &
               & //"strain begins, is not between 0 and the shear strength SL = " &
               & //text(ply%shear_strength), "a stress above 0 and below SL")
         else if (slope <= 0.0_wp) then
            call card%refuse("KP", "KP is missing: without hardening the stress would never " &
               & //"reach SL", "a share of the modulus above 0, such as 0.05")
         else if (ply%shear(1) > 0.0_wp) then
            ply%curve = new_hardening_curve(ply%shear(1), yield, slope)
         end if
      case default
         continue
      end select
   end subroutine visit_shear

   !> Cracks that close, crushing, width of the band, debris
   subroutine visit_contact(card, ply)
      class(card_visitor_type), intent(inout) :: card
      type(fracture_constants_type), intent(inout) :: ply

      call card%card(optional=.true.)
      call card%real("FRIC", "-", "coefficient of friction of closed matrix cracks", ply%friction, &
         & default=0.0_wp, least=0.0_wp, most=1.0_wp)
      call card%real("PLATEAU", "-", "share of XC that crushed fibres keep, from 0 to below 1", &
         & ply%plateau, default=0.0_wp, least=0.0_wp, most=0.99_wp)
      call visit_band_rule(card, ply%band_rule)
      call card%nonnegative("PCRUSH", "stress", "pressure through the thickness that crushes the " &
         & //"ply; 0 for none", ply%crush_stress)
      call card%nonnegative("DEBRIS", "-", "largest opening of cracks, as a strain, that debris " &
         & //"holds; 0 for none. Fitted", ply%debris_limit)
      call card%real("SHARE", "-", "share of the largest opening that debris holds, up to " &
         & //"DEBRIS. Fitted", ply%debris_share, default=0.0_wp, least=0.0_wp, most=1.0_wp)
      if (.not. card%reads) return
      if (.not. (card%is_fine("DEBRIS") .and. card%is_fine("SHARE"))) return
      if (ply%debris_limit > 0.0_wp .and. ply%debris_share <= 0.0_wp) then
         call refuse_half("SHARE", "DEBRIS", ply%debris_limit)
      else if (ply%debris_share > 0.0_wp .and. ply%debris_limit <= 0.0_wp) then
         call refuse_half("DEBRIS", "SHARE", ply%debris_share)
      end if

   contains

      !> One of two numbers is given without the other
      subroutine refuse_half(missing, given, value)
         character(*), intent(in) :: missing, given
         real(wp), intent(in) :: value

         call card%refuse(missing, missing//" is missing beside "//given//" = "//text(value), &
            & "both numbers of the debris, or none")
      end subroutine refuse_half

   end subroutine visit_contact

end module plydyn_input_fracture
