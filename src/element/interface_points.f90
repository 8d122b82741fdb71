!> From the nodes of a quad to the Gauss points of its interfaces, and back with the transposed.
module plydyn_element_interface_points
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: to_nodes, to_points

contains

   !> Values at the nodes to values at the Gauss points, in place
   pure subroutine to_points(side, reach, value)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Distance of the outer points from the middle
      real(wp), intent(in) :: reach
      !> Values
      real(wp), intent(inout) :: value(lanes, 3, side**2)

      real(wp) :: v1, v2, v3, v4, v5, v6, v7, v8, v9
      integer :: c, l

      if (side == 2) then
         call blend_four(reach, value)
         return
      end if
      do c = 1, 3
         !$omp simd private(v1, v2, v3, v4, v5, v6, v7, v8, v9)
         do l = 1, lanes
            v1 = value(l, c, 1)
            v2 = value(l, c, 2)
            v3 = value(l, c, 3)
            v4 = value(l, c, 4)
            v5 = value(l, c, 5)
            v6 = value(l, c, 6)
            v7 = value(l, c, 7)
            v8 = value(l, c, 8)
            v9 = value(l, c, 9)
            call spread_line(reach, v1, v2, v3)
            call spread_line(reach, v4, v5, v6)
            call spread_line(reach, v7, v8, v9)
            call spread_line(reach, v1, v4, v7)
            call spread_line(reach, v2, v5, v8)
            call spread_line(reach, v3, v6, v9)
            value(l, c, 1) = v1
            value(l, c, 2) = v2
            value(l, c, 3) = v3
            value(l, c, 4) = v4
            value(l, c, 6) = v6
            value(l, c, 7) = v7
            value(l, c, 8) = v8
            value(l, c, 9) = v9
         end do
      end do
   end subroutine to_points

   !> Transposed of `to_points`: forces at the Gauss points to forces at the nodes
   pure subroutine to_nodes(side, reach, value)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Distance of the outer points from the middle
      real(wp), intent(in) :: reach
      !> Forces
      real(wp), intent(inout) :: value(lanes, 3, side**2)

      real(wp) :: v1, v2, v3, v4, v5, v6, v7, v8, v9
      integer :: c, l

      if (side == 2) then
         call blend_four(reach, value)
         return
      end if
      do c = 1, 3
         !$omp simd private(v1, v2, v3, v4, v5, v6, v7, v8, v9)
         do l = 1, lanes
            v1 = value(l, c, 1)
            v2 = value(l, c, 2)
            v3 = value(l, c, 3)
            v4 = value(l, c, 4)
            v5 = value(l, c, 5)
            v6 = value(l, c, 6)
            v7 = value(l, c, 7)
            v8 = value(l, c, 8)
            v9 = value(l, c, 9)
            call gather_line(reach, v1, v4, v7)
            call gather_line(reach, v2, v5, v8)
            call gather_line(reach, v3, v6, v9)
            call gather_line(reach, v1, v2, v3)
            call gather_line(reach, v4, v5, v6)
            call gather_line(reach, v7, v8, v9)
            value(l, c, 1) = v1
            value(l, c, 2) = v2
            value(l, c, 3) = v3
            value(l, c, 4) = v4
            value(l, c, 5) = v5
            value(l, c, 6) = v6
            value(l, c, 7) = v7
            value(l, c, 8) = v8
            value(l, c, 9) = v9
         end do
      end do
   end subroutine to_nodes

   !> Either of the two for a quad of four nodes
   pure subroutine blend_four(reach, value)
      !> Distance of the points from the middle
      real(wp), intent(in) :: reach
      !> Values
      real(wp), intent(inout) :: value(lanes, 3, 4)

      real(wp) :: v1, v2, v3, v4
      integer :: c, l

      do c = 1, 3
         !$omp simd private(v1, v2, v3, v4)
         do l = 1, lanes
            v1 = value(l, c, 1)
            v2 = value(l, c, 2)
            v3 = value(l, c, 3)
            v4 = value(l, c, 4)
            call blend(reach, v1, v2)
            call blend(reach, v3, v4)
            call blend(reach, v1, v3)
            call blend(reach, v2, v4)
            value(l, c, 1) = v1
            value(l, c, 2) = v2
            value(l, c, 3) = v3
            value(l, c, 4) = v4
         end do
      end do
   end subroutine blend_four

   !> Values at the ends of a line to those at its two Gauss points; its own transposed
   pure subroutine blend(reach, first, last)
      !> Distance of the points from the middle
      real(wp), intent(in) :: reach
      !> Values
      real(wp), intent(inout) :: first, last
      real(wp) :: even, odd

      even = 0.5_wp*(last + first)
      odd = 0.5_wp*reach*(last - first)
      first = even - odd
      last = even + odd
   end subroutine blend

   !> Values at three nodes of a line to those at its three Gauss points; the middle one stays
   pure subroutine spread_line(reach, first, middle, last)
      !> Distance of the outer points from the middle
      real(wp), intent(in) :: reach
      !> Values
      real(wp), intent(inout) :: first, last
      !> Value in the middle
      real(wp), intent(in) :: middle
      real(wp) :: even, odd

      even = middle + 0.5_wp*reach**2*((last + first) - 2.0_wp*middle)
      odd = 0.5_wp*reach*(last - first)
      first = even - odd
      last = even + odd
   end subroutine spread_line

   !> Transposed of `spread_line`
   pure subroutine gather_line(reach, first, middle, last)
      !> Distance of the outer points from the middle
      real(wp), intent(in) :: reach
      !> Forces
      real(wp), intent(inout) :: first, middle, last
      real(wp) :: even, odd

      even = last + first
      odd = 0.5_wp*reach*(last - first)
      middle = middle + (1.0_wp - reach**2)*even
      first = 0.5_wp*reach**2*even - odd
      last = 0.5_wp*reach**2*even + odd
   end subroutine gather_line

end module plydyn_element_interface_points
