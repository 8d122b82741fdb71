!> The tables of an expansion reproduce polynomials and their derivatives.
program test_fem_expansion
   use plydyn_base_precision, only : wp
   use plydyn_fem_expansion, only : expansion_type, new_expansion
   use testing, only : begin, check, finish
   implicit none

   type(expansion_type) :: table
   real(wp), allocatable :: mode(:), nodal(:)
   integer :: i, k, order

   call begin("new_expansion")
   do order = 1, 4
      do i = 1, 2
         table = new_expansion(order, i == 2)
         call check(sum(table%mass_share), 1.0_wp, 1.0e-14_wp, "the shares of the mass make one")
         call check(minval(table%mass_share) > 0.0_wp, "no share of the mass is negative")
         do k = 0, order
            nodal = table%node**k
            call check(matmul(table%to_gauss, nodal), table%gauss**k, 1.0e-13_wp, &
               & "powers are reproduced at the Gauss points")
            call check(matmul(table%gauss_slope, table%gauss**k), &
               & real(k, wp)*table%gauss**max(0, k - 1), 1.0e-12_wp, "and their derivatives")
            mode = matmul(table%to_mode, nodal)
            call check(sum(mode**2), 2.0_wp/real(2*k + 1, wp), 1.0e-13_wp, &
               & "modes are orthonormal: their squares make the integral of the square")
            mode = matmul(table%mode_slope, mode)
            call check(sum(mode**2), merge(0.0_wp, 2.0_wp*real(k*k, wp)/real(max(1, 2*k - 1), wp), &
               & k == 0), 1.0e-11_wp, "likewise for the derivative")
         end do
      end do
   end do
   table = new_expansion(2, .false.)
   call check(table%mass_share, [1.0_wp, 4.0_wp, 1.0_wp]/6.0_wp, 1.0e-14_wp, "Simpson's rule")
   table = new_expansion(3, .false.)
   call check(table%mass_share, [1.0_wp, 3.0_wp, 3.0_wp, 1.0_wp]/8.0_wp, 1.0e-14_wp, &
      & "three eighths")
   call finish()
end program test_fem_expansion
