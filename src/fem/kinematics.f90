!> Kinematics at a point, lanes side by side: ratio of volumes, strain, stress on undeformed and on
!> deformed areas (Bonet and Wood, 2008, chapters 4 and 5), and axes turned about z.
!>
!> Displacement gradients are (lanes, component, direction); strain and stress are xx, yy, zz, xy,
!> xz, yz with engineering shear. The kernels of plates have strain, stress and flux fused in loops
!> of their own.
module plydyn_fem_kinematics
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: find_cauchy, find_piola, find_strain, turn_strain, turn_stress, turn_stress_back, &
      & volume_ratios

contains

   !> Ratio of volumes, det(I + H)
   pure function volume_ratios(h) result(ratio)
      !> Displacement gradients
      real(wp), intent(in) :: h(lanes, 3, 3)
      real(wp) :: ratio(lanes)

      ratio(:) = (1.0_wp + h(:, 1, 1)) &
         & *((1.0_wp + h(:, 2, 2))*(1.0_wp + h(:, 3, 3)) - h(:, 2, 3)*h(:, 3, 2)) &
         & - h(:, 1, 2)*(h(:, 2, 1)*(1.0_wp + h(:, 3, 3)) - h(:, 2, 3)*h(:, 3, 1)) &
         & + h(:, 1, 3)*(h(:, 2, 1)*h(:, 3, 2) - (1.0_wp + h(:, 2, 2))*h(:, 3, 1))
   end function volume_ratios

   !> Strain of a displacement gradient, linear or of Green and Lagrange
   pure subroutine find_strain(h, large, e)
      !> Displacement gradients
      real(wp), intent(in) :: h(lanes, 3, 3)
      !> Large displacement
      logical, intent(in) :: large
      !> Strain in the same axes
      real(wp), intent(out) :: e(lanes, 6)

      real(wp) :: half, whole
      integer :: l

      whole = merge(1.0_wp, 0.0_wp, large)
      half = 0.5_wp*whole
      !$omp simd
      do l = 1, lanes
         e(l, 1) = h(l, 1, 1) + half*(h(l, 1, 1)**2 + h(l, 2, 1)**2 + h(l, 3, 1)**2)
         e(l, 2) = h(l, 2, 2) + half*(h(l, 1, 2)**2 + h(l, 2, 2)**2 + h(l, 3, 2)**2)
         e(l, 3) = h(l, 3, 3) + half*(h(l, 1, 3)**2 + h(l, 2, 3)**2 + h(l, 3, 3)**2)
         e(l, 4) = h(l, 1, 2) + h(l, 2, 1) + whole*(h(l, 1, 1)*h(l, 1, 2) &
            & + h(l, 2, 1)*h(l, 2, 2) + h(l, 3, 1)*h(l, 3, 2))
         e(l, 5) = h(l, 1, 3) + h(l, 3, 1) + whole*(h(l, 1, 1)*h(l, 1, 3) &
            & + h(l, 2, 1)*h(l, 2, 3) + h(l, 3, 1)*h(l, 3, 3))
         e(l, 6) = h(l, 2, 3) + h(l, 3, 2) + whole*(h(l, 1, 2)*h(l, 1, 3) &
            & + h(l, 2, 2)*h(l, 2, 3) + h(l, 3, 2)*h(l, 3, 3))
      end do
   end subroutine find_strain

   !> First Piola-Kirchhoff stress F S of the second one, times a weight; with small displacement
   !> the stress itself
   pure subroutine find_piola(h, s, weight, large, p)
      !> Displacement gradients
      real(wp), intent(in) :: h(lanes, 3, 3)
      !> Second Piola-Kirchhoff stress
      real(wp), intent(in) :: s(lanes, 6)
      !> Weight, such as the volume of the point
      real(wp), intent(in) :: weight(lanes)
      !> Large displacement
      logical, intent(in) :: large
      !> The stress times the weight, (lanes, component, direction)
      real(wp), intent(out) :: p(lanes, 3, 3)

      real(wp) :: f1, f2, f3, own(3), share
      integer :: d, l

      share = merge(1.0_wp, 0.0_wp, large)
      do d = 1, 3
         own(:) = 0.0_wp
         own(d) = 1.0_wp
         !$omp simd private(f1, f2, f3)
         do l = 1, lanes
            f1 = weight(l)*(share*h(l, d, 1) + own(1))
            f2 = weight(l)*(share*h(l, d, 2) + own(2))
            f3 = weight(l)*(share*h(l, d, 3) + own(3))
            p(l, d, 1) = f1*s(l, 1) + f2*s(l, 4) + f3*s(l, 5)
            p(l, d, 2) = f1*s(l, 4) + f2*s(l, 2) + f3*s(l, 6)
            p(l, d, 3) = f1*s(l, 5) + f2*s(l, 6) + f3*s(l, 3)
         end do
      end do
   end subroutine find_piola

   !> Cauchy stress of the second Piola-Kirchhoff stress, F S F^T / det F, in place
   pure subroutine find_cauchy(h, s)
      !> Displacement gradients
      real(wp), intent(in) :: h(lanes, 3, 3)
      !> The stress
      real(wp), intent(inout) :: s(lanes, 6)

      integer, parameter :: first(6) = [1, 2, 3, 1, 1, 2], second(6) = [1, 2, 3, 2, 3, 3]
      real(wp) :: p(lanes, 3, 3)
      integer :: i

      call find_piola(h, s, 1.0_wp/volume_ratios(h), .true., p)
      do i = 1, 6
         associate (own => p(:, first(i), :), other => h(:, second(i), :))
            s(:, i) = own(:, second(i)) + own(:, 1)*other(:, 1) + own(:, 2)*other(:, 2) &
               & + own(:, 3)*other(:, 3)
         end associate
      end do
   end subroutine find_cauchy

   !> Strain in axes turned about z, in place
   pure subroutine turn_strain(rotation, e)
      !> Cosine and sine of the angle from the axes of the strain to those wanted
      real(wp), intent(in) :: rotation(lanes, 2)
      !> The strain
      real(wp), intent(inout) :: e(lanes, 6)

      call turn(rotation, 1.0_wp, 1.0_wp, e)
   end subroutine turn_strain

   !> Stress in axes turned about z, in place
   pure subroutine turn_stress(rotation, s)
      !> As in `turn_strain`
      real(wp), intent(in) :: rotation(lanes, 2)
      !> The stress
      real(wp), intent(inout) :: s(lanes, 6)

      call turn(rotation, 1.0_wp, 2.0_wp, s)
   end subroutine turn_stress

   !> Stress from the turned axes back, in place
   pure subroutine turn_stress_back(rotation, s)
      !> As in `turn_strain`
      real(wp), intent(in) :: rotation(lanes, 2)
      !> The stress
      real(wp), intent(inout) :: s(lanes, 6)

      call turn(rotation, -1.0_wp, 2.0_wp, s)
   end subroutine turn_stress_back

   !> Symmetric tensor in axes turned about z, in place
   pure subroutine turn(rotation, sense, shear, t)
      !> As in `turn_strain`; 1 or -1 for the opposite angle
      real(wp), intent(in) :: rotation(lanes, 2), sense
      !> 2 over the factor that the shear of the tensor has
      real(wp), intent(in) :: shear
      real(wp), intent(inout) :: t(lanes, 6)

      real(wp) :: cc, cs, s, ss, x, xy, xz, y
      integer :: l

      !$omp simd private(cc, cs, s, ss, x, xy, xz, y)
      do l = 1, lanes
         s = sense*rotation(l, 2)
         cc = rotation(l, 1)**2
         ss = s**2
         cs = rotation(l, 1)*s
         x = t(l, 1)
         y = t(l, 2)
         xy = t(l, 4)
         xz = t(l, 5)
         t(l, 1) = cc*x + ss*y + shear*cs*xy
         t(l, 2) = ss*x + cc*y - shear*cs*xy
         t(l, 4) = 2.0_wp/shear*cs*(y - x) + (cc - ss)*xy
         t(l, 5) = rotation(l, 1)*xz + s*t(l, 6)
         t(l, 6) = rotation(l, 1)*t(l, 6) - s*xz
      end do
   end subroutine turn

end module plydyn_fem_kinematics
