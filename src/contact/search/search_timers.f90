!> Search timers: the approach bound at which each contact node must be projected again.
!>
!> Nodes are grouped, so that a group without a due node costs one comparison.
module plydyn_contact_search_search_timers
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: new_search_timers

   !> Nodes of a group
   integer, parameter :: group_size = 32

   !> Nodes that are due when the approach bound has reached a value of their own
   type, public :: search_timers_type
      !> Approach bound at which each node is due, length; huge for padding of the last group
      real(wp), allocatable :: due_at(:)
      !> Nodes that are due, in ascending order, in the first `count` entries
      integer, allocatable :: due(:)
      !> Number of due nodes
      integer :: count = 0
      !> Lower bound of `due_at` in each group, length
      real(wp), allocatable, private :: group_due_at(:)
   contains
      procedure :: enlarge
      procedure :: find_due
      procedure :: restart_groups
   end type search_timers_type

contains

   !> Timers of nodes that are all due
   pure subroutine new_search_timers(self, nodes)
      !> The timers
      type(search_timers_type), intent(out) :: self
      !> Number of nodes
      integer, intent(in) :: nodes

      allocate (self%group_due_at((nodes + group_size - 1)/group_size), source=0.0_wp)
      allocate (self%due_at(group_size*size(self%group_due_at)), source=huge(1.0_wp))
      allocate (self%due(size(self%due_at) + 1), source=0)
      self%due_at(:nodes) = 0.0_wp
   end subroutine new_search_timers

   !> Add nodes, all of them due
   pure subroutine enlarge(self, before, nodes)
      !> The timers
      class(search_timers_type), intent(inout) :: self
      !> Number of nodes so far, and with the new ones
      integer, intent(in) :: before, nodes

      type(search_timers_type) :: larger

      call new_search_timers(larger, nodes)
      larger%due_at(:before) = self%due_at(:before)
      call move_alloc(larger%due_at, self%due_at)
      call move_alloc(larger%due, self%due)
      call move_alloc(larger%group_due_at, self%group_due_at)
   end subroutine enlarge

   !> Void the bounds of the groups: nodes may be due earlier than before
   pure subroutine restart_groups(self)
      !> The timers
      class(search_timers_type), intent(inout) :: self

      self%group_due_at(:) = 0.0_wp
   end subroutine restart_groups

   !> Find the nodes that are due
   pure subroutine find_due(self, approach_bound)
      !> The timers
      class(search_timers_type), intent(inout) :: self
      !> Approach bound of impactor and surface, length
      real(wp), intent(in) :: approach_bound

      integer :: before, count, g, i
      real(wp) :: bound, least

      ! nodes that fill the last group are never due, whatever the motion
      bound = min(approach_bound, 0.5_wp*huge(1.0_wp))
      count = 0
      do g = 1, size(self%group_due_at)
         if (self%group_due_at(g) > bound) cycle
         before = group_size*(g - 1)
         least = huge(1.0_wp)
         !$omp simd reduction(min:least)
         do i = 1, group_size
            least = merge(self%due_at(before + i), least, self%due_at(before + i) < least)
         end do
         self%group_due_at(g) = least
         if (least > bound) cycle
         do i = 1, group_size
            self%due(count + 1) = before + i
            count = count + merge(1, 0, self%due_at(before + i) <= bound)
         end do
      end do
      self%count = count
   end subroutine find_due

end module plydyn_contact_search_search_timers
