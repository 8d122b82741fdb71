!> Nodes of the plane whose columns differ by their area only.
module plydyn_domain_node_classes
   use plydyn_base_precision, only : wp
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   public :: find_classes

   !> Relative difference below which two numbers are the same
   real(wp), parameter :: same = 1.0e-9_wp

contains

   !> Class of each node, counted in the order of the first nodes that all ranks have of them. All
   !> ranks must come here, and find the same classes
   subroutine find_classes(comm, number, key, class_of, first)
      type(comm_type), intent(in) :: comm
      !> What number each node has in the whole model, rising
      integer, intent(in) :: number(:)
      !> What makes a class, the same wherever a node is, (numbers, nodes)
      real(wp), intent(in) :: key(:, :)
      !> Class of each node
      integer, intent(out) :: class_of(:)
      !> What makes each class: that of its first node, (numbers, classes)
      real(wp), allocatable, intent(out) :: first(:, :)

      logical :: found
      real(wp) :: one(size(key, 1))
      integer :: k, n

      class_of(:) = 0
      allocate (first(size(key, 1), 0))
      do
         call find_first(comm, number, key, class_of, found, one)
         if (.not. found) exit
         k = size(first, 2) + 1
         first = reshape([first, one], [size(key, 1), k])
         do n = 1, size(class_of)
            if (class_of(n) > 0) cycle
            if (all(abs(key(:, n) - one) <= same*abs(one))) class_of(n) = k
         end do
      end do
   end subroutine find_classes

   !> The first node of all ranks that has no class yet
   subroutine find_first(comm, number, key, class_of, found, one)
      type(comm_type), intent(in) :: comm
      integer, intent(in) :: number(:), class_of(:)
      real(wp), intent(in) :: key(:, :)
      !> Whether there is one, and what makes its class
      logical, intent(out) :: found
      real(wp), intent(out) :: one(:)

      real(wp) :: least(1)
      integer :: next

      next = findloc(class_of, 0, 1)
      least(1) = -huge(1.0_wp)
      if (next > 0) least(1) = -real(number(next), wp)
      call comm%max(least)
      found = least(1) > -huge(1.0_wp)
      one(:) = -huge(1.0_wp)
      if (found .and. next > 0) then
         if (number(next) == nint(-least(1))) one(:) = key(:, next)
      end if
      call comm%max(one)
   end subroutine find_first

end module plydyn_domain_node_classes
