!> Parameters of a deck: names for numbers.
module plydyn_deck_parameter
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : lower_case
   use plydyn_deck_nearest, only : nearest_word
   use plydyn_deck_number, only : read_real
   use plydyn_deck_report, only : deck_location_type, report_type
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
      !> Whether it is an integer (I)
      logical :: whole = .false.
      !> Line that defines it
      integer :: line = 0
      !> Whether an error of its value has been reported
      logical :: is_wrong = .false.
   end type parameter_type

   !> A value from the command line, which replaces that of the deck
   type :: setting_type
      !> Name in lower case
      character(parameter_length) :: name = ""
      !> Its number
      real(wp) :: value = 0.0_wp
      !> Whether the deck defines a parameter of this name
      logical :: used = .false.
   end type setting_type

   !> The parameters defined so far
   type, public :: parameter_table_type
      !> The parameters
      type(parameter_type), allocatable :: list(:)
      !> How many there are
      integer :: count = 0
      !> Numbers from the command line
      type(setting_type), allocatable :: settings(:)
   contains
      procedure :: set
      procedure :: choose
      procedure :: check_settings
      procedure :: add
      procedure :: find
      procedure :: advice
   end type parameter_table_type

contains

   !> Set values from the command line
   subroutine set(self, settings, report)
      class(parameter_table_type), intent(inout) :: self
      !> Names and numbers, as in `velocity=3.0`, each with a line feed
      character(*), intent(in) :: settings
      !> Findings
      type(report_type), intent(inout) :: report

      type(setting_type) :: setting
      integer :: begin, equals, last, wrong_at

      allocate (self%settings(0))
      begin = 1
      do while (begin <= len(settings))
         last = begin + index(settings(begin:), achar(10)) - 2
         equals = begin + index(settings(begin:last), "=") - 1
         setting%name = lower_case(settings(begin:equals - 1))
         call read_real(settings(equals + 1:last), setting%value, wrong_at)
         if (equals <= begin .or. wrong_at > 0) then
            call report%refuse(deck_location_type(), "'-p "//settings(begin:last)//"' on the " &
               & //"command line", "a name and a number, as in -p velocity=3.0")
         end if
         self%settings = [self%settings, setting]
         begin = last + 2
      end do
   end subroutine set

   !> Replace the value of a parameter by that of the command line, if there is one
   pure subroutine choose(self, name, value)
      class(parameter_table_type), intent(inout) :: self
      !> Name in either case
      character(*), intent(in) :: name
      !> Value of the deck in, value to use out
      real(wp), intent(inout) :: value

      integer :: i

      do i = 1, size(self%settings)
         if (self%settings(i)%name /= lower_case(name)) cycle
         self%settings(i)%used = .true.
         value = self%settings(i)%value
      end do
   end subroutine choose

   !> Report settings without a parameter in the deck
   subroutine check_settings(self, report)
      class(parameter_table_type), intent(in) :: self
      !> Findings
      type(report_type), intent(inout) :: report

      integer :: i

      do i = 1, size(self%settings)
         if (self%settings(i)%used) cycle
         call report%refuse(deck_location_type(), "'-p "//trim(self%settings(i)%name)//"' on " &
            & //"the command line: the deck does not define this parameter", &
            & self%advice(trim(self%settings(i)%name)))
      end do
   end subroutine check_settings

   !> Define a parameter
   pure subroutine add(self, parameter)
      class(parameter_table_type), intent(inout) :: self
      !> The parameter; its name is new
      type(parameter_type), intent(in) :: parameter

      if (.not. allocated(self%list)) allocate (self%list(0))
      self%list = [self%list, parameter]
      self%count = size(self%list)
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

   !> Suggestion in place of an undefined name
   pure function advice(self, name) result(words)
      class(parameter_table_type), intent(in) :: self
      !> Undefined name
      character(*), intent(in) :: name
      character(:), allocatable :: words

      character(parameter_length) :: known(self%count)
      integer :: i

      words = "a parameter that *PARAMETER defines above this line"
      if (self%count == 0) return
      known(:) = self%list%name
      i = nearest_word(lower_case(name), known)
      if (i == 0) return
      words = "perhaps "//trim(self%list(i)%name)//"; a parameter is defined above its use"
   end function advice

end module plydyn_deck_parameter
