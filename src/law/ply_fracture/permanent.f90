!> Permanent strain of a ply: shear 12, 13 and 23, each by itself and signed, and crushing through
!> the thickness.
module plydyn_law_ply_fracture_permanent
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_fracture_batch_constants, only : fracture_batch_type
   use plydyn_law_ply_fracture_history, only : crushed, histories, plane_cosine, plane_sine, &
      & plastic_shear, yield_stress
   implicit none
   private

   public :: add_permanent_strain

   !> Relative change of stress that ends the search on a power curve, and most steps of it
   real(wp), parameter :: stress_tolerance = 1.0e-14_wp
   integer, parameter :: most_steps = 60

contains

   !> Let permanent strains grow. Shear stops where the matrix has a plane of fracture; the pressure
   !> that crushes is that on a ply without cracks
   pure subroutine add_permanent_strain(ply, e, h, elastic, growth)
      !> Constants
      type(fracture_batch_type), intent(in) :: ply
      !> Total strain
      real(wp), intent(in) :: e(lanes, 6)
      !> History of the point
      real(wp), intent(inout) :: h(lanes, histories)
      !> Elastic strain, that of cracks in it
      real(wp), intent(out) :: elastic(lanes, 6)
      !> Growth of the strains 12, 13, 23 and 33 in the step
      real(wp), intent(out) :: growth(lanes, 4)

      real(wp) :: over
      integer :: k, l

      elastic(:, :2) = e(:, :2)
      do k = 1, 3
         call add_shear(ply, k, e(:, 3 + k), h, elastic(:, 3 + k), growth(:, k))
      end do
      associate (c => ply%stiffness)
         !$omp simd private(over)
         do l = 1, lanes
            over = c(l, 3)*e(l, 1) + c(l, 5)*e(l, 2) + c(l, 6)*(e(l, 3) - h(l, crushed))
            over = max(-over - ply%crush_stress(l), 0.0_wp)
            growth(l, 4) = -over/c(l, 6)
            h(l, crushed) = h(l, crushed) + growth(l, 4)
            elastic(l, 3) = e(l, 3) - h(l, crushed)
         end do
      end associate
   end subroutine add_permanent_strain

   !> Permanent strain of one shear, by return to the yield stress that it has hardened to
   pure subroutine add_shear(ply, k, e, h, elastic, growth)
      !> Constants
      type(fracture_batch_type), intent(in) :: ply
      !> Which shear
      integer, intent(in) :: k
      !> Its strain
      real(wp), intent(in) :: e(lanes)
      !> History of the point
      real(wp), intent(inout) :: h(lanes, histories)
      !> Elastic strain, and growth of the permanent one
      real(wp), intent(out) :: elastic(lanes), growth(lanes)

      real(wp) :: grown, most, over(lanes), reached(lanes), trial(lanes), yield
      integer :: l, p, y

      p = plastic_shear - 1 + k
      y = yield_stress - 1 + k
      most = 0.0_wp
      !$omp simd private(yield) reduction(max:most)
      do l = 1, lanes
         elastic(l) = e(l) - h(l, p)
         growth(l) = 0.0_wp
         trial(l) = ply%shear(l, k)*abs(elastic(l))
         yield = max(h(l, y), ply%first_yield(l, k))
         over(l) = trial(l) - yield
         over(l) = merge(over(l), 0.0_wp, abs(h(l, plane_cosine)) + abs(h(l, plane_sine)) <= 0.0_wp)
         over(l) = max(over(l), 0.0_wp)
         reached(l) = trial(l) - over(l)*ply%shear(l, k)/(ply%shear(l, k) + ply%hardening(l, k))
         most = max(most, over(l))
      end do
      if (.not. most > 0.0_wp) return
      if (ply%has_power) call return_to_curve(ply, k, over, trial, reached)
      !$omp simd private(grown)
      do l = 1, lanes
         grown = (trial(l) - reached(l))/ply%shear(l, k)
         grown = sign(merge(grown, 0.0_wp, over(l) > 0.0_wp), elastic(l))
         growth(l) = grown
         h(l, p) = h(l, p) + grown
         h(l, y) = merge(reached(l), h(l, y), over(l) > 0.0_wp)
         elastic(l) = elastic(l) - grown
      end do
   end subroutine add_shear

   !> Stress on a power curve from a trial stress beyond it, by Newton's method from above
   pure subroutine return_to_curve(ply, k, over, trial, reached)
      !> Constants
      type(fracture_batch_type), intent(in) :: ply
      !> Which shear
      integer, intent(in) :: k
      !> Trial stress, and what it has beyond the yield stress
      real(wp), intent(in) :: over(lanes), trial(lanes)
      !> Stress of the lanes with a power curve
      real(wp), intent(inout) :: reached(lanes)

      real(wp) :: bent, change, kept, stress
      integer :: i, l

      do l = 1, lanes
         associate (coefficient => ply%coefficient(l, k), exponent => ply%exponent(l))
            if (.not. (over(l) > 0.0_wp .and. coefficient > 0.0_wp)) cycle
            kept = trial(l) + coefficient*(trial(l) - over(l))**exponent
            stress = trial(l)
            do i = 1, most_steps
               bent = coefficient*stress**(exponent - 1.0_wp)
               change = (stress*(1.0_wp + bent) - kept)/(1.0_wp + exponent*bent)
               stress = stress - change
               if (change <= stress_tolerance*stress) exit
            end do
            reached(l) = stress
         end associate
      end do
   end subroutine return_to_curve

end module plydyn_law_ply_fracture_permanent
