!> Declarations of keywords: the source of parsing, checks and keyword manual.
!>
!> A declaration is built card by card and field by field. The first field begins the first card:
!>
!>     keyword = new_keyword("IMPACTOR_SPHERE", extension, "A rigid sphere that may hit a part.")
!>     call keyword%add_integer("IID", "number of the impactor", least=1)
!>     call keyword%add_real("RADIUS", "length", "radius", above=0.0_wp)
module plydyn_deck_declaration
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: new_keyword

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
      !> Dimension of a real number, in words
      character(:), allocatable :: dimension
      !> What it means
      character(:), allocatable :: sentence
      !> Whether plydyn uses the field; else only neutral values are accepted
      logical :: supported = .true.
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
      !> Whether it may be missing at the end of the keyword
      logical :: optional = .false.
      !> Whether it may be repeated; the last card only
      logical :: repeated = .false.
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
      !> Whether the set of cards may be repeated
      logical :: repeated = .false.
      !> Whether a deck may have it only once
      logical :: once = .false.
      !> LS-DYNA's number form of the name; empty without one
      character(:), allocatable :: alias
      !> Suffixes that add a card in front, separated by blanks: TITLE, ID
      character(:), allocatable :: suffixes
      !> Number of cards that a suffix has added in front
      integer :: leading_cards = 0
      !> Width of fields added next, in columns
      integer :: width = usual_width
      !> Its cards
      type(card_type), allocatable :: cards(:)
   contains
      procedure :: add_card
      procedure :: add_text_card
      procedure :: add_integer
      procedure :: add_real
      procedure :: add_nonnegative
      procedure :: add_word
      procedure :: add_words
      procedure :: add_list
      procedure :: add_unused
      procedure :: zero_is_default
      procedure :: find_field
      procedure :: with_suffix
   end type keyword_type

contains

   !> Begin a declaration
   pure function new_keyword(name, own, sentence, repeated, suffixes, alias) result(keyword)
      !> Name without the star
      character(*), intent(in) :: name
      !> `extension` or `standard`
      logical, intent(in) :: own
      !> What it is for
      character(*), intent(in) :: sentence
      !> Whether the set of cards may be repeated
      logical, intent(in), optional :: repeated
      !> Suffixes that add a card in front
      character(*), intent(in), optional :: suffixes
      !> LS-DYNA's number form of the name
      character(*), intent(in), optional :: alias
      type(keyword_type) :: keyword

      keyword%name = name
      keyword%own = own
      keyword%sentence = sentence
      keyword%remark = ""
      keyword%suffixes = ""
      keyword%alias = ""
      if (present(repeated)) keyword%repeated = repeated
      if (present(suffixes)) keyword%suffixes = suffixes
      if (present(alias)) keyword%alias = alias
      allocate (keyword%cards(0))
   end function new_keyword

   !> Begin the next card
   pure subroutine add_card(self, optional, repeated)
      class(keyword_type), intent(inout) :: self
      !> Whether it may be missing at the end of the keyword
      logical, intent(in), optional :: optional
      !> Whether it may be repeated
      logical, intent(in), optional :: repeated

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

   !> Add a card that is one line of text
   pure subroutine add_text_card(self, name, sentence)
      class(keyword_type), intent(inout) :: self
      !> Name of the text, and what it means
      character(*), intent(in) :: name, sentence

      type(field_type) :: field

      call self%add_card()
      field%kind = text_field
      field%width = line_width
      field%required = .false.
      call append(self, field, name, sentence)
   end subroutine add_text_card

   !> Add an integer; it is required unless it has a default
   pure subroutine add_integer(self, name, sentence, default, least, most, allowed)
      class(keyword_type), intent(inout) :: self
      !> Name on the card, and what it means
      character(*), intent(in) :: name, sentence
      !> Value of a blank
      integer, intent(in), optional :: default
      !> Smallest and largest value
      integer, intent(in), optional :: least, most
      !> The values that are accepted
      integer, intent(in), optional :: allowed(:)

      type(field_type) :: field

      field%required = .not. present(default)
      if (present(default)) field%default = default
      if (present(least)) field%least = least
      if (present(most)) field%most = most
      if (present(allowed)) field%allowed = real(allowed, wp)
      call append(self, field, name, sentence)
   end subroutine add_integer

   !> Add a real number; it is required unless it has a default
   pure subroutine add_real(self, name, dimension, sentence, default, least, above, most)
      class(keyword_type), intent(inout) :: self
      !> Name on the card, and dimension in words
      character(*), intent(in) :: name, dimension
      !> What it means
      character(*), intent(in) :: sentence
      !> Value of a blank
      real(wp), intent(in), optional :: default
      !> Smallest value, value that must be exceeded, largest value
      real(wp), intent(in), optional :: least, above, most

      type(field_type) :: field

      field%kind = real_field
      field%dimension = dimension
      field%required = .not. present(default)
      if (present(default)) field%default = default
      if (present(least)) field%least = least
      if (present(above)) field%above = above
      if (present(most)) field%most = most
      call append(self, field, name, sentence)
   end subroutine add_real

   !> Add a real number of 0 or more; a blank is 0
   pure subroutine add_nonnegative(self, name, dimension, sentence)
      class(keyword_type), intent(inout) :: self
      !> As in `add_real`
      character(*), intent(in) :: name, dimension, sentence

      call self%add_real(name, dimension, sentence, default=0.0_wp, least=0.0_wp)
   end subroutine add_nonnegative

   !> Add a word
   pure subroutine add_word(self, name, sentence, words, required)
      class(keyword_type), intent(inout) :: self
      !> Name on the card, and what it means
      character(*), intent(in) :: name, sentence
      !> Words that are accepted, separated by blanks
      character(*), intent(in) :: words
      !> False when it may be blank
      logical, intent(in) :: required

      type(field_type) :: field

      field%kind = word_field
      field%required = required
      field%words = words
      call append(self, field, name, sentence)
   end subroutine add_word

   !> Add a line of words, separated by blanks or commas
   pure subroutine add_words(self, name, sentence, words)
      class(keyword_type), intent(inout) :: self
      !> Name of the words, and what they mean
      character(*), intent(in) :: name, sentence
      !> Words that are accepted, separated by blanks
      character(*), intent(in) :: words

      type(field_type) :: field

      field%kind = words_field
      field%width = line_width
      field%words = words
      call append(self, field, name, sentence)
   end subroutine add_words

   !> Add a list of integers: `NID` becomes NID1, NID2 and so on; trailing blanks are no members
   pure subroutine add_list(self, name, number, sentence)
      class(keyword_type), intent(inout) :: self
      !> Name without number
      character(*), intent(in) :: name
      !> Fields on the card
      integer, intent(in) :: number
      !> What a member means
      character(*), intent(in) :: sentence

      character(2) :: digits
      integer :: i

      do i = 1, number
         write (digits, "(i0)") i
         if (i == 1) call self%add_integer(name//trim(digits), sentence, least=1)
         if (i > 1) call self%add_integer(name//trim(digits), sentence, default=0, least=1)
      end do
   end subroutine add_list

   !> Add fields that are refused unless they are blank or hold a neutral value
   pure subroutine add_unused(self, names, neutral, word)
      class(keyword_type), intent(inout) :: self
      !> Names on the card, separated by blanks
      character(*), intent(in) :: names
      !> Values that change nothing; 0 if not given
      real(wp), intent(in), optional :: neutral(:)
      !> Words that change nothing, for fields that hold a word
      character(*), intent(in), optional :: word

      type(field_type) :: field
      integer :: begin, length

      field%supported = .false.
      field%required = .false.
      field%kind = merge(word_field, real_field, present(word))
      field%dimension = ""
      if (present(word)) field%words = word
      field%allowed = [0.0_wp]
      if (present(neutral)) field%allowed = neutral
      begin = 1
      do while (begin <= len_trim(names))
         length = index(names(begin:)//" ", " ") - 1
         call append(self, field, names(begin:begin + length - 1), "not supported")
         begin = begin + length + 1
      end do
   end subroutine add_unused

   !> Make a zero in the last field stand for its default, as in LS-DYNA
   pure subroutine zero_is_default(self)
      class(keyword_type), intent(inout) :: self

      associate (card => self%cards(size(self%cards)))
         card%fields(size(card%fields))%zero_is_default = .true.
      end associate
   end subroutine zero_is_default

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

      keyword = self
      deallocate (keyword%cards)
      allocate (keyword%cards(0))
      keyword%width = usual_width
      if (suffix == "TITLE") then
         call keyword%add_text_card("TITLE", "title")
      else
         call keyword%add_card()
         call keyword%add_integer("ID", "number, for people only", default=0)
         call keyword%add_word("HEADING", "title", words="", required=.false.)
         keyword%cards(1)%fields(2)%width = line_width - usual_width
      end if
      keyword%leading_cards = size(keyword%cards)
      keyword%cards = [keyword%cards, self%cards]
   end function with_suffix

   !> Append a field to the last card, or to a first one
   pure subroutine append(self, field, name, sentence)
      type(keyword_type), intent(inout) :: self
      !> The field without names
      type(field_type), intent(in) :: field
      !> Name on the card, and what it means
      character(*), intent(in) :: name, sentence

      type(field_type), allocatable :: longer(:)
      integer :: n

      if (size(self%cards) == 0) call self%add_card()
      associate (card => self%cards(size(self%cards)))
         n = size(card%fields) + 1
         allocate (longer(n))
         longer(:n - 1) = card%fields
         longer(n) = field
         longer(n)%name = name
         longer(n)%sentence = sentence
         if (field%width == usual_width) longer(n)%width = self%width
         call move_alloc(longer, card%fields)
      end associate
   end subroutine append

end module plydyn_deck_declaration
