!> Sums by which a file tells whether its numbers are still those that were written.
!>
!> The bits of each number are turned by its place and cut in two, and both halves are added up. So
!> one wrong bit is found wherever it is, most exchanges are, and bands of an array may be summed by
!> themselves. Arrays have fewer than 2**31 numbers: no sum overflows.
module plydyn_io_checkpoint_check_sum
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: sum_text, sums_of

   !> Name of the attribute that has the sums
   character(*), parameter, public :: sum_name = "check sum"
   !> Bits of a number, and of half of one
   integer, parameter :: all_bits = 64, half_bits = 32

   !> Sums of an array, of integers, or of a text
   interface sums_of
      module procedure sums_of_reals, sums_of_integers, sums_of_text
   end interface sums_of

contains

   !> Sums of a band of an array
   pure function sums_of_reals(values, before) result(sums)
      !> The band
      real(wp), intent(in) :: values(:)
      !> Numbers of the array before it
      integer, intent(in) :: before
      !> Of the halves; those of all bands together are those of the array
      integer(int64) :: sums(2)

      integer :: i

      sums(:) = 0
      do i = 1, size(values)
         call add(transfer(values(i), 0_int64), before + i, sums)
      end do
   end function sums_of_reals

   !> Sums of an array of integers
   pure function sums_of_integers(values) result(sums)
      !> The array
      integer, intent(in) :: values(:)
      integer(int64) :: sums(2)

      integer :: i

      sums(:) = 0
      do i = 1, size(values)
         call add(int(values(i), int64), i, sums)
      end do
   end function sums_of_integers

   !> Sums of a text
   pure function sums_of_text(content) result(sums)
      !> The text
      character(*), intent(in) :: content
      integer(int64) :: sums(2)

      integer :: i

      sums(:) = 0
      do i = 1, len(content)
         call add(int(ichar(content(i:i)), int64), i, sums)
      end do
   end function sums_of_text

   !> Add a number at a place
   pure subroutine add(bits, place, sums)
      integer(int64), intent(in) :: bits
      integer, intent(in) :: place
      integer(int64), intent(inout) :: sums(2)

      integer(int64) :: turned

      turned = ishftc(bits, modulo(place, all_bits))
      sums(1) = sums(1) + ibits(turned, 0, half_bits)
      sums(2) = sums(2) + ibits(turned, half_bits, half_bits)
   end subroutine add

   !> Sums as the file has them
   pure function sum_text(sums) result(words)
      !> As from `sums_of`
      integer(int64), intent(in) :: sums(2)
      character(32) :: words

      write (words, "(2z16.16)") sums
   end function sum_text

end module plydyn_io_checkpoint_check_sum
