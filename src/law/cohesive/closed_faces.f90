!> What closed faces of an interface lose: the penalty that falls with the damage, and Coulomb
!> friction of the failed share of the face after Alfano and Sacco (2006).
!>
!> The failed share has one slip; what has just failed joins it free of friction, so that both
!> energies only grow and their sum is the work that is lost.
module plydyn_law_cohesive_closed_faces
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_cohesive_softening, only : damage_at, friction_at, slip_at, stretch_at, &
      & with_friction
   implicit none
   private

   public :: add_friction, release_penalty

contains

   !> Energy that closed faces lose when their penalty falls
   pure subroutine release_penalty(stiffness, floor, before, damage, opening, closing)
      !> Traction per opening, and the least share of it that closed faces keep
      real(wp), intent(in) :: stiffness, floor
      !> Damage before and after this step
      real(wp), intent(in) :: before(lanes), damage(lanes)
      !> Opening
      real(wp), intent(in) :: opening(lanes, 3)
      !> Energy lost so
      real(wp), intent(inout) :: closing(lanes)

      real(wp) :: lost
      integer :: l

      !$omp simd private(lost)
      do l = 1, lanes
         lost = max(1.0_wp - before(l), floor) &
            & - max(1.0_wp - damage(l), floor)
         closing(l) = closing(l) &
            & + 0.5_wp*stiffness*lost*min(opening(l, 3), 0.0_wp)**2
      end do
   end subroutine release_penalty

   !> Add the friction of the failed share of the face. Sliding first stretches it; it slips where
   !> that would take more than Coulomb's traction. The energy is the mean traction times the slip
   pure subroutine add_friction(coefficient, stiffness, before, opening, history, traction)
      !> Coefficient of friction, and stiffness of failed faces before they slide
      real(wp), intent(in) :: coefficient, stiffness
      !> Damage before this step
      real(wp), intent(in) :: before(lanes)
      !> Opening
      real(wp), intent(in) :: opening(lanes, 3)
      !> Damage, slip, stretch and energy
      real(wp), intent(inout) :: history(lanes, with_friction)
      !> Traction, without friction in
      real(wp), intent(inout) :: traction(lanes, 3)

      real(wp) :: carried, damage, full, part, share, x, y
      integer :: l

      !$omp simd private(carried, damage, full, part, share, x, y)
      do l = 1, lanes
         damage = history(l, damage_at)
         ! the share of the failed face that had failed before
         share = before(l)/max(damage, tiny(1.0_wp))
         x = opening(l, 1) - history(l, slip_at)
         y = opening(l, 2) - history(l, slip_at + 1)
         full = sqrt(x*x + y*y)
         carried = min(share*full, coefficient*max(-traction(l, 3), 0.0_wp) &
            & /stiffness)
         part = carried/max(full, tiny(1.0_wp))
         traction(l, 1) = traction(l, 1) + damage*stiffness*part*x
         traction(l, 2) = traction(l, 2) + damage*stiffness*part*y
         history(l, slip_at) = opening(l, 1) - part*x
         history(l, slip_at + 1) = opening(l, 2) - part*y
         history(l, friction_at) = history(l, friction_at) + 0.5_wp*damage*stiffness &
            & *((share*full - carried)*(carried + history(l, stretch_at)) &
            & + (1.0_wp - share)*full*carried)
         history(l, stretch_at) = carried
      end do
   end subroutine add_friction

end module plydyn_law_cohesive_closed_faces
