!> Numbers as text, and conversion of case.
module plydyn_base_text
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: text, fixed_text, lower_case, printable, upper_case

   !> Text of a number
   interface text
      module procedure :: text_of_integer
      module procedure :: text_of_real
   end interface text

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

   !> Text of a real with some significant digits (default 6)
   pure function text_of_real(number, digits) result(string)
      !> Number to write
      real(wp), intent(in) :: number
      !> Significant digits
      integer, intent(in), optional :: digits
      character(:), allocatable :: string
      character(40) :: buffer
      character(12) :: form
      integer :: significant

      significant = 6
      if (present(digits)) significant = digits
      write (form, "(a,i0,a)") "(g0.", significant, ")"
      write (buffer, form) number
      string = trim(adjustl(buffer))
      ! no point that nothing follows
      if (string(len(string):) == ".") string = string(:len(string) - 1)
   end function text_of_real

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

end module plydyn_base_text
