!> Register of the user's numbers of one kind: where they are defined, and which are used.
module plydyn_input_register
   implicit none
   private

   !> Numbers of one kind, in the order in which they are defined
   type, public :: register_type
      !> What has a number, as in `node set`
      character(:), allocatable :: what
      !> Keyword that defines it, for advice
      character(:), allocatable :: keyword
      !> The numbers, as many as `count`
      integer, allocatable :: id(:)
      !> Line of each definition
      integer, allocatable :: line(:)
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
      procedure :: index_of
      procedure :: is_twice
      procedure :: mark
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

   !> Bring the order up to date: a merge sort, equal numbers keep their order
   pure subroutine sort(self)
      class(register_type), intent(inout) :: self

      integer, allocatable :: merged(:)
      integer :: begin, i, middle, width

      if (self%sorted) return
      self%sorted = .true.
      self%order = [(i, i=1, self%count)]
      if (self%count < 2) return
      if (all(self%id(2:self%count) > self%id(:self%count - 1))) return
      allocate (merged(self%count))
      width = 1
      do while (width < self%count)
         do begin = 1, self%count, 2*width
            middle = min(begin + width, self%count + 1)
            call merge_halves(self%id, self%order, begin, middle, &
               & min(begin + 2*width, self%count + 1), merged)
         end do
         self%order(:) = merged
         width = 2*width
      end do
   end subroutine sort

   !> Merge two ordered stretches
   pure subroutine merge_halves(id, order, begin, middle, finish, merged)
      !> Numbers
      integer, intent(in) :: id(:)
      !> Their order so far
      integer, intent(in) :: order(:)
      !> Begin of the first stretch, of the second, and of what follows
      integer, intent(in) :: begin, middle, finish
      !> Gets the merged stretch
      integer, intent(inout) :: merged(:)

      logical :: from_left
      integer :: k, left, right

      left = begin
      right = middle
      do k = begin, finish - 1
         from_left = right >= finish
         if (left < middle .and. right < finish) from_left = id(order(left)) <= id(order(right))
         if (from_left) then
            merged(k) = order(left)
            left = left + 1
         else
            merged(k) = order(right)
            right = right + 1
         end if
      end do
   end subroutine merge_halves

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

   !> The number at a place of the order has been there before; sorted registers only
   pure logical function is_twice(self, k)
      class(register_type), intent(in) :: self
      !> Place in the order, above 1
      integer, intent(in) :: k

      is_twice = self%id(self%order(k)) == self%id(self%order(k - 1))
   end function is_twice

   !> Something refers to a thing
   pure subroutine mark(self, place)
      class(register_type), intent(inout) :: self
      !> Place in the order of definition
      integer, intent(in) :: place

      self%used(place) = .true.
   end subroutine mark

end module plydyn_input_register
