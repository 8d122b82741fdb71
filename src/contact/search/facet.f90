!> Facets as polynomials of their local coordinates, up to xi**2 eta**2, one facet in each lane.
!>
!> The coefficients are computed once per projection and evaluated in every Newton iteration.
module plydyn_contact_search_facet
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_shape, only : bilinear_nodes
   implicit none
   private

   public :: facet_polynomials, frames_at

   !> Entries of a frame: position, tangents along xi and eta, and second derivatives
   integer, parameter, public :: frame_value = 1, frame_xi = 2, frame_eta = 3, frame_xi_xi = 4, &
      & frame_eta_eta = 5, frame_xi_eta = 6, frame_size = 6

contains

   !> Coefficients of xi**p eta**q, (lanes, coordinates, p, q)
   pure subroutine facet_polynomials(nodes, x, polynomial)
      !> Points of a facet, 4 or 9
      integer, intent(in) :: nodes
      !> Their positions, length
      real(wp), intent(in) :: x(lanes, 3, nodes)
      !> The coefficients, length
      real(wp), intent(out) :: polynomial(lanes, 3, 0:2, 0:2)

      real(wp) :: line(lanes, 3, 0:2, -1:1)
      integer :: p

      if (nodes == bilinear_nodes) then
         polynomial(:, :, :, :) = 0.0_wp
         polynomial(:, :, 0, 0) = 0.25_wp*((x(:, :, 1) + x(:, :, 2)) + (x(:, :, 3) + x(:, :, 4)))
         polynomial(:, :, 1, 0) = 0.25_wp*((x(:, :, 2) - x(:, :, 1)) + (x(:, :, 3) - x(:, :, 4)))
         polynomial(:, :, 0, 1) = 0.25_wp*((x(:, :, 4) - x(:, :, 1)) + (x(:, :, 3) - x(:, :, 2)))
         polynomial(:, :, 1, 1) = 0.25_wp*((x(:, :, 1) - x(:, :, 2)) + (x(:, :, 3) - x(:, :, 4)))
      else
         call line_polynomials(x(:, :, 1), x(:, :, 5), x(:, :, 2), line(:, :, 0, -1), &
            & line(:, :, 1, -1), line(:, :, 2, -1))
         call line_polynomials(x(:, :, 8), x(:, :, 9), x(:, :, 6), line(:, :, 0, 0), &
            & line(:, :, 1, 0), line(:, :, 2, 0))
         call line_polynomials(x(:, :, 4), x(:, :, 7), x(:, :, 3), line(:, :, 0, 1), &
            & line(:, :, 1, 1), line(:, :, 2, 1))
         do p = 0, 2
            call line_polynomials(line(:, :, p, -1), line(:, :, p, 0), line(:, :, p, 1), &
               & polynomial(:, :, p, 0), polynomial(:, :, p, 1), polynomial(:, :, p, 2))
         end do
      end if
   end subroutine facet_polynomials

   !> Coefficients of parabolas through points at -1, 0 and 1
   pure subroutine line_polynomials(first, middle, last, constant, linear, square)
      !> The points, length
      real(wp), intent(in), dimension(lanes, 3) :: first, middle, last
      !> The coefficients, length
      real(wp), intent(out), dimension(lanes, 3) :: constant, linear, square

      constant(:, :) = middle
      linear(:, :) = 0.5_wp*(last - first)
      square(:, :) = 0.5_wp*((last - middle) + (first - middle))
   end subroutine line_polynomials

   !> Positions, tangents and second derivatives of the facets at local coordinates
   pure subroutine frames_at(polynomial, local, frame)
      !> From `facet_polynomials`
      real(wp), intent(in) :: polynomial(lanes, 3, 0:2, 0:2)
      !> Local coordinates
      real(wp), intent(in) :: local(lanes, 2)
      !> The frames, length
      real(wp), intent(out) :: frame(lanes, 3, frame_size)

      real(wp) :: curvature(0:2), eta, slope(0:2), value(0:2), xi
      integer :: c, l

      do c = 1, 3
         !$omp simd private(curvature, eta, slope, value, xi)
         do l = 1, lanes
            xi = local(l, 1)
            eta = local(l, 2)
            value(:) = polynomial(l, c, :, 0) + eta*(polynomial(l, c, :, 1) &
               & + eta*polynomial(l, c, :, 2))
            slope(:) = polynomial(l, c, :, 1) + 2.0_wp*eta*polynomial(l, c, :, 2)
            curvature(:) = 2.0_wp*polynomial(l, c, :, 2)
            frame(l, c, frame_value) = value(0) + xi*(value(1) + xi*value(2))
            frame(l, c, frame_xi) = value(1) + 2.0_wp*xi*value(2)
            frame(l, c, frame_eta) = slope(0) + xi*(slope(1) + xi*slope(2))
            frame(l, c, frame_xi_xi) = 2.0_wp*value(2)
            frame(l, c, frame_eta_eta) = curvature(0) + xi*(curvature(1) + xi*curvature(2))
            frame(l, c, frame_xi_eta) = slope(1) + 2.0_wp*xi*slope(2)
         end do
      end do
   end subroutine frames_at

end module plydyn_contact_search_facet
