!> The patch in contact: its area, its largest pressure, its centre of pressure.
!>
!> The forces of the rows are distributed to the points of the plate by their shape functions. The
!> pressure at a point is its force over its tributary area, so that a uniform pressure gives a
!> uniform one. The area is that of the points under pressure: area times pressure, summed over
!> them, is the force. Where contact nodes lie between points it is too large by about half a facet
!> around the patch.
module plydyn_contact_patch
   use plydyn_base_matrix, only : cross
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : constraints_type, correction_type
   use plydyn_fem_quadrature, only : gauss_points, gauss_weights
   use plydyn_fem_shape, only : shape_functions
   implicit none
   private

   public :: new_patch, point_areas

   !> A patch, of one contact pair or of several
   type, public :: contact_patch_type
      !> Area in contact, length squared
      real(wp) :: area = 0.0_wp
      !> Rows that carry a force
      integer :: rows = 0
      !> Largest pressure
      real(wp) :: largest_pressure = 0.0_wp
      !> Mean position of the forces on the rows, length; zero without a force
      real(wp) :: centre(3) = 0.0_wp
      !> Sum of the magnitudes of these forces
      real(wp) :: force = 0.0_wp
   end type contact_patch_type

   !> Pressure that is round-off, as a share of the largest
   real(wp), parameter :: round_off = 1.0e-6_wp
   !> Gauss points along a side of a facet
   integer, parameter :: points_along = 3

contains

   !> Tributary areas of surface points: integrals of their shape functions over the facets
   pure function point_areas(facet, position) result(area)
      !> Points of each facet, (4 or 9, facets)
      integer, intent(in) :: facet(:, :)
      !> Surface points, (3, points), length
      real(wp), intent(in) :: position(:, :)
      real(wp) :: area(size(position, 2))

      real(wp) :: n(size(facet, 1)), dn(2, size(facet, 1)), tangent(3, 2), w(points_along)
      real(wp) :: x(points_along)
      integer :: f, i, j

      x(:) = gauss_points(points_along)
      w(:) = gauss_weights(points_along)
      area(:) = 0.0_wp
      do f = 1, size(facet, 2)
         do j = 1, points_along
            do i = 1, points_along
               call shape_functions(size(n), x(i), x(j), n, dn)
               tangent(:, :) = matmul(position(:, facet(:, f)), transpose(dn))
               area(facet(:, f)) = area(facet(:, f)) &
                  & + w(i)*w(j)*n*norm2(cross(tangent(:, 1), tangent(:, 2)))
            end do
         end do
      end do
   end function point_areas

   !> The patch of a contact pair after the correction of a step
   pure type(contact_patch_type) function new_patch(rows, point_area, position, correction, dt) &
      & result(self)
      !> The constraints with their multipliers
      type(constraints_type), intent(in) :: rows
      !> Tributary area of each surface point
      real(wp), intent(in) :: point_area(:)
      !> Trial positions of the points of the rows, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Correction of the surface points, length
      type(correction_type), intent(in) :: correction
      !> Step
      real(wp), intent(in) :: dt

      real(wp) :: force, pressure(size(point_area))
      integer :: i, row

      pressure(:) = 0.0_wp
      do row = 1, rows%count
         force = rows%multiplier(row)/dt**2
         if (force <= 0.0_wp) cycle
         self%rows = self%rows + 1
         self%force = self%force + force
         do i = 1, size(rows%point, 1)
            associate (k => rows%point(i, row), weight => rows%weight(i, row))
               pressure(k) = pressure(k) + weight*force/point_area(k)
               self%centre(:) = self%centre + weight*force &
                  & *(position(:, k) + correction%displacement(:, k))
            end associate
         end do
      end do
      if (self%rows == 0) return
      self%centre(:) = self%centre/self%force
      self%largest_pressure = maxval(pressure)
      self%area = sum(point_area, pressure > round_off*self%largest_pressure)
   end function new_patch

end module plydyn_contact_patch
