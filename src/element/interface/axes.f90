!> Axes of the deformed faces of interfaces.
module plydyn_element_interface_axes
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: find_axes, rotate_back, rotate_in

   !> Distance from 1 up to which `near_root` has all digits
   real(wp), parameter :: near = 0.05_wp

contains

   !> Axes of the deformed face at each point: the third is its normal, the others are those along x
   !> and y turned as the face has turned, without its stretch. No direction of the plane goes
   !> before another, so that what slips does not depend on how a mesh lies
   pure subroutine find_axes(side, metric, middle, axes, stretch)
      !> Points along a side
      integer, intent(in) :: side
      !> Geometry of the points; see `quad_metric`
      real(wp), intent(in) :: metric(5, side, side)
      !> Sum of the displacements of both faces at the points
      real(wp), intent(in) :: middle(lanes, 3, side, side)
      !> Axes, (lanes, components, axes, points)
      real(wp), intent(out) :: axes(lanes, 3, 3, side, side)
      !> Components 11, 12 and 22 of the stretch: what has become of the unit vectors along x and y,
      !> along the first and the second axis
      real(wp), intent(out) :: stretch(lanes, 3, side, side)

      real(wp) :: along(lanes, 3, 2)
      integer :: i, j

      do j = 1, side
         do i = 1, side
            along(:, :, 1) = middle(:, :, side, j) - middle(:, :, 1, j)
            along(:, :, 2) = middle(:, :, i, side) - middle(:, :, i, 1)
            if (side == 3) then
               along(:, :, 1) = along(:, :, 1) + real(2*(i - 2), wp)*(middle(:, :, 3, j) &
                  & + middle(:, :, 1, j) - 2.0_wp*middle(:, :, 2, j))
               along(:, :, 2) = along(:, :, 2) + real(2*(j - 2), wp)*(middle(:, :, i, 3) &
                  & + middle(:, :, i, 1) - 2.0_wp*middle(:, :, i, 2))
            end if
            call point_axes(metric(:, i, j), along, axes(:, :, :, i, j), stretch(:, :, i, j))
         end do
      end do
   end subroutine find_axes

   !> Axes of the deformed face at a point
   pure subroutine point_axes(metric, along, axes, stretch)
      !> Geometry of the point; derivatives of twice the displacement along xi and eta
      real(wp), intent(in) :: metric(5), along(lanes, 3, 2)
      !> Axes, (lanes, components, axes), and the stretch
      real(wp), intent(out) :: axes(lanes, 3, 3), stretch(lanes, 3)

      real(wp) :: inverse(lanes, 3), square(lanes, 3)

      call span_face(metric, along, axes, square)
      if (hardly_stretched(square)) then
         call find_near_roots(square, inverse)
      else
         call find_roots(square, inverse)
      end if
      call turn_axes(square, inverse, axes, stretch)
   end subroutine point_axes

   !> What has become of the unit vectors along x and y, and their normal, not yet of length 1
   pure subroutine span_face(metric, along, axes, square)
      real(wp), intent(in) :: metric(5), along(lanes, 3, 2)
      !> These vectors
      real(wp), intent(out) :: axes(lanes, 3, 3)
      !> Squares of the length of the first and of the area, and the product of the first two
      real(wp), intent(out) :: square(lanes, 3)

      real(wp) :: a1, a2, a3, b1, b2, b3, n1, n2, n3
      integer :: l

      associate (x => 0.5_wp*metric(1:3:2), y => 0.5_wp*metric(2:4:2))
         !$omp simd private(a1, a2, a3, b1, b2, b3, n1, n2, n3)
         do l = 1, lanes
            a1 = 1.0_wp + along(l, 1, 1)*x(1) + along(l, 1, 2)*x(2)
            a2 = along(l, 2, 1)*x(1) + along(l, 2, 2)*x(2)
            a3 = along(l, 3, 1)*x(1) + along(l, 3, 2)*x(2)
            b1 = along(l, 1, 1)*y(1) + along(l, 1, 2)*y(2)
            b2 = 1.0_wp + along(l, 2, 1)*y(1) + along(l, 2, 2)*y(2)
            b3 = along(l, 3, 1)*y(1) + along(l, 3, 2)*y(2)
            n1 = a2*b3 - a3*b2
            n2 = a3*b1 - a1*b3
            n3 = a1*b2 - a2*b1
            square(l, 1) = a1*a1 + a2*a2 + a3*a3
            square(l, 2) = n1*n1 + n2*n2 + n3*n3
            square(l, 3) = a1*b1 + a2*b2 + a3*b3
            axes(l, 1, 1) = a1
            axes(l, 2, 1) = a2
            axes(l, 3, 1) = a3
            axes(l, 1, 3) = n1
            axes(l, 2, 3) = n2
            axes(l, 3, 3) = n3
         end do
      end associate
   end subroutine span_face

   !> Whether all numbers of which roots are taken are near 1
   pure logical function hardly_stretched(square)
      real(wp), intent(in) :: square(lanes, 3)

      real(wp) :: farthest
      integer :: l

      farthest = 0.0_wp
      !$omp simd reduction(max:farthest)
      do l = 1, lanes
         farthest = max(farthest, abs(square(l, 1) - 1.0_wp), abs(square(l, 2) - 1.0_wp), &
            & abs(square(l, 3)))
      end do
      hardly_stretched = farthest <= near
   end function hardly_stretched

   !> One over the length of the first vector, over the area, and over the length of the diagonal
   !> that makes both axes alike
   pure subroutine find_roots(square, inverse)
      !> From `span_face`
      real(wp), intent(in) :: square(lanes, 3)
      real(wp), intent(out) :: inverse(lanes, 3)
      integer :: l

      !$omp simd
      do l = 1, lanes
         inverse(l, 1) = 1.0_wp/sqrt(square(l, 1))
         inverse(l, 2) = 1.0_wp/sqrt(square(l, 2))
         inverse(l, 3) = 1.0_wp/sqrt(diagonal_square(square(l, 1), square(l, 2), square(l, 3), &
            & inverse(l, 1), inverse(l, 2)))
      end do
   end subroutine find_roots

   !> The same of numbers near 1, where divisions and roots take the longest by far
   pure subroutine find_near_roots(square, inverse)
      real(wp), intent(in) :: square(lanes, 3)
      real(wp), intent(out) :: inverse(lanes, 3)
      integer :: l

      !$omp simd
      do l = 1, lanes
         inverse(l, 1) = near_root(square(l, 1))
         inverse(l, 2) = near_root(square(l, 2))
         inverse(l, 3) = 0.5_wp*near_root(0.25_wp*diagonal_square(square(l, 1), square(l, 2), &
            & square(l, 3), inverse(l, 1), inverse(l, 2)))
      end do
   end subroutine find_near_roots

   !> Along and across the first vector this is (length, 0), the second one (lean, height): the
   !> square of (length + height, lean)
   pure real(wp) function diagonal_square(first, area, product, over_first, over_area)
      !> From `span_face`; and one over the roots of both squares
      real(wp), intent(in) :: first, area, product, over_first, over_area

      diagonal_square = ((first + area*over_area)**2 + product**2)*over_first**2
   end function diagonal_square

   !> One over the root of a number near 1 to all digits: three steps of Newton's method from the
   !> tangent, each of which squares the error, 3/8 of the square of the distance from 1
   pure real(wp) function near_root(x) result(y)
      real(wp), intent(in) :: x

      y = 1.5_wp - 0.5_wp*x
      y = y*(1.5_wp - 0.5_wp*x*y*y)
      y = y*(1.5_wp - 0.5_wp*x*y*y)
      y = y*(1.5_wp - 0.5_wp*x*y*y)
   end function near_root

   !> Make vectors of length 1 of the first one and of the normal, and turn the first about the
   !> normal, so that neither direction of the plane goes before the other
   pure subroutine turn_axes(square, inverse, axes, stretch)
      !> From `span_face` and `find_roots`
      real(wp), intent(in) :: square(lanes, 3), inverse(lanes, 3)
      real(wp), intent(inout) :: axes(lanes, 3, 3)
      real(wp), intent(out) :: stretch(lanes, 3)

      real(wp) :: a1, a2, a3, c, c1, c2, c3, height, lean, length, n1, n2, n3, s
      integer :: l

      !$omp simd private(a1, a2, a3, c, c1, c2, c3, height, lean, length, n1, n2, n3, s)
      do l = 1, lanes
         a1 = axes(l, 1, 1)*inverse(l, 1)
         a2 = axes(l, 2, 1)*inverse(l, 1)
         a3 = axes(l, 3, 1)*inverse(l, 1)
         n1 = axes(l, 1, 3)*inverse(l, 2)
         n2 = axes(l, 2, 3)*inverse(l, 2)
         n3 = axes(l, 3, 3)*inverse(l, 2)
         c1 = n2*a3 - n3*a2
         c2 = n3*a1 - n1*a3
         c3 = n1*a2 - n2*a1
         length = square(l, 1)*inverse(l, 1)
         height = square(l, 2)*inverse(l, 2)*inverse(l, 1)
         lean = square(l, 3)*inverse(l, 1)
         c = (length + height)*inverse(l, 3)
         s = -lean*inverse(l, 3)
         stretch(l, 1) = c*length
         stretch(l, 2) = -s*length
         stretch(l, 3) = c*height - s*lean
         axes(l, 1, 1) = c*a1 + s*c1
         axes(l, 2, 1) = c*a2 + s*c2
         axes(l, 3, 1) = c*a3 + s*c3
         axes(l, 1, 2) = c*c1 - s*a1
         axes(l, 2, 2) = c*c2 - s*a2
         axes(l, 3, 2) = c*c3 - s*a3
         axes(l, 1, 3) = n1
         axes(l, 2, 3) = n2
         axes(l, 3, 3) = n3
      end do
   end subroutine turn_axes

   !> Components in the axes of the face, in place
   pure subroutine rotate_in(points, axes, vector)
      !> Number of points
      integer, intent(in) :: points
      !> Axes
      real(wp), intent(in) :: axes(lanes, 3, 3, points)
      !> Vectors
      real(wp), intent(inout) :: vector(lanes, 3, points)

      real(wp) :: x, y, z
      integer :: k, l, q

      do q = 1, points
         !$omp simd private(k, x, y, z)
         do l = 1, lanes
            x = vector(l, 1, q)
            y = vector(l, 2, q)
            z = vector(l, 3, q)
            do k = 1, 3
               vector(l, k, q) = axes(l, 1, k, q)*x + axes(l, 2, k, q)*y + axes(l, 3, k, q)*z
            end do
         end do
      end do
   end subroutine rotate_in

   !> Components along x, y, z from those in the axes of the face, in place
   pure subroutine rotate_back(points, axes, vector)
      !> As in `rotate_in`
      integer, intent(in) :: points
      real(wp), intent(in) :: axes(lanes, 3, 3, points)
      real(wp), intent(inout) :: vector(lanes, 3, points)

      real(wp) :: x, y, z
      integer :: c, l, q

      do q = 1, points
         !$omp simd private(c, x, y, z)
         do l = 1, lanes
            x = vector(l, 1, q)
            y = vector(l, 2, q)
            z = vector(l, 3, q)
            do c = 1, 3
               vector(l, c, q) = axes(l, c, 1, q)*x + axes(l, c, 2, q)*y + axes(l, c, 3, q)*z
            end do
         end do
      end do
   end subroutine rotate_back

end module plydyn_element_interface_axes
