!> Fibres that break or are crushed, and the stress of a ply without matrix cracks.
!>
!> Tension and compression have damage of their own: broken fibres that are pressed carry what
!> compression has left of them, and tension and shear feel the larger of both.
module plydyn_law_ply_fracture_fibres
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_fibre_lines, only : first_line_end, stress_on_tail
   use plydyn_law_ply_fracture_constants, only : fracture_batch_type, snap_ratio
   use plydyn_law_ply_fracture_history, only : fibre_damage, fibre_finish, fibre_onset, &
      & fibre_width, histories, last_stress, lost_integrity, to_compression
   implicit none
   private

   public :: damage_fibres, uncracked_stress

   !> What is left of the fibres in a step
   type, public :: fibres_type
      !> Integrity for normal stress before and after, and for shear
      real(wp), dimension(lanes) :: before = 1.0_wp, after = 1.0_wp, sheared_before = 1.0_wp, &
         & sheared = 1.0_wp
      !> Whether any changes in any lane
      logical :: changes = .false.
      !> What broken fibres take off the stiffness: C11, C12, C13 times this times C11, C12, C13
      real(wp) :: lost(lanes) = 0.0_wp
   end type fibres_type

   !> Keeps divisors off zero in lanes without anything
   real(wp), parameter :: small = 1.0e-30_wp

contains

   !> Integrity of the fibres before and after a step. Damage begins by the stress of an intact ply,
   !> and the stress then falls with the strain along the fibres, to zero or to the plateau
   pure subroutine damage_fibres(ply, elastic, h, fibres)
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
            stress(l) = c(l, 1)*elastic(l, 1) + c(l, 2)*elastic(l, 2) + c(l, 3)*elastic(l, 3)
            tension = merge(1.0_wp, 0.0_wp, stress(l) >= 0.0_wp)
            limit = tension*max(a(l, 1), h(l, fibre_width)*b(l, 1)) &
               & + (1.0_wp - tension)*max(a(l, 2), h(l, fibre_width)*b(l, 2))
            square(l) = limit*stress(l)**2
            most = max(most, ply%own(l)*square(l))
            bonds = max(bonds, h(l, fibre_onset), h(l, fibre_onset + to_compression))
         end do
      end associate
      if (most >= 1.0_wp .or. bonds > 0.0_wp) then
         call weaken(ply, elastic(:, 1), stress, square, h, fibres)
      end if
   end subroutine damage_fibres

   !> Integrity where damage begins or has begun
   pure subroutine weaken(ply, strain, stress, square, h, fibres)
      type(fracture_batch_type), intent(in) :: ply
      !> Strain along the fibres, stress of an intact ply, square of it over that of onset
      real(wp), intent(in) :: strain(lanes), stress(lanes), square(lanes)
      !> History of the point
      real(wp), intent(inout) :: h(lanes, histories)
      !> What is left of them
      type(fibres_type), intent(inout) :: fibres

      real(wp) :: pressed(lanes)

      ! the sign of the stress, with the other stresses of the step before
      pressed(:) = merge(1.0_wp, 0.0_wp, strain + ply%compliance*(ply%poisson(:, 1) &
         & *h(:, last_stress + 1) + ply%poisson(:, 2)*h(:, last_stress + 2)) < 0.0_wp)
      fibres%before(:) = 1.0_wp - h(:, lost_integrity)
      fibres%sheared_before(:) = 1.0_wp - max(h(:, fibre_damage), h(:, fibre_damage &
         & + to_compression))
      call begin_damage(ply, strain, stress, square, h)
      call soften(ply, 1, (1.0_wp - pressed)*abs(strain), h(:, fibre_damage:fibre_finish))
      call soften(ply, 2, pressed*abs(strain), &
         & h(:, fibre_damage + to_compression:fibre_finish + to_compression))
      associate (open => h(:, fibre_damage), closed => h(:, fibre_damage + to_compression))
         fibres%sheared(:) = 1.0_wp - max(open, closed)
         fibres%after(:) = pressed*(1.0_wp - closed) + (1.0_wp - pressed)*fibres%sheared
      end associate
      h(:, lost_integrity) = 1.0_wp - fibres%after
      fibres%changes = any(abs(fibres%after - fibres%before) > 0.0_wp &
         & .or. fibres%sheared < fibres%sheared_before)
      fibres%lost(:) = (1.0_wp - fibres%after)*ply%compliance/(fibres%after &
         & + (1.0_wp - fibres%after)*ply%compliance*ply%stiffness(:, 1))
   end subroutine weaken

   !> Let damage of fibres begin where their stress has met the strength
   pure subroutine begin_damage(ply, strain, stress, square, h)
      !> As in `weaken`
      type(fracture_batch_type), intent(in) :: ply
      real(wp), intent(in) :: strain(lanes), stress(lanes), square(lanes)
      !> History of the point
      real(wp), intent(inout) :: h(lanes, histories)

      real(wp) :: onset, strength
      integer :: first, l, sense

      do l = 1, lanes
         sense = merge(1, 2, stress(l) >= 0.0_wp)
         first = merge(fibre_onset, fibre_onset + to_compression, sense == 1)
         if (h(l, first) > 0.0_wp .or. ply%own(l)*square(l) < 1.0_wp) cycle
         ! on the way to the stress of now the strength was met at this strain
         strength = abs(stress(l))/sqrt(square(l))
         onset = max(abs(strain(l))/sqrt(square(l)), small)
         h(l, first) = onset
         h(l, first + 1) = max(ply%lines%reach(l, sense)*2.0_wp*ply%fibre_toughness(l, sense) &
            & /(h(l, fibre_width)*strength), snap_ratio*onset)
      end do
   end subroutine begin_damage

   !> Let the damage of fibres of one sense grow with the strain along them; it never heals
   pure subroutine soften(ply, sense, strain, mode)
      type(fracture_batch_type), intent(in) :: ply
      !> Tension or compression
      integer, intent(in) :: sense
      !> Size of the strain along the fibres; 0 where it has the other sense
      real(wp), intent(in) :: strain(lanes)
      !> Damage, strains at onset and at the end
      real(wp), intent(inout) :: mode(lanes, 3)

      real(wp) :: damage, end_of_first, fall, now, onset, rest
      integer :: l

      associate (tail => ply%lines%tail(:, sense), reach => ply%lines%reach(:, sense))
         !$omp simd private(damage, end_of_first, fall, now, onset, rest)
         do l = 1, lanes
            onset = mode(l, 2)
            end_of_first = first_line_end(onset, mode(l, 3), tail(l), reach(l))
            fall = max(end_of_first - onset, small)
            now = max(strain(l), onset, small)
            rest = max((end_of_first - now)/fall, stress_on_tail(onset, mode(l, 3), tail(l), now), &
               & merge(ply%plateau(l), 0.0_wp, sense == 2))
            damage = min(1.0_wp - onset*rest/now, ply%most_damage(l))
            damage = damage*merge(1.0_wp, 0.0_wp, onset > 0.0_wp)
            mode(l, 1) = max(damage, mode(l, 1))
         end do
      end associate
   end subroutine soften

   !> Stress of a ply whose fibres have an integrity: it multiplies E1 of the compliance, G12 and
   !> G13, and leaves the Poisson terms
   pure subroutine uncracked_stress(ply, strain, fibres, stress)
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
            stress(l, 4) = fibres%sheared(l)*g(l, 1)*e(l, 4)
            stress(l, 5) = fibres%sheared(l)*g(l, 2)*e(l, 5)
            stress(l, 6) = g(l, 3)*e(l, 6)
         end do
      end associate
   end subroutine uncracked_stress

end module plydyn_law_ply_fracture_fibres
