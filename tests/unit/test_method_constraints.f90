!> Linear constraints: accelerations without a part along the sum, and sums that are led.
program test_method_constraints
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_constraints, only : add_constraint_power, begin_constraints, &
      & constrain_forces, constraint_work_type, lead_constraints, new_constraint_work
   use plydyn_method_energy, only : global_reduction_type
   use plydyn_model_support, only : all_planes, constraint_term_type, constraint_type, &
      & prescribes_displacement, top_face
   use plydyn_model_curve, only : curve_type
   use plydyn_model_model, only : model_type
   use plydyn_state_state, only : state_type
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   !> Coefficients of a lever between points of the top face, and of means over the thickness
   real(wp), parameter :: lever(3) = [-0.4_wp, 1.4_wp, 0.3_wp], means(2) = [2.0_wp, -1.0_wp]
   !> What leads the lever: a displacement that grows at this speed
   real(wp), parameter :: speed = 3.0_wp, round_off = 1.0e-12_wp

   type(constraint_work_type) :: work
   type(domain_type) :: domain
   type(error_type), allocatable :: error
   type(global_reduction_type) :: reduction
   type(model_type) :: model
   type(state_type) :: state
   real(wp), allocatable :: before(:)
   real(wp) :: kinetic
   integer :: i

   model = rectangle_model(rectangle_mesh(3, 2, 1, 10.0_wp, 5.0_wp, 0.1_wp), [0.0_wp, 90.0_wp], &
      & 0.5_wp, [2, 2])
   model%curves = [model%curves, curve_type(id=9, x=[0.0_wp, 1.0_wp], y=[0.0_wp, 1.0_wp])]
   deallocate (model%constraints)
   allocate (model%constraints(2))
   model%constraints(1) = constraint_type(id=5, quantity=prescribes_displacement, curve=2, &
      & scale=speed, terms=[constraint_term_type(1, 3, top_face, lever(1)), &
      & constraint_term_type(8, 3, top_face, lever(2)), &
      & constraint_term_type(15, 2, top_face, lever(3))])
   model%constraints(2) = constraint_type(id=6, terms=[constraint_term_type(4, 1, all_planes, &
      & means(1)), constraint_term_type(9, 1, all_planes, means(2))])
   call build_domain(model, domain, error)
   call check(.not. allocated(error), "is built")
   work = new_constraint_work(domain)
   allocate (state%velocity(domain%columns%freedoms))
   state%velocity(:) = [(sin(real(i, wp)), i=1, size(state%velocity))]
   state%displacement = 0.0_wp*state%velocity
   state%acceleration = 100.0_wp*cos(3.0_wp*state%velocity)
   call begin_constraints(domain, state%velocity, state%supports%constraints)

   call begin("begin_constraints")
   call check(state%supports%constraints%rate, &
      & [led_sum(state%velocity), sum_of_means(state%velocity)], round_off, "rates of the sums")
   call check(state%supports%constraints%displacement, [0.0_wp, 0.0_wp], 0.0_wp, "no displacement")

   call begin("constrain_forces")
   before = state%acceleration
   call constrain_forces(domain, state%acceleration, state%supports%constraints, work)
   before(:) = state%acceleration - before
   associate (a => accelerations(state%acceleration))
      call check(led_sum(a), 0.0_wp, round_off*maxval(abs(a)), "the sum does not accelerate")
      call check(sum_of_means(a), 0.0_wp, round_off*maxval(abs(a)), "nor that of means")
   end associate
   call check(count(abs(before) > 0.0_wp), 3 + 2*6, "forces on the points of the terms alone")
   call check(before(place(8, 3)), lever(2)*state%supports%constraints%force(1), &
      & round_off*1.0e2_wp, "the multiplier times the coefficient")
   call check(sum(before, mask_of(4, 1)), means(1)*state%supports%constraints%force(2), &
      & round_off*1.0e2_wp, "shared by the thickness")
   call check(dot_product(before, state%velocity), &
      & dot_product(state%supports%constraints%force, state%supports%constraints%rate), &
      & round_off*1.0e4_wp, "power along the rates")

   call begin("lead_constraints")
   state%step = 1.0e-3_wp
   state%step_before = state%step
   call reduction%clear()
   kinetic = kinetic_energy(state%velocity)
   call lead_constraints(domain, state, work, reduction)
   call check(led_sum(state%velocity), speed, round_off, "the rate of the curve")
   call check(led_sum(state%displacement), &
      & led_sum(state%step*(state%velocity - start_velocity())), round_off, &
      & "the displacement follows the velocity")
   call check(sum_of_means(state%velocity), 0.0_wp, round_off, "no rate without a curve")
   call check(reduction%prescribed_work%value(), kinetic_energy(state%velocity) - kinetic, &
      & round_off*kinetic, "work into the motion")
   call add_constraint_power(domain, state%supports%constraints, reduction%external_power_after)
   call check(reduction%external_power_after%value(), state%supports%constraints%force(1)*speed, &
      & round_off*1.0e4_wp, "only what is led does work")
   call finish()

contains

   !> Place of a point of the top face in the arrays of motion
   integer function place(node, direction)
      integer, intent(in) :: node, direction

      place = domain%columns%freedom(2, 3, direction, node)
   end function place

   !> The sum of the lever
   real(wp) function led_sum(values)
      real(wp), intent(in) :: values(:)

      led_sum = lever(1)*values(place(1, 3)) + lever(2)*values(place(8, 3)) &
         & + lever(3)*values(place(15, 2))
   end function led_sum

   !> The sum of the means
   real(wp) function sum_of_means(values)
      real(wp), intent(in) :: values(:)

      sum_of_means = means(1)*mean(values, 4, 1) + means(2)*mean(values, 9, 1)
   end function sum_of_means

   !> Mean over the points above a node by their masses
   real(wp) function mean(values, node, direction)
      real(wp), intent(in) :: values(:)
      integer, intent(in) :: node, direction

      real(wp) :: mass, whole
      integer :: k, t

      mean = 0.0_wp
      whole = 0.0_wp
      do k = 1, 2
         do t = 1, 3
            mass = domain%inertia%mass(domain%columns%mass_of(k, t, node))
            mean = mean + mass*values(domain%columns%freedom(k, t, direction, node))
            whole = whole + mass
         end do
      end do
      mean = mean/whole
   end function mean

   !> Points above a node, as places in the arrays of motion
   function mask_of(node, direction) result(mask)
      integer, intent(in) :: node, direction
      logical :: mask(size(state%velocity))

      integer :: k, t

      mask(:) = .false.
      do k = 1, 2
         do t = 1, 3
            mask(domain%columns%freedom(k, t, direction, node)) = .true.
         end do
      end do
   end function mask_of

   !> Forces over masses, each point by itself
   function accelerations(force) result(a)
      real(wp), intent(in) :: force(:)
      real(wp) :: a(size(state%velocity))

      a(:) = force(:size(a))*masses(inverse=.true.)
   end function accelerations

   !> Mass of each place in the arrays of motion, or its inverse
   function masses(inverse) result(mass)
      logical, intent(in) :: inverse
      real(wp) :: mass(size(state%velocity))

      integer :: c, k, n, t

      mass(:) = 0.0_wp
      do n = 1, domain%columns%nodes
         do k = 1, 2
            do t = 1, 3
               do c = 1, 3
                  associate (m => domain%inertia%mass(domain%columns%mass_of(k, t, n)))
                     mass(domain%columns%freedom(k, t, c, n)) = merge(1.0_wp/m, m, inverse)
                  end associate
               end do
            end do
         end do
      end do
   end function masses

   !> Kinetic energy of all points
   real(wp) function kinetic_energy(velocity)
      real(wp), intent(in) :: velocity(:)

      kinetic_energy = 0.5_wp*sum(masses(inverse=.false.)*velocity**2)
   end function kinetic_energy

   !> Velocity that the test begins with
   function start_velocity() result(velocity)
      real(wp) :: velocity(size(state%velocity))
      integer :: i

      velocity(:) = [(sin(real(i, wp)), i=1, size(velocity))]
   end function start_velocity

end program test_method_constraints
