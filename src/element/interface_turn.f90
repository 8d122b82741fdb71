!> Forces on the faces of an interface that stands open while they turn.
!>
!> The opening at a point is seen from axes that turn with the mid-face, so the energy of the
!> interface depends on that turn as well: tractions t across an opening d do the work of a moment
!> t x d. It acts on what the axes hang on, the slopes of the mid-face, and so on both faces alike.
!> With it the forces are the slope of the energy, and their moment about any point is zero.
module plydyn_element_interface_turn
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: find_turning

contains

   !> Forces by which tractions across an opening turn the mid-face, for the displacements of each
   !> of both faces at the points of a quad
   pure subroutine find_turning(side, metric, axes, legs, opening, traction, turning)
      !> Points along a side
      integer, intent(in) :: side
      !> Geometry of the points; see `quad_metric`
      real(wp), intent(in) :: metric(5, side, side)
      !> Axes of the face, and what has become of the unit vectors along x and y in them; see
      !> `find_axes`
      real(wp), intent(in) :: axes(lanes, 3, 3, side, side), legs(lanes, 3, side, side)
      !> Opening, and traction times area that resists it, both in these axes
      real(wp), intent(in) :: opening(lanes, 3, side, side), traction(lanes, 3, side, side)
      !> Force along x, y, z that is to be subtracted on both faces
      real(wp), intent(out) :: turning(lanes, 3, side, side)

      real(wp) :: along(lanes, 3, side, side), up(lanes, 3, side, side)
      integer :: i, j

      do j = 1, side
         do i = 1, side
            call point_turning(metric(:, i, j), axes(:, :, :, i, j), legs(:, :, i, j), &
               & opening(:, :, i, j), traction(:, :, i, j), along(:, :, i, j), up(:, :, i, j))
         end do
      end do
      turning(:, :, :, :) = 0.0_wp
      if (side == 2) then
         turning(:, :, 1, :) = turning(:, :, 1, :) - along(:, :, 1, :) - along(:, :, 2, :)
         turning(:, :, 2, :) = turning(:, :, 2, :) + along(:, :, 1, :) + along(:, :, 2, :)
         turning(:, :, :, 1) = turning(:, :, :, 1) - up(:, :, :, 1) - up(:, :, :, 2)
         turning(:, :, :, 2) = turning(:, :, :, 2) + up(:, :, :, 1) + up(:, :, :, 2)
         return
      end if
      do i = 1, 3
         call add_slopes(along(:, :, 1, i), along(:, :, 2, i), along(:, :, 3, i), &
            & turning(:, :, 1, i), turning(:, :, 2, i), turning(:, :, 3, i))
         call add_slopes(up(:, :, i, 1), up(:, :, i, 2), up(:, :, i, 3), &
            & turning(:, :, i, 1), turning(:, :, i, 2), turning(:, :, i, 3))
      end do
   end subroutine find_turning

   !> What the moment at a point does to the slopes of the sum of both displacements
   pure subroutine point_turning(metric, axes, legs, d, t, along, up)
      real(wp), intent(in) :: metric(5), axes(lanes, 3, 3), legs(lanes, 3), d(lanes, 3), t(lanes, 3)
      !> Forces for the derivatives along xi and eta
      real(wp), intent(out) :: along(lanes, 3), up(lanes, 3)

      real(wp) :: first, inverse, normal, second, side, tip
      integer :: l

      associate (x => 0.5_wp*metric(1:3:2), y => 0.5_wp*metric(2:4:2))
         !$omp simd private(first, inverse, normal, second, side, tip)
         do l = 1, lanes
            ! turns about the first axis tip the second leg, about the others the first leg
            inverse = 1.0_wp/(legs(l, 1)*legs(l, 3))
            tip = (t(l, 2)*d(l, 3) - t(l, 3)*d(l, 2))*inverse
            side = (t(l, 1)*d(l, 2) - t(l, 2)*d(l, 1))*legs(l, 3)*inverse
            first = -tip*legs(l, 2) - (t(l, 3)*d(l, 1) - t(l, 1)*d(l, 3))*legs(l, 3)*inverse
            second = tip*legs(l, 1)
            normal = x(1)*first + y(1)*second
            along(l, 1) = normal*axes(l, 1, 3) + x(1)*side*axes(l, 1, 2)
            along(l, 2) = normal*axes(l, 2, 3) + x(1)*side*axes(l, 2, 2)
            along(l, 3) = normal*axes(l, 3, 3) + x(1)*side*axes(l, 3, 2)
            normal = x(2)*first + y(2)*second
            up(l, 1) = normal*axes(l, 1, 3) + x(2)*side*axes(l, 1, 2)
            up(l, 2) = normal*axes(l, 2, 3) + x(2)*side*axes(l, 2, 2)
            up(l, 3) = normal*axes(l, 3, 3) + x(2)*side*axes(l, 3, 2)
         end do
      end associate
   end subroutine point_turning

   !> The transposed of the derivatives along a line of three points in `find_axes`
   pure subroutine add_slopes(g1, g2, g3, first, middle, last)
      !> Forces for the derivatives at the points
      real(wp), intent(in), dimension(lanes, 3) :: g1, g2, g3
      !> Forces on the points
      real(wp), intent(inout), dimension(lanes, 3) :: first, middle, last

      integer :: c, l

      do c = 1, 3
         !$omp simd
         do l = 1, lanes
            first(l, c) = first(l, c) - 3.0_wp*g1(l, c) - g2(l, c) + g3(l, c)
            middle(l, c) = middle(l, c) + 4.0_wp*(g1(l, c) - g3(l, c))
            last(l, c) = last(l, c) - g1(l, c) + g2(l, c) + 3.0_wp*g3(l, c)
         end do
      end do
   end subroutine add_slopes

end module plydyn_element_interface_turn
