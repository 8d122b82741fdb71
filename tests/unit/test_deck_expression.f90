!> Arithmetic gives what a calculator gives, or says where it stops.
program test_deck_expression
   use plydyn_base_precision, only : wp
   use plydyn_deck_expression, only : evaluate
   use plydyn_deck_parameter, only : parameter_table_type, parameter_type
   use plydyn_deck_report, only : fault_type
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: pi = acos(-1.0_wp)
   type(parameter_table_type) :: table

   call table%add(parameter_type("thick", 0.125_wp))
   call table%add(parameter_type("plies", 8.0_wp))

   call begin("evaluate")
   call check_value("1.0", 1.0_wp)
   call check_value("1 + 2*3", 7.0_wp)
   call check_value("(1 + 2)*3", 9.0_wp)
   call check_value("10 - 4 - 3", 3.0_wp)
   call check_value("16/4/2", 2.0_wp)
   call check_value("7/2", 3.5_wp)
   call check_value("2**3**2", 512.0_wp)
   call check_value("-2**2", -4.0_wp)
   call check_value("2**-1", 0.5_wp)
   call check_value("(-2)**3", -8.0_wp)
   call check_value("1.5e2 + 1E-1", 150.1_wp)
   call check_value("&thick*plies", 1.0_wp)
   call check_value("THICK*2", 0.25_wp)
   call check_value("sqrt(16.0)", 4.0_wp)
   call check_value("sin(pi/2) + cos(0) + tan(0)", 2.0_wp)
   call check_value("abs(-3) + min(1, 2) + max(1, 2)", 6.0_wp)
   call check_value("exp(log(5))", 5.0_wp)
   call check_value("2*pi", 2.0_wp*pi)
   call check_value("sqrt( min( plies , 4 ) )", 2.0_wp)
   call check_value("0**2", 0.0_wp)
   call check_value(repeat("(", 150)//"7"//repeat(")", 150), 7.0_wp)

   call begin("evaluate, errors")
   call check_wrong("1 +", 4, "a number is missing")
   call check_wrong("2*(1 + 3", 9, "')' is missing")
   call check_wrong(repeat("(", 30000)//"1", 201, "the expression is nested too deeply")
   call check_wrong(repeat("-", 30000)//"1", 201, "the expression is nested too deeply")
   call check_wrong("1 2", 3, "an operator is missing")
   call check_wrong("", 1, "a number is missing")
   call check_wrong("3*thik", 3, "no parameter 'thik'")
   call check_wrong("cosh(1)", 1, "no function 'cosh'")
   call check_wrong("1/(2 - 2)", 3, "divisor is zero")
   call check_wrong("sqrt(-1)", 1, "not defined")
   call check_wrong("log(0)", 1, "not defined")
   call check_wrong("exp(1000)", 1, "not defined")
   call check_wrong("(-8)**0.5", 1, "fractional power")
   call check_wrong("0**(-1)", 1, "zero to a power")
   call check_wrong("10**400", 1, "too large")
   call check_wrong("1e200*1e200", 7, "too large")
   call check_wrong("1.2.3", 4, "not a number")
   call check_wrong("min(1)", 6, "',' is missing")
   call check_wrong("1 # 2", 3, "an operator is missing")

   call finish()

contains

   !> An expression and its value
   subroutine check_value(text, expected)
      !> The expression
      character(*), intent(in) :: text
      !> Its value
      real(wp), intent(in) :: expected

      type(fault_type) :: fault
      real(wp) :: value

      call evaluate(text, table, value, fault)
      call check(fault%at, 0, text//" is an expression")
      call check(value, expected, 4.0_wp*epsilon(1.0_wp)*max(abs(expected), 1.0_wp), text)
   end subroutine check_value

   !> An expression that stops
   subroutine check_wrong(text, at, fragment)
      !> The expression
      character(*), intent(in) :: text
      !> Where it stops
      integer, intent(in) :: at
      !> What the message must say
      character(*), intent(in) :: fragment

      type(fault_type) :: fault
      real(wp) :: value

      call evaluate(text, table, value, fault)
      call check(fault%at, at, "'"//text//"' stops there")
      if (fault%at > 0) call check(index(fault%wrong, fragment) > 0, "'"//text//"' says '" &
         & //fragment//"', not '"//fault%wrong//"'")
   end subroutine check_wrong

end program test_deck_expression
