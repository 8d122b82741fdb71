!> Register of the user's numbers of one kind: where they are defined, and which are used.
module plydyn_input_register
   use plydyn_base_sort, only : sorted_order
   implicit none
   private

   !> Numbers of one kind, in the order in which they are defined
   type, public :: register_type
      !> What has a number, as in `node set`, and keyword that defines it, for advice
      character(:), allocatable :: what, keyword
      !> The numbers, as many as `count`, and line of each definition
      integer, allocatable :: id(:), line(:)
      !> True for those that something refers to
      logical, allocatable :: used(:)
      !> How many there are
      integer :: count = 0
      !> Places of the numbers in increasing order, when `sorted`
      integer, allocatable :: order(:)
      !> The order is up to date
      logical :: sorted = .false.
   contains
      procedure :: add
      procedure :: sort
      procedure :: refer
      procedure :: index_of
   end type register_type

   !> Room at first
   integer, parameter :: first_room = 16

contains

   !> Append a number
   pure subroutine add(self, id, line)
      class(register_type), intent(inout) :: self
      !> The user's number, and line of the definition
      integer, intent(in) :: id, line

      if (.not. allocated(self%id)) then
         allocate (self%id(first_room), self%line(first_room), self%used(first_room))
      end if
      if (self%count == size(self%id)) call lengthen(self)
      self%count = self%count + 1
      self%id(self%count) = id
      self%line(self%count) = line
      self%used(self%count) = .false.
      self%sorted = .false.
   end subroutine add

   !> Double the room
   pure subroutine lengthen(self)
      type(register_type), intent(inout) :: self

      integer, allocatable :: id(:), line(:)
      logical, allocatable :: used(:)
      integer :: n

      n = self%count
      allocate (id(2*n), line(2*n), used(2*n))
      id(:n) = self%id
      line(:n) = self%line
      used(:n) = self%used
      call move_alloc(id, self%id)
      call move_alloc(line, self%line)
      call move_alloc(used, self%used)
   end subroutine lengthen

   !> Bring the order up to date; equal numbers keep theirs
   pure subroutine sort(self)
      class(register_type), intent(inout) :: self

      integer :: i

      if (self%sorted) return
      self%sorted = .true.
      self%order = [(i, i=1, self%count)]
      if (self%count < 2) return
      if (any(self%id(2:self%count) <= self%id(:self%count - 1))) self%order(:) = &
         & sorted_order(self%id(:self%count))
   end subroutine sort

   !> Place of a number that something refers to, which is used from now on; 0 if it is not defined
   pure subroutine refer(self, id, place)
      class(register_type), intent(inout) :: self
      !> The user's number
      integer, intent(in) :: id
      !> Place in the order of definition
      integer, intent(out) :: place

      call self%sort()
      place = self%index_of(id)
      if (place > 0) self%used(place) = .true.
   end subroutine refer

   !> Place of a number in the order of definition; 0 if it is not defined; sorted registers only
   pure integer function index_of(self, id) result(place)
      class(register_type), intent(in) :: self
      !> The user's number
      integer, intent(in) :: id

      integer :: high, low, middle

      place = 0
      low = 1
      high = self%count
      do while (low < high)
         middle = (low + high)/2
         if (self%id(self%order(middle)) < id) then
            low = middle + 1
         else
            high = middle
         end if
      end do
      if (low > self%count) return
      if (self%id(self%order(low)) == id) place = self%order(low)
   end function index_of

end module plydyn_input_register
