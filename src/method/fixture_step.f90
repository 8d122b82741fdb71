!> Contact of the plate with fixtures, step by step.
!>
!> A fixture moves as prescribed, so that every point of the plate in contact is a row of its own:
!> no equations are solved, and every rank corrects the points that it has, those near the fixture.
!> An impactor gives way, so that its rows are one system, which every rank solves whole: this is
!> why the two stay apart.
module plydyn_method_fixture_step
   use plydyn_base_precision, only : wp
   use plydyn_contact_search_near_points, only : near_points_type, unknown_move
   use plydyn_contact_solve_coulomb, only : contact_row_type, limit_friction, solve_row
   use plydyn_domain_domain, only : domain_type, face_type
   use plydyn_method_contact_correction, only : contact_work_type, impulse_type, push_point
   use plydyn_method_energy, only : body_sums_type, global_reduction_type
   use plydyn_method_step_control, only : coefficients_of_step, leapfrog_coefficients_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: approach_fixtures, correct_fixtures, place_new_fixtures

contains

   !> Take the motion over the coming step from what points have left to the fixtures
   pure subroutine approach_fixtures(domain, move, state, near, is_due)
      type(domain_type), intent(in) :: domain
      !> Bound on the displacement of a point since the fixtures saw it, or `unknown_move`
      real(wp), intent(in) :: move
      !> Has the step
      type(state_type), intent(in) :: state
      !> Points near each fixture
      type(near_points_type), intent(inout) :: near(:)
      !> Whether points that are not near one now may come to it in the step
      logical, intent(out) :: is_due

      integer :: i

      is_due = .false.
      do i = 1, size(near)
         associate (fixture => domain%contact%fixtures(i))
            if (fixture%is_clamp) cycle
            call near(i)%approach(move + norm2(fixture%displacement(domain%curves, state%time &
               & + state%step) - fixture%displacement(domain%curves, state%time)))
         end associate
         is_due = is_due .or. near(i)%is_due()
      end do
   end subroutine approach_fixtures

   !> Press the clamps onto the plate, then push it out of the fixtures, from the top face first: so
   !> their order in the deck changes nothing, even where a column of points shares its inertia
   subroutine correct_fixtures(domain, is_moved, pushed, near, state, work, reduction)
      type(domain_type), intent(in) :: domain
      !> Whether each prescribed motion acts now; the first is that of no motion
      logical, contiguous, intent(in) :: is_moved(0:)
      !> Bound on what the impactors have moved a point in this step
      real(wp), intent(in) :: pushed
      !> Points near each fixture, whose motion over the step is known
      type(near_points_type), intent(inout) :: near(:)
      !> Displacement and velocity of the plate, already predicted and in contact with impactors
      type(state_type), intent(inout) :: state
      !> Gets the impulses on the plate
      type(contact_work_type), intent(inout) :: work
      !> Gets the forces of the fixtures
      type(global_reduction_type), intent(inout) :: reduction

      integer :: face, i

      associate (fixtures => domain%contact%fixtures)
         do i = 1, size(fixtures)
            if (fixtures(i)%is_clamp) call press_clamp(domain, i, is_moved, state, work, reduction)
         end do
         do face = 1, -1, -2
            do i = 1, size(fixtures)
               if (fixtures(i)%is_clamp .or. fixtures(i)%face /= face) cycle
               call near(i)%push(pushed + size(fixtures)*reduction%largest_push)
               if (near(i)%is_due()) call list_near(domain, i, state, near(i))
               call meet_body(domain, i, is_moved, near(i)%point(:near(i)%count), state, work, &
                  & reduction)
            end do
         end do
      end associate
   end subroutine correct_fixtures

   !> Let fixtures that a restart adds stand before the plate as it is: their GAP is from the
   !> outermost point under them. All ranks must come here
   subroutine place_new_fixtures(domain, state)
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

   !> List the points near a fixture anew: all of them where their motion has no bound
   pure subroutine list_near(domain, i, state, near)
      type(domain_type), intent(in) :: domain
      !> Index of the fixture
      integer, intent(in) :: i
      type(state_type), intent(in) :: state
      type(near_points_type), intent(inout) :: near

      real(wp) :: moved(3)
      integer :: j

      associate (fixture => domain%contact%fixtures(i), &
         & surface => domain%contact%fixture_faces(domain%contact%fixtures(i)%surface))
         if (near%reach >= unknown_move) then
            call near%list_all(surface%here)
            return
         end if
         moved(:) = fixture%displacement(domain%curves, state%time + state%step)
         call near%list_none()
         do j = 1, size(surface%here)
            associate (k => surface%here(j))
               call near%list_if_near(fixture%body, k, surface%position(:, k) &
                  & + state%displacement(surface%freedom(:, k)) - moved &
                  & - [0.0_wp, 0.0_wp, state%fixtures(i)%height])
            end associate
         end do
      end associate
   end subroutine list_near

   !> Contact of points that this rank has with a rigid body
   subroutine meet_body(domain, i, is_moved, points, state, work, reduction)
      type(domain_type), intent(in) :: domain
      !> Index of the fixture
      integer, intent(in) :: i
      !> As in `correct_fixtures`
      logical, contiguous, intent(in) :: is_moved(0:)
      !> All points of the face that may touch it
      integer, intent(in) :: points(:)
      type(state_type), intent(inout) :: state
      type(contact_work_type), intent(inout) :: work
      type(global_reduction_type), intent(inout) :: reduction

      real(wp) :: increment(3), moved(3), point(3)
      type(contact_row_type) :: row
      integer :: j, k

      associate (fixture => domain%contact%fixtures(i), &
         & surface => domain%contact%fixture_faces(domain%contact%fixtures(i)%surface))
         moved(:) = fixture%displacement(domain%curves, state%time + state%step)
         increment(:) = moved - fixture%displacement(domain%curves, state%time)
         do j = 1, size(points)
            k = points(j)
            ! its height alone tells of most points that they are clear
            point(3) = surface%position(3, k) + state%displacement(surface%freedom(3, k)) &
               & - moved(3) - state%fixtures(i)%height
            if (fixture%body%upward*point(3) >= 0.0_wp) cycle
            point(:2) = surface%position(:2, k) + state%displacement(surface%freedom(:2, k)) &
               & - moved(:2)
            call fixture%body%find_gap(point, row%gap, row%normal)
            if (row%gap >= 0.0_wp) cycle
            row%inverse_mass(:) = merge(0.0_wp, surface%inverse_mass(:, k), &
               & is_moved(surface%motion(:, k)))
            row%motion(:) = state%step*state%velocity(surface%freedom(:, k)) - increment
            call solve_row(row, fixture%friction, state%step)
            row%velocity(:) = increment/state%step
            call push_row(domain, surface, k, i, row, state, work, reduction)
         end do
      end associate
   end subroutine meet_body

   !> Force of a clamp on the points that this rank has: the pressure of its force and of its
   !> spring at the beginning of the step
   subroutine press_clamp(domain, i, is_moved, state, work, reduction)
      type(domain_type), intent(in) :: domain
      !> As in `meet_body`
      integer, intent(in) :: i
      logical, contiguous, intent(in) :: is_moved(0:)
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
            call push_row(domain, surface, k, i, row, state, work, reduction)
         end do
      end associate
   end subroutine press_clamp

   !> Give a point the multiplier of its row
   subroutine push_row(domain, surface, k, i, row, state, work, reduction)
      type(domain_type), intent(in) :: domain
      type(face_type), intent(in) :: surface
      !> Point of the face, and index of the fixture
      integer, intent(in) :: k, i
      type(contact_row_type), intent(in) :: row
      type(state_type), intent(inout) :: state
      type(contact_work_type), intent(inout) :: work
      type(global_reduction_type), intent(inout) :: reduction

      associate (body => size(state%impactors) + i, move => row%inverse_mass*row%multiplier)
         call push_point(domain, surface, k, impulse_of(row, body, state%step), move, state, work)
         reduction%largest_push = max(reduction%largest_push, maxval(abs(move)))
         if (surface%own(k)) call count_row(row, surface%area(k), state%step, &
            & reduction%bodies(body))
      end associate
   end subroutine push_row

   !> Impulses of a row; the normal force of a clamp is a load
   pure type(impulse_type) function impulse_of(row, body, dt) result(impulse)
      type(contact_row_type), intent(in) :: row
      !> Number of the body, and time step
      integer, intent(in) :: body
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
      impulse%body = body
      impulse%velocity(:) = row%velocity
   end function impulse_of

   !> Add impulse, area and slip of a row to the sums of its body
   pure subroutine count_row(row, area, dt, found)
      type(contact_row_type), intent(in) :: row
      !> Area of the point, and the time step
      real(wp), intent(in) :: area, dt
      type(body_sums_type), intent(inout) :: found

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
