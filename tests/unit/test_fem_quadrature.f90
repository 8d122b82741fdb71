!> Quadrature integrates its polynomials.
program test_fem_quadrature
   use plydyn_base_precision, only : wp
   use plydyn_fem_quadrature, only : gauss_points, gauss_weights, legendre, lobatto_points
   use testing, only : begin, check, finish
   implicit none

   real(wp) :: slope, value
   integer :: k, n

   call begin("Gauss points")
   do n = 1, 6
      do k = 0, 2*n - 1
         call check(sum(gauss_weights(n)*gauss_points(n)**k), &
            & merge(2.0_wp/real(k + 1, wp), 0.0_wp, mod(k, 2) == 0), 1.0e-14_wp, &
            & "integrate every power up to 2n - 1")
      end do
   end do
   call begin("Lobatto points")
   call check(lobatto_points(4), [-1.0_wp, -1.0_wp/sqrt(5.0_wp), 1.0_wp/sqrt(5.0_wp), 1.0_wp], &
      & 1.0e-15_wp, "of four are known in closed form")
   call check(lobatto_points(5), [-1.0_wp, -sqrt(3.0_wp/7.0_wp), 0.0_wp, sqrt(3.0_wp/7.0_wp), &
      & 1.0_wp], 1.0e-15_wp, "of five are known in closed form")
   call begin("Legendre polynomial")
   call legendre(3, 0.3_wp, value, slope)
   call check(value, 0.5_wp*(5.0_wp*0.3_wp**3 - 3.0_wp*0.3_wp), 1.0e-15_wp, "third, value")
   call check(slope, 0.5_wp*(15.0_wp*0.3_wp**2 - 3.0_wp), 1.0e-15_wp, "third, slope")
   call finish()
end program test_fem_quadrature
