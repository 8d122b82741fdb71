!> Keyword of plies whose damage begins and ends at strains of the deck.
module plydyn_input_strain_damage
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_declaration, only : standard
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_material, only : check_stability, set_axes, visit_axes_option, visit_head, &
      & visit_plane_vector
   use plydyn_law_ply_strain_damage, only : strain_constants_type, strain_mechanisms
   use plydyn_model_material, only : add_material, material_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: mat_codam2

   !> Names of the mechanisms on the card, in the order of the law
   character(3), parameter :: names(strain_mechanisms) = ["FIB", "MAT", "LOC"]

contains

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
         & //"of " &
         & //text(layers)//" layers is not supported", "1, and each layer a ply of " &
         & //"*PART_COMPOSITE with an angle of its own")
   end subroutine visit_layer

   !> Axes of the material, and the angle of its layer
   subroutine visit_axes(card, material)
      class(card_visitor_type), intent(inout) :: card
      type(material_type), intent(inout) :: material

      real(wp) :: a(2), angle, d(2)

      call card%card()
      call card%unused("XP YP ZP")
      call visit_plane_vector(card, "A", "a", a)
      call visit_axes_option(card)
      call card%card()
      call card%unused("V1 V2 V3")
      call visit_plane_vector(card, "D", "d", d)
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
      call card%positive("SFIB"//letter, "-", "strain at which fibre damage is complete", &
         & finish(1))
      call card%positive("SLOC"//letter, "-", "principal strain at which nothing of the ply is " &
         & //"left in its plane", finish(3))
      call card%real("SDEL"//letter, "-", pictures, unread, default=0.0_wp)
      if (.not. card%reads) return
      do i = 1, size(names)
         associate (first => "I"//names(i)//letter, last => "S"//names(i)//letter)
            if (.not. (card%is_fine(first) .and. card%is_fine(last))) cycle
            if (finish(i) <= onset(i)) call card%refuse(last, "damage would be complete at " &
               & //text(finish(i))//" and begin at "//text(onset(i)), "a strain above "//first)
         end associate
      end do
   end subroutine visit_strains

end module plydyn_input_strain_damage
