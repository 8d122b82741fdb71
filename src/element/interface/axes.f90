!> Axes of the deformed faces of interfaces.
module plydyn_element_interface_axes
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: find_axes, rotate_back, rotate_in

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

      real(wp) :: a1, a2, a3, area, b1, b2, b3, c, c1, c2, c3, height, inverse, lean, length
      real(wp) :: n1, n2, n3, s
      integer :: l

      associate (x => 0.5_wp*metric(1:3:2), y => 0.5_wp*metric(2:4:2))
         !$omp simd private(a1, a2, a3, area, b1, b2, b3, c, c1, c2, c3, height, inverse, lean, &
         !$omp& length, n1, n2, n3, s)
         do l = 1, lanes
            ! what has become of the unit vectors along x and y
            a1 = 1.0_wp + along(l, 1, 1)*x(1) + along(l, 1, 2)*x(2)
            a2 = along(l, 2, 1)*x(1) + along(l, 2, 2)*x(2)
            a3 = along(l, 3, 1)*x(1) + along(l, 3, 2)*x(2)
            b1 = along(l, 1, 1)*y(1) + along(l, 1, 2)*y(2)
            b2 = 1.0_wp + along(l, 2, 1)*y(1) + along(l, 2, 2)*y(2)
            b3 = along(l, 3, 1)*y(1) + along(l, 3, 2)*y(2)
            n1 = a2*b3 - a3*b2
            n2 = a3*b1 - a1*b3
            n3 = a1*b2 - a2*b1
            call normalise(n1, n2, n3, area, inverse)
            call normalise(a1, a2, a3, length, inverse)
            c1 = n2*a3 - n3*a2
            c2 = n3*a1 - n1*a3
            c3 = n1*a2 - n2*a1
            ! along a and across it a is (length, 0), b (lean, height); c and s make them alike
            lean = a1*b1 + a2*b2 + a3*b3
            height = area*inverse
            inverse = 1.0_wp/sqrt((length + height)**2 + lean**2)
            c = (length + height)*inverse
            s = -lean*inverse
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
      end associate
   end subroutine point_axes

   !> Make a vector one of length 1
   pure subroutine normalise(x, y, z, length, inverse)
      real(wp), intent(inout) :: x, y, z
      !> Its length, and one over that
      real(wp), intent(out) :: length, inverse

      length = sqrt(x*x + y*y + z*z)
      inverse = 1.0_wp/length
      x = x*inverse
      y = y*inverse
      z = z*inverse
   end subroutine normalise

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
