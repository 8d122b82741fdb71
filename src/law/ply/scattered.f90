!> Strengths that scatter from point to point.
!>
!> All criteria are homogeneous: a mode whose strengths are s times those of the card is, in
!> stresses and strains divided by s, a mode with the strengths of the card and a crack band that is
!> s**2 times as wide. The same holds for shear, whose curve is s times as large in stress and in
!> strain. The history of a point has the widened bands before onset, and the factors.
module plydyn_law_ply_scattered
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_batch_constants, only : ply_batch_constants_type
   use plydyn_law_ply_batch_shear, only : batch_shear_type
   use plydyn_law_ply_history, only : band_width, fibre_threshold, matrix_threshold
   implicit none
   private

   public :: find_scaled_set, find_scattered_onset, load_column, load_factors, plastic_work_at, &
      & raise_by_factors

   !> Places of the factors of fibres and of matrix behind `factors` of the constants
   integer, parameter, public :: of_fibres = 1, of_matrix = 2

contains

   !> Factors of the strengths of fibres and of matrix at a point; 1 in lanes of other laws
   pure subroutine load_factors(ply, pitch, history, factor)
      !> Constants of a law whose strengths scatter
      type(ply_batch_constants_type), intent(in) :: ply
      !> Rows of the history from one variable to the next
      integer, intent(in) :: pitch
      !> History from the point on
      real(wp), intent(in) :: history(lanes, pitch, *)
      !> The factors
      real(wp), intent(out) :: factor(lanes, 2)

      integer :: k

      do k = of_fibres, of_matrix
         call load_column(ply%own, 1, history(:, 1, ply%factors + k), factor(:, k))
      end do
   end subroutine load_factors

   !> Factors of fibres or of matrix at some points; 1 in lanes of other laws
   pure subroutine load_column(own, points, variable, factor)
      !> 1 in lanes of the law, else 0
      real(wp), intent(in) :: own(lanes)
      !> Number of points
      integer, intent(in) :: points
      !> Variable of the history
      real(wp), intent(in) :: variable(lanes, points)
      !> The factors
      real(wp), intent(out) :: factor(lanes, points)

      integer :: l, m
      real(wp) :: kept

      do m = 1, points
         !$omp simd private(kept)
         do l = 1, lanes
            kept = variable(l, m)
            factor(l, m) = merge(kept, 1.0_wp, own(l) > 0.0_wp)
         end do
      end do
   end subroutine load_column

   !> How far beyond onset a point is: by stresses and strains over the factors, which the strengths
   !> of the card limit
   pure subroutine find_scattered_onset(ply, pitch, history, trial, e, shear, excess)
      !> As in `load_factors`
      type(ply_batch_constants_type), intent(in) :: ply
      integer, intent(in) :: pitch
      real(wp), intent(in) :: history(lanes, pitch, *)
      !> Trial stresses and strains 11 and 22
      real(wp), intent(in) :: trial(lanes, 2), e(lanes, 2)
      !> Sizes of the shear stress on its curve and of the elastic shear strain
      real(wp), intent(in) :: shear(lanes, 2)
      !> As in `find_onset`
      real(wp), intent(out) :: excess(lanes, 2)

      real(wp) :: factor(lanes, 2), in_plane(lanes, 2), strain(lanes, 2), stress(lanes, 2)
      integer :: k, l

      call load_factors(ply, pitch, history, factor)
      do k = of_fibres, of_matrix
         !$omp simd
         do l = 1, lanes
            stress(l, k) = trial(l, k)/factor(l, k)
            strain(l, k) = e(l, k)/factor(l, k)
            in_plane(l, k) = shear(l, k)/factor(l, of_matrix)
         end do
      end do
      call ply%onset%find_onset(stress, strain, in_plane, &
         & band_width(history(:, 1, fibre_threshold)), &
         & band_width(history(:, 1, matrix_threshold)), excess)
   end subroutine find_scattered_onset

   !> Raise sums that are below 1 far from onset to what they are at most with the factors
   pure subroutine raise_by_factors(ply, points, pitch, history, each)
      !> Constants of a law whose strengths scatter
      type(ply_batch_constants_type), intent(in) :: ply
      !> Number of points; rows of the history from one variable to the next
      integer, intent(in) :: points, pitch
      !> History from the first of the points on
      real(wp), intent(in) :: history(lanes, pitch, *)
      !> Largest sum of the points of each lane with the strengths of the card
      real(wp), intent(inout) :: each(lanes)

      real(wp) :: factor(lanes, 2), least(lanes)
      integer :: m

      least(:) = 1.0_wp
      do m = 1, points
         call load_factors(ply, pitch, history(1, m, 1), factor)
         least(:) = min(least, factor(:, of_fibres), factor(:, of_matrix))
      end do
      each(:) = each/least**2
   end subroutine raise_by_factors

   !> Permanent shear strain that belongs to a largest one; never less than before
   pure subroutine find_scaled_set(curve, points, factor, peak, set)
      !> Curves of the card
      type(batch_shear_type), intent(in) :: curve
      !> Number of points
      integer, intent(in) :: points
      !> Factors of the matrix
      real(wp), intent(in) :: factor(lanes, points)
      !> Largest size of the shear strain
      real(wp), intent(in) :: peak(lanes, points)
      !> Permanent strain
      real(wp), intent(inout) :: set(lanes, points)

      real(wp) :: scaled(lanes, points), start(lanes, points)

      ! from no permanent strain: the same peak gives the same bits in every step
      start(:, :) = 0.0_wp
      scaled(:, :) = peak/factor
      call curve%find_set(points, scaled, start)
      set(:, :) = max(set, factor*start)
   end subroutine find_scaled_set

   !> Plastic work per volume of an intact ply since the beginning
   pure function plastic_work_at(ply, pitch, history, peak, set) result(work)
      !> Constants
      type(ply_batch_constants_type), intent(in) :: ply
      !> As in `load_factors`
      integer, intent(in) :: pitch
      real(wp), intent(in) :: history(lanes, pitch, *)
      !> Largest and permanent shear strain
      real(wp), intent(in) :: peak(lanes), set(lanes)
      real(wp) :: work(lanes)

      real(wp) :: factor(lanes, 2)

      if (ply%factors > 0) then
         call load_factors(ply, pitch, history, factor)
         work(:) = factor(:, of_matrix)**2*ply%curve%plastic_work(peak/factor(:, of_matrix), &
            & set/factor(:, of_matrix))
      else
         work(:) = ply%curve%plastic_work(peak, set)
      end if
   end function plastic_work_at

end module plydyn_law_ply_scattered
