!> Large arrays lie where the arrays of the domain expect them.
program test_base_memory
   use, intrinsic :: iso_c_binding, only : c_intptr_t, c_loc
   use plydyn_base_memory, only : keep_arrays_on_pages, prefer_large_pages
   use plydyn_base_precision, only : wp
   use plydyn_fem_columns, only : alignment_offset
   use testing, only : begin, check, finish
   implicit none

   !> Bytes of a line of the cache, and of a number
   integer, parameter :: line = 64, bytes = 8
   !> Numbers in an array of 160 kB, and in one of 16 MB, of which the C library learns
   integer, parameter :: middle = 20000, huge_one = 2000000

   call check_columns()
   call check_large_pages()
   call finish()

contains

   !> The first number behind the offset begins a line, after a larger array was given back, too
   subroutine check_columns()
      real(wp), allocatable, target :: array(:), larger(:)
      integer(c_intptr_t) :: address

      call begin("keep_arrays_on_pages")
      call keep_arrays_on_pages()
      allocate (larger(huge_one), source=1.0_wp)
      call check(sum(larger), real(huge_one, wp), 1.0e-9_wp, "the larger array is used")
      deallocate (larger)
      allocate (array(middle), source=1.0_wp)
      address = transfer(c_loc(array(1)), address) + alignment_offset*bytes
      call check(int(modulo(address, int(line, c_intptr_t))), 0, "columns begin on a line")
   end subroutine check_columns

   !> Numbers stay where they are and what they are, on large pages or without
   subroutine check_large_pages()
      real(wp), allocatable, target :: array(:)
      integer(c_intptr_t) :: address
      integer :: i

      call begin("prefer_large_pages")
      allocate (array(huge_one))
      do i = 1, huge_one
         array(i) = real(i, wp)
      end do
      address = transfer(c_loc(array(1)), address)
      call prefer_large_pages(array)
      call check(address == transfer(c_loc(array(1)), address), "they stay where they are")
      call check(count_right(array), huge_one, "and what they are")
      call prefer_large_pages(array(:0))
   end subroutine check_large_pages

   !> How many numbers are those of their places
   pure integer function count_right(array)
      real(wp), intent(in) :: array(:)
      integer :: i

      count_right = 0
      do i = 1, size(array)
         if (nint(array(i)) == i) count_right = count_right + 1
      end do
   end function count_right

end program test_base_memory
