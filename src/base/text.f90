!> Numbers as text, and conversion of case.
module plydyn_base_text
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: duration_text, fixed_text, lower_case, number_of, padded, printable, &
      & text, upper_case

   !> Text of a number
   interface text
      module procedure :: text_of_integer
      module procedure :: text_of_real
   end interface text

   !> Powers of ten of numbers that are written without an exponent
   integer, parameter :: least_power = -3, most_power = 5
   !> Offset between the cases in ASCII
   integer, parameter :: case_shift = iachar("a") - iachar("A")

contains

   !> Text of an integer
   pure function text_of_integer(number) result(string)
      !> Number to write
      integer, intent(in) :: number
      character(:), allocatable :: string
      character(20) :: buffer

      write (buffer, "(i0)") number
      string = trim(buffer)
   end function text_of_integer

   !> Text of a real as people write it, with some significant digits (default 6) and no zeros
   !> behind them: 8, 0.0035, 1e-6; NaN and infinity too
   pure function text_of_real(number, digits) result(string)
      !> Number to write
      real(wp), intent(in) :: number
      !> Significant digits
      integer, intent(in), optional :: digits
      character(:), allocatable :: string
      character(60) :: buffer
      character(16) :: form
      integer :: significant, power

      significant = 6
      if (present(digits)) significant = digits
      if (.not. ieee_is_finite(number)) then
         write (buffer, "(g0)") number
         string = trim(adjustl(buffer))
         return
      else if (is_whole(number)) then
         string = text(nint(number))
         return
      end if
      write (form, "(a,i0,a)") "(es60.", significant - 1, "e4)"
      write (buffer, form) number
      read (buffer(len(buffer) - 4:), *) power
      if (power >= significant - 1 .and. power <= most_power) then
         string = fixed_text(number, 0)
      else if (power >= least_power .and. power <= most_power) then
         string = without_zeros(fixed_text(number, significant - 1 - power))
      else
         string = without_zeros(trim(adjustl(buffer(:len(buffer) - 6))))//"e"//text(power)
      end if
   end function text_of_real

   !> Whether a real is an integer that is printed without an exponent
   pure logical function is_whole(number)
      !> Any finite number
      real(wp), intent(in) :: number

      is_whole = .false.
      if (abs(number) < huge(1)) is_whole = abs(number - anint(number)) <= 0.0_wp
   end function is_whole

   !> Digits without zeros at the end, and without a point that nothing follows
   pure function without_zeros(digits) result(words)
      !> Digits with a point
      character(*), intent(in) :: digits
      character(:), allocatable :: words

      words = digits(:verify(digits, "0", back=.true.))
      if (words(len(words):) == ".") words = words(:len(words) - 1)
   end function without_zeros

   !> Text of a real with some digits after the point and at least one before it; no point for zero
   !> digits
   pure function fixed_text(number, digits) result(string)
      !> Number to write
      real(wp), intent(in) :: number
      !> Digits after the point
      integer, intent(in) :: digits
      character(:), allocatable :: string

      character(range(number) + 20) :: buffer
      character(12) :: form

      write (form, "(a,i0,a)") "(f0.", digits, ")"
      write (buffer, form) abs(number)
      string = trim(buffer)
      if (digits == 0) string = string(:len(string) - 1)
      if (scan(string//".", "0123456789") /= 1) string = "0"//string
      if (number < 0.0_wp) string = "-"//string
   end function fixed_text

   !> A duration as `h:mm:ss`; `-` when it is negative or beyond a year
   pure function duration_text(seconds) result(string)
      !> Seconds
      real(wp), intent(in) :: seconds
      character(:), allocatable :: string

      integer, parameter :: minute = 60, hour = 3600
      real(wp), parameter :: year = 365.0_wp*24.0_wp*hour
      character(10) :: word
      integer :: whole

      string = "-"
      if (seconds < 0.0_wp .or. seconds > year) return
      whole = nint(seconds)
      write (word, "(i0,2(a,i2.2))") whole/hour, ":", mod(whole, hour)/minute, ":", &
         & mod(whole, minute)
      string = trim(word)
   end function duration_text

   !> A number with its noun
   pure function number_of(count, what) result(words)
      !> The number
      integer, intent(in) :: count
      !> Singular of the noun
      character(*), intent(in) :: what
      character(:), allocatable :: words

      words = text(count)//" "//what
      if (count /= 1) words = words//"s"
   end function number_of

   !> The same text in lower case
   pure function lower_case(string) result(lowered)
      !> Any text
      character(*), intent(in) :: string
      character(len(string)) :: lowered
      integer :: i

      lowered = string
      do i = 1, len(string)
         if (string(i:i) >= "A" .and. string(i:i) <= "Z") then
            lowered(i:i) = achar(iachar(string(i:i)) + case_shift)
         end if
      end do
   end function lower_case

   !> A text with question marks for control characters, which could steer a terminal; line feeds
   !> and tabs stay
   pure function printable(string) result(shown)
      !> Any text
      character(*), intent(in) :: string
      character(len(string)) :: shown
      integer :: i

      shown = string
      do i = 1, len(string)
         if (string(i:i) == achar(9) .or. string(i:i) == achar(10)) cycle
         if (string(i:i) < " " .or. string(i:i) == achar(127)) shown(i:i) = "?"
      end do
   end function printable

   !> The same text in upper case
   pure function upper_case(string) result(raised)
      !> Any text
      character(*), intent(in) :: string
      character(len(string)) :: raised
      integer :: i

      raised = string
      do i = 1, len(string)
         if (string(i:i) >= "a" .and. string(i:i) <= "z") then
            raised(i:i) = achar(iachar(string(i:i)) - case_shift)
         end if
      end do
   end function upper_case

   !> Words with blanks behind them: tabulators of formats count from elsewhere in files without
   !> records
   pure function padded(words, width) result(string)
      character(*), intent(in) :: words
      !> Length of the result
      integer, intent(in) :: width
      character(width) :: string

      string = words
   end function padded

end module plydyn_base_text
