!> Corrections by contact: displacement, velocity and work of plate and impactors (the paper's
!> eqs 16 and 17).
module plydyn_method_contact_correction
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_correction, only : correction_type
   use plydyn_domain_domain, only : domain_type, surface_type
   use plydyn_method_global_reduction, only : global_reduction_type
   use plydyn_method_implicit_column_inertia, only : add_column_correction
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: correct_impactor, correct_plate

contains

   !> Add the correction to the plate; the impulse does its work at the mean of the velocities
   !> before and after it, of which the first is the velocity at the full step. Points that share
   !> their inertia with the corrected points follow
   pure subroutine correct_plate(domain, surface, inverse_mass, correction, state, reduction)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The face
      type(surface_type), intent(in) :: surface
      !> Inverse mass of its points, zero in directions that do not give way now, (3, points)
      real(wp), intent(in) :: inverse_mass(:, :)
      !> Displacements that contact adds
      type(correction_type), intent(in) :: correction
      !> Velocity and displacement of the plate
      type(state_type), intent(inout) :: state
      !> Gets work and power
      type(global_reduction_type), intent(inout) :: reduction

      real(wp) :: jump, mass, move, power, work
      integer :: c, i, k

      do i = 1, correction%count
         k = correction%point(i)
         if (surface%freedom(1, k) == 0) cycle
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
               work = work + mass*jump*(v - 0.5_wp*state%step*a + 0.5_wp*jump)
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
      end do
   end subroutine correct_plate

   !> Add the correction to the impactor
   pure subroutine correct_impactor(mass, correction, state, i)
      !> Mass of the impactor, and the displacement that contact adds
      real(wp), intent(in) :: mass, correction(3)
      !> Impactors and energies
      type(state_type), intent(inout) :: state
      !> Which impactor
      integer, intent(in) :: i

      real(wp) :: jump(3)

      associate (own => state%impactors(i))
         jump(:) = correction/state%step
         state%energies%contact = state%energies%contact &
            & - mass*dot_product(jump, own%velocity + 0.5_wp*jump)
         own%velocity(:) = own%velocity + jump
         own%centre(:) = own%centre + correction
         own%displacement(:) = own%displacement + correction
      end associate
   end subroutine correct_impactor

end module plydyn_method_contact_correction
