!> Begin of damage: the strains between which a mode softens are frozen in the step of its onset.
module plydyn_law_ply_damage_begin
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_batch_constants, only : ply_batch_constants_type
   use plydyn_law_ply_damage_growth, only : ply_step_type
   use plydyn_law_ply_history, only : band_width, begun_shear, begun_threshold, fibre_finish, &
      & fibre_onset, fibre_threshold, matrix_finish, matrix_onset, matrix_threshold, shear_peak
   use plydyn_law_ply_no_growth_path, only : use_intact_stress
   use plydyn_law_ply_scattered, only : find_scattered_onset, of_fibres, of_matrix
   implicit none
   private

   public :: begin_damage

contains

   !> Freeze the strains of the modes that begin in this step
   pure subroutine begin_damage(ply, e, shear, stress, h, now, begins)
      !> Constants
      type(ply_batch_constants_type), intent(in) :: ply
      !> Strains 11, 22, 33; sizes of shear stress and elastic shear strain; effective normal
      !> stresses
      real(wp), intent(in) :: e(lanes, 3), shear(lanes, 2), stress(lanes, 3)
      !> History of the point
      real(wp), intent(inout) :: h(lanes, *)
      !> Change of the point; gets the excess over onset
      type(ply_step_type), intent(inout) :: now
      !> A mode begins in some lane
      logical, intent(out) :: begins

      real(wp) :: most, trial(lanes, 3)
      integer :: l

      trial(:, :) = stress
      if (ply%any_intact) call use_intact_stress(ply, e, trial)
      if (ply%factors > 0) then
         call find_scattered_onset(ply, 1, h, trial, e, shear, now%excess)
      else
         call ply%onset%find_onset(trial, e, shear, band_width(h(:, fibre_threshold)), &
            & band_width(h(:, matrix_threshold)), now%excess)
      end if
      most = -1.0_wp
      associate (excess => now%excess)
         !$omp simd reduction(max:most)
         do l = 1, lanes
            excess(l, 1) = merge(-1.0_wp, excess(l, 1), h(l, fibre_finish) > 0.0_wp)
            excess(l, 2) = merge(-1.0_wp, excess(l, 2), h(l, matrix_finish) > 0.0_wp)
            most = max(most, excess(l, 1), excess(l, 2))
         end do
      end associate
      begins = most >= 0.0_wp
      if (.not. begins) return
      ! once in the life of a mode at a point
      do l = 1, lanes
         if (any(now%excess(l, :) >= 0.0_wp)) call begin_modes(ply, l, now%excess, trial, e, &
            & shear, h)
      end do
   end subroutine begin_damage

   !> Begin the modes of a lane that have no excess below 0: with the strengths of the card, in
   !> stresses and strains over the factors of the strengths
   pure subroutine begin_modes(ply, lane, excess, stress, strain, shear, h)
      type(ply_batch_constants_type), intent(in) :: ply
      !> The lane
      integer, intent(in) :: lane
      !> Excess over onset; trial stresses and strains, of which the first two count; shear
      real(wp), intent(in) :: excess(lanes, 2), stress(lanes, 3), strain(lanes, 3), shear(lanes, 2)
      real(wp), intent(inout) :: h(lanes, *)

      real(wp) :: factor(2), in_plane(2), length

      factor(:) = 1.0_wp
      if (ply%factors > 0) factor(:) = h(lane, ply%factors + of_fibres:ply%factors + of_matrix)
      h(lane, shear_peak) = begun_shear(h(lane, shear_peak))
      if (excess(lane, 1) >= 0.0_wp) then
         length = band_width(h(lane, fibre_threshold))
         call ply%onset%begin_fibre(lane, stress(lane, 1)/factor(1), strain(lane, 1)/factor(1), &
            & length, h(lane, fibre_onset), h(lane, fibre_finish))
         h(lane, fibre_onset:fibre_finish) = factor(1)*h(lane, fibre_onset:fibre_finish)
         h(lane, fibre_threshold) = begun_threshold(length)
      end if
      if (excess(lane, 2) >= 0.0_wp) then
         length = band_width(h(lane, matrix_threshold))
         in_plane(:) = shear(lane, :)/factor(2)
         call ply%onset%begin_matrix(lane, stress(lane, 2)/factor(2), strain(lane, 2)/factor(2), &
            & in_plane, length, h(lane, matrix_onset), h(lane, matrix_finish))
         h(lane, matrix_onset:matrix_finish) = factor(2)*h(lane, matrix_onset:matrix_finish)
         h(lane, matrix_threshold) = begun_threshold(length)
      end if
   end subroutine begin_modes

end module plydyn_law_ply_damage_begin
