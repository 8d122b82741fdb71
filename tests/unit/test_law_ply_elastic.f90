!> Stiffness inverts compliance, and rotations keep energy.
program test_law_ply_elastic
   use plydyn_base_precision, only : wp
   use plydyn_law_ply_elastic, only : ply_stiffness, strain_rotation
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: e(3) = [165.0e3_wp, 9.0e3_wp, 8.0e3_wp]
   real(wp), parameter :: nu(3) = [0.34_wp, 0.3_wp, 0.5_wp], g(3) = [5.6e3_wp, 5.0e3_wp, 2.8e3_wp]
   real(wp) :: c(6, 6), compliance(6, 6), one(6, 6), r(6, 6), strain(6)
   integer :: i

   compliance(:, :) = 0.0_wp
   compliance(1, 1:3) = [1.0_wp, -nu(1), -nu(2)]/e(1)
   compliance(2, 1:3) = [-nu(1)/e(1), 1.0_wp/e(2), -nu(3)/e(2)]
   compliance(3, 1:3) = [-nu(2)/e(1), -nu(3)/e(2), 1.0_wp/e(3)]
   one(:, :) = 0.0_wp
   do i = 1, 6
      one(i, i) = 1.0_wp
   end do
   do i = 1, 3
      compliance(3 + i, 3 + i) = 1.0_wp/g(i)
   end do

   call begin("ply_stiffness")
   c(:, :) = ply_stiffness(e, nu, g)
   call check(reshape(matmul(c, compliance), [36]), reshape(one, [36]), 1.0e-12_wp, &
      & "is the inverse of the compliance")

   call begin("strain_rotation")
   r(:, :) = matmul(strain_rotation(-37.0_wp), strain_rotation(37.0_wp))
   call check(reshape(r, [36]), reshape(one, [36]), 1.0e-14_wp, "turns back with the other sign")
   r(:, :) = strain_rotation(90.0_wp)
   strain(:) = matmul(r, [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp])
   call check(strain, [2.0_wp, 1.0_wp, 3.0_wp, -4.0_wp, 6.0_wp, -5.0_wp], 1.0e-14_wp, &
      & "by a quarter changes x for y and y for -x")
   call finish()
end program test_law_ply_elastic
