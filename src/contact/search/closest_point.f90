!> Closest points of facets by Newton's method, one facet and one point in each lane.
module plydyn_contact_search_closest_point
   use plydyn_base_precision, only : lanes, wp
   use plydyn_contact_search_facet, only : facet_polynomials, frame_eta, frame_eta_eta, &
      & frame_size, &
      & frame_value, frame_xi, frame_xi_eta, frame_xi_xi, frames_at
   implicit none
   private

   public :: closest_points

   !> Steps of Newton's method before giving up
   integer, parameter :: most_steps = 30

   !> A step this small, in local coordinates, is the last: the error after it is its square, and
   !> that of the gap the square of this
   real(wp), parameter :: last_step = 1.0e-4_wp

   !> Growth of a squared distance that may be round-off
   real(wp), parameter :: round_off = 1.0e-14_wp

   !> Share of the product of the tangents' squares that a regular determinant exceeds
   real(wp), parameter :: regular = 1.0e-6_wp

contains

   !> Places where facets come closest to their points, and what the facets are there
   pure subroutine closest_points(nodes, x, place, frame)
      !> Points of a facet, 4 or 9
      integer, intent(in) :: nodes
      !> Where they are, seen from the point of the lane, length
      real(wp), intent(in) :: x(lanes, 3, nodes)
      !> Start in, closest place out, inside the facet
      real(wp), intent(inout) :: place(lanes, 2)
      !> The facets there, seen from the points, length
      real(wp), intent(out) :: frame(lanes, 3, frame_size)

      real(wp) :: curve(lanes, 3), last(lanes), newton(lanes, 2), polynomial(lanes, 3, 0:2, 0:2)
      real(wp) :: slope(lanes, 2), step(lanes, 2)
      integer :: iteration

      call facet_polynomials(nodes, x, polynomial)
      last(:) = 0.5_wp*huge(1.0_wp)
      step(:, :) = 1.0_wp
      do iteration = 1, most_steps
         call frames_at(polynomial, place, frame)
         if (maxval(abs(step)) <= last_step .or. iteration == most_steps) exit
         call find_slopes(frame, slope, curve)
         call newton_step(slope, curve, place, newton)
         call go_on(frame(:, :, frame_value), newton, place, step, last)
      end do
   end subroutine closest_points

   !> Slopes of half the squared distances, downhill, and their second derivatives
   pure subroutine find_slopes(frame, slope, curve)
      !> The facets, seen from the points
      real(wp), intent(in) :: frame(lanes, 3, frame_size)
      !> Along xi and eta
      real(wp), intent(out) :: slope(lanes, 2)
      !> Along xi xi, eta eta and xi eta; Gauss and Newton's where the distance is not convex
      real(wp), intent(out) :: curve(lanes, 3)

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
         slope(l, :) = along(frame_xi:frame_eta)
         curve(l, 1) = metric(1) - along(frame_xi_xi)
         curve(l, 2) = metric(2) - along(frame_eta_eta)
         curve(l, 3) = metric(3) - along(frame_xi_eta)
         if (curve(l, 1) < regular*metric(1) .or. curve(l, 2) < regular*metric(2) &
            & .or. curve(l, 1)*curve(l, 2) - curve(l, 3)**2 < regular*metric(1)*metric(2)) then
            curve(l, 1) = metric(1)
            curve(l, 2) = metric(2)
            curve(l, 3) = metric(3)
         end if
      end do
   end subroutine find_slopes

   !> Newton steps towards the closest points, cut at the side that they cross first; on they go
   !> along that side
   pure subroutine newton_step(slope, curve, place, step)
      !> From `find_slopes`
      real(wp), intent(in) :: slope(lanes, 2), curve(lanes, 3)
      !> Places in the facets
      real(wp), intent(in) :: place(lanes, 2)
      !> The steps
      real(wp), intent(out) :: step(lanes, 2)

      real(wp) :: along(2), cut(2), determinant, free(2), room(2)
      logical :: is_first, is_free
      integer :: l

      !$omp simd private(along, cut, determinant, free, room, is_first, is_free)
      do l = 1, lanes
         determinant = curve(l, 1)*curve(l, 2) - curve(l, 3)**2
         free(1) = (curve(l, 2)*slope(l, 1) - curve(l, 3)*slope(l, 2))/determinant
         free(2) = (curve(l, 1)*slope(l, 2) - curve(l, 3)*slope(l, 1))/determinant
         room(1) = merge(1.0_wp - place(l, 1), 1.0_wp + place(l, 1), free(1) > 0.0_wp)
         room(2) = merge(1.0_wp - place(l, 2), 1.0_wp + place(l, 2), free(2) > 0.0_wp)
         room(1) = merge(room(1), 0.0_wp, room(1) > 0.0_wp)
         room(2) = merge(room(2), 0.0_wp, room(2) > 0.0_wp)
         cut(1) = sign(room(1), free(1))
         cut(2) = sign(room(2), free(2))
         ! along eta where xi is cut, and the other way round
         along(1) = (slope(l, 1) - curve(l, 3)*cut(2))/curve(l, 1)
         along(2) = (slope(l, 2) - curve(l, 3)*cut(1))/curve(l, 2)
         along(1) = merge(along(1), 1.0_wp - place(l, 1), along(1) < 1.0_wp - place(l, 1))
         along(2) = merge(along(2), 1.0_wp - place(l, 2), along(2) < 1.0_wp - place(l, 2))
         along(1) = merge(along(1), -1.0_wp - place(l, 1), along(1) > -1.0_wp - place(l, 1))
         along(2) = merge(along(2), -1.0_wp - place(l, 2), along(2) > -1.0_wp - place(l, 2))
         is_free = abs(free(1)) <= room(1) .and. abs(free(2)) <= room(2)
         is_first = room(1)*abs(free(2)) <= room(2)*abs(free(1))
         step(l, 1) = merge(free(1), merge(cut(1), along(1), is_first), is_free)
         step(l, 2) = merge(free(2), merge(along(2), cut(2), is_first), is_free)
      end do
   end subroutine newton_step

   !> Take the steps, or go half of the way back where the last one went too far
   pure subroutine go_on(value, newton, place, step, last)
      !> The facets at the places, seen from the points
      real(wp), intent(in) :: value(lanes, 3)
      !> Newton's steps
      real(wp), intent(in) :: newton(lanes, 2)
      !> Places; those whose last step was small stay
      real(wp), intent(inout) :: place(lanes, 2)
      !> The last steps in, these out
      real(wp), intent(inout) :: step(lanes, 2)
      !> Squared distances where the last steps began, from the second on
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
               place(l, 1) = place(l, 1) - step(l, 1)
               place(l, 2) = place(l, 2) - step(l, 2)
            else
               last(l) = squared
               step(l, 1) = newton(l, 1)
               step(l, 2) = newton(l, 2)
               place(l, 1) = place(l, 1) + newton(l, 1)
               place(l, 2) = place(l, 2) + newton(l, 2)
            end if
         end if
      end do
   end subroutine go_on

end module plydyn_contact_search_closest_point
