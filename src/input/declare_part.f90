!> Keywords of laminates and materials.
module plydyn_input_declare_part
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : keyword_type, new_keyword, extension, standard
   implicit none
   private

   public :: add_isotropic_card, add_ply_elastic_cards, part_composite, part_composite_long, &
      & section_layerwise, mat_elastic, mat_orthotropic_elastic, mat_ply_elastic

contains

   !> A laminate, two plies on a card
   function part_composite() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("PART_COMPOSITE", standard, &
         & "A laminate: its plies from the bottom up, two on a card.")
      keyword%remark = "A ply is numbered by its place in the stack. The angle is added to the " &
         & //"axis angle of the material."
      call add_laminate_cards(keyword)
      call keyword%add_card(repeated=.true.)
      call keyword%add_integer("MID1", "ply material", least=1)
      call keyword%add_real("THICK1", "length", "thickness", above=0.0_wp)
      call keyword%add_real("B1", "degrees", "angle of the fibres from x", default=0.0_wp)
      call keyword%add_unused("TMID1")
      call keyword%add_integer("MID2", "ply material; blank or 0 for no second ply", default=0, &
         & least=0)
      call keyword%add_nonnegative("THICK2", "length", "thickness")
      call keyword%add_real("B2", "degrees", "angle of the fibres from x", default=0.0_wp)
      call keyword%add_unused("TMID2")
   end function part_composite

   !> A laminate, one ply on a card
   function part_composite_long() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("PART_COMPOSITE_LONG", standard, &
         & "A laminate: its plies from the bottom up, one on a card.")
      keyword%remark = "The angle is added to the axis angle of the material."
      call add_laminate_cards(keyword)
      call keyword%add_card(repeated=.true.)
      call keyword%add_integer("MID", "ply material", least=1)
      call keyword%add_real("THICK", "length", "thickness", above=0.0_wp)
      call keyword%add_real("B", "degrees", "angle of the fibres from x", default=0.0_wp)
      call keyword%add_unused("TMID")
      call keyword%add_integer("PLYID", "number of the ply; 0 for its place in the stack", &
         & default=0, least=0)
      call keyword%add_unused("SHRFAC", neutral=[0.0_wp, 1.0_wp])
   end function part_composite_long

   !> Title and first card of a laminate
   subroutine add_laminate_cards(keyword)
      !> The keyword of the laminate
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_text_card("TITLE", "title of the part")
      call keyword%add_card()
      call keyword%add_integer("PID", "number of the part", least=1)
      call keyword%add_integer("ELFORM", &
         & "without effect: all plates are layer-wise, see *SECTION_LAYERWISE", default=0)
      call keyword%add_real("SHRF", "-", "without effect: layer-wise plates need no shear factor", &
         & default=1.0_wp)
      call keyword%add_real("NLOC", "-", &
         & "where the nodes are: -1 bottom face, 0 mid-plane, 1 top face", default=0.0_wp, &
         & least=-1.0_wp, most=1.0_wp)
      call keyword%add_unused("MAREA HGID ADPOPT THSHEL")
   end subroutine add_laminate_cards

   !> Expansion through the thickness
   function section_layerwise() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("SECTION_LAYERWISE", extension, &
         & "Expansion of the displacement through the thickness of a laminate.")
      keyword%remark = "Without the keyword: order 2 and one numerical layer per ply."
      call keyword%add_integer("PID", "part", least=1)
      call keyword%add_integer("THEORY", "0 layer-wise Lagrange polynomials", default=0, &
         & allowed=[0])
      call keyword%add_integer("ORDER", "order of the polynomials in each numerical layer", &
         & default=2, least=1, most=4)
      call keyword%add_integer("BASIS", "points: 0 equally spaced, 1 Gauss-Lobatto", default=0, &
         & allowed=[0, 1])
      call keyword%add_integer("NQPLAN", "quadrature points along an edge; 0 for full quadrature", &
         & default=0, least=0)
      call keyword%add_integer("NQTHK", &
         & "quadrature points through a layer; 0 for full quadrature", default=0, least=0)
      call keyword%add_integer("LUMP", "0 diagonal mass", default=0, allowed=[0])
      call keyword%add_card(repeated=.true., optional=.true.)
      call keyword%add_integer("PLYID1", "first ply of a range", least=1)
      call keyword%add_integer("PLYID2", "last ply of the range", least=1)
      call keyword%add_integer("PLYORDER", "order of the polynomials in these plies", least=1, &
         & most=4)
      call keyword%add_integer("NSUB", "numerical layers in each of these plies", default=1, &
         & least=1, most=100)
   end function section_layerwise

   !> Isotropic material
   function mat_elastic() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("MAT_ELASTIC", standard, "Isotropic linear elastic ply material.", &
         & suffixes="TITLE", alias="MAT_001")
      call add_isotropic_card(keyword)
      call keyword%add_unused("DA DB K")
   end function mat_elastic

   !> Number, density and elastic constants of an isotropic material, on a card that may have more
   subroutine add_isotropic_card(keyword)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_integer("MID", "number of the material", least=1)
      call keyword%add_real("RO", "mass/length3", "density", above=0.0_wp)
      call keyword%add_real("E", "stress", "Young's modulus", above=0.0_wp)
      call keyword%add_real("PR", "-", "Poisson's ratio, above -1 and below 0.5", default=0.0_wp)
   end subroutine add_isotropic_card

   !> Orthotropic material of LS-DYNA
   function mat_orthotropic_elastic() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("MAT_ORTHOTROPIC_ELASTIC", standard, &
         & "Orthotropic linear elastic ply material with axes a, b, c.", suffixes="TITLE", &
         & alias="MAT_002")
      keyword%remark = "The Poisson's ratios are the minor ones: PRBA EA = nu_ab EB and so on. " &
         & //"a and d lie in the plane of the plate, d counter-clockwise from a."
      call keyword%add_integer("MID", "number of the material", least=1)
      call keyword%add_real("RO", "mass/length3", "density", above=0.0_wp)
      call keyword%add_real("EA", "stress", "Young's modulus along a", above=0.0_wp)
      call keyword%add_real("EB", "stress", "Young's modulus along b", above=0.0_wp)
      call keyword%add_real("EC", "stress", "Young's modulus along c", above=0.0_wp)
      call keyword%add_real("PRBA", "-", "strain along a from stress along b")
      call keyword%add_real("PRCA", "-", "strain along a from stress along c")
      call keyword%add_real("PRCB", "-", "strain along b from stress along c")
      call keyword%add_card()
      call keyword%add_real("GAB", "stress", "shear modulus in the plane a-b", above=0.0_wp)
      call keyword%add_real("GBC", "stress", "shear modulus in the plane b-c", above=0.0_wp)
      call keyword%add_real("GCA", "stress", "shear modulus in the plane c-a", above=0.0_wp)
      call keyword%add_real("AOPT", "-", "2: a and d are given", least=2.0_wp, most=2.0_wp)
      call keyword%add_unused("G SIGF")
      call keyword%add_card()
      call keyword%add_unused("XP YP ZP")
      call keyword%add_real("A1", "-", "x of a")
      call keyword%add_real("A2", "-", "y of a")
      call keyword%add_real("A3", "-", "z of a, zero", default=0.0_wp, least=0.0_wp, most=0.0_wp)
      call keyword%add_unused("MACF", neutral=[0.0_wp, 1.0_wp])
      call keyword%add_unused("IHIS")
      call keyword%add_card()
      call keyword%add_unused("V1 V2 V3")
      call keyword%add_real("D1", "-", "x of d")
      call keyword%add_real("D2", "-", "y of d")
      call keyword%add_real("D3", "-", "z of d, zero", default=0.0_wp, least=0.0_wp, most=0.0_wp)
      call keyword%add_unused("BETA REF")
   end function mat_orthotropic_elastic

   !> Ply material by its engineering constants
   function mat_ply_elastic() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("MAT_PLY_ELASTIC", extension, &
         & "Orthotropic linear elastic ply: 1 along the fibres, 2 across in the plane, 3 normal.", &
         & suffixes="TITLE")
      call add_ply_elastic_cards(keyword)
   end function mat_ply_elastic

   !> Number, density and elastic constants of a ply
   subroutine add_ply_elastic_cards(keyword)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_card()
      call keyword%add_integer("MID", "number of the material", least=1)
      call keyword%add_real("RO", "mass/length3", "density", above=0.0_wp)
      call keyword%add_real("E1", "stress", "Young's modulus along 1", above=0.0_wp)
      call keyword%add_real("E2", "stress", "Young's modulus along 2", above=0.0_wp)
      call keyword%add_real("E3", "stress", "Young's modulus along 3", above=0.0_wp)
      call keyword%add_real("NU12", "-", "Poisson's ratio: strain along 2 from stress along 1")
      call keyword%add_real("NU13", "-", "Poisson's ratio: strain along 3 from stress along 1")
      call keyword%add_real("NU23", "-", "Poisson's ratio: strain along 3 from stress along 2")
      call keyword%add_card()
      call keyword%add_real("G12", "stress", "shear modulus in the plane 1-2", above=0.0_wp)
      call keyword%add_real("G13", "stress", "shear modulus in the plane 1-3", above=0.0_wp)
      call keyword%add_real("G23", "stress", "shear modulus in the plane 2-3", above=0.0_wp)
   end subroutine add_ply_elastic_cards

end module plydyn_input_declare_part
