!> Keywords of plies whose fibres and matrix are damaged, with one variable each: from strengths by
!> fracture energies, or between strains of the deck.
module plydyn_input_damage
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_declaration, only : extension, standard
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_fracture, only : mat_ply_fracture_3d
   use plydyn_input_keyword_row, only : keyword_list_type, stage_material
   use plydyn_input_material, only : check_stability, set_axes, visit_axes_option, visit_head, &
      & visit_plane_vector, visit_ply
   use plydyn_input_ply, only : check_curve, check_idle, check_strengths, take_shear_points, &
      & visit_band, visit_band_rule, visit_line_shares, visit_strengths
   use plydyn_law_ply_constants, only : onset_hashin, onset_quadratic, ply_constants_type, &
      & snap_drop, snap_reduce, snap_refuse
   use plydyn_law_ply_shear_curve, only : new_exponential_curve, new_power_curve
   use plydyn_law_ply_strain_damage, only : strain_constants_type, strain_mechanisms
   use plydyn_model_material, only : add_material, material_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_damaged_materials

   !> Shapes of the shear curve as on the card
   integer, parameter :: exponential = 1, table = 2, power = 3
   !> Shear strain at which an exponential curve reaches the strength, unless a card says more
   real(wp), parameter :: usual_shear_strain = 0.05_wp
   !> Smallest ratio of strains at complete damage and at onset, unless a card says more
   real(wp), parameter :: usual_ratio = 1.05_wp
   !> Names of the mechanisms of damage between strains on the card, in the order of the law
   character(3), parameter :: mechanisms(strain_mechanisms) = ["FIB", "MAT", "LOC"]

contains

   !> Add the keywords of plies that are damaged
   subroutine add_damaged_materials(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("MAT_PLY_CODAM2", mat_ply_codam2, stage_material)
      call list%add("MAT_CODAM2", mat_codam2, stage_material)
      call list%add("MAT_PLY_FRACTURE_3D", mat_ply_fracture_3d, stage_material)
   end subroutine add_damaged_materials

   !> Ply whose fibres and matrix are damaged
   subroutine mat_ply_codam2(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(material_type) :: material
      type(ply_constants_type) :: ply
      real(wp) :: radius(2)

      call card%keyword(extension, "Ply with damage of fibres and of matrix after nonlinear " &
         & //"shear: CODAM2 at the level of the ply.")
      call card%remark("1 along the fibres, 2 across in the plane, 3 normal. Damage starts at " &
         & //"a strength. The stress then falls linearly with strain, until the fracture energy " &
         & //"is dissipated over the width of the crack band, which depends on the size of the " &
         & //"quad. Fibres may soften on two lines: two laws, each with a share of strength and " &
         & //"energy. The listing prints these strains and widths. Empty fields have the " &
         & //"defaults of recipes. In GZ a zero is a value of its own, not the default.")
      call card%example("plies-that-are-damaged", "1, 1.6e-9, 153.0e3, 10.3e3, 10.3e3, 0.3, 0.3, " &
         & //"0.4|6.0e3, 6.0e3, 3.7e3|2537.0, 1580.0, 82.0, 236.0, 90.0|91.6, 79.9, 0.22, 1.1|" &
         & //"1, 0, 0.05")
      call visit_ply(card, material, ply)
      call visit_strengths(card, ply%fibre_strength, ply%matrix_strength)
      call card%positive("SL", "stress", "shear strength in the plane 1-2", ply%shear_strength)
      call card%nonnegative("ST", "stress", "shear strength in the plane 2-3; needed for MCOMP 1", &
         & ply%cross_strength)
      call card%card()
      call card%positive("G1T", "energy/length2", "fracture energy of fibres in tension", &
         & ply%fibre_toughness(1))
      call card%positive("G1C", "energy/length2", "fracture energy of fibres in compression", &
         & ply%fibre_toughness(2))
      call card%positive("G2T", "energy/length2", "fracture energy of matrix in tension", &
         & ply%matrix_toughness(1))
      call card%positive("G2C", "energy/length2", "fracture energy of matrix in compression", &
         & ply%matrix_toughness(2))
      call visit_band(card, ply%band_width, ply%residual)
      call card%nonnegative("G2S", "energy/length2", "fracture energy of matrix in shear; 0 for " &
         & //"G2T or G2C by the sign of the stress across", ply%shear_toughness)
      call visit_shear(card, model, ply)
      call visit_switches(card, ply)
      call card%nonnegative("R1", "length", "radius, along the fibres, of the ellipse over which " &
         & //"the strains that drive damage are averaged; 0 for no average", radius(1))
      call card%nonnegative("R2", "length", "radius of it across the fibres; needed with R1", &
         & radius(2))
      call visit_line_shares(card, ply%line_strength, ply%line_toughness, ply%plateau)
      if (.not. card%reads) return
      call check_strengths(card, ply)
      call check_choices(card, ply%onset == onset_hashin)
      call set_average(card, radius, ply)
      material%line = card%line_of("MID")
      if (card%has("SNAP")) material%line = card%line_of("SNAP")
      if (ply%averages()) material%radius_line = card%line_of("R1")
      call add_material(model%materials, material, ply)
   end subroutine mat_ply_codam2

   !> Curve of shear in the plane
   subroutine visit_shear(card, model, ply)
      class(card_visitor_type), intent(inout) :: card
      !> Has the curves
      type(model_type), intent(in) :: model
      type(ply_constants_type), intent(inout) :: ply

      integer :: number, shape_number
      real(wp) :: coefficient, exponent, strain

      call card%card(optional=.true.)
      call card%integer("SHEAR", "shear in the plane 1-2 until the matrix cracks: 0 linear; 1 " &
         & //"exponential that reaches SL at GAMU; 2 curve LCID; 3 of Ramberg and Osgood, strain " &
         & //"= stress/G12 + ALPHA stress**N", shape_number, default=0, allowed=[0, 1, 2, 3])
      call card%integer("LCID", "curve of shear stress over shear strain from 0, 0; its last " &
         & //"line goes on", number, default=0, least=0)
      call card%positive("GAMU", "-", "shear strain at which SL is reached, above SL/G12", strain, &
         & default=usual_shear_strain)
      call card%zero_is_default()
      call card%nonnegative("ALPHA", "1/stress**N", "coefficient of Ramberg and Osgood", &
         & coefficient)
      call card%nonnegative("N", "-", "exponent of Ramberg and Osgood, above 1", exponent)
      if (.not. card%reads) return
      if (.not. (card%is_fine("G12") .and. card%is_fine("SL"))) return
      associate (modulus => ply%shear(1), strength => ply%shear_strength)
         select case (shape_number)
         case (exponential)
            if (.not. card%is_fine("GAMU")) return
            if (strain*modulus > strength) then
               ply%curve = new_exponential_curve(modulus, strength, strain)
            else
               call card%refuse("GAMU", "the shear curve cannot reach SL at a strain of " &
                  & //text(strain), "a strain above SL/G12 = "//text(strength/modulus))
            end if
         case (table)
            call take_shear_points(card, model%curves, modulus, strength, ply%curve)
         case (power)
            if (.not. (card%is_fine("ALPHA") .and. card%is_fine("N"))) return
            ply%curve = new_power_curve(modulus*coefficient, exponent)
            call check_curve(card, trim(merge("N    ", "ALPHA", coefficient > 0.0_wp)), ply%curve, &
               & [modulus, strength], "ALPHA such that ALPHA SL**N is the plastic strain at the " &
               & //"strength, and N above 1")
         case default
            continue
         end select
      end associate
   end subroutine visit_shear

   !> Choices within the law
   subroutine visit_switches(card, ply)
      class(card_visitor_type), intent(inout) :: card
      type(ply_constants_type), intent(inout) :: ply

      logical :: is_stiff

      call card%card(optional=.true.)
      call visit_band_rule(card, ply%band_rule)
      call card%choice("SNAP", "if the crack band is too wide for the fracture energy: 0 damage " &
         & //"starts below the strength, and the fracture energy is right; 1 error; 2 the stress " &
         & //"drops at once from the strength", ply%snap_back, &
         & [snap_reduce, snap_refuse, snap_drop])
      call card%real("RSNAP", "-", "smallest ratio of the strains at complete damage and at " &
         & //"onset of damage, for SNAP 0 and 1", ply%snap_ratio, default=usual_ratio, least=1.0_wp)
      call card%zero_is_default()
      call card%choice("MCOMP", "onset of matrix damage in compression: 0 quadratic in stress " &
         & //"and shear; 1 of Hashin (1980)", ply%onset, [onset_quadratic, onset_hashin])
      call card%unused("TRIAL", successor="onset is by the stresses on what remains in the other " &
         & //"direction")
      call card%flag("CLOSE", "cracks: 0 never close, as always with R1; 1 close in compression, " &
         & //"which has damage of its own", ply%closes, default=1)
      call card%real("PLATEAU", "-", "share of XC that crushed fibres keep, from 0 to below 1", &
         & ply%plateau, default=0.0_wp, least=0.0_wp, most=0.99_wp)
      call card%flag("GZ", "shear across the thickness: 0 weakened by damage, with which layers " &
         & //"below an impactor may fold; 1 not weakened", is_stiff, default=1)
      call card%card(optional=.true.)
      call card%unused("BRITTLE", successor="the stress of crushed fibres falls along lines, or " &
         & //"to PLATEAU")
      if (.not. card%reads) return
      ply%weakens_across = .not. is_stiff
      if (ply%snap_back == snap_drop .and. abs(ply%snap_ratio - usual_ratio) > 0.0_wp) then
         call card%warn_idle("RSNAP", "SNAP 0 or 1")
      end if
      if (ply%onset == onset_hashin .and. ply%cross_strength <= 0.0_wp) then
         if (card%is_fine("ST")) call card%refuse("ST", "ST is missing", "a strength above 0, " &
            & //"which Hashin's onset (MCOMP 1) needs")
      end if
   end subroutine visit_switches

   !> Radii of the average over neighbours
   subroutine set_average(card, radius, ply)
      class(card_visitor_type), intent(inout) :: card
      !> Along the fibres and across them
      real(wp), intent(in) :: radius(2)
      type(ply_constants_type), intent(inout) :: ply

      character(2), parameter :: names(2) = ["R1", "R2"]
      integer :: missing

      if (.not. (card%is_fine("R1") .and. card%is_fine("R2"))) return
      if (maxval(radius) <= 0.0_wp) return
      missing = minloc(radius, 1)
      if (radius(missing) <= 0.0_wp) then
         call card%refuse(names(missing), names(missing)//" is missing beside " &
            & //names(3 - missing)//" = "//text(radius(3 - missing)), "both radii of the " &
            & //"ellipse, or none")
      else if (ply%closes .and. card%has("CLOSE")) then
         call card%refuse("CLOSE", "cracks that close do not go with an average over neighbours", &
            & "0, or no R1 and R2")
      end if
      ply%closes = .false.
      ply%radius(:) = radius
   end subroutine set_average

   !> Constants of what is not chosen mean nothing
   subroutine check_choices(card, is_hashin)
      class(card_visitor_type), intent(inout) :: card
      !> Whether the onset is Hashin's
      logical, intent(in) :: is_hashin

      if (abs(card%number("GAMU") - usual_shear_strain) > 0.0_wp .and. card%whole("SHEAR") &
         & /= exponential) call card%warn_idle("GAMU", "SHEAR 1")
      call check_idle(card, ["LCID ", "ALPHA", "N    "], [table, power, power])
      if (.not. is_hashin .and. card%number("ST") > 0.0_wp) call card%warn_idle("ST", "MCOMP 1")
   end subroutine check_choices

   !> Ply whose damage begins and ends at strains of the deck
   subroutine mat_codam2(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(material_type) :: material
      type(strain_constants_type) :: ply
      real(wp) :: unread(2)

      call card%keyword(standard, "Ply whose damage begins and is complete at strains that the " &
         & //"deck gives.", alias="MAT_219")
      call card%remark("One ply, transversely isotropic about its fibres (a): EC = EB, PRCA = " &
         & //"PRBA, GCA = GAB, GBC = EB/(2 (1 + PRCB)). Each ply of *PART_COMPOSITE has its own " &
         & //"damage, so the sub-laminate has one layer. Without the nonlocal average (R1) a " &
         & //"crack dissipates more energy in larger quads; with it, about as much as a band of " &
         & //"the width 1.4 R1. The listing prints this energy. *MAT_PLY_CODAM2 takes fracture " &
         & //"energies instead. No element is deleted.")
      call card%example("plies-damaged-between-given-strains", "1, 1.6e-9, 130.0e3, 9.0e3, 0, " &
         & //"0.02, 0, 0.4|5.0e3, 0, 0, 1|0, 0, 0, 1.0, 0, 0, 2|0, 0, 0, 0, 1.0, 0|0.0|" &
         & //"0.008, 0.015, 0.06, 0, 0.032, 0.06, 0.08|0.020, 0.011, 0.09, 0, 0.07, 0.09, 0.11")
      call visit_head(card, material)
      call visit_layer(card, ply)
      call visit_axes(card, material)
      call visit_strains(card, "T", "tension", ply%onset(:, 1), ply%finish(:, 1))
      call visit_strains(card, "C", "compression", ply%onset(:, 2), ply%finish(:, 2))
      call card%card(optional=.true.)
      call card%unused("ERODE")
      call card%real("ERPAR1", "-", "without effect, for ERODE is 0", unread(1), default=0.0_wp)
      call card%real("ERPAR2", "-", "without effect, for ERODE is 0", unread(2), default=0.0_wp)
      call card%unused("RESIDS")
      if (.not. card%reads) return
      material%radius_line = card%line_of("R1")
      call add_material(model%materials, material, ply)
   end subroutine mat_codam2

   !> Elastic constants, layers of the sub-laminate, average over neighbours
   subroutine visit_layer(card, ply)
      class(card_visitor_type), intent(inout) :: card
      type(strain_constants_type), intent(inout) :: ply

      integer :: layers
      real(wp) :: minor

      call card%positive("EA", "stress", "Young's modulus along the fibres", ply%young(1))
      call card%positive("EB", "stress", "Young's modulus across the fibres", ply%young(2))
      call card%unused("UNUSED1")
      call card%real("PRBA", "-", "strain along the fibres from stress across", minor)
      call card%unused("UNUSED2")
      call card%real("PRCB", "-", "strain across the fibres from stress across, the other way", &
         & ply%poisson(3))
      call card%card()
      call card%positive("GAB", "stress", "shear modulus along the fibres", ply%shear(1))
      call card%unused("UNUSED3 UNUSED4")
      call card%integer("NLAYER", "layers of the sub-laminate: 1", layers, least=1)
      call card%nonnegative("R1", "length", "radius of the circle over which the strains in the " &
         & //"plane are averaged before they drive damage; 0 for no average", ply%radius(1))
      call card%unused("R2 NFREQ")
      if (.not. card%reads) return
      ply%radius(2) = ply%radius(1)
      ply%young(3) = ply%young(2)
      ply%shear(2) = ply%shear(1)
      if (all(ply%young > 0.0_wp)) then
         ply%poisson(:2) = minor*ply%young(1)/ply%young(2)
         call check_stability(card, ["PRBA", "PRBA", "PRCB"], ply)
      end if
      if (abs(ply%poisson(3)) < 1.0_wp) ply%shear(3) = ply%young(2)/(2.0_wp*(1.0_wp &
         & + ply%poisson(3)))
      if (card%is_fine("NLAYER") .and. layers /= 1) call card%refuse("NLAYER", "a sub-laminate " &
         & //"of "//text(layers)//" layers is not supported", "1, and each layer a ply of " &
         & //"*PART_COMPOSITE with an angle of its own")
   end subroutine visit_layer

   !> Axes of the material, and the angle of its layer
   subroutine visit_axes(card, material)
      class(card_visitor_type), intent(inout) :: card
      type(material_type), intent(inout) :: material

      real(wp) :: a(2), angle, d(2)

      call visit_plane_vector(card, "XP YP ZP", "A", "a", a)
      call visit_axes_option(card)
      call visit_plane_vector(card, "V1 V2 V3", "D", "d", d)
      call card%unused("BETA")
      call card%unused("MACF", neutral=[0.0_wp, 1.0_wp])
      call card%card()
      call card%real("ANGLE1", "degrees", "angle of the fibres from a, added to that of the ply", &
         & angle, default=0.0_wp)
      call card%unused("ANGLE2 ANGLE3 ANGLE4 ANGLE5 ANGLE6 ANGLE7 ANGLE8")
      if (.not. card%reads) return
      call set_axes(card, a, d, material)
      material%axis_angle = material%axis_angle + angle
   end subroutine visit_axes

   !> Strains at which damage begins and is complete
   subroutine visit_strains(card, letter, sense, onset, finish)
      class(card_visitor_type), intent(inout) :: card
      !> T or C, for tension or compression
      character(*), intent(in) :: letter, sense
      !> The strains of each mechanism
      real(wp), intent(inout) :: onset(strain_mechanisms), finish(strain_mechanisms)

      character(*), parameter :: pictures = "without effect, as in LS-DYNA, which shows it"
      real(wp) :: unread
      integer :: i

      call card%card()
      call card%positive("IMAT"//letter, "-", "strain at onset of matrix damage in "//sense, &
         & onset(2))
      call card%positive("IFIB"//letter, "-", "strain at onset of fibre damage in "//sense, &
         & onset(1))
      call card%positive("ILOC"//letter, "-", "principal strain in "//sense//" from which on the " &
         & //"rest of the ply gives way; in LS-DYNA's advice SFIB"//letter, onset(3))
      call card%real("IDEL"//letter, "-", pictures, unread, default=0.0_wp)
      call card%positive("SMAT"//letter, "-", "strain at which matrix damage is complete", &
         & finish(2))
      call card%positive("SFIB"//letter, "-", "strain at which fibre damage is complete", finish(1))
      call card%positive("SLOC"//letter, "-", "principal strain at which nothing of the ply is " &
         & //"left in its plane", finish(3))
      call card%real("SDEL"//letter, "-", pictures, unread, default=0.0_wp)
      if (.not. card%reads) return
      do i = 1, size(mechanisms)
         associate (first => "I"//mechanisms(i)//letter, last => "S"//mechanisms(i)//letter)
            if (.not. (card%is_fine(first) .and. card%is_fine(last))) cycle
            if (finish(i) <= onset(i)) call card%refuse(last, "damage would be complete at " &
               & //text(finish(i))//" and begin at "//text(onset(i)), "a strain above "//first)
         end associate
      end do
   end subroutine visit_strains

end module plydyn_input_damage
