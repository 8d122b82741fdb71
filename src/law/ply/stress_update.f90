!> What a step does to a point of a ply that is damaged: its stress, and the energy it costs.
module plydyn_law_ply_stress_update
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_history, only : fibre_energy, matrix_energy, shear_spared
   use plydyn_law_ply_secant, only : secant_type
   implicit none
   private

   public :: add_damaged, add_energies

   !> Damage that grows by more than so many times the growth of the strain over the strain falls at
   !> the strain of the step: it drops
   real(wp), parameter :: steep = 100.0_wp

   !> What happens to a point in a step
   type, public :: ply_step_type
      !> Work per volume of a ply without damage on the shear that stays
      real(wp) :: work(lanes)
      !> Stresses along and across the fibres of which the signs count; only where cracks close
      real(wp) :: sense(lanes, 2)
      !> What remained and what remains: R1 and R2 for normal stress, R1 and R2 for shear
      real(wp) :: before(lanes, 4), after(lanes, 4)
      !> How far beyond onset the modes are that have not begun: 0 or more where one begins
      real(wp) :: excess(lanes, 2)
      !> Mean of the driving forces over their values at the end, for fibres and for matrix
      real(wp) :: share(lanes, 2)
      !> Whether the shear that stays, or any damage, grows
      logical :: grows
   end type ply_step_type

contains

   !> Stress of damaged lanes, from the normal stresses on what remains
   pure subroutine add_damaged(firm, weak, e, shear, now, s)
      !> G13 and G23: what damage leaves alone of them, and what it weakens
      real(wp), intent(in) :: firm(lanes, 2), weak(lanes, 2)
      !> Strain, size of the shear stress 12 before damage
      real(wp), intent(in) :: e(lanes, 6), shear(lanes)
      !> What remains
      type(ply_step_type), intent(in) :: now
      !> Normal stresses on what remains in, stress out
      real(wp), intent(inout) :: s(lanes, 6)

      integer :: l

      associate (r => now%after)
         !$omp simd
         do l = 1, lanes
            s(l, 1) = r(l, 1)*s(l, 1)
            s(l, 2) = r(l, 2)*s(l, 2)
            s(l, 4) = r(l, 3)*r(l, 4)*sign(shear(l), e(l, 4))
            s(l, 5) = (firm(l, 1) + r(l, 3)*weak(l, 1))*e(l, 5)
            s(l, 6) = (firm(l, 2) + r(l, 4)*weak(l, 2))*e(l, 6)
         end do
      end associate
   end subroutine add_damaged

   !> Energy that the loss of stiffness sets free at the strain of the step, and what it spares of
   !> plastic work. What a drop of the stiffness sets free at a strain is half the change of the
   !> compliance times the stress before and that after; where stress follows a line, as Poisson's
   !> effect lets it in uniaxial stress, both are the stress after
   pure subroutine add_energies(secant, weak, e, elastic, now, s, h)
      !> Stiffness; what damage weakens of G13 and G23
      type(secant_type), intent(in) :: secant
      real(wp), intent(in) :: weak(lanes, 2)
      !> Strain, size of the elastic shear strain
      real(wp), intent(in) :: e(lanes, 6), elastic(lanes)
      !> What remained and remains
      type(ply_step_type), intent(in) :: now
      !> Normal stresses 11 and 22 on what remains after the step
      real(wp), intent(in) :: s(lanes, 2)
      !> History, of which the energies grow
      real(wp), intent(inout) :: h(lanes, *)

      real(wp) :: along, across, first(lanes, 3), loss(4), mean(2), plane
      integer :: l

      call secant%damaged_stress(e, now%before, first)
      associate (compliance => secant%compliance, g => secant%shear, before => now%before, &
         & after => now%after, share => now%share)
         !$omp simd private(across, along, loss, mean, plane)
         do l = 1, lanes
            loss(:) = before(l, :) - after(l, :)
            mean(:) = 0.5_wp*(before(l, 3:4) + after(l, 3:4))
            plane = g(l, 1)*elastic(l)**2
            along = merge(first(l, 1), s(l, 1), loss(1) > steep*(1.0_wp - share(l, 1)))
            across = merge(first(l, 2), s(l, 2), loss(2) > steep*(1.0_wp - share(l, 2)))
            h(l, fibre_energy) = h(l, fibre_energy) + 0.5_wp*share(l, 1)*( &
               & loss(1)*compliance(l, 1)*along*s(l, 1) &
               & + loss(3)*(mean(2)*plane + weak(l, 1)*e(l, 5)**2))
            h(l, matrix_energy) = h(l, matrix_energy) + 0.5_wp*share(l, 2)*( &
               & loss(2)*compliance(l, 2)*across*s(l, 2) &
               & + loss(4)*(mean(1)*plane + weak(l, 2)*e(l, 6)**2))
            h(l, shear_spared) = h(l, shear_spared) &
               & + now%work(l)*(1.0_wp - after(l, 3)*after(l, 4))
         end do
      end associate
   end subroutine add_energies

end module plydyn_law_ply_stress_update
