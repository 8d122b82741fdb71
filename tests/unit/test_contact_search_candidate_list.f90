!> Search timers of contact nodes.
program test_contact_search_candidate_list
   use, intrinsic :: ieee_arithmetic, only : ieee_positive_inf, ieee_value
   use plydyn_base_precision, only : wp
   use plydyn_contact_search_candidate_list, only : new_search_timers, search_timers_type
   use testing, only : begin, check, finish
   implicit none

   !> More than fill some groups
   integer, parameter :: nodes = 205

   call check_due()
   call check_new_times()
   call finish()

contains

   !> Nodes are due from their own approach bound on, in ascending order
   subroutine check_due()
      type(search_timers_type) :: timers
      integer, allocatable :: expected(:)
      integer :: i, step

      call begin("find_due")
      call new_search_timers(timers, nodes)
      call timers%find_due(0.0_wp)
      call check(timers%count, nodes, "all are due at first")
      do i = 1, nodes
         timers%due_at(i) = modulo(37*i, 101)
      end do
      call timers%find_due(ieee_value(1.0_wp, ieee_positive_inf))
      call check(timers%count, nodes, "an infinite approach makes no node more due than there are")
      do step = 0, 110
         expected = pack([(i, i=1, nodes)], [(modulo(37*i, 101) <= step, i=1, nodes)])
         call timers%find_due(real(step, wp))
         call check(timers%count, size(expected), "number")
         call check(all(timers%due(:timers%count) == expected), "nodes")
      end do
   end subroutine check_due

   !> A restart of the groups finds nodes that are due earlier than before
   subroutine check_new_times()
      type(search_timers_type) :: timers

      call begin("restart_groups")
      call new_search_timers(timers, nodes)
      timers%due_at(:nodes) = 5.0_wp
      call timers%find_due(1.0_wp)
      call check(timers%count, 0, "none is due")
      timers%due_at(nodes) = 2.0_wp
      call timers%restart_groups()
      call timers%find_due(2.0_wp)
      call check(timers%count, 1, "one is due")
      call check(timers%due(1), nodes, "the last one")
   end subroutine check_new_times

end program test_contact_search_candidate_list
