!> Products and inverses of vectors and matrices in space.
module plydyn_base_matrix
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: cross, invert

contains

   !> Vector product
   pure function cross(a, b)
      !> The factors
      real(wp), intent(in) :: a(3), b(3)
      real(wp) :: cross(3)

      cross(:) = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
   end function cross

   !> Inverse and determinant, by Cramer's rule
   pure subroutine invert(a, inverse, determinant)
      !> A matrix that is not singular
      real(wp), intent(in) :: a(3, 3)
      real(wp), intent(out) :: inverse(3, 3), determinant

      inverse(1, :) = cross(a(:, 2), a(:, 3))
      inverse(2, :) = cross(a(:, 3), a(:, 1))
      inverse(3, :) = cross(a(:, 1), a(:, 2))
      determinant = dot_product(inverse(1, :), a(:, 1))
      inverse(:, :) = inverse/determinant
   end subroutine invert

end module plydyn_base_matrix
