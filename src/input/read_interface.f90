!> Readers of interfaces between plies: materials, and where they are.
module plydyn_input_read_interface
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : a_curve, a_part, an_interface_material, catalogue_type
   use plydyn_input_check_scatter_length, only : check_scatter_length
   use plydyn_law_cohesive_constants, only : cohesive_constants_type
   use plydyn_law_cohesive_softening, only : normal, shear
   use plydyn_law_cohesive_check, only : about_toughness, check_cohesive, finding_type
   use plydyn_law_cohesive_toughness, only : benzeggagh_kenane, power_law
   use plydyn_law_scatter, only : scatter_type
   use plydyn_model_curve, only : curve_type
   use plydyn_model_layup, only : faces_apart, faces_tied
   use plydyn_model_material, only : interface_material_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: find_interfaces, read_interface_cohesive, read_interface_law, read_interface_scatter, &
      & read_mat_cohesive_elastic, read_mat_cohesive_general, read_mat_cohesive_mixed_mode

   !> Share by which a strength may differ from what the ultimate displacement gives
   real(wp), parameter :: same_strength = 1.0e-3_wp
   !> Exponents of mixed modes: with less, a trace of the other mode changes the toughness; with
   !> more, powers of toughness leave the range of numbers in some units
   real(wp), parameter :: least_exponent = 0.1_wp, most_exponent = 20.0_wp

contains

   !> *MAT_COHESIVE_ELASTIC: springs between plies
   subroutine read_mat_cohesive_elastic(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(interface_material_type) :: material

      call begin_material(cards, catalogue, material)
      material%constants%stiffness(:) = cards%reals(["EN", "ET"])
      model%interface_materials = [model%interface_materials, material]
   end subroutine read_mat_cohesive_elastic

   !> *MAT_COHESIVE_MIXED_MODE: a bond that softens and fails
   subroutine read_mat_cohesive_mixed_mode(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(interface_material_type) :: material

      call begin_material(cards, catalogue, material)
      material%fails = .true.
      associate (constants => material%constants)
         constants%stiffness(:) = cards%reals(["EN", "ET"])
         constants%toughness(:) = cards%reals(["GIC ", "GIIC"])
         constants%criterion = merge(power_law, benzeggagh_kenane, cards%real("XMU") > 0.0_wp)
         constants%exponent = abs(cards%real("XMU"))
         call read_strength(cards, ["T  ", "UND"], constants%toughness(normal), catalogue, &
            & constants%strength(normal))
         call read_strength(cards, ["S  ", "UTD"], constants%toughness(shear), catalogue, &
            & constants%strength(shear))
         if (cards%has("XMU") .and. (constants%exponent < least_exponent .or. &
            & constants%exponent > most_exponent)) then
            call catalogue%refuse(cards, "XMU", "XMU cannot be "//text(cards%real("XMU")), &
               & "from "//text(least_exponent)//" to "//text(most_exponent) &
               & //" for the power law, from "//text(-most_exponent)//" to " &
               & //text(-least_exponent)//" for Benzeggagh-Kenane")
         else if (all(constants%strength > 0.0_wp)) then
            call refuse_findings(cards, constants, catalogue)
         end if
      end associate
      model%interface_materials = [model%interface_materials, material]
   end subroutine read_mat_cohesive_mixed_mode

   !> *MAT_COHESIVE_GENERAL: the same bond by a triangle of traction over separation
   subroutine read_mat_cohesive_general(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      integer, parameter :: dimensionless = 2
      type(interface_material_type) :: material
      real(wp) :: peak
      integer :: curve

      call begin_material(cards, catalogue, material)
      material%fails = .true.
      if (cards%integer("TES") /= dimensionless .and. cards%is_fine("TES")) then
         call catalogue%refuse(cards, "TES", "TES "//text(cards%integer("TES")) &
            & //" is not supported", "the dimensionless separation TES 2, or " &
            & //"*MAT_COHESIVE_MIXED_MODE with the exponent XMU")
      end if
      call catalogue%find(a_curve, cards, "TSLC", curve)
      peak = 1.0_wp
      if (curve > 0) call read_triangle(cards, model%curves(curve), catalogue, peak)
      associate (constants => material%constants)
         constants%toughness(:) = cards%reals(["GIC ", "GIIC"])
         constants%strength(:) = cards%reals(["T", "S"])
         constants%criterion = power_law
         if (all(constants%toughness > 0.0_wp)) then
            constants%stiffness(:) = constants%strength**2/(2.0_wp*constants%toughness*peak)
         end if
      end associate
      model%interface_materials = [model%interface_materials, material]
   end subroutine read_mat_cohesive_general

   !> Separation at the peak of a triangle from (0, 0) over (separation, 1) to (1, 0)
   subroutine read_triangle(cards, curve, catalogue, peak)
      type(cards_type), intent(in) :: cards
      !> What should be a triangle
      type(curve_type), intent(in) :: curve
      type(catalogue_type), intent(inout) :: catalogue
      !> Separation at the peak; 1 where the curve is no triangle, which is reported
      real(wp), intent(out) :: peak

      real(wp), parameter :: same = 1.0e-6_wp
      logical :: triangle

      peak = 1.0_wp
      triangle = size(curve%x) == 3
      if (triangle) triangle = all(abs(curve%y - [0.0_wp, 1.0_wp, 0.0_wp]) <= same) &
         & .and. all(abs(curve%x([1, 3]) - [0.0_wp, 1.0_wp]) <= same) &
         & .and. curve%x(2) > same .and. curve%x(2) < 1.0_wp - same
      if (triangle) then
         peak = curve%x(2)
      else
         call catalogue%refuse(cards, "TSLC", "curve "//text(cards%integer("TSLC")) &
            & //" is no triangle", "the points (0, 0), (separation at the peak, 1), (1, 0)")
      end if
   end subroutine read_triangle

   !> A strength, or the ultimate displacement that it follows from
   subroutine read_strength(cards, names, toughness, catalogue, strength)
      type(cards_type), intent(in) :: cards
      !> Fields of the strength and of the ultimate displacement
      character(*), intent(in) :: names(2)
      !> Energy per crack area of the mode
      real(wp), intent(in) :: toughness
      type(catalogue_type), intent(inout) :: catalogue
      !> Strength; 0 where there is none, which is reported
      real(wp), intent(out) :: strength

      real(wp) :: ultimate

      strength = cards%real(names(1))
      ultimate = cards%real(names(2))
      if (strength > 0.0_wp .and. ultimate > 0.0_wp) then
         if (abs(strength*ultimate/(2.0_wp*toughness) - 1.0_wp) <= same_strength) return
         call catalogue%refuse(cards, names(2), trim(names(1))//" and "//trim(names(2)) &
            & //" do not fit to the toughness", "one of them, and 0 for the other; "//trim( &
            & names(2))//" "//text(2.0_wp*toughness/strength)//" follows from "//trim( &
            & names(1)))
      else if (ultimate > 0.0_wp) then
         strength = 2.0_wp*toughness/ultimate
      else if (strength <= 0.0_wp .and. cards%is_fine(names(1)) &
         & .and. cards%line_of(names(1)) > cards%line) then
         call catalogue%refuse(cards, names(1), trim(names(1))//" is missing", &
            & "a strength above 0, or the ultimate displacement "//trim(names(2)))
      end if
   end subroutine read_strength

   !> Report what is wrong with the constants of *MAT_COHESIVE_MIXED_MODE, at their fields
   subroutine refuse_findings(cards, constants, catalogue)
      type(cards_type), intent(in) :: cards
      !> Constants, some of which may be wrong
      type(cohesive_constants_type), intent(in) :: constants
      type(catalogue_type), intent(inout) :: catalogue

      character(*), parameter :: toughness(2) = ["GIC ", "GIIC"]
      type(finding_type), allocatable :: findings(:)
      character(:), allocatable :: name
      integer :: i

      ! the bounds of the fields report all others
      call check_cohesive(constants, findings)
      do i = 1, size(findings)
         if (findings(i)%constant /= about_toughness) cycle
         name = toughness(max(findings(i)%mode, normal))
         if (.not. cards%is_fine(name)) cycle
         call catalogue%refuse(cards, name, findings(i)%wrong, findings(i)%right)
      end do
   end subroutine refuse_findings

   !> Number and title of an interface material
   subroutine begin_material(cards, catalogue, material)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(interface_material_type), intent(inout) :: material

      call catalogue%define(an_interface_material, cards, "MID")
      material%id = cards%integer("MID")
      material%title = cards%word("TITLE")
      if (cards%real("RO") > 0.0_wp) then
         call catalogue%report%note(cards%place("RO"), "RO is without effect", &
            & "an interface has no mass")
      end if
   end subroutine begin_material

   !> *INTERFACE_LAW: how a material fails where the mode changes, and under pressure
   subroutine read_interface_law(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      integer :: material, nth

      do nth = 1, cards%sets()
         call find_failing(cards, nth, catalogue, model, material)
         if (material == 0) cycle
         associate (constants => model%interface_materials(material)%constants)
            constants%by_work = cards%integer("MIX", nth) == 1
            constants%pressure_gain = cards%real("ETA", nth)
         end associate
      end do
   end subroutine read_interface_law

   !> *INTERFACE_SCATTER: strengths of a material from point to point
   subroutine read_interface_scatter(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(cohesive_constants_type) :: strongest
      type(finding_type), allocatable :: findings(:)
      integer :: material, nth

      do nth = 1, cards%sets()
         call find_failing(cards, nth, catalogue, model, material)
         call check_scatter_length(cards, nth, catalogue, model%mesh)
         if (material == 0 .or. catalogue%report%has_errors()) cycle
         associate (own => model%interface_materials(material))
            own%scatter = scatter_type(cards%integer("SEED", nth), cards%real("M", nth), &
               & cards%real("LENGTH", nth))
            strongest = own%constants
            strongest%strength(:) = own%scatter%largest_factor()*strongest%strength
            call check_cohesive(strongest, findings)
            if (size(findings) > 0) call catalogue%refuse(cards, "M", &
               & "at the strongest points "//findings(1)%wrong, findings(1)%right, nth)
         end associate
      end do
   end subroutine read_interface_scatter

   !> Index of the interface material of a row; 0 for one that is undefined or does not fail
   subroutine find_failing(cards, nth, catalogue, model, material)
      type(cards_type), intent(in) :: cards
      !> Which row
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(in) :: model
      !> The index
      integer, intent(out) :: material

      call catalogue%find(an_interface_material, cards, "MID", material, nth)
      if (material == 0) return
      if (model%interface_materials(material)%fails) return
      call catalogue%refuse(cards, "MID", "the material does not fail", &
         & "a material such as *MAT_COHESIVE_MIXED_MODE", nth)
      material = 0
   end subroutine find_failing

   !> *INTERFACE_COHESIVE: what lies between plies
   subroutine read_interface_cohesive(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      integer :: first, joint, last, nth, part

      do nth = 1, cards%sets()
         joint = faces_apart
         if (cards%integer("MID", nth) == 0 .and. cards%is_fine("MID", nth)) then
            call catalogue%refuse(cards, "MID", "MID cannot be 0", &
               & "an interface material, or -1 for nothing; tied interfaces need no card", nth)
         else if (cards%integer("MID", nth) > 0) then
            call catalogue%find(an_interface_material, cards, "MID", joint, nth)
         end if
         call read_options(cards, nth, catalogue, model%interface_materials, joint)
         call catalogue%find(a_part, cards, "PID", part, nth)
         if (part == 0) cycle
         call find_interfaces(cards, nth, size(model%parts(part)%joint), catalogue, first, last)
         if (any(model%parts(part)%joint(first:last) /= faces_tied)) then
            call catalogue%refuse(cards, "IFAC1", "some of these interfaces have a card already", &
               & "each interface on one card", nth)
         end if
         model%parts(part)%joint(first:last) = joint
      end do
   end subroutine read_interface_cohesive

   !> Let the joint be the material with the options of its card
   subroutine read_options(cards, nth, catalogue, materials, joint)
      type(cards_type), intent(in) :: cards
      !> Which row
      integer, intent(in) :: nth
      type(catalogue_type), intent(inout) :: catalogue
      !> Interface materials
      type(interface_material_type), allocatable, intent(inout) :: materials(:)
      !> Index of the material; in without options, out with them
      integer, intent(inout) :: joint

      character(*), parameter :: names(3) = ["CLOSE", "FRIC ", "FIT  "]
      type(finding_type), allocatable :: findings(:)
      type(interface_material_type) :: material
      integer :: i, fit

      if (joint > 0) material = materials(joint)
      if (.not. material%fails) then
         do i = 1, size(names)
            if (cards%real(names(i), nth) <= 0.0_wp) cycle
            call catalogue%refuse(cards, names(i), trim(names(i)) &
               & //" needs an interface that fails", "0, or a material such as " &
               & //"*MAT_COHESIVE_MIXED_MODE", nth)
         end do
      end if
      if (joint <= 0) return
      fit = cards%integer("FIT", nth)
      material%nodal = cards%integer("NQ", nth) == 1
      material%fitted = fit >= 2
      associate (constants => material%constants)
         constants%falling_penalty = material%fails .and. cards%integer("CLOSE", nth) == 0
         constants%friction = cards%real("FRIC", nth)
         constants%consistent = modulo(fit, 2) == 1
         if (constants%consistent .and. .not. catalogue%report%has_errors()) then
            call check_cohesive(constants, findings)
            if (size(findings) > 0) then
               call catalogue%refuse(cards, "FIT", "with the fitted shear stiffness, " &
                  & //findings(1)%wrong, findings(1)%right, nth)
            end if
         end if
      end associate
      call find_alike(material, materials, joint)
   end subroutine read_options

   !> Index of a material with the same number and options; a new one if there is none
   subroutine find_alike(material, materials, index)
      type(interface_material_type), intent(in) :: material
      type(interface_material_type), allocatable, intent(inout) :: materials(:)
      integer, intent(out) :: index

      do index = 1, size(materials)
         if (is_alike(material, materials(index))) return
      end do
      materials = [materials, material]
   end subroutine find_alike

   !> Whether two materials are one with the same options
   pure logical function is_alike(one, other)
      type(interface_material_type), intent(in) :: one, other

      associate (a => one%constants, b => other%constants)
         is_alike = one%id == other%id .and. (one%nodal .eqv. other%nodal) &
            & .and. (one%fitted .eqv. other%fitted) .and. (a%consistent .eqv. b%consistent) &
            & .and. (a%falling_penalty .eqv. b%falling_penalty) &
            & .and. abs(a%friction - b%friction) <= 0.0_wp
      end associate
   end function is_alike

   !> Range of interfaces; an empty one and a report when there are no such interfaces
   subroutine find_interfaces(cards, nth, count, catalogue, first, last)
      type(cards_type), intent(in) :: cards
      !> Which row, and interfaces of the part
      integer, intent(in) :: nth, count
      type(catalogue_type), intent(inout) :: catalogue
      !> First and last interface
      integer, intent(out) :: first, last

      first = cards%integer("IFAC1", nth)
      last = cards%integer("IFAC2", nth)
      if (first == 0 .and. last == 0 .and. count > 0) then
         first = 1
         last = count
      else if (first < 1 .or. last < first .or. last > count) then
         call catalogue%refuse(cards, merge("IFAC1", "IFAC2", first < 1 .or. first > count), &
            & "interfaces "//text(first)//" to "//text(last)//" do not exist", &
            & "a range within the "//text(count)//" interfaces of the part, or 0 and 0 for all", &
            & nth)
         first = 1
         last = 0
      end if
   end subroutine find_interfaces

end module plydyn_input_read_interface
