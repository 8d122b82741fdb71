!> How fast the kernels are: lines `name,value` for tests/bench/run.py. A word on the command line
!> chooses those that have it in their names.
!>
!> Values are the best of many short windows, so that other work on the machine disturbs little.
program bench
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_memory, only : keep_arrays_on_pages
   use plydyn_base_precision, only : lanes, wp
   use plydyn_bench_cases, only : averaged_case, damage_laws, plate_case, press, yield_laws
   use plydyn_bench_fracture, only : closed, crushes, hardens, intact, near_onset, on_curve, &
      & on_debris, opened, prepare_fracture, sheared, smooth, update_fracture
   use plydyn_bench_probe, only : chains, far_numbers, move, move_together, moved_bytes, &
      & multiply_add, probe_flops
   use plydyn_bench_paths, only : elastic_path, line_points, no_growth_path, prepare_paths, &
      & update_by_path, whole_law
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_build, only : start_histories
   use plydyn_element_average, only : average_points
   use plydyn_model_control, only : linear_strain, total_lagrangian
   use plydyn_model_model, only : model_type
   use plydyn_method_central_difference, only : add_chunk_sums, apply_masses, predict
   use plydyn_method_forces, only : find_internal_forces
   use plydyn_method_energy, only : global_reduction_type
   use plydyn_method_workspace, only : new_workspace, workspace_type
   use plydyn_run_setup, only : set_threads
   use plydyn_state_state, only : state_type
   implicit none

   !> Windows, and the time that one is to take at least, seconds
   integer, parameter :: windows = 400
   real(wp), parameter :: window = 1.0e-4_wp
   real(wp), parameter :: nano = 1.0e9_wp, micro = 1.0e6_wp, giga = 1.0e9_wp
   !> Quads along x and y: one chunk, and the plate of the paper's table 7
   integer, parameter :: in_cache(2) = [4, 4], of_paper(2) = [16, 12]

   !> What can be timed
   integer, parameter :: probe = 1, internal = 2, joints = 3, acceleration = 4, motion = 5
   integer, parameter :: memory = -2, shared_memory = -3
   !> And the paths of the damage law, behind these
   integer, parameter :: by_path = 5
   !> And the law with planes of fracture, and averages over neighbours
   integer, parameter :: by_fracture = 0, averages = -1
   !> Ratios of volumes: at which the barrier is looked for, and acts
   real(wp), parameter :: looked_for = 0.85_wp, acts = 0.75_wp
   !> Radius of averages, two quads
   real(wp), parameter :: radius = 2.0_wp

   !> Without damage at time zero
   type(model_type) :: model
   type(domain_type) :: domain
   type(global_reduction_type) :: reduction
   type(workspace_type) :: work_space
   type(state_type) :: state
   real(wp), allocatable :: displacement(:), force(:), history(:)
   real(wp) :: vectors(lanes, chains)
   character(32) :: chosen
   integer :: order, side

   call keep_arrays_on_pages()
   call set_threads(1)
   call get_command_argument(1, chosen)
   vectors(:, :) = 1.0_wp
   write (*, "(a,f0.2)") "peak GFLOP/s,", probe_flops/(giga*best_time(probe))
   if (chosen == "bandwidth") call time_memory()
   do side = 2, 3
      do order = 1, 3
         call time_plates("linear", side, order, linear_strain, "elastic")
         call time_plates("large", side, order, total_lagrangian, "elastic")
         call time_plates("damage linear", side, order, linear_strain, "damage")
         call time_plates("damage large", side, order, total_lagrangian, "damage")
         call time_plates("plastic linear", side, order, linear_strain, "plastic")
      end do
      call time_interfaces("interface springs", side)
   end do
   call time_step("step linear", linear_strain, "elastic")
   call time_step("step large", total_lagrangian, "elastic")
   call time_step("step damage law", linear_strain, "damage")
   call time_path("intact damage law elastic path", elastic_path, damaged=.false.)
   call time_path("intact damage law no-growth path", no_growth_path, damaged=.false.)
   call time_path("damaged damage law no-growth path", no_growth_path, damaged=.true.)
   call time_path("damaged damage law whole law", whole_law, damaged=.true.)
   call time_fracture("intact fracture law", intact)
   call time_fracture("open fracture law", opened)
   call time_fracture("closed fracture law", closed)
   call time_fracture("smooth fracture law", smooth)
   call time_fracture("debris fracture law", on_debris)
   call time_fracture("sheared fracture law", sheared)
   call time_fracture("near onset fracture law", near_onset)
   call time_fracture("hardening fracture law", hardens)
   call time_fracture("power curve fracture law", on_curve)
   call time_fracture("crushing fracture law", crushes)
   call time_barrier("elastic")
   call time_barrier("plastic")
   call time_averages()

contains

   !> Print what a core moves from the memory and back, and what two do at once
   subroutine time_memory()
      allocate (displacement(far_numbers), source=0.0_wp)
      allocate (force(far_numbers), source=1.0_wp)
      write (*, "(a,f0.2)") "bandwidth GB/s,", moved_bytes/(giga*best_time(memory))
      call set_threads(2)
      write (*, "(a,f0.2)") "of two cores GB/s,", &
         & moved_bytes/(giga*best_time(shared_memory))
   end subroutine time_memory

   !> Print the time of a ply element
   subroutine time_plates(name, side, order, kinematics, law)
      character(*), intent(in) :: name, law
      integer, intent(in) :: side, order, kinematics

      character(32) :: line

      write (line, "(2a,i0,a,i0)") name, " q", side**2, " le", order
      if (index(line, trim(chosen)) == 0) return
      call plate_case(side, in_cache, order, kinematics, .false., domain)
      if (law == "damage") call damage_laws(domain)
      if (law == "plastic") call yield_laws(domain)
      call rest()
      write (*, "(2a,f0.3)") trim(line), ",", &
         & nano*best_time(internal)/real(lanes*size(domain%groups(1)%item%element), wp)
   end subroutine time_plates

   !> Print the time of an interface element
   subroutine time_interfaces(name, side)
      character(*), intent(in) :: name
      integer, intent(in) :: side

      character(32) :: line

      write (line, "(2a,i0)") name, " q", side**2
      if (index(line, trim(chosen)) == 0) return
      call plate_case(side, in_cache, 2, linear_strain, .true., domain)
      call rest()
      write (*, "(2a,f0.3)") trim(line), ",", &
         & nano*best_time(joints)/real((lanes - 1)*size(domain%groups(1)%item%element), wp)
   end subroutine time_interfaces

   !> Print the parts of a step of 192 quads of nine nodes, order 2, joined by springs, in
   !> microseconds
   subroutine time_step(name, kinematics, law)
      character(*), intent(in) :: name, law
      integer, intent(in) :: kinematics

      if (index(name, trim(chosen)) == 0) return
      call plate_case(3, of_paper, 2, kinematics, .true., domain)
      if (law == "damage") call damage_laws(domain)
      call rest()
      write (*, "(2a,f0.2)") name, " forces,", micro*best_time(internal)
      write (*, "(2a,f0.2)") name, " accelerate,", micro*best_time(acceleration)
      write (*, "(2a,f0.2)") name, " advance,", micro*best_time(motion)
   end subroutine time_step

   !> Print the time of a point of eight plies by a path of the damage law
   subroutine time_path(name, path, damaged)
      character(*), intent(in) :: name
      integer, intent(in) :: path
      logical, intent(in) :: damaged

      if (index(name, trim(chosen)) == 0) return
      call prepare_paths(damaged)
      write (*, "(2a,f0.3)") name, ",", nano*best_time(by_path + path)/real(line_points, wp)
   end subroutine time_path

   !> Print the time of a point of eight plies with planes of fracture in a state
   subroutine time_fracture(name, state)
      character(*), intent(in) :: name
      integer, intent(in) :: state

      if (index(name, trim(chosen)) == 0) return
      call prepare_fracture(state)
      write (*, "(2a,f0.3)") name, ",", nano*best_time(by_fracture)/real(line_points, wp)
   end subroutine time_fracture

   !> Print the time of a ply element of order 2 with large displacement at rest, where strains are
   !> so large that the barrier is looked for, and where it acts
   subroutine time_barrier(law)
      character(*), intent(in) :: law

      character(*), parameter :: state(3) = ["rest     ", "strained ", "pressed  "]
      real(wp), parameter :: ratio(3) = [1.0_wp, looked_for, acts]
      integer :: k

      if (index("barrier "//law//" law", trim(chosen)) == 0) return
      call plate_case(3, in_cache, 2, total_lagrangian, .false., domain)
      if (law == "plastic") call yield_laws(domain)
      call rest()
      do k = 1, size(state)
         call press(domain, 2, ratio(k), displacement)
         write (*, "(4a,f0.3)") "barrier ", law, " law ", trim(state(k))//",", &
            & nano*best_time(internal)/real(lanes*size(domain%groups(1)%item%element), wp)
      end do
   end subroutine time_barrier

   !> Print the time of the forces of 192 quads without and with averages, in microseconds, and of
   !> an average of a point of eight plies alone, with the fewest and most neighbours
   subroutine time_averages()
      integer :: points

      if (index("averages law", trim(chosen)) == 0) return
      call averaged_case(of_paper, 2, 0.0_wp, domain)
      call rest()
      call start_histories(model, domain, history)
      write (*, "(a,f0.2)") "step law without averages,", micro*best_time(internal)
      call averaged_case(of_paper, 2, radius, domain)
      call rest()
      call start_histories(model, domain, history)
      write (*, "(a,f0.2)") "step law with averages,", micro*best_time(internal)
      points = 27*product(of_paper)
      write (*, "(2(a,i0),a,f0.3)") "averages law of ", minval(domain%averaging%neighbours), &
         & " to ", maxval(domain%averaging%neighbours), " points,", &
         & nano*best_time(averages)/real(points, wp)
   end subroutine time_averages

   !> Small random displacements, no history
   subroutine rest()
      if (allocated(displacement)) deallocate (displacement, force, history)
      allocate (displacement(domain%columns%freedoms), force(domain%columns%forces))
      allocate (history(domain%histories))
      call random_number(displacement)
      displacement(:) = 1.0e-6_wp*displacement
      force(:) = 0.0_wp
      history(:) = 0.0_wp
      state%velocity = displacement
      state%displacement = displacement
      state%acceleration = force
      state%step = 1.0e-12_wp
      call new_workspace(domain, state, work_space)
   end subroutine rest

   !> Do a piece of work
   subroutine do_work(work)
      !> Which
      integer, intent(in) :: work

      integer :: g

      select case (work)
      case (memory)
         call move(force, displacement)
      case (shared_memory)
         call move_together(2, force, displacement)
      case (probe)
         call multiply_add(vectors)
      case (internal)
         call work_space%team%begin_step(.false.)
         call work_space%team%expect_contact()
         call work_space%team%signal_contact()
         call find_internal_forces(domain, work_space%team, 0.0_wp, displacement, displacement, &
            & history, force)
      case (joints)
         do g = 1, size(domain%groups)
            if (.not. allocated(domain%groups(g)%item%springs)) cycle
            call domain%groups(g)%item%add_forces(domain%chunks%list(1)%elements, 0.0_wp, &
               & displacement, displacement, history, force)
         end do
      case (acceleration)
         call apply_masses(domain, work_space, state)
         call add_chunk_sums(work_space%chunk_sums, reduction)
      case (by_fracture)
         call update_fracture()
      case (averages)
         do g = 1, size(domain%averaging%averages)
            associate (average => domain%averaging%averages(g))
               call average_points(average, [1, (size(average%first) - 1)/average%plane], &
                  & history(average%first_history:))
            end associate
         end do
      case (by_path + 1:)
         call update_by_path(work - by_path)
      case default
         call predict(domain, work_space, state)
         call work_space%team%signal_contact()
      end select
   end subroutine do_work

   !> Least time that some work takes, seconds
   real(wp) function best_time(work) result(best)
      integer, intent(in) :: work

      integer(int64) :: now, rate, then
      integer :: i, k, repeats

      call do_work(work)
      call system_clock(then, rate)
      call do_work(work)
      call system_clock(now)
      repeats = 1 + int(window*real(rate, wp)/real(max(now - then, 1_int64), wp))
      best = huge(1.0_wp)
      do k = 1, windows
         call system_clock(then)
         do i = 1, repeats
            call do_work(work)
         end do
         call system_clock(now)
         best = min(best, real(now - then, wp)/(real(rate, wp)*real(repeats, wp)))
      end do
   end function best_time

end program bench
