!> What is wrong with a deck: all findings of one pass, at most some of a kind.
module plydyn_deck_report
   use plydyn_deck_number, only : is_digit
   implicit none
   private

   !> Findings of one kind that are shown
   integer, parameter, public :: most_of_a_kind = 5
   !> How grave a finding is
   integer, parameter, public :: grave_error = 1, grave_warning = 2, grave_note = 3

   !> Where in the deck
   type, public :: file_position_type
      !> Line, an index into the lines of the source; 0 for nowhere in particular
      integer :: line = 0
      !> First and last column of the field in fixed columns, or of the text itself; 0 if unknown
      integer :: first = 0, last = 0
      !> Place of the field among the commas of a line in free format; 0 if columns say it all
      integer :: comma = 0
      !> Keyword with its star, empty without one
      character(:), allocatable :: keyword
      !> Number of the card, 0 without one
      integer :: card = 0
      !> Name of the field, empty without one
      character(:), allocatable :: field
   end type file_position_type

   !> One thing that is wrong
   type, public :: finding_type
      !> `grave_error`, `grave_warning` or `grave_note`
      integer :: gravity = grave_error
      !> Where
      type(file_position_type) :: place
      !> What is wrong
      character(:), allocatable :: wrong
      !> What would be right
      character(:), allocatable :: right
      !> Another line that matters, such as the first definition; 0 without one
      integer :: also = 0
      !> Index into the kinds of the report
      integer :: kind = 0
   end type finding_type

   !> Findings that differ in their numbers and quotations only
   type :: kind_type
      !> Keyword and message without numbers and quotations
      character(:), allocatable :: pattern
      !> How many were found, shown or not
      integer :: count = 0
   end type kind_type

   !> All findings of a deck
   type, public :: report_type
      !> The findings that are shown, as many as `shown`
      type(finding_type), allocatable :: findings(:)
      !> How many findings are shown
      integer :: shown = 0
      !> Kinds of findings, as many as `kinds_met`
      type(kind_type), allocatable :: kinds(:)
      !> How many kinds there are
      integer :: kinds_met = 0
      !> How many findings there are of each gravity
      integer :: count(3) = 0
   contains
      procedure :: refuse
      procedure :: warn
      procedure :: note
      procedure :: has_errors
   end type report_type

contains

   !> Add an error
   subroutine refuse(self, place, wrong, right, also)
      class(report_type), intent(inout) :: self
      !> Where
      type(file_position_type), intent(in) :: place
      !> What is wrong
      character(*), intent(in) :: wrong
      !> What would be right
      character(*), intent(in) :: right
      !> Another line that matters
      integer, intent(in), optional :: also

      call add(self, grave_error, place, wrong, right, also)
   end subroutine refuse

   !> Add a warning
   subroutine warn(self, place, wrong, right, also)
      class(report_type), intent(inout) :: self
      !> Where
      type(file_position_type), intent(in) :: place
      !> What is suspicious
      character(*), intent(in) :: wrong
      !> What to do about it
      character(*), intent(in) :: right
      !> Another line that matters
      integer, intent(in), optional :: also

      call add(self, grave_warning, place, wrong, right, also)
   end subroutine warn

   !> Add something worth knowing
   subroutine note(self, place, what, consequence)
      class(report_type), intent(inout) :: self
      !> Where
      type(file_position_type), intent(in) :: place
      !> What is worth knowing
      character(*), intent(in) :: what
      !> What comes of it
      character(*), intent(in) :: consequence

      call add(self, grave_note, place, what, consequence)
   end subroutine note

   !> At least one error was found
   pure logical function has_errors(self)
      class(report_type), intent(in) :: self

      has_errors = self%count(grave_error) > 0
   end function has_errors

   !> Count a finding, and keep it if there are not too many of its kind yet
   subroutine add(self, gravity, place, wrong, right, also)
      type(report_type), intent(inout) :: self
      !> `grave_error`, `grave_warning` or `grave_note`
      integer, intent(in) :: gravity
      !> Where
      type(file_position_type), intent(in) :: place
      !> What is wrong
      character(*), intent(in) :: wrong
      !> What would be right
      character(*), intent(in) :: right
      !> Another line that matters
      integer, intent(in), optional :: also

      type(finding_type) :: finding

      self%count(gravity) = self%count(gravity) + 1
      call count_kind(self, pattern_of(place, wrong), finding%kind)
      if (self%kinds(finding%kind)%count > most_of_a_kind) return
      finding%gravity = gravity
      finding%place = place
      finding%wrong = wrong
      finding%right = right
      if (present(also)) finding%also = also
      call keep(self, finding)
   end subroutine add

   !> Append a finding
   subroutine keep(self, finding)
      type(report_type), intent(inout) :: self
      !> The finding
      type(finding_type), intent(in) :: finding

      type(finding_type), allocatable :: longer(:)

      if (.not. allocated(self%findings)) allocate (self%findings(8))
      if (self%shown == size(self%findings)) then
         allocate (longer(2*self%shown))
         longer(:self%shown) = self%findings
         call move_alloc(longer, self%findings)
      end if
      self%shown = self%shown + 1
      self%findings(self%shown) = finding
   end subroutine keep

   !> Count a finding of a kind, new or known
   subroutine count_kind(self, pattern, kind)
      type(report_type), intent(inout) :: self
      !> What all findings of the kind have in common
      character(*), intent(in) :: pattern
      !> Index of the kind
      integer, intent(out) :: kind

      type(kind_type), allocatable :: longer(:)

      if (.not. allocated(self%kinds)) allocate (self%kinds(8))
      do kind = 1, self%kinds_met
         if (self%kinds(kind)%pattern == pattern) exit
      end do
      if (kind > size(self%kinds)) then
         allocate (longer(2*size(self%kinds)))
         longer(:self%kinds_met) = self%kinds
         call move_alloc(longer, self%kinds)
      end if
      if (kind > self%kinds_met) self%kinds(kind)%pattern = pattern
      self%kinds_met = max(kind, self%kinds_met)
      self%kinds(kind)%count = self%kinds(kind)%count + 1
   end subroutine count_kind

   !> Keyword and message with every number and quotation taken out
   pure function pattern_of(place, wrong) result(pattern)
      !> Where
      type(file_position_type), intent(in) :: place
      !> What is wrong
      character(*), intent(in) :: wrong
      character(:), allocatable :: pattern

      logical :: quoted
      integer :: i

      pattern = ""
      if (allocated(place%keyword)) pattern = place%keyword
      quoted = .false.
      do i = 1, len(wrong)
         if (wrong(i:i) == "'") quoted = .not. quoted
         if (quoted .or. is_digit(wrong(i:i)) .or. wrong(i:i) == "'") cycle
         pattern = pattern//wrong(i:i)
      end do
   end function pattern_of

end module plydyn_deck_report
