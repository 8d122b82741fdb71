!> A state that is written and read again is the same in every component that a restart file holds.
program test_state_exchange
   use plydyn_base_precision, only : wp
   use plydyn_state_exchange, only : exchange_state
   use plydyn_state_state, only : constraint_state_type, energies_type, fixture_state_type, &
      & impactor_state_type, motion_sums_type, relaxation_state_type, run_end_type, state_type, &
      & support_state_type
   use state_memory, only : memory_type
   use testing, only : begin, check, finish
   implicit none

   !> Freedoms, and the forces of columns of shared nodes behind the accelerations
   integer, parameter :: freedoms = 6, behind = 3
   type(memory_type) :: memory
   type(state_type) :: read_again, written

   written = some_state(1.0_wp)
   read_again = some_state(-1.0_wp)
   allocate (memory%arrays(0))
   call exchange_state(memory, written)
   memory%reads = .true.
   call exchange_state(memory, read_again)

   call check_clock()
   call check_points()
   call check_supports()
   call check_totals()
   call check_bodies()
   call finish()

contains

   !> A state whose components differ from each other, and from those of another sign
   function some_state(sign) result(state)
      real(wp), intent(in) :: sign
      type(state_type) :: state

      integer :: i, sense

      sense = nint(sign)
      state%time = sign*1.5_wp
      state%cycle = sense*2
      state%end = run_end_type(sign*3.5_wp, sense*4, sign*5.5_wp, sign*6.5_wp, sign*7.5_wp, &
         & sign*8.5_wp)
      state%least_volume = sign*9.5_wp
      state%step = sign*10.5_wp
      state%step_before = sign*11.5_wp
      state%first_step = sign*12.5_wp
      state%displacement = sign*[(20.5_wp + i, i=1, freedoms)]
      state%velocity = sign*[(30.5_wp + i, i=1, freedoms)]
      state%acceleration = sign*[(40.5_wp + i, i=1, freedoms + behind)]
      state%history = sign*[(50.5_wp + i, i=1, 7)]
      state%supports = support_state_type(sense*[61, 62], sign*[63.5_wp, 64.5_wp, 65.5_wp], &
         & sign*[66.5_wp, 67.5_wp], sign*[68.5_wp], constraint_state_type(sign*[69.5_wp], &
         & sign*[70.5_wp], sign*[71.5_wp]))
      state%relaxation = relaxation_state_type(sign*81.5_wp, sign*82.5_wp, sense*83, sign*84.5_wp, &
         & sign*85.5_wp, sign*86.5_wp, sign*87.5_wp)
      state%sums = motion_sums_type(sign*[91.5_wp, 92.5_wp, 93.5_wp], sign*94.5_wp, sign*95.5_wp, &
         & sign*96.5_wp, sign*97.5_wp)
      state%energies = transfer(sign*[(100.5_wp + i, i=1, 15)], state%energies)
      call add_bodies(sign, state)
   end function some_state

   !> Impactors, fixtures and contacts, two of each
   subroutine add_bodies(sign, state)
      real(wp), intent(in) :: sign
      type(state_type), intent(inout) :: state

      integer :: i, sense

      sense = nint(sign)
      allocate (state%impactors(2), state%fixtures(2), state%contacts(2))
      do i = 1, 2
         state%impactors(i) = impactor_state_type(id=20 + i, force=sign*three(200*i), &
            & impulse=sign*three(200*i + 3), friction=sign*(200*i + 6.5_wp), &
            & contact=sign*(200*i + 7.5_wp), contacts=sense*(200*i + 8), &
            & centre=sign*three(200*i + 9), displacement=sign*three(200*i + 12), &
            & velocity=sign*three(200*i + 15), spin=sign*three(200*i + 18), &
            & work=sign*(200*i + 21.5_wp), penetration=sign*(200*i + 22.5_wp), &
            & last_contact=sign*(200*i + 23.5_wp))
         state%fixtures(i) = fixture_state_type(id=30 + i, force=sign*three(200*i + 30), &
            & impulse=sign*three(200*i + 33), friction=sign*(200*i + 36.5_wp), &
            & contact=sign*(200*i + 37.5_wp), contacts=sense*(200*i + 38), &
            & height=sign*(200*i + 39.5_wp), area=sign*(200*i + 40.5_wp), &
            & slip=sign*(200*i + 41.5_wp))
         state%contacts(i)%places = sense*[200*i + 50, 200*i + 51, 200*i + 52]
         state%contacts(i)%numbers = sign*[200*i + 60.5_wp, 200*i + 61.5_wp]
      end do
   end subroutine add_bodies

   !> Three numbers that follow another
   pure function three(before) result(numbers)
      integer, intent(in) :: before
      real(wp) :: numbers(3)

      numbers(:) = before + [1.5_wp, 2.5_wp, 3.5_wp]
   end function three

   subroutine check_clock()
      call begin("clock of a restart")
      associate (new => read_again, old => written)
         call check([new%time, new%step, new%step_before, new%first_step, new%least_volume], &
            & [old%time, old%step, old%step_before, old%first_step, old%least_volume], 0.0_wp, &
            & "has the time, the steps and the least volume")
         call check(new%cycle, old%cycle, "has the number of the step")
         call check(new%end%cycle, old%end%cycle, "has the last step")
         call check(transfer_end(new%end), transfer_end(old%end), 0.0_wp, "has the end")
      end associate
   end subroutine check_clock

   !> The reals of the end of a run
   pure function transfer_end(end) result(numbers)
      type(run_end_type), intent(in) :: end
      real(wp) :: numbers(5)

      numbers(:) = [end%time, end%begin, end%largest_power, end%look_time, end%look_work]
   end function transfer_end

   subroutine check_points()
      call begin("points of a restart")
      associate (new => read_again, old => written)
         call check(new%displacement, old%displacement, 0.0_wp, "have their displacements")
         call check(new%velocity, old%velocity, 0.0_wp, "have their velocities")
         call check(new%acceleration(:freedoms), old%acceleration(:freedoms), 0.0_wp, &
            & "have their accelerations")
         call check(new%acceleration(freedoms + 1:), -old%acceleration(freedoms + 1:), 0.0_wp, &
            & "leave the forces behind them alone")
         call check(new%history, old%history, 0.0_wp, "have their history")
      end associate
   end subroutine check_points

   subroutine check_supports()
      call begin("supports of a restart")
      associate (new => read_again%supports, old => written%supports)
         call check(real(new%planes, wp), real(old%planes, wp), 0.0_wp, "have the symmetry")
         call check(new%force, old%force, 0.0_wp, "have the forces")
         call check(new%velocity, old%velocity, 0.0_wp, "have the velocities")
         call check(new%load_factor, old%load_factor, 0.0_wp, "have the factors of loads")
         call check([new%constraints%force, new%constraints%rate, new%constraints%displacement], &
            & [old%constraints%force, old%constraints%rate, old%constraints%displacement], 0.0_wp, &
            & "have the constraints")
      end associate
   end subroutine check_supports

   subroutine check_totals()
      call begin("sums of a restart")
      call check(transfer(read_again%sums, [0.0_wp]), transfer(written%sums, [0.0_wp]), 0.0_wp, &
         & "are those of the motion")
      call check(transfer(read_again%energies, [0.0_wp]), transfer(written%energies, [0.0_wp]), &
         & 0.0_wp, "are the energies")
      associate (new => read_again%relaxation, old => written%relaxation)
         call check(new%change_cycle, old%change_cycle, "have the step that changes the damping")
         call check([new%damping, new%next_damping, new%largest_kinetic, new%damped_time, &
            & new%twice_kinetic, new%stiffness_square], [old%damping, old%next_damping, &
            & old%largest_kinetic, old%damped_time, old%twice_kinetic, old%stiffness_square], &
            & 0.0_wp, "are those of the relaxation")
      end associate
   end subroutine check_totals

   subroutine check_bodies()
      integer :: i

      call begin("bodies of a restart")
      do i = 1, 2
         associate (new => read_again%impactors(i), old => written%impactors(i))
            call check([new%centre, new%displacement, new%velocity, new%spin, new%force, &
               & new%impulse], [old%centre, old%displacement, old%velocity, old%spin, old%force, &
               & old%impulse], 0.0_wp, "have the vectors of impactors")
            call check([new%friction, new%work, new%contact, new%penetration, new%last_contact], &
               & [old%friction, old%work, old%contact, old%penetration, old%last_contact], 0.0_wp, &
               & "have the work of impactors")
            call check(new%contacts, old%contacts, "have the contacts of impactors")
         end associate
         associate (new => read_again%fixtures(i), old => written%fixtures(i))
            call check([new%height, new%force, new%impulse, new%area, new%slip, new%friction, &
               & new%contact], [old%height, old%force, old%impulse, old%area, old%slip, &
               & old%friction, old%contact], 0.0_wp, "have all of fixtures")
            call check(new%contacts, old%contacts, "have the contacts of fixtures")
         end associate
         associate (new => read_again%contacts(i), old => written%contacts(i))
            call check(all(new%places == old%places), "have the facets of contacts")
            call check(new%numbers, old%numbers, 0.0_wp, "have the numbers of contacts")
         end associate
      end do
   end subroutine check_bodies

end program test_state_exchange
