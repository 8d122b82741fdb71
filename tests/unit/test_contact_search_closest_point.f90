!> Facets as polynomials.
program test_contact_search_closest_point
   use monomial, only : bend, slope
   use plydyn_base_precision, only : lanes, wp
   use plydyn_contact_search_closest_point, only : facet_polynomials, frame_eta, &
      & frame_eta_eta, frame_size, frame_value, frame_xi, frame_xi_eta, frame_xi_xi, frames_at
   use plydyn_fem_shape, only : bilinear_nodes, biquadratic_nodes, local_nodes, shape_functions
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: xi = 0.3_wp, eta = -0.7_wp, round_off = 1.0e-14_wp

   call check_monomials(bilinear_nodes)
   call check_monomials(biquadratic_nodes)
   call check_interpolation(bilinear_nodes)
   call check_interpolation(biquadratic_nodes)
   call finish()

contains

   !> A point that lies as high as a monomial says has its value, slopes and second derivatives
   subroutine check_monomials(nodes)
      !> Points of the facet
      integer, intent(in) :: nodes

      real(wp) :: frame(3, frame_size), height(nodes), local(2, nodes)
      integer :: a, b, degree

      call begin("frames_at, monomials")
      degree = merge(1, 2, nodes == bilinear_nodes)
      local(:, :) = local_nodes(nodes)
      do b = 0, degree
         do a = 0, degree
            height(:) = local(1, :)**a*local(2, :)**b
            call find_frame(nodes, spread(height, 1, 3), frame)
            call check(frame(3, frame_value), xi**a*eta**b, round_off, "value")
            call check(frame(3, frame_xi), slope(xi, a)*eta**b, round_off, "along xi")
            call check(frame(3, frame_eta), xi**a*slope(eta, b), round_off, "along eta")
            call check(frame(3, frame_xi_xi), bend(xi, a)*eta**b, round_off, "xi xi")
            call check(frame(3, frame_eta_eta), xi**a*bend(eta, b), round_off, "eta eta")
            call check(frame(3, frame_xi_eta), slope(xi, a)*slope(eta, b), round_off, "xi eta")
         end do
      end do
   end subroutine check_monomials

   !> Any facet is what the shape functions make of its points, in all coordinates
   subroutine check_interpolation(nodes)
      !> Points of the facet
      integer, intent(in) :: nodes

      real(wp) :: dn(2, nodes), frame(3, frame_size), n(nodes), x(3, nodes)
      integer :: i

      call begin("frames_at, any facet")
      do i = 1, nodes
         x(:, i) = [sin(3.1_wp*i), cos(1.7_wp*i), sin(0.9_wp*i**2)]
      end do
      call find_frame(nodes, x, frame)
      call shape_functions(nodes, xi, eta, n, dn)
      call check(frame(:, frame_value), matmul(x, n), round_off, "position")
      call check(frame(:, frame_xi), matmul(x, dn(1, :)), round_off, "along xi")
      call check(frame(:, frame_eta), matmul(x, dn(2, :)), round_off, "along eta")
   end subroutine check_interpolation

   !> Frame of a facet at the place of the test, in the last lane; another one is in the others
   subroutine find_frame(nodes, x, frame)
      !> Points of the facet: how many, and where
      integer, intent(in) :: nodes
      real(wp), intent(in) :: x(3, nodes)
      !> The frame
      real(wp), intent(out) :: frame(3, frame_size)

      real(wp) :: frames(lanes, 3, frame_size), local(lanes, 2), polynomial(lanes, 3, 0:2, 0:2)
      real(wp) :: points(lanes, 3, nodes)

      points(:, :, :) = 1.0_wp
      local(:, :) = 0.0_wp
      points(lanes, :, :) = x
      local(lanes, :) = [xi, eta]
      call facet_polynomials(nodes, points, polynomial)
      call frames_at(polynomial, local, frames)
      call check(maxval(abs(frames(:lanes - 1, :, frame_value) - 1.0_wp)), 0.0_wp, round_off, &
         & "the other lanes do not mind")
      frame(:, :) = frames(lanes, :, :)
   end subroutine find_frame

end program test_contact_search_closest_point
