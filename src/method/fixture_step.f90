!> Contact of the plate with fixtures, step by step.
!>
!> A fixture moves as prescribed, so that every point of the plate in contact is a row of its own:
!> no equations are solved, and every rank corrects the points that it has.
module plydyn_method_fixture_step
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_coulomb, only : contact_row_type, limit_friction, solve_row
   use plydyn_domain_domain, only : domain_type, placed_fixture_type, face_type
   use plydyn_method_contact_correction, only : contact_work_type, impulse_type, move_point
   use plydyn_method_energy, only : fixture_sums_type, global_reduction_type
   use plydyn_method_step_control, only : coefficients_of_step, leapfrog_coefficients_type
   use plydyn_method_supports, only : is_active
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: correct_fixtures, place_new_fixtures, update_fixtures

   !> Motion of a fixture over a step
   type :: fixture_motion_type
      !> Displacement at its end, and its change over the step
      real(wp) :: displacement(3) = 0.0_wp, increment(3) = 0.0_wp
   end type fixture_motion_type

contains

   !> Press the clamps onto the plate, then push it out of the fixtures, from the top face first: so
   !> their order in the deck changes nothing, even where a column of points shares its inertia
   subroutine correct_fixtures(domain, state, work, reduction)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Displacement and velocity of the plate, already predicted and in contact with impactors
      type(state_type), intent(inout) :: state
      !> Gets the impulses on the plate
      type(contact_work_type), intent(inout) :: work
      !> Gets the forces of the fixtures
      type(global_reduction_type), intent(inout) :: reduction

      logical :: is_moved(0:size(domain%supports%motions))
      integer :: face, i

      is_moved(0) = .false.
      is_moved(1:) = is_active(domain%supports%motions, state%time)
      associate (fixtures => domain%contact%fixtures)
         do i = 1, size(fixtures)
            if (fixtures(i)%is_clamp) call press_clamp(domain, i, is_moved, state, work, reduction)
         end do
         do face = 1, -1, -2
            do i = 1, size(fixtures)
               if (fixtures(i)%is_clamp .or. fixtures(i)%face /= face) cycle
               call meet_body(domain, i, is_moved, state, work, reduction)
            end do
         end do
      end associate
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

      real(wp) :: friction, impulse(3), normal
      integer :: c, i

      do i = 1, size(state%fixtures)
         associate (found => reduction%fixtures(i), own => state%fixtures(i))
            impulse(:) = [(found%impulse(c)%value(), c=1, 3)]
            own%force(:) = impulse/(0.5_wp*(state%step_before + state%step))
            own%impulse(:) = own%impulse + impulse
            own%area = found%area%value()
            own%contacts = nint(found%points%value())
            normal = found%normal%value()
            if (normal > 0.0_wp) own%slip = own%slip + found%slip%value()/normal
            friction = reduction%friction(size(state%impactors) + i)%value()
            own%friction = own%friction + friction
            own%contact = own%contact - reduction%contact(size(state%impactors) + i)%value()
            state%energies%friction = state%energies%friction + friction
         end associate
      end do
   end subroutine update_fixtures

   !> Contact of the points that this rank has with a rigid body
   subroutine meet_body(domain, i, is_moved, state, work, reduction)
      type(domain_type), intent(in) :: domain
      !> Index of the fixture
      integer, intent(in) :: i
      !> Whether each prescribed motion acts now
      logical, intent(in) :: is_moved(0:)
      type(state_type), intent(inout) :: state
      type(contact_work_type), intent(inout) :: work
      type(global_reduction_type), intent(inout) :: reduction

      real(wp) :: point(3)
      type(contact_row_type) :: row
      type(fixture_motion_type) :: motion
      integer :: j, k

      associate (fixture => domain%contact%fixtures(i), &
         & surface => domain%contact%fixture_faces(domain%contact%fixtures(i)%surface))
         motion = motion_of(fixture, domain, state)
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
            row%velocity(:) = motion%increment/state%step
            call push_point(domain, surface, k, i, row, state, work, reduction)
         end do
      end associate
   end subroutine meet_body

   !> Force of a clamp on the points that this rank has: the pressure of its force and of its
   !> spring at the beginning of the step
   subroutine press_clamp(domain, i, is_moved, state, work, reduction)
      type(domain_type), intent(in) :: domain
      !> As in `meet_body`
      integer, intent(in) :: i
      logical, intent(in) :: is_moved(0:)
      type(state_type), intent(inout) :: state
      type(contact_work_type), intent(inout) :: work
      type(global_reduction_type), intent(inout) :: reduction

      real(wp) :: force, mean_step, raised
      type(leapfrog_coefficients_type) :: coefficients
      type(contact_row_type) :: row
      integer :: j, k

      associate (fixture => domain%contact%fixtures(i), &
         & surface => domain%contact%fixture_faces(domain%contact%fixtures(i)%surface))
         ! the impulse of a load, which damping takes its share of
         coefficients = coefficients_of_step(domain%control%damping, state)
         mean_step = coefficients%mean_step
         force = fixture%force*domain%curves(fixture%curve)%at(state%time)
         row%normal(:) = [0.0_wp, 0.0_wp, real(fixture%body%upward, wp)]
         do j = 1, size(fixture%below)
            k = fixture%below(j)
            row%motion(:) = state%step*state%velocity(surface%freedom(:, k))
            raised = state%displacement(surface%freedom(3, k)) - row%motion(3)
            row%inverse_mass(:) = merge(0.0_wp, surface%inverse_mass(:, k), &
               & is_moved(surface%motion(:, k)))
            if (row%inverse_mass(3) <= 0.0_wp) cycle
            call limit_friction(row, state%step*mean_step*surface%area(k)/fixture%area &
               & *max(0.0_wp, force - fixture%body%upward*raised*fixture%stiffness), &
               & fixture%friction, state%step)
            call push_point(domain, surface, k, i, row, state, work, reduction)
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
   subroutine push_point(domain, surface, k, i, row, state, work, reduction)
      type(domain_type), intent(in) :: domain
      type(face_type), intent(in) :: surface
      !> Point of the face, and index of the fixture
      integer, intent(in) :: k, i
      type(contact_row_type), intent(in) :: row
      type(state_type), intent(inout) :: state
      type(contact_work_type), intent(inout) :: work
      type(global_reduction_type), intent(inout) :: reduction

      type(impulse_type) :: impulse

      if (surface%own(k)) then
         impulse = impulse_of(row, state%step)
         impulse%place(:) = surface%freedom(:, k)
         impulse%body = size(state%impactors) + i
         call work%add(domain%columns, impulse, state%velocity)
         call count_row(row, surface%area(k), state%step, reduction%fixtures(i))
      end if
      associate (move => row%inverse_mass*row%multiplier)
         call move_point(domain, surface, k, move, state)
         reduction%largest_push = max(reduction%largest_push, maxval(abs(move)))
      end associate
   end subroutine push_point

   !> Impulses of a row; the normal force of a clamp is a load
   pure type(impulse_type) function impulse_of(row, dt) result(impulse)
      type(contact_row_type), intent(in) :: row
      !> Time step
      real(wp), intent(in) :: dt

      real(wp) :: tangent(3)

      tangent(:) = (row%multiplier - row%normal_multiplier()*row%normal)/dt
      if (row%slides) impulse%sliding(:) = tangent
      ! a clamp has no gap
      if (row%gap < 0.0_wp) then
         impulse%contact(:) = row%multiplier/dt
      else
         impulse%contact(:) = tangent
         impulse%load(:) = row%multiplier/dt - tangent
      end if
      impulse%velocity(:) = row%velocity
   end function impulse_of

   !> Add impulse, area and slip of a row to the sums of its fixture
   pure subroutine count_row(row, area, dt, found)
      type(contact_row_type), intent(in) :: row
      !> Area of the point, and the time step
      real(wp), intent(in) :: area, dt
      type(fixture_sums_type), intent(inout) :: found

      integer :: c

      associate (normal_part => row%normal_multiplier()/dt)
         do c = 1, 3
            call found%impulse(c)%add(-row%multiplier(c)/dt)
         end do
         call found%area%add(area)
         call found%points%add(1.0_wp)
         call found%normal%add(normal_part)
         call found%slip%add(normal_part*norm2(row%slip()))
      end associate
   end subroutine count_row

end module plydyn_method_fixture_step
