!> Keywords of metals, and of the tables that they refer to.
module plydyn_input_declare_metal
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : keyword_type, new_keyword, standard
   use plydyn_input_declare_part, only : add_isotropic_card
   implicit none
   private

   public :: mat_plastic_kinematic, mat_piecewise_linear_plasticity, &
      & mat_simplified_johnson_cook, define_table, define_table_2d

   !> Points of a yield curve on the cards of the material
   integer, parameter, public :: card_points = 8
   !> Columns of the value and the curve of a table
   integer, parameter :: table_width = 20
   !> Strain at which LS-DYNA's metals fail by default: never
   real(wp), parameter :: never_fails(3) = [0.0_wp, 1.0e17_wp, 1.0e21_wp]
   !> Bound of stress that is none
   real(wp), parameter :: no_bound(2) = [0.0_wp, 1.0e28_wp]

contains

   !> Metal with linear hardening
   function mat_plastic_kinematic() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("MAT_PLASTIC_KINEMATIC", standard, &
         & "Metal that yields by von Mises with linear hardening.", suffixes="TITLE", &
         & alias="MAT_003")
      keyword%remark = "ETAN 0 is perfect plasticity. With a rate, the yield stress is " &
         & //"multiplied by 1 + (rate/SRC)**(1/SRP), the rate being that of effective " &
         & //"plastic strain."
      call add_isotropic_card(keyword)
      call keyword%add_real("SIGY", "stress", "yield stress", above=0.0_wp)
      call keyword%add_nonnegative("ETAN", "stress", "slope of stress over strain beyond yield")
      call keyword%add_real("BETA", "-", "share of hardening that is isotropic: 1 isotropic, " &
         & //"0 kinematic", default=0.0_wp, least=0.0_wp, most=1.0_wp)
      call keyword%add_card(optional=.true.)
      call keyword%add_nonnegative("SRC", "1/time", "rate at which the yield stress is doubled; " &
         & //"0 for no effect of the rate")
      call keyword%add_nonnegative("SRP", "-", "power of the rise with the rate")
      call keyword%add_unused("FS")
      call keyword%add_real("VP", "-", "0 or 1, without difference: the rate is that of " &
         & //"effective plastic strain", default=0.0_wp, least=0.0_wp, most=1.0_wp)
   end function mat_plastic_kinematic

   !> Metal with a yield stress by points, curve or table
   function mat_piecewise_linear_plasticity() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("MAT_PIECEWISE_LINEAR_PLASTICITY", standard, &
         & "Metal that yields by von Mises with a yield stress by points, curve or table.", &
         & suffixes="TITLE", alias="MAT_024")
      keyword%remark = "The yield stress over effective plastic strain comes from the curve " &
         & //"LCSS, one for each rate where LCSS is a table; without LCSS from the points EPS, " &
         & //"ES; without these from SIGY and ETAN. It is straight between points and goes on " &
         & //"past the last one as it ended, but not down; beyond the rates of a table the " &
         & //"nearest curve holds. A table whose first value is below 0 has the natural " &
         & //"logarithms of its rates. With C and P, SIGY (rate/C)**(1/P) is added. The rate is " &
         & //"that of effective plastic strain, so VP must be 1 where rates matter."
      call add_isotropic_card(keyword)
      call keyword%add_nonnegative("SIGY", "stress", "yield stress, where no points and no " &
         & //"curve give it, and the stress that rises with C and P")
      call keyword%add_nonnegative("ETAN", "stress", "slope of stress over strain beyond yield")
      call keyword%add_unused("FAIL", neutral=never_fails)
      call keyword%add_unused("TDEL")
      call keyword%add_card(optional=.true.)
      call keyword%add_nonnegative("C", "1/time", "rate at which the rise is SIGY; 0 for none")
      call keyword%add_nonnegative("P", "-", "power of the rise with the rate")
      call keyword%add_integer("LCSS", "curve of yield stress over effective plastic strain, or " &
         & //"table of curves over rates; 0 for none", default=0, least=0)
      call keyword%add_unused("LCSR")
      call keyword%add_real("VP", "-", "1: the rate is that of effective plastic strain; 0 where " &
         & //"no rate matters", default=0.0_wp, least=0.0_wp, most=1.0_wp)
      call keyword%add_unused("LCF")
      call add_points(keyword, "EPS", "-", "effective plastic strain of a point, the first 0")
      call add_points(keyword, "ES", "stress", "yield stress of a point")
   end function mat_piecewise_linear_plasticity

   !> A card with one number for each point of a yield curve
   subroutine add_points(keyword, name, dimension, sentence)
      type(keyword_type), intent(inout) :: keyword
      !> Name without number, and dimension of the number
      character(*), intent(in) :: name, dimension
      !> What it means
      character(*), intent(in) :: sentence

      integer :: i

      call keyword%add_card(optional=.true.)
      do i = 1, card_points
         call keyword%add_nonnegative(name//achar(iachar("0") + i), dimension, sentence)
      end do
   end subroutine add_points

   !> Metal with the yield stress of Johnson and Cook
   function mat_simplified_johnson_cook() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("MAT_SIMPLIFIED_JOHNSON_COOK", standard, &
         & "Metal that yields by von Mises with Johnson and Cook's yield stress, without " &
         & //"temperature.", suffixes="TITLE", alias="MAT_098")
      keyword%remark = "The yield stress is (A + B p**N) (1 + C ln(rate/EPSO)) with the " &
         & //"effective plastic strain p; below the rate EPSO the rate is without effect. The " &
         & //"rate is that of effective plastic strain, so VP must be 1 where C is not 0."
      call add_isotropic_card(keyword)
      call keyword%add_real("VP", "-", "1: the rate is that of effective plastic strain; 0 where " &
         & //"no rate matters", default=0.0_wp, least=0.0_wp, most=1.0_wp)
      call keyword%add_card()
      call keyword%add_real("A", "stress", "yield stress without plastic strain", above=0.0_wp)
      call keyword%add_nonnegative("B", "stress", "rise of the yield stress up to a plastic " &
         & //"strain of 1")
      call keyword%add_nonnegative("N", "-", "power of plastic strain")
      call keyword%add_nonnegative("C", "-", "rise with the logarithm of the rate; 0 for none")
      call keyword%add_unused("PSFAIL", neutral=never_fails)
      call keyword%add_unused("SIGMAX SIGSAT", neutral=no_bound)
      call keyword%add_real("EPSO", "1/time", "rate from which on the yield stress rises", &
         & default=1.0_wp, least=0.0_wp)
      call keyword%zero_is_default()
   end function mat_simplified_johnson_cook

   !> A table whose curves follow
   function define_table() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("DEFINE_TABLE", standard, &
         & "A curve for each of some values; the curves follow the table in the deck.", &
         & suffixes="TITLE")
      keyword%remark = "The first *DEFINE_CURVE behind the table belongs to its first value, the " &
         & //"next to its second, and so on. The values are SFA (VALUE + OFFA)."
      call add_table_cards(keyword)
   end function define_table

   !> A table that names its curves
   function define_table_2d() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("DEFINE_TABLE_2D", standard, &
         & "A curve for each of some values, by the numbers of the curves.", suffixes="TITLE")
      keyword%remark = "The values are SFA (VALUE + OFFA)."
      call add_table_cards(keyword)
      call keyword%add_integer("CURVEID", "curve of this value", least=1)
   end function define_table_2d

   !> First card of a table, and its values
   subroutine add_table_cards(keyword)
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_integer("TBID", "number of the table, none that a curve has", least=1)
      call keyword%add_real("SFA", "-", "factor on the values", default=1.0_wp)
      call keyword%zero_is_default()
      call keyword%add_real("OFFA", "any", "offset of the values", default=0.0_wp)
      keyword%width = table_width
      call keyword%add_card(repeated=.true.)
      call keyword%add_real("VALUE", "any", "value, increasing from line to line")
   end subroutine add_table_cards

end module plydyn_input_declare_metal
