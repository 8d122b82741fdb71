!> Plies whose cracks close: which damage acts, and the path through a step without growth.
!>
!> Tension and compression have damage of their own. Compression feels its own only, tension and
!> shear the larger of both.
module plydyn_law_ply_closing_path
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_batch_constants, only : ply_batch_constants_type
   use plydyn_law_ply_damage_onset, only : compression_tolerance
   use plydyn_law_ply_history, only : band_width, fibre_damage, fibre_threshold, growth_limit, &
      & has_begun, integrity_of, limit_to_compression, matrix_damage, matrix_threshold, &
      & strain_excess, to_compression
   implicit none
   private

   public :: find_acting, update_closing_point

contains

   !> Signs of the normal stresses, and the integrity that goes with them. The sign of a stress
   !> depends only on the integrity in the other direction, by Poisson's effect: there the damage
   !> that goes with the signs of an intact ply is enough. Compression across the fibres that is
   !> small beside the shear counts as tension
   pure subroutine find_acting(ply, pitch, strain, shear, history, sense, integrity)
      type(ply_batch_constants_type), intent(in) :: ply
      !> Rows of the history from one variable to the next
      integer, intent(in) :: pitch
      !> Strains 11, 22, 33; size of the shear stress 12 before damage
      real(wp), intent(in) :: strain(lanes, 3), shear(lanes)
      !> History from the point on, with the damage of tension first
      real(wp), intent(in) :: history(lanes, pitch, *)
      !> Stresses 11 and 22 of which the signs count
      real(wp), intent(out) :: sense(lanes, 2)
      !> R1 and R2 for normal stress, R1 and R2 for shear
      real(wp), intent(out) :: integrity(lanes, 4)

      real(wp) :: own(lanes, 2, 2), stress(lanes, 3)
      integer :: k, l

      do k = 1, 2
         associate (tension => history(:, 1, merge(fibre_damage, matrix_damage, k == 1)), &
            & compression => history(:, 1, merge(fibre_damage, matrix_damage, k == 1) &
            & + to_compression))
            !$omp simd
            do l = 1, lanes
               own(l, k, 1) = integrity_of(ply%own(l)*tension(l), ply%residual(l))
               own(l, k, 2) = integrity_of(ply%own(l)*compression(l), ply%residual(l))
               integrity(l, k + 2) = min(own(l, k, 1), own(l, k, 2))
            end do
         end associate
      end do
      call ply%secant%intact_stress(strain, stress)
      call choose(ply%closes, stress, shear, own(:, :, 2), integrity, sense)
      call ply%secant%damaged_stress(strain, integrity, stress)
      call choose(ply%closes, stress, shear, own(:, :, 2), integrity, sense)
   end subroutine find_acting

   !> Integrity for normal stress by the signs of stresses
   pure subroutine choose(closes, stress, shear, in_compression, integrity, sense)
      !> 1 in lanes where cracks close, else 0; stresses 11 and 22; as in `find_acting`
      real(wp), intent(in) :: closes(lanes), stress(lanes, 2), shear(lanes)
      !> Integrity that compression leaves
      real(wp), intent(in) :: in_compression(lanes, 2)
      real(wp), intent(inout) :: integrity(lanes, 4)
      real(wp), intent(out) :: sense(lanes, 2)

      real(wp) :: closed, open
      integer :: k, l

      do k = 1, 2
         !$omp simd private(closed, open)
         do l = 1, lanes
            sense(l, k) = stress(l, k)
            if (k == 2) sense(l, k) = stress(l, k) + compression_tolerance*shear(l)
            closed = in_compression(l, k)
            open = integrity(l, k + 2)
            integrity(l, k) = merge(closed, open, closes(l)*sense(l, k) < 0.0_wp)
         end do
      end do
   end subroutine choose

   !> Stress of a point, and in which lanes damage begins or grows, as in the no-growth path
   pure subroutine update_closing_point(ply, pitch, e, shear, history, sheared, s, growth)
      !> As in `find_acting`
      type(ply_batch_constants_type), intent(in) :: ply
      integer, intent(in) :: pitch
      !> Total strain; sizes of the shear stress 12 before damage and of the elastic shear strain
      real(wp), intent(in) :: e(lanes, 6), shear(lanes, 2)
      !> History from the point on
      real(wp), intent(in) :: history(lanes, pitch, *)
      !> Integrity for shear, along and across the fibres; stress
      real(wp), intent(out) :: sheared(lanes, 2), s(lanes, 6)
      !> More than 0 where damage begins or grows
      real(wp), intent(out) :: growth(lanes)

      real(wp) :: drive, excess(lanes, 2), integrity(lanes, 4), limit(lanes, 2), sense(lanes, 2)
      integer :: k, l

      call find_acting(ply, pitch, e, shear(:, 1), history, sense, integrity)
      call ply%secant%damaged_stress(e, integrity, s)
      call ply%onset%find_onset(s, e, shear, band_width(history(:, 1, fibre_threshold)), &
         & band_width(history(:, 1, matrix_threshold)), excess)
      call find_limits(ply%closes, pitch, sense, history, limit)
      growth(:) = 0.0_wp
      do k = 1, 2
         !$omp simd private(drive)
         do l = 1, lanes
            ! square of the equivalent strain
            drive = merge(e(l, 1)**2, e(l, 2)**2 + shear(l, 2)**2, k == 1)
            growth(l) = max(growth(l), ply%own(l)*merge(strain_excess(drive, -limit(l, k)), &
               & excess(l, k) + tiny(excess), limit(l, k) > 0.0_wp))
         end do
      end do
      sheared(:, :) = integrity(:, 3:4)
      call ply%secant%degrade_stress(e, shear(:, 1), integrity(:, 1:2), sheared, s)
   end subroutine update_closing_point

   !> Squares of the strains beyond which the damage grows that goes with the signs; 0 before onset
   pure subroutine find_limits(closes, pitch, sense, history, limit)
      real(wp), intent(in) :: closes(lanes)
      integer, intent(in) :: pitch
      real(wp), intent(in) :: sense(lanes, 2), history(lanes, pitch, *)
      real(wp), intent(out) :: limit(lanes, 2)

      real(wp) :: closed, of_open, open, threshold
      integer :: k, l

      do k = 1, 2
         !$omp simd private(closed, of_open, open, threshold)
         do l = 1, lanes
            threshold = history(l, 1, merge(fibre_threshold, matrix_threshold, k == 1))
            open = history(l, 1, growth_limit - 1 + k)
            closed = history(l, 1, growth_limit - 1 + k + limit_to_compression)
            of_open = merge(-threshold, 0.0_wp, has_begun(threshold))
            open = merge(closed, open, sense(l, k) < 0.0_wp)
            limit(l, k) = merge(open**2, of_open, closes(l) > 0.0_wp)
         end do
      end do
   end subroutine find_limits

end module plydyn_law_ply_closing_path
