!> Patch tests and rigid motions of the plate kernels, through domain and solver.
program test_method_forces
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_plate_recover, only : layer_values
   use plydyn_element_group, only : ply_stress_at, recovered
   use plydyn_law_ply_elastic, only : elastic_constants_type, orthotropic_type, ply_stiffness, &
      & strain_rotation
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type
   use plydyn_model_control, only : linear_strain, total_lagrangian
   use plydyn_model_layup, only : faces_apart
   use plydyn_model_material, only : interface_material_type
   use plydyn_model_model, only : model_type
   use plydyn_parallel_thread_team, only : thread_team_type, new_thread_team
   use plydyn_method_forces, only : find_internal_forces
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   use groups, only : add_spring_forces, plate_of
   use plydyn_element_plate_group, only : plate_group_type
   implicit none

   !> Displacement gradient of the patch tests
   real(wp), parameter :: gradient(3, 3) = reshape([1.0e-3_wp, 4.0e-4_wp, -2.0e-4_wp, 7.0e-4_wp, &
      & -5.0e-4_wp, 3.0e-4_wp, 6.0e-4_wp, -1.0e-4_wp, 9.0e-4_wp], [3, 3])
   real(wp), parameter :: angles(3) = [30.0_wp, 30.0_wp, 30.0_wp]
   !> Elastic layers have no history
   real(wp) :: history(0)
   integer :: order, side

   do side = 2, 3
      do order = 1, 4
         call test_patch(side, [order, order, order], linear_strain)
         call test_patch(side, [order, order, order], total_lagrangian)
         call test_rigid_motion(side, [order, order, order])
      end do
      call test_patch(side, [1, 3, 2], linear_strain)
      call test_patch(side, [1, 3, 2], total_lagrangian)
   end do
   do order = 1, 4
      call test_law_path(2, order)
      call test_law_path(3, order)
   end do
   call test_interface()
   call finish()

contains

   !> A linear displacement field makes the exact stress, and no force inside of the body
   subroutine test_patch(side, orders, kinematics)
      integer, intent(in) :: side, orders(3), kinematics

      type(thread_team_type) :: team
      type(domain_type) :: domain
      real(wp), allocatable :: displacement(:), force(:)
      real(wp) :: e(3, 3), expected(6), strain(6), values(recovered, side*side, orders(3) + 1)
      integer :: slot(3)

      call begin("patch test")
      call make(side, orders, kinematics, domain)
      displacement = linear_field(domain, gradient)
      allocate (force(size(displacement)))
      force(:) = 0.0_wp
      call new_thread_team(domain%chunks%order, domain%chunks%outer, team)
      call find_internal_forces(domain, team, 0.0_wp, displacement, &
            & 0.0_wp*displacement, history, force)
      call check(largest_inside(domain, force)/maxval(abs(force)) < 1.0e-11_wp, &
         & "no force inside of the body")
      e(:, :) = gradient + transpose(gradient)
      if (kinematics == total_lagrangian) e(:, :) = e + matmul(transpose(gradient), gradient)
      strain(:) = [0.5_wp*e(1, 1), 0.5_wp*e(2, 2), 0.5_wp*e(3, 3), e(1, 2), e(1, 3), e(2, 3)]
      expected(:) = matmul(ply_stiffness([165.0e3_wp, 9.0e3_wp, 9.0e3_wp], &
         & [0.34_wp, 0.34_wp, 0.5_wp], [5.6e3_wp, 5.6e3_wp, 2.8e3_wp]), &
         & matmul(strain_rotation(30.0_wp), strain))
      slot(:) = domain%columns%layer_slot(:, 3)
      values(:, :, :) = layer_values(plate_of(domain, 1), slot(1), slot(2), slot(3), 2, &
         & kinematics == total_lagrangian, displacement, history)
      call check(maxval(abs(values(ply_stress_at + 1:ply_stress_at + 6, :, :) &
         & - spread(spread(expected, 2, side*side), 3, orders(3) + 1))) &
         & < 1.0e-10_wp*maxval(abs(expected)), "the stress in ply axes is exact everywhere")
   end subroutine test_patch

   !> Large rotations make no force with total Lagrangian; small ones none of first order
   subroutine test_rigid_motion(side, orders)
      integer, intent(in) :: side, orders(3)

      type(thread_team_type) :: team
      type(domain_type) :: domain
      real(wp), allocatable :: force(:)
      real(wp), parameter :: c = cos(2.0_wp), s = sin(2.0_wp)
      real(wp), parameter :: rotation(3, 3) = reshape([c, s, 0.0_wp, -s*c, c*c, s, &
         & s*s, -s*c, c], [3, 3])
      real(wp), parameter :: spin(3, 3) = reshape([0.0_wp, 3.0_wp, -2.0_wp, -3.0_wp, 0.0_wp, &
         & 5.0_wp, 2.0_wp, -5.0_wp, 0.0_wp], [3, 3])
      real(wp) :: h(3, 3), scale
      integer :: i

      call begin("rigid motion")
      call make(side, orders, total_lagrangian, domain)
      allocate (force(domain%columns%freedoms))
      h(:, :) = rotation
      do i = 1, 3
         h(i, i) = h(i, i) - 1.0_wp
      end do
      ! the force that a strain of one would make
      force(:) = 0.0_wp
      call new_thread_team(domain%chunks%order, domain%chunks%outer, team)
      call find_internal_forces(domain, team, 0.0_wp, linear_field(domain, gradient), &
            & 0.0_wp*linear_field(domain, gradient), history, force)
      scale = maxval(abs(force))/norm2(gradient)
      force(:) = 0.0_wp
      call new_thread_team(domain%chunks%order, domain%chunks%outer, team)
      call find_internal_forces(domain, team, 0.0_wp, linear_field(domain, h), &
            & 0.0_wp*linear_field(domain, h), history, force)
      call check(maxval(abs(force)) < 1.0e-11_wp*scale, "a large rotation makes no force")

      call make(side, orders, linear_strain, domain)
      force(:) = 0.0_wp
      call new_thread_team(domain%chunks%order, domain%chunks%outer, team)
      call find_internal_forces(domain, team, 0.0_wp, linear_field(domain, spin), &
            & 0.0_wp*linear_field(domain, spin), history, force)
      call check(maxval(abs(force)) < 1.0e-10_wp*scale, "a spin makes no linear strain")
   end subroutine test_rigid_motion

   !> The elastic law point by point gives the forces of the elastic kernels
   subroutine test_law_path(side, order)
      integer, intent(in) :: side, order

      type(thread_team_type) :: team
      type(domain_type) :: domain
      type(error_type), allocatable :: error
      type(model_type) :: model
      real(wp), allocatable :: displacement(:), force(:, :)
      integer :: i, kinematics

      call begin("law path")
      model = rectangle_model(rectangle_mesh(side, 3, 2, 6.0_wp, 4.0_wp, 0.06_wp), &
         & [(real(17*i, wp), i=1, 9)], 0.25_wp, spread(order, 1, 9))
      do kinematics = linear_strain, total_lagrangian
         model%control%kinematics = kinematics
         call build_domain(model, domain, error)
         call check(.not. allocated(error), "the domain is built")
         displacement = 1.0e-2_wp*sin(real([(i, i=1, domain%columns%freedoms)], wp))
         allocate (force(domain%columns%freedoms, 2))
         force(:, :) = 0.0_wp
         call new_thread_team(domain%chunks%order, domain%chunks%outer, team)
         call find_internal_forces(domain, team, 0.0_wp, displacement, &
            & 0.0_wp*displacement, history, force(:, 1))
         call set_laws(domain)
         call new_thread_team(domain%chunks%order, domain%chunks%outer, team)
         call find_internal_forces(domain, team, 0.0_wp, displacement, &
            & 0.0_wp*displacement, history, force(:, 2))
         call check(maxval(abs(force(:, 2) - force(:, 1))) < 1.0e-12_wp*maxval(abs(force)), &
            & "the elastic law point by point gives the same forces")
         deallocate (force)
      end do
   end subroutine test_law_path

   !> Give all layers the elastic law as a law of their own
   subroutine set_laws(domain)
      type(domain_type), intent(inout) :: domain

      type(elastic_constants_type) :: ply
      type(orthotropic_type) :: law
      integer :: b, l

      ply%young = [165.0e3_wp, 9.0e3_wp, 9.0e3_wp]
      ply%poisson = [0.34_wp, 0.34_wp, 0.5_wp]
      ply%shear = [5.6e3_wp, 5.6e3_wp, 2.8e3_wp]
      select type (group => domain%groups(1)%item)
      type is (plate_group_type)
         associate (batch => group%plate%batches(1))
            deallocate (batch%laws)
            allocate (batch%laws(batch%blocks))
            do b = 1, batch%blocks
               law = orthotropic_type()
               do l = 1, lanes
                  if (batch%layer(l, b) == 0) cycle
                  call ply%set_lane(l, law)
               end do
               batch%laws(b)%block = b
               allocate (batch%laws(b)%law, source=law)
            end do
         end associate
      end select
   end subroutine set_laws

   !> Springs pull the faces of two plies together: resultants of a uniform jump
   subroutine test_interface()
      type(domain_type) :: domain
      type(error_type), allocatable :: error
      type(model_type) :: model
      real(wp), allocatable :: displacement(:), force(:), history(:)
      real(wp), parameter :: jump(3) = [0.01_wp, -0.02_wp, 0.03_wp]
      real(wp) :: total(3)
      integer :: c, n

      call begin("elastic interface")
      model = rectangle_model(rectangle_mesh(3, 3, 2, 6.0_wp, 4.0_wp, 0.06_wp), &
         & [0.0_wp, 90.0_wp], 0.25_wp, [2, 1])
      model%parts(1)%joint(1) = 1
      model%interface_materials = [interface_material_type(id=7, title="springs", &
         & constants=cohesive_constants_type(stiffness=[1000.0_wp, 400.0_wp]))]
      call build_domain(model, domain, error)
      call check(.not. allocated(error), "the domain is built")
      allocate (displacement(domain%columns%freedoms), force(domain%columns%freedoms))
      displacement(:) = 0.0_wp
      force(:) = 0.0_wp
      do c = 1, 3
         displacement(domain%columns%freedom(2, 1, c, [(n, n=1, domain%columns%nodes)])) = jump(c)
      end do
      allocate (history(domain%histories))
      call add_spring_forces(domain, 1, displacement, history, force)
      do c = 1, 3
         total(c) = sum(force(domain%columns%freedom(1, 3, c, [(n, n=1, domain%columns%nodes)])))
      end do
      call check(total, 24.0_wp*[400.0_wp, 400.0_wp, 1000.0_wp]*jump, 1.0e-10_wp, &
         & "stiffness times area times jump acts on the lower face")
      call check(sum(force), 0.0_wp, 1.0e-10_wp, "and its opposite on the upper")
      call check(2.0_wp/domain%limit%step**2*2.0_wp, domain%limit%element_rate &
         & + domain%limit%interface_rate, 1.0e-6_wp*domain%limit%element_rate, &
         & "the springs take part in the stable step")
   end subroutine test_interface

   !> A distorted plate of three plies, the upper two not joined
   subroutine make(side, orders, kinematics, domain)
      integer, intent(in) :: side, orders(3), kinematics
      type(domain_type), intent(out) :: domain

      type(error_type), allocatable :: error
      type(model_type) :: model

      model = rectangle_model(rectangle_mesh(side, 3, 2, 6.0_wp, 4.0_wp, 0.06_wp), angles, &
         & 0.25_wp, orders)
      model%parts(1)%joint(2) = faces_apart
      model%control%kinematics = kinematics
      call build_domain(model, domain, error)
      call check(.not. allocated(error), "the domain is built")
   end subroutine make

   !> Displacement h . x of all points
   function linear_field(domain, h) result(displacement)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: h(3, 3)
      real(wp), allocatable :: displacement(:)

      integer :: k, n, t
      real(wp) :: x(3)

      allocate (displacement(domain%columns%freedoms))
      displacement(:) = 0.0_wp
      do n = 1, domain%columns%nodes
         do k = 1, size(domain%layers%order)
            do t = 1, domain%layers%order(k) + 1
               x(:) = domain%position(:, n)
               x(3) = x(3) + domain%layers%height(k, t)
               displacement(domain%columns%freedom(k, t, [1, 2, 3], n)) = matmul(h, x)
            end do
         end do
      end do
   end function linear_field

   !> Largest force on the points that no stress acts on from outside, both points of a tied face
   !> together
   real(wp) function largest_inside(domain, force) result(largest)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: force(:)

      integer :: c, k, n, t
      real(wp) :: here

      largest = 0.0_wp
      do n = 1, domain%columns%nodes
         if (is_border(domain%position(:, n))) cycle
         do c = 1, 3
            here = force(domain%columns%freedom(1, domain%layers%order(1) + 1, c, n)) &
               & + force(domain%columns%freedom(2, 1, c, n))
            largest = max(largest, abs(here))
            do k = 1, size(domain%layers%order)
               do t = 2, domain%layers%order(k)
                  largest = max(largest, abs(force(domain%columns%freedom(k, t, c, n))))
               end do
            end do
         end do
      end do
   end function largest_inside

   !> Whether a node lies on the border
   pure logical function is_border(x)
      real(wp), intent(in) :: x(3)

      is_border = any(abs(x(1:2)*(x(1:2) - [6.0_wp, 4.0_wp])) < 1.0e-9_wp)
   end function is_border

end program test_method_forces
