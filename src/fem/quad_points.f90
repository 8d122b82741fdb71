!> Integration points of an interface over a quad.
module plydyn_fem_quad_points
   use plydyn_base_precision, only : wp
   use plydyn_fem_quadrature, only : gauss_points
   use plydyn_fem_shape, only : shape_functions
   implicit none
   private

   public :: quad_points

contains

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

end module plydyn_fem_quad_points
