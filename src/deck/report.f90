!> Findings of a deck: errors, warnings and notes, a limited number of each kind.
module plydyn_deck_report
   use plydyn_deck_number, only : is_digit
   implicit none
   private

   !> Largest number of findings of one kind that are shown
   integer, parameter, public :: max_per_kind = 5
   !> Severity of a finding
   integer, parameter, public :: severity_error = 1, severity_warning = 2, severity_note = 3

   !> Position in the deck
   type, public :: deck_location_type
      !> Line, an index into the lines of the source; 0 without one, -1 beside all decks
      integer :: line = 0
      !> First and last column of the field, or of the text; 0 if unknown
      integer :: first = 0, last = 0
      !> Index of the field in a line in free format; 0 in fixed columns
      integer :: comma = 0
      !> Keyword with its star, empty without one
      character(:), allocatable :: keyword
      !> Number of the card, 0 without one
      integer :: card = 0
      !> Name of the field, empty without one
      character(:), allocatable :: field
   end type deck_location_type

   !> One finding
   type, public :: finding_type
      !> `severity_error`, `severity_warning` or `severity_note`
      integer :: severity = severity_error
      !> Its position
      type(deck_location_type) :: place
      !> What is wrong, and what would be right
      character(:), allocatable :: wrong, right
      !> Related line, such as the first definition, 0 without one; index into `report_type%kinds`
      integer :: also = 0, kind = 0
   end type finding_type

   !> Error in a text, before its place in the deck is known
   type, public :: fault_type
      !> First wrong character; 0 without error
      integer :: at = 0
      !> What is wrong, empty if it has been reported already, and what would be right
      character(:), allocatable :: wrong, right
   contains
      procedure :: set
   end type fault_type

   !> Findings that differ only in numbers and quotations
   type :: kind_type
      !> Keyword and message without numbers and quotations
      character(:), allocatable :: pattern
      !> Number found, shown or not
      integer :: count = 0
   end type kind_type

   !> All findings of a deck
   type, public :: report_type
      !> The findings that are shown
      type(finding_type), allocatable :: findings(:)
      !> Number of shown findings
      integer :: shown = 0
      !> Kinds of findings
      type(kind_type), allocatable :: kinds(:)
      !> Number of findings of each severity
      integer :: count(3) = 0
   contains
      procedure :: refuse
      procedure :: warn
      procedure :: note
      procedure :: has_errors
   end type report_type

contains

   !> Set what is wrong from some character on, and what would be right
   pure subroutine set(self, at, wrong, right)
      class(fault_type), intent(inout) :: self
      integer, intent(in) :: at
      character(*), intent(in) :: wrong, right

      self%at = at
      self%wrong = wrong
      self%right = right
   end subroutine set

   !> Add an error
   subroutine refuse(self, place, wrong, right, also)
      class(report_type), intent(inout) :: self
      !> Its position
      type(deck_location_type), intent(in) :: place
      !> What is wrong, and what would be right
      character(*), intent(in) :: wrong, right
      !> Related line
      integer, intent(in), optional :: also

      call add(self, severity_error, place, wrong, right, also)
   end subroutine refuse

   !> Add a warning
   subroutine warn(self, place, wrong, right, also)
      class(report_type), intent(inout) :: self
      !> Its position
      type(deck_location_type), intent(in) :: place
      !> What is doubtful, and what to do about it
      character(*), intent(in) :: wrong, right
      !> Related line
      integer, intent(in), optional :: also

      call add(self, severity_warning, place, wrong, right, also)
   end subroutine warn

   !> Add a note
   subroutine note(self, place, what, consequence)
      class(report_type), intent(inout) :: self
      !> Its position
      type(deck_location_type), intent(in) :: place
      !> The fact, and its consequence
      character(*), intent(in) :: what, consequence

      call add(self, severity_note, place, what, consequence)
   end subroutine note

   !> Whether there is at least one error
   pure logical function has_errors(self)
      class(report_type), intent(in) :: self

      has_errors = self%count(severity_error) > 0
   end function has_errors

   !> Count a finding, and append it unless its kind has reached the limit
   subroutine add(self, severity, place, wrong, right, also)
      type(report_type), intent(inout) :: self
      !> `severity_error`, `severity_warning` or `severity_note`
      integer, intent(in) :: severity
      type(deck_location_type), intent(in) :: place
      character(*), intent(in) :: wrong, right
      integer, intent(in), optional :: also

      type(finding_type) :: finding

      self%count(severity) = self%count(severity) + 1
      call count_kind(self, kind_pattern(place, wrong), finding%kind)
      if (self%kinds(finding%kind)%count > max_per_kind) return
      finding%severity = severity
      finding%place = place
      finding%wrong = wrong
      finding%right = right
      if (present(also)) finding%also = also
      if (.not. allocated(self%findings)) allocate (self%findings(0))
      self%findings = [self%findings, finding]
      self%shown = size(self%findings)
   end subroutine add

   !> Count a finding of a new or known kind
   subroutine count_kind(self, pattern, kind)
      type(report_type), intent(inout) :: self
      !> Keyword and message without numbers and quotations
      character(*), intent(in) :: pattern
      !> Index of the kind
      integer, intent(out) :: kind

      type(kind_type) :: new

      if (.not. allocated(self%kinds)) allocate (self%kinds(0))
      do kind = 1, size(self%kinds)
         if (self%kinds(kind)%pattern == pattern) exit
      end do
      if (kind > size(self%kinds)) then
         new%pattern = pattern
         self%kinds = [self%kinds, new]
      end if
      self%kinds(kind)%count = self%kinds(kind)%count + 1
   end subroutine count_kind

   !> Keyword and message without numbers and quotations
   pure function kind_pattern(place, wrong) result(pattern)
      type(deck_location_type), intent(in) :: place
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
   end function kind_pattern

end module plydyn_deck_report
