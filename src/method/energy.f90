!> The energy balance, closed in every step.
!>
!> Internal forces and loads do the work 1/2 (f_n + f_n+1) . (u_n+1 - u_n) over a step, which the
!> scheme conserves. The kinetic energy is that of the velocity at the full step,
!> v_n = v_n-1/2 + 1/2 dt a_n, which is never negative. It exceeds the conserved form by the
!> half-step correction 1/8 dt^2 a M a: the balance subtracts it, and the stability monitor checks
!> it. Where the step changes, as it does at the start, the correction does too.
module plydyn_method_energy
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_global_reduction, only : global_reduction_type
   use plydyn_method_leapfrog_coefficients, only : leapfrog_coefficients_type, &
      & coefficients_of_step
   use plydyn_state_state, only : energies_type, motion_sums_type, state_type
   implicit none
   private

   public :: measure_energies, update_energies

contains

   !> Energies at the end of the step under way
   pure subroutine update_energies(domain, reduction, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Sums of the step over all ranks
      type(global_reduction_type), intent(in) :: reduction
      !> Energies; the clock is still that of the beginning of the step
      type(state_type), intent(inout) :: state

      type(leapfrog_coefficients_type) :: coefficients
      real(wp) :: inside, internal_power, outside, outside_before

      coefficients = coefficients_of_step(domain%control%damping, state)
      call change_step(coefficients, state%step_before, state%sums, state%energies, internal_power)
      call measure_energies(domain, reduction, state%step, state)
      outside_before = reduction%external_power_before%value()
      outside = reduction%external_power_after%value()
      inside = internal_power + outside_before - reduction%contact_power%value()
      state%relaxation%stiffening = outside - state%sums%power - inside
      associate (e => state%energies, step => state%step)
         e%internal = e%internal + 0.5_wp*step*(inside + outside - state%sums%power)
         e%external = e%external + 0.5_wp*step*(outside_before + outside) &
            & + reduction%prescribed_work%value()
         e%contact = e%contact - reduction%contact_work%value()
         e%damping = e%damping + reduction%contact_damping%value()
      end associate
      call state%energies%raise_reference()
   end subroutine update_energies

   !> A new step changes the form of energy that the scheme conserves. The power of all forces with
   !> the velocity over it, and the work of damping, follow from the sums at the full step before,
   !> whatever inertia is behind the accelerations
   pure subroutine change_step(coefficients, before, sums, energies, internal_power)
      !> Of the step
      type(leapfrog_coefficients_type), intent(in) :: coefficients
      !> The step before
      real(wp), intent(in) :: before
      !> Sums over all points at the beginning of the step
      type(motion_sums_type), intent(in) :: sums
      !> Energies
      type(energies_type), intent(inout) :: energies
      !> Power of the forces at the beginning of the step with the velocity over it, negative
      real(wp), intent(out) :: internal_power

      associate (e => energies, decay => coefficients%decay, mean_step => coefficients%mean_step)
         e%step_change = e%step_change + 0.125_wp*sums%acceleration_square &
            & *(coefficients%step**2 - before**2)
         internal_power = -decay*sums%power - mean_step*sums%acceleration_square
         ! the velocity before is the velocity at the full step less 1/2 dt a
         e%damping = e%damping + 0.5_wp*coefficients%damping*((1.0_wp + decay)**2 &
            & *(sums%twice_kinetic + sums%twice_added - before*(sums%power &
            & + 0.25_wp*before*sums%acceleration_square)) + mean_step*(2.0_wp*(1.0_wp + decay) &
            & *sums%power + mean_step*sums%acceleration_square))
      end associate
   end subroutine change_step

   !> Kinetic energies and momentum of the present motion
   pure subroutine measure_energies(domain, reduction, step, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Sums over all points of all ranks
      type(global_reduction_type), intent(in) :: reduction
      !> The step that ends with this motion
      real(wp), intent(in) :: step
      !> Sums and energies
      type(state_type), intent(inout) :: state

      integer :: i

      state%sums = reduction%motion_sums()
      associate (e => state%energies, sums => state%sums)
         e%kinetic = 0.5_wp*sums%twice_kinetic
         e%added = 0.5_wp*sums%twice_added
         e%half_step_correction = 0.125_wp*step**2*sums%acceleration_square
         e%momentum(:) = sums%momentum
         e%impactor = 0.0_wp
         do i = 1, size(state%impactors)
            associate (impactor => domain%contact%impactors(i), v => state%impactors(i)%velocity, &
               & spin => state%impactors(i)%spin)
               e%impactor = e%impactor + 0.5_wp*impactor%mass*dot_product(v, v)
               if (impactor%rotates) then
                  e%impactor = e%impactor + 0.5_wp*impactor%inertia*dot_product(spin, spin)
               end if
               e%momentum(:) = e%momentum + impactor%mass*v
            end associate
         end do
      end associate
   end subroutine measure_energies

end module plydyn_method_energy
