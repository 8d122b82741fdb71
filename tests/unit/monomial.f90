!> Powers of a coordinate, from which tests build polynomials.
module monomial
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: bend, slope

contains

   !> Derivative of x**power
   pure function slope(x, power) result(value)
      !> Where
      real(wp), intent(in) :: x
      !> Power, 0 or more
      integer, intent(in) :: power
      real(wp) :: value

      value = 0.0_wp
      if (power > 0) value = power*x**(power - 1)
   end function slope

   !> Second derivative of x**power
   pure function bend(x, power) result(value)
      !> Where
      real(wp), intent(in) :: x
      !> Power, 0 or more
      integer, intent(in) :: power
      real(wp) :: value

      value = 0.0_wp
      if (power > 1) value = power*slope(x, power - 1)
   end function bend

end module monomial
