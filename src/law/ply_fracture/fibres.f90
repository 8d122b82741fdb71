!> Fibres that break or are crushed, and the stress of a ply without matrix cracks.
module plydyn_law_ply_fracture_fibres
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_fracture_batch_constants, only : fracture_batch_type
   use plydyn_law_ply_fracture_constants, only : snap_ratio
   use plydyn_law_ply_fracture_history, only : fibre_damage, fibre_finish, fibre_onset, &
      & fibre_width, histories
   implicit none
   private

   public :: damage_fibres, uncracked_stress

   !> Keeps divisors off zero in lanes without anything
   real(wp), parameter :: small = 1.0e-30_wp

contains

   !> Integrity of the fibres before and after a step. Damage begins by the stress of an intact ply,
   !> and the stress then falls with the strain along the fibres, to zero or to the plateau
   pure subroutine damage_fibres(ply, elastic, h, left)
      !> Constants
      type(fracture_batch_type), intent(in) :: ply
      !> Elastic strain
      real(wp), intent(in) :: elastic(lanes, 6)
      !> History of the point
      real(wp), intent(inout) :: h(lanes, histories)
      !> Before and after, (lanes, 2)
      real(wp), intent(out) :: left(lanes, 2)

      real(wp) :: most, reached, strain, strength(lanes), stress(lanes), toughness
      integer :: l

      most = 0.0_wp
      associate (c => ply%stiffness)
         !$omp simd private(reached, toughness) reduction(max:most)
         do l = 1, lanes
            left(l, 1) = 1.0_wp - h(l, fibre_damage)
            stress(l) = c(l, 1)*elastic(l, 1) + c(l, 2)*elastic(l, 2) + c(l, 3)*elastic(l, 3)
            strength(l) = merge(ply%fibre_strength(l, 1), ply%fibre_strength(l, 2), &
               & stress(l) >= 0.0_wp)
            toughness = merge(ply%fibre_toughness(l, 1), ply%fibre_toughness(l, 2), &
               & stress(l) >= 0.0_wp)
            strength(l) = min(strength(l), sqrt(2.0_wp*toughness/(snap_ratio*ply%compliance(l) &
               & *max(h(l, fibre_width), small))))
            reached = ply%own(l)*(abs(stress(l)) - strength(l))
            most = max(most, reached, abs(h(l, fibre_onset)))
         end do
      end associate
      left(:, 2) = left(:, 1)
      if (.not. most > 0.0_wp) return
      do l = 1, lanes
         if (abs(h(l, fibre_onset)) > 0.0_wp .or. abs(stress(l)) < strength(l) &
            & .or. ply%own(l) <= 0.0_wp) cycle
         ! on the way to the stress of now the strength was met at this strain
         strain = abs(elastic(l, 1))*strength(l)/abs(stress(l))
         toughness = merge(ply%fibre_toughness(l, 1), ply%fibre_toughness(l, 2), &
            & stress(l) >= 0.0_wp)
         h(l, fibre_onset) = sign(strain, stress(l))
         h(l, fibre_finish) = max(2.0_wp*toughness/(h(l, fibre_width)*strength(l)), &
            & snap_ratio*strain)
      end do
      call soften(ply, elastic(:, 1), h)
      left(:, 2) = 1.0_wp - h(:, fibre_damage)
   end subroutine damage_fibres

   !> Let the damage of fibres grow with the strain along them; it never heals
   pure subroutine soften(ply, strain, h)
      !> Constants
      type(fracture_batch_type), intent(in) :: ply
      !> Strain along the fibres
      real(wp), intent(in) :: strain(lanes)
      !> History of the point
      real(wp), intent(inout) :: h(lanes, histories)

      real(wp) :: damage, fall, floor, now, onset, rest
      integer :: l

      !$omp simd private(damage, fall, floor, now, onset, rest)
      do l = 1, lanes
         onset = abs(h(l, fibre_onset))
         floor = merge(ply%plateau(l), 0.0_wp, h(l, fibre_onset) < 0.0_wp)
         fall = max(h(l, fibre_finish) - onset, small)
         now = max(abs(strain(l)), onset, small)
         rest = max((h(l, fibre_finish) - now)/fall, floor)
         damage = min(1.0_wp - onset*rest/now, ply%most_damage(l))
         h(l, fibre_damage) = merge(max(damage, h(l, fibre_damage)), h(l, fibre_damage), &
            & onset > 0.0_wp)
      end do
   end subroutine soften

   !> Stress of a ply whose fibres have an integrity: it multiplies E1 of the compliance, G12 and
   !> G13, and leaves the Poisson terms
   pure subroutine uncracked_stress(ply, strain, left, stress)
      !> Constants
      type(fracture_batch_type), intent(in) :: ply
      !> Elastic strain without that of cracks; integrity of the fibres
      real(wp), intent(in) :: strain(lanes, 6), left(lanes)
      !> Stress
      real(wp), intent(out) :: stress(lanes, 6)

      real(wp) :: along, lost
      integer :: l

      associate (c => ply%stiffness, g => ply%shear, e => strain)
         !$omp simd private(along, lost)
         do l = 1, lanes
            along = c(l, 1)*e(l, 1) + c(l, 2)*e(l, 2) + c(l, 3)*e(l, 3)
            lost = along*(1.0_wp - left(l))*ply%compliance(l) &
               & /(left(l) + (1.0_wp - left(l))*ply%compliance(l)*c(l, 1))
            stress(l, 1) = along - lost*c(l, 1)
            stress(l, 2) = c(l, 2)*e(l, 1) + c(l, 4)*e(l, 2) + c(l, 5)*e(l, 3) - lost*c(l, 2)
            stress(l, 3) = c(l, 3)*e(l, 1) + c(l, 5)*e(l, 2) + c(l, 6)*e(l, 3) - lost*c(l, 3)
            stress(l, 4) = left(l)*g(l, 1)*e(l, 4)
            stress(l, 5) = left(l)*g(l, 2)*e(l, 5)
            stress(l, 6) = g(l, 3)*e(l, 6)
         end do
      end associate
   end subroutine uncracked_stress

end module plydyn_law_ply_fracture_fibres
