!> Motion of the impactors over a step, and corrections by contact: displacement, velocity and work
!> of plate and impactors (the paper's eqs 15 to 17).
module plydyn_method_contact_correction
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : correction_type
   use plydyn_contact_solve_sliding, only : step_motion_type
   use plydyn_domain_domain, only : domain_type, prescribed_type, surface_type
   use plydyn_method_energy, only : global_reduction_type
   use plydyn_method_implicit_column_inertia, only : add_column_correction
   use plydyn_method_time_step, only : coefficients_of_step, leapfrog_coefficients_type
   use plydyn_method_supports, only : prescribed_velocity
   use plydyn_model_impactor, only : impactor_type
   use plydyn_state_state, only : energies_type, impactor_state_type, state_type
   implicit none
   private

   public :: correct_impactor, correct_plate, move_impactor, update_impactors

contains

   !> Trial motion of an impactor: under its weight, and as prescribed
   pure subroutine move_impactor(domain, i, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Which impactor
      integer, intent(in) :: i
      !> Impactors and energies
      type(state_type), intent(inout) :: state

      type(prescribed_type) :: motion
      real(wp) :: velocity_change, work
      integer :: c

      associate (own => state%impactors(i), impactor => domain%contact%impactors(i))
         do c = 1, 3
            if (impactor%motion(c) > 0) then
               motion%curve = impactor%motion(c)
               motion%quantity = impactor%quantity
               velocity_change = prescribed_velocity(domain, motion, state, own%displacement(c), &
                  & own%velocity(c)) - own%velocity(c)
            else if (abs(impactor%gravity(c)) > 0.0_wp) then
               velocity_change = 0.5_wp*(state%step_before + state%step)*impactor%gravity(c)
            else
               cycle
            end if
            work = impactor%mass*velocity_change*(own%velocity(c) + 0.5_wp*velocity_change)
            state%energies%external = state%energies%external + work
            if (impactor%motion(c) > 0) own%work = own%work + work
            own%velocity(c) = own%velocity(c) + velocity_change
         end do
         own%centre(:) = own%centre + state%step*own%velocity
         own%displacement(:) = own%displacement + state%step*own%velocity
         own%force(:) = 0.0_wp
         own%contacts = 0
         own%penetration = 0.0_wp
      end associate
   end subroutine move_impactor

   !> Add the correction to the plate; the impulse does its work at the mean of the velocities
   !> before the step and after the impulse. Points that share their inertia with the corrected
   !> points follow
   pure subroutine correct_plate(domain, surface, inverse_mass, correction, impactor, state, &
      & reduction, motion)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The face
      type(surface_type), intent(in) :: surface
      !> Inverse mass of its points, zero in directions that do not give way now, (3, points)
      real(wp), intent(in) :: inverse_mass(:, :)
      !> Displacements that contact adds
      type(correction_type), intent(in) :: correction
      !> Index of the impactor
      integer, intent(in) :: impactor
      !> Velocity and displacement of the plate
      type(state_type), intent(inout) :: state
      !> Gets work and power
      type(global_reduction_type), intent(inout) :: reduction
      !> Has the multipliers of rows that slide; not without friction
      type(step_motion_type), optional, intent(in) :: motion

      type(leapfrog_coefficients_type) :: coefficients
      real(wp) :: damping, jump, mass, mean, move, power, work
      integer :: c, i, k

      coefficients = coefficients_of_step(domain%control%damping, state)
      do i = 1, correction%count
         k = correction%point(i)
         if (surface%freedom(1, k) == 0) cycle
         if (present(motion) .and. surface%own(k)) then
            call reduction%bodies%add(impactor, friction_work(surface%freedom(:, k), &
               & motion%point_force(:, k), correction%displacement(:, k), coefficients, state))
         end if
         damping = 0.0_wp
         power = 0.0_wp
         work = 0.0_wp
         do c = 1, 3
            move = correction%displacement(c, k)
            if (inverse_mass(c, k) <= 0.0_wp .or. abs(move) <= 0.0_wp) cycle
            associate (v => state%velocity(surface%freedom(c, k)), &
               & u => state%displacement(surface%freedom(c, k)), &
               & a => state%acceleration(surface%freedom(c, k)))
               mass = 1.0_wp/inverse_mass(c, k)
               jump = move/state%step
               mean = coefficients%mean_velocity(v, a)
               work = work + mass*jump*(mean + 0.5_wp*jump)
               damping = damping + coefficients%damping*mass*jump*mean
               power = power + mass*a*jump
               v = v + jump
               u = u + move
            end associate
            if (domain%inertia%thickness%active) then
               call add_column_correction(domain%inertia%thickness, domain%columns, surface, k, c, &
                  & move, state)
            end if
         end do
         if (.not. surface%own(k)) cycle
         call reduction%contact_work%add(work)
         call reduction%contact_power%add(power)
         call reduction%contact_damping%add(damping)
      end do
   end subroutine correct_plate

   !> Work taken by friction at a point of the plate
   pure real(wp) function friction_work(place, force, correction, coefficients, &
      & state)
      !> Places of the point in the arrays of motion
      integer, intent(in) :: place(3)
      !> Multiplier of the rows that slide, mass times length, and correction of the point, length
      real(wp), intent(in) :: force(3), correction(3)
      !> Of the step
      type(leapfrog_coefficients_type), intent(in) :: coefficients
      !> Velocity and acceleration before the correction
      type(state_type), intent(in) :: state

      friction_work = -dot_product(force/state%step, coefficients%mean_velocity( &
         & state%velocity(place), state%acceleration(place)) + 0.5_wp*correction/state%step)
   end function friction_work

   !> Add the correction to the impactor. Where its motion is prescribed it does the work of the
   !> force on it at the mean of its velocities before and after
   pure subroutine correct_impactor(impactor, velocity_before, force, correction, motion, own, &
      & step, energies)
      !> The impactor
      type(impactor_type), intent(in) :: impactor
      !> Its velocity over the step before, the force on it, and the displacement that contact adds
      real(wp), intent(in) :: velocity_before(3), force(3), correction(3)
      !> Rotation that friction adds, and multipliers of rows that slide; not without friction
      type(step_motion_type), optional, intent(in) :: motion
      !> Its state
      type(impactor_state_type), intent(inout) :: own
      !> Time step
      real(wp), intent(in) :: step
      !> Energies
      type(energies_type), intent(inout) :: energies

      real(wp) :: jump(3), middle(3), spin_jump(3), work

      jump(:) = correction/step
      middle(:) = own%velocity + 0.5_wp*jump
      where (impactor%motion > 0) middle = 0.5_wp*(velocity_before + own%velocity)
      energies%contact = energies%contact &
         & - impactor%mass*dot_product(jump, own%velocity + 0.5_wp*jump)
      if (any(impactor%motion > 0)) then
         work = -step*sum(force*middle, mask=impactor%motion > 0)
         own%work = own%work + work
         energies%external = energies%external + work
         energies%contact = energies%contact + work
      end if
      if (present(motion)) then
         spin_jump(:) = motion%rotation_correction/step
         energies%contact = energies%contact &
            & - impactor%inertia*dot_product(spin_jump, own%spin + 0.5_wp*spin_jump)
         work = -(dot_product(motion%force, middle) &
            & + dot_product(motion%moment, own%spin + 0.5_wp*spin_jump))/step
         call count_friction(work, own, energies)
         own%spin(:) = own%spin + spin_jump
      end if
      own%velocity(:) = own%velocity + jump
      own%centre(:) = own%centre + correction
      own%displacement(:) = own%displacement + correction
   end subroutine correct_impactor

   !> Friction on the plate in the step under way, summed over all ranks
   pure subroutine update_impactors(reduction, state)
      !> Sums of the step over all ranks
      type(global_reduction_type), intent(in) :: reduction
      !> Impactors and energies
      type(state_type), intent(inout) :: state
      integer :: i

      do i = 1, size(state%impactors)
         call count_friction(reduction%bodies%value(i), state%impactors(i), state%energies)
      end do
   end subroutine update_impactors

   !> What friction takes is not lost where bodies meet
   pure subroutine count_friction(work, own, energies)
      !> Work taken
      real(wp), intent(in) :: work
      !> The impactor
      type(impactor_state_type), intent(inout) :: own
      !> Energies
      type(energies_type), intent(inout) :: energies

      own%friction = own%friction + work
      energies%friction = energies%friction + work
      energies%contact = energies%contact - work
   end subroutine count_friction

end module plydyn_method_contact_correction
