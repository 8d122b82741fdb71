!> Matrices of three rows: cross products, inverses and determinants.
program test_base_matrix
   use plydyn_base_matrix, only : cross, invert
   use plydyn_base_precision, only : wp
   use testing, only : begin, check, finish
   implicit none

   !> Columns of a matrix, and its determinant: 2 (3*2 - 1*1) - 1 (1*2 - 1*0) + 0
   real(wp), parameter :: a(3, 3) = reshape([2.0_wp, 1.0_wp, 0.0_wp, 1.0_wp, 3.0_wp, 1.0_wp, &
      & 0.0_wp, 1.0_wp, 2.0_wp], [3, 3]), determinant = 8.0_wp
   real(wp), parameter :: unit(3, 3) = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, &
      & 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
   real(wp) :: found, inverse(3, 3)
   integer :: i

   call begin("cross")
   do i = 1, 3
      call check(cross(unit(:, i), unit(:, mod(i, 3) + 1)), unit(:, mod(i + 1, 3) + 1), 0.0_wp, &
         & "of two axes is the third")
   end do
   call check(cross([1.0_wp, 2.0_wp, 3.0_wp], [4.0_wp, 5.0_wp, 7.0_wp]), &
      & [-1.0_wp, 5.0_wp, -3.0_wp], 0.0_wp, "of any vectors")

   call begin("invert")
   call invert(a, inverse, found)
   call check(found, determinant, 1.0e-15_wp, "determinant")
   call check(pack(matmul(inverse, a), .true.), pack(unit, .true.), 1.0e-15_wp, "inverse")
   call invert(a(:, [2, 1, 3]), inverse, found)
   call check(found, -determinant, 1.0e-15_wp, "columns that change places change the sign")
   call finish()
end program test_base_matrix
