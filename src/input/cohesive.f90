!> Keywords of interface materials.
module plydyn_input_cohesive
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_declaration, only : standard
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_curve, an_interface_material
   use plydyn_input_keyword_row, only : keyword_list_type, stage_material
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type
   use plydyn_law_cohesive_softening, only : benzeggagh_kenane, normal, power_law
   use plydyn_law_cohesive_check, only : about_toughness, check_cohesive, finding_type
   use plydyn_model_curve, only : curve_type
   use plydyn_model_material, only : interface_material_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_interface_materials

   !> Share by which a strength may differ from what the ultimate displacement gives
   real(wp), parameter :: same_strength = 1.0e-3_wp
   !> Exponents of mixed modes: with less, a trace of the other mode changes the toughness; with
   !> more, powers of toughness leave the range of numbers in some units
   real(wp), parameter :: least_exponent = 0.1_wp, most_exponent = 20.0_wp
   !> Heading of the theory on interfaces that fail
   character(*), parameter, public :: of_failure = "71-the-law-of-an-interface-that-fails"

contains

   !> Add these keywords
   subroutine add_interface_materials(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("MAT_COHESIVE_ELASTIC", mat_cohesive_elastic, stage_material)
      call list%add("MAT_COHESIVE_MIXED_MODE", mat_cohesive_mixed_mode, stage_material)
      call list%add("MAT_COHESIVE_GENERAL", mat_cohesive_general, stage_material)
   end subroutine add_interface_materials

   !> Elastic interface material
   subroutine mat_cohesive_elastic(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(interface_material_type) :: material

      call card%keyword(standard, "Linear elastic springs between two plies.", alias="MAT_184")
      call card%example("7-joints-of-layers", "100, 0, 0, 0, 5.0e5, 1.0e6")
      call visit_head(card, material)
      call card%positive("ET", "stress/length", "traction per sliding", &
         & material%constants%stiffness(2))
      call card%positive("EN", "stress/length", "traction per opening", &
         & material%constants%stiffness(1))
      call card%unused("FN_FAIL")
      if (card%reads) model%interface_materials = [model%interface_materials, material]
   end subroutine mat_cohesive_elastic

   !> Interface material that softens
   subroutine mat_cohesive_mixed_mode(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      real(wp) :: exponent, ultimate(2)
      type(interface_material_type) :: material

      call card%keyword(standard, "Cohesive zone between two plies that softens and fails in " &
         & //"opening (mode I), sliding (mode II) and mixed mode.", alias="MAT_138")
      call card%remark("A bilinear law: damage starts at (t_n/T)**2 + (t_s/S)**2 = 1 and is " &
         & //"complete when the fracture energy of the mode mixity is dissipated. XMU above 0: " &
         & //"power law, (G_I/GIC)**XMU + (G_II/GIIC)**XMU = 1. XMU below 0: Benzeggagh-Kenane, " &
         & //"GIC + (GIIC - GIC) B**|XMU| with the share B of shear in the energy. T or S of 0 " &
         & //"follow from the ultimate displacements: T = 2 GIC/UND, S = 2 GIIC/UTD. Failed " &
         & //"faces are never deleted: they still transmit pressure when closed (INTFAIL 0). " &
         & //"Quadrature: NQ of *INTERFACE_COHESIVE.")
      call card%example(of_failure, "100, 0, 0, 0, 1.3733e6, 4.933e5, 0.28, 0.79|-1.45, 62.3, 92.3")
      call visit_head(card, material)
      associate (constants => material%constants)
         call card%positive("EN", "stress/length", "traction per opening", constants%stiffness(1))
         call card%positive("ET", "stress/length", "traction per sliding", constants%stiffness(2))
         call visit_toughness(card, constants)
         call card%card()
         call card%real("XMU", "-", "exponent of mixed modes: 0.1 to 20 power law, -20 to -0.1 " &
            & //"Benzeggagh-Kenane", exponent)
         call card%nonnegative("T", "stress", "strength in opening; 0 for 2 GIC/UND", &
            & constants%strength(1))
         call card%nonnegative("S", "stress", "strength in sliding; 0 for 2 GIIC/UTD", &
            & constants%strength(2))
         call card%nonnegative("UND", "length", "opening at failure, where T is 0", ultimate(1))
         call card%nonnegative("UTD", "length", "sliding at failure, where S is 0", ultimate(2))
         call card%unused("GAMMA", neutral=[0.0_wp, 1.0_wp])
         if (.not. card%reads) return
         constants%criterion = merge(power_law, benzeggagh_kenane, exponent > 0.0_wp)
         constants%exponent = abs(exponent)
         call find_strength(card, ["T  ", "UND"], constants%toughness(1), ultimate(1), &
            & constants%strength(1))
         call find_strength(card, ["S  ", "UTD"], constants%toughness(2), ultimate(2), &
            & constants%strength(2))
         call check_constants(card, constants)
      end associate
      material%fails = .true.
      model%interface_materials = [model%interface_materials, material]
   end subroutine mat_cohesive_mixed_mode

   !> Interface material by a curve of traction over separation
   subroutine mat_cohesive_general(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      integer, parameter :: dimensionless = 2
      integer :: curve, separation
      real(wp) :: peak
      type(interface_material_type) :: material

      call card%keyword(standard, "Cohesive zone between two plies with a curve of traction over " &
         & //"separation.", alias="MAT_186")
      call card%remark("Only the case that is equal to *MAT_COHESIVE_MIXED_MODE with XMU 1 is " &
         & //"supported: the dimensionless separation, TES 2, and the triangle (0, 0), (l, 1), " &
         & //"(1, 0) as TSLC. EN is then T**2/(2 GIC l), ET is S**2/(2 GIIC l). TES 0 and 1, " &
         & //"which mix the modes in another way, and other curves are errors.")
      call card%example(of_failure, "100, 0, 0, 0, 2, 1, 0.28, 0.79|0, 62.3, 92.3")
      call visit_head(card, material)
      associate (constants => material%constants)
         call card%integer("TES", "separation: 2 dimensionless", separation, default=0, least=0, &
            & most=2)
         call card%refer(a_curve, "TSLC", "curve of traction over separation, a triangle", curve)
         call visit_toughness(card, constants)
         call card%card()
         call card%unused("XMU", neutral=[0.0_wp, 1.0_wp])
         call card%positive("T", "stress", "strength in opening", constants%strength(1))
         call card%positive("S", "stress", "strength in sliding", constants%strength(2))
         call card%unused("STFSF TSLC2")
         if (.not. card%reads) return
         if (separation /= dimensionless .and. card%is_fine("TES")) call card%refuse("TES", "TES " &
            & //text(separation)//" is not supported", "the dimensionless separation TES 2, or " &
            & //"*MAT_COHESIVE_MIXED_MODE with the exponent XMU")
         peak = 1.0_wp
         if (curve > 0) call read_triangle(card, model%curves(curve), peak)
         constants%criterion = power_law
         if (all(constants%toughness > 0.0_wp)) constants%stiffness(:) = &
            & constants%strength**2/(2.0_wp*constants%toughness*peak)
      end associate
      material%fails = .true.
      model%interface_materials = [model%interface_materials, material]
   end subroutine mat_cohesive_general

   !> Number, title and density of an interface material
   subroutine visit_head(card, material)
      class(card_visitor_type), intent(inout) :: card
      type(interface_material_type), intent(inout) :: material

      real(wp) :: density

      call card%title(material%title)
      call card%define(an_interface_material, "MID", "number of the material", material%id)
      call card%nonnegative("RO", "mass/length2", "without effect: an interface has no mass", &
         & density)
      call card%unused("ROFLG", neutral=[0.0_wp, 1.0_wp])
      call card%unused("INTFAIL")
      if (.not. card%reads) return
      if (density > 0.0_wp) call card%note("RO", "RO is without effect", "an interface has no mass")
   end subroutine visit_head

   !> Fracture energies
   subroutine visit_toughness(card, constants)
      class(card_visitor_type), intent(inout) :: card
      type(cohesive_constants_type), intent(inout) :: constants

      call card%positive("GIC", "energy/length2", "fracture energy in opening (mode I)", &
         & constants%toughness(1))
      call card%positive("GIIC", "energy/length2", "fracture energy in sliding (mode II)", &
         & constants%toughness(2))
   end subroutine visit_toughness

   !> A strength that the card has, or that follows from the ultimate displacement
   subroutine find_strength(card, names, toughness, ultimate, strength)
      class(card_visitor_type), intent(inout) :: card
      !> Fields of the strength and of the ultimate displacement
      character(*), intent(in) :: names(2)
      !> Energy per crack area of the mode, and ultimate displacement; 0 for none
      real(wp), intent(in) :: toughness, ultimate
      !> Strength; 0 where there is none, which is reported
      real(wp), intent(inout) :: strength

      if (strength > 0.0_wp .and. ultimate > 0.0_wp) then
         if (abs(strength*ultimate/(2.0_wp*toughness) - 1.0_wp) <= same_strength) return
         call card%refuse(names(2), trim(names(1))//" and "//trim(names(2)) &
            & //" do not fit to the toughness", "one of them, and 0 for the other; " &
            & //trim(names(2))//" "//text(2.0_wp*toughness/strength)//" follows from " &
            & //trim(names(1)))
      else if (ultimate > 0.0_wp) then
         strength = 2.0_wp*toughness/ultimate
      else if (strength <= 0.0_wp .and. card%is_fine(names(1)) &
         & .and. card%line_of(names(1)) > card%line) then
         call card%refuse(names(1), trim(names(1))//" is missing", &
            & "a strength above 0, or the ultimate displacement "//trim(names(2)))
      end if
   end subroutine find_strength

   !> Report what is wrong with the constants of *MAT_COHESIVE_MIXED_MODE, at their fields
   subroutine check_constants(card, constants)
      class(card_visitor_type), intent(inout) :: card
      !> Constants, some of which may be wrong
      type(cohesive_constants_type), intent(in) :: constants

      character(*), parameter :: toughness(2) = ["GIC ", "GIIC"]
      type(finding_type), allocatable :: findings(:)
      character(:), allocatable :: name
      integer :: i

      if (card%has("XMU") .and. (constants%exponent < least_exponent &
         & .or. constants%exponent > most_exponent)) then
         call card%refuse("XMU", "XMU cannot be "//text(card%number("XMU")), &
            & "from "//text(least_exponent)//" to "//text(most_exponent) &
            & //" for the power law, from "//text(-most_exponent)//" to " &
            & //text(-least_exponent)//" for Benzeggagh-Kenane")
         return
      end if
      if (any(constants%strength <= 0.0_wp)) return
      ! the bounds of the fields report all others
      call check_cohesive(constants, findings)
      do i = 1, size(findings)
         if (findings(i)%constant /= about_toughness) cycle
         name = toughness(max(findings(i)%mode, normal))
         if (card%is_fine(name)) call card%refuse(name, findings(i)%wrong, findings(i)%right)
      end do
   end subroutine check_constants

   !> Separation at the peak of a triangle from (0, 0) over (separation, 1) to (1, 0)
   subroutine read_triangle(card, curve, peak)
      class(card_visitor_type), intent(inout) :: card
      !> What should be a triangle
      type(curve_type), intent(in) :: curve
      !> Separation at the peak; left where the curve is no triangle, which is reported
      real(wp), intent(inout) :: peak

      real(wp), parameter :: same = 1.0e-6_wp
      logical :: triangle

      triangle = size(curve%x) == 3
      if (triangle) triangle = all(abs(curve%y - [0.0_wp, 1.0_wp, 0.0_wp]) <= same) &
         & .and. all(abs(curve%x([1, 3]) - [0.0_wp, 1.0_wp]) <= same) &
         & .and. curve%x(2) > same .and. curve%x(2) < 1.0_wp - same
      if (triangle) then
         peak = curve%x(2)
      else
         call card%refuse("TSLC", "curve "//text(curve%id)//" is no triangle", &
            & "the points (0, 0), (separation at the peak, 1), (1, 0)")
      end if
   end subroutine read_triangle

end module plydyn_input_cohesive
