!> Friction of a sphere on a face: stick, slip, momentum, and no preferred direction.
program test_contact_solve_sliding
   use ball, only : ball_body
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_contact_contact, only : contact_pair_type, contact_result_type, contact_setup_type, &
      & new_contact
   use plydyn_contact_solve_coulomb, only : friction_type
   use plydyn_contact_solve_sliding, only : step_motion_type
   use sample, only : flat_surface
   use testing, only : begin, check, finish
   implicit none

   !> Surface points of 4 x 4 squares of side one with nine points each, and their mass
   integer, parameter :: squares = 4, line = 2*squares + 1, points = line**2
   real(wp), parameter :: point_mass = 0.05_wp
   real(wp), parameter :: radius = 10.0_wp, mass = 3.0_wp, inertia = 0.4_wp*mass*radius**2
   real(wp), parameter :: dt = 1.0e-3_wp, depth = 0.03_wp, round_off = 1.0e-12_wp
   !> Motions of a step: the sphere across the plate, its rotation
   real(wp), parameter :: across(3) = [0.02_wp, -0.01_wp, -0.1_wp]
   real(wp), parameter :: rotation(3) = [4.0e-4_wp, 1.0e-3_wp, 2.0e-3_wp]

   !> A step of the sphere
   type :: step_type
      type(contact_pair_type) :: pair
      type(contact_result_type) :: result
      type(step_motion_type) :: motion
      real(wp) :: position(3, points) = 0.0_wp, centre(3) = 0.0_wp, lift(3) = 0.0_wp
   end type step_type

   integer :: method

   do method = 1, 2
      call check_stick(method)
      call check_slip(method)
      call check_momentum(method)
      call check_direction(method)
      call check_smooth(method)
   end do
   call check_speed()
   call finish()

contains

   !> With a large coefficient points in contact move with the sphere along the face
   subroutine check_stick(method)
      !> 1 for contact nodes, 2 for the exact sphere
      integer, intent(in) :: method

      type(step_type) :: step
      real(wp) :: arm(3), slip(3)
      integer, parameter :: middle = (points + 1)/2

      call begin("friction, stick"//which(method))
      step = made_step(method, friction_type(static=1.0e3_wp), 0.0_wp)
      call check(maxval(abs(step%motion%force)), 0.0_wp, 0.0_wp, "no row slides")
      ! contact nodes do not lie on points
      if (method == 1) return
      arm(:) = step%position(:, middle) - step%centre
      slip(:) = across + step%lift + cross(rotation + step%motion%rotation_correction, arm) &
         & - step%pair%correction%displacement(:, middle)
      slip(:) = slip - dot_product(slip, arm)/dot_product(arm, arm)*arm
      call check(norm2(slip), 0.0_wp, 1.0e-10_wp, "the middle does not slip")
   end subroutine check_stick

   !> Friction of a fast sphere is mu times the normal force, against its motion
   subroutine check_slip(method)
      !> As above
      integer, intent(in) :: method

      type(step_type) :: step
      real(wp), parameter :: mu = 1.0e-3_wp

      call begin("friction, slip"//which(method))
      step = made_step(method, friction_type(static=mu), 0.0_wp, still=.true.)
      ! normals differ by four degrees, so that the fall of the sphere, five times its way along
      ! the face, turns the slip within the patch by up to a fifth: a mean cosine of 0.99
      associate (force => step%motion%force/dt**2)
         call check(norm2(force), mu*step%result%force(3), 2.0e-2_wp*mu*step%result%force(3), &
            & "mu times the force")
         call check(force(:2)/norm2(force), -across(:2)/norm2(across(:2)), 0.05_wp, &
            & "against the motion")
      end associate
   end subroutine check_slip

   !> Momentum is conserved; with the exact sphere that about a point, too
   subroutine check_momentum(method)
      !> As above
      integer, intent(in) :: method

      type(step_type) :: step
      real(wp) :: angular(3), linear(3), scale
      integer :: k

      call begin("friction, momentum"//which(method))
      step = made_step(method, friction_type(0.3_wp, 0.1_wp, 0.05_wp), 0.0_wp)
      scale = mass*norm2(step%lift)
      linear(:) = mass*step%lift
      angular(:) = mass*cross(step%centre, step%lift) + inertia*step%motion%rotation_correction
      do k = 1, points
         associate (move => step%pair%correction%displacement(:, k))
            linear(:) = linear + point_mass*move
            angular(:) = angular + point_mass*cross(step%position(:, k), move)
         end associate
      end do
      call check(norm2(linear), 0.0_wp, round_off*scale, "linear")
      ! contact nodes press along the normal of a facet, which is not that of the sphere
      call check(norm2(angular), 0.0_wp, merge(2.0e-2_wp, round_off, method == 1)*scale*radius, &
         & "angular")
      call check(norm2(step%motion%rotation_correction) > 0.0_wp, "the sphere rotates")
   end subroutine check_momentum

   !> A turned set-up gives the turned motion: there is no preferred direction
   subroutine check_direction(method)
      !> As above
      integer, intent(in) :: method

      type(step_type) :: here, there
      real(wp) :: largest
      integer :: k

      call begin("friction, direction"//which(method))
      ! the contact nodes of a sphere are the same after a quarter of a turn
      associate (angle => merge(2.0_wp*atan(1.0_wp), 0.7_wp, method == 1))
         here = made_step(method, friction_type(static=0.3_wp), 0.0_wp)
         there = made_step(method, friction_type(static=0.3_wp), angle)
         call check(there%lift, turned(here%lift, angle), 1.0e-10_wp*norm2(here%lift), "sphere")
         call check(there%motion%rotation_correction, turned(here%motion%rotation_correction, &
            & angle), 1.0e-9_wp*norm2(here%motion%rotation_correction), "rotation")
         largest = here%pair%correction%largest_displacement()
         do k = 1, points
            call check(there%pair%correction%displacement(:, k), &
               & turned(here%pair%correction%displacement(:, k), angle), 1.0e-9_wp*largest, &
               & "points")
         end do
      end associate
   end subroutine check_direction

   !> Without friction the motion has no influence at all
   subroutine check_smooth(method)
      !> As above
      integer, intent(in) :: method

      type(step_type) :: here, there

      call begin("friction, none"//which(method))
      here = made_step(method, friction_type(), 0.0_wp)
      there = made_step(method, friction_type(), 0.0_wp, still=.true.)
      call check(here%lift, there%lift, 0.0_wp, "sphere")
      call check(maxval(abs(here%pair%correction%displacement &
         & - there%pair%correction%displacement)), 0.0_wp, 0.0_wp, "points")
      call check(maxval(abs(here%motion%rotation_correction)), 0.0_wp, 0.0_wp, "rotation")
   end subroutine check_smooth

   !> The coefficient is that at the speed which it leaves
   subroutine check_speed()
      type(friction_type), parameter :: falling = friction_type(0.5_wp, 0.1_wp, 2.0_wp)
      real(wp), parameter :: compliance = 0.2_wp, normal_part = 3.0_wp, time = 0.1_wp
      real(wp) :: speed, tangent(3)
      logical :: slides

      call begin("friction, speed")
      call falling%limit([0.0_wp, 0.299_wp, 0.0_wp], compliance, normal_part, time, tangent, slides)
      call check(.not. slides, "the static coefficient decides on stick")
      call check(tangent, [0.0_wp, -0.299_wp/compliance, 0.0_wp], 1.0e-13_wp, "stick")
      call falling%limit([0.0_wp, 0.6_wp, 0.0_wp], compliance, normal_part, time, tangent, slides)
      speed = (0.6_wp + compliance*tangent(2))/time
      call check(slides, "slip")
      call check(-tangent(2), falling%coefficient(speed)*normal_part, 1.0e-12_wp, "coefficient")
      call falling%limit([0.0_wp, 0.6_wp, 0.0_wp], 0.0_wp, normal_part, time, tangent, slides)
      call check(-tangent(2), falling%coefficient(6.0_wp)*normal_part, 1.0e-12_wp, &
         & "bodies that do not give way")
   end subroutine check_speed

   !> A step of a sphere that sinks into a flat face, everything turned about z
   function made_step(method, friction, angle, still) result(step)
      integer, intent(in) :: method
      type(friction_type), intent(in) :: friction
      real(wp), intent(in) :: angle
      !> Whether the sphere does not rotate
      logical, intent(in), optional :: still
      type(step_type) :: step

      type(contact_setup_type) :: setup
      type(error_type), allocatable :: error
      real(wp) :: inverse(3, points)
      integer :: facet(9, squares**2), k

      call flat_surface(squares, step%position, facet)
      do k = 1, points
         step%position(:, k) = turned(step%position(:, k), angle)
      end do
      inverse(:, :) = 1.0_wp/point_mass
      setup%body = ball_body(radius)
      setup%inverse_mass(:) = 1.0_wp/mass
      setup%inverse_inertia = 1.0_wp/inertia
      setup%friction = friction
      setup%exact_body = method == 2
      call new_contact(step%pair, setup, facet, step%position, [0.0_wp, 0.0_wp, radius], error)
      call check(.not. allocated(error), "the pair can be built")
      step%centre(:) = turned([0.1_wp, 0.23_wp, radius - depth], angle)
      step%motion%centre(:) = turned(across, angle)
      step%motion%rotation(:) = turned(rotation, angle)
      if (present(still)) step%motion%rotation(:) = 0.0_wp
      allocate (step%motion%point(3, points), step%motion%point_force(3, points), source=0.0_wp)
      call step%pair%enforce(step%position, inverse, dt, step%centre, step%result, step%motion)
      step%lift(:) = step%pair%correction%impactor
      call check(step%result%active > 1, "several rows")
   end function made_step

   !> A vector turned about z
   pure function turned(vector, angle)
      real(wp), intent(in) :: vector(3), angle
      real(wp) :: turned(3)

      turned(:) = [cos(angle)*vector(1) - sin(angle)*vector(2), &
         & sin(angle)*vector(1) + cos(angle)*vector(2), vector(3)]
   end function turned

   !> Vector product
   pure function cross(a, b)
      real(wp), intent(in) :: a(3), b(3)
      real(wp) :: cross(3)

      cross(:) = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
   end function cross

   !> Name of the discretisation
   pure function which(method) result(name)
      integer, intent(in) :: method
      character(:), allocatable :: name

      name = merge(", contact nodes", ", exact sphere ", method == 1)
   end function which

end program test_contact_solve_sliding
