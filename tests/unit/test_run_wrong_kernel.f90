!> Kernels that are wrong on purpose: the balance of the scheme stays closed, and the guard on the
!> stored energy stops the run.
program test_run_wrong_kernel
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type
   use plydyn_law_metal_kinematic, only : kinematic_constants_type
   use plydyn_method_observer, only : observer_type, observers_type
   use plydyn_model_control, only : total_lagrangian
   use plydyn_model_layup, only : faces_tied
   use plydyn_model_material, only : interface_material_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : initial_velocity_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_run_loop, only : run
   use plydyn_run_setup, only : run_type, set_up
   use plydyn_run_stability_monitor, only : new_balance_monitor
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, check_error, finish
   use wrong_plates, only : spoil
   implicit none

   !> Share by which forces are wrong: too small, so that the step stays stable
   real(wp), parameter :: wrong = -0.5_wp
   !> Share of the energy that may be missing
   real(wp), parameter :: limit = 0.01_wp
   !> Length of the plate, and speed of one end
   real(wp), parameter :: length = 12.0_wp, speed = 2.0e4_wp
   character(*), parameter :: stopped = "given back more energy than they took"

   call test("elastic", metal=.false., springs=.false., large=.false.)
   call test("large displacement", metal=.false., springs=.false., large=.true.)
   call test("metal", metal=.true., springs=.false., large=.false.)
   call test("springs", metal=.false., springs=.true., large=.true.)
   call finish()

contains

   !> A model that is right, and the same with wrong forces
   subroutine test(name, metal, springs, large)
      character(*), intent(in) :: name
      !> Plies yield; springs between them; large displacement
      logical, intent(in) :: metal, springs, large

      type(error_type), allocatable :: error
      type(model_type) :: model
      real(wp) :: balance

      call begin(name)
      model = moving_plate(metal, springs, large)
      call run_model(model, 0.0_wp, springs, balance, error)
      call check(.not. allocated(error), "right forces run to their end")
      call run_model(model, wrong, springs, balance, error)
      call check(balance, 0.0_wp, 1.0e-9_wp, "the balance of the scheme sees nothing")
      call check_error(error, stopped, "the guard stops wrong ones")
   end subroutine test

   !> A plate, one end of which flies off and upwards
   function moving_plate(metal, springs, large) result(model)
      logical, intent(in) :: metal, springs, large
      type(model_type) :: model

      integer :: i

      model = rectangle_model(rectangle_mesh(3, 3, 2, length, 8.0_wp, 0.0_wp), [0.0_wp, 90.0_wp], &
         & 0.5_wp, [1, 2])
      if (metal) then
         deallocate (model%materials(1)%law)
         allocate (model%materials(1)%law, source=kinematic_constants_type( &
            & young=spread(70.0e3_wp, 1, 3), poisson=spread(0.3_wp, 1, 3), &
            & shear=spread(70.0e3_wp/2.6_wp, 1, 3), yield=20.0_wp))
      end if
      model%parts(1)%joint(:) = faces_tied
      if (springs) then
         model%interface_materials = [interface_material_type(id=1, title="springs", &
            & constants=cohesive_constants_type(stiffness=[2.0e4_wp, 5.0e3_wp]))]
         model%parts(1)%joint(:) = 1
      end if
      if (large) model%control%kinematics = total_lagrangian
      model%initial_velocities = [initial_velocity_type(pack([(i, i=1, size(model%mesh%node_id))], &
         & model%mesh%position(1, :) > 0.6_wp*length), [speed, 0.0_wp, 0.5_wp*speed])]
      model%control%energy_limit = limit
      model%control%end_time = 2.0e-5_wp
   end function moving_plate

   !> Build, make the forces wrong, and run
   subroutine run_model(model, share, springs, balance, error)
      type(model_type), intent(in) :: model
      !> Share by which forces are wrong
      real(wp), intent(in) :: share
      !> Those of springs instead of those of plies
      logical, intent(in) :: springs
      !> Error of the energy balance of the scheme at the end
      real(wp), intent(out) :: balance
      type(error_type), allocatable, intent(out) :: error

      class(observer_type), allocatable :: monitor
      type(comm_type) :: alone
      type(observers_type) :: observers
      type(run_type) :: parts

      parts%model = model
      call set_up(alone, parts, error)
      call observers%start("test_run_wrong_kernel")
      allocate (monitor, source=new_balance_monitor())
      call observers%add(monitor)
      call spoil(parts%domain, interfaces=springs, stiffer=share)
      call run(parts, observers, error)
      balance = parts%state%energies%error()
   end subroutine run_model

end program test_run_wrong_kernel
