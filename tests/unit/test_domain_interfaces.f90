!> Interfaces find their faces, whatever the orders, materials and number of layers.
program test_domain_interfaces
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_domain, only : domain_type
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type
   use plydyn_model_control, only : linear_strain, total_lagrangian
   use plydyn_model_layup, only : faces_apart
   use plydyn_model_material, only : interface_material_type
   use plydyn_model_model, only : model_type
   use groups, only : add_spring_forces, spring_groups
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   !> Normal and shear stiffness of the two materials
   real(wp), parameter :: stiffness(2, 2) = reshape([1000.0_wp, 400.0_wp, 3000.0_wp, 700.0_wp], &
      & [2, 2])
   integer :: k

   ! one family: nineteen layers fill three blocks, and a lane of the last one is open
   call begin("interfaces of one family")
   call test_stack([(2, k=1, 19)], [(1, k=1, 18)], 3)
   call test_stack([(1, k=1, 16)], [(1, k=1, 15)], 2)
   call begin("interfaces of two materials, ties and open faces")
   call test_stack([(1, k=1, 10)], [1, 2, 0, 1, faces_apart, 2, 2, 1, 1], 3)
   call begin("interfaces between families")
   call test_stack([1, 3, 3, 2, 1, 2, 2, 3, 1, 1, 2], [1, 1, 1, 2, 1, 2, 1, 1, 0, 1], 4)
   call test_stack([(1 + mod(k, 2), k=1, 12)], [(1, k=1, 11)], 2)
   call finish()

contains

   !> Layer k moves by k squared times a jump: resultants on both faces of each interface
   subroutine test_stack(order, joint, batches)
      integer, intent(in) :: order(:), joint(:), batches

      type(domain_type) :: domain
      type(model_type) :: model
      type(error_type), allocatable :: error
      real(wp), allocatable :: displacement(:), force(:), history(:)
      real(wp), parameter :: jump(3) = [0.01_wp, -0.02_wp, 0.03_wp]
      real(wp) :: bottom(3), pull(3), top(3)
      integer :: c, kinematics, layer, n

      model = rectangle_model(rectangle_mesh(3, 3, 2, 6.0_wp, 4.0_wp, 0.06_wp), &
         & [(0.0_wp, n=1, size(order))], 0.25_wp, order)
      model%parts(1)%joint(:) = joint
      model%interface_materials = [(interface_material_type(id=n, title="springs", &
         & constants=cohesive_constants_type(stiffness=stiffness(:, n))), n=1, 2)]
      do kinematics = min(linear_strain, total_lagrangian), max(linear_strain, total_lagrangian)
         model%control%kinematics = kinematics
         call build_domain(model, domain, error)
         call check(.not. allocated(error), "the domain is built")
         call check(spring_groups(domain), batches, "they fill as few batches as they can")
         allocate (displacement(domain%columns%freedoms), force(domain%columns%freedoms))
         allocate (history(domain%histories))
         force(:) = 0.0_wp
         ! lanes without a layer are read, too
         displacement(:) = 0.0_wp
         do layer = 1, size(order)
            do c = 1, 3
               do n = 1, order(layer) + 1
                  displacement(places(domain, layer, n, c)) = real(layer**2, wp)*jump(c)
               end do
            end do
         end do
         call add_spring_forces(domain, 1, displacement, history, force)
         do layer = 1, size(joint)
            pull(:) = 0.0_wp
            if (joint(layer) > 0) pull(:) = 24.0_wp*real(2*layer + 1, wp)*jump &
               & *stiffness([2, 2, 1], joint(layer))
            do c = 1, 3
               top(c) = sum(force(places(domain, layer, order(layer) + 1, c)))
               bottom(c) = sum(force(places(domain, layer + 1, 1, c)))
            end do
            call check(top, pull, 1.0e-8_wp, "the lower face is pulled up")
            call check(bottom, -pull, 1.0e-8_wp, "the upper face is pulled down")
         end do
         deallocate (displacement, force, history)
      end do
   end subroutine test_stack

   !> Places of all nodes of a level of a layer
   function places(domain, layer, level, direction)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: layer, level, direction
      integer :: places(domain%columns%nodes)

      integer :: n

      places(:) = domain%columns%freedom(layer, level, direction, [(n, n=1, domain%columns%nodes)])
   end function places

end program test_domain_interfaces
