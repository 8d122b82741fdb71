!> Memory: pages of their own for large arrays, large pages, pages that only take memory once they
!> are written to, and requests ahead of use.
!>
!> Arrays with pages of their own begin 16 bytes after a cache line, on which the alignment offset
!> of the domain relies. The threshold for this is dynamic in glibc: it grows when arrays are freed.
!> Larger arrays would then start anywhere in a cache line, and vector loads would cross two lines.
!>
!> Where arrays are larger than the caches, the pages themselves count: small ones are so many that
!> the processor looks their places up again and again.
module plydyn_base_memory
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t, c_loc, c_long, c_ptr, &
      & c_size_t
   use, intrinsic :: iso_fortran_env, only : error_unit, int64
   use plydyn_base_error, only : c_exit, exit_run
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: clear_pages, copy_pages, fail_to_allocate, fail_to_grow, keep_arrays_on_pages, &
      & prefer_large_pages, prefetch, release_clear_pages

   !> Number of the option M_MMAP_THRESHOLD of glibc, and its initial value, bytes
   integer(c_int), parameter :: threshold = -3_c_int, initial_value = 131072_c_int
   !> Advice of Linux, MADV_DONTNEED, MADV_HUGEPAGE, MADV_NOHUGEPAGE and MADV_COLLAPSE: to take back
   !> pages, which are zero when they are used again; to use large pages, or small ones; and to make
   !> large ones of the small ones that are there
   integer(c_int), parameter :: take_back = 4_c_int, use_large = 14_c_int, use_small = 15_c_int, &
      & make_large = 25_c_int
   !> Bytes of a small and of a large page, and numbers on a small one
   integer(c_intptr_t), parameter :: page = 4096_c_intptr_t, large_page = 512*page
   integer, parameter :: numbers_on_page = int(page)/(storage_size(1.0_wp)/8)

   interface
      integer(c_int) function c_mallopt(option, value) bind(c, name="mallopt")
         import :: c_int
         implicit none
         integer(c_int), value :: option, value
      end function c_mallopt

      !> What is to become of some pages
      integer(c_int) function c_madvise(first, length, advice) bind(c, name="madvise")
         import :: c_int, c_intptr_t, c_size_t
         implicit none
         integer(c_intptr_t), value :: first
         integer(c_size_t), value :: length
         integer(c_int), value :: advice
      end function c_madvise

      !> Bytes of a small page of the machine
      integer(c_int) function c_getpagesize() bind(c, name="getpagesize")
         import :: c_int
         implicit none
      end function c_getpagesize

      !> Ask for memory, see prefetch.c
      pure subroutine c_prefetch(first, bytes) bind(c, name="plydyn_prefetch")
         import :: c_double, c_long
         implicit none
         real(c_double), intent(in) :: first(*)
         integer(c_long), value :: bytes
      end subroutine c_prefetch
   end interface

contains

   !> Fix the threshold: all arrays of 128 KiB and more have pages of their own
   subroutine keep_arrays_on_pages()
      integer(c_int) :: status

      ! the result is ignored: without the option only speed is lost
      status = c_mallopt(threshold, initial_value)
   end subroutine keep_arrays_on_pages

   !> Put an array on large pages, as far as it fills them and the machine has them
   subroutine prefer_large_pages(array)
      !> An array that exists; its values stay
      real(wp), intent(in), contiguous, target :: array(:)

      integer(c_int) :: status
      integer(c_intptr_t) :: after, first

      if (size(array) == 0) return
      first = transfer(c_loc(array(1)), first)
      after = first + size(array, kind=c_intptr_t)*storage_size(array)/8
      first = (first + page - 1)/page*page
      if (after - first < large_page) return
      ! the results are ignored: without large pages only speed is lost
      status = c_madvise(first, int(after - first, c_size_t), use_large)
      status = c_madvise(first, int(after - first, c_size_t), make_large)
   end subroutine prefer_large_pages

   !> Set an array to zero so that each of its pages takes memory only when it is written to, and
   !> then as a small page
   subroutine clear_pages(array)
      !> An array that exists
      real(wp), intent(inout), contiguous, target :: array(:)

      integer :: first, last
      integer(c_int) :: status

      call find_pages(array, first, last)
      if (last < first) then
         array(:) = 0.0_wp
         return
      end if
      array(:first - 1) = 0.0_wp
      array(last + 1:) = 0.0_wp
      status = advise(array(first:last), use_small)
      status = advise(array(first:last), take_back)
      if (status /= 0) array(first:last) = 0.0_wp
   end subroutine clear_pages

   !> Copy an array so that pages of zeros take no memory in the copy
   subroutine copy_pages(from, to)
      !> The array
      real(wp), intent(in), contiguous :: from(:)
      !> The copy
      real(wp), allocatable, intent(out) :: to(:)

      integer :: first, last

      allocate (to(size(from)))
      call clear_pages(to)
      do first = 1, size(from), numbers_on_page
         last = min(first + numbers_on_page - 1, size(from))
         if (.not. is_clear(from(first:last))) to(first:last) = from(first:last)
      end do
   end subroutine copy_pages

   !> Give back the pages of an array on which all bits are zero
   subroutine release_clear_pages(array)
      !> An array that exists; its values stay
      real(wp), intent(inout), contiguous, target :: array(:)

      integer :: first, last, n
      integer(c_int) :: status

      call find_pages(array, first, last)
      do n = first, last, numbers_on_page
         ! the result is ignored: a page that is kept only takes memory
         if (is_clear(array(n:n + numbers_on_page - 1))) then
            status = advise(array(n:n + numbers_on_page - 1), take_back)
         end if
      end do
   end subroutine release_clear_pages

   !> First and last number of an array on its whole small pages; none of small arrays, and where
   !> the machine has other pages
   subroutine find_pages(array, first, last)
      real(wp), intent(in), contiguous, target :: array(:)
      integer, intent(out) :: first, last

      integer(c_intptr_t) :: start

      first = 1
      last = 0
      if (size(array) < numbers_on_page*int(large_page/page)) return
      if (c_getpagesize() /= page) return
      start = transfer(c_loc(array(1)), start)
      first = 1 + int(modulo(-start, page))/(storage_size(1.0_wp)/8)
      last = first - 1 + (size(array) - first + 1)/numbers_on_page*numbers_on_page
   end subroutine find_pages

   !> Say what is to become of some whole pages; 0 if it is done
   integer(c_int) function advise(array, advice) result(status)
      real(wp), intent(in), contiguous, target :: array(:)
      integer(c_int), intent(in) :: advice

      integer(c_intptr_t) :: first

      first = transfer(c_loc(array(1)), first)
      status = c_madvise(first, size(array, kind=c_size_t)*(storage_size(1.0_wp)/8), advice)
   end function advise

   !> Whether all bits of some numbers are zero
   pure logical function is_clear(numbers)
      real(wp), intent(in) :: numbers(:)

      integer(int64) :: bits
      integer :: i

      bits = 0_int64
      do i = 1, size(numbers)
         bits = ior(bits, transfer(numbers(i), bits))
      end do
      is_clear = bits == 0_int64
   end function is_clear

   !> Ask for some numbers ahead of their use: what arrives meanwhile need not be waited for
   pure subroutine prefetch(numbers)
      !> The numbers, one behind the other
      real(wp), intent(in), contiguous :: numbers(:)

      call c_prefetch(numbers, int(size(numbers)*storage_size(numbers)/8, c_long))
   end subroutine prefetch

   !> What an `allocate` without `stat` calls when it fails, in place of the procedure of that name
   !> in the run-time library, which ends the program with a trace and the exit code of a wrong
   !> command line. Linking the library statically would define it twice
   subroutine fail_to_allocate(where, message) bind(c, name="_gfortran_os_error_at")
      !> Source line, and a format for the size: of no use to an analyst
      type(c_ptr), value :: where, message

      call end_without_memory()
   end subroutine fail_to_allocate

   !> The same for temporary arrays and those that grow by assignment
   subroutine fail_to_grow(message) bind(c, name="_gfortran_os_error")
      !> As above
      type(c_ptr), value :: message

      call end_without_memory()
   end subroutine fail_to_grow

   !> The only end of the program besides that in `main`: no array could hold another error
   subroutine end_without_memory()

      write (error_unit, "(a)") "out of memory: the machine, the batch job or a limit (ulimit " &
         & //"-v) allows no more; a coarser mesh, fewer layers or ranks on more machines need less"
      flush (error_unit)
      call c_exit(int(exit_run, c_int))
   end subroutine end_without_memory

end module plydyn_base_memory
