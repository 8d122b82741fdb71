!> Lower bound on the distance of a facet from a point, by the convex hull of its control points.
!>
!> A facet lies within the convex hull of its control points in Bernstein's form. The bounding box
!> and the bounding sphere of these points both bound the distance from below.
module plydyn_contact_search_hull
   use plydyn_base_precision, only : wp
   use plydyn_fem_shape, only : bilinear_nodes
   implicit none
   private

   public :: distance_bound

contains

   !> Lower bound on the distance from a point to a facet, length: the larger of both bounds
   pure real(wp) function distance_bound(node, point) result(distance)
      !> Points of the facet, (3, 4 or 9), length
      real(wp), intent(in) :: node(:, :)
      !> Any point, length
      real(wp), intent(in) :: point(3)

      real(wp) :: control(3, size(node, 2)), from_middle, middle(3), outside(3), hull_radius
      integer :: i

      control(:, :) = control_points(node)
      outside(:) = max(minval(control, 2) - point, point - maxval(control, 2), 0.0_wp)
      middle(:) = node(:, size(node, 2))
      hull_radius = 0.0_wp
      do i = 1, size(node, 2)
         hull_radius = max(hull_radius, norm2(control(:, i) - middle))
      end do
      from_middle = norm2(point - middle)
      distance = max(norm2(outside), from_middle - hull_radius)
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

end module plydyn_contact_search_hull
