!> Readers of metals, and of the tables that they refer to.
module plydyn_input_read_metal
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : a_curve, a_table, catalogue_type, table_type
   use plydyn_input_declare_metal, only : card_points
   use plydyn_input_read_material, only : begin_material, read_isotropic
   use plydyn_model_curve, only : curve_type
   use plydyn_law_metal_johnson_cook, only : johnson_cook_constants_type
   use plydyn_law_metal_kinematic, only : kinematic_constants_type
   use plydyn_law_metal_tabulated, only : tabulated_constants_type
   use plydyn_law_metal_yield_curve, only : yield_curve_type
   use plydyn_model_material, only : add_material, material_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_define_table, read_define_table_2d, read_mat_piecewise_linear_plasticity, &
      & read_mat_plastic_kinematic, read_mat_simplified_johnson_cook

   !> Between the values of VP
   real(wp), parameter :: half = 0.5_wp

contains

   !> *MAT_PLASTIC_KINEMATIC: a metal with linear hardening
   subroutine read_mat_plastic_kinematic(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(kinematic_constants_type) :: law
      type(material_type) :: material

      call begin_material(cards, catalogue, material)
      call read_isotropic(cards, catalogue, law)
      law%yield = cards%real("SIGY")
      law%tangent = cards%real("ETAN")
      law%isotropic = cards%real("BETA")
      law%rate = cards%real("SRC")
      law%power = cards%real("SRP")
      call check_tangent(cards, law%tangent, law%young(1), catalogue)
      call check_power(cards, ["SRP", "SRC"], law%rate, law%power, catalogue)
      call add_material(model%materials, material, law)
   end subroutine read_mat_plastic_kinematic

   !> *MAT_SIMPLIFIED_JOHNSON_COOK: a metal that hardens by a power and the logarithm of the rate
   subroutine read_mat_simplified_johnson_cook(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(johnson_cook_constants_type) :: law
      type(material_type) :: material

      call begin_material(cards, catalogue, material)
      call read_isotropic(cards, catalogue, law)
      law%yield = cards%real("A")
      law%factor = cards%real("B")
      if (law%factor > 0.0_wp) then
         law%exponent = cards%real("N")
         if (law%exponent <= 0.0_wp) call catalogue%refuse(cards, "N", "N is missing", &
            & "the power of plastic strain, above 0, or B 0 for no hardening")
      else if (cards%real("N") > 0.0_wp) then
         call catalogue%warn_idle(cards, "N", "B above 0")
      end if
      law%sensitivity = cards%real("C")
      law%reference_rate = cards%real("EPSO")
      if (law%sensitivity > 0.0_wp) call check_formulation(cards, "C", catalogue)
      call add_material(model%materials, material, law)
   end subroutine read_mat_simplified_johnson_cook

   !> *MAT_PIECEWISE_LINEAR_PLASTICITY: a metal with a yield stress by points, curve or table
   subroutine read_mat_piecewise_linear_plasticity(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(material_type) :: material
      type(tabulated_constants_type) :: law
      real(wp) :: tangent

      call begin_material(cards, catalogue, material)
      call read_isotropic(cards, catalogue, law)
      law%yield = cards%real("SIGY")
      law%rate = cards%real("C")
      law%power = cards%real("P")
      call check_power(cards, ["P", "C"], law%rate, law%power, catalogue)
      if (law%rate > 0.0_wp) then
         call check_formulation(cards, "C", catalogue)
         call check_yield(cards, law%yield, catalogue)
      end if
      call check_idle(cards, catalogue)
      if (cards%integer("LCSS") > 0) then
         call read_yield_curves(cards, model%curves, catalogue, law)
      else if (cards%has("ES1")) then
         call read_points(cards, catalogue, law)
      else
         tangent = cards%real("ETAN")
         call check_yield(cards, law%yield, catalogue)
         call check_tangent(cards, tangent, law%young(1), catalogue)
         call take_straight_line(tangent, law)
      end if
      call add_material(model%materials, material, law)
   end subroutine read_mat_piecewise_linear_plasticity

   !> A curve leaves points, SIGY and ETAN without effect, and points the last two; points have
   !> both strain and stress
   subroutine check_idle(cards, catalogue)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue

      character(*), parameter :: names(2) = ["EPS", "ES "]
      logical :: has_curve, has_points
      integer :: i, k

      has_curve = cards%integer("LCSS") > 0
      has_points = cards%has("ES1")
      do k = 1, size(names)
         do i = 1, card_points
            associate (name => trim(names(k))//text(i))
               if (cards%real(name) <= 0.0_wp) cycle
               if (has_curve) then
                  call catalogue%warn_idle(cards, name, "LCSS 0")
               else if (.not. has_points) then
                  call catalogue%refuse(cards, name, "a yield curve by points needs strain and " &
                     & //"stress from its first point on", &
                     & "both cards of points, EPS1 to EPS8 and ES1 to ES8")
               end if
               exit
            end associate
         end do
      end do
      if (.not. (has_curve .or. has_points)) return
      if (cards%real("ETAN") > 0.0_wp) call catalogue%warn_idle(cards, "ETAN", &
         & "neither LCSS nor points EPS, ES")
      if (cards%real("SIGY") > 0.0_wp .and. cards%real("C") <= 0.0_wp) call catalogue%warn_idle( &
         & cards, "SIGY", "neither LCSS nor points EPS, ES")
   end subroutine check_idle

   !> The curve of LCSS, or the curves of its table
   subroutine read_yield_curves(cards, curves, catalogue, law)
      type(cards_type), intent(in) :: cards
      type(curve_type), intent(in) :: curves(:)
      type(catalogue_type), intent(inout) :: catalogue
      !> Gets its curves
      type(tabulated_constants_type), intent(inout) :: law

      real(wp), allocatable :: rates(:)
      integer, allocatable :: used(:)
      integer :: i, place

      call catalogue%registers(a_table)%sort()
      place = catalogue%registers(a_table)%index_of(cards%integer("LCSS"))
      if (place > 0) then
         call catalogue%registers(a_table)%mark(place)
         rates = catalogue%tables(place)%value
         used = catalogue%tables(place)%curve
         law%logarithmic = rates(1) < 0.0_wp
         if (law%logarithmic) rates(:) = exp(rates)
         call check_formulation(cards, "LCSS", catalogue)
      else
         allocate (used(1))
         call catalogue%find(a_curve, cards, "LCSS", used(1))
         rates = [0.0_wp]
      end if
      if (any(used == 0)) return
      allocate (law%curves(size(used)))
      do i = 1, size(used)
         law%curves(i)%rate = rates(i)
         law%curves(i)%strain = curves(used(i))%x
         law%curves(i)%stress = curves(used(i))%y
         call check_curve(cards, "LCSS", curves(used(i)), catalogue)
      end do
   end subroutine read_yield_curves

   !> The points EPS, ES up to the last whose strain is not 0
   subroutine read_points(cards, catalogue, law)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      !> Gets its curve
      type(tabulated_constants_type), intent(inout) :: law

      type(curve_type) :: curve
      integer :: i, last

      last = 1
      do i = 2, card_points
         if (cards%real("EPS"//text(i)) > 0.0_wp) last = i
      end do
      curve%x = [(cards%real("EPS"//text(i)), i=1, last)]
      curve%y = [(cards%real("ES"//text(i)), i=1, last)]
      law%curves = [yield_curve_type(strain=curve%x, stress=curve%y)]
      do i = last + 1, card_points
         if (cards%real("ES"//text(i)) <= 0.0_wp) cycle
         call catalogue%refuse(cards, "ES"//text(i), "a point of the yield curve has no strain", &
            & "EPS"//text(i)//" above "//text(curve%x(last))//", or 0 here")
         return
      end do
      do i = 2, last
         if (curve%x(i) > curve%x(i - 1)) cycle
         call catalogue%refuse(cards, "EPS"//text(i), "the plastic strain does not increase", &
            & "more than the "//text(curve%x(i - 1))//" of the point before")
         return
      end do
      call check_curve(cards, "EPS1", curve, catalogue)
   end subroutine read_points

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

   !> *DEFINE_TABLE: values whose curves follow in the deck
   subroutine read_define_table(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(table_type) :: table
      integer :: curves, first, i, wanted

      wanted = cards%sets()
      curves = size(model%curves)
      allocate (table%curve(wanted), source=0)
      associate (register => catalogue%registers(a_curve))
         first = 1
         if (curves > 0) first = count(register%line(:curves) < cards%line) + 1
         do i = 1, min(wanted, curves - first + 1)
            table%curve(i) = first + i - 1
            call register%mark(table%curve(i))
         end do
      end associate
      if (any(table%curve == 0)) then
         call catalogue%refuse(cards, "TBID", "the table has "//text(wanted)//" values, but " &
            & //text(count(table%curve > 0))//" curves follow it", &
            & "a *DEFINE_CURVE behind the table for each of its values")
      end if
      call add_table(cards, table, catalogue)
   end subroutine read_define_table

   !> *DEFINE_TABLE_2D: values and their curves
   subroutine read_define_table_2d(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(table_type) :: table
      integer :: i

      allocate (table%curve(cards%sets()))
      do i = 1, size(table%curve)
         call catalogue%find(a_curve, cards, "CURVEID", table%curve(i), i)
      end do
      call add_table(cards, table, catalogue)
   end subroutine read_define_table_2d

   !> Number and values of a table
   subroutine add_table(cards, table, catalogue)
      type(cards_type), intent(in) :: cards
      !> The table without values
      type(table_type), intent(inout) :: table
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i

      call catalogue%define(a_table, cards, "TBID")
      table%value = cards%real("SFA")*([(cards%real("VALUE", i), i=1, cards%sets())] &
         & + cards%real("OFFA"))
      do i = 2, size(table%value)
         if (table%value(i) > table%value(i - 1)) cycle
         call catalogue%refuse(cards, "VALUE", "the value does not increase", &
            & "more than the "//text(table%value(i - 1))//" of the line before", i)
      end do
      catalogue%tables = [catalogue%tables, table]
   end subroutine add_table

   !> A yield curve starts at no plastic strain and is positive
   subroutine check_curve(cards, name, curve, catalogue)
      type(cards_type), intent(in) :: cards
      !> Field that gives the curve
      character(*), intent(in) :: name
      type(curve_type), intent(in) :: curve
      type(catalogue_type), intent(inout) :: catalogue

      if (abs(curve%x(1)) > 0.0_wp) then
         call catalogue%refuse(cards, name, "the yield stress starts at the plastic strain " &
            & //text(curve%x(1)), "a first point at plastic strain 0")
      else if (any(curve%y <= 0.0_wp)) then
         call catalogue%refuse(cards, name, "the yield stress is " &
            & //text(minval(curve%y))//" somewhere", "a yield stress above 0 everywhere")
      end if
   end subroutine check_curve

   !> SIGY where it is needed
   subroutine check_yield(cards, yield, catalogue)
      type(cards_type), intent(in) :: cards
      !> SIGY
      real(wp), intent(in) :: yield
      type(catalogue_type), intent(inout) :: catalogue

      if (yield > 0.0_wp) return
      call catalogue%refuse(cards, "SIGY", "SIGY is missing", &
         & "the yield stress, above 0, or points or a curve, and C 0")
   end subroutine check_yield

   !> The slope beyond yield is below that before
   subroutine check_tangent(cards, tangent, young, catalogue)
      type(cards_type), intent(in) :: cards
      !> ETAN and Young's modulus
      real(wp), intent(in) :: tangent, young
      type(catalogue_type), intent(inout) :: catalogue

      if (tangent < young) return
      call catalogue%refuse(cards, "ETAN", "ETAN cannot be "//text(tangent), &
         & "a slope below Young's modulus E")
   end subroutine check_tangent

   !> A rate has a power
   subroutine check_power(cards, names, rate, power, catalogue)
      type(cards_type), intent(in) :: cards
      !> Fields of the power and of the rate
      character(*), intent(in) :: names(2)
      !> Rate at which the rise is one, and its power
      real(wp), intent(in) :: rate, power
      type(catalogue_type), intent(inout) :: catalogue

      if (rate <= 0.0_wp .and. power > 0.0_wp) call catalogue%warn_idle(cards, names(1), &
         & names(2)//" above 0")
      if (rate <= 0.0_wp .or. power > 0.0_wp) return
      call catalogue%refuse(cards, names(1), names(1)//" is missing", &
         & "the power of the rise with the rate, above 0, or "//names(2) &
         & //" 0 for no effect of the rate")
   end subroutine check_power

   !> The rate that matters is that of effective plastic strain
   subroutine check_formulation(cards, name, catalogue)
      type(cards_type), intent(in) :: cards
      !> Field that makes the rate matter
      character(*), intent(in) :: name
      type(catalogue_type), intent(inout) :: catalogue

      if (cards%real("VP") > half) return
      call catalogue%refuse(cards, "VP", "VP is not 1, and "//name//" makes the rate matter", &
         & "VP 1: the rate of effective plastic strain, not that of strain")
   end subroutine check_formulation

end module plydyn_input_read_metal
