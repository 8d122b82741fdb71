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
   pure subroutine begin_damage(ply, strain, shear, stress, history, now, begins)
      !> Constants
      type(ply_batch_constants_type), intent(in) :: ply
      !> Strains 11, 22, 33; sizes of shear stress and elastic shear strain; effective normal
      !> stresses
      real(wp), intent(in) :: strain(lanes, 3), shear(lanes, 2), stress(lanes, 3)
      !> History of the point
      real(wp), intent(inout) :: history(lanes, *)
      !> Change of the point; gets the excess over onset
      type(ply_step_type), intent(inout) :: now
      !> A mode begins in some lane
      logical, intent(out) :: begins

      real(wp) :: most, trial(lanes, 3)
      integer :: lane

      trial(:, :) = stress
      if (ply%any_intact) call use_intact_stress(ply, strain, trial)
      if (ply%factors > 0) then
         call find_scattered_onset(ply, 1, history, trial, strain, shear, now%excess)
      else
         call ply%onset%find_onset(trial, strain, shear, band_width(history(:, fibre_threshold)), &
            & band_width(history(:, matrix_threshold)), now%excess)
      end if
      most = -1.0_wp
      associate (excess => now%excess)
         !$omp simd reduction(max:most)
         do lane = 1, lanes
            excess(lane, 1) = merge(-1.0_wp, excess(lane, 1), history(lane, fibre_finish) > 0.0_wp)
            excess(lane, 2) = merge(-1.0_wp, excess(lane, 2), history(lane, matrix_finish) > 0.0_wp)
            most = max(most, excess(lane, 1), excess(lane, 2))
         end do
      end associate
      begins = most >= 0.0_wp
      if (.not. begins) return
      ! once in the life of a mode at a point
      do lane = 1, lanes
         if (any(now%excess(lane, :) >= 0.0_wp)) call begin_modes(ply, lane, now%excess, trial, &
            & strain, shear, history)
      end do
   end subroutine begin_damage

   !> Begin the modes of a lane that have no excess below 0: with the strengths of the card, in
   !> stresses and strains over the factors of the strengths
   pure subroutine begin_modes(ply, lane, excess, stress, strain, shear, history)
      type(ply_batch_constants_type), intent(in) :: ply
      !> The lane
      integer, intent(in) :: lane
      !> Excess over onset; trial stresses and strains, of which the first two count; shear
      real(wp), intent(in) :: excess(lanes, 2), stress(lanes, 3), strain(lanes, 3), shear(lanes, 2)
      real(wp), intent(inout) :: history(lanes, *)

      real(wp) :: factor(2), in_plane(2), length

      factor(:) = 1.0_wp
      if (ply%factors > 0) factor(:) = history(lane, ply%factors + of_fibres:ply%factors &
         & + of_matrix)
      history(lane, shear_peak) = begun_shear(history(lane, shear_peak))
      if (excess(lane, 1) >= 0.0_wp) then
         length = band_width(history(lane, fibre_threshold))
         call ply%onset%begin_fibre(lane, stress(lane, 1)/factor(1), strain(lane, 1)/factor(1), &
            & length, history(lane, fibre_onset), history(lane, fibre_finish))
         history(lane, fibre_onset:fibre_finish) = factor(1)*history(lane, fibre_onset:fibre_finish)
         history(lane, fibre_threshold) = begun_threshold(length)
      end if
      if (excess(lane, 2) >= 0.0_wp) then
         length = band_width(history(lane, matrix_threshold))
         in_plane(:) = shear(lane, :)/factor(2)
         call ply%onset%begin_matrix(lane, stress(lane, 2)/factor(2), strain(lane, 2)/factor(2), &
            & in_plane, length, history(lane, matrix_onset), history(lane, matrix_finish))
         history(lane, matrix_onset:matrix_finish) = factor(2)*history(lane, &
            & matrix_onset:matrix_finish)
         history(lane, matrix_threshold) = begun_threshold(length)
      end if
   end subroutine begin_modes

end module plydyn_law_ply_damage_begin
