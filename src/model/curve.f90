!> Curves, over time or of a material, linear between their points.
module plydyn_model_curve
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> A curve
   type, public :: curve_type
      !> The user's number; 0 is the constant 1
      integer :: id = 0
      !> Abscissas, increasing, and ordinates
      real(wp), allocatable :: x(:), y(:)
   contains
      procedure :: at
      procedure :: largest
      procedure :: least
   end type curve_type

contains

   !> Ordinate at an abscissa; held constant before the first point and after the last
   pure real(wp) function at(self, x) result(y)
      class(curve_type), intent(in) :: self
      !> Abscissa
      real(wp), intent(in) :: x

      real(wp) :: part
      integer :: right

      right = 1
      do while (right < size(self%x))
         if (self%x(right) >= x) exit
         right = right + 1
      end do
      if (right == 1 .or. x >= self%x(right)) then
         y = self%y(right)
      else
         part = (x - self%x(right - 1))/(self%x(right) - self%x(right - 1))
         y = self%y(right - 1) + part*(self%y(right) - self%y(right - 1))
      end if
   end function at

   !> Largest size of an ordinate between two abscissas
   pure real(wp) function largest(self, from, to)
      class(curve_type), intent(in) :: self
      !> The abscissas, in order
      real(wp), intent(in) :: from, to

      largest = max(abs(self%at(from)), abs(self%at(to)))
      largest = max(largest, maxval(abs(self%y), mask=self%x > from .and. self%x < to))
   end function largest

   !> Smallest ordinate between two abscissas
   pure real(wp) function least(self, from, to)
      class(curve_type), intent(in) :: self
      !> The abscissas, in order
      real(wp), intent(in) :: from, to

      least = min(self%at(from), self%at(to))
      least = min(least, minval(self%y, mask=self%x > from .and. self%x < to))
   end function least

end module plydyn_model_curve
