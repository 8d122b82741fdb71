!> From the nodes of a quad to the Gauss points of its interfaces, and back with the transposed.
!>
!> Plates interpolate with the numbers 0.3 and 0.4 of three Gauss points, and take derivatives with
!> it; here the distance of the points is a variable. Both round differently in the last bit.
module plydyn_element_interface_points
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: to_nodes, to_points

   !> Nodes of the lines of a quad along xi, then along eta
   integer, parameter :: lines_q4(2, 4) = reshape([1, 2, 3, 4, 1, 3, 2, 4], [2, 4])
   integer, parameter :: lines_q9(3, 6) = reshape( &
      & [1, 2, 3, 4, 5, 6, 7, 8, 9, 1, 4, 7, 2, 5, 8, 3, 6, 9], [3, 6])
   !> The lines of a quad of nine nodes in the order of the transposed interpolation
   integer, parameter :: transposed_order(6) = [4, 5, 6, 1, 2, 3]

contains

   !> Values at the nodes to values at the Gauss points, in place: line by line along xi, then eta
   pure subroutine to_points(side, gauss_abscissa, value)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Distance of the outer points from the middle
      real(wp), intent(in) :: gauss_abscissa
      !> Values
      real(wp), intent(inout) :: value(lanes, 3, side**2)
      integer :: c, k, l

      if (side == 2) then
         call interpolate_four(gauss_abscissa, value)
         return
      end if
      do k = 1, size(lines_q9, 2)
         associate (first => lines_q9(1, k), middle => lines_q9(2, k), last => lines_q9(3, k))
            do c = 1, 3
               !$omp simd
               do l = 1, lanes
                  call line_to_points(gauss_abscissa, value(l, c, first), value(l, c, middle), &
                     & value(l, c, last))
               end do
            end do
         end associate
      end do
   end subroutine to_points

   !> Transposed of `to_points`: forces at the Gauss points to forces at the nodes
   pure subroutine to_nodes(side, gauss_abscissa, value)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Distance of the outer points from the middle
      real(wp), intent(in) :: gauss_abscissa
      !> Forces
      real(wp), intent(inout) :: value(lanes, 3, side**2)
      integer :: c, i, k, l

      if (side == 2) then
         call interpolate_four(gauss_abscissa, value)
         return
      end if
      do i = 1, size(lines_q9, 2)
         k = transposed_order(i)
         associate (first => lines_q9(1, k), middle => lines_q9(2, k), last => lines_q9(3, k))
            do c = 1, 3
               !$omp simd
               do l = 1, lanes
                  call line_to_nodes(gauss_abscissa, value(l, c, first), value(l, c, middle), &
                     & value(l, c, last))
               end do
            end do
         end associate
      end do
   end subroutine to_nodes

   !> Either of the two for a quad of four nodes
   pure subroutine interpolate_four(gauss_abscissa, value)
      !> Distance of the points from the middle
      real(wp), intent(in) :: gauss_abscissa
      !> Values
      real(wp), intent(inout) :: value(lanes, 3, 4)
      integer :: c, k, l

      do k = 1, size(lines_q4, 2)
         do c = 1, 3
            !$omp simd
            do l = 1, lanes
               call line_of_two(gauss_abscissa, value(l, c, lines_q4(1, k)), &
                  & value(l, c, lines_q4(2, k)))
            end do
         end do
      end do
   end subroutine interpolate_four

   !> Values at the ends of a line to those at its two Gauss points; its own transposed
   pure subroutine line_of_two(gauss_abscissa, first, last)
      !> Distance of the points from the middle
      real(wp), intent(in) :: gauss_abscissa
      !> Values
      real(wp), intent(inout) :: first, last
      real(wp) :: even, odd

      even = 0.5_wp*(last + first)
      odd = 0.5_wp*gauss_abscissa*(last - first)
      first = even - odd
      last = even + odd
   end subroutine line_of_two

   !> Values at three nodes of a line to those at its three Gauss points; the middle one stays
   pure subroutine line_to_points(gauss_abscissa, first, middle, last)
      !> Distance of the outer points from the middle
      real(wp), intent(in) :: gauss_abscissa
      !> Values
      real(wp), intent(inout) :: first, last
      !> Value in the middle
      real(wp), intent(in) :: middle
      real(wp) :: even, odd

      even = middle + 0.5_wp*gauss_abscissa**2*((last + first) - 2.0_wp*middle)
      odd = 0.5_wp*gauss_abscissa*(last - first)
      first = even - odd
      last = even + odd
   end subroutine line_to_points

   !> Transposed of `line_to_points`
   pure subroutine line_to_nodes(gauss_abscissa, first, middle, last)
      !> Distance of the outer points from the middle
      real(wp), intent(in) :: gauss_abscissa
      !> Forces
      real(wp), intent(inout) :: first, middle, last
      real(wp) :: even, odd

      even = last + first
      odd = 0.5_wp*gauss_abscissa*(last - first)
      middle = middle + (1.0_wp - gauss_abscissa**2)*even
      first = 0.5_wp*gauss_abscissa**2*even - odd
      last = 0.5_wp*gauss_abscissa**2*even + odd
   end subroutine line_to_nodes

end module plydyn_element_interface_points
