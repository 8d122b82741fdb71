!> Memory allocator of the C library: pages of their own for large arrays.
!>
!> Arrays with pages of their own begin 16 bytes after a cache line, on which the alignment offset
!> of the domain relies. The threshold for this is dynamic in glibc: it grows when arrays are freed.
!> Larger arrays would then start anywhere in a cache line, and vector loads would cross two lines.
module plydyn_base_memory
   use, intrinsic :: iso_c_binding, only : c_int, c_ptr
   use, intrinsic :: iso_fortran_env, only : error_unit
   use plydyn_base_error, only : exit_run
   implicit none
   private

   public :: fail_to_allocate, fail_to_grow, keep_arrays_on_pages

   !> Number of the option M_MMAP_THRESHOLD of glibc, and its initial value, bytes
   integer(c_int), parameter :: threshold = -3_c_int, initial_value = 131072_c_int

   interface
      integer(c_int) function c_mallopt(option, value) bind(c, name="mallopt")
         import :: c_int
         implicit none
         integer(c_int), value :: option, value
      end function c_mallopt

      !> C's exit: an exit code without Fortran's own words
      subroutine c_exit(code) bind(c, name="exit")
         import :: c_int
         implicit none
         integer(c_int), value :: code
      end subroutine c_exit
   end interface

contains

   !> Fix the threshold: all arrays of 128 KiB and more have pages of their own
   subroutine keep_arrays_on_pages()
      integer(c_int) :: status

      ! the result is ignored: without the option only speed is lost
      status = c_mallopt(threshold, initial_value)
   end subroutine keep_arrays_on_pages

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
