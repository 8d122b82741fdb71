!> Numbers: what is one, what is none, and where it goes wrong.
program test_deck_number
   use plydyn_base_precision, only : wp
   use plydyn_deck_number, only : number_advice, read_integer, read_real
   use testing, only : begin, check, finish
   implicit none

   call begin("read_real")
   call check_real("70.0", 70.0_wp)
   call check_real("-1.5e3", -1500.0_wp)
   call check_real("+.5", 0.5_wp)
   call check_real("5.", 5.0_wp)
   call check_real("7", 7.0_wp)
   call check_real("1.0D-3", 1.0e-3_wp)
   call check_real("1.6e-9", 1.6e-9_wp)
   call check_real("0.1", 0.1_wp)
   call check_real("123456789012345678901234567890", 123456789012345678901234567890.0_wp)
   call check_real("0.000000000000000000000000000000012345", 1.2345e-32_wp)
   call check_real("1.7976931348623157e300", 1.7976931348623157e300_wp)
   call check_real("-0.0e999", 0.0_wp)
   call check_wrong("7O.0", 2)
   call check_wrong("1.5+3", 4)
   call check_wrong("1.5e", 5)
   call check_wrong("1.5e+", 6)
   call check_wrong("1.2.3", 4)
   call check_wrong("1 2", 2)
   call check_wrong(".", 2)
   call check_wrong("-", 2)
   call check_wrong("--1", 2)
   call check_wrong("NaN", 1)
   call check_wrong("Infinity", 1)
   call check_wrong("1e999", 1)
   call check_wrong("1e-400", 1)
   call check_wrong("-.01e-400", 1)
   call check_wrong("1.00e-2147483647", 1)
   call check_wrong("1e99999999999", 3)
   call check_wrong("1.00e2147483647", 1)
   call check_wrong("1_wp", 2)

   call begin("read_integer")
   call check_integer("42", 42, 0)
   call check_integer("-7", -7, 0)
   call check_integer("+7", 7, 0)
   call check_integer("2147483647", huge(1), 0)
   call check_integer("2147483648", 0, 1)
   call check_integer("99999999999999999999", 0, 1)
   call check_integer("3.0", 0, 2)
   call check_integer("1e2", 0, 2)
   call check_integer("", 0, 1)
   call check_integer("x", 0, 1)

   call begin("number_advice")
   call check(index(number_advice("7O", 2), "letter O") > 0, "tells O from 0")
   call check(index(number_advice("l0", 1), "letter l") > 0, "tells l from 1")
   call check(number_advice("one", 1) == "", "takes no letter of a word for a digit")
   call check(number_advice("ninety", 1) == "", "nor its beginning for NaN")
   call check(index(number_advice("Inf", 1), "NaN and Inf") > 0, "knows Inf")
   call check(index(number_advice("-nan", 2), "NaN and Inf") > 0, "knows NaN behind a sign")
   call check(index(number_advice("1+3", 2), "exponent needs its letter") > 0, &
      & "asks for the letter")
   call check(index(number_advice("-1e400", 1), "too large") > 0, "sees the size behind a sign")
   call check(index(number_advice("1e-400", 1), "too small") > 0, "sees a small number")
   call check(index(number_advice("-1e-400", 1), "too small") > 0, "sees it behind a sign")
   call check(index(number_advice("0."//repeat("0", 400)//"1", 1), "too small") > 0, &
      & "sees it without an exponent")
   call check(len(number_advice("+x", 2)) == 0, "is silent where the character says it all")

   call finish()

contains

   !> A text that is a number, to the last bit
   subroutine check_real(text, expected)
      !> The text
      character(*), intent(in) :: text
      !> Its value
      real(wp), intent(in) :: expected

      real(wp) :: number
      integer :: wrong_at

      call read_real(text, number, wrong_at)
      call check(wrong_at, 0, text//" is a number")
      call check(number, expected, 0.0_wp, text//" has its value")
   end subroutine check_real

   !> A text that is no number
   subroutine check_wrong(text, expected)
      !> The text
      character(*), intent(in) :: text
      !> Its first wrong character
      integer, intent(in) :: expected

      real(wp) :: number
      integer :: wrong_at

      call read_real(text, number, wrong_at)
      call check(wrong_at, expected, text//" is no number from there on")
   end subroutine check_wrong

   !> A text and the integer that it is or is not
   subroutine check_integer(text, expected, expected_at)
      !> The text
      character(*), intent(in) :: text
      !> Its value
      integer, intent(in) :: expected
      !> Its first wrong character
      integer, intent(in) :: expected_at

      integer :: number, wrong_at

      call read_integer(text, number, wrong_at)
      call check(number, expected, "'"//text//"' has its value")
      call check(wrong_at, expected_at, "'"//text//"' is wrong there")
   end subroutine check_integer

end program test_deck_number
