!> Shear in the plane of some points, along its curve until the matrix cracks, with as little of
!> their history as that takes.
module plydyn_law_ply_shear
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_history, only : largest_band, matrix_gate, shear_energy, shear_peak, shear_set
   use plydyn_law_ply_lanes, only : ply_lanes_type
   implicit none
   private

   public :: bend, keep_shear

   !> Most points in a call, a line of a quad and the thickness: work space of fixed size can be
   !> aligned
   integer, parameter, public :: most_points = 15

   !> What a step makes of the shear; 0 in lanes of other laws
   type, public :: shear_type
      !> Strain that stays, and largest strain
      real(wp), dimension(lanes, most_points) :: set, peak
      !> Whether they grow at any of the points; only then, work of a ply without damage on what
      !> stays
      logical :: grows
      real(wp) :: work(lanes, most_points)
      !> Whether damage has begun at any of the points
      logical :: begun
   end type shear_type

contains

   !> Shear along its curve
   pure subroutine bend(ply, points, histories, strain, history, shear)
      !> Constants
      type(ply_lanes_type), intent(in) :: ply
      !> Number of points, `most_points` at most; history variables of each
      integer, intent(in) :: points, histories
      !> Total strain
      real(wp), intent(in) :: strain(lanes, 6, points)
      !> History, where cracks close with the damage that acts in tension first
      real(wp), intent(in) :: history(lanes, histories, points)
      !> What becomes of it
      type(shear_type), intent(out) :: shear

      real(wp) :: ahead(lanes), least(lanes), lowest, most, size(lanes, most_points)
      integer :: l, m

      ahead(:) = 0.0_wp
      least(:) = 0.0_wp
      do m = 1, points
         !$omp simd
         do l = 1, lanes
            least(l) = min(least(l), ply%own(l)*history(l, largest_band, m))
            size(l, m) = ply%own(l)*abs(strain(l, 4, m))
            shear%set(l, m) = ply%own(l)*history(l, shear_set, m)
            shear%peak(l, m) = ply%own(l)*history(l, shear_peak, m)
            ahead(l) = max(ahead(l), ply%curve%curved(l)*(size(l, m) - shear%peak(l, m)))
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
      if (shear%begun) call leave_cracked(ply, points, histories, history, shear%peak, size, most)
      shear%grows = most > 0.0_wp
      if (shear%grows) call ply%curve%grow(points, most, size, shear%peak, shear%set, shear%work)
   end subroutine bend

   !> What has cracked is elastic: nothing grows there
   pure subroutine leave_cracked(ply, points, histories, history, peak, size, most)
      type(ply_lanes_type), intent(in) :: ply
      integer, intent(in) :: points, histories
      real(wp), intent(in) :: history(lanes, histories, points)
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
            gate = history(l, matrix_gate, m)
            here = size(l, m)
            size(l, m) = merge(0.0_wp, here, gate < 0.0_wp)
            ahead(l) = max(ahead(l), ply%curve%curved(l)*(size(l, m) - peak(l, m)))
         end do
      end do
      most = 0.0_wp
      !$omp simd reduction(max:most)
      do l = 1, lanes
         most = max(most, ahead(l))
      end do
   end subroutine leave_cracked

   !> Keep what the shear of a point has become, and what it has cost
   pure subroutine keep_shear(ply, peak, set, work, history)
      !> Constants
      type(ply_lanes_type), intent(in) :: ply
      !> As in `shear_type`
      real(wp), intent(in) :: peak(lanes), set(lanes), work(lanes)
      !> History of the point
      real(wp), intent(inout) :: history(lanes, shear_energy)

      real(wp) :: cost, kept
      integer :: l

      !$omp simd private(cost, kept)
      do l = 1, lanes
         kept = history(l, shear_peak)
         history(l, shear_peak) = merge(peak(l), kept, ply%own(l) > 0.0_wp)
         kept = history(l, shear_set)
         history(l, shear_set) = merge(set(l), kept, ply%own(l) > 0.0_wp)
         cost = ply%own(l)*work(l)
         history(l, shear_energy) = history(l, shear_energy) + cost
      end do
   end subroutine keep_shear

end module plydyn_law_ply_shear
