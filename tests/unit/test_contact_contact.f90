!> Contact of a sphere with a face, step by step.
program test_contact_contact
   use ball, only : ball_body
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_contact_contact, only : contact_pair_type, contact_result_type, contact_setup_type, &
      & new_contact
   use sample, only : flat_surface
   use testing, only : begin, check, check_error, finish
   implicit none

   !> Surface points of 4 x 4 squares of side one with nine points each
   integer, parameter :: squares = 4, line = 2*squares + 1, points = line**2
   integer, parameter :: middle = (points + 1)/2

   real(wp), parameter :: radius = 10.0_wp, mass = 3.0_wp, dt = 1.0e-3_wp
   real(wp), parameter :: round_off = 1.0e-12_wp

   integer :: method

   do method = 1, 2
      call check_collision(method)
      call check_rest(method)
      call check_weight(method)
      call check_separation(method)
      call check_symmetry(method)
      call check_momentum(method)
      call check_guide(method)
      call check_initial_gap(method)
      call check_bottom(method)
      call check_memory(method)
   end do
   call check_spacing()
   call finish()

contains

   !> Sphere and point move on together: momentum is conserved, the loss is that of plastic impact
   subroutine check_collision(method)
      !> 1 for contact nodes, 2 for the exact sphere
      integer, intent(in) :: method

      real(wp), parameter :: speed = 2.0_wp
      real(wp) :: centre(3), inverse(3, points), lift(3), position(3, points)
      real(wp) :: after, both, loss, small
      type(contact_pair_type) :: pair
      type(contact_result_type) :: result

      call begin("enforce, collision"//which(method))
      call build(method, pair, position, inverse, centre)
      small = 1.0_wp/inverse(3, middle)
      centre(3) = centre(3) - speed*dt
      call pair%enforce(position, inverse, dt, centre, result)
      lift(:) = pair%correction%impactor
      both = -mass*speed/(mass + small)
      after = -speed + lift(3)/dt
      call check(after, both, 1.0e-11_wp, "velocity of the impactor")
      call check(pair%correction%displacement(3, middle)/dt, both, 1.0e-11_wp, &
         & "velocity of the point")
      loss = 0.5_wp*mass*speed**2 - 0.5_wp*mass*after**2 &
         & - 0.5_wp*small*(pair%correction%displacement(3, middle)/dt)**2
      call check(loss, 0.5_wp*small*mass/(mass + small)*speed**2, 1.0e-11_wp, "loss")
      call check(result%force(3), mass*lift(3)/dt**2, 1.0e-9_wp, "force")
      call check(result%active, 1, "one active row")
      call check(result%penetration, 0.0_wp, round_off, "no penetration remains")
   end subroutine check_collision

   !> A sphere that touches and does not move stays, and so does the plate
   subroutine check_rest(method)
      !> 1 for contact nodes, 2 for the exact sphere
      integer, intent(in) :: method

      real(wp) :: centre(3), inverse(3, points), lift(3), position(3, points)
      type(contact_pair_type) :: pair
      type(contact_result_type) :: result
      integer :: step

      call begin("enforce, rest"//which(method))
      call build(method, pair, position, inverse, centre)
      do step = 1, 10
         call pair%enforce(position, inverse, dt, centre, result)
         lift(:) = pair%correction%impactor
         position(:, :) = position + pair%correction%displacement
         centre(:) = centre + lift
         call check(maxval(abs(pair%correction%displacement)), 0.0_wp, 1.0e-15_wp, &
            & "the plate stays")
         call check(lift, spread(0.0_wp, 1, 3), 1.0e-15_wp, "the impactor stays")
      end do
   end subroutine check_rest

   !> A held plate carries the weight, no more and no less
   subroutine check_weight(method)
      !> 1 for contact nodes, 2 for the exact sphere
      integer, intent(in) :: method

      real(wp), parameter :: gravity = 9.81_wp
      real(wp) :: centre(3), inverse(3, points), lift(3), position(3, points)
      real(wp) :: velocity
      type(contact_pair_type) :: pair
      type(contact_result_type) :: result
      integer :: step

      call begin("enforce, weight"//which(method))
      call build(method, pair, position, inverse, centre)
      inverse(:, :) = 0.0_wp
      velocity = 0.0_wp
      do step = 1, 5
         velocity = velocity - gravity*dt
         centre(3) = centre(3) + velocity*dt
         call pair%enforce(position, inverse, dt, centre, result)
         lift(:) = pair%correction%impactor
         velocity = velocity + lift(3)/dt
         centre(:) = centre + lift
         call check(result%force(3), mass*gravity, 1.0e-7_wp, "the force is the weight")
         call check(maxval(abs(pair%correction%displacement)), 0.0_wp, 0.0_wp, "held points stay")
      end do
   end subroutine check_weight

   !> A sphere that separates exerts no force
   subroutine check_separation(method)
      !> 1 for contact nodes, 2 for the exact sphere
      integer, intent(in) :: method

      real(wp) :: centre(3), inverse(3, points), lift(3), position(3, points)
      type(contact_pair_type) :: pair
      type(contact_result_type) :: result

      call begin("enforce, separation"//which(method))
      call build(method, pair, position, inverse, centre)
      centre(3) = centre(3) - 1.0e-2_wp
      call pair%enforce(position, inverse, dt, centre, result)
      lift(:) = pair%correction%impactor
      call check(result%force(3) > 0.0_wp, "a force while in contact")
      centre(:) = centre + lift + [0.0_wp, 0.0_wp, 1.0e-6_wp]
      position(:, :) = position + pair%correction%displacement
      call pair%enforce(position, inverse, dt, centre, result)
      lift(:) = pair%correction%impactor
      call check(result%force, spread(0.0_wp, 1, 3), 0.0_wp, "no force when it leaves")
      call check(result%active, 0, "no active row")
      call check(maxval(abs(pair%correction%displacement)), 0.0_wp, 0.0_wp, "no motion")
   end subroutine check_separation

   !> Over a corner of four facets all that contact does has the symmetry of the square
   subroutine check_symmetry(method)
      !> 1 for contact nodes, 2 for the exact sphere
      integer, intent(in) :: method

      real(wp) :: centre(3), inverse(3, points), lift(3), position(3, points)
      real(wp) :: down(line, line), scale
      type(contact_pair_type) :: pair
      type(contact_result_type) :: result

      call begin("enforce, symmetry"//which(method))
      call build(method, pair, position, inverse, centre)
      ! a dish with folds between the facets
      position(3, :) = 0.02_wp*(abs(position(1, :)) + abs(position(2, :)))
      centre(3) = centre(3) - 0.03_wp
      call pair%enforce(position, inverse, dt, centre, result)
      lift(:) = pair%correction%impactor
      down(:, :) = reshape(pair%correction%displacement(3, :), [line, line])
      scale = maxval(abs(down))
      call check(result%active > 4, "more rows than the pole")
      call check(lift(:2), spread(0.0_wp, 1, 2), round_off*lift(3), "nothing aside")
      call check(maxval(abs(down - transpose(down))), 0.0_wp, 1.0e-9_wp*scale, &
         & "across the diagonal")
      call check(maxval(abs(down - down(line:1:-1, :))), 0.0_wp, 1.0e-9_wp*scale, "left and right")
   end subroutine check_symmetry

   !> Momentum is conserved in all directions, on a warped plate
   subroutine check_momentum(method)
      !> 1 for contact nodes, 2 for the exact sphere
      integer, intent(in) :: method

      real(wp) :: centre(3), inverse(3, points), lift(3), position(3, points)
      real(wp) :: given(3)
      type(contact_pair_type) :: pair
      type(contact_result_type) :: result

      call begin("enforce, momentum"//which(method))
      call build(method, pair, position, inverse, centre)
      position(3, :) = 0.05_wp*sin(3.0_wp*position(1, :)) + 0.1_wp*position(2, :)
      centre(:) = centre + [0.3_wp, -0.2_wp, -0.2_wp]
      call pair%enforce(position, inverse, dt, centre, result)
      lift(:) = pair%correction%impactor
      given(:) = sum(pair%correction%displacement/inverse, dim=2)
      call check(result%active > 3, "several active rows")
      call check(given, -mass*lift, round_off*mass*norm2(lift), "momentum")
      call check(result%force, mass*lift/dt**2, round_off*mass*norm2(lift)/dt**2, "force")
      call check(result%penetration, 0.0_wp, 1.0e-9_wp, "no penetration remains")
   end subroutine check_momentum

   !> A guide carries the lateral force
   subroutine check_guide(method)
      !> 1 for contact nodes, 2 for the exact sphere
      integer, intent(in) :: method

      real(wp) :: centre(3), inverse(3, points), lift(3), position(3, points)
      type(contact_pair_type) :: pair
      type(contact_result_type) :: result

      call begin("enforce, guided"//which(method))
      call build(method, pair, position, inverse, centre, guided=.true.)
      position(3, :) = 0.1_wp*position(1, :)
      centre(3) = centre(3) - 0.01_wp
      call pair%enforce(position, inverse, dt, centre, result)
      lift(:) = pair%correction%impactor
      call check(lift(:2), spread(0.0_wp, 1, 2), 0.0_wp, "moves along the guide only")
      call check(result%force(1) < 0.0_wp, "lateral force down the slope")
      call check(result%force(3), mass*lift(3)/dt**2, 1.0e-6_wp*result%force(3), &
         & "the axial force moves it")
      call check(sum(pair%correction%displacement(1, :)/inverse(1, :)), -result%force(1)*dt**2, &
         & round_off*abs(result%force(1))*dt**2, "the plate feels the guide")
   end subroutine check_guide

   !> The gap before the run, positive, zero and negative, and with nothing underneath
   subroutine check_initial_gap(method)
      !> 1 for contact nodes, 2 for the exact sphere
      integer, intent(in) :: method

      real(wp) :: centre(3), inverse(3, points), position(3, points)
      type(contact_pair_type) :: pair

      call begin("initial_gap"//which(method))
      call build(method, pair, position, inverse, centre)
      call check(pair%initial_gap(position, centre), 0.0_wp, round_off, "touching")
      call check(pair%initial_gap(position, centre + [0.0_wp, 0.0_wp, 3.0_wp]), 3.0_wp, round_off, &
         & "above")
      call check(pair%initial_gap(position, centre - [0.0_wp, 0.0_wp, 0.1_wp]), -0.1_wp, &
         & round_off, "inside")
      call check(pair%initial_gap(position, -centre) < 0.0_wp, "on the wrong side")
      call check(pair%initial_gap(position, centre + [90.0_wp, 0.0_wp, 0.0_wp]) > radius, "aside")
   end subroutine check_initial_gap

   !> From below against the bottom face all is the mirror image
   subroutine check_bottom(method)
      !> 1 for contact nodes, 2 for the exact sphere
      integer, intent(in) :: method

      real(wp) :: centre(3), inverse(3, points), lift(3), position(3, points)
      real(wp) :: centre_below(3), lift_below(3)
      type(contact_pair_type) :: above, below
      type(contact_result_type) :: result, result_below

      call begin("enforce, bottom face"//which(method))
      call build(method, above, position, inverse, centre)
      call build(method, below, position, inverse, centre_below, side=-1)
      centre(:) = centre + [0.2_wp, 0.1_wp, -0.03_wp]
      centre_below(:) = [centre(1), centre(2), -centre(3)]
      call above%enforce(position, inverse, dt, centre, result)
      lift(:) = above%correction%impactor
      call below%enforce(position, inverse, dt, centre_below, result_below)
      lift_below(:) = below%correction%impactor
      call check(lift_below, [lift(1), lift(2), -lift(3)], round_off, "the impactor")
      call check(below%correction%displacement(3, :), -above%correction%displacement(3, :), &
         & round_off, "the points")
      call check(result_below%active, result%active, "active rows")
   end subroutine check_bottom

   !> A pair with search data does what a new one does, during oblique impact on a moving plate
   subroutine check_memory(method)
      !> 1 for contact nodes, 2 for the exact sphere
      integer, intent(in) :: method

      real(wp) :: centre(3), inverse(3, points), lift(3), position(3, points)
      real(wp) :: flat(3, points), lift_fresh(3), t
      type(contact_pair_type) :: pair, fresh
      type(contact_result_type) :: result, result_fresh
      integer :: pressing, step

      call begin("enforce, memory"//which(method))
      call build(method, pair, flat, inverse, centre)
      pressing = 0
      do step = 1, 150
         t = 0.02_wp*step
         position(:, :) = flat
         position(3, :) = 0.05_wp*sin(4.0_wp*t - 2.0_wp*flat(1, :))*cos(flat(2, :))
         centre(:) = [0.5_wp*t - 0.7_wp, 0.3_wp*t, radius + 0.2_wp*cos(3.0_wp*t)]
         call pair%enforce(position, inverse, dt, centre, result)
         lift(:) = pair%correction%impactor
         call build(method, fresh, flat, inverse, lift_fresh)
         call fresh%enforce(position, inverse, dt, centre, result_fresh)
         lift_fresh(:) = fresh%correction%impactor
         call check(lift, lift_fresh, 1.0e-9_wp, "the impactor")
         call check(maxval(abs(pair%correction%displacement - fresh%correction%displacement)), &
            & 0.0_wp, 1.0e-9_wp, "the points")
         if (result%active > 0) pressing = pressing + 1
      end do
      call check(pressing > 30 .and. pressing < 120, "contact comes and goes")
   end subroutine check_memory

   !> A spacing that makes too many nodes is refused
   subroutine check_spacing()
      type(contact_pair_type) :: pair
      type(contact_setup_type) :: setup
      type(error_type), allocatable :: error
      real(wp) :: position(3, points)
      integer :: facet(9, squares**2)

      call begin("new_contact")
      call flat_surface(squares, position, facet)
      setup%body = ball_body(radius)
      setup%inverse_mass(:) = 1.0_wp/mass
      setup%spacing = 1.0e-4_wp
      call new_contact(pair, setup, facet, position, [0.0_wp, 0.0_wp, radius], error)
      call check_error(error, "SPACING", "too many contact nodes")
   end subroutine check_spacing

   !> A flat plate at height zero and a sphere that touches its middle
   subroutine build(method, pair, position, inverse, centre, guided, side)
      !> 1 for contact nodes, 2 for the exact sphere
      integer, intent(in) :: method
      !> The pair
      type(contact_pair_type), intent(out) :: pair
      !> Surface points and their inverse masses
      real(wp), intent(out) :: position(3, points), inverse(3, points)
      !> Centre of the sphere
      real(wp), intent(out) :: centre(3)
      !> Along z only
      logical, intent(in), optional :: guided
      !> Face of the plate, 1 by default
      integer, intent(in), optional :: side

      type(contact_setup_type) :: setup
      type(error_type), allocatable :: error
      integer :: facet(9, squares**2), f, i

      call flat_surface(squares, position, facet)
      ! masses as 1 to 4 to 16 in each facet
      inverse(:, :) = 0.0_wp
      do f = 1, size(facet, 2)
         do i = 1, 9
            inverse(:, facet(i, f)) = inverse(:, facet(i, f)) + merge(1.0_wp, merge(4.0_wp, &
               & 16.0_wp, i < 9), i < 5)/36.0_wp
         end do
      end do
      inverse(:, :) = 1.0_wp/inverse
      setup%body = ball_body(radius)
      setup%inverse_mass(:) = 1.0_wp/mass
      if (present(guided)) setup%inverse_mass(:2) = merge(0.0_wp, 1.0_wp/mass, guided)
      if (present(side)) setup%side = side
      setup%exact_body = method == 2
      centre(:) = [0.0_wp, 0.0_wp, setup%side*radius]
      call new_contact(pair, setup, facet, position, centre, error)
      call check(.not. allocated(error), "the pair can be built")
   end subroutine build

   !> Name of the discretisation
   function which(method) result(name)
      !> 1 or 2
      integer, intent(in) :: method
      character(:), allocatable :: name

      name = merge(", contact nodes", ", exact sphere ", method == 1)
   end function which

end program test_contact_contact
