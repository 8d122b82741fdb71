!> Arithmetic of *PARAMETER_EXPRESSION.
!>
!> Numbers, earlier parameters (with or without &), pi, + - * / ** and parentheses, sqrt, sin, cos,
!> tan (radians), abs, exp, log (natural), min and max. As in Fortran, ** binds to the right and
!> before a sign: -2**2 is -4.
module plydyn_deck_expression
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : lower_case
   use plydyn_deck_number, only : is_digit, read_real
   use plydyn_deck_parameter, only : parameter_table_type
   use plydyn_deck_report, only : fault_type
   implicit none
   private

   public :: evaluate, is_name_part

   real(wp), parameter :: pi = acos(-1.0_wp)
   !> Largest argument of exp without overflow
   real(wp), parameter :: largest_power = log(huge(1.0_wp)) - 1.0_wp
   !> Deepest nesting of parentheses, functions, signs and powers, which bounds the recursion
   integer, parameter :: max_depth = 200

   !> An expression with the position of the scanner
   type :: scan_type
      !> The expression
      character(:), allocatable :: text
      !> Parameters defined so far
      type(parameter_table_type) :: parameters
      !> Next character, and nesting depth of parentheses, functions, signs and powers
      integer :: at = 1, depth = 0
      !> The first error
      type(fault_type) :: fault
   contains
      procedure :: expect
      procedure :: next
      procedure :: pass_blanks
      procedure :: fail_at
   end type scan_type

contains

   !> Value of an expression
   subroutine evaluate(text, parameters, value, fault)
      !> The expression
      character(*), intent(in) :: text
      !> Parameters defined so far
      type(parameter_table_type), intent(in) :: parameters
      !> Its value
      real(wp), intent(out) :: value
      !> The first error
      type(fault_type), intent(out) :: fault

      type(scan_type) :: scan

      scan%text = text
      scan%parameters = parameters
      call read_sum(scan, value)
      call scan%pass_blanks()
      if (scan%at <= len(text)) then
         call scan%fail_at(scan%at, "an operator is missing here", &
            & "+ - * / ** or the end of the expression")
      end if
      fault = scan%fault
   end subroutine evaluate

   !> Terms with + and - between them
   recursive subroutine read_sum(scan, value)
      type(scan_type), intent(inout) :: scan
      real(wp), intent(out) :: value

      real(wp) :: term
      character(1) :: operator

      call read_product(scan, value)
      do
         operator = scan%next()
         if (operator /= "+" .and. operator /= "-") return
         scan%at = scan%at + 1
         call read_product(scan, term)
         if (scan%fault%at > 0) return
         if (max(exponent(value), exponent(term)) >= maxexponent(1.0_wp)) then
            call scan%fail_at(scan%at, "the sum is too large", "numbers below 1e307")
            return
         end if
         if (operator == "-") term = -term
         value = value + term
      end do
   end subroutine read_sum

   !> Factors with * and / between them
   recursive subroutine read_product(scan, value)
      type(scan_type), intent(inout) :: scan
      real(wp), intent(out) :: value

      real(wp) :: factor
      character(1) :: operator
      integer :: begin

      call read_factor(scan, value)
      do
         operator = scan%next()
         if (operator /= "*" .and. operator /= "/") return
         scan%at = scan%at + 1
         begin = scan%at
         call read_factor(scan, factor)
         if (scan%fault%at > 0) return
         if (operator == "/") call invert(scan, begin, factor)
         if (exponent(value) + exponent(factor) > maxexponent(1.0_wp)) then
            call scan%fail_at(begin, "the product is too large", "numbers below 1e307")
            return
         end if
         value = value*factor
      end do
   end subroutine read_product

   !> One over a factor
   subroutine invert(scan, begin, factor)
      type(scan_type), intent(inout) :: scan
      !> Where the factor begins
      integer, intent(in) :: begin
      !> The factor, and its inverse
      real(wp), intent(inout) :: factor

      if (abs(factor) < 2*tiny(1.0_wp)) then
         call scan%fail_at(begin, "the divisor is zero", "a divisor other than zero")
      else
         factor = 1.0_wp/factor
      end if
   end subroutine invert

   !> A factor, unless it is nested too deeply
   recursive subroutine read_factor(scan, value)
      type(scan_type), intent(inout) :: scan
      real(wp), intent(out) :: value

      value = 0.0_wp
      if (scan%depth == max_depth) then
         call scan%fail_at(scan%at, "the expression is nested too deeply", &
            & "parameters for parts of the expression")
      end if
      if (scan%fault%at > 0) return
      scan%depth = scan%depth + 1
      call read_power(scan, value)
      scan%depth = scan%depth - 1
   end subroutine read_factor

   !> A sign and a factor, or a power
   recursive subroutine read_power(scan, value)
      type(scan_type), intent(inout) :: scan
      real(wp), intent(out) :: value

      real(wp) :: power
      character(1) :: sign
      integer :: begin

      sign = scan%next()
      if (sign == "+" .or. sign == "-") then
         scan%at = scan%at + 1
         call read_factor(scan, value)
         if (sign == "-") value = -value
         return
      end if
      begin = scan%at
      call read_primary(scan, value)
      sign = scan%next()
      if (scan%fault%at > 0 .or. scan%at >= len(scan%text)) return
      if (scan%text(scan%at:scan%at + 1) /= "**") return
      scan%at = scan%at + 2
      call read_factor(scan, power)
      if (scan%fault%at == 0) call raise(scan, begin, power, value)
   end subroutine read_power

   !> A number to a power
   subroutine raise(scan, begin, power, value)
      type(scan_type), intent(inout) :: scan
      !> Where the base begins
      integer, intent(in) :: begin
      !> The power
      real(wp), intent(in) :: power
      !> The base, and the result
      real(wp), intent(inout) :: value

      logical :: odd, whole

      whole = abs(power - anint(power)) <= 0.0_wp
      if (abs(value) <= 0.0_wp .and. power <= 0.0_wp) then
         call scan%fail_at(begin, "zero to a power that is not positive", "a base other than zero")
      else if (value < 0.0_wp .and. .not. whole) then
         call scan%fail_at(begin, "a negative number to a fractional power", "an integer power")
      else if (abs(value) <= 0.0_wp) then
         value = 0.0_wp
      else if (power*log(abs(value)) > largest_power) then
         call scan%fail_at(begin, "the power is too large", "numbers below 1e307")
      else
         odd = whole .and. modulo(power, 2.0_wp) > 0.5_wp
         value = merge(-1.0_wp, 1.0_wp, odd .and. value < 0.0_wp)*abs(value)**power
      end if
   end subroutine raise

   !> A number, a name, a function or parentheses
   recursive subroutine read_primary(scan, value)
      type(scan_type), intent(inout) :: scan
      real(wp), intent(out) :: value

      value = 0.0_wp
      if (scan%fault%at > 0) return
      select case (scan%next())
      case ("0":"9", ".")
         call read_number(scan, value)
      case ("(")
         scan%at = scan%at + 1
         call read_sum(scan, value)
         call scan%expect(")")
      case ("a":"z", "A":"Z", "&")
         call read_name(scan, value)
      case default
         call scan%fail_at(scan%at, "a number is missing here", &
            & "a number, an earlier parameter, a function or parentheses")
      end select
   end subroutine read_primary

   !> A number
   subroutine read_number(scan, value)
      type(scan_type), intent(inout) :: scan
      real(wp), intent(out) :: value

      integer :: begin, wrong_at

      begin = scan%at
      do while (scan%at <= len(scan%text))
         associate (c => scan%text(scan%at:scan%at))
            if (.not. (is_digit(c) .or. c == "." .or. is_exponent(scan%text, scan%at, begin))) exit
         end associate
         scan%at = scan%at + 1
      end do
      call read_real(scan%text(begin:scan%at - 1), value, wrong_at)
      if (wrong_at > 0) call scan%fail_at(begin + wrong_at - 1, &
         & "'"//scan%text(begin:scan%at - 1)//"' is not a number", "a number such as 1.5e3")
   end subroutine read_number

   !> Whether a character is the exponent letter of a number, or the sign after it
   pure logical function is_exponent(text, at, begin)
      character(*), intent(in) :: text
      !> The character, and first character of the number
      integer, intent(in) :: at, begin

      is_exponent = at > begin
      if (.not. is_exponent) return
      is_exponent = index("eEdD", text(at:at)) > 0
      if (is_exponent) return
      is_exponent = index("+-", text(at:at)) > 0 .and. index("eEdD", text(at - 1:at - 1)) > 0
   end function is_exponent

   !> A parameter, pi or a function
   recursive subroutine read_name(scan, value)
      type(scan_type), intent(inout) :: scan
      real(wp), intent(out) :: value

      character(:), allocatable :: name
      integer :: begin, i

      if (scan%text(scan%at:scan%at) == "&") scan%at = scan%at + 1
      begin = scan%at
      do while (scan%at <= len(scan%text))
         if (.not. is_name_part(scan%text(scan%at:scan%at))) exit
         scan%at = scan%at + 1
      end do
      name = lower_case(scan%text(begin:scan%at - 1))
      value = 0.0_wp
      i = scan%parameters%find(name)
      if (scan%next() == "(") then
         call read_function(scan, name, begin, value)
      else if (i > 0) then
         value = scan%parameters%list(i)%value
      else if (name == "pi") then
         value = pi
      else
         call scan%fail_at(begin, "there is no parameter '"//name//"' above this line", &
            & scan%parameters%advice(name))
      end if
   end subroutine read_name

   !> A function of one or two arguments
   recursive subroutine read_function(scan, name, begin, value)
      type(scan_type), intent(inout) :: scan
      !> Its name
      character(*), intent(in) :: name
      !> Where the name begins
      integer, intent(in) :: begin
      real(wp), intent(out) :: value

      real(wp) :: first, second

      scan%at = scan%at + 1
      call read_sum(scan, first)
      second = 0.0_wp
      if (name == "min" .or. name == "max") then
         call scan%expect(",")
         call read_sum(scan, second)
      end if
      call scan%expect(")")
      value = 0.0_wp
      if (scan%fault%at > 0) return
      if ((name == "sqrt" .and. first < 0.0_wp) .or. (name == "log" .and. first <= 0.0_wp) &
         & .or. (name == "exp" .and. first > largest_power)) then
         call scan%fail_at(begin, name//" is not defined for this argument", &
            & "an argument within its domain")
         return
      end if
      select case (name)
      case ("sqrt"); value = sqrt(first)
      case ("sin"); value = sin(first)
      case ("cos"); value = cos(first)
      case ("tan"); value = tan(first)
      case ("abs"); value = abs(first)
      case ("exp"); value = exp(first)
      case ("log"); value = log(first)
      case ("min"); value = min(first, second)
      case ("max"); value = max(first, second)
      case default
         call scan%fail_at(begin, "there is no function '"//name//"'", &
            & "sqrt, sin, cos, tan, abs, exp, log, min or max")
      end select
   end subroutine read_function

   !> Whether a character may be part of a name
   elemental logical function is_name_part(c)
      !> Any character
      character(1), intent(in) :: c

      is_name_part = is_digit(c) .or. c == "_" &
         & .or. (lower_case(c) >= "a" .and. lower_case(c) <= "z")
   end function is_name_part

   !> Step over a character that is required next
   subroutine expect(self, mark)
      class(scan_type), intent(inout) :: self
      !> The character
      character(1), intent(in) :: mark

      if (self%next() == mark) then
         self%at = self%at + 1
      else
         call self%fail_at(self%at, "a '"//mark//"' is missing here", "a "//mark)
      end if
   end subroutine expect

   !> Next character that is not blank; a blank at the end and after an error
   character(1) function next(self) result(c)
      class(scan_type), intent(inout) :: self

      call self%pass_blanks()
      c = " "
      if (self%fault%at == 0 .and. self%at <= len(self%text)) c = self%text(self%at:self%at)
   end function next

   !> Step over blanks
   subroutine pass_blanks(self)
      class(scan_type), intent(inout) :: self

      do while (self%at <= len(self%text))
         if (self%text(self%at:self%at) /= " ") return
         self%at = self%at + 1
      end do
   end subroutine pass_blanks

   !> Record an error unless there is one already
   subroutine fail_at(self, at, wrong, right)
      class(scan_type), intent(inout) :: self
      !> The wrong character
      integer, intent(in) :: at
      !> What is wrong, and what would be right
      character(*), intent(in) :: wrong, right

      if (self%fault%at == 0) call self%fault%set(at, wrong, right)
   end subroutine fail_at

end module plydyn_deck_expression
