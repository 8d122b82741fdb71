!> Stresses at the points of wedges from displacement gradients: elastic, or by the laws of the
!> plies.
module plydyn_element_cracked_stresses
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_cracked_cells, only : wedges
   use plydyn_element_cracked_wedges, only : faces, wedge_points
   use plydyn_element_plate_layers, only : c33, layer_batch_type, plate_type
   use plydyn_law_compression_barrier, only : add_barrier_stress, barrier_ratio, volume_ratios
   implicit none
   private

   public :: find_stresses, find_strain, turn_strain

contains

   !> First Piola-Kirchhoff stresses times volume at the points of a block of layers over a quad
   pure subroutine find_stresses(plate, block, quad, large, step, gradient, history, piola)
      !> The plate, block of layers, quad
      type(plate_type), intent(in) :: plate
      integer, intent(in) :: block, quad
      !> Large displacement; time step
      logical, intent(in) :: large
      real(wp), intent(in) :: step
      !> Displacement gradients
      real(wp), intent(in) :: gradient(lanes, 3, 3, wedge_points)
      !> History from the first point of the block on
      real(wp), intent(inout) :: history(lanes, plate%batches(1)%pitch, *)
      !> Component and direction
      real(wp), intent(out) :: piola(lanes, 3, 3, wedge_points)

      real(wp) :: strain(lanes, 6, wedge_points), stress(lanes, 6, wedge_points), turned(lanes, 6)
      real(wp) :: weight
      integer :: k, p

      associate (batch => plate%batches(1))
         do p = 1, wedge_points
            call find_strain(gradient(:, :, :, p), large, strain(:, :, p))
         end do
         if (size(batch%laws) > 0) then
            do p = 1, wedge_points
               call turn_strain(batch%rotation(:, :, block), strain(:, :, p), turned)
               strain(:, :, p) = turned
            end do
            stress(:, :, :) = 0.0_wp
            do k = 1, size(batch%laws)
               if (batch%laws(k)%block /= block) cycle
               call batch%laws(k)%law%update_points(wedge_points, batch%pitch, step, strain, &
                  & history, stress)
            end do
            do p = 1, wedge_points
               call turn_stress_back(batch%rotation(:, :, block), batch%half_thickness(:, block), &
                  & stress(:, :, p))
            end do
         else
            do p = 1, wedge_points
               call elastic_stress(batch%stiffness(:, :, block), strain(:, :, p), stress(:, :, p))
            end do
         end if
         do k = 1, wedges
            do p = faces*(k - 1) + 1, faces*k
               weight = plate%metric(5, k, quad)*batch%expansion%weight(p - faces*(k - 1))
               call find_piola(gradient(:, :, :, p), stress(:, :, p), weight, large, &
                  & piola(:, :, :, p))
               if (large) call add_barrier(batch, block, weight, gradient(:, :, :, p), &
                  & piola(:, :, :, p))
            end do
         end do
      end associate
   end subroutine find_stresses

   !> Strain of a displacement gradient, linear or of Green and Lagrange
   pure subroutine find_strain(h, large, e)
      !> Displacement gradient
      real(wp), intent(in) :: h(lanes, 3, 3)
      !> Large displacement
      logical, intent(in) :: large
      !> Strain in the same axes
      real(wp), intent(out) :: e(lanes, 6)

      real(wp) :: s
      integer :: l

      s = merge(1.0_wp, 0.0_wp, large)
      !$omp simd
      do l = 1, lanes
         e(l, 1) = h(l, 1, 1) + 0.5_wp*s*(h(l, 1, 1)**2 + h(l, 2, 1)**2 + h(l, 3, 1)**2)
         e(l, 2) = h(l, 2, 2) + 0.5_wp*s*(h(l, 1, 2)**2 + h(l, 2, 2)**2 + h(l, 3, 2)**2)
         e(l, 3) = h(l, 3, 3) + 0.5_wp*s*(h(l, 1, 3)**2 + h(l, 2, 3)**2 + h(l, 3, 3)**2)
         e(l, 4) = h(l, 1, 2) + h(l, 2, 1) + s*(h(l, 1, 1)*h(l, 1, 2) + h(l, 2, 1)*h(l, 2, 2) &
            & + h(l, 3, 1)*h(l, 3, 2))
         e(l, 5) = h(l, 1, 3) + h(l, 3, 1) + s*(h(l, 1, 1)*h(l, 1, 3) + h(l, 2, 1)*h(l, 2, 3) &
            & + h(l, 3, 1)*h(l, 3, 3))
         e(l, 6) = h(l, 2, 3) + h(l, 3, 2) + s*(h(l, 1, 2)*h(l, 1, 3) + h(l, 2, 2)*h(l, 2, 3) &
            & + h(l, 3, 2)*h(l, 3, 3))
      end do
   end subroutine find_strain

   !> Strain in ply axes
   pure subroutine turn_strain(rotation, e, ply)
      !> Cosine and sine of the fibre direction
      real(wp), intent(in) :: rotation(lanes, 2)
      !> In the axes of the plate
      real(wp), intent(in) :: e(lanes, 6)
      real(wp), intent(out) :: ply(lanes, 6)

      real(wp) :: cc, cs, ss
      integer :: l

      !$omp simd private(cc, cs, ss)
      do l = 1, lanes
         cc = rotation(l, 1)**2
         ss = rotation(l, 2)**2
         cs = rotation(l, 1)*rotation(l, 2)
         ply(l, 1) = cc*e(l, 1) + ss*e(l, 2) + cs*e(l, 4)
         ply(l, 2) = ss*e(l, 1) + cc*e(l, 2) - cs*e(l, 4)
         ply(l, 3) = e(l, 3)
         ply(l, 4) = 2.0_wp*cs*(e(l, 2) - e(l, 1)) + (cc - ss)*e(l, 4)
         ply(l, 5) = rotation(l, 1)*e(l, 5) + rotation(l, 2)*e(l, 6)
         ply(l, 6) = rotation(l, 1)*e(l, 6) - rotation(l, 2)*e(l, 5)
      end do
   end subroutine turn_strain

   !> Stress in the axes of the plate times a factor, in place
   pure subroutine turn_stress_back(rotation, factor, s)
      real(wp), intent(in) :: rotation(lanes, 2), factor(lanes)
      !> In ply axes in
      real(wp), intent(inout) :: s(lanes, 6)

      real(wp) :: cc, cs, s1, s12, s13, s2, s23, ss
      integer :: l

      !$omp simd private(cc, cs, s1, s12, s13, s2, s23, ss)
      do l = 1, lanes
         cc = rotation(l, 1)**2
         ss = rotation(l, 2)**2
         cs = rotation(l, 1)*rotation(l, 2)
         s1 = factor(l)*s(l, 1)
         s2 = factor(l)*s(l, 2)
         s12 = factor(l)*s(l, 4)
         s13 = factor(l)*s(l, 5)
         s23 = factor(l)*s(l, 6)
         s(l, 1) = cc*s1 + ss*s2 - 2.0_wp*cs*s12
         s(l, 2) = ss*s1 + cc*s2 + 2.0_wp*cs*s12
         s(l, 3) = factor(l)*s(l, 3)
         s(l, 4) = cs*(s1 - s2) + (cc - ss)*s12
         s(l, 5) = rotation(l, 1)*s13 - rotation(l, 2)*s23
         s(l, 6) = rotation(l, 2)*s13 + rotation(l, 1)*s23
      end do
   end subroutine turn_stress_back

   !> Stress of elastic layers times half of their thickness
   pure subroutine elastic_stress(k, e, s)
      !> As in `layer_batch_type`
      real(wp), intent(in) :: k(lanes, 13)
      real(wp), intent(in) :: e(lanes, 6)
      real(wp), intent(out) :: s(lanes, 6)

      integer :: l

      !$omp simd
      do l = 1, lanes
         s(l, 1) = k(l, 1)*e(l, 1) + k(l, 2)*e(l, 2) + k(l, 3)*e(l, 3) + k(l, 4)*e(l, 4)
         s(l, 2) = k(l, 2)*e(l, 1) + k(l, 5)*e(l, 2) + k(l, 6)*e(l, 3) + k(l, 7)*e(l, 4)
         s(l, 3) = k(l, 3)*e(l, 1) + k(l, 6)*e(l, 2) + k(l, 8)*e(l, 3) + k(l, 9)*e(l, 4)
         s(l, 4) = k(l, 4)*e(l, 1) + k(l, 7)*e(l, 2) + k(l, 9)*e(l, 3) + k(l, 10)*e(l, 4)
         s(l, 5) = k(l, 11)*e(l, 5) + k(l, 12)*e(l, 6)
         s(l, 6) = k(l, 12)*e(l, 5) + k(l, 13)*e(l, 6)
      end do
   end subroutine elastic_stress

   !> First Piola-Kirchhoff stress of the second one, times a weight
   pure subroutine find_piola(h, s, weight, large, p)
      real(wp), intent(in) :: h(lanes, 3, 3), s(lanes, 6), weight
      logical, intent(in) :: large
      real(wp), intent(out) :: p(lanes, 3, 3)

      real(wp) :: f1, f2, f3, own(3), s11, s12, s13, s22, s23, s33, share
      integer :: d, l

      share = merge(weight, 0.0_wp, large)
      do d = 1, 3
         own(:) = 0.0_wp
         own(d) = weight
         !$omp simd private(f1, f2, f3, s11, s12, s13, s22, s23, s33)
         do l = 1, lanes
            f1 = share*h(l, d, 1) + own(1)
            f2 = share*h(l, d, 2) + own(2)
            f3 = share*h(l, d, 3) + own(3)
            s11 = s(l, 1)
            s22 = s(l, 2)
            s33 = s(l, 3)
            s12 = s(l, 4)
            s13 = s(l, 5)
            s23 = s(l, 6)
            p(l, d, 1) = f1*s11 + f2*s12 + f3*s13
            p(l, d, 2) = f1*s12 + f2*s22 + f3*s23
            p(l, d, 3) = f1*s13 + f2*s23 + f3*s33
         end do
      end do
   end subroutine find_piola

   !> Add the barrier against wedges turned inside out, where one is near that
   pure subroutine add_barrier(batch, block, weight, h, p)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block
      real(wp), intent(in) :: weight, h(lanes, 3, 3)
      real(wp), intent(inout) :: p(lanes, 3, 3)

      real(wp) :: one(3, 3), ratio(lanes)
      integer :: l

      ratio(:) = volume_ratios(h)
      if (minval(ratio) >= barrier_ratio) return
      do l = 1, lanes
         if (ratio(l) >= barrier_ratio) cycle
         one(:, :) = p(l, :, :)
         call add_barrier_stress(weight*batch%stiffness(l, c33, block), h(l, :, :), one)
         p(l, :, :) = one
      end do
   end subroutine add_barrier

end module plydyn_element_cracked_stresses
