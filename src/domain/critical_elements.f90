!> The elements of all ranks that have the smallest stable steps.
module plydyn_domain_critical_elements
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : critical_element_type
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   public :: find_slowest

   !> Most elements that are named
   integer, parameter :: most_named = 20
   !> Numbers of an element that ranks exchange
   integer, parameter :: numbers = 4

contains

   !> The elements with the largest eigenvalues, the largest first; of equal ones the first of the
   !> mesh. All ranks must come here, and get the same
   function find_slowest(comm, elements) result(slowest)
      !> The ranks
      type(comm_type), intent(in) :: comm
      !> Elements of this rank
      type(critical_element_type), intent(in) :: elements(:)
      type(critical_element_type), allocatable :: slowest(:)

      type(critical_element_type), allocatable :: own(:)
      real(wp) :: all(numbers*most_named*comm%ranks), part(numbers, most_named)
      integer :: e, r

      own = foremost(elements)
      part(:, :) = 0.0_wp
      do e = 1, size(own)
         part(:, e) = [real([own(e)%group, own(e)%element, own(e)%layer], wp), own(e)%rate]
      end do
      call comm%allgather(reshape(part, [size(part)]), [(size(part), r=1, comm%ranks)], all)
      allocate (slowest(most_named*comm%ranks))
      do e = 1, size(slowest)
         associate (each => all(numbers*(e - 1) + 1:numbers*e))
            slowest(e) = critical_element_type(nint(each(1)), nint(each(2)), nint(each(3)), each(4))
         end associate
      end do
      slowest = foremost(pack(slowest, slowest%element > 0))
   end function find_slowest

   !> The slowest of some elements, the slowest first
   pure function foremost(elements) result(first)
      type(critical_element_type), intent(in) :: elements(:)
      type(critical_element_type), allocatable :: first(:)

      logical, allocatable :: is_left(:)
      integer :: e, i, next

      allocate (first(min(most_named, size(elements))))
      is_left = spread(.true., 1, size(elements))
      do i = 1, size(first)
         next = 0
         do e = 1, size(elements)
            if (.not. is_left(e)) cycle
            if (next == 0) next = e
            if (is_slower(elements(e), elements(next))) next = e
         end do
         is_left(next) = .false.
         first(i) = elements(next)
      end do
   end function foremost

   !> Whether an element comes before another one
   pure logical function is_slower(one, other)
      type(critical_element_type), intent(in) :: one, other

      if (one%rate > other%rate) then
         is_slower = .true.
      else if (one%rate < other%rate) then
         is_slower = .false.
      else
         is_slower = one%element < other%element
      end if
   end function is_slower

end module plydyn_domain_critical_elements
