!> Closest-point projection on facets by Newton's method, one facet and one point in each lane.
!>
!> Facets are polynomials of their local coordinates, up to xi**2 eta**2. The coefficients are
!> computed once per projection and evaluated in every iteration. A bound on the distance between a
!> facet and a body tells where there is something to project.
module plydyn_contact_search_closest_point
   use plydyn_base_precision, only : lanes, wp
   use plydyn_contact_bodies_revolved_body, only : revolved_body_type
   use plydyn_fem_shape, only : bilinear_nodes
   implicit none
   private

   public :: closest_points, distance_bound, facet_polynomials, frames_at

   !> Entries of a frame: position, tangents along xi and eta, and second derivatives
   integer, parameter, public :: frame_value = 1, frame_xi = 2, frame_eta = 3, frame_xi_xi = 4, &
      & frame_eta_eta = 5, frame_xi_eta = 6, frame_size = 6

   !> Steps of Newton's method before giving up
   integer, parameter :: max_steps = 30

   !> Largest step at convergence, in local coordinates; as convergence is quadratic, the error of
   !> the result is its square, and that of the gap its fourth power
   real(wp), parameter :: last_step = 1.0e-4_wp

   !> Relative increase of a squared distance that may be round-off
   real(wp), parameter :: round_off = 1.0e-14_wp

   !> Smallest determinant of a regular Hessian, over the product of the squared tangents
   real(wp), parameter :: regular = 1.0e-6_wp

contains

   !> Local coordinates of closest points; positions and derivatives of the facets there
   pure subroutine closest_points(nodes, x, local, frame)
      !> Points of a facet, 4 or 9
      integer, intent(in) :: nodes
      !> Their positions relative to the point of the lane, length
      real(wp), intent(in) :: x(lanes, 3, nodes)
      !> Start in, closest point out, within the facet
      real(wp), intent(inout) :: local(lanes, 2)
      !> The facets there, relative to the points, length
      real(wp), intent(out) :: frame(lanes, 3, frame_size)

      real(wp) :: hessian(lanes, 3), last(lanes), newton(lanes, 2), polynomial(lanes, 3, 0:2, 0:2)
      real(wp) :: descent(lanes, 2), step(lanes, 2)
      integer :: iteration

      call facet_polynomials(nodes, x, polynomial)
      last(:) = 0.5_wp*huge(1.0_wp)
      step(:, :) = 1.0_wp
      do iteration = 1, max_steps
         call frames_at(polynomial, local, frame)
         if (maxval(abs(step)) <= last_step .or. iteration == max_steps) exit
         call find_derivatives(frame, descent, hessian)
         call newton_step(descent, hessian, local, newton)
         call apply_steps(frame(:, :, frame_value), newton, local, step, last)
      end do
   end subroutine closest_points

   !> Descent directions of half the squared distances, and the Hessians
   pure subroutine find_derivatives(frame, descent, hessian)
      !> The facets, relative to the points
      real(wp), intent(in) :: frame(lanes, 3, frame_size)
      !> Along xi and eta
      real(wp), intent(out) :: descent(lanes, 2)
      !> Along xi xi, eta eta and xi eta; of Gauss and Newton where the distance is not convex
      real(wp), intent(out) :: hessian(lanes, 3)

      real(wp) :: along(frame_xi:frame_size), gap(3), metric(3)
      integer :: c, l

      !$omp simd private(along, gap, metric)
      do l = 1, lanes
         gap(:) = -frame(l, :, frame_value)
         along(:) = frame(l, 1, frame_xi:)*gap(1) + frame(l, 2, frame_xi:)*gap(2) &
            & + frame(l, 3, frame_xi:)*gap(3)
         metric(:) = 0.0_wp
         do c = 1, 3
            metric(1) = metric(1) + frame(l, c, frame_xi)*frame(l, c, frame_xi)
            metric(2) = metric(2) + frame(l, c, frame_eta)*frame(l, c, frame_eta)
            metric(3) = metric(3) + frame(l, c, frame_xi)*frame(l, c, frame_eta)
         end do
         descent(l, :) = along(frame_xi:frame_eta)
         hessian(l, 1) = metric(1) - along(frame_xi_xi)
         hessian(l, 2) = metric(2) - along(frame_eta_eta)
         hessian(l, 3) = metric(3) - along(frame_xi_eta)
         if (hessian(l, 1) < regular*metric(1) .or. hessian(l, 2) < regular*metric(2) .or. &
            & hessian(l, 1)*hessian(l, 2) - hessian(l, 3)**2 < regular*metric(1)*metric(2)) then
            hessian(l, 1) = metric(1)
            hessian(l, 2) = metric(2)
            hessian(l, 3) = metric(3)
         end if
      end do
   end subroutine find_derivatives

   !> Newton steps, stopped at the side that they cross first and continued along that side
   pure subroutine newton_step(descent, hessian, local, step)
      !> From `find_derivatives`
      real(wp), intent(in) :: descent(lanes, 2), hessian(lanes, 3)
      !> Local coordinates
      real(wp), intent(in) :: local(lanes, 2)
      !> The steps
      real(wp), intent(out) :: step(lanes, 2)

      real(wp) :: along(2), cut(2), determinant, free(2), clearance(2)
      logical :: is_first, is_free
      integer :: l

      !$omp simd private(along, cut, determinant, free, clearance, is_first, is_free)
      do l = 1, lanes
         determinant = hessian(l, 1)*hessian(l, 2) - hessian(l, 3)**2
         free(1) = (hessian(l, 2)*descent(l, 1) - hessian(l, 3)*descent(l, 2))/determinant
         free(2) = (hessian(l, 1)*descent(l, 2) - hessian(l, 3)*descent(l, 1))/determinant
         clearance(1) = merge(1.0_wp - local(l, 1), 1.0_wp + local(l, 1), free(1) > 0.0_wp)
         clearance(2) = merge(1.0_wp - local(l, 2), 1.0_wp + local(l, 2), free(2) > 0.0_wp)
         clearance(1) = merge(clearance(1), 0.0_wp, clearance(1) > 0.0_wp)
         clearance(2) = merge(clearance(2), 0.0_wp, clearance(2) > 0.0_wp)
         cut(1) = sign(clearance(1), free(1))
         cut(2) = sign(clearance(2), free(2))
         ! along eta where xi is cut, and the other way round
         along(1) = (descent(l, 1) - hessian(l, 3)*cut(2))/hessian(l, 1)
         along(2) = (descent(l, 2) - hessian(l, 3)*cut(1))/hessian(l, 2)
         along(1) = merge(along(1), 1.0_wp - local(l, 1), along(1) < 1.0_wp - local(l, 1))
         along(2) = merge(along(2), 1.0_wp - local(l, 2), along(2) < 1.0_wp - local(l, 2))
         along(1) = merge(along(1), -1.0_wp - local(l, 1), along(1) > -1.0_wp - local(l, 1))
         along(2) = merge(along(2), -1.0_wp - local(l, 2), along(2) > -1.0_wp - local(l, 2))
         is_free = abs(free(1)) <= clearance(1) .and. abs(free(2)) <= clearance(2)
         is_first = clearance(1)*abs(free(2)) <= clearance(2)*abs(free(1))
         step(l, 1) = merge(free(1), merge(cut(1), along(1), is_first), is_free)
         step(l, 2) = merge(free(2), merge(along(2), cut(2), is_first), is_free)
      end do
   end subroutine newton_step

   !> Apply the steps; halve the last one where it increased the distance
   pure subroutine apply_steps(value, newton, local, step, last)
      !> The facets at the local coordinates, relative to the points
      real(wp), intent(in) :: value(lanes, 3)
      !> Newton's steps
      real(wp), intent(in) :: newton(lanes, 2)
      !> Local coordinates; those that have converged are kept
      real(wp), intent(inout) :: local(lanes, 2)
      !> The last steps in, the new ones out
      real(wp), intent(inout) :: step(lanes, 2)
      !> Squared distances before the last steps
      real(wp), intent(inout) :: last(lanes)

      real(wp) :: squared
      integer :: c, l

      !$omp simd private(squared)
      do l = 1, lanes
         squared = 0.0_wp
         do c = 1, 3
            squared = squared + value(l, c)*value(l, c)
         end do
         if (max(abs(step(l, 1)), abs(step(l, 2))) > last_step) then
            if (squared > (1.0_wp + round_off)*last(l)) then
               step(l, 1) = 0.5_wp*step(l, 1)
               step(l, 2) = 0.5_wp*step(l, 2)
               local(l, 1) = local(l, 1) - step(l, 1)
               local(l, 2) = local(l, 2) - step(l, 2)
            else
               last(l) = squared
               step(l, 1) = newton(l, 1)
               step(l, 2) = newton(l, 2)
               local(l, 1) = local(l, 1) + newton(l, 1)
               local(l, 2) = local(l, 2) + newton(l, 2)
            end if
         end if
      end do
   end subroutine apply_steps

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

   !> Lower bound on the distance from a core to a facet, length
   !>
   !> A facet lies within the convex hull of its control points in Bernstein's form. The bounding
   !> sphere of these points bounds the distance from below; so does their bounding box where the
   !> core is a point.
   pure real(wp) function distance_bound(node, centre, body) result(distance)
      !> Points of the facet, (3, 4 or 9), length
      real(wp), intent(in) :: node(:, :)
      !> Centre of the body, length
      real(wp), intent(in) :: centre(3)
      type(revolved_body_type), intent(in) :: body

      real(wp) :: control(3, size(node, 2)), middle(3), normal(3), outside(3), hull_radius
      integer :: i

      control(:, :) = control_points(node)
      middle(:) = node(:, size(node, 2))
      hull_radius = 0.0_wp
      do i = 1, size(node, 2)
         hull_radius = max(hull_radius, norm2(control(:, i) - middle))
      end do
      call body%find_core(centre - middle, distance, normal)
      distance = distance - hull_radius
      if (size(body%corner, 2) > 1) return
      outside(:) = max(minval(control, 2) - centre, centre - maxval(control, 2), 0.0_wp)
      distance = max(norm2(outside), distance)
   end function distance_bound

   !> Bernstein control points of a facet
   pure function control_points(node) result(control)
      real(wp), intent(in) :: node(:, :)
      real(wp) :: control(3, size(node, 2))

      control(:, :) = node
      if (size(node, 2) == bilinear_nodes) return
      control(:, 5) = control_point(node(:, 1), node(:, 5), node(:, 2))
      control(:, 6) = control_point(node(:, 2), node(:, 6), node(:, 3))
      control(:, 7) = control_point(node(:, 3), node(:, 7), node(:, 4))
      control(:, 8) = control_point(node(:, 4), node(:, 8), node(:, 1))
      control(:, 9) = control_point(control(:, 5), &
         & control_point(node(:, 8), node(:, 9), node(:, 6)), control(:, 7))
   end function control_points

   !> Middle control point of the parabola through points at -1, 0 and 1
   pure function control_point(first, middle, last) result(control)
      real(wp), intent(in), dimension(3) :: first, middle, last
      real(wp) :: control(3)

      control(:) = 2.0_wp*middle - 0.5_wp*(first + last)
   end function control_point

end module plydyn_contact_search_closest_point
