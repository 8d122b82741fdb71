!> Parsing of numbers: the whole text must be a number, else the first wrong character is reported.
!>
!> An exponent needs its letter (e, E, d or D): `1.5e+3`. The short form `1.5+3` of some writers is
!> refused, because it reads as a sum.
module plydyn_deck_number
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : lower_case
   implicit none
   private

   public :: read_integer, read_real, is_digit, number_advice

   !> Number of decimal digits that always fits an `int64`
   integer, parameter :: most_digits = 18
   !> Powers of ten that are exact in double precision
   integer, parameter :: exact_power = 22
   !> Integers up to here are exact in double precision
   integer(int64), parameter :: exact_integer = 2_int64**53
   !> Decimal exponent of the largest number that is accepted
   integer, parameter :: largest_exponent = 307
   !> Larger exponents are replaced by this one, so that sums with it do not overflow
   integer, parameter :: most_exponent = 10**6
   !> The exact powers of ten
   real(wp), parameter :: ten_to(0:exact_power) = [1.0e0_wp, 1.0e1_wp, 1.0e2_wp, 1.0e3_wp, &
      & 1.0e4_wp, 1.0e5_wp, 1.0e6_wp, 1.0e7_wp, 1.0e8_wp, 1.0e9_wp, 1.0e10_wp, 1.0e11_wp, &
      & 1.0e12_wp, 1.0e13_wp, 1.0e14_wp, 1.0e15_wp, 1.0e16_wp, 1.0e17_wp, 1.0e18_wp, &
      & 1.0e19_wp, 1.0e20_wp, 1.0e21_wp, 1.0e22_wp]

contains

   !> Parse an integer
   pure subroutine read_integer(text, number, wrong_at)
      !> Text without blanks around it
      character(*), intent(in) :: text
      !> The integer; zero when the text is not one
      integer, intent(out) :: number
      !> First character that is wrong; 0 when all is well, 1 when the integer is too large
      integer, intent(out) :: wrong_at

      integer(int64) :: magnitude
      integer :: at, first

      number = 0
      at = 1
      call pass_sign(text, at)
      first = at
      call pass_digits(text, at)
      wrong_at = at
      if (at == first .or. at <= len(text)) return
      wrong_at = 1
      if (at - first > most_digits) return
      magnitude = digits_value(text(first:))
      if (magnitude > huge(number)) return
      wrong_at = 0
      number = int(magnitude)
      if (text(1:1) == "-") number = -number
   end subroutine read_integer

   !> Parse a real number
   pure subroutine read_real(text, number, wrong_at)
      !> Text without blanks around it
      character(*), intent(in) :: text
      !> The number; zero when the text is not one
      real(wp), intent(out) :: number
      !> First character that is wrong; 0 when all is well, 1 when the number is too large or so
      !> small that nothing would be left of it
      integer, intent(out) :: wrong_at

      integer :: at, exponent, mantissa_end, point

      number = 0.0_wp
      exponent = 0
      at = 1
      call pass_mantissa(text, at, point, wrong_at)
      if (wrong_at > 0) return
      mantissa_end = at - 1
      if (at <= len(text)) then
         wrong_at = at
         if (index("eEdD", text(at:at)) == 0) return
         call read_integer(text(at + 1:), exponent, wrong_at)
         if (wrong_at > 0) then
            wrong_at = at + wrong_at
            return
         end if
      end if
      exponent = max(-most_exponent, min(most_exponent, exponent))
      call convert(text(:mantissa_end), point, exponent, number, wrong_at)
   end subroutine read_real

   !> Advice on the first wrong character of a number; empty if there is none to give
   pure function number_advice(text, wrong_at) result(advice)
      !> Text that is not a number
      character(*), intent(in) :: text
      !> Its first wrong character
      integer, intent(in) :: wrong_at
      character(:), allocatable :: advice

      advice = ""
      if (wrong_at > len(text)) then
         advice = "the number is incomplete"
         return
      end if
      if (any(lower_case(text(wrong_at:)) == [character(8) :: "nan", "inf", "infinity"])) then
         advice = "NaN and Inf are not accepted"
         return
      end if
      select case (text(wrong_at:wrong_at))
      case ("O", "o", "l", "I")
         ! not in a word
         if (verify(text, "0123456789+-.eEdDOolI") > 0) return
         advice = "the letter "//text(wrong_at:wrong_at)//" is not the digit " &
            & //merge("0", "1", scan(text(wrong_at:wrong_at), "Oo") > 0)
      case ("+", "-")
         advice = "an exponent needs its letter, as in 1.5e+3"
         if (wrong_at == 1) advice = merge("it is too small", "it is too large", is_small(text))
      case (" ")
         advice = "each number within its columns, or commas between numbers"
      case ("0":"9", ".")
         advice = merge("it is too small", "it is too large", is_small(text))
      case default
         advice = ""
      end select
   end function number_advice

   !> Whether a number has a negative exponent, or no digits but 0 before its point
   pure logical function is_small(text)
      character(*), intent(in) :: text

      integer :: letter

      letter = scan(text, "eEdD")
      if (letter > 0) then
         is_small = index(text(letter:), "-") == 2
      else
         is_small = index(text, ".") > 0 .and. verify(text(:index(text, ".")), "+-0.") == 0
      end if
   end function is_small

   !> Whether a character is a decimal digit
   elemental logical function is_digit(character)
      !> Any character
      character(1), intent(in) :: character

      is_digit = character >= "0" .and. character <= "9"
   end function is_digit

   !> Step over sign, digits and point
   pure subroutine pass_mantissa(text, at, point, wrong_at)
      character(*), intent(in) :: text
      !> First character in, first character after them out
      integer, intent(inout) :: at
      !> Number of digits after the point; first character that is wrong, 0 when all is well
      integer, intent(out) :: point, wrong_at

      integer :: digits, first

      point = 0
      wrong_at = 0
      call pass_sign(text, at)
      first = at
      call pass_digits(text, at)
      digits = at - first
      if (at <= len(text)) then
         if (text(at:at) == ".") then
            at = at + 1
            first = at
            call pass_digits(text, at)
            point = at - first
         end if
      end if
      if (digits + point == 0) wrong_at = at
   end subroutine pass_mantissa

   !> Mantissa times a power of ten, correctly rounded
   pure subroutine convert(mantissa, point, exponent, number, wrong_at)
      !> Sign, digits and point
      character(*), intent(in) :: mantissa
      !> Number of digits after the point, and power of ten
      integer, intent(in) :: point, exponent
      real(wp), intent(out) :: number
      !> 1 when the number is too large or nothing is left of it, else 0
      integer, intent(out) :: wrong_at

      character(len(mantissa) + 16) :: buffer
      integer(int64) :: digits
      integer :: power

      number = 0.0_wp
      wrong_at = 0
      power = exponent - point
      digits = digits_value(mantissa)
      if (digits == 0) return
      if (digits <= exact_integer .and. abs(power) <= exact_power) then
         if (power >= 0) number = real(digits, wp)*ten_to(power)
         if (power < 0) number = real(digits, wp)/ten_to(-power)
         if (mantissa(1:1) == "-") number = -number
      else if (len(mantissa) - point + exponent > largest_exponent) then
         wrong_at = 1
      else
         ! many digits, or a large exponent
         write (buffer, "(a,a,i0)") mantissa, "e", exponent
         read (buffer, *) number
         if (abs(number) <= 0.0_wp) wrong_at = 1
      end if
   end subroutine convert

   !> Integer of the digits of a text, without signs and points
   pure function digits_value(text) result(total)
      character(*), intent(in) :: text
      integer(int64) :: total

      integer :: i

      total = 0
      do i = 1, len(text)
         if (.not. is_digit(text(i:i))) cycle
         if (total > exact_integer) return
         total = 10*total + iachar(text(i:i)) - iachar("0")
      end do
   end function digits_value

   !> Step over one sign
   pure subroutine pass_sign(text, at)
      character(*), intent(in) :: text
      !> First character in, first character after them out
      integer, intent(inout) :: at

      if (at > len(text)) return
      if (text(at:at) == "+" .or. text(at:at) == "-") at = at + 1
   end subroutine pass_sign

   !> Step over digits
   pure subroutine pass_digits(text, at)
      character(*), intent(in) :: text
      !> First character in, first character after them out
      integer, intent(inout) :: at

      do while (at <= len(text))
         if (.not. is_digit(text(at:at))) return
         at = at + 1
      end do
   end subroutine pass_digits

end module plydyn_deck_number
