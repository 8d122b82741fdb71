!> Factors of strengths have the distribution of Weibull with mean 1 and are correlated.
program test_law_scatter
   use plydyn_base_precision, only : wp
   use plydyn_law_scatter, only : scatter_type
   use testing, only : begin, check, finish
   implicit none

   integer, parameter :: side = 120
   real(wp), parameter :: modulus = 12.0_wp, length = 1.5_wp
   type(scatter_type) :: other, scatter
   real(wp) :: along(side, side), apart, beside(side, side), factor(side, side), here, mean, spread
   integer :: i, j

   scatter = scatter_type(seed=7, modulus=modulus, length=length)
   do j = 1, side
      do i = 1, side
         ! points far apart, each with one at the correlation length, and another layer
         associate (place => 7.3_wp*[real(i, wp), real(j, wp)] - 400.0_wp)
            factor(i, j) = scatter%factor(place, 3)
            along(i, j) = scatter%factor(place + [length, 0.0_wp], 3)
            beside(i, j) = scatter%factor(place, 4)
         end associate
      end do
   end do

   call begin("scatter of strengths")
   ! of 14400 independent numbers: three standard errors of the mean, of the deviation and of a
   ! correlation
   spread = sqrt(gamma(1.0_wp + 2.0_wp/modulus)/gamma(1.0_wp + 1.0_wp/modulus)**2 - 1.0_wp)
   mean = sum(factor)/side**2
   call check(mean, 1.0_wp, 3.0_wp*spread/side, "has the mean 1")
   call check(sqrt(sum((factor - mean)**2)/side**2)/spread, 1.0_wp, 3.0_wp/side, &
      & "has the deviation of Weibull")
   call check(correlation(factor, along), exp(-0.5_wp), 0.03_wp + 3.0_wp/side, &
      & "is correlated over its length")
   call check(correlation(factor, beside), 0.0_wp, 3.0_wp/side, "is independent between layers")
   call check(maxval(factor) <= scatter%largest_factor(), "has a largest factor")
   ! of its distribution one in a thousand lies below that factor
   apart = (-log(0.999_wp))**(1.0_wp/modulus)/gamma(1.0_wp + 1.0_wp/modulus)
   call check(real(count(factor < apart), wp), 1.0e-3_wp*side**2, 3.0_wp*sqrt(1.0e-3_wp)*side, &
      & "has the tail of Weibull")

   call begin("seed of the scatter")
   here = scatter%factor([1.25_wp, -3.5_wp], 2)
   call check(scatter%factor([1.25_wp, -3.5_wp], 2), here, 0.0_wp, "the same place is the same")
   other = scatter_type(seed=8, modulus=modulus, length=length)
   call check(abs(other%factor([1.25_wp, -3.5_wp], 2) - here) > 1.0e-6_wp, &
      & "another seed is another one")
   call check(abs(scatter%factor([1.25_wp + 1.0e-6_wp, -3.5_wp], 2) - here) < 1.0e-5_wp, &
      & "is continuous")

   call begin("length far too short")
   ! places of the lattice that no integer numbers
   other = scatter_type(seed=7, modulus=modulus, length=1.0e-12_wp)
   do j = 1, side
      do i = 1, side
         factor(i, j) = other%factor(7.3_wp*[real(i, wp), real(j, wp)] - 400.0_wp, 3)
      end do
   end do
   mean = sum(factor)/side**2
   call check(mean, 1.0_wp, 3.0_wp*spread/side, "still has the mean 1")
   call check(sqrt(sum((factor - mean)**2)/side**2)/spread, 1.0_wp, 3.0_wp/side, &
      & "and the deviation of Weibull")
   call finish()

contains

   !> Correlation of two samples
   pure real(wp) function correlation(one, two)
      real(wp), intent(in) :: one(:, :), two(:, :)

      real(wp) :: means(2)

      means(:) = [sum(one), sum(two)]/size(one)
      correlation = sum((one - means(1))*(two - means(2)))/sqrt(sum((one - means(1))**2) &
         & *sum((two - means(2))**2))
   end function correlation

end program test_law_scatter
