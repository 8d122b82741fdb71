!> Contact with friction of one point: stick, slip, and what holds for both.
program test_contact_solve_coulomb
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_coulomb, only : contact_row_type, friction_type, limit_friction, &
      & solve_row
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: round_off = 1.0e-13_wp, mass = 2.0_wp, dt = 0.1_wp
   type(friction_type), parameter :: rough = friction_type(static=0.3_wp)

   call check_flat()
   call check_inclined()
   call check_directions()
   call check_held()
   call check_given_force()
   call check_speed()
   call finish()

contains

   !> Stick below the limit and slip at it, on a flat face
   subroutine check_flat()
      type(contact_row_type) :: row

      call begin("solve_row")
      row = contact_row_type(gap=-0.5_wp, normal=[0.0_wp, 0.0_wp, 1.0_wp], &
         & motion=[0.06_wp, -0.08_wp, -0.7_wp], inverse_mass=spread(1.0_wp/mass, 1, 3))
      call solve_row(row, rough, dt)
      call check(row%multiplier, mass*[-0.06_wp, 0.08_wp, 0.5_wp], round_off, "stick")
      call check(row%slip(), spread(0.0_wp, 1, 3), round_off, "no slip remains")
      call check(.not. row%slides, "it does not slide")
      row%motion(:) = [0.6_wp, -0.8_wp, -0.7_wp]
      call solve_row(row, rough, dt)
      call check(row%multiplier, mass*0.5_wp*[-0.18_wp, 0.24_wp, 1.0_wp], round_off, "slip")
      call check(row%slip(), 0.85_wp*[0.6_wp, -0.8_wp, 0.0_wp], round_off, "along the motion")
      call check(row%slides, "it slides")
      call solve_row(row, friction_type(), dt)
      call check(row%multiplier, [0.0_wp, 0.0_wp, mass*0.5_wp], round_off, "without friction")
      call check(.not. row%slides, "nothing slides against friction")
   end subroutine check_flat

   !> A turned set-up gives the turned multiplier
   subroutine check_inclined()
      real(wp), parameter :: cosine = 0.8_wp, sine = 0.6_wp
      real(wp), parameter :: turn(3, 3) = reshape([cosine, 0.0_wp, sine, 0.0_wp, 1.0_wp, 0.0_wp, &
         & -sine, 0.0_wp, cosine], [3, 3])
      real(wp) :: motion(3, 2)
      type(contact_row_type) :: flat, turned
      integer :: i

      motion(:, 1) = [0.02_wp, 0.01_wp, 0.3_wp]
      motion(:, 2) = [0.9_wp, -0.4_wp, -0.2_wp]
      do i = 1, 2
         flat = contact_row_type(gap=-0.5_wp, normal=[0.0_wp, 0.0_wp, 1.0_wp], &
            & motion=motion(:, i), inverse_mass=spread(1.0_wp/mass, 1, 3))
         turned = flat
         turned%normal(:) = matmul(turn, flat%normal)
         turned%motion(:) = matmul(turn, flat%motion)
         call solve_row(flat, rough, dt)
         call solve_row(turned, rough, dt)
         call check(turned%multiplier, matmul(turn, flat%multiplier), round_off, "it turns")
      end do
   end subroutine check_inclined

   !> On a slope an inverse mass that differs between directions makes the normal force slip: stick
   !> ends that slip, too, and friction is against what is left of it
   subroutine check_directions()
      real(wp), parameter :: inverse_mass(3) = [0.5_wp, 0.3_wp, 0.1_wp], motion(3, 3) = &
         & reshape([0.0_wp, 0.0_wp, -0.5_wp, 0.4_wp, -0.9_wp, -0.5_wp, -0.1_wp, 0.1_wp, 0.0_wp], &
         & [3, 3])
      type(contact_row_type) :: row
      real(wp) :: left(3), loss, tangent(3)
      logical :: has_slid, has_stuck
      integer :: i, k

      call begin("different inverse masses")
      has_slid = .false.
      has_stuck = .false.
      do k = 0, 9
         do i = 1, size(motion, 2)
            row = contact_row_type(gap=-0.2_wp, normal=[0.1_wp*k, 0.0_wp, sqrt(1.0_wp &
               & - 0.01_wp*k**2)], motion=motion(:, i), inverse_mass=inverse_mass)
            call solve_row(row, rough, dt)
            call check(row%gap + sum(row%normal*inverse_mass*row%multiplier), 0.0_wp, round_off, &
               & "the gap closes")
            tangent(:) = row%multiplier - row%normal_multiplier()*row%normal
            left(:) = row%slip()
            if (row%slides) then
               has_slid = .true.
               call check(norm2(tangent), rough%static*row%normal_multiplier(), 1.0e-12_wp, &
                  & "the limit holds")
               call check(sum(tangent*left), -norm2(tangent)*norm2(left), 1.0e-12_wp, &
                  & "friction is against the slip")
            else
               has_stuck = .true.
               call check(left, spread(0.0_wp, 1, 3), round_off, "no slip remains")
               call check(norm2(tangent) <= rough%static*row%normal_multiplier(), "below the limit")
            end if
            ! at the mean of the motions before and after; a body at rest gives nothing where the
            ! point comes from outside of it
            loss = -sum(row%multiplier*(row%motion + 0.5_wp*inverse_mass*row%multiplier))
            if (dot_product(row%motion, row%normal) <= row%gap) call check(loss &
               & >= 0.5_wp*sum(inverse_mass*row%multiplier**2), "it takes energy")
         end do
      end do
      call check(has_slid .and. has_stuck, "both have been seen")
   end subroutine check_directions

   !> Held directions: nothing along the normal, or no friction along a held one
   subroutine check_held()
      type(contact_row_type) :: row

      call begin("held directions")
      row = contact_row_type(gap=-0.5_wp, normal=[0.0_wp, 0.0_wp, 1.0_wp], &
         & motion=[0.0_wp, 0.02_wp, 0.0_wp], inverse_mass=[0.0_wp, 1.0_wp/mass, 0.0_wp])
      call solve_row(row, rough, dt)
      call check(row%multiplier, spread(0.0_wp, 1, 3), 0.0_wp, "held along the normal")
      row%inverse_mass(:) = [0.0_wp, 1.0_wp/mass, 1.0_wp/mass]
      call solve_row(row, rough, dt)
      call check(row%multiplier, mass*[0.0_wp, -0.02_wp, 0.5_wp], round_off, "held across")
      ! on a slope, points held in x still end up on the surface
      row%normal(:) = [0.6_wp, 0.0_wp, 0.8_wp]
      row%motion(:) = [0.0_wp, 3.0_wp, 0.1_wp]
      call solve_row(row, rough, dt)
      call check(sum(row%normal*row%inverse_mass*row%multiplier), 0.5_wp, round_off, &
         & "the gap closes on a slope")
   end subroutine check_held

   !> The normal force of a clamp bounds its friction
   subroutine check_given_force()
      type(contact_row_type) :: row

      call begin("limit_friction")
      row = contact_row_type(normal=[0.0_wp, 0.0_wp, -1.0_wp], motion=[0.6_wp, -0.8_wp, -0.7_wp], &
         & inverse_mass=spread(1.0_wp/mass, 1, 3))
      call limit_friction(row, 0.5_wp, rough, dt)
      call check(row%multiplier, [-0.09_wp, 0.12_wp, -0.5_wp], round_off, "slip")
      call check(row%slides, "it slides")
      call limit_friction(row, 100.0_wp, rough, dt)
      call check(row%multiplier, [-1.2_wp, 1.6_wp, -100.0_wp], round_off, "stick")
      call check(.not. row%slides, "it sticks")
      call limit_friction(row, 0.0_wp, rough, dt)
      call check(row%multiplier, spread(0.0_wp, 1, 3), 0.0_wp, "no force, no friction")
   end subroutine check_given_force

   !> The coefficient falls with the speed
   subroutine check_speed()
      type(friction_type), parameter :: falling = friction_type(static=0.5_wp, dynamic=0.2_wp, &
         & decay=0.1_wp)
      type(contact_row_type) :: row
      real(wp) :: speed

      call begin("coefficient")
      call check(falling%coefficient(0.0_wp), 0.5_wp, round_off, "at rest")
      call check(falling%coefficient(10.0_wp*log(2.0_wp)), 0.35_wp, round_off, "half-way")
      call check(falling%coefficient(1.0e4_wp), 0.2_wp, round_off, "at high speed")
      call check(rough%coefficient(1.0e4_wp), 0.3_wp, round_off, "without decay")
      row = contact_row_type(gap=-0.5_wp, normal=[0.0_wp, 0.0_wp, 1.0_wp], &
         & motion=[0.24_wp, 0.0_wp, -0.7_wp], inverse_mass=spread(1.0_wp/mass, 1, 3))
      call solve_row(row, falling, dt)
      call check(row%slip(), spread(0.0_wp, 1, 3), round_off, "the static one decides on stick")
      row%motion(1) = 6.0_wp
      call solve_row(row, falling, dt)
      speed = norm2(row%slip())/dt
      call check(-row%multiplier(1), falling%coefficient(speed)*row%multiplier(3), round_off*mass, &
         & "slip at the coefficient of the speed that is left")
      ! nothing is left of a coefficient that falls to zero; a point may hardly touch
      row%motion(1) = 600.0_wp
      call solve_row(row, friction_type(static=0.5_wp, decay=1.0_wp), dt)
      call check(row%multiplier, [0.0_wp, 0.0_wp, mass*0.5_wp], round_off, "no friction is left")
      row%gap = -1.0e-60_wp
      call solve_row(row, rough, dt)
      call check(row%multiplier*1.0e60_wp, mass*[-0.3_wp, 0.0_wp, 1.0_wp], round_off, &
         & "friction of a point that hardly touches")
   end subroutine check_speed

end program test_contact_solve_coulomb
