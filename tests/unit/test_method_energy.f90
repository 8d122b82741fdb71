!> Reduction of a step: sums of chunks, and what a new step clears.
program test_method_energy
   use plydyn_base_precision, only : wp
   use plydyn_method_energy, only : global_reduction_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_state_state, only : motion_sums_type
   use testing, only : begin, check, finish
   implicit none

   call test_sums()
   call test_order()
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

end program test_method_energy
