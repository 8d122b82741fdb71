!> Contact nodes that sleep.
program test_contact_search_search_timers
   use plydyn_base_precision, only : wp
   use plydyn_contact_search_search_timers, only : new_search_timers, search_timers_type
   use testing, only : begin, check, finish
   implicit none

   !> More than fill some groups
   integer, parameter :: nodes = 205

   call check_waking()
   call check_new_times()
   call finish()

contains

   !> Those awake are those whose time has come, in the order of their numbers, at any travel
   subroutine check_waking()
      type(search_timers_type) :: sleepers
      integer, allocatable :: expected(:)
      integer :: i, step

      call begin("find_awake")
      call new_search_timers(sleepers, nodes)
      call sleepers%find_awake(0.0_wp)
      call check(sleepers%count, nodes, "all are awake at first")
      do i = 1, nodes
         sleepers%wake(i) = modulo(37*i, 101)
      end do
      do step = 0, 110
         expected = pack([(i, i=1, nodes)], [(modulo(37*i, 101) <= step, i=1, nodes)])
         call sleepers%find_awake(real(step, wp))
         call check(sleepers%count, size(expected), "as many as must be")
         call check(all(sleepers%awake(:sleepers%count) == expected), "and the same ones")
      end do
   end subroutine check_waking

   !> A group that was left alone is looked at when its nodes are to wake earlier
   subroutine check_new_times()
      type(search_timers_type) :: sleepers

      call begin("renew")
      call new_search_timers(sleepers, nodes)
      sleepers%wake(:nodes) = 5.0_wp
      call sleepers%find_awake(1.0_wp)
      call check(sleepers%count, 0, "all sleep")
      sleepers%wake(nodes) = 2.0_wp
      call sleepers%renew()
      call sleepers%find_awake(2.0_wp)
      call check(sleepers%count, 1, "one wakes")
      call check(sleepers%awake(1), nodes, "the last one")
   end subroutine check_new_times

end program test_contact_search_search_timers
