!> Where the C library puts large arrays.
!>
!> Arrays of motion, force and history begin 16 bytes behind a line of the cache (`front` in the
!> domain counts on it) where they are large enough for pages of their own. The library learns from
!> what is given back to put larger and larger arrays among the small ones instead, anywhere in a
!> line: then vectors lie across two, and passes over them take longer.
module plydyn_base_memory
   use, intrinsic :: iso_c_binding, only : c_int
   implicit none
   private

   public :: keep_arrays_on_pages

   !> Number of the option in glibc, M_MMAP_THRESHOLD, and the value that it has before it learns
   integer(c_int), parameter :: threshold = -3_c_int, first_value = 131072_c_int

   interface
      integer(c_int) function c_mallopt(option, value) bind(c, name="mallopt")
         import :: c_int
         implicit none
         integer(c_int), value :: option, value
      end function c_mallopt
   end interface

contains

   !> From now on all arrays of 128 KiB and more have pages of their own
   subroutine keep_arrays_on_pages()
      integer(c_int) :: done

      ! where it cannot be set nothing is wrong but the speed
      done = c_mallopt(threshold, first_value)
   end subroutine keep_arrays_on_pages

end module plydyn_base_memory
