!> Inertia through the thickness: closed forms, symmetry, momentum, supports, sums.
program test_method_implicit_column_inertia
   use acceleration, only : accelerate_points
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_domain, only : domain_type
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type
   use plydyn_model_control, only : implicit_thickness
   use plydyn_model_layup, only : faces_tied
   use plydyn_model_material, only : interface_material_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : all_planes, bottom_face, support_type
   use plydyn_parallel_thread_team, only : thread_team_type, new_thread_team
   use plydyn_method_forces, only : find_internal_forces
   use plydyn_method_supports, only : add_held_inertia
   use plydyn_state_state, only : motion_sums_type
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   !> Density and stiffness of the plies, their thickness
   real(wp), parameter :: rho = 1.7e-9_wp, ply = 0.25_wp
   !> C33 and the larger transverse shear of IM7/8552: nu13 E3/E1 and nu23 = 1/2 in C33
   real(wp), parameter :: nu31 = 0.34_wp*9.0_wp/165.0_wp
   real(wp), parameter :: determinant = 1.0_wp - 2.0_wp*0.34_wp*nu31 - 0.25_wp &
      & - 2.0_wp*nu31*0.5_wp*0.34_wp
   real(wp), parameter :: c33 = 9.0e3_wp*(1.0_wp - 0.34_wp*nu31)/determinant, g13 = 5.6e3_wp
   !> Springs of interfaces
   real(wp), parameter :: stiffness(2) = [2.0e5_wp, 0.7e5_wp]
   !> Elastic layers have no history
   real(wp) :: history(0)

   call test_two_masses()
   call test_operator([2, 2, 2])
   call test_operator([1, 3, 3])
   call test_sums()
   call test_thickness_vibration()
   call test_held()
   call finish()

contains

   !> Three plies of which the first two stand on springs, the others are tied
   function stack(order, distortion) result(model)
      integer, intent(in) :: order(:)
      real(wp), intent(in) :: distortion
      type(model_type) :: model
      integer :: k

      model = rectangle_model(rectangle_mesh(3, 2, 1, 12.0_wp, 6.0_wp, distortion), &
         & [(60.0_wp*k, k=0, size(order) - 1)], ply, order)
      model%control%scheme = implicit_thickness
      if (size(order) == 1) return
      model%interface_materials = [interface_material_type(id=5, title="springs", &
         & constants=cohesive_constants_type(stiffness=stiffness))]
      model%parts(1)%joint(:) = [1, spread(faces_tied, 1, size(order) - 2)]
   end function stack

   !> The domain of a model
   function built(model) result(domain)
      type(model_type), intent(in) :: model
      type(domain_type) :: domain
      type(error_type), allocatable :: error

      call build_domain(model, domain, error)
      call check(.not. allocated(error), "the domain is built")
   end function built

   !> One layer of order 1: two masses with half of the spring C/h between them, times step squared
   subroutine test_two_masses()
      type(domain_type) :: domain
      type(motion_sums_type) :: sums
      real(wp), allocatable :: a(:), v(:)
      real(wp) :: k
      integer :: c, place(2)

      call begin("two masses")
      domain = built(stack([1], 0.05_wp))
      allocate (a(domain%columns%freedoms), v(domain%columns%freedoms))
      v(:) = 0.0_wp
      do c = 1, 3
         place(:) = [domain%columns%freedom(1, 1, c, 4), domain%columns%freedom(1, 2, c, 4)]
         a(:) = 0.0_wp
         a(place) = domain%inertia%mass(domain%columns%mass_of(1, 1, 4))*[2.0_wp, -5.0_wp]
         call accelerate_points(domain, 0.0_wp, v, a, sums)
         ! added inertia over the mass of one face
         k = 0.5_wp*domain%step**2*merge(c33, g13, c == 3)/ply/(0.5_wp*rho*ply)
         call check(a(place), -1.5_wp + [3.5_wp, -3.5_wp]/(1.0_wp + 2.0_wp*k), 1.0e-12_wp, &
            & "mean as without, difference over 1 + 2 k")
      end do
   end subroutine test_two_masses

   !> The inverse of the inertia is symmetric and positive, and keeps the momentum
   subroutine test_operator(order)
      integer, intent(in) :: order(3)

      type(domain_type) :: domain
      type(motion_sums_type) :: sums
      real(wp), allocatable :: a(:), b(:), force(:, :), v(:)
      integer :: c, i, k

      call begin("operator")
      domain = built(stack(order, 0.05_wp))
      k = domain%columns%freedoms
      allocate (a(k), b(k), v(k), force(k, 2))
      force(:, 1) = [(sin(real(7*i*i, wp)), i=1, k)]*points(domain, order, [1, 2, 3])
      force(:, 2) = [(cos(real(5*i*i, wp)), i=1, k)]*points(domain, order, [1, 2, 3])
      v(:) = 0.0_wp
      a(:) = force(:, 1)
      b(:) = force(:, 2)
      call accelerate_points(domain, 2.0_wp, v, a, sums)
      do c = 1, 3
         call check(sums%momentum(c), sum(force(:, 1)*points(domain, order, [c])), &
            & 1.0e-12_wp*sum(abs(force(:, 1))), "momentum is the impulse of the forces")
      end do
      ! forces on tied points act on both: every force moves its own point
      call check(sums%acceleration_square, dot_product(a, force(:, 1)), &
         & 1.0e-11_wp*sums%acceleration_square, "positive: the work of the forces")
      call accelerate_points(domain, 2.0_wp, v, b, sums)
      call check(dot_product(a, force(:, 2)), dot_product(b, force(:, 1)), &
         & 1.0e-11_wp*sums%acceleration_square, "symmetric")
      do i = 1, 3
         call check(a(domain%columns%freedom(2, order(2) + 1, i, 2)), &
            & a(domain%columns%freedom(3, 1, i, 2)), 0.0_wp, "tied points move as one")
      end do
   end subroutine test_operator

   !> 1 at the points of some directions, else 0
   function points(domain, order, direction) result(is)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: order(:), direction(:)
      real(wp) :: is(domain%columns%freedoms)
      integer :: c, k, n, t

      is(:) = 0.0_wp
      do n = 1, domain%columns%nodes
         do c = 1, size(direction)
            do k = 1, size(order)
               is(domain%columns%freedom(k, [(t, t=1, order(k) + 1)], direction(c), n)) = 1.0_wp
            end do
         end do
      end do
   end function points

   !> Energies of one layer of order 1 against two masses and a spring at every node
   subroutine test_sums()
      type(domain_type) :: domain
      type(motion_sums_type) :: sums
      real(wp), allocatable :: a(:), v(:)
      real(wp) :: added, kinetic, mass
      integer :: c, i, n, place(2)

      call begin("sums")
      domain = built(stack([1], 0.05_wp))
      allocate (a(domain%columns%freedoms), v(domain%columns%freedoms))
      v(:) = [(sin(real(3*i*i, wp)), i=1, size(v))]*points(domain, [1], [1, 2, 3])
      a(:) = [(1.0e-9_wp*cos(real(11*i*i, wp)), i=1, size(a))]*points(domain, [1], [1, 2, 3])
      call accelerate_points(domain, 1.0_wp, v, a, sums)
      v(:) = v + 0.5_wp*a
      added = 0.0_wp
      kinetic = 0.0_wp
      do n = 1, domain%columns%nodes
         mass = domain%inertia%mass(domain%columns%mass_of(1, 1, n))
         do c = 1, 3
            place(:) = [domain%columns%freedom(1, 1, c, n), domain%columns%freedom(1, 2, c, n)]
            kinetic = kinetic + mass*sum(v(place)**2)
            added = added + 0.5_wp*domain%step**2*merge(c33, g13, c == 3)/ply &
               & *mass/(0.5_wp*rho*ply)*(v(place(2)) - v(place(1)))**2
         end do
      end do
      call check(sums%twice_kinetic, kinetic, 1.0e-12_wp*kinetic, "kinetic energy of the points")
      call check(sums%twice_added, added, 1.0e-12_wp*added, "that of the added inertia")
   end subroutine test_sums

   !> A ply that breathes, far beyond its explicit step:
   !> cos(p) = 1 - k/2/(1 + k/2), with k the square of step times frequency
   subroutine test_thickness_vibration()
      integer, parameter :: steps = 40
      type(domain_type) :: domain
      type(model_type) :: model
      type(motion_sums_type) :: sums
      real(wp), allocatable :: a(:), u(:), v(:)
      real(wp) :: k, stretch(0:steps)
      integer :: i, n

      type(thread_team_type) :: team
      call begin("thickness vibration")
      model = stack([1], 0.0_wp)
      model%supports = [support_type(nodes=[(n, n=1, 15)], direction=[.true., .true., .false.], &
         & face=all_planes)]
      domain = built(model)
      allocate (a(domain%columns%forces), u(domain%columns%freedoms), v(domain%columns%freedoms))
      u(:) = 0.0_wp
      v(:) = 0.0_wp
      u(domain%columns%freedom(1, 2, 3, [(n, n=1, 15)])) = 1.0_wp
      do i = 0, steps
         stretch(i) = u(domain%columns%freedom(1, 2, 3, 8)) - u(domain%columns%freedom(1, 1, 3, 8))
         call new_thread_team(domain%chunks%order, domain%chunks%outer, team)
         call find_internal_forces(domain, team, 0.0_wp, u, v, history, a)
         a(domain%supports%held) = 0.0_wp
         call accelerate_points(domain, domain%step, v, a, sums)
         v(:) = v + merge(0.5_wp, 1.0_wp, i == 0)*domain%step*a
         u(:) = u + domain%step*v
      end do
      k = domain%step**2*4.0_wp*c33/(rho*ply**2)
      call check(k > 4.0_wp, "the step is beyond the explicit one")
      call check(stretch, [(cos(i*acos(1.0_wp - 0.5_wp*k/(1.0_wp + 0.5_wp*k))), i=0, steps)], &
         & 1.0e-9_wp, "is that of two masses with added inertia")
   end subroutine test_thickness_vibration

   !> A held face: the other one has its mass and the added inertia, the support feels what is left
   subroutine test_held()
      type(domain_type) :: domain
      type(model_type) :: model
      type(motion_sums_type) :: sums
      real(wp), allocatable :: a(:), v(:)
      real(wp) :: k, mass, support(3)
      integer :: place(2)

      call begin("held")
      model = stack([1], 0.05_wp)
      model%supports = [support_type(nodes=[4, 5, 6], direction=[.false., .false., .true.], &
         & face=bottom_face)]
      domain = built(model)
      allocate (a(domain%columns%freedoms), v(domain%columns%freedoms))
      v(:) = 0.0_wp
      a(:) = 0.0_wp
      support(:) = 0.0_wp
      place(:) = [domain%columns%freedom(1, 1, 3, 5), domain%columns%freedom(1, 2, 3, 5)]
      mass = domain%inertia%mass(domain%columns%mass_of(1, 1, 5))
      a(place(2)) = mass
      call accelerate_points(domain, 2.0_wp, v, a, sums)
      call add_held_inertia(domain, a, support)
      k = 0.5_wp*domain%step**2*c33/ply/(0.5_wp*rho*ply)
      call check(a(place), [0.0_wp, 1.0_wp/(1.0_wp + k)], 1.0e-13_wp, "closed form")
      call check(support, [0.0_wp, mass*k/(1.0_wp + k), 0.0_wp], 1.0e-13_wp*mass, &
         & "the support takes what the added inertia of its column needs")
      call check(sums%momentum(3), mass - sum(support), 1.0e-13_wp*mass, "momentum")
   end subroutine test_held

end program test_method_implicit_column_inertia
