!> Shear in the plane of some points, along its curve until the matrix cracks, with as little of
!> their history as that takes.
module plydyn_law_ply_shear_path
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_history, only : give, matrix_gate, shear_peak, shear_set, &
      & shear_spared
   use plydyn_law_ply_batch_constants, only : ply_batch_constants_type
   implicit none
   private

   public :: bend, keep_shear, spare_work

   !> Most points in a call, a line of a quad and the thickness: work space of fixed size can be
   !> aligned
   integer, parameter, public :: most_points = 15

   !> What a step makes of the shear; 0 in lanes of other laws
   type, public :: shear_type
      !> Largest strain, and strain that stays
      real(wp), dimension(lanes, most_points) :: peak, set
      !> Whether they grow at any of the points, and whether damage has begun at any
      logical :: grows, begun
      !> Only where both is so, work on what stays that the damage spares
      real(wp) :: spared(lanes, most_points)
   end type shear_type

contains

   !> Shear along its curve
   pure subroutine bend(ply, points, pitch, strain, history, shear)
      !> Constants
      type(ply_batch_constants_type), intent(in) :: ply
      !> Number of points, `most_points` at most; rows of the history from one of their variables to
      !> the next
      integer, intent(in) :: points, pitch
      !> Total strain
      real(wp), intent(in) :: strain(lanes, 6, points)
      !> History from the first of the points on, where cracks close with the damage
      !> that acts in tension first
      real(wp), intent(in) :: history(lanes, pitch, *)
      !> What becomes of it
      type(shear_type), intent(out) :: shear

      real(wp) :: ahead(lanes), kept, least(lanes), lowest, most, size(lanes, most_points)
      integer :: l, m

      ahead(:) = 0.0_wp
      least(:) = 0.0_wp
      do m = 1, points
         !$omp simd private(kept)
         do l = 1, lanes
            kept = ply%own(l)*history(l, m, shear_peak)
            least(l) = min(least(l), kept)
            size(l, m) = ply%own(l)*ply%curve%curved(l)*abs(strain(l, 4, m))
            shear%peak(l, m) = abs(kept)
            ahead(l) = max(ahead(l), size(l, m) - shear%peak(l, m))
         end do
      end do
      lowest = 0.0_wp
      most = 0.0_wp
      !$omp simd reduction(min:lowest) reduction(max:most)
      do l = 1, lanes
         lowest = min(lowest, least(l))
         most = max(most, ahead(l))
      end do
      shear%begun = lowest < 0.0_wp
      if (shear%begun) call leave_cracked(points, pitch, history, shear%peak, size, most)
      shear%grows = most > 0.0_wp
      call recall_set(ply%own, points, pitch, history, shear%set)
      if (.not. shear%grows) return
      call raise(points, size, shear%peak)
      call ply%curve%find_set(points, shear%peak, shear%set)
   end subroutine bend

   !> What has cracked is elastic: nothing grows there
   pure subroutine leave_cracked(points, pitch, history, peak, size, most)
      integer, intent(in) :: points, pitch
      real(wp), intent(in) :: history(lanes, pitch, *)
      !> Largest shear strain
      real(wp), intent(in) :: peak(lanes, most_points)
      !> Shear strain in, 0 out where the matrix has cracked
      real(wp), intent(inout) :: size(lanes, most_points)
      !> Largest growth of the others
      real(wp), intent(out) :: most

      real(wp) :: ahead(lanes), gate, here
      integer :: l, m

      ahead(:) = 0.0_wp
      do m = 1, points
         !$omp simd private(gate, here)
         do l = 1, lanes
            gate = history(l, m, matrix_gate)
            here = size(l, m)
            size(l, m) = merge(0.0_wp, here, gate < 0.0_wp)
            ahead(l) = max(ahead(l), size(l, m) - peak(l, m))
         end do
      end do
      most = 0.0_wp
      !$omp simd reduction(max:most)
      do l = 1, lanes
         most = max(most, ahead(l))
      end do
   end subroutine leave_cracked

   !> Strain that stayed before
   pure subroutine recall_set(own, points, pitch, history, set)
      real(wp), intent(in) :: own(lanes)
      integer, intent(in) :: points, pitch
      real(wp), intent(in) :: history(lanes, pitch, *)
      real(wp), intent(inout) :: set(lanes, most_points)

      integer :: l, m

      do m = 1, points
         !$omp simd
         do l = 1, lanes
            set(l, m) = own(l)*history(l, m, shear_set)
         end do
      end do
   end subroutine recall_set

   !> Strains that are larger than all before
   pure subroutine raise(points, size, peak)
      integer, intent(in) :: points
      real(wp), intent(in) :: size(lanes, most_points)
      real(wp), intent(inout) :: peak(lanes, most_points)

      integer :: l, m

      do m = 1, points
         !$omp simd
         do l = 1, lanes
            peak(l, m) = max(peak(l, m), size(l, m))
         end do
      end do
   end subroutine raise

   !> Work on what stays that damage spares in a step in which it does not grow
   pure subroutine spare_work(ply, points, pitch, history, remains, shear)
      !> Constants
      type(ply_batch_constants_type), intent(in) :: ply
      !> As in `bend`; history as it was before
      integer, intent(in) :: points, pitch
      real(wp), intent(in) :: history(lanes, pitch, *)
      !> What remains of the stiffness along and across the fibres
      real(wp), intent(in) :: remains(lanes, 2, most_points)
      !> What the step makes of the shear; gets the work
      type(shear_type), intent(inout) :: shear

      real(wp) :: before(lanes, 2)
      integer :: m

      do m = 1, points
         before(:, 1) = ply%own*abs(history(:, m, shear_peak))
         before(:, 2) = ply%own*history(:, m, shear_set)
         shear%spared(:, m) = (1.0_wp - remains(:, 1, m)*remains(:, 2, m)) &
            & *(ply%curve%lost(shear%peak(:, m), shear%set(:, m)) &
            & - ply%curve%lost(before(:, 1), before(:, 2)))
      end do
   end subroutine spare_work

   !> Keep what the shear of a point has become
   pure subroutine keep_shear(ply, m, pitch, shear, history)
      !> Constants
      type(ply_batch_constants_type), intent(in) :: ply
      !> Which of the points; as in `bend`
      integer, intent(in) :: m, pitch
      !> What the step has made of the shear
      type(shear_type), intent(in) :: shear
      !> As in `bend`
      real(wp), intent(inout) :: history(lanes, pitch, *)

      real(wp) :: grown, kept
      integer :: l

      !$omp simd private(grown, kept)
      do l = 1, lanes
         kept = history(l, m, shear_peak)
         grown = sign(shear%peak(l, m), kept)
         history(l, m, shear_peak) = merge(grown, kept, ply%own(l) > 0.0_wp)
      end do
      call give(ply%own, 1, shear%set(:, m), history(:, m, shear_set))
      if (.not. shear%begun) return
      !$omp simd private(grown)
      do l = 1, lanes
         grown = ply%own(l)*shear%spared(l, m)
         history(l, m, shear_spared) = history(l, m, shear_spared) + grown
      end do
   end subroutine keep_shear

end module plydyn_law_ply_shear_path
