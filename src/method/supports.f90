!> Supports: held points, and points of prescribed motion.
module plydyn_method_supports
   use plydyn_base_exact_sum, only : exact_sum_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type, prescribed_type
   use plydyn_method_constraints, only : constraint_work_type, lead_constraints, led_velocity
   use plydyn_method_energy, only : global_reduction_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: add_held_inertia, add_support_power, fix_points, hold_supports, is_active, &
      & prescribe_motion, support_points

contains

   !> How many points are held or prescribed
   pure integer function support_points(domain) result(points)
      type(domain_type), intent(in) :: domain
      integer :: m

      points = size(domain%supports%held)
      do m = 1, size(domain%supports%motions)
         points = points + size(domain%supports%motions(m)%freedom)
      end do
   end function support_points

   !> Take held and prescribed points out of the free motion, and keep the force they would feel.
   !> All threads come here together
   subroutine hold_supports(domain, time, force, support_force)
      type(domain_type), intent(in) :: domain
      !> Time of these forces
      real(wp), intent(in) :: time
      !> Force on all points; becomes zero on these
      real(wp), intent(inout), contiguous :: force(:)
      !> The force before: held points first, then those of each motion, zero while it is inactive
      real(wp), intent(inout), contiguous :: support_force(:)

      integer :: c, first, m

      !$omp do schedule(static)
      do c = size(domain%chunks%list), 1, -1
         call fix_points(domain, domain%chunks%list(c)%held, force, support_force)
      end do
      !$omp end do nowait
      if (size(domain%supports%motions) == 0) return
      !$omp barrier
      !$omp single
      first = size(domain%supports%held)
      do m = 1, size(domain%supports%motions)
         associate (motion => domain%supports%motions(m), &
            & n => size(domain%supports%motions(m)%freedom))
            support_force(first + 1:first + n) = 0.0_wp
            if (is_active(motion, time)) then
               support_force(first + 1:first + n) = force(motion%freedom)
               force(motion%freedom) = 0.0_wp
            end if
            first = first + n
         end associate
      end do
      !$omp end single
   end subroutine hold_supports

   !> Take held points out of the free motion, and keep the force they would feel
   pure subroutine fix_points(domain, runs, force, support_force)
      type(domain_type), intent(in) :: domain
      !> Which of its held points: first and last of each run
      integer, intent(in) :: runs(:, :)
      !> As in `hold_supports`
      real(wp), intent(inout), contiguous :: force(:), support_force(:)

      integer :: i, k, place

      do i = 1, size(runs, 2)
         place = domain%supports%held(runs(1, i)) - runs(1, i)
         do k = runs(1, i), runs(2, i)
            support_force(k) = force(place + k)
            force(place + k) = 0.0_wp
         end do
      end do
   end subroutine fix_points

   !> Add the forces on held points of the inertia that they share with free points of their columns
   pure subroutine add_held_inertia(domain, acceleration, support_force)
      type(domain_type), intent(in) :: domain
      !> Of all points
      real(wp), intent(in) :: acceleration(:)
      !> Force that held points would feel free
      real(wp), intent(inout) :: support_force(:)
      integer :: k

      associate (links => domain%inertia%held_links)
         do k = 1, size(links%inertia)
            associate (held => links%place(1, k), free => links%place(2, k))
               support_force(held) = support_force(held) + links%inertia(k)*acceleration(free)
            end associate
         end do
      end associate
   end subroutine add_held_inertia

   !> Whether a motion acts at some time
   elemental logical function is_active(motion, time)
      type(prescribed_type), intent(in) :: motion
      real(wp), intent(in) :: time

      is_active = motion%birth <= time .and. time < motion%death
   end function is_active

   !> Give prescribed points their velocity over the coming step, and the displacement at its end,
   !> and the sums of constraints their rates
   subroutine prescribe_motion(domain, state, work, reduction)
      type(domain_type), intent(in) :: domain
      !> Velocity and displacement, already predicted without the supports
      type(state_type), intent(inout) :: state
      !> Work space of the constraints
      type(constraint_work_type), intent(inout) :: work
      !> Gets the work of the prescribed motions
      type(global_reduction_type), intent(inout) :: reduction

      if (size(domain%supports%motions) > 0) call move_points(domain, state, reduction)
      if (size(domain%constraints%list) > 0) then
         call lead_constraints(domain, state, work, reduction)
      end if
   end subroutine prescribe_motion

   !> Move the prescribed points
   subroutine move_points(domain, state, reduction)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(inout) :: state
      type(global_reduction_type), intent(inout) :: reduction

      real(wp) :: before, undamped, velocity
      integer :: i, k, m

      call domain%inertia%moved_links%count_energy(state%velocity, -1.0_wp, &
         & reduction%prescribed_work)
      k = 0
      do m = 1, size(domain%supports%motions)
         associate (motion => domain%supports%motions(m))
            do i = 1, size(motion%freedom)
               k = k + 1
               associate (v => state%velocity(motion%freedom(i)), &
                  & u => state%displacement(motion%freedom(i)), last => state%supports%velocity(k))
                  undamped = last
                  last = v
                  if (.not. is_active(motion, state%time)) cycle
                  before = u - state%step*v
                  velocity = led_velocity(domain, motion, state, before, undamped)
                  last = velocity
                  if (domain%counts(motion%freedom(i))) call reduction%prescribed_work%add( &
                     & 0.5_wp*domain%inertia%mass(motion%mass(i))*(velocity**2 - v**2))
                  u = before + state%step*velocity
                  v = velocity
               end associate
            end do
         end associate
      end do
      call domain%inertia%moved_links%count_energy(state%velocity, 1.0_wp, &
         & reduction%prescribed_work)
   end subroutine move_points

   !> Add the power that prescribed points take from the plate to a sum: it passes through the
   !> supports
   pure subroutine add_support_power(domain, support_force, velocity, sum)
      type(domain_type), intent(in) :: domain
      !> As in the state
      real(wp), intent(in) :: support_force(:)
      !> Velocity of all points
      real(wp), intent(in) :: velocity(:)
      type(exact_sum_type), intent(inout) :: sum

      integer :: first, i, m

      first = size(domain%supports%held)
      do m = 1, size(domain%supports%motions)
         associate (motion => domain%supports%motions(m))
            do i = 1, size(motion%freedom)
               if (domain%counts(motion%freedom(i))) call sum%add( &
                  & -support_force(first + i)*velocity(motion%freedom(i)))
            end do
            first = first + size(motion%freedom)
         end associate
      end do
   end subroutine add_support_power

end module plydyn_method_supports
