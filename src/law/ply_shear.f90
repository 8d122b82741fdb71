!> Shear in the plane of some points, along its curve until the matrix cracks, with as little of
!> their history as that takes.
module plydyn_law_ply_shear
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_history, only : fibre_gate, matrix_gate, shear_energy, shear_peak, shear_set
   use plydyn_law_ply_lanes, only : ply_lanes_type
   implicit none
   private

   public :: bend, keep_shear

   !> Most points in a call, a line of a quad and the thickness: work space of fixed size can be
   !> aligned
   integer, parameter, public :: most_points = 15

   !> What a step makes of the shear; 0 in lanes of other laws
   type, public :: shear_type
      !> Strain that stays
      real(wp) :: set(lanes, most_points)
      !> Whether it grows at any of the points; only then, largest strain, and work of a ply without
      !> damage on what stays
      logical :: grows
      real(wp), dimension(lanes, most_points) :: peak, work
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

      real(wp) :: across, ahead(lanes), beyond, least(lanes), lowest, most
      integer :: l, m

      ahead(:) = 0.0_wp
      least(:) = 0.0_wp
      do m = 1, points
         !$omp simd private(across, beyond)
         do l = 1, lanes
            shear%set(l, m) = ply%own(l)*history(l, shear_set, m)
            across = ply%own(l)*history(l, matrix_gate, m)
            least(l) = min(least(l), ply%own(l)*history(l, fibre_gate, m), across)
            beyond = ply%curve%curved(l)*(abs(strain(l, 4, m)) - history(l, shear_peak, m))
            ! what has cracked is elastic
            ahead(l) = max(ahead(l), beyond*max(sign(1.0_wp, across), 0.0_wp))
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
      shear%grows = most > 0.0_wp
      if (shear%grows) call follow(ply, points, histories, strain, history, shear)
   end subroutine bend

   !> Shear that grows along its curve
   pure subroutine follow(ply, points, histories, strain, history, shear)
      type(ply_lanes_type), intent(in) :: ply
      integer, intent(in) :: points, histories
      real(wp), intent(in) :: strain(lanes, 6, points), history(lanes, histories, points)
      type(shear_type), intent(inout) :: shear

      real(wp) :: gate, here, size(lanes, most_points)
      integer :: l, m

      do m = 1, points
         !$omp simd private(gate, here)
         do l = 1, lanes
            gate = history(l, matrix_gate, m)
            here = ply%own(l)*abs(strain(l, 4, m))
            size(l, m) = merge(0.0_wp, here, gate < 0.0_wp)
            shear%peak(l, m) = ply%own(l)*history(l, shear_peak, m)
         end do
      end do
      call ply%curve%advance(points, size, shear%peak, shear%set, shear%work, shear%grows)
   end subroutine follow

   !> Keep what the shear of a point has become, and what it has cost
   pure subroutine keep_shear(ply, peak, set, work, history)
      !> Constants
      type(ply_lanes_type), intent(in) :: ply
      !> As in `shear_type`
      real(wp), intent(in) :: peak(lanes), set(lanes), work(lanes)
      !> History of the point
      real(wp), intent(inout) :: history(lanes, shear_set)

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
