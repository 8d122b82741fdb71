!> Factors of the strengths of plies: distribution, correlation, and what is not correlated.
program test_law_scatter_strengths
   use plydyn_base_precision, only : wp
   use plydyn_law_scatter, only : scatter_type, strength_scatter_type
   use testing, only : begin, check, finish
   implicit none

   integer, parameter :: side = 100, fibres = 1, matrix = 2
   real(wp), parameter :: modulus(2) = [30.0_wp, 10.0_wp], length = 1.5_wp
   !> Shares of points below the quantiles that are looked at
   real(wp), parameter :: shares(3) = [0.01_wp, 0.5_wp, 0.99_wp]
   character(6), parameter :: names(2) = ["fibres", "matrix"]
   type(strength_scatter_type) :: scatter
   real(wp), dimension(2, side, side) :: above, along, bond, here
   real(wp) :: deviation, mean, quantile
   integer :: i, j, k, n

   scatter = strength_scatter_type(seed=7, modulus=modulus, length=length)
   do j = 1, side
      do i = 1, side
         ! points far apart, each with one at the correlation length, one in the next ply, and one
         ! of an interface with the same seed
         associate (place => 11.3_wp*[real(i, wp), real(j, wp)] - 600.0_wp)
            here(:, i, j) = scatter%factors(place, 3)
            along(:, i, j) = scatter%factors(place + [0.0_wp, length], 3)
            above(:, i, j) = scatter%factors(place, 4)
            do k = 1, 2
               bond(k, i, j) = interface_factor(place, modulus(k), 2 + k)
            end do
         end associate
      end do
   end do

   ! of 10000 independent numbers: three standard errors of the mean, of the deviation, of a
   ! correlation and of a share
   do k = fibres, matrix
      call begin("factors of "//trim(names(k)))
      deviation = sqrt(gamma(1.0_wp + 2.0_wp/modulus(k))/gamma(1.0_wp + 1.0_wp/modulus(k))**2 &
         & - 1.0_wp)
      mean = sum(here(k, :, :))/side**2
      call check(mean, 1.0_wp, 3.0_wp*deviation/side, "have the mean 1")
      call check(sqrt(sum((here(k, :, :) - mean)**2)/side**2)/deviation, 1.0_wp, 3.0_wp/side, &
         & "have the deviation of Weibull")
      do n = 1, size(shares)
         quantile = (-log(1.0_wp - shares(n)))**(1.0_wp/modulus(k)) &
            & /gamma(1.0_wp + 1.0_wp/modulus(k))
         call check(real(count(here(k, :, :) < quantile), wp)/side**2, shares(n), &
            & 3.0_wp*sqrt(shares(n)*(1.0_wp - shares(n)))/side, "have its quantiles")
      end do
      call check(correlation(here(k, :, :), along(k, :, :)), exp(-0.5_wp), 0.03_wp + 3.0_wp/side, &
         & "are correlated over the length")
      call check(correlation(here(k, :, :), above(k, :, :)), 0.0_wp, 3.0_wp/side, &
         & "are independent of those of the next ply")
      call check(correlation(here(k, :, :), bond(k, :, :)), 0.0_wp, 3.0_wp/side, &
         & "are independent of those of interfaces")
   end do

   call begin("fibres and matrix")
   call check(correlation(here(fibres, :, :), here(matrix, :, :)), 0.0_wp, 3.0_wp/side, &
      & "are independent")
   call check(correlation(here(fibres, :, :), above(matrix, :, :)), 0.0_wp, 3.0_wp/side, &
      & "also from ply to ply")

   call begin("a modulus of 0")
   call check(.not. none(), "means no scatter")
   scatter%modulus(:) = [0.0_wp, 10.0_wp]
   call check(scatter%scatters(), "in one place leaves the other")
   call check(scatter%factors([3.0_wp, 4.0_wp], 1), [1.0_wp, matrix_alone()], 0.0_wp, &
      & "leaves the strength")
   call finish()

contains

   !> Whether strengths scatter by default
   pure logical function none()
      type(strength_scatter_type) :: plain

      none = plain%scatters()
   end function none

   !> Factor of the matrix where the fibres scatter, too
   pure real(wp) function matrix_alone()
      type(strength_scatter_type) :: both
      real(wp) :: factor(2)

      both = strength_scatter_type(7, [30.0_wp, 10.0_wp], length)
      factor(:) = both%factors([3.0_wp, 4.0_wp], 1)
      matrix_alone = factor(2)
   end function matrix_alone

   !> Factor of an interface with the same seed
   pure real(wp) function interface_factor(place, modulus_of_bond, number)
      real(wp), intent(in) :: place(2), modulus_of_bond
      !> Number of the interface
      integer, intent(in) :: number

      type(scatter_type) :: field

      field = scatter_type(7, modulus_of_bond, length)
      interface_factor = field%factor(place, number)
   end function interface_factor

   !> Correlation of two samples
   pure real(wp) function correlation(one, two)
      real(wp), intent(in) :: one(:, :), two(:, :)

      real(wp) :: means(2)

      means(:) = [sum(one), sum(two)]/size(one)
      correlation = sum((one - means(1))*(two - means(2)))/sqrt(sum((one - means(1))**2) &
         & *sum((two - means(2))**2))
   end function correlation

end program test_law_scatter_strengths
