!> Declarations of keywords: the source of parsing, checks and keyword manual.
!>
!> A visit of a keyword builds its declaration, card by card and field by field.
module plydyn_deck_declaration
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: new_field, new_keyword

   !> Origin of a keyword: plydyn's own, or LS-DYNA's
   logical, parameter, public :: extension = .true., standard = .false.
   !> Status of a keyword
   integer, parameter, public :: is_read = 0, is_ignored = 1, is_refused = 2
   !> Kinds of fields; a text fills its card, words are a list that fills its card
   integer, parameter, public :: integer_field = 1, real_field = 2, word_field = 3, &
      & text_field = 4, words_field = 5
   !> Widths of fields, in columns
   integer, parameter, public :: usual_width = 10, long_width = 20, line_width = 80
   !> Longest name of a field
   integer, parameter, public :: name_length = 12

   !> One field of a card
   type, public :: field_type
      !> Name on the card
      character(name_length) :: name = ""
      !> `integer_field`, `real_field`, `word_field`, `text_field` or `words_field`
      integer :: kind = integer_field
      !> Width in columns
      integer :: width = usual_width
      !> Dimension of a real number, in words, and what the field means
      character(:), allocatable :: dimension, sentence
      !> Whether plydyn uses the field; else only neutral values are accepted
      logical :: supported = .true.
      !> What to use in place of a field that earlier versions had; unallocated for other fields
      character(:), allocatable :: successor
      !> Whether a blank is refused
      logical :: required = .true.
      !> Value of a blank field that is not required
      real(wp) :: default = 0.0_wp
      !> Whether a zero stands for the default, as in LS-DYNA
      logical :: zero_is_default = .false.
      !> Smallest value, largest value, exclusive lower bound
      real(wp) :: least = -huge(1.0_wp), most = huge(1.0_wp), above = -huge(1.0_wp)
      !> Accepted numbers; unallocated: all within the bounds
      real(wp), allocatable :: allowed(:)
      !> Words that are accepted, separated by blanks; any if empty
      character(:), allocatable :: words
   end type field_type

   !> One card
   type :: card_type
      !> Its fields
      type(field_type), allocatable :: fields(:)
      !> Whether it may be missing at the end of the keyword, or be repeated, the last card only
      logical :: optional = .false., repeated = .false.
   end type card_type

   !> A keyword
   type, public :: keyword_type
      !> Name without the star
      character(:), allocatable :: name
      !> `extension` or `standard` (LS-DYNA's)
      logical :: own = standard
      !> What it is for
      character(:), allocatable :: sentence
      !> Paragraph for the manual, or advice for a keyword that is refused; empty without one
      character(:), allocatable :: remark
      !> Lines of an example behind the name, each with a line feed; unallocated without one
      character(:), allocatable :: example
      !> Heading of `manual/theory.md` that explains it, as a link, or page and heading; empty
      !> without one
      character(:), allocatable :: theory
      !> `is_read`, `is_ignored` or `is_refused`
      integer :: status = is_read
      !> Whether the set of cards may be repeated, and whether a deck may have it only once
      logical :: repeated = .false., once = .false.
      !> LS-DYNA's number form of the name; empty without one
      character(:), allocatable :: alias
      !> What the deck of a restart changes by it, empty for nothing: it cannot have the keyword
      character(:), allocatable :: change
      !> Suffixes that add a card in front, separated by blanks: TITLE, ID
      character(:), allocatable :: suffixes
      !> Number of cards that a suffix has added in front; width of fields added next, in columns
      integer :: leading_cards = 0, width = usual_width
      !> Its cards
      type(card_type), allocatable :: cards(:)
   contains
      procedure :: append => append_field
      procedure :: add_card
      procedure :: find_field
      procedure :: with_suffix
   end type keyword_type

contains

   !> Begin a declaration
   pure function new_keyword(name) result(keyword)
      !> Name without the star
      character(*), intent(in) :: name
      type(keyword_type) :: keyword

      keyword%name = name
      keyword%sentence = ""
      keyword%remark = ""
      keyword%suffixes = ""
      keyword%change = ""
      keyword%alias = ""
      allocate (keyword%cards(0))
   end function new_keyword

   !> Begin the next card
   pure subroutine add_card(self, optional, repeated)
      class(keyword_type), intent(inout) :: self
      !> Whether it may be missing at the end of the keyword; whether it may be repeated
      logical, intent(in), optional :: optional, repeated

      type(card_type), allocatable :: longer(:)
      integer :: n

      n = size(self%cards) + 1
      allocate (longer(n))
      longer(:n - 1) = self%cards
      allocate (longer(n)%fields(0))
      if (present(optional)) longer(n)%optional = optional
      if (present(repeated)) longer(n)%repeated = repeated
      call move_alloc(longer, self%cards)
   end subroutine add_card

   !> Card of a field and its index on it; zeros if there is none of that name
   pure subroutine find_field(self, name, card, place)
      class(keyword_type), intent(in) :: self
      !> Name of the field
      character(*), intent(in) :: name
      !> Number of its card, and its index on the card
      integer, intent(out) :: card, place

      do card = 1, size(self%cards)
         do place = 1, size(self%cards(card)%fields)
            if (self%cards(card)%fields(place)%name == name) return
         end do
      end do
      card = 0
      place = 0
   end subroutine find_field

   !> The declaration of the keyword with a suffix, which adds a card in front
   pure function with_suffix(self, suffix) result(keyword)
      class(keyword_type), intent(in) :: self
      !> TITLE or ID
      character(*), intent(in) :: suffix
      type(keyword_type) :: keyword

      type(field_type) :: heading

      keyword = self
      keyword%cards = [card_type ::]
      keyword%width = usual_width
      if (suffix == "TITLE") then
         call keyword%append(new_field("TITLE", text_field, "title", .false.))
      else
         call keyword%append(new_field("ID", integer_field, "number, for people only", .false.))
         heading = new_field("HEADING", word_field, "title", .false.)
         heading%words = ""
         heading%width = line_width - usual_width
         call keyword%append(heading)
      end if
      keyword%leading_cards = size(keyword%cards)
      keyword%cards = [keyword%cards, self%cards]
   end function with_suffix

   !> A field without bounds
   pure function new_field(name, kind, sentence, required) result(field)
      character(*), intent(in) :: name, sentence
      !> As in `field_type`
      integer, intent(in) :: kind
      logical, intent(in) :: required
      type(field_type) :: field

      field%name = name
      field%kind = kind
      field%sentence = sentence
      field%required = required
      if (kind == text_field .or. kind == words_field) field%width = line_width
   end function new_field

   !> Append a field to the last card, or to a first one
   pure subroutine append_field(self, field)
      class(keyword_type), intent(inout) :: self
      type(field_type), intent(in) :: field

      type(field_type), allocatable :: longer(:)
      integer :: n

      if (size(self%cards) == 0) call self%add_card()
      associate (card => self%cards(size(self%cards)))
         n = size(card%fields) + 1
         allocate (longer(n))
         longer(:n - 1) = card%fields
         longer(n) = field
         if (field%width == usual_width) longer(n)%width = self%width
         call move_alloc(longer, card%fields)
      end associate
   end subroutine append_field

end module plydyn_deck_declaration
