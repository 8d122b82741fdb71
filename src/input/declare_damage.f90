!> Keywords of plies that are damaged.
module plydyn_input_declare_damage
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : extension, keyword_type, new_keyword, standard
   use plydyn_input_declare_part, only : add_ply_elastic_cards
   implicit none
   private

   public :: mat_codam2, mat_ply_codam2, mat_ply_fracture_3d, ply_scatter

   !> Shear strain at which an exponential curve reaches the strength, unless a card says more
   real(wp), parameter, public :: usual_shear_strain = 0.05_wp

contains

   !> Ply whose fibres and matrix are damaged
   function mat_ply_codam2() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("MAT_PLY_CODAM2", extension, &
         & "Ply with damage of fibres and of matrix " &
         & //"after nonlinear shear: CODAM2 at the level of the ply.", suffixes="TITLE")
      keyword%remark = "1 along the fibres, 2 across in the plane, 3 normal. Damage starts at " &
         & //"a strength. The stress then falls linearly with strain, until the fracture energy " &
         & //"is dissipated over the width of the crack band, which depends on the size of the " &
         & //"quad. The listing prints these strains and widths. Empty fields have the " &
         & //"defaults of recipes. In GZ a zero is a value of its own, not the default."
      call add_ply_elastic_cards(keyword)
      call add_strength_cards(keyword)
      call add_shear_card(keyword)
      call add_switch_card(keyword)
   end function mat_ply_codam2

   !> Strengths, toughnesses, width of the crack band, largest damage
   subroutine add_strength_cards(keyword)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword

      call add_normal_strengths(keyword)
      call keyword%add_real("SL", "stress", "shear strength in the plane 1-2", above=0.0_wp)
      call keyword%add_nonnegative("ST", "stress", "shear strength in the plane 2-3; needed for " &
         & //"MCOMP 1")
      call add_fibre_toughnesses(keyword)
      call keyword%add_real("G2T", "energy/length2", "fracture energy of matrix in tension", &
         & above=0.0_wp)
      call keyword%add_real("G2C", "energy/length2", "fracture energy of matrix in compression", &
         & above=0.0_wp)
      call add_band_and_residual(keyword)
      call keyword%add_nonnegative("G2S", "energy/length2", "fracture energy of matrix in " &
         & //"shear; 0 for G2T or G2C by the sign of the stress across")
   end subroutine add_strength_cards

   !> Card that begins with the strengths along the fibres and across them
   subroutine add_normal_strengths(keyword)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_card()
      call keyword%add_real("XT", "stress", "strength of fibres in tension", above=0.0_wp)
      call keyword%add_real("XC", "stress", "strength of fibres in compression", above=0.0_wp)
      call keyword%add_real("YT", "stress", "strength of matrix in tension", above=0.0_wp)
      call keyword%add_real("YC", "stress", "strength of matrix in compression", above=0.0_wp)
   end subroutine add_normal_strengths

   !> Card that begins with the toughnesses of fibres
   subroutine add_fibre_toughnesses(keyword)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_card()
      call keyword%add_real("G1T", "energy/length2", "fracture energy of fibres in tension", &
         & above=0.0_wp)
      call keyword%add_real("G1C", "energy/length2", "fracture energy of fibres in compression", &
         & above=0.0_wp)
   end subroutine add_fibre_toughnesses

   !> Width of the crack band, and what broken points keep of their stiffness
   subroutine add_band_and_residual(keyword)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_nonnegative("LSTAR", "length", "width of the crack band; 0 for LRULE")
      call keyword%add_real("DMAX", "-", "largest damage: a share of 1 - DMAX of the stiffness " &
         & //"remains", default=0.999_wp, above=0.0_wp, most=0.999999_wp)
      call keyword%zero_is_default()
   end subroutine add_band_and_residual

   !> Rule for the width of the crack band
   subroutine add_band_rule(keyword)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_integer("LRULE", "width of the crack band: 0 share of the length of the " &
         & //"quad along the direction, 13/18 with 9 nodes; 1 length of the Gauss point along " &
         & //"it; 2 root of the area of the Gauss point; 3 root of the area of the quad", &
         & default=0, allowed=[0, 1, 2, 3])
   end subroutine add_band_rule

   !> Curve of shear
   subroutine add_shear_card(keyword)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_card(optional=.true.)
      call keyword%add_integer("SHEAR", "shear in the plane 1-2 until the matrix cracks: " &
         & //"0 linear; 1 exponential that reaches SL at GAMU; 2 curve LCID; 3 of Ramberg and " &
         & //"Osgood, strain = stress/G12 + ALPHA stress**N", default=0, allowed=[0, 1, 2, 3])
      call keyword%add_integer("LCID", "curve of shear stress over shear strain from 0, 0; its " &
         & //"last line goes on", default=0, least=0)
      call keyword%add_real("GAMU", "-", "shear strain at which SL is reached, above SL/G12", &
         & default=usual_shear_strain, above=0.0_wp)
      call keyword%zero_is_default()
      call keyword%add_nonnegative("ALPHA", "1/stress**N", "coefficient of Ramberg and Osgood")
      call keyword%add_nonnegative("N", "-", "exponent of Ramberg and Osgood, above 1")
   end subroutine add_shear_card

   !> Choices within the law
   subroutine add_switch_card(keyword)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_card(optional=.true.)
      call add_band_rule(keyword)
      call keyword%add_integer("SNAP", "if the crack band is too wide for the fracture energy: " &
         & //"0 damage starts below the strength, and the fracture energy is right; 1 error; 2 " &
         & //"the stress drops at once from the strength", default=0, allowed=[0, 1, 2])
      call keyword%add_real("RSNAP", "-", "smallest ratio of the strains at complete damage " &
         & //"and at onset of damage, for SNAP 0 and 1", default=1.05_wp, least=1.0_wp)
      call keyword%zero_is_default()
      call keyword%add_integer("MCOMP", "onset of matrix damage in compression: 0 quadratic in " &
         & //"stress and shear; 1 of Hashin (1980)", default=0, allowed=[0, 1])
      call keyword%add_integer("TRIAL", "stresses of onset: 0 on what remains in the other " &
         & //"direction; 1 of an intact ply, with CLOSE 1 only where it has the sign of the " &
         & //"other", default=0, allowed=[0, 1])
      call keyword%add_integer("CLOSE", "cracks: 0 never close; 1 close in compression, which " &
         & //"has damage of its own", default=0, allowed=[0, 1])
      call keyword%add_real("PLATEAU", "-", "share of XC that crushed fibres keep, from 0 to " &
         & //"below 1", default=0.0_wp, least=0.0_wp, most=0.99_wp)
      call keyword%add_integer("GZ", "shear across the thickness: 0 weakened by damage, with " &
         & //"which layers below an impactor may fold; 1 not weakened", default=1, allowed=[0, 1])
      call keyword%add_card(optional=.true.)
      call keyword%add_real("BRITTLE", "-", "share of XC from which the stress of crushed fibres " &
         & //"drops to nothing, from 0 (never) to below 1; 0 with PLATEAU", default=0.0_wp, &
         & least=0.0_wp, most=0.99_wp)
      call keyword%add_nonnegative("R1", "length", "radius, along the fibres, of the ellipse " &
         & //"over which the strains that drive damage are averaged; 0 for no average")
      call keyword%add_nonnegative("R2", "length", "radius of it across the fibres; needed with R1")
   end subroutine add_switch_card

   !> Scatter of the strengths of a ply material
   function ply_scatter() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("PLY_SCATTER", extension, &
         & "Random scatter of the strengths of a ply material.", repeated=.true.)
      keyword%remark = "The strengths of the matrix YT, YC, SL and ST are multiplied by one " &
         & //"Weibull-distributed factor of mean 1, those of the fibres XT and XC by another. " &
         & //"The fracture energies do not change. The shear curve (SHEAR) is stretched by the " &
         & //"factor of the matrix in stress and in strain. The correlation of two points " &
         & //"at the distance LENGTH is some 0.6; fibres and matrix, different plies and " &
         & //"interfaces are not correlated. The factors depend only on the position, the " &
         & //"ply and SEED, not on the mesh or the number of ranks. The coefficient of " &
         & //"variation is some 1.2/M. In bands too wide for the fracture energy (SNAP 0) " &
         & //"damage starts below the strength, and only weaker points scatter."
      call keyword%add_integer("MID", "material of *MAT_PLY_CODAM2", least=1)
      call keyword%add_integer("SEED", "number of the realisation", least=0)
      call keyword%add_real("M", "-", "modulus of Weibull of the strengths of the matrix, 2 or " &
         & //"more; 0 for no scatter", least=0.0_wp)
      call keyword%add_real("LENGTH", "length", "length of the correlation", above=0.0_wp)
      call keyword%add_nonnegative("MF", "-", "modulus of Weibull of the strengths of the " &
         & //"fibres, 2 or more; 0 for no scatter")
   end function ply_scatter

   !> Ply whose damage begins and ends at strains of the deck
   function mat_codam2() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("MAT_CODAM2", standard, "Ply whose damage begins and is complete at " &
         & //"strains that the deck gives.", suffixes="TITLE", alias="MAT_219")
      keyword%remark = "One ply, transversely isotropic about its fibres (a): EC = EB, PRCA = " &
         & //"PRBA, GCA = GAB, GBC = EB/(2 (1 + PRCB)). Each ply of *PART_COMPOSITE has its own " &
         & //"damage, so the sub-laminate has one layer. Without the nonlocal average (R1) a " &
         & //"crack dissipates more energy in larger quads; with it, about as much as a band of " &
         & //"the width 1.4 R1. The listing prints this energy. *MAT_PLY_CODAM2 takes fracture " &
         & //"energies instead. No element is deleted."
      call add_layer_cards(keyword)
      call add_axis_cards(keyword)
      call add_strain_card(keyword, "T", "tension")
      call add_strain_card(keyword, "C", "compression")
      call keyword%add_card(optional=.true.)
      call keyword%add_unused("ERODE")
      call keyword%add_real("ERPAR1", "-", "without effect, for ERODE is 0", default=0.0_wp)
      call keyword%add_real("ERPAR2", "-", "without effect, for ERODE is 0", default=0.0_wp)
      call keyword%add_unused("RESIDS")
   end function mat_codam2

   !> Density, elastic constants, layers of the sub-laminate
   subroutine add_layer_cards(keyword)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_integer("MID", "number of the material", least=1)
      call keyword%add_real("RO", "mass/length3", "density", above=0.0_wp)
      call keyword%add_real("EA", "stress", "Young's modulus along the fibres", above=0.0_wp)
      call keyword%add_real("EB", "stress", "Young's modulus across the fibres", above=0.0_wp)
      call keyword%add_unused("UNUSED1")
      call keyword%add_real("PRBA", "-", "strain along the fibres from stress across")
      call keyword%add_unused("UNUSED2")
      call keyword%add_real("PRCB", "-", "strain across the fibres from stress across, the other " &
         & //"way")
      call keyword%add_card()
      call keyword%add_real("GAB", "stress", "shear modulus along the fibres", above=0.0_wp)
      call keyword%add_unused("UNUSED3 UNUSED4")
      call keyword%add_integer("NLAYER", "layers of the sub-laminate: 1", least=1)
      call keyword%add_nonnegative("R1", "length", "radius of the circle over which the strains " &
         & //"in the plane are averaged before they drive damage; 0 for no average")
      call keyword%add_unused("R2 NFREQ")
   end subroutine add_layer_cards

   !> Axes of the material, and the angle of its layer
   subroutine add_axis_cards(keyword)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_card()
      call keyword%add_unused("XP YP ZP")
      call keyword%add_real("A1", "-", "x of a")
      call keyword%add_real("A2", "-", "y of a")
      call keyword%add_real("A3", "-", "z of a, zero", default=0.0_wp, least=0.0_wp, most=0.0_wp)
      call keyword%add_real("AOPT", "-", "2: a and d are given", least=2.0_wp, most=2.0_wp)
      call keyword%add_card()
      call keyword%add_unused("V1 V2 V3")
      call keyword%add_real("D1", "-", "x of d")
      call keyword%add_real("D2", "-", "y of d")
      call keyword%add_real("D3", "-", "z of d, zero", default=0.0_wp, least=0.0_wp, most=0.0_wp)
      call keyword%add_unused("BETA")
      call keyword%add_unused("MACF", neutral=[0.0_wp, 1.0_wp])
      call keyword%add_card()
      call keyword%add_real("ANGLE1", "degrees", "angle of the fibres from a, added to that of " &
         & //"the ply", default=0.0_wp)
      call keyword%add_unused("ANGLE2 ANGLE3 ANGLE4 ANGLE5 ANGLE6 ANGLE7 ANGLE8")
   end subroutine add_axis_cards

   !> Strains at which damage begins and is complete
   subroutine add_strain_card(keyword, letter, sense)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword
      !> T or C
      character(1), intent(in) :: letter
      !> Tension or compression
      character(*), intent(in) :: sense

      character(*), parameter :: pictures = "without effect, as in LS-DYNA, which shows it"

      call keyword%add_card()
      call keyword%add_real("IMAT"//letter, "-", "strain at onset of matrix damage in "//sense, &
         & above=0.0_wp)
      call keyword%add_real("IFIB"//letter, "-", "strain at onset of fibre damage in "//sense, &
         & above=0.0_wp)
      call keyword%add_real("ILOC"//letter, "-", "principal strain in "//sense//" from which on " &
         & //"the rest of the ply gives way; in LS-DYNA's advice SFIB"//letter, above=0.0_wp)
      call keyword%add_real("IDEL"//letter, "-", pictures, default=0.0_wp)
      call keyword%add_real("SMAT"//letter, "-", "strain at which matrix damage is complete", &
         & above=0.0_wp)
      call keyword%add_real("SFIB"//letter, "-", "strain at which fibre damage is complete", &
         & above=0.0_wp)
      call keyword%add_real("SLOC"//letter, "-", "principal strain at which nothing of the ply " &
         & //"is left in its plane", above=0.0_wp)
      call keyword%add_real("SDEL"//letter, "-", pictures, default=0.0_wp)
   end subroutine add_strain_card

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
      call add_fracture_cards(keyword)
      call add_permanent_card(keyword)
      call add_contact_card(keyword)
   end function mat_ply_fracture_3d

   !> Strengths, toughnesses, width of the crack band, largest damage
   subroutine add_fracture_cards(keyword)
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
   end subroutine add_fracture_cards

   !> Permanent shear
   subroutine add_permanent_card(keyword)
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
   end subroutine add_permanent_card

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

end module plydyn_input_declare_damage
