!> An impact from the first step to the last: momentum, energy, guards.
program test_run_loop
   use ball, only : ball_body
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_control, only : all_explicit, implicit_thickness, total_lagrangian
   use plydyn_model_body, only : contact_type, impactor_type, nodes_on_impactor, &
      & points_on_plate
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : top_face
   use plydyn_io_job, only : job_type
   use plydyn_state_file_positions, only : new_file_positions
   use plydyn_parallel_comm, only : comm_type
   use plydyn_parallel_thread_team, only : new_thread_team, thread_team_type
   use plydyn_run_loop, only : run
   use plydyn_method_forces, only : find_internal_forces
   use plydyn_method_accelerations, only : begin_accelerations
   use plydyn_method_central_difference, only : predict
   use plydyn_method_energy, only : global_reduction_type
   use plydyn_method_observer, only : observers_type
   use plydyn_method_workspace, only : new_workspace, workspace_type
   use plydyn_run_observers, only : make_observers
   use plydyn_run_setup, only : run_type, set_up
   use plydyn_state_state, only : state_type
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, check_error, finish
   implicit none

   real(wp), parameter :: mass = 2.0e-5_wp, speed = 2000.0_wp

   call test_impact(nodes_on_impactor, 2, all_explicit)
   call test_impact(points_on_plate, 2, all_explicit)
   call test_impact(points_on_plate, 1, all_explicit)
   call test_impact(nodes_on_impactor, 2, implicit_thickness)
   call test_impact(points_on_plate, 1, implicit_thickness)
   call test_unstable()
   call test_last_steps()
   call test_bound()
   call finish()

contains

   !> A sphere hits a free plate and leaves it again
   subroutine test_impact(method, order, scheme)
      integer, intent(in) :: method, order, scheme

      type(error_type), allocatable :: error
      type(model_type) :: model
      type(state_type) :: state

      call begin("impact")
      model = impact_model(method, order)
      model%control%scheme = scheme
      call run_model(model, state, error)
      call check(.not. allocated(error), "runs to its end")
      associate (e => state%energies)
         call check(e%momentum(3), -mass*speed, 1.0e-12_wp*mass*speed, "keeps the momentum along z")
         call check(e%momentum(1:2), [0.0_wp, 0.0_wp], 1.0e-12_wp*mass*speed, "and across")
         call check(e%error(), 0.0_wp, 5.0e-3_wp, "keeps the energy within half a percent")
         call check(e%contact >= -1.0e-12_wp*e%start, "contact makes no energy")
         call check(e%contact < 0.05_wp*e%start, "and takes little")
         call check(state%impactors(1)%velocity(3) > -speed, "the sphere was slowed down")
         call check(e%internal, stored_energy(model, state), 1.0e-9_wp*e%start, &
            & "the work of the inner forces is the strain energy of the state")
      end associate
      call check(maxval(abs(tie_gap(state, model))), 0.0_wp, 0.0_wp, &
         & "both points of tied faces have the same motion to the last bit")
   end subroutine test_impact

   !> A step above the stable one is stopped by the guard
   subroutine test_unstable()
      type(error_type), allocatable :: error
      type(model_type) :: model
      type(state_type) :: state

      call begin("guard")
      model = impact_model(points_on_plate, 2)
      model%control%step_factor = 1.5_wp
      model%control%kinematics = total_lagrangian
      call run_model(model, state, error)
      call check_error(error, "cycle", "an unstable run is stopped at some cycle")
   end subroutine test_unstable

   !> A rest that is shorter than a step is shared by the last two steps
   subroutine test_last_steps()
      integer, parameter :: whole = 40
      real(wp), parameter :: rest = 1.0e-3_wp
      type(error_type), allocatable :: error
      type(model_type) :: model
      type(state_type) :: state

      call begin("last steps")
      model = impact_model(points_on_plate, 1)
      call run_model(model, state, error)
      model%control%end_time = (real(whole, wp) + rest)*state%first_step
      call run_model(model, state, error)
      call check(state%cycle, whole + 1, "as many as a cut one would make")
      call check(state%step_before, 0.5_wp*(1.0_wp + rest)*state%first_step, &
         & 1.0e-9_wp*state%first_step, "but two of half the length")
      call check(state%time, model%control%end_time, 1.0e-12_wp*state%time, "and the end on time")
   end subroutine test_last_steps

   !> No point moves faster over the next step than the bound, in contact or not, implicit or not
   subroutine test_bound()
      integer, parameter :: schemes(2) = [all_explicit, implicit_thickness]
      type(domain_type) :: domain
      type(error_type), allocatable :: error
      type(model_type) :: model
      type(global_reduction_type) :: reduction
      type(state_type) :: state
      type(workspace_type) :: work
      integer :: cycles, k
      real(wp) :: before, most

      call begin("speed_bound")
      do k = 1, size(schemes)
         do cycles = 2, 32, 6
            model = impact_model(points_on_plate, 2)
            model%control%scheme = schemes(k)
            model%control%end_cycle = cycles
            call run_model(model, state, error)
            call build_domain(model, domain, error)
            call begin_accelerations(domain, state, reduction)
            before = maxval(abs(state%velocity))
            state%step = domain%step
            call new_workspace(domain, state, work)
            call predict(domain, work, state)
            call work%team%signal_contact()
            most = maxval(abs(state%velocity))
            call check(most <= reduction%speed_bound, "no component is larger than the bound")
            ! step times acceleration is the difference between two velocities
            call check(reduction%speed_bound <= 1.0001_wp*(2.0_wp*before + most), &
               & "nor is that far off")
         end do
      end do
   end subroutine test_bound

   !> A free plate and a sphere above its middle
   function impact_model(method, order) result(model)
      integer, intent(in) :: method, order
      type(model_type) :: model

      model = rectangle_model(rectangle_mesh(3, 6, 6, 30.0_wp, 30.0_wp, 0.01_wp), &
         & [0.0_wp, 90.0_wp, 90.0_wp, 0.0_wp], 0.25_wp, [order, order, order, order])
      model%impactors = [impactor_type(id=1, kind="sphere", &
         & body=ball_body(8.0_wp), mass=mass, centre=[15.0_wp, 15.0_wp, 8.501_wp], &
         & velocity=[0.0_wp, 0.0_wp, -speed])]
      model%contacts = [contact_type(id=1, impactor=1, parts=[1], face=top_face, method=method)]
      model%control%end_time = 6.0e-5_wp
   end function impact_model

   !> Build and run
   subroutine run_model(model, state, error)
      type(model_type), intent(in) :: model
      type(state_type), intent(out) :: state
      type(error_type), allocatable, intent(out) :: error

      type(comm_type) :: alone
      type(job_type) :: job
      type(observers_type) :: observers
      type(run_type) :: parts

      parts%model = model
      call set_up(alone, parts, error)
      if (allocated(error)) return
      job%path = "test_run_loop"
      job%deck = "none"
      job%version = "test"
      job%places = new_file_positions(job%path)
      call make_observers(job, parts, huge(1.0_wp), observers, error)
      if (.not. allocated(error)) call run(parts, observers, error)
      call observers%close(parts, error)
      state = parts%state
   end subroutine run_model

   !> Strain energy of linear elasticity, 1/2 u . K u
   real(wp) function stored_energy(model, state) result(energy)
      type(model_type), intent(in) :: model
      type(state_type), intent(in) :: state

      type(thread_team_type) :: team
      type(domain_type) :: domain
      type(error_type), allocatable :: error
      real(wp), allocatable :: force(:)
      real(wp) :: history(0)

      call build_domain(model, domain, error)
      allocate (force(domain%columns%forces))
      force(:) = 0.0_wp
      call new_thread_team(domain%chunks%order, domain%chunks%outer, team)
      call find_internal_forces(domain, team, 0.0_wp, state%displacement, &
            & 0.0_wp*state%displacement, history, force)
      energy = -0.5_wp*dot_product(state%displacement, force(:domain%columns%freedoms))
   end function stored_energy

   !> Difference of displacement across the tied faces
   function tie_gap(state, model) result(gap)
      type(state_type), intent(in) :: state
      type(model_type), intent(in) :: model
      real(wp), allocatable :: gap(:)

      type(domain_type) :: domain
      type(error_type), allocatable :: error
      integer :: c, k, n

      call build_domain(model, domain, error)
      allocate (gap(0))
      do k = 1, size(domain%inertia%ties)
         do c = 1, 3
            gap = [gap, state%displacement(domain%columns%freedom(k, domain%columns%levels(k), c, &
               & [(n, n=1, domain%columns%nodes)])) - state%displacement( &
               & domain%columns%freedom(k + 1, 1, c, [(n, n=1, domain%columns%nodes)]))]
         end do
      end do
   end function tie_gap

end program test_run_loop
