!> Stress of a damaged ply, and the energy that a step dissipates.
module plydyn_law_ply_stress_update
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_batch_constants, only : ply_batch_constants_type
   use plydyn_law_ply_history, only : fibre_energy, matrix_energy, spared_work
   implicit none
   private

   public :: add_energies, degrade_stress

   !> Ratio of damage increment to relative strain increment above which softening is treated as a
   !> sudden drop
   real(wp), parameter :: sudden = 100.0_wp

   !> Change of a point in a step
   type, public :: ply_step_type
      !> Plastic work per volume of an intact ply
      real(wp) :: work(lanes)
      !> Stresses along and across the fibres whose signs count; only where cracks close
      real(wp) :: sense(lanes, 2)
      !> Integrity before and after: R1 and R2 for normal stress, R1 and R2 for shear
      real(wp) :: before(lanes, 4), after(lanes, 4)
      !> Excess over onset of the modes that have not begun: 0 or more where one begins
      real(wp) :: excess(lanes, 2)
      !> Mean of the driving forces over their values at the end, for fibres and for matrix
      real(wp) :: share(lanes, 2)
      !> Whether the permanent shear strain or any damage grows
      logical :: grows
   end type ply_step_type

contains

   !> Stress of a ply, from its effective normal stresses
   pure subroutine degrade_stress(ply, e, shear, normal, sheared, s)
      !> Constants
      type(ply_batch_constants_type), intent(in) :: ply
      !> Strain, size of the shear stress 12 before damage
      real(wp), intent(in) :: e(lanes, 6), shear(lanes)
      !> R1 and R2 for normal stress, and for shear
      real(wp), intent(in) :: normal(lanes, 2), sheared(lanes, 2)
      !> Effective normal stresses in, stress out
      real(wp), intent(inout) :: s(lanes, 6)

      real(wp) :: r1, r2
      integer :: l

      associate (intact => ply%g_intact, degraded => ply%g_degraded)
         !$omp simd private(r1, r2)
         do l = 1, lanes
            r1 = sheared(l, 1)
            r2 = sheared(l, 2)
            s(l, 1) = normal(l, 1)*s(l, 1)
            s(l, 2) = normal(l, 2)*s(l, 2)
            s(l, 4) = r1*r2*sign(shear(l), e(l, 4))
            s(l, 5) = (intact(l, 1) + r1*degraded(l, 1))*e(l, 5)
            s(l, 6) = (intact(l, 2) + r2*degraded(l, 2))*e(l, 6)
         end do
      end associate
   end subroutine degrade_stress

   !> Add the energy that the loss of stiffness releases at the strain of the step, and the plastic
   !> work that it spares. A sudden drop releases half the change of the compliance times the stress
   !> before and the stress after. Where the stress follows a line, as Poisson's effect lets it in
   !> uniaxial stress, both are the stress after
   pure subroutine add_energies(ply, e, elastic, now, s, h)
      !> Constants
      type(ply_batch_constants_type), intent(in) :: ply
      !> Strain, size of the elastic shear strain
      real(wp), intent(in) :: e(lanes, 6), elastic(lanes)
      !> Integrity before and after the step
      type(ply_step_type), intent(in) :: now
      !> Effective normal stresses 11 and 22 after the step
      real(wp), intent(in) :: s(lanes, 2)
      !> History, of which the energies grow
      real(wp), intent(inout) :: h(lanes, *)

      real(wp) :: along, across, first(lanes, 3), loss(4), mean(2), plane
      integer :: l

      call ply%secant%damaged_stress(e, now%before, first)
      associate (compliance => ply%secant%compliance, g => ply%secant%shear, &
         & degraded => ply%g_degraded, before => now%before, after => now%after, &
         & share => now%share)
         !$omp simd private(across, along, loss, mean, plane)
         do l = 1, lanes
            loss(:) = before(l, :) - after(l, :)
            mean(:) = 0.5_wp*(before(l, 3:4) + after(l, 3:4))
            plane = g(l, 1)*elastic(l)**2
            along = merge(first(l, 1), s(l, 1), loss(1) > sudden*(1.0_wp - share(l, 1)))
            across = merge(first(l, 2), s(l, 2), loss(2) > sudden*(1.0_wp - share(l, 2)))
            h(l, fibre_energy) = h(l, fibre_energy) + 0.5_wp*share(l, 1)*( &
               & loss(1)*compliance(l, 1)*along*s(l, 1) &
               & + loss(3)*(mean(2)*plane + degraded(l, 1)*e(l, 5)**2))
            h(l, matrix_energy) = h(l, matrix_energy) + 0.5_wp*share(l, 2)*( &
               & loss(2)*compliance(l, 2)*across*s(l, 2) &
               & + loss(4)*(mean(1)*plane + degraded(l, 2)*e(l, 6)**2))
            h(l, spared_work) = h(l, spared_work) &
               & + now%work(l)*(1.0_wp - after(l, 3)*after(l, 4))
         end do
      end associate
   end subroutine add_energies

end module plydyn_law_ply_stress_update
