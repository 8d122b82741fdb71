!> Parameters of a deck: names for numbers.
module plydyn_deck_parameter
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : lower_case
   use plydyn_deck_nearest, only : nearest_word
   implicit none
   private

   !> Longest name of a parameter
   integer, parameter, public :: parameter_length = 32

   !> One parameter
   type, public :: parameter_type
      !> Name in lower case
      character(parameter_length) :: name = ""
      !> Its number
      real(wp) :: value = 0.0_wp
      !> Defined with I
      logical :: whole = .false.
      !> Line that defines it
      integer :: line = 0
   end type parameter_type

   !> The parameters defined so far
   type, public :: parameter_table_type
      !> The parameters, as many as `count`
      type(parameter_type), allocatable :: list(:)
      !> How many there are
      integer :: count = 0
   contains
      procedure :: add
      procedure :: find
      procedure :: advice
   end type parameter_table_type

contains

   !> Define a parameter
   pure subroutine add(self, parameter)
      class(parameter_table_type), intent(inout) :: self
      !> Its name is new
      type(parameter_type), intent(in) :: parameter

      type(parameter_type), allocatable :: longer(:)

      if (.not. allocated(self%list)) allocate (self%list(16))
      if (self%count == size(self%list)) then
         allocate (longer(2*self%count))
         longer(:self%count) = self%list
         call move_alloc(longer, self%list)
      end if
      self%count = self%count + 1
      self%list(self%count) = parameter
      self%list(self%count)%name = lower_case(parameter%name)
   end subroutine add

   !> Index of a parameter; 0 if there is none of that name yet
   pure integer function find(self, name) result(i)
      class(parameter_table_type), intent(in) :: self
      !> Name in either case
      character(*), intent(in) :: name

      do i = self%count, 1, -1
         if (self%list(i)%name == lower_case(name)) return
      end do
      i = 0
   end function find

   !> What would be right in place of an undefined name
   pure function advice(self, name) result(words)
      class(parameter_table_type), intent(in) :: self
      !> Name of no parameter
      character(*), intent(in) :: name
      character(:), allocatable :: words

      character(parameter_length) :: known(self%count)
      integer :: i

      words = "a parameter that *PARAMETER defines further up"
      if (self%count == 0) return
      known(:) = self%list(:self%count)%name
      i = nearest_word(lower_case(name), known)
      if (i == 0) return
      words = "perhaps "//trim(self%list(i)%name)//"; a parameter is defined above its use"
   end function advice

end module plydyn_deck_parameter
