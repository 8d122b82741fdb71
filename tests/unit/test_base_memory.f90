!> Large arrays lie where the arrays of the domain expect them, and pages of zeros take no memory.
program test_base_memory
   use, intrinsic :: iso_c_binding, only : c_intptr_t, c_loc
   use plydyn_base_memory, only : clear_pages, copy_pages, keep_arrays_on_pages, &
      & prefer_large_pages, release_clear_pages
   use plydyn_base_precision, only : wp
   use plydyn_fem_columns, only : alignment_offset
   use testing, only : begin, check, finish
   implicit none

   !> Bytes of a line of the cache, and of a number
   integer, parameter :: line = 64, bytes = 8
   !> Numbers on a small page
   integer, parameter :: on_page = 512
   !> Numbers in an array of 160 kB, and in one of 16 MB, of which the C library learns
   integer, parameter :: middle = 20000, huge_one = 4000*on_page

   call check_columns()
   call check_large_pages()
   call check_clear_pages()
   call check_small_arrays()
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

   !> An array of zeros takes memory for the pages on which something is written, and so does its
   !> copy; zeros that are written are given back
   subroutine check_clear_pages()
      real(wp), allocatable :: array(:), copy(:)
      integer :: before

      call begin("clear_pages")
      allocate (array(huge_one), source=1.0_wp)
      ! what is called first brings pages of the program with it
      call copy_pages(array, copy)
      before = resident_pages()
      before = resident_pages()
      call clear_pages(array)
      call check(before - resident_pages() >= huge_one/on_page - 1, "all pages are given back")
      call check(maxval(abs(array)), 0.0_wp, 0.0_wp, "and zero")
      before = resident_pages()
      array(1:huge_one:huge_one/10) = 1.0_wp
      call check(resident_pages() - before <= 11, "each number brings one page back")
      call begin("copy_pages")
      before = resident_pages()
      array(2) = -0.0_wp
      call copy_pages(array, copy)
      call check(resident_pages() - before <= 12, "a copy has the pages that are not zero")
      call check(all(transfer(array, [0_c_intptr_t]) == transfer(copy, [0_c_intptr_t])), &
         & "and the same bits")
      call begin("release_clear_pages")
      copy(:) = 0.0_wp
      copy(huge_one/2) = 1.0_wp
      before = resident_pages()
      call release_clear_pages(copy)
      call check(before - resident_pages() >= huge_one/on_page - 4, "pages of zeros are given back")
      call check(sum(copy), 1.0_wp, 0.0_wp, "a number stays")
      call check(copy(huge_one/2), 1.0_wp, 0.0_wp, "in its place")
   end subroutine check_clear_pages

   !> Arrays of less than a large page, and none
   subroutine check_small_arrays()
      real(wp), allocatable :: array(:), copy(:)

      call begin("clear_pages of small arrays")
      allocate (array(middle), source=1.0_wp)
      call clear_pages(array(2:middle - 1))
      call check(sum(array), 2.0_wp, 0.0_wp, "nothing beside them is cleared")
      call release_clear_pages(array)
      call copy_pages(array(:0), copy)
      call check(size(copy), 0, "nothing is copied of nothing")
   end subroutine check_small_arrays

   !> Small pages that the program has in memory (proc(5), smaps_rollup; statm is not exact)
   integer function resident_pages() result(pages)
      character(80) :: line
      character(8) :: word
      integer :: kilobytes, unit

      open (newunit=unit, file="/proc/self/smaps_rollup", action="read")
      do
         read (unit, "(a)") line
         if (line(:4) == "Rss:") exit
      end do
      close (unit)
      read (line, *) word, kilobytes
      pages = kilobytes/4
   end function resident_pages

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
