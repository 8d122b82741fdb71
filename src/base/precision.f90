!> Kind of real numbers, and the width of a batch.
module plydyn_base_precision
   use, intrinsic :: iso_fortran_env, only : real64
   implicit none
   private

   !> Working precision
   integer, parameter, public :: wp = real64
   !> SIMD lanes of a kernel: first extent of every batch array
   integer, parameter, public :: lanes = 8

end module plydyn_base_precision
