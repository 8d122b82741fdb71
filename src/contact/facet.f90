!> A facet as a polynomial of its local coordinates, up to xi**2 eta**2: made once, it is evaluated
!> at one place after the other for little.
module plydyn_contact_facet
   use plydyn_base_precision, only : wp
   use plydyn_fem_shape, only : bilinear_nodes
   implicit none
   private

   public :: facet_polynomial, frame_at

   !> Coordinates, and a zero that fills a vector
   integer, parameter, public :: wide = 4

   !> Columns of a frame: position, tangents along xi and eta, and second derivatives
   integer, parameter, public :: frame_value = 1, frame_xi = 2, frame_eta = 3, frame_xi_xi = 4, &
      & frame_eta_eta = 5, frame_xi_eta = 6, frame_size = 6

contains

   !> Coefficients of xi**p eta**q, (wide, p, q)
   pure subroutine facet_polynomial(nodes, x, polynomial)
      !> Points of the facet, 4 or 9
      integer, intent(in) :: nodes
      !> Where they are, length
      real(wp), intent(in) :: x(wide, nodes)
      !> The coefficients, length
      real(wp), intent(out) :: polynomial(wide, 0:2, 0:2)

      real(wp) :: line(wide, 0:2, -1:1)
      integer :: p

      if (nodes == bilinear_nodes) then
         polynomial(:, :, :) = 0.0_wp
         polynomial(:, 0, 0) = 0.25_wp*((x(:, 1) + x(:, 2)) + (x(:, 3) + x(:, 4)))
         polynomial(:, 1, 0) = 0.25_wp*((x(:, 2) - x(:, 1)) + (x(:, 3) - x(:, 4)))
         polynomial(:, 0, 1) = 0.25_wp*((x(:, 4) - x(:, 1)) + (x(:, 3) - x(:, 2)))
         polynomial(:, 1, 1) = 0.25_wp*((x(:, 1) - x(:, 2)) + (x(:, 3) - x(:, 4)))
      else
         call line_polynomial(x(:, 1), x(:, 5), x(:, 2), line(:, :, -1))
         call line_polynomial(x(:, 8), x(:, 9), x(:, 6), line(:, :, 0))
         call line_polynomial(x(:, 4), x(:, 7), x(:, 3), line(:, :, 1))
         do p = 0, 2
            call line_polynomial(line(:, p, -1), line(:, p, 0), line(:, p, 1), polynomial(:, p, :))
         end do
      end if
   end subroutine facet_polynomial

   !> Coefficients of a parabola through points at -1, 0 and 1
   pure subroutine line_polynomial(first, middle, last, polynomial)
      !> The points, length
      real(wp), intent(in) :: first(wide), middle(wide), last(wide)
      !> The coefficients, length
      real(wp), intent(out) :: polynomial(wide, 0:2)

      polynomial(:, 0) = middle
      polynomial(:, 1) = 0.5_wp*(last - first)
      polynomial(:, 2) = 0.5_wp*((last - middle) + (first - middle))
   end subroutine line_polynomial

   !> Position, tangents and second derivatives at a place of the facet
   pure subroutine frame_at(polynomial, place, frame)
      !> From `facet_polynomial`
      real(wp), intent(in) :: polynomial(wide, 0:2, 0:2)
      !> Local coordinates
      real(wp), intent(in) :: place(2)
      !> The frame, (wide, frame_size), length
      real(wp), intent(out) :: frame(wide, frame_size)

      real(wp), dimension(wide, 0:2) :: bend, slope, value

      associate (c => polynomial, xi => place(1), eta => place(2))
         value(:, :) = c(:, :, 0) + eta*(c(:, :, 1) + eta*c(:, :, 2))
         slope(:, :) = c(:, :, 1) + 2.0_wp*eta*c(:, :, 2)
         bend(:, :) = 2.0_wp*c(:, :, 2)
         frame(:, frame_value) = value(:, 0) + xi*(value(:, 1) + xi*value(:, 2))
         frame(:, frame_xi) = value(:, 1) + 2.0_wp*xi*value(:, 2)
         frame(:, frame_eta) = slope(:, 0) + xi*(slope(:, 1) + xi*slope(:, 2))
         frame(:, frame_xi_xi) = 2.0_wp*value(:, 2)
         frame(:, frame_eta_eta) = bend(:, 0) + xi*(bend(:, 1) + xi*bend(:, 2))
         frame(:, frame_xi_eta) = slope(:, 1) + 2.0_wp*xi*slope(:, 2)
      end associate
   end subroutine frame_at

end module plydyn_contact_facet
