!> Permanent strain of a ply: shear 12, 13 and 23, each by itself and signed, and crushing through
!> the thickness.
module plydyn_law_ply_fracture_permanent
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_fracture_constants, only : fracture_batch_type
   use plydyn_law_ply_fracture_history, only : crushed, histories, plane_cosine, plane_sine, &
      & plastic_shear, yield_stress
   implicit none
   private

   public :: add_permanent_strain

contains

   !> Let permanent strains grow. Shear stops where the matrix has a plane of fracture; the pressure
   !> that crushes is that on a ply without cracks
   pure subroutine add_permanent_strain(ply, e, h, elastic, growth, grows)
      type(fracture_batch_type), intent(in) :: ply
      !> Total strain
      real(wp), intent(in) :: e(lanes, 6)
      !> History of the point
      real(wp), intent(inout) :: h(lanes, histories)
      !> Elastic strain, that of cracks in it
      real(wp), intent(out) :: elastic(lanes, 6)
      !> Growth of the strains 12, 13, 23 and 33 in the step
      real(wp), intent(out) :: growth(lanes, 4)
      !> Whether any does in any lane
      logical, intent(out) :: grows

      real(wp) :: excess(lanes, 3), most, over
      integer :: k, l

      most = 0.0_wp
      do k = 1, 3
         call find_excess(ply, k, e(:, 3 + k), h, elastic(:, 3 + k), excess(:, k))
         growth(:, k) = 0.0_wp
      end do
      !$omp simd reduction(max:most)
      do l = 1, lanes
         most = max(most, excess(l, 1), excess(l, 2), excess(l, 3))
      end do
      if (most > 0.0_wp) then
         do k = 1, 3
            call add_shear(ply, k, excess(:, k), h, elastic(:, 3 + k), growth(:, k))
         end do
      end if
      associate (c => ply%stiffness)
         !$omp simd private(over) reduction(max:most)
         do l = 1, lanes
            elastic(l, 1) = e(l, 1)
            elastic(l, 2) = e(l, 2)
            over = c(l, 3)*e(l, 1) + c(l, 5)*e(l, 2) + c(l, 6)*(e(l, 3) - h(l, crushed))
            over = max(-over - ply%crush_stress(l), 0.0_wp)
            growth(l, 4) = -over*ply%give(l)
            most = max(most, over)
            h(l, crushed) = h(l, crushed) + growth(l, 4)
            elastic(l, 3) = e(l, 3) - h(l, crushed)
         end do
      end associate
      grows = most > 0.0_wp
   end subroutine add_permanent_strain

   !> Shear stress beyond the yield stress, were the strain to stay elastic; 0 where the matrix has
   !> a plane of fracture
   pure subroutine find_excess(ply, k, e, h, elastic, over)
      type(fracture_batch_type), intent(in) :: ply
      !> Which shear
      integer, intent(in) :: k
      !> Its strain; history of the point
      real(wp), intent(in) :: e(lanes), h(lanes, histories)
      !> Elastic strain, and stress beyond yield
      real(wp), intent(out) :: elastic(lanes), over(lanes)

      real(wp) :: uncracked
      integer :: l, p, y

      p = plastic_shear - 1 + k
      y = yield_stress - 1 + k
      !$omp simd private(uncracked)
      do l = 1, lanes
         elastic(l) = e(l) - h(l, p)
         uncracked = merge(1.0_wp, 0.0_wp, abs(h(l, plane_cosine)) + abs(h(l, plane_sine)) &
            & <= 0.0_wp)
         over(l) = uncracked*max(ply%shear(l, k)*abs(elastic(l)) &
            & - max(h(l, y), ply%first_yield(l, k)), 0.0_wp)
      end do
   end subroutine find_excess

   !> Permanent strain of one shear: along its curve from the yield stress that it has hardened to,
   !> by the elastic strain beyond it
   pure subroutine add_shear(ply, k, over, h, elastic, growth)
      type(fracture_batch_type), intent(in) :: ply
      !> Which shear
      integer, intent(in) :: k
      !> Stress beyond yield
      real(wp), intent(in) :: over(lanes)
      !> History of the point; elastic strain, with that beyond yield in and without it out
      real(wp), intent(inout) :: h(lanes, histories), elastic(lanes)
      !> Growth of the permanent strain
      real(wp), intent(out) :: growth(lanes)

      real(wp) :: flows, grown, old, reached(lanes), strain(lanes), trial(lanes), yield(lanes)
      integer :: l, p, y

      p = plastic_shear - 1 + k
      y = yield_stress - 1 + k
      trial(:) = ply%shear(:, k)*abs(elastic)
      yield(:) = trial - over
      strain(:) = ply%curves(k)%curve_strain(yield)
      call ply%curves(k)%curve_stress(1, strain + over/ply%shear(:, k), &
         & strain - yield/ply%shear(:, k), reached)
      !$omp simd private(flows, grown, old)
      do l = 1, lanes
         flows = merge(1.0_wp, 0.0_wp, over(l) > 0.0_wp)
         old = h(l, y)
         grown = sign(flows*(trial(l) - reached(l))/ply%shear(l, k), elastic(l))
         growth(l) = grown
         h(l, p) = h(l, p) + grown
         h(l, y) = flows*reached(l) + (1.0_wp - flows)*old
         elastic(l) = elastic(l) - grown
      end do
   end subroutine add_shear

end module plydyn_law_ply_fracture_permanent
