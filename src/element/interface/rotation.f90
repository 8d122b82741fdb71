!> Forces on the faces of an interface that stands open while they turn.
!>
!> The opening at a point is seen from axes that turn with the mid-face, so the energy of the
!> interface depends on that turn as well: tractions t across an opening d do the work of a moment
!> t x d. It acts on what the axes hang on, the slopes of the mid-face, and so on both faces alike.
!> With it the forces are the slope of the energy, and their moment about any point is zero.
module plydyn_element_interface_rotation
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: find_moment_forces

contains

   !> Forces by which tractions across an opening turn the mid-face, for the displacements of each
   !> of both faces at the points of a quad
   pure subroutine find_moment_forces(side, metric, axes, stretch, opening, traction, moment_force)
      !> Points along a side
      integer, intent(in) :: side
      !> Geometry of the points; see `quad_metric`
      real(wp), intent(in) :: metric(5, side, side)
      !> Axes of the face, and the stretch in them; see `find_axes`
      real(wp), intent(in) :: axes(lanes, 3, 3, side, side), stretch(lanes, 3, side, side)
      !> Opening, and traction times area against it, both in these axes
      real(wp), intent(in) :: opening(lanes, 3, side, side), traction(lanes, 3, side, side)
      !> Force along x, y, z that is to be subtracted on both faces
      real(wp), intent(out) :: moment_force(lanes, 3, side, side)

      real(wp) :: along(lanes, 3, side, side), up(lanes, 3, side, side)
      integer :: i, j

      do j = 1, side
         do i = 1, side
            call point_moment_forces(metric(:, i, j), axes(:, :, :, i, j), stretch(:, :, i, j), &
               & opening(:, :, i, j), traction(:, :, i, j), along(:, :, i, j), up(:, :, i, j))
         end do
      end do
      moment_force(:, :, :, :) = 0.0_wp
      if (side == 2) then
         moment_force(:, :, 1, :) = moment_force(:, :, 1, :) - along(:, :, 1, :) - along(:, :, 2, :)
         moment_force(:, :, 2, :) = moment_force(:, :, 2, :) + along(:, :, 1, :) + along(:, :, 2, :)
         moment_force(:, :, :, 1) = moment_force(:, :, :, 1) - up(:, :, :, 1) - up(:, :, :, 2)
         moment_force(:, :, :, 2) = moment_force(:, :, :, 2) + up(:, :, :, 1) + up(:, :, :, 2)
         return
      end if
      do i = 1, 3
         call add_slopes(along(:, :, 1, i), along(:, :, 2, i), along(:, :, 3, i), &
            & moment_force(:, :, 1, i), moment_force(:, :, 2, i), moment_force(:, :, 3, i))
         call add_slopes(up(:, :, i, 1), up(:, :, i, 2), up(:, :, i, 3), &
            & moment_force(:, :, i, 1), moment_force(:, :, i, 2), moment_force(:, :, i, 3))
      end do
   end subroutine find_moment_forces

   !> What the moment at a point does to the slopes of the sum of both displacements
   pure subroutine point_moment_forces(metric, axes, stretch, d, t, along, up)
      real(wp), intent(in) :: metric(5), axes(lanes, 3, 3), stretch(lanes, 3)
      real(wp), intent(in) :: d(lanes, 3), t(lanes, 3)
      !> Forces for the derivatives along xi and eta
      real(wp), intent(out) :: along(lanes, 3), up(lanes, 3)

      real(wp) :: about1, about2, about3, first, inverse, normal, second
      integer :: c, l

      associate (x => 0.5_wp*metric(1:3:2), y => 0.5_wp*metric(2:4:2), u => stretch)
         !$omp simd private(about1, about2, about3, c, first, inverse, normal, second)
         do l = 1, lanes
            ! the axes tip with both vectors, and turn about the normal by half the difference of
            ! what each moves along the other's axis, over the mean stretch
            inverse = 1.0_wp/(u(l, 1)*u(l, 3) - u(l, 2)**2)
            about1 = (t(l, 2)*d(l, 3) - t(l, 3)*d(l, 2))*inverse
            about2 = (t(l, 3)*d(l, 1) - t(l, 1)*d(l, 3))*inverse
            about3 = (t(l, 1)*d(l, 2) - t(l, 2)*d(l, 1))/(u(l, 1) + u(l, 3))
            first = -about1*u(l, 2) - about2*u(l, 3)
            second = about1*u(l, 1) + about2*u(l, 2)
            normal = x(1)*first + y(1)*second
            do c = 1, 3
               along(l, c) = normal*axes(l, c, 3) &
                  & + about3*(x(1)*axes(l, c, 2) - y(1)*axes(l, c, 1))
            end do
            normal = x(2)*first + y(2)*second
            do c = 1, 3
               up(l, c) = normal*axes(l, c, 3) + about3*(x(2)*axes(l, c, 2) - y(2)*axes(l, c, 1))
            end do
         end do
      end associate
   end subroutine point_moment_forces

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

end module plydyn_element_interface_rotation
