!> Displacement gradient and elastic stress of bricks at a point, over a batch.
module plydyn_element_brick_point
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_brick_bricks, only : corners
   implicit none
   private

   public :: elastic_stress, gradient_of

contains

   !> Derivatives of the displacement, (lanes, directions, along)
   pure subroutine gradient_of(u, b, h)
      !> Displacement of the nodes
      real(wp), intent(in) :: u(lanes, corners, 3)
      !> Gradients of the shape functions
      real(wp), intent(in) :: b(lanes, corners, 3)
      !> The derivatives
      real(wp), intent(out) :: h(lanes, 3, 3)
      integer :: i, j, l

      do j = 1, 3
         do i = 1, 3
            !$omp simd
            do l = 1, lanes
               h(l, i, j) = ((u(l, 1, i)*b(l, 1, j) + u(l, 2, i)*b(l, 2, j)) &
                  & + (u(l, 3, i)*b(l, 3, j) + u(l, 4, i)*b(l, 4, j))) &
                  & + ((u(l, 5, i)*b(l, 5, j) + u(l, 6, i)*b(l, 6, j)) &
                  & + (u(l, 7, i)*b(l, 7, j) + u(l, 8, i)*b(l, 8, j)))
            end do
         end do
      end do
   end subroutine gradient_of

   !> Stress of an elastic part in the axes of the model
   pure subroutine elastic_stress(c, e, s)
      !> Constants C11 C12 C13 C14 C22 C23 C24 C33 C34 C44 C55 C56 C66
      real(wp), intent(in) :: c(13)
      !> Strain
      real(wp), intent(in) :: e(lanes, 6)
      !> Stress
      real(wp), intent(out) :: s(lanes, 6)
      integer :: l

      !$omp simd
      do l = 1, lanes
         s(l, 1) = c(1)*e(l, 1) + c(2)*e(l, 2) + c(3)*e(l, 3) + c(4)*e(l, 4)
         s(l, 2) = c(2)*e(l, 1) + c(5)*e(l, 2) + c(6)*e(l, 3) + c(7)*e(l, 4)
         s(l, 3) = c(3)*e(l, 1) + c(6)*e(l, 2) + c(8)*e(l, 3) + c(9)*e(l, 4)
         s(l, 4) = c(4)*e(l, 1) + c(7)*e(l, 2) + c(9)*e(l, 3) + c(10)*e(l, 4)
         s(l, 5) = c(11)*e(l, 5) + c(12)*e(l, 6)
         s(l, 6) = c(12)*e(l, 5) + c(13)*e(l, 6)
      end do
   end subroutine elastic_stress

end module plydyn_element_brick_point
