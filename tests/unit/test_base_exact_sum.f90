!> Sums without round-off.
program test_base_exact_sum
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan, ieee_positive_inf, ieee_quiet_nan, &
      & ieee_value
   use plydyn_base_exact_sum, only : exact_sum_type, exact_sums_type, new_exact_sums
   use plydyn_base_precision, only : wp
   use testing, only : begin, check, finish
   implicit none

   call begin("exact sums")
   call round_once()
   call no_order()
   call no_parts()
   call no_numbers()
   call finish()

contains

   !> Sum of some terms
   real(wp) function sum_of(terms)
      real(wp), intent(in) :: terms(:)

      type(exact_sum_type) :: sum
      integer :: i

      do i = 1, size(terms)
         call sum%add(terms(i))
      end do
      sum_of = sum%value()
   end function sum_of

   !> Whole numbers and powers of two have exact sums
   subroutine round_once()
      integer :: i

      call check(same(sum_of([real(wp) ::]), 0.0_wp), "no term is zero")
      call check(same(sum_of([1.0e30_wp, 1.0_wp, -1.0e30_wp]), 1.0_wp), "small terms survive")
      call check(same(sum_of([-1.0e30_wp, -1.0_wp, 1.0e30_wp]), -1.0_wp), "also negative ones")
      call check(same(sum_of([(0.1_wp, i=1, 8)]), 8*0.1_wp), "eight times a number is exact")
      call check(same(sum_of([-3.7e-90_wp]), -3.7e-90_wp), "one small term stays as it is")
      call check(same(sum_of([1.9e96_wp]), 1.9e96_wp), "one large term stays as it is")
      call check(same(sum_of([1.0_wp, epsilon(1.0_wp)]), 1.0_wp + epsilon(1.0_wp)), "last bit")
      call check(same(sum_of([real(wp) :: (i, i=-1000, 2000)]), real(sum([(i, i=1001, 2000)]), &
         & wp)), "carries go up and down")
   end subroutine round_once

   !> Terms of all sizes in two orders
   subroutine no_order()
      real(wp) :: terms(2000)
      integer :: i

      call random_number(terms)
      terms(:) = (terms - 0.5_wp)*10.0_wp**(mod([(i, i=1, size(terms))], 40) - 20)
      call check(same(sum_of(terms), sum_of(terms(size(terms):1:-1))), "any order, same bits")
      call check(abs(sum_of(terms) - sum(terms)) <= 2000*epsilon(1.0_wp)*sum(abs(terms)), &
         & "the sum is that of the terms")
   end subroutine no_order

   !> Two sums of parts add up to that of the whole
   subroutine no_parts()
      type(exact_sums_type) :: left, right, whole
      real(wp) :: terms(300)
      integer :: i

      call random_number(terms)
      left = new_exact_sums(2)
      right = new_exact_sums(2)
      whole = new_exact_sums(2)
      do i = 1, size(terms)
         call whole%add(2, terms(i))
         if (mod(i, 3) == 0) call left%add(2, terms(i))
         if (mod(i, 3) /= 0) call right%add(2, terms(i))
      end do
      left%limb(:, :) = left%limb + right%limb
      call check(same(left%value(2), whole%value(2)), "parts add up")
      call check(same(left%value(1), 0.0_wp), "the other sum keeps zero")
      call whole%clear()
      call check(same(whole%value(2), 0.0_wp), "cleared is zero")
   end subroutine no_parts

   !> What is no number spoils its sum
   subroutine no_numbers()
      type(exact_sums_type) :: sums

      sums = new_exact_sums(3)
      call sums%add(1, ieee_value(1.0_wp, ieee_quiet_nan))
      call sums%add(2, ieee_value(1.0_wp, ieee_positive_inf))
      call sums%add(3, 1.0_wp)
      call check(ieee_is_nan(sums%value(1)), "not a number")
      call check(ieee_is_nan(sums%value(2)), "infinite")
      call check(same(sums%value(3), 1.0_wp), "the others keep theirs")
   end subroutine no_numbers

   !> Equal to the last bit
   pure logical function same(a, b)
      real(wp), intent(in) :: a, b

      same = .not. (a < b .or. a > b)
   end function same

end program test_base_exact_sum
