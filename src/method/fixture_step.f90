!> Contact of the plate with fixtures, step by step.
!>
!> A fixture moves as prescribed, so that every point of the plate in contact is a row of its own:
!> no equations are solved, and every rank corrects the points that it has.
module plydyn_method_fixture_step
   use plydyn_base_exact_sum, only : new_exact_sums
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_coulomb, only : contact_row_type, limit_friction, solve_row
   use plydyn_domain_domain, only : domain_type, placed_fixture_type, surface_type
   use plydyn_method_energy, only : global_reduction_type
   use plydyn_method_implicit_column_inertia, only : add_column_correction
   use plydyn_method_time_step, only : coefficients_of_step, leapfrog_coefficients_type
   use plydyn_method_supports, only : is_active
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: correct_fixtures, expect_bodies, place_new_fixtures, update_fixtures

   !> Sums of each fixture over its points: force along x, y, z, area, points, work of friction,
   !> normal force, and normal force times slip
   integer, parameter :: area_at = 4, points_at = 5, friction_at = 6, normal_at = 7, slip_at = 8
   integer, parameter :: sums = 8

   !> Motion of a fixture over a step
   type :: fixture_motion_type
      !> Displacement at its end, and its change over the step
      real(wp) :: displacement(3) = 0.0_wp, increment(3) = 0.0_wp
      !> Coefficients of the motion of the plate
      type(leapfrog_coefficients_type) :: coefficients
   end type fixture_motion_type

contains

   !> Make room for the sums of impactors and fixtures
   pure subroutine expect_bodies(domain, reduction)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Gets the room, once
      type(global_reduction_type), intent(inout) :: reduction

      logical :: has_friction

      if (allocated(reduction%bodies%limb)) return
      associate (bodies => domain%contact)
         has_friction = any(bodies%contacts%friction%static > 0.0_wp)
         if (size(bodies%fixtures) == 0 .and. .not. has_friction) return
         reduction%bodies = new_exact_sums(size(bodies%impactors) + sums*size(bodies%fixtures))
      end associate
   end subroutine expect_bodies

   !> Push the plate out of the fixtures, and press the clamps onto it, one fixture after the other
   subroutine correct_fixtures(domain, state, reduction)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Displacement and velocity of the plate, already predicted and in contact with impactors
      type(state_type), intent(inout) :: state
      !> Gets the work and the forces of the fixtures
      type(global_reduction_type), intent(inout) :: reduction

      type(leapfrog_coefficients_type) :: coefficients
      logical :: is_moved(0:size(domain%supports%motions))
      integer :: i

      coefficients = coefficients_of_step(domain%control%damping, state)
      is_moved(0) = .false.
      is_moved(1:) = is_active(domain%supports%motions, state%time)
      do i = 1, size(domain%contact%fixtures)
         associate (surface => domain%contact%fixture_faces(domain%contact%fixtures(i)%surface))
            if (domain%contact%fixtures(i)%is_clamp) then
               call press_clamp(domain, surface, i, is_moved, coefficients, state, reduction)
            else
               call meet_body(domain, surface, i, is_moved, coefficients, state, reduction)
            end if
         end associate
      end do
   end subroutine correct_fixtures

   !> Let fixtures that a restart adds stand before the plate as it is: their GAP is from the
   !> outermost point under them. All ranks must come here
   subroutine place_new_fixtures(domain, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The plate; fixtures without a height get one
      type(state_type), intent(inout) :: state

      real(wp) :: outermost(size(state%fixtures))
      integer :: i, j, k

      outermost(:) = -huge(1.0_wp)
      do i = 1, size(outermost)
         associate (fixture => domain%contact%fixtures(i), &
            & surface => domain%contact%fixture_faces(domain%contact%fixtures(i)%surface))
            do j = 1, size(fixture%below)
               k = fixture%below(j)
               outermost(i) = max(outermost(i), -fixture%body%upward*(surface%position(3, k) &
                  & + state%displacement(surface%freedom(3, k))))
            end do
         end associate
      end do
      call domain%comm%max(outermost)
      do i = 1, size(outermost)
         if (state%fixtures(i)%height < huge(1.0_wp)) cycle
         associate (fixture => domain%contact%fixtures(i))
            state%fixtures(i)%height = -fixture%body%upward*(outermost(i) + fixture%gap)
         end associate
      end do
   end subroutine place_new_fixtures

   !> Forces, paths and work of the fixtures over the step under way
   pure subroutine update_fixtures(reduction, state)
      !> Sums of the step over all ranks
      type(global_reduction_type), intent(in) :: reduction
      !> Fixtures
      type(state_type), intent(inout) :: state

      real(wp) :: found(sums)
      integer :: first, i, k

      do i = 1, size(state%fixtures)
         first = size(state%impactors) + sums*(i - 1)
         found(:) = [(reduction%bodies%value(first + k), k=1, sums)]
         associate (own => state%fixtures(i))
            own%force(:) = found(:3)
            own%impulse(:) = own%impulse + state%step*own%force
            own%area = found(area_at)
            own%contacts = nint(found(points_at))
            own%friction = own%friction + found(friction_at)
            if (found(normal_at) > 0.0_wp) own%slip = own%slip + found(slip_at)/found(normal_at)
            state%energies%friction = state%energies%friction + found(friction_at)
         end associate
      end do
   end subroutine update_fixtures

   !> Contact of the points that this rank has with a rigid body
   subroutine meet_body(domain, surface, i, is_moved, coefficients, state, reduction)
      type(domain_type), intent(in) :: domain
      type(surface_type), intent(in) :: surface
      !> Index of the fixture
      integer, intent(in) :: i
      !> Whether each prescribed motion acts now
      logical, intent(in) :: is_moved(0:)
      !> Of the motion of the plate
      type(leapfrog_coefficients_type), intent(in) :: coefficients
      type(state_type), intent(inout) :: state
      type(global_reduction_type), intent(inout) :: reduction

      real(wp) :: point(3)
      type(contact_row_type) :: row
      type(fixture_motion_type) :: motion
      integer :: j, k

      associate (fixture => domain%contact%fixtures(i))
         motion = motion_of(fixture, domain, state)
         motion%coefficients = coefficients
         do j = 1, size(surface%here)
            k = surface%here(j)
            ! its height alone tells of most points that they are clear
            point(3) = surface%position(3, k) + state%displacement(surface%freedom(3, k)) &
               & - motion%displacement(3) - state%fixtures(i)%height
            if (fixture%body%upward*point(3) >= 0.0_wp) cycle
            point(:2) = surface%position(:2, k) + state%displacement(surface%freedom(:2, k)) &
               & - motion%displacement(:2)
            call fixture%body%find_gap(point, row%gap, row%normal)
            if (row%gap >= 0.0_wp) cycle
            row%inverse_mass(:) = merge(0.0_wp, surface%inverse_mass(:, k), &
               & is_moved(surface%motion(:, k)))
            row%motion(:) = state%step*state%velocity(surface%freedom(:, k)) - motion%increment
            call solve_row(row, fixture%friction, state%step)
            call push_point(domain, surface, k, i, row, motion, state, reduction)
         end do
      end associate
   end subroutine meet_body

   !> Force of a clamp on the points that this rank has: the pressure of its force and of its
   !> spring at the beginning of the step
   subroutine press_clamp(domain, surface, i, is_moved, coefficients, state, reduction)
      type(domain_type), intent(in) :: domain
      type(surface_type), intent(in) :: surface
      !> As in `meet_body`
      integer, intent(in) :: i
      logical, intent(in) :: is_moved(0:)
      type(leapfrog_coefficients_type), intent(in) :: coefficients
      type(state_type), intent(inout) :: state
      type(global_reduction_type), intent(inout) :: reduction

      real(wp) :: force, raised
      type(contact_row_type) :: row
      type(fixture_motion_type) :: at_rest
      integer :: j, k

      at_rest%coefficients = coefficients
      associate (fixture => domain%contact%fixtures(i))
         force = fixture%force*domain%curves(fixture%curve)%at(state%time)
         row%normal(:) = [0.0_wp, 0.0_wp, real(fixture%body%upward, wp)]
         do j = 1, size(fixture%below)
            k = fixture%below(j)
            row%motion(:) = state%step*state%velocity(surface%freedom(:, k))
            raised = state%displacement(surface%freedom(3, k)) - row%motion(3)
            row%inverse_mass(:) = merge(0.0_wp, surface%inverse_mass(:, k), &
               & is_moved(surface%motion(:, k)))
            if (row%inverse_mass(3) <= 0.0_wp) cycle
            call limit_friction(row, state%step**2*surface%area(k)/fixture%area &
               & *max(0.0_wp, force - fixture%body%upward*raised*fixture%stiffness), &
               & fixture%friction, state%step)
            call push_point(domain, surface, k, i, row, at_rest, state, reduction)
         end do
      end associate
   end subroutine press_clamp

   !> Motion of a fixture over the step under way
   pure type(fixture_motion_type) function motion_of(fixture, domain, state) result(motion)
      type(placed_fixture_type), intent(in) :: fixture
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state

      if (all(fixture%motion == 0)) return
      motion%displacement(:) = fixture%displacement(domain%curves, state%time + state%step)
      motion%increment(:) = motion%displacement - fixture%displacement(domain%curves, state%time)
   end function motion_of

   !> Give a point the multiplier of its row, with the points that share their inertia with it
   pure subroutine push_point(domain, surface, k, i, row, motion, state, reduction)
      type(domain_type), intent(in) :: domain
      type(surface_type), intent(in) :: surface
      !> Point of the face, and index of the fixture
      integer, intent(in) :: k, i
      type(contact_row_type), intent(in) :: row
      type(fixture_motion_type), intent(in) :: motion
      type(state_type), intent(inout) :: state
      type(global_reduction_type), intent(inout) :: reduction

      real(wp) :: acceleration(3), mean(3), middle(3), move(3)
      integer :: c, first, places(3)

      first = size(state%impactors) + sums*(i - 1)
      move(:) = row%inverse_mass*row%multiplier
      places(:) = surface%freedom(:, k)
      associate (v => state%velocity, u => state%displacement)
         ! the mean of the velocities before the step and after the multiplier
         acceleration(:) = state%acceleration(places)
         mean(:) = motion%coefficients%mean_velocity(v(places), acceleration)
         middle(:) = mean + 0.5_wp*move/state%step
         if (surface%own(k)) then
            call count_row(first, row, middle, motion%increment/state%step, surface%area(k), &
               & acceleration, state%step, reduction)
            call reduction%contact_damping%add(motion%coefficients%damping &
               & *dot_product(row%multiplier/state%step, mean))
         end if
         do c = 1, 3
            v(places(c)) = v(places(c)) + move(c)/state%step
            u(places(c)) = u(places(c)) + move(c)
         end do
      end associate
      reduction%largest_push = max(reduction%largest_push, maxval(abs(move)))
      if (.not. domain%inertia%thickness%active) return
      do c = 1, 3
         if (abs(move(c)) > 0.0_wp) call add_column_correction(domain%inertia%thickness, &
            & domain%columns, surface, k, c, move(c), state)
      end do
   end subroutine push_point

   !> Add the force and the work of a row to the sums of the step. The work on the plate is that of
   !> the fixture's own motion, which is external; the rest is lost, to friction where the point
   !> slides, else where it meets the fixture. That of a clamp along its normal is external
   pure subroutine count_row(first, row, middle, fixture_velocity, area, acceleration, dt, &
      & reduction)
      !> Place before the sums of the fixture
      integer, intent(in) :: first
      type(contact_row_type), intent(in) :: row
      !> Mean velocity of the point over the step, velocity of the fixture
      real(wp), intent(in) :: middle(3), fixture_velocity(3)
      !> Area of the point, its acceleration, and the time step
      real(wp), intent(in) :: area, acceleration(3), dt
      type(global_reduction_type), intent(inout) :: reduction

      real(wp) :: friction, impulse(3), lost, normal_part, tangent(3)
      integer :: c

      normal_part = row%normal_multiplier()/dt
      impulse(:) = row%multiplier/dt
      tangent(:) = impulse - normal_part*row%normal
      lost = -dot_product(impulse, middle - fixture_velocity)
      friction = 0.0_wp
      if (row%slides) friction = -dot_product(tangent, middle - fixture_velocity)
      ! a clamp has no gap: its normal force is given
      if (row%gap >= 0.0_wp) lost = -dot_product(tangent, middle - fixture_velocity)
      associate (found => reduction%bodies)
         do c = 1, 3
            call found%add(first + c, -impulse(c)/dt)
         end do
         call found%add(first + area_at, area)
         call found%add(first + points_at, 1.0_wp)
         call found%add(first + friction_at, friction)
         call found%add(first + normal_at, normal_part)
         call found%add(first + slip_at, normal_part*norm2(row%slip()))
      end associate
      call reduction%contact_work%add(friction - lost)
      call reduction%prescribed_work%add(dot_product(impulse, middle) + lost)
      call reduction%contact_power%add(dot_product(impulse, acceleration))
   end subroutine count_row

end module plydyn_method_fixture_step
