!> The energy balance, closed in every step.
!>
!> Inner forces and loads do the work 1/2 (f_n + f_n+1) . (u_n+1 - u_n) over a step, which is what
!> central differences conserve. The kinetic energy is that of the velocity at the full step,
!> v_n = v_n-1/2 + 1/2 dt a_n, which is never negative. It differs from the conserved form by the
!> ripple, 1/8 dt^2 a M a: the balance takes it out, and the guard of stability watches it. Where
!> the step changes, as it does at the start, the ripple does too.
module plydyn_method_energy
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_forces, only : count_load_power
   use plydyn_method_central_difference, only : new_leapfrog_coefficients, &
      & leapfrog_coefficients_type
   use plydyn_method_supports, only : count_support_power
   use plydyn_state_state, only : attention_sum, contact_power_sum, contact_sum, impactors_sum, &
      & halt_sum, output_sum, power_after_sum, power_before_sum, rows_sum, speed_sum, state_type, &
      & sums_of, support_sum
   implicit none
   private

   public :: balance, begin_work, change_step

contains

   !> A new step changes the form of energy that the scheme conserves. The power of all forces with
   !> the velocity over it, and the work of damping, follow from the sums at the full step before,
   !> whatever inertia is behind the accelerations
   pure subroutine change_step(domain, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The step to come, and the one just made
      type(state_type), intent(inout) :: state

      type(leapfrog_coefficients_type) :: stride

      stride = new_leapfrog_coefficients(domain%control%damping, state%step_before, state%step)
      associate (e => state%energies, sums => state%sums, before => state%step_before, &
         & keep => stride%keep, middle => stride%middle)
         e%shift = e%shift + 0.125_wp*sums%pull*(state%step**2 - before**2)
         state%internal_power = -keep*sums%power - middle*sums%pull
         ! the velocity before is the one at the full step less 1/2 dt a
         e%damping = e%damping + 0.5_wp*stride%brake*((1.0_wp + keep)**2*(sums%twice_kinetic &
            & + sums%twice_added - before*(sums%power + 0.25_wp*before*sums%pull)) &
            & + middle*(2.0_wp*(1.0_wp + keep)*sums%power + middle*sums%pull))
      end associate
   end subroutine change_step

   !> Power at the beginning of a step, with the velocity over it; once supports and contact are in
   subroutine begin_work(domain, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Powers
      type(state_type), intent(inout) :: state

      call count_power(domain, state, power_before_sum)
   end subroutine begin_work

   !> Add the power of loads and supports to a sum
   subroutine count_power(domain, state, sum)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(inout) :: state
      integer, intent(in) :: sum

      call count_load_power(domain, state%load_factor, state%velocity, state%tally, sum)
      call count_support_power(domain, state%support_force, state%velocity, state%tally, sum)
   end subroutine count_power

   !> Energies at the end of a step, from the accelerations there and what all ranks have counted
   subroutine balance(domain, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Energies
      type(state_type), intent(inout) :: state

      real(wp) :: inside, outside, outside_before, step
      integer :: i

      call count_power(domain, state, power_after_sum)
      call domain%comm%sum(state%tally%limb)
      state%sums = sums_of(state%tally)
      state%output_due = state%tally%value(output_sum) > 0.0_wp
      state%rows_due = state%tally%value(rows_sum) > 0.0_wp
      state%impactors_due = state%tally%value(impactors_sum) > 0.0_wp
      state%attention = state%tally%value(attention_sum) > 0.0_wp
      state%halts = state%attention .or. state%tally%value(halt_sum) > 0.0_wp
      state%fastest = state%tally%value(speed_sum)
      step = state%step_before
      associate (e => state%energies, sums => state%sums, tally => state%tally)
         outside_before = tally%value(power_before_sum)
         outside = tally%value(power_after_sum)
         inside = state%internal_power + outside_before - tally%value(contact_power_sum)
         e%kinetic = 0.5_wp*sums%twice_kinetic
         e%added = 0.5_wp*sums%twice_added
         e%ripple = 0.125_wp*step**2*sums%pull
         e%internal = e%internal + 0.5_wp*step*(inside + outside - sums%power)
         e%external = e%external + 0.5_wp*step*(outside_before + outside) &
            & + tally%value(support_sum)
         e%contact = e%contact - tally%value(contact_sum)
         e%momentum(:) = sums%momentum
         e%impactor = 0.0_wp
         do i = 1, size(state%impactors)
            associate (impactor => domain%contact%impactors(i), v => state%impactors(i)%velocity)
               e%impactor = e%impactor + 0.5_wp*impactor%mass*dot_product(v, v)
               e%momentum(:) = e%momentum + impactor%mass*v
            end associate
         end do
         e%reference = max(e%reference, e%start + abs(e%external))
         call tally%clear()
      end associate
   end subroutine balance

end module plydyn_method_energy
