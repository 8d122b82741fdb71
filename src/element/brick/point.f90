!> Strain and stress of bricks at a point, over a batch.
module plydyn_element_brick_point
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_brick_bricks, only : corners
   implicit none
   private

   public :: elastic_stress, gradient_of, strain_of, to_flux, rotate_strain, rotate_stress

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

   !> Linear or Green-Lagrange strain in the axes of the model, with engineering shear
   pure subroutine strain_of(h, large, e)
      !> Derivatives of the displacement
      real(wp), intent(in) :: h(lanes, 3, 3)
      !> 1 for large displacement, else 0
      real(wp), intent(in) :: large
      !> The strain
      real(wp), intent(out) :: e(lanes, 6)

      real(wp) :: half
      integer :: l

      half = 0.5_wp*large
      !$omp simd
      do l = 1, lanes
         e(l, 1) = h(l, 1, 1) + half*(h(l, 1, 1)**2 + h(l, 2, 1)**2 + h(l, 3, 1)**2)
         e(l, 2) = h(l, 2, 2) + half*(h(l, 1, 2)**2 + h(l, 2, 2)**2 + h(l, 3, 2)**2)
         e(l, 3) = h(l, 3, 3) + half*(h(l, 1, 3)**2 + h(l, 2, 3)**2 + h(l, 3, 3)**2)
         e(l, 4) = h(l, 1, 2) + h(l, 2, 1) + large*(h(l, 1, 1)*h(l, 1, 2) &
            & + h(l, 2, 1)*h(l, 2, 2) + h(l, 3, 1)*h(l, 3, 2))
         e(l, 5) = h(l, 1, 3) + h(l, 3, 1) + large*(h(l, 1, 1)*h(l, 1, 3) &
            & + h(l, 2, 1)*h(l, 2, 3) + h(l, 3, 1)*h(l, 3, 3))
         e(l, 6) = h(l, 2, 3) + h(l, 3, 2) + large*(h(l, 1, 2)*h(l, 1, 3) &
            & + h(l, 2, 2)*h(l, 2, 3) + h(l, 3, 2)*h(l, 3, 3))
      end do
   end subroutine strain_of

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

   !> First Piola-Kirchhoff stress times the volume of the point, (lanes, directions, along)
   pure subroutine to_flux(h, large, volume, s, p)
      !> Derivatives of the displacement
      real(wp), intent(in) :: h(lanes, 3, 3)
      !> 1 for large displacement, else 0
      real(wp), intent(in) :: large
      !> Volume of the point
      real(wp), intent(in) :: volume(lanes)
      !> Second Piola-Kirchhoff stress, or stress
      real(wp), intent(in) :: s(lanes, 6)
      !> The flux
      real(wp), intent(out) :: p(lanes, 3, 3)

      real(wp) :: f(lanes, 3, 3)
      integer :: i, l

      do l = 1, lanes
         f(l, 1, 1) = volume(l)*(1.0_wp + large*h(l, 1, 1))
         f(l, 2, 2) = volume(l)*(1.0_wp + large*h(l, 2, 2))
         f(l, 3, 3) = volume(l)*(1.0_wp + large*h(l, 3, 3))
         f(l, 1, 2) = volume(l)*large*h(l, 1, 2)
         f(l, 1, 3) = volume(l)*large*h(l, 1, 3)
         f(l, 2, 1) = volume(l)*large*h(l, 2, 1)
         f(l, 2, 3) = volume(l)*large*h(l, 2, 3)
         f(l, 3, 1) = volume(l)*large*h(l, 3, 1)
         f(l, 3, 2) = volume(l)*large*h(l, 3, 2)
      end do
      do i = 1, 3
         !$omp simd
         do l = 1, lanes
            p(l, i, 1) = f(l, i, 1)*s(l, 1) + f(l, i, 2)*s(l, 4) + f(l, i, 3)*s(l, 5)
            p(l, i, 2) = f(l, i, 1)*s(l, 4) + f(l, i, 2)*s(l, 2) + f(l, i, 3)*s(l, 6)
            p(l, i, 3) = f(l, i, 1)*s(l, 5) + f(l, i, 2)*s(l, 6) + f(l, i, 3)*s(l, 3)
         end do
      end do
   end subroutine to_flux

   !> Strain in ply axes, in place
   pure subroutine rotate_strain(cosine_sine, e)
      !> Cosine and sine of the fibre direction
      real(wp), intent(in) :: cosine_sine(2)
      !> Strain with engineering shear
      real(wp), intent(inout) :: e(lanes, 6)

      real(wp) :: c, s, x, y, z
      integer :: l

      c = cosine_sine(1)
      s = cosine_sine(2)
      !$omp simd private(x, y, z)
      do l = 1, lanes
         x = e(l, 1)
         y = e(l, 2)
         z = e(l, 4)
         e(l, 1) = c*c*x + s*s*y + c*s*z
         e(l, 2) = s*s*x + c*c*y - c*s*z
         e(l, 4) = 2.0_wp*c*s*(y - x) + (c*c - s*s)*z
         x = e(l, 5)
         e(l, 5) = c*x + s*e(l, 6)
         e(l, 6) = c*e(l, 6) - s*x
      end do
   end subroutine rotate_strain

   !> Stress from ply axes to those of the model, in place
   pure subroutine rotate_stress(cosine_sine, t)
      !> Cosine and sine of the fibre direction
      real(wp), intent(in) :: cosine_sine(2)
      !> Stress
      real(wp), intent(inout) :: t(lanes, 6)

      integer :: l
      real(wp) :: c, s, x, y, z

      c = cosine_sine(1)
      s = cosine_sine(2)
      !$omp simd private(x, y, z)
      do l = 1, lanes
         x = t(l, 1)
         y = t(l, 2)
         z = t(l, 4)
         t(l, 1) = c*c*x + s*s*y - 2.0_wp*c*s*z
         t(l, 2) = s*s*x + c*c*y + 2.0_wp*c*s*z
         t(l, 4) = c*s*(x - y) + (c*c - s*s)*z
         x = t(l, 5)
         t(l, 5) = c*x - s*t(l, 6)
         t(l, 6) = s*x + c*t(l, 6)
      end do
   end subroutine rotate_stress

end module plydyn_element_brick_point
