!> Which of many contact nodes sleep, and until when: most of them do, and whole groups at once.
module plydyn_contact_search_search_timers
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: new_search_timers

   !> Nodes of a group
   integer, parameter :: members = 32

   !> Nodes that sleep until the travel of sphere and surface has come to a value of their own
   type, public :: search_timers_type
      !> Travel at which each node wakes, length; never for what fills the last group
      real(wp), allocatable :: wake(:)
      !> Nodes that were found awake, by number, in the first places
      integer, allocatable :: awake(:)
      !> How many these are
      integer :: count = 0
      !> The least travel at which a node of each group wakes, or less, length
      real(wp), allocatable, private :: first(:)
   contains
      procedure :: find_awake
      procedure :: renew
   end type search_timers_type

contains

   !> All are awake
   pure subroutine new_search_timers(self, nodes)
      !> The sleepers
      type(search_timers_type), intent(out) :: self
      !> How many
      integer, intent(in) :: nodes

      allocate (self%first((nodes + members - 1)/members), source=0.0_wp)
      allocate (self%wake(members*size(self%first)), source=huge(1.0_wp))
      allocate (self%awake(size(self%wake) + 1), source=0)
      self%wake(:nodes) = 0.0_wp
   end subroutine new_search_timers

   !> Let groups be looked through anew: nodes may wake earlier than before
   pure subroutine renew(self)
      !> The sleepers
      class(search_timers_type), intent(inout) :: self

      self%first(:) = 0.0_wp
   end subroutine renew

   !> Find the nodes that are awake
   pure subroutine find_awake(self, travel)
      !> The sleepers
      class(search_timers_type), intent(inout) :: self
      !> Travel of sphere and surface, length
      real(wp), intent(in) :: travel

      integer :: before, count, g, i
      real(wp) :: least

      count = 0
      do g = 1, size(self%first)
         if (self%first(g) > travel) cycle
         before = members*(g - 1)
         least = huge(1.0_wp)
         !$omp simd reduction(min:least)
         do i = 1, members
            least = merge(self%wake(before + i), least, self%wake(before + i) < least)
         end do
         self%first(g) = least
         if (least > travel) cycle
         do i = 1, members
            self%awake(count + 1) = before + i
            count = count + merge(1, 0, self%wake(before + i) <= travel)
         end do
      end do
      self%count = count
   end subroutine find_awake

end module plydyn_contact_search_search_timers
