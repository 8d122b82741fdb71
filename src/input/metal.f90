!> Keywords of metals.
module plydyn_input_metal
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_declaration, only : standard
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_curve, a_table
   use plydyn_input_keyword_row, only : keyword_list_type, stage_material
   use plydyn_input_material, only : visit_isotropic
   use plydyn_input_set, only : add_tables
   use plydyn_law_metal_johnson_cook, only : johnson_cook_constants_type
   use plydyn_law_metal_kinematic, only : kinematic_constants_type
   use plydyn_law_metal_tabulated, only : tabulated_constants_type, yield_curve_type
   use plydyn_model_curve, only : curve_type
   use plydyn_model_material, only : add_material, material_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_metals

   !> Points of a yield curve on the cards of the material
   integer, parameter :: card_points = 8
   !> Strain at which LS-DYNA's metals fail by default: never
   real(wp), parameter :: never_fails(3) = [0.0_wp, 1.0e17_wp, 1.0e21_wp]
   !> Bound of stress that is none
   real(wp), parameter :: no_bound(2) = [0.0_wp, 1.0e28_wp]
   !> Between the values of VP
   real(wp), parameter :: half = 0.5_wp
   !> Power of the rise with the rate below which numbers go out of range
   real(wp), parameter :: least_power = 0.1_wp
   !> Heading of the theory on metals
   character(*), parameter :: of_metals = "metals-that-yield"

contains

   !> Add these keywords
   subroutine add_metals(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("MAT_PLASTIC_KINEMATIC", mat_plastic_kinematic, stage_material)
      call list%add("MAT_PIECEWISE_LINEAR_PLASTICITY", mat_piecewise_linear_plasticity, &
         & stage_material)
      call list%add("MAT_SIMPLIFIED_JOHNSON_COOK", mat_simplified_johnson_cook, stage_material)
      call add_tables(list)
   end subroutine add_metals

   !> Metal with linear hardening
   subroutine mat_plastic_kinematic(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(kinematic_constants_type) :: law
      type(material_type) :: material
      real(wp) :: form

      call card%keyword(standard, "Metal that yields by von Mises with linear hardening.", &
         & alias="MAT_003")
      call card%remark("ETAN 0 is perfect plasticity. With a rate, the yield stress is " &
         & //"multiplied by 1 + (rate/SRC)**(1/SRP), the rate being that of effective plastic " &
         & //"strain.")
      call card%example(of_metals, "1, 7.8e-9, 210.0e3, 0.3, 210.0, 2.0e3, 1.0")
      call visit_isotropic(card, material, law)
      call card%positive("SIGY", "stress", "yield stress", law%yield)
      call card%nonnegative("ETAN", "stress", "slope of stress over strain beyond yield", &
         & law%tangent)
      call card%real("BETA", "-", "share of hardening that is isotropic: 1 isotropic, 0 " &
         & //"kinematic", law%isotropic, default=0.0_wp, least=0.0_wp, most=1.0_wp)
      call card%card(optional=.true.)
      call card%nonnegative("SRC", "1/time", "rate at which the yield stress is doubled; 0 for " &
         & //"no effect of the rate", law%rate)
      call card%nonnegative("SRP", "-", "power of the rise with the rate", law%power)
      call card%unused("FS")
      call card%real("VP", "-", "0 or 1, without difference: the rate is that of effective " &
         & //"plastic strain", form, default=0.0_wp, least=0.0_wp, most=1.0_wp)
      if (.not. card%reads) return
      if (law%isotropic > 0.0_wp .and. law%tangent <= 0.0_wp) call card%warn_idle("BETA", &
         & "ETAN above 0")
      call check_tangent(card, law%tangent, law%young(1))
      call check_power(card, ["SRP", "SRC"], law%rate, law%power)
      call add_material(model%materials, material, law)
   end subroutine mat_plastic_kinematic

   !> Metal with the yield stress of Johnson and Cook
   subroutine mat_simplified_johnson_cook(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(johnson_cook_constants_type) :: law
      type(material_type) :: material
      real(wp) :: exponent

      call card%keyword(standard, "Metal that yields by von Mises with Johnson and Cook's yield " &
         & //"stress, without temperature.", alias="MAT_098")
      call card%remark("The yield stress is (A + B p**N) (1 + C ln(rate/EPSO)) with the " &
         & //"effective plastic strain p; below the rate EPSO the rate is without effect. The " &
         & //"rate is that of effective plastic strain, so VP must be 1 where C is not 0.")
      call card%example(of_metals, "1, 7.8e-9, 210.0e3, 0.3, 1.0|" &
         & //"210.0, 300.0, 0.4, 0.03, 1.0e17, 0, 0, 0.5")
      call visit_isotropic(card, material, law)
      call visit_formulation(card)
      call card%card()
      call card%positive("A", "stress", "yield stress without plastic strain", law%yield)
      call card%nonnegative("B", "stress", "rise of the yield stress up to a plastic strain of 1", &
         & law%factor)
      call card%nonnegative("N", "-", "power of plastic strain", exponent)
      call card%real("C", "-", "rise with the logarithm of the rate, 0.06 and less for most " &
         & //"metals; 0 for none", law%sensitivity, default=0.0_wp, least=0.0_wp, most=1.0_wp)
      call card%unused("PSFAIL", neutral=never_fails)
      call card%unused("SIGMAX SIGSAT", neutral=no_bound)
      call card%real("EPSO", "1/time", "rate from which on the yield stress rises", &
         & law%reference_rate, default=1.0_wp, least=0.0_wp)
      call card%zero_is_default()
      if (.not. card%reads) return
      if (law%factor > 0.0_wp) then
         law%exponent = exponent
         if (exponent <= 0.0_wp) call card%refuse("N", "N is missing", &
            & "the power of plastic strain, above 0, or B 0 for no hardening")
      else if (exponent > 0.0_wp) then
         call card%warn_idle("N", "B above 0")
      end if
      if (law%sensitivity > 0.0_wp) then
         call check_formulation(card, "C")
      else if (card%has("EPSO") .and. abs(card%number("EPSO")) > 0.0_wp) then
         call card%warn_idle("EPSO", "C above 0")
      end if
      call add_material(model%materials, material, law)
   end subroutine mat_simplified_johnson_cook

   !> Metal with a yield stress by points, curve or table
   subroutine mat_piecewise_linear_plasticity(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      integer :: curve
      type(material_type) :: material
      type(tabulated_constants_type) :: law
      real(wp) :: strain(card_points), stress(card_points), tangent

      call card%keyword(standard, "Metal that yields by von Mises with a yield stress by points, " &
         & //"curve or table.", alias="MAT_024")
      call card%remark("The yield stress over effective plastic strain comes from the curve " &
         & //"LCSS, one for each rate where LCSS is a table; without LCSS from the points EPS, " &
         & //"ES; without these from SIGY and ETAN. It is straight between points and goes on " &
         & //"past the last one as it ended, but not down; beyond the rates of a table the " &
         & //"nearest curve holds. A table whose first value is below 0 has the natural " &
         & //"logarithms of its rates. With C and P, SIGY (rate/C)**(1/P) is added. The rate is " &
         & //"that of effective plastic strain, so VP must be 1 where rates matter.")
      call card%example(of_metals, "1, 7.8e-9, 210.0e3, 0.3|0, 0, 1")
      call visit_isotropic(card, material, law)
      call card%nonnegative("SIGY", "stress", "yield stress, where no points and no curve give " &
         & //"it, and the stress that rises with C and P", law%yield)
      call card%nonnegative("ETAN", "stress", "slope of stress over strain beyond yield", tangent)
      call card%unused("FAIL", neutral=never_fails)
      call card%unused("TDEL")
      call card%card(optional=.true.)
      call card%nonnegative("C", "1/time", "rate at which the rise is SIGY; 0 for none", law%rate)
      call card%nonnegative("P", "-", "power of the rise with the rate", law%power)
      call card%integer("LCSS", "curve of yield stress over effective plastic strain, or table " &
         & //"of curves over rates; 0 for none", curve, default=0, least=0)
      call card%unused("LCSR")
      call visit_formulation(card)
      call card%unused("LCF")
      call visit_points(card, "EPS", "-", "effective plastic strain of a point, the first 0", &
         & strain)
      call visit_points(card, "ES", "stress", "yield stress of a point", stress)
      if (.not. card%reads) return
      call check_power(card, ["P", "C"], law%rate, law%power)
      if (law%rate > 0.0_wp) then
         call check_formulation(card, "C")
         call check_yield(card, law%yield)
      end if
      call check_idle(card, reshape([strain, stress], [card_points, 2]), curve > 0)
      if (curve > 0) then
         call take_curves(card, model%curves, law)
      else if (card%has("ES1")) then
         call take_points(card, strain, stress, law)
      else
         call check_yield(card, law%yield)
         call check_tangent(card, tangent, law%young(1))
         call take_straight_line(tangent, law)
      end if
      call add_material(model%materials, material, law)
   end subroutine mat_piecewise_linear_plasticity

   !> A card with one number for each point of a yield curve
   subroutine visit_points(card, name, dimension, sentence, values)
      class(card_visitor_type), intent(inout) :: card
      !> Name without number, dimension and meaning of the number
      character(*), intent(in) :: name, dimension, sentence
      real(wp), intent(inout) :: values(card_points)

      integer :: i

      call card%card(optional=.true.)
      do i = 1, card_points
         call card%nonnegative(name//text(i), dimension, sentence, values(i))
      end do
   end subroutine visit_points

   !> Whether the rate is that of effective plastic strain
   subroutine visit_formulation(card)
      class(card_visitor_type), intent(inout) :: card

      real(wp) :: form

      call card%real("VP", "-", "1: the rate is that of effective plastic strain; 0 where no " &
         & //"rate matters", form, default=0.0_wp, least=0.0_wp, most=1.0_wp)
   end subroutine visit_formulation

   !> A curve leaves points, SIGY and ETAN without effect, and points the last two; points have
   !> both strain and stress
   subroutine check_idle(card, points, has_curve)
      class(card_visitor_type), intent(inout) :: card
      !> Strain and stress of the points
      real(wp), intent(in) :: points(card_points, 2)
      !> Whether there is a curve
      logical, intent(in) :: has_curve

      character(*), parameter :: names(2) = ["EPS", "ES "]
      integer :: i, k

      do k = 1, size(names)
         i = findloc(points(:, k) > 0.0_wp, .true., 1)
         if (i == 0) cycle
         if (has_curve) then
            call card%warn_idle(trim(names(k))//text(i), "LCSS 0")
         else if (.not. card%has("ES1")) then
            call card%refuse(trim(names(k))//text(i), "a yield curve by points needs strain and " &
               & //"stress from its first point on", &
               & "both cards of points, EPS1 to EPS8 and ES1 to ES8")
         end if
      end do
      if (.not. (has_curve .or. card%has("ES1"))) return
      if (card%number("ETAN") > 0.0_wp) call card%warn_idle("ETAN", &
         & "neither LCSS nor points EPS, ES")
      if (card%number("SIGY") > 0.0_wp .and. card%number("C") <= 0.0_wp) call card%warn_idle( &
         & "SIGY", "neither LCSS nor points EPS, ES")
   end subroutine check_idle

   !> The curve of LCSS, or the curves of its table
   subroutine take_curves(card, curves, law)
      class(card_visitor_type), intent(inout) :: card
      type(curve_type), intent(in) :: curves(:)
      !> Gets its curves
      type(tabulated_constants_type), intent(inout) :: law

      real(wp), allocatable :: rates(:)
      integer, allocatable :: used(:)
      integer :: i, place

      call card%catalogue%registers(a_table)%refer(card%whole("LCSS"), place)
      if (place > 0) then
         rates = card%catalogue%tables(place)%value
         used = card%catalogue%tables(place)%curve
         law%logarithmic = rates(1) < 0.0_wp
         if (law%logarithmic) rates(:) = exp(rates)
         call check_formulation(card, "LCSS")
      else
         allocate (used(1))
         call card%look_up(a_curve, "LCSS", used(1))
         rates = [0.0_wp]
      end if
      if (any(used == 0)) return
      allocate (law%curves(size(used)))
      do i = 1, size(used)
         law%curves(i)%rate = rates(i)
         law%curves(i)%strain = curves(used(i))%x
         law%curves(i)%stress = curves(used(i))%y
         call check_curve(card, "LCSS", law%curves(i))
      end do
   end subroutine take_curves

   !> The points EPS, ES up to the last whose strain is not 0
   subroutine take_points(card, strain, stress, law)
      class(card_visitor_type), intent(inout) :: card
      real(wp), intent(in) :: strain(card_points), stress(card_points)
      !> Gets its curve
      type(tabulated_constants_type), intent(inout) :: law

      integer :: i, last

      last = max(1, findloc(strain > 0.0_wp, .true., 1, back=.true.))
      law%curves = [yield_curve_type(strain=strain(:last), stress=stress(:last))]
      i = last + findloc(stress(last + 1:) > 0.0_wp, .true., 1)
      if (i > last) then
         call card%refuse("ES"//text(i), "a point of the yield curve has no strain", &
            & "EPS"//text(i)//" above "//text(strain(last))//", or 0 here")
         return
      end if
      do i = 2, last
         if (strain(i) > strain(i - 1)) cycle
         call card%refuse("EPS"//text(i), "the plastic strain does not increase", &
            & "more than the "//text(strain(i - 1))//" of the point before")
         return
      end do
      call check_curve(card, "EPS1", law%curves(1))
   end subroutine take_points

   !> A yield stress that rises in proportion to plastic strain
   pure subroutine take_straight_line(tangent, law)
      !> ETAN
      real(wp), intent(in) :: tangent
      !> Gets its curve from SIGY and ETAN
      type(tabulated_constants_type), intent(inout) :: law

      real(wp) :: modulus

      associate (young => law%young(1))
         modulus = young*tangent/(young - min(tangent, half*young))
      end associate
      law%curves = [yield_curve_type(strain=[0.0_wp, 1.0_wp], &
         & stress=law%yield + modulus*[0.0_wp, 1.0_wp])]
   end subroutine take_straight_line

   !> A yield curve starts at no plastic strain and is positive
   subroutine check_curve(card, name, curve)
      class(card_visitor_type), intent(inout) :: card
      !> Field that gives the curve
      character(*), intent(in) :: name
      type(yield_curve_type), intent(in) :: curve

      if (abs(curve%strain(1)) > 0.0_wp) then
         call card%refuse(name, "the yield stress starts at the plastic strain " &
            & //text(curve%strain(1)), "a first point at plastic strain 0")
      else if (any(curve%stress <= 0.0_wp)) then
         call card%refuse(name, "the yield stress is "//text(minval(curve%stress)) &
            & //" somewhere", "a yield stress above 0 everywhere")
      end if
   end subroutine check_curve

   !> SIGY where it is needed
   subroutine check_yield(card, yield)
      class(card_visitor_type), intent(inout) :: card
      !> SIGY
      real(wp), intent(in) :: yield

      if (yield <= 0.0_wp) call card%refuse("SIGY", "SIGY is missing", &
         & "the yield stress, above 0, or points or a curve, and C 0")
   end subroutine check_yield

   !> The slope beyond yield is below that before
   subroutine check_tangent(card, tangent, young)
      class(card_visitor_type), intent(inout) :: card
      !> ETAN and Young's modulus
      real(wp), intent(in) :: tangent, young

      if (tangent >= young) call card%refuse("ETAN", "ETAN cannot be "//text(tangent), &
         & "a slope below Young's modulus E")
   end subroutine check_tangent

   !> A rate has a power
   subroutine check_power(card, names, rate, power)
      class(card_visitor_type), intent(inout) :: card
      !> Fields of the power and of the rate
      character(*), intent(in) :: names(2)
      !> Rate at which the rise is one, and its power
      real(wp), intent(in) :: rate, power

      if (rate <= 0.0_wp .and. power > 0.0_wp) call card%warn_idle(names(1), names(2)//" above 0")
      if (rate > 0.0_wp .and. power > 0.0_wp .and. power < least_power) call card%refuse( &
         & trim(names(1)), "1/"//trim(names(1))//" is the power of the rate, " &
         & //text(1.0_wp/power), "1 to 10, usually, and at least "//text(least_power))
      if (rate > 0.0_wp .and. power <= 0.0_wp) call card%refuse(names(1), names(1) &
         & //" is missing", "the power of the rise with the rate, above 0, or "//names(2) &
         & //" 0 for no effect of the rate")
   end subroutine check_power

   !> The rate that matters is that of effective plastic strain
   subroutine check_formulation(card, name)
      class(card_visitor_type), intent(inout) :: card
      !> Field that makes the rate matter
      character(*), intent(in) :: name

      if (card%number("VP") <= half) call card%refuse("VP", "VP is not 1, and "//name//" makes " &
         & //"the rate matter", "VP 1: the rate of effective plastic strain, not that of strain")
   end subroutine check_formulation

end module plydyn_input_metal
