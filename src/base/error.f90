!> Errors as values: created where the cause is known, printed by `main` only.
module plydyn_base_error
   use, intrinsic :: iso_c_binding, only : c_int
   implicit none
   private

   public :: c_exit, fail

   !> Exit codes of the program
   integer, parameter, public :: exit_normal = 0, exit_usage = 1, exit_input = 2, &
      & exit_run = 3, exit_stopped = 4, exit_output = 5

   !> An error with its remedy
   type, public :: error_type
      !> Text for the user, with the position in the deck if there is one
      character(:), allocatable :: message
      !> Exit code of the program
      integer :: code = exit_run
   end type error_type

   interface
      !> C's exit: an exit code without Fortran's own words
      subroutine c_exit(code) bind(c, name="exit")
         import :: c_int
         implicit none
         integer(c_int), value :: code
      end subroutine c_exit
   end interface

contains

   !> Create an error
   subroutine fail(error, code, message)
      !> The new error
      type(error_type), allocatable, intent(out) :: error
      !> Exit code of the program
      integer, intent(in) :: code
      !> Text for the user
      character(*), intent(in) :: message

      allocate (error)
      error%message = message
      error%code = code
   end subroutine fail

end module plydyn_base_error
