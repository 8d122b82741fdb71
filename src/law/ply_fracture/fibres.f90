!> Fibres that break or are crushed, and the stress of a ply without matrix cracks.
module plydyn_law_ply_fracture_fibres
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_fracture_constants, only : fracture_batch_type, snap_ratio
   use plydyn_law_ply_fracture_history, only : fibre_damage, fibre_finish, fibre_onset, &
      & fibre_width, histories
   use plydyn_law_ply_history, only : began_in_compression
   implicit none
   private

   public :: damage_fibres, uncracked_stress

   !> What is left of the fibres in a step
   type, public :: fibres_type
      !> Integrity before and after; whether it falls in any lane
      real(wp) :: before(lanes), after(lanes)
      logical :: grows
      !> What broken fibres take off the stiffness: C11, C12, C13 times this times C11, C12, C13
      real(wp) :: lost(lanes)
   end type fibres_type

   !> Keeps divisors off zero in lanes without anything
   real(wp), parameter :: small = 1.0e-30_wp

contains

   !> Integrity of the fibres before and after a step. Damage begins by the stress of an intact ply,
   !> and the stress then falls with the strain along the fibres, to zero or to the plateau
   pure subroutine damage_fibres(ply, elastic, h, fibres)
      !> Constants
      type(fracture_batch_type), intent(in) :: ply
      !> Elastic strain
      real(wp), intent(in) :: elastic(lanes, 6)
      !> History of the point
      real(wp), intent(inout) :: h(lanes, histories)
      !> What is left of them
      type(fibres_type), intent(out) :: fibres

      real(wp) :: bonds, limit, most, square(lanes), stress(lanes), tension
      integer :: l

      most = 0.0_wp
      bonds = 0.0_wp
      associate (c => ply%stiffness, a => ply%fibre_limit, b => ply%fibre_energy_limit)
         !$omp simd private(limit, tension) reduction(max:most, bonds)
         do l = 1, lanes
            fibres%before(l) = 1.0_wp - h(l, fibre_damage)
            stress(l) = c(l, 1)*elastic(l, 1) + c(l, 2)*elastic(l, 2) + c(l, 3)*elastic(l, 3)
            tension = merge(1.0_wp, 0.0_wp, stress(l) >= 0.0_wp)
            limit = tension*max(a(l, 1), h(l, fibre_width)*b(l, 1)) &
               & + (1.0_wp - tension)*max(a(l, 2), h(l, fibre_width)*b(l, 2))
            square(l) = limit*stress(l)**2
            most = max(most, ply%own(l)*square(l))
            bonds = max(bonds, abs(h(l, fibre_onset)))
         end do
      end associate
      fibres%after(:) = fibres%before
      fibres%lost(:) = 0.0_wp
      fibres%grows = .false.
      if (.not. (most >= 1.0_wp .or. bonds > 0.0_wp)) return
      if (most >= 1.0_wp) call begin_damage(ply, elastic(:, 1), stress, square, h)
      call soften(ply, elastic(:, 1), h)
      fibres%after(:) = 1.0_wp - h(:, fibre_damage)
      fibres%grows = any(fibres%after < fibres%before)
      fibres%lost(:) = (1.0_wp - fibres%after)*ply%compliance/(fibres%after &
         & + (1.0_wp - fibres%after)*ply%compliance*ply%stiffness(:, 1))
   end subroutine damage_fibres

   !> Let damage of fibres begin where their stress has met the strength
   pure subroutine begin_damage(ply, strain, stress, square, h)
      !> Constants
      type(fracture_batch_type), intent(in) :: ply
      !> Strain along the fibres, stress of an intact ply, square of it over that of onset
      real(wp), intent(in) :: strain(lanes), stress(lanes), square(lanes)
      !> History of the point
      real(wp), intent(inout) :: h(lanes, histories)

      real(wp) :: onset, strength
      integer :: l, sense

      do l = 1, lanes
         if (abs(h(l, fibre_onset)) > 0.0_wp .or. ply%own(l)*square(l) < 1.0_wp) cycle
         sense = merge(1, 2, stress(l) >= 0.0_wp)
         ! on the way to the stress of now the strength was met at this strain
         strength = abs(stress(l))/sqrt(square(l))
         onset = abs(strain(l))/sqrt(square(l))
         h(l, fibre_onset) = sign(onset, stress(l))
         h(l, fibre_finish) = max(2.0_wp*ply%fibre_toughness(l, sense)/(h(l, fibre_width) &
            & *strength), snap_ratio*onset)
      end do
   end subroutine begin_damage

   !> Let the damage of fibres grow with the strain along them; it never heals
   pure subroutine soften(ply, strain, h)
      !> Constants
      type(fracture_batch_type), intent(in) :: ply
      !> Strain along the fibres
      real(wp), intent(in) :: strain(lanes)
      !> History of the point
      real(wp), intent(inout) :: h(lanes, histories)

      real(wp) :: crushed, damage, fall, now, onset, rest, was
      integer :: l

      !$omp simd private(crushed, damage, fall, now, onset, rest, was)
      do l = 1, lanes
         was = h(l, fibre_damage)
         onset = abs(h(l, fibre_onset))
         crushed = merge(1.0_wp, 0.0_wp, began_in_compression(h(l, fibre_onset)))
         fall = max(h(l, fibre_finish) - onset, small)
         now = max(abs(strain(l)), onset, small)
         rest = max((h(l, fibre_finish) - now)/fall, crushed*ply%plateau(l))
         damage = min(1.0_wp - onset*rest/now, ply%most_damage(l))
         damage = damage*merge(1.0_wp, 0.0_wp, onset > 0.0_wp)
         h(l, fibre_damage) = max(damage, was)
      end do
   end subroutine soften

   !> Stress of a ply whose fibres have an integrity: it multiplies E1 of the compliance, G12 and
   !> G13, and leaves the Poisson terms
   pure subroutine uncracked_stress(ply, strain, fibres, stress)
      !> Constants
      type(fracture_batch_type), intent(in) :: ply
      !> Elastic strain without that of cracks
      real(wp), intent(in) :: strain(lanes, 6)
      !> What is left of the fibres
      type(fibres_type), intent(in) :: fibres
      !> Stress
      real(wp), intent(out) :: stress(lanes, 6)

      real(wp) :: along, lost
      integer :: l

      associate (c => ply%stiffness, g => ply%shear, e => strain)
         !$omp simd private(along, lost)
         do l = 1, lanes
            along = c(l, 1)*e(l, 1) + c(l, 2)*e(l, 2) + c(l, 3)*e(l, 3)
            lost = along*fibres%lost(l)
            stress(l, 1) = along - lost*c(l, 1)
            stress(l, 2) = c(l, 2)*e(l, 1) + c(l, 4)*e(l, 2) + c(l, 5)*e(l, 3) - lost*c(l, 2)
            stress(l, 3) = c(l, 3)*e(l, 1) + c(l, 5)*e(l, 2) + c(l, 6)*e(l, 3) - lost*c(l, 3)
            stress(l, 4) = fibres%after(l)*g(l, 1)*e(l, 4)
            stress(l, 5) = fibres%after(l)*g(l, 2)*e(l, 5)
            stress(l, 6) = g(l, 3)*e(l, 6)
         end do
      end associate
   end subroutine uncracked_stress

end module plydyn_law_ply_fracture_fibres
