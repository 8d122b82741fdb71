!> Memory allocator of the C library: pages of their own for large arrays.
!>
!> Arrays with pages of their own begin 16 bytes after a cache line, on which the alignment offset
!> of the domain relies. The threshold for this is dynamic in glibc: it grows when arrays are freed.
!> Larger arrays would then start anywhere in a cache line, and vector loads would cross two lines.
module plydyn_base_memory
   use, intrinsic :: iso_c_binding, only : c_int
   implicit none
   private

   public :: keep_arrays_on_pages

   !> Number of the option M_MMAP_THRESHOLD of glibc, and its initial value, bytes
   integer(c_int), parameter :: threshold = -3_c_int, initial_value = 131072_c_int

   interface
      integer(c_int) function c_mallopt(option, value) bind(c, name="mallopt")
         import :: c_int
         implicit none
         integer(c_int), value :: option, value
      end function c_mallopt
   end interface

contains

   !> Fix the threshold: all arrays of 128 KiB and more have pages of their own
   subroutine keep_arrays_on_pages()
      integer(c_int) :: status

      ! the result is ignored: without the option only speed is lost
      status = c_mallopt(threshold, initial_value)
   end subroutine keep_arrays_on_pages

end module plydyn_base_memory
