!> Shear in the plane of some points, along its curve until the matrix cracks.
module plydyn_law_ply_shear_path
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_history, only : has_begun, largest_shear, matrix_threshold, &
      & shear_peak, shear_set, spared_work, store_columns, with_largest_shear
   use plydyn_law_ply_batch_constants, only : ply_batch_constants_type
   use plydyn_law_ply_batch_shear, only : batch_shear_type
   implicit none
   private

   public :: advance, advance_shear, elastic_shear, find_spared_work, store_shear, update_shear

   !> Most points in a call, a line of a quad and the thickness: work space of fixed size can be
   !> aligned
   integer, parameter, public :: most_points = 15

   !> Shear of some points after a step; 0 in lanes of other laws
   type, public :: shear_type
      !> Largest strain, and permanent strain
      real(wp), dimension(lanes, most_points) :: peak, set
      !> Whether they grow at any of the points, and whether damage has begun at any
      logical :: grows, begun
      !> Plastic work that damage spares; only where both is so
      real(wp) :: spared(lanes, most_points)
   end type shear_type

contains

   !> Size of the elastic shear strain
   elemental real(wp) function elastic_shear(strain, set)
      !> Shear strain 12; permanent shear strain
      real(wp), intent(in) :: strain, set

      elastic_shear = max(abs(strain) - set, 0.0_wp)
   end function elastic_shear

   !> Shear along its curve
   pure subroutine update_shear(ply, points, pitch, strain, history, shear)
      type(ply_batch_constants_type), intent(in) :: ply
      !> Number of points, `most_points` at most; rows of the history from one of their variables to
      !> the next
      integer, intent(in) :: points, pitch
      !> Total strain
      real(wp), intent(in) :: strain(lanes, 6, points)
      !> History from the first of the points on; where cracks close, the damage of tension first
      real(wp), intent(in) :: history(lanes, pitch, *)
      !> Shear after the step
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
            shear%peak(l, m) = largest_shear(kept)
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
      shear%begun = has_begun(lowest)
      if (shear%begun) call exclude_cracked(points, pitch, history, shear%peak, size, most)
      shear%grows = most > 0.0_wp
      do m = 1, points
         !$omp simd
         do l = 1, lanes
            shear%set(l, m) = ply%own(l)*history(l, m, shear_set)
         end do
      end do
      if (.not. shear%grows) return
      do m = 1, points
         !$omp simd
         do l = 1, lanes
            shear%peak(l, m) = max(shear%peak(l, m), size(l, m))
         end do
      end do
      call ply%curve%find_set(points, shear%peak, shear%set)
   end subroutine update_shear

   !> Shear of a point by the whole law: along its curve until the matrix cracks, and elastic from
   !> there
   pure subroutine advance_shear(ply, strain, h, shear, work, grows)
      type(ply_batch_constants_type), intent(in) :: ply
      !> Shear strain 12
      real(wp), intent(in) :: strain(lanes)
      !> History of the point
      real(wp), intent(inout) :: h(lanes, *)
      !> Sizes of the shear stress 12 before damage and of the elastic shear strain
      real(wp), intent(out) :: shear(lanes, 2)
      !> Plastic work per volume of an intact ply in the step
      real(wp), intent(out) :: work(lanes)
      !> Whether the permanent shear strain grows in any lane
      logical, intent(out) :: grows

      real(wp) :: peak(lanes), set(lanes), size(lanes)
      integer :: l

      size(:) = merge(0.0_wp, abs(strain), has_begun(h(:, matrix_threshold)))
      set(:) = h(:, shear_set)
      peak(:) = largest_shear(h(:, shear_peak))
      call advance(ply%curve, size, peak, set, work, grows)
      h(:, shear_peak) = with_largest_shear(peak, h(:, shear_peak))
      h(:, shear_set) = set
      associate (modulus => ply%secant%shear)
         !$omp simd
         do l = 1, lanes
            shear(l, 2) = elastic_shear(strain(l), set(l))
            shear(l, 1) = modulus(l, 1)*shear(l, 2)
         end do
      end associate
   end subroutine advance_shear

   !> Follow the curve where the strain has grown: largest strain, permanent strain, plastic work
   pure subroutine advance(curve, strain, peak, set, work, grows)
      !> Curves
      type(batch_shear_type), intent(in) :: curve
      !> Size of the shear strain; 0 where nothing is to change
      real(wp), intent(in) :: strain(lanes)
      !> Largest size of the shear strain so far; permanent shear strain
      real(wp), intent(inout) :: peak(lanes), set(lanes)
      !> Plastic work per volume of the step
      real(wp), intent(out) :: work(lanes)
      !> Whether any strain is larger than it has been
      logical, intent(out) :: grows

      real(wp) :: before(lanes)

      ! nothing changes along a line
      grows = any(curve%curved*strain > peak)
      work(:) = 0.0_wp
      if (.not. grows) return
      before(:) = curve%plastic_work(peak, set)
      peak(:) = max(peak, curve%curved*strain)
      call curve%find_set(1, peak, set)
      work(:) = curve%plastic_work(peak, set) - before
   end subroutine advance

   !> Shear is elastic where the matrix has cracked: exclude it from growth
   pure subroutine exclude_cracked(points, pitch, history, peak, size, most)
      integer, intent(in) :: points, pitch
      real(wp), intent(in) :: history(lanes, pitch, *)
      !> Largest shear strain
      real(wp), intent(in) :: peak(lanes, most_points)
      !> Shear strain in, 0 out where the matrix has cracked
      real(wp), intent(inout) :: size(lanes, most_points)
      !> Largest growth of the others
      real(wp), intent(out) :: most

      real(wp) :: ahead(lanes), here, threshold
      integer :: l, m

      ahead(:) = 0.0_wp
      do m = 1, points
         !$omp simd private(here, threshold)
         do l = 1, lanes
            threshold = history(l, m, matrix_threshold)
            here = size(l, m)
            size(l, m) = merge(0.0_wp, here, has_begun(threshold))
            ahead(l) = max(ahead(l), size(l, m) - peak(l, m))
         end do
      end do
      most = 0.0_wp
      !$omp simd reduction(max:most)
      do l = 1, lanes
         most = max(most, ahead(l))
      end do
   end subroutine exclude_cracked

   !> Plastic work that damage spares in a step in which it does not grow
   pure subroutine find_spared_work(ply, points, pitch, history, integrity, shear)
      type(ply_batch_constants_type), intent(in) :: ply
      !> As in `update_shear`; history as it was before
      integer, intent(in) :: points, pitch
      real(wp), intent(in) :: history(lanes, pitch, *)
      !> Integrity along and across the fibres
      real(wp), intent(in) :: integrity(lanes, 2, most_points)
      !> Shear after the step; gets the work
      type(shear_type), intent(inout) :: shear

      real(wp) :: before(lanes, 2)
      integer :: m

      do m = 1, points
         before(:, 1) = ply%own*largest_shear(history(:, m, shear_peak))
         before(:, 2) = ply%own*history(:, m, shear_set)
         shear%spared(:, m) = (1.0_wp - integrity(:, 1, m)*integrity(:, 2, m)) &
            & *(ply%curve%plastic_work(shear%peak(:, m), shear%set(:, m)) &
            & - ply%curve%plastic_work(before(:, 1), before(:, 2)))
      end do
   end subroutine find_spared_work

   !> Store the shear of a point
   pure subroutine store_shear(ply, m, pitch, shear, history)
      type(ply_batch_constants_type), intent(in) :: ply
      !> Which of the points; as in `update_shear`
      integer, intent(in) :: m, pitch
      !> Shear after the step
      type(shear_type), intent(in) :: shear
      !> As in `update_shear`
      real(wp), intent(inout) :: history(lanes, pitch, *)

      real(wp) :: grown, kept
      integer :: l

      !$omp simd private(grown, kept)
      do l = 1, lanes
         kept = history(l, m, shear_peak)
         grown = with_largest_shear(shear%peak(l, m), kept)
         history(l, m, shear_peak) = merge(grown, kept, ply%own(l) > 0.0_wp)
      end do
      call store_columns(ply%own, 1, shear%set(:, m), history(:, m, shear_set))
      if (.not. shear%begun) return
      !$omp simd private(grown)
      do l = 1, lanes
         grown = ply%own(l)*shear%spared(l, m)
         history(l, m, spared_work) = history(l, m, spared_work) + grown
      end do
   end subroutine store_shear

end module plydyn_law_ply_shear_path
