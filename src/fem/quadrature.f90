!> Gauss-Legendre and Gauss-Lobatto points of the interval -1 to 1, and the integration points of an
!> interface over a quad.
module plydyn_fem_quadrature
   use plydyn_base_precision, only : wp
   use plydyn_fem_shape, only : shape_functions
   implicit none
   private

   public :: equal_points, gauss_points, gauss_weights, legendre, lobatto_points, quad_points

contains

   !> Legendre polynomial and its derivative, by Bonnet's recursion
   pure subroutine legendre(degree, x, value, slope)
      !> Degree, 0 or more
      integer, intent(in) :: degree
      !> Abscissa
      real(wp), intent(in) :: x
      !> P(x) and dP/dx
      real(wp), intent(out) :: value, slope

      real(wp) :: before, next
      integer :: k

      before = 0.0_wp
      value = 1.0_wp
      slope = 0.0_wp
      do k = 1, degree
         slope = x*slope + real(k, wp)*value
         next = (real(2*k - 1, wp)*x*value - real(k - 1, wp)*before)/real(k, wp)
         before = value
         value = next
      end do
   end subroutine legendre

   !> Points of the Gauss-Legendre rule, in ascending order: zeros of the Legendre polynomial
   pure function gauss_points(n) result(x)
      !> Number of points
      integer, intent(in) :: n
      real(wp) :: x(n)

      real(wp), parameter :: pi = acos(-1.0_wp)
      real(wp) :: slope, value
      integer :: i, pass

      do i = 1, n
         x(i) = -cos(pi*(real(i, wp) - 0.25_wp)/(real(n, wp) + 0.5_wp))
         do pass = 1, 10
            call legendre(n, x(i), value, slope)
            x(i) = x(i) - value/slope
         end do
      end do
      x(:) = 0.5_wp*(x - x(n:1:-1))
   end function gauss_points

   !> Weights of the Gauss points; their sum is 2
   pure function gauss_weights(n) result(w)
      !> Number of points
      integer, intent(in) :: n
      real(wp) :: w(n)

      real(wp) :: slope, value, x(n)
      integer :: i

      x(:) = gauss_points(n)
      do i = 1, n
         call legendre(n, x(i), value, slope)
         w(i) = 2.0_wp/((1.0_wp - x(i)**2)*slope**2)
      end do
   end function gauss_weights

   !> Points of equal spacing, in ascending order, both ends among them
   pure function equal_points(n) result(x)
      !> Number of points, 2 or more
      integer, intent(in) :: n
      real(wp) :: x(n)

      integer :: i

      x(:) = [(-1.0_wp + 2.0_wp*real(i - 1, wp)/real(n - 1, wp), i=1, n)]
   end function equal_points

   !> Points of the Gauss-Lobatto rule, in ascending order: ends and extrema of the polynomial
   pure function lobatto_points(n) result(x)
      !> Number of points, 2 or more
      integer, intent(in) :: n
      real(wp) :: x(n)

      real(wp), parameter :: pi = acos(-1.0_wp)
      real(wp) :: curvature, slope, value
      integer :: i, pass

      do i = 1, n
         x(i) = -cos(pi*real(i - 1, wp)/real(n - 1, wp))
         if (i == 1 .or. i == n) cycle
         do pass = 1, 10
            call legendre(n - 1, x(i), value, slope)
            curvature = (2.0_wp*x(i)*slope - real(n*(n - 1), wp)*value)/(1.0_wp - x(i)**2)
            x(i) = x(i) - slope/curvature
         end do
      end do
      x(:) = 0.5_wp*(x - x(n:1:-1))
   end function lobatto_points

   !> Positions of the points in the plane, along xi first, then eta, (2, nodes), length
   pure function quad_points(position, nodal) result(point)
      !> Positions of the nodes in the order of the deck, (2, nodes), length
      real(wp), intent(in) :: position(:, :)
      !> Points at the nodes, else as many Gauss points
      logical, intent(in) :: nodal
      real(wp) :: point(2, size(position, 2))

      real(wp) :: shape(size(position, 2)), slope(2, size(position, 2))
      real(wp) :: x(nint(sqrt(real(size(position, 2), wp))))
      integer :: i, j

      x(:) = gauss_points(size(x))
      if (nodal) x(:) = x/maxval(x)
      do j = 1, size(x)
         do i = 1, size(x)
            call shape_functions(size(position, 2), x(i), x(j), shape, slope)
            point(:, i + size(x)*(j - 1)) = matmul(position, shape)
         end do
      end do
   end function quad_points

end module plydyn_fem_quadrature
