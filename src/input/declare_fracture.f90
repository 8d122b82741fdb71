!> Keyword of the ply whose matrix cracks on planes of fracture.
module plydyn_input_declare_fracture
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : extension, keyword_type, new_keyword
   use plydyn_input_declare_damage, only : add_band_and_residual, add_band_rule, &
      & add_fibre_toughnesses, add_normal_strengths
   use plydyn_input_declare_part, only : add_ply_elastic_cards
   implicit none
   private

   public :: mat_ply_fracture_3d

contains

   !> Ply with cracks on planes of fracture
   function mat_ply_fracture_3d() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("MAT_PLY_FRACTURE_3D", extension, "Ply with matrix cracks on planes " &
         & //"of fracture, found by all six stresses, friction of closed cracks, and permanent " &
         & //"shear.", suffixes="TITLE")
      keyword%remark = "1 along the fibres, 2 across in the plane, 3 normal. The matrix cracks " &
         & //"on the plane parallel to the fibres with the largest failure index of tension, " &
         & //"shear and pressure, and softens there over the width of the crack band. Closed " &
         & //"cracks carry pressure and friction. If the band is too wide for the fracture " &
         & //"energy, damage starts below the strength, and the fracture energy is right. DEBRIS " &
         & //"and SHARE are fitted to the dent of a test."
      call add_ply_elastic_cards(keyword)
      call add_strength_cards(keyword)
      call add_shear_card(keyword)
      call add_contact_card(keyword)
   end function mat_ply_fracture_3d

   !> Strengths, toughnesses, width of the crack band, largest damage
   subroutine add_strength_cards(keyword)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword

      call add_normal_strengths(keyword)
      call keyword%add_real("SL", "stress", "shear strength along the fibres", above=0.0_wp)
      call keyword%add_real("ALPHA0", "degrees", "angle of the plane of fracture in compression " &
         & //"across, above 45 and at most 60; with YC it gives the shear strength across", &
         & default=53.0_wp, above=45.0_wp, most=60.0_wp)
      call keyword%zero_is_default()
      call add_fibre_toughnesses(keyword)
      call keyword%add_real("G2T", "energy/length2", "fracture energy of opened matrix cracks", &
         & above=0.0_wp)
      call keyword%add_real("G2S", "energy/length2", "fracture energy of sheared matrix cracks", &
         & above=0.0_wp)
      call add_band_and_residual(keyword)
      call keyword%add_real("BK", "-", "exponent of Benzeggagh and Kenane between G2T and G2S", &
         & default=1.45_wp, above=0.0_wp)
      call keyword%zero_is_default()
   end subroutine add_strength_cards

   !> Permanent shear
   subroutine add_shear_card(keyword)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_card(optional=.true.)
      call keyword%add_integer("SHEAR", "permanent shear 12, 13 and 23 until the matrix cracks: " &
         & //"0 none; 2 curve LCID; 3 of Ramberg and Osgood, ALPHA stress**N; 4 linear " &
         & //"hardening from SP on. That of 23 is at stresses in the ratio of the shear " &
         & //"strengths", default=0, allowed=[0, 2, 3, 4])
      call keyword%add_nonnegative("ALPHA", "1/stress**N", "coefficient of Ramberg and Osgood")
      call keyword%add_nonnegative("N", "-", "exponent of Ramberg and Osgood, above 1")
      call keyword%add_nonnegative("SP", "stress", "shear stress 12 at first yield, below SL")
      call keyword%add_nonnegative("KP", "-", "slope of the yield stress over the permanent " &
         & //"strain, as a share of the shear modulus")
      call keyword%add_integer("LCID", "curve of shear stress 12 over total shear strain in " &
         & //"monotone loading from 0, 0, rising by G12 at most; its last line goes on", &
         & default=0, least=0)
   end subroutine add_shear_card

   !> Cracks that close, crushing, width of the band
   subroutine add_contact_card(keyword)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_card(optional=.true.)
      call keyword%add_real("FRIC", "-", "coefficient of friction of closed matrix cracks", &
         & default=0.0_wp, least=0.0_wp, most=1.0_wp)
      call keyword%add_real("PLATEAU", "-", "share of XC that crushed fibres keep, from 0 to " &
         & //"below 1", default=0.0_wp, least=0.0_wp, most=0.99_wp)
      call add_band_rule(keyword)
      call keyword%add_nonnegative("PCRUSH", "stress", "pressure through the thickness that " &
         & //"crushes the ply; 0 for none")
      call keyword%add_nonnegative("DEBRIS", "-", "largest opening of cracks, as a strain, that " &
         & //"debris holds; 0 for none. Fitted")
      call keyword%add_real("SHARE", "-", "share of the largest opening that debris holds, up to " &
         & //"DEBRIS. Fitted", default=0.0_wp, least=0.0_wp, most=1.0_wp)
   end subroutine add_contact_card

end module plydyn_input_declare_fracture
