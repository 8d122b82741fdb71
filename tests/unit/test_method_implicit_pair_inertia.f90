!> Inertia across interfaces: closed forms, symmetry, momentum, and what it does to springs.
program test_method_implicit_pair_inertia
   use acceleration, only : accelerate_points
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_domain, only : domain_type
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type
   use plydyn_model_control, only : implicit_interfaces, total_lagrangian
   use plydyn_model_layup, only : faces_tied
   use plydyn_model_material, only : interface_material_type
   use plydyn_model_model, only : model_type
   use groups, only : add_spring_forces
   use plydyn_state_state, only : motion_sums_type
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: stiffness(2) = [2.0e5_wp, 0.7e5_wp], share = 0.5_wp
   !> Springs have no history
   real(wp) :: history(0)

   call test_two_masses(2, 2)
   call test_two_masses(2, 1)
   call test_operator()
   call test_sums()
   call test_period()
   call test_step()
   call finish()

contains

   !> Three plies of which the first two stand on springs
   function spring_model(order, scheme, distortion) result(model)
      integer, intent(in) :: order(3), scheme
      real(wp), intent(in) :: distortion
      type(model_type) :: model

      model = rectangle_model(rectangle_mesh(3, 2, 1, 2.0_wp, 1.0_wp, distortion), &
         & [0.0_wp, 60.0_wp, 60.0_wp], 0.25_wp, order)
      model%interface_materials = [interface_material_type(id=5, title="springs", &
         & constants=cohesive_constants_type(stiffness=stiffness))]
      model%parts(1)%joint(:) = [1, faces_tied]
      model%control%scheme = scheme
   end function spring_model

   !> The domain of that model
   function spring_domain(order) result(domain)
      integer, intent(in) :: order(3)
      type(domain_type) :: domain
      type(error_type), allocatable :: error

      call build_domain(spring_model(order, implicit_interfaces, 0.05_wp), domain, error)
      call check(.not. allocated(error), "the domain is built")
   end function spring_domain

   !> Accelerations of a pair are those of the inverse of its 2 x 2 inertia, in any direction,
   !> whether its layers lie side by side or not
   subroutine test_two_masses(below, above)
      integer, intent(in) :: below, above

      type(domain_type) :: domain
      type(motion_sums_type) :: sums
      real(wp), allocatable :: a(:), v(:)
      real(wp) :: added, inverse(2, 2), m(2)
      integer :: c, n, place(2)

      call begin("two masses")
      domain = spring_domain([below, above, above])
      allocate (a(domain%columns%freedoms), v(domain%columns%freedoms))
      n = 3
      do c = 1, 3
         place(:) = [domain%columns%freedom(1, below + 1, c, n), &
            & domain%columns%freedom(2, 1, c, n)]
         m(:) = domain%inertia%mass([domain%columns%mass_of(1, below + 1, n), &
            & domain%columns%mass_of(2, 1, n)])
         ! area by mass: a face has 1/2 or 1/6 of its layer
         added = share*domain%step**2*stiffness(merge(1, 2, c == 3)) &
            & *m(1)/(1.7e-9_wp*0.25_wp)*merge(2.0_wp, 6.0_wp, below == 1)
         inverse(:, :) = reshape([m(2) + added, added, added, m(1) + added], [2, 2]) &
            & /(m(1)*m(2) + added*sum(m))
         a(:) = 0.0_wp
         v(:) = 0.0_wp
         a(place) = [2.0_wp, -5.0_wp]
         call accelerate_points(domain, 0.0_wp, v, a, sums)
         call check(a(place)*m, matmul(inverse, [2.0_wp, -5.0_wp])*m, 1.0e-13_wp, &
            & "in closed form")
         a(place) = 0.0_wp
         call check(maxval(abs(a)), 0.0_wp, 0.0_wp, "no other point feels it")
      end do
   end subroutine test_two_masses

   !> The inverse of the inertia is symmetric and positive, and keeps the momentum
   subroutine test_operator()
      type(domain_type) :: domain
      type(motion_sums_type) :: sums
      real(wp), allocatable :: a(:), b(:), force(:, :), v(:)
      integer :: i, k

      call begin("operator")
      domain = spring_domain([2, 2, 2])
      k = domain%columns%freedoms
      allocate (a(k), b(k), v(k), force(k, 2))
      force(:, 1) = [(sin(real(7*i*i, wp)), i=1, k)]
      force(:, 2) = [(cos(real(5*i*i, wp)), i=1, k)]
      do i = 1, 2
         where (.not. is_point(domain)) force(:, i) = 0.0_wp
      end do
      v(:) = 0.0_wp
      a(:) = force(:, 1)
      b(:) = force(:, 2)
      call accelerate_points(domain, 2.0_wp, v, a, sums)
      do i = 1, 3
         call check(sums%momentum(i), sum(force(:, 1), along(domain, i)), &
            & 1.0e-13_wp*sum(abs(force(:, 1))), "momentum is the impulse of the forces")
      end do
      call check(sums%acceleration_square, dot_product(a, force(:, 1)), &
         & 1.0e-12_wp*sums%acceleration_square, "positive: the work of the forces")
      call accelerate_points(domain, 2.0_wp, v, b, sums)
      call check(dot_product(a, force(:, 2)), dot_product(b, force(:, 1)), &
         & 1.0e-12_wp*sums%acceleration_square, "symmetric")
   end subroutine test_operator

   !> Sums of the energies against those of the points one by one
   subroutine test_sums()
      type(domain_type) :: domain
      type(motion_sums_type) :: sums
      real(wp), allocatable :: a(:), v(:)
      real(wp) :: added, kinetic
      integer :: c, i, n, place(2)

      call begin("sums")
      domain = spring_domain([2, 2, 2])
      allocate (a(domain%columns%freedoms), v(domain%columns%freedoms))
      v(:) = [(sin(real(3*i*i, wp)), i=1, size(v))]
      a(:) = [(1.0e-7_wp*cos(real(11*i*i, wp)), i=1, size(a))]
      where (.not. is_point(domain))
         v = 0.0_wp
         a = 0.0_wp
      end where
      call accelerate_points(domain, 1.0_wp, v, a, sums)
      v(:) = v + 0.5_wp*a
      kinetic = sum(spread_mass(domain)*v**2)
      added = 0.0_wp
      do n = 1, domain%columns%nodes
         do c = 1, 3
            place(:) = [domain%columns%freedom(1, 3, c, n), domain%columns%freedom(2, 1, c, n)]
            added = added + share*domain%step**2*stiffness(merge(1, 2, c == 3))*6.0_wp &
               & *domain%inertia%mass(domain%columns%mass_of(2, 1, n))/(1.7e-9_wp*0.25_wp) &
               & *(v(place(2)) - v(place(1)))**2
         end do
      end do
      call check(sums%twice_kinetic, kinetic, 1.0e-12_wp*kinetic, "kinetic energy of the points")
      call check(sums%twice_added, added, 1.0e-12_wp*added, "that of the added inertia")
   end subroutine test_sums

   !> Springs alone at many times their critical step: two masses whose discrete period is
   !> cos(p) = 1 - k/2/(1 + k/2), with k the square of step times frequency
   subroutine test_period()
      integer, parameter :: steps = 50
      type(domain_type) :: domain
      type(error_type), allocatable :: error
      type(motion_sums_type) :: sums
      real(wp), allocatable :: a(:), u(:), v(:)
      real(wp) :: k, opening(0:steps)
      integer :: i, n

      call begin("period")
      ! on rectangles the areas of Gauss points and nodes move alike
      call build_domain(spring_model([2, 2, 2], implicit_interfaces, 0.0_wp), domain, error)
      allocate (a(domain%columns%freedoms), u(domain%columns%freedoms), v(domain%columns%freedoms))
      u(:) = 0.0_wp
      v(:) = 0.0_wp
      do n = 1, domain%columns%nodes
         u(domain%columns%freedom(2, 1, 3, n)) = 1.0_wp
      end do
      do i = 0, steps
         opening(i) = u(domain%columns%freedom(2, 1, 3, 8)) - u(domain%columns%freedom(1, 3, 3, 8))
         a(:) = 0.0_wp
         call add_spring_forces(domain, 1, u, history, a)
         call accelerate_points(domain, domain%step, v, a, sums)
         v(:) = v + merge(0.5_wp, 1.0_wp, i == 0)*domain%step*a
         u(:) = u + domain%step*v
      end do
      ! both faces have 1/6 of the mass of their plies
      k = domain%step**2*stiffness(1)*12.0_wp/(1.7e-9_wp*0.25_wp)
      call check(k > 4.0_wp, "the step is beyond that of explicit springs")
      call check(opening, [(cos(i*acos(1.0_wp - 0.5_wp*k/(1.0_wp + 0.5_wp*k))), i=0, steps)], &
         & 1.0e-9_wp, "is that of two masses with added inertia")
   end subroutine test_period

   !> The step is that of the plies; so is that of large displacement, whatever the turn
   subroutine test_step()
      type(domain_type) :: domain
      type(error_type), allocatable :: error
      type(model_type) :: model

      call begin("step")
      domain = spring_domain([2, 2, 2])
      call check(domain%limit%step, 2.0_wp/sqrt(domain%limit%element_rate), &
         & 1.0e-12_wp*domain%limit%step, "interfaces do not bound it")
      model = spring_model([2, 2, 2], implicit_interfaces, 0.05_wp)
      model%control%kinematics = total_lagrangian
      model%control%largest_step = 1.0e-9_wp
      call build_domain(model, domain, error)
      call check(domain%step, 1.0e-9_wp, 0.0_wp, "nor is it larger than the deck allows")
      call check(maxval(domain%inertia%pairs%inertia), minval(domain%inertia%pairs%inertia), &
         & 0.0_wp, &
         & "springs that turn have one inertia in all directions")
      call check(minval(domain%inertia%pairs%inertia), 0.5e-18_wp*maxval(stiffness), &
         & 1.0e-12_wp*maxval(domain%inertia%pairs%inertia), &
         & "that of the stiffer one, for this step")
   end subroutine test_step

   !> Whether a place in the arrays of motion is a point of a layer without a tie: ply 1, or the
   !> lower levels of ply 2
   function is_point(domain) result(is)
      type(domain_type), intent(in) :: domain
      logical :: is(domain%columns%freedoms)
      integer :: c, n

      is(:) = .false.
      do n = 1, domain%columns%nodes
         do c = 1, 3
            is(domain%columns%freedom(1, [1, 2, 3], c, n)) = .true.
            is(domain%columns%freedom(2, [1, 2], c, n)) = .true.
         end do
      end do
   end function is_point

   !> Whether a place in the arrays of motion is one along x, y or z
   function along(domain, direction) result(is)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: direction
      logical :: is(domain%columns%freedoms)
      integer :: k, n

      is(:) = .false.
      do n = 1, domain%columns%nodes
         do k = 1, 3
            is(domain%columns%freedom(k, [1, 2, 3], direction, n)) = .true.
         end do
      end do
   end function along

   !> Mass at each place in the arrays of motion
   function spread_mass(domain) result(mass)
      type(domain_type), intent(in) :: domain
      real(wp) :: mass(domain%columns%freedoms)
      integer :: c, k, n

      mass(:) = 0.0_wp
      do n = 1, domain%columns%nodes
         do c = 1, 3
            do k = 1, 3
               mass(domain%columns%freedom(k, [1, 2, 3], c, n)) = &
                  & domain%inertia%mass(domain%columns%mass_of(k, [1, 2, 3], n))
            end do
         end do
      end do
   end function spread_mass

end program test_method_implicit_pair_inertia
