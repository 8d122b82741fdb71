!> Reduction of a step: sums of chunks, and what a new step clears.
program test_method_energy
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : contact_bodies_type
   use plydyn_method_energy, only : global_reduction_type, update_bodies
   use plydyn_parallel_comm, only : comm_type
   use plydyn_state_state, only : motion_sums_type, state_type
   use testing, only : begin, check, finish
   implicit none

   call test_sums()
   call test_order()
   call test_bodies()
   call finish()

contains

   !> Every member is the sum of its own terms
   subroutine test_sums()
      type(comm_type) :: alone
      type(global_reduction_type) :: reduction
      type(motion_sums_type) :: part, total

      call begin("sum")
      part = motion_sums_type(momentum=[1.0_wp, 2.0_wp, 3.0_wp], twice_kinetic=4.0_wp, &
         & acceleration_square=5.0_wp, twice_added=6.0_wp, power=7.0_wp)
      call reduction%add_motion(part)
      call reduction%add_motion(part)
      call reduction%contact_work%add(8.0_wp)
      reduction%speed_bound = 9.0_wp
      reduction%requests = 1
      call reduction%sum(alone)
      total = reduction%motion_sums()
      call check(total%momentum, [2.0_wp, 4.0_wp, 6.0_wp], 0.0_wp, "momentum")
      call check([total%twice_kinetic, total%acceleration_square, total%twice_added, total%power], &
         & [8.0_wp, 10.0_wp, 12.0_wp, 14.0_wp], 0.0_wp, "the other sums")
      call check(reduction%contact_work%value(), 8.0_wp, 0.0_wp, "work of contact by itself")
      call check(reduction%contact_power%value(), 0.0_wp, 0.0_wp, "no term, no sum")
      call reduction%clear()
      total = reduction%motion_sums()
      call check(total%twice_kinetic, 0.0_wp, 0.0_wp, "a new step begins with zero")
      call check(reduction%requests, 0, "and with no request")
      call check(reduction%speed_bound, 9.0_wp, 0.0_wp, "the bound holds for the next step")
   end subroutine test_sums

   !> Sums have the same bits in any order of the chunks
   subroutine test_order()
      integer, parameter :: chunks = 1000
      type(global_reduction_type) :: backward, forward
      type(motion_sums_type) :: part(chunks), sums(2)
      integer :: c

      call begin("order")
      do c = 1, chunks
         part(c)%power = sin(real(7*c*c, wp))*10.0_wp**mod(c, 17)
      end do
      do c = 1, chunks
         call forward%add_motion(part(c))
         call backward%add_motion(part(chunks + 1 - c))
      end do
      sums = [forward%motion_sums(), backward%motion_sums()]
      call check(sums(1)%power, sums(2)%power, 0.0_wp, "the same bits")
   end subroutine test_order

   !> An impactor gets its work on the plate, a fixture that and what its rows sum to
   subroutine test_bodies()
      type(contact_bodies_type) :: bodies
      type(global_reduction_type) :: reduction
      type(state_type) :: state

      call begin("update_bodies")
      allocate (bodies%impactors(1), bodies%fixtures(1), state%impactors(1), state%fixtures(1))
      call reduction%expect_bodies(bodies)
      call reduction%bodies(1)%friction%add(2.0_wp)
      call reduction%bodies(1)%contact%add(-5.0_wp)
      associate (sums => reduction%bodies(2))
         call sums%friction%add(3.0_wp)
         call sums%contact%add(-1.0_wp)
         call sums%impulse(3)%add(6.0_wp)
         call sums%area%add(7.0_wp)
         call sums%points%add(8.0_wp)
         call sums%normal%add(4.0_wp)
         call sums%slip%add(1.0_wp)
      end associate
      state%energies%friction = 10.0_wp
      state%step_before = 1.0_wp
      state%step = 3.0_wp
      call update_bodies(reduction, state)
      associate (impactor => state%impactors(1), fixture => state%fixtures(1))
         call check([impactor%friction, impactor%contact], [2.0_wp, 5.0_wp], 0.0_wp, &
            & "friction and loss of the impactor")
         call check([fixture%friction, fixture%contact], [3.0_wp, 1.0_wp], 0.0_wp, &
            & "friction and loss of the fixture")
         call check(state%energies%friction, 15.0_wp, 0.0_wp, "friction of all")
         call check(fixture%force, [0.0_wp, 0.0_wp, 3.0_wp], 0.0_wp, &
            & "impulse of half of both steps as a force")
         call check(fixture%impulse(3), 6.0_wp, 0.0_wp, "impulse")
         call check([fixture%area, fixture%slip], [7.0_wp, 0.25_wp], 0.0_wp, &
            & "area, and path as the mean by normal force")
         call check(fixture%contacts, 8, "points")
         call reduction%clear()
         call update_bodies(reduction, state)
         call check([fixture%force(3), fixture%area], [0.0_wp, 0.0_wp], 0.0_wp, &
            & "a step without contact has no force")
         call check([fixture%impulse(3), fixture%slip, fixture%friction, impactor%contact], &
            & [6.0_wp, 0.25_wp, 3.0_wp, 5.0_wp], 0.0_wp, "what came before stays")
      end associate
   end subroutine test_bodies

end program test_method_energy
