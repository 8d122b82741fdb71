!> Rigid sphere: its contact nodes, and its exact distance from a point.
!>
!> Only the half that faces the plate can touch it: a sphere and a hemisphere are the same here.
module plydyn_contact_bodies_sphere
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: sphere_nodes, sphere_gap

   !> Radians
   real(wp), parameter :: right_angle = acos(0.0_wp)

   !> Quarters of a ring
   integer, parameter :: quarters = 4

contains

   !> Contact nodes on the half sphere that faces the plate, relative to the centre
   !>
   !> Rings around the node at the pole: at most a spacing apart along the meridian, about a spacing
   !> between nodes of a ring. No node lies on the x or y axis, where sides of facets often are. The
   !> pattern is symmetric under quarter turns to the last bit, and under reflection to round-off.
   !> Rings farther from the axis than `axis_distance` are left out.
   pure subroutine sphere_nodes(radius, spacing, axis_distance, side, node)
      !> Length
      real(wp), intent(in) :: radius
      !> Distance between nodes, length
      real(wp), intent(in) :: spacing
      !> Largest distance of a node from the axis, length
      real(wp), intent(in) :: axis_distance
      !> 1 when the plate lies below the sphere, -1 when above
      integer, intent(in) :: side
      !> Positions relative to the centre, (3, nodes), ring after ring from the pole
      real(wp), allocatable, intent(out) :: node(:, :)

      integer, allocatable :: first(:)
      integer :: r, rings
      real(wp) :: step

      rings = max(1, ceiling(right_angle*radius/spacing))
      step = right_angle/rings
      rings = max(1, count([(radius*sin(r*step) <= axis_distance, r=1, rings)]))
      ! first node of each ring, and one more at the end
      allocate (first(rings + 2), source=1)
      first(2) = 2
      do r = 1, rings
         first(r + 2) = first(r + 1) + quarters*max(1, nint(right_angle*sin(r*step)*radius/spacing))
      end do
      allocate (node(3, first(rings + 2) - 1), source=0.0_wp)
      node(3, 1) = -side*radius
      do r = 1, rings
         call place_ring(radius*sin(r*step), -side*radius*cos(r*step), &
            & node(:, first(r + 1):first(r + 2) - 1))
      end do
   end subroutine sphere_nodes

   !> Nodes evenly spaced on a circle around the z axis, half a spacing from the x axis
   pure subroutine place_ring(radius, height, node)
      !> Radius of the circle, length
      real(wp), intent(in) :: radius
      !> Its height, length
      real(wp), intent(in) :: height
      !> Positions, (3, nodes), a multiple of four nodes
      real(wp), intent(inout) :: node(:, :)

      integer :: i, quarter
      real(wp) :: angle

      quarter = size(node, 2)/quarters
      do i = 1, quarter
         angle = (i - 0.5_wp)*right_angle/quarter
         node(:, i) = [radius*cos(angle), radius*sin(angle), height]
         node(:, i + quarter) = [-node(2, i), node(1, i), height]
         node(:, i + 2*quarter) = [-node(1, i), -node(2, i), height]
         node(:, i + 3*quarter) = [node(2, i), -node(1, i), height]
      end do
   end subroutine place_ring

   !> Gap of a point of the plate to the exact sphere
   !>
   !> A point behind the centre and within the radius of the axis counts as inside: an impactor on
   !> the wrong side of the plate is reported as penetration.
   pure subroutine sphere_gap(point, centre, radius, side, gap, normal)
      !> Point of the plate, length
      real(wp), intent(in) :: point(3)
      !> Centre of the sphere, length
      real(wp), intent(in) :: centre(3)
      !> Length
      real(wp), intent(in) :: radius
      !> 1 when the plate lies below the sphere, -1 when above
      integer, intent(in) :: side
      !> Distance from the sphere, negative when the point is inside
      real(wp), intent(out) :: gap
      !> Unit vector from the point towards the centre
      real(wp), intent(out) :: normal(3)

      real(wp) :: arm(3), distance

      arm(:) = centre - point
      distance = norm2(arm)
      if (side*arm(3) <= 0.0_wp .and. norm2(arm(:2)) < radius) then
         gap = side*arm(3) - radius
         normal(:) = [0.0_wp, 0.0_wp, real(side, wp)]
      else
         gap = distance - radius
         normal(:) = arm/distance
      end if
   end subroutine sphere_gap

end module plydyn_contact_bodies_sphere
