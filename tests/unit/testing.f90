!> Checks of the unit tests: each names what must hold, `finish` counts and decides the exit.
!>
!> The only module of the project with variables: a test program is one process that counts once. It
!> writes its files beside itself, into the build, whatever folder it is started from.
module testing
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_null_char
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   implicit none
   private

   public :: begin, check, check_error, finish, write_lines

   !> A value against what it must be, or a condition that must hold
   interface check
      module procedure :: check_condition
      module procedure :: check_integer
      module procedure :: check_real
      module procedure :: check_reals
   end interface check

   !> POSIX: go to a folder
   interface
      function c_chdir(path) bind(C, name="chdir") result(status)
         import :: c_char, c_int
         implicit none
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int) :: status
      end function c_chdir
   end interface

   !> Significant digits of the values in a message
   integer, parameter :: digits_shown = 15

   !> Checks so far
   integer :: passed = 0, failed = 0
   !> What is being tested
   character(:), allocatable :: subject

contains

   !> Name what the next checks are about
   subroutine begin(name)
      !> Procedure or phenomenon under test
      character(*), intent(in) :: name

      if (.not. allocated(subject)) then
         subject = "test"
         call enter_own_folder()
      end if
      subject = name
   end subroutine begin

   !> Go to the folder of the program
   subroutine enter_own_folder()
      character(:), allocatable :: path
      integer :: length, slash

      call get_command_argument(0, length=length)
      allocate (character(length) :: path)
      call get_command_argument(0, path)
      slash = index(path, "/", back=.true.)
      if (slash == 0) return
      call record(c_chdir(path(:slash)//c_null_char) == 0, "the folder of the program", &
         & "cannot be entered")
   end subroutine enter_own_folder

   !> A condition that must hold
   subroutine check_condition(condition, what)
      !> True when all is well
      logical, intent(in) :: condition
      !> What must hold
      character(*), intent(in) :: what

      call record(condition, what, "does not hold")
   end subroutine check_condition

   !> An integer that must equal another
   subroutine check_integer(value, expected, what)
      !> What was computed
      integer, intent(in) :: value
      !> What it must be
      integer, intent(in) :: expected
      !> What must hold
      character(*), intent(in) :: what

      call record(value == expected, what, "is "//text(value)//", must be "//text(expected))
   end subroutine check_integer

   !> A real that must be within a distance of another
   subroutine check_real(value, expected, tolerance, what)
      !> What was computed
      real(wp), intent(in) :: value
      !> What it must be
      real(wp), intent(in) :: expected
      !> Largest distance allowed, absolute
      real(wp), intent(in) :: tolerance
      !> What must hold
      character(*), intent(in) :: what

      call record(abs(value - expected) <= tolerance, what, &
         & difference(value, expected, tolerance))
   end subroutine check_real

   !> Reals that must each be within a distance of others; the first that is not is reported
   subroutine check_reals(value, expected, tolerance, what)
      !> What was computed
      real(wp), intent(in) :: value(:)
      !> What it must be, as many
      real(wp), intent(in) :: expected(:)
      !> Largest distance allowed, absolute
      real(wp), intent(in) :: tolerance
      !> What must hold
      character(*), intent(in) :: what

      integer :: i

      if (size(value) /= size(expected)) then
         call record(.false., what, "has "//text(size(value))//" values, must have " &
            & //text(size(expected)))
         return
      end if
      do i = 1, size(value)
         if (.not. abs(value(i) - expected(i)) <= tolerance) then
            call record(.false., what, &
               & "("//text(i)//") "//difference(value(i), expected(i), tolerance))
            return
         end if
      end do
      call record(.true., what, "")
   end subroutine check_reals

   !> An error that must have been made, with words that tell the user what is wrong
   subroutine check_error(error, fragment, what)
      !> What a procedure gave back
      type(error_type), intent(in), allocatable :: error
      !> Part of the message
      character(*), intent(in) :: fragment
      !> What must hold
      character(*), intent(in) :: what

      if (.not. allocated(error)) then
         call record(.false., what, "gives no error, must say '"//fragment//"'")
      else if (.not. allocated(error%message)) then
         call record(.false., what, "gives no message, must say '"//fragment//"'")
      else
         call record(index(error%message, fragment) > 0, what, &
            & "says '"//error%message//"', must say '"//fragment//"'")
      end if
   end subroutine check_error

   !> Write a file whose lines are parted by bars
   subroutine write_lines(path, text)
      !> Path of the file; one that was there is replaced
      character(*), intent(in) :: path
      !> What is in it, with a bar for each end of a line
      character(*), intent(in) :: text

      integer :: i, unit

      open (newunit=unit, file=path, access="stream", form="unformatted", status="replace", &
         & action="write")
      do i = 1, len(text)
         write (unit) merge(new_line(text), text(i:i), text(i:i) == "|")
      end do
      close (unit)
   end subroutine write_lines

   !> Print the count; the program ends here when a check failed
   subroutine finish()
      write (*, "(a)") text(passed)//" passed, "//text(failed)//" failed"
      if (failed > 0) error stop 1
   end subroutine finish

   !> Count one check and tell when it failed
   subroutine record(holds, what, how)
      !> True when all is well
      logical, intent(in) :: holds
      !> What must hold
      character(*), intent(in) :: what
      !> How it fails, with the values
      character(*), intent(in) :: how

      if (holds) then
         passed = passed + 1
         return
      end if
      failed = failed + 1
      if (.not. allocated(subject)) subject = "test"
      write (*, "(a)") "FAILED "//subject//": "//what//": "//how
   end subroutine record

   !> The words for two reals that are too far apart
   function difference(value, expected, tolerance) result(words)
      !> What was computed
      real(wp), intent(in) :: value
      !> What it must be
      real(wp), intent(in) :: expected
      !> Largest distance allowed
      real(wp), intent(in) :: tolerance
      character(:), allocatable :: words

      words = "is "//text(value, digits_shown)//", must be "//text(expected, digits_shown) &
         & //" within "//text(tolerance)
   end function difference

end module testing
