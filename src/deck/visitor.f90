!> Visits the fields of a keyword in their order: declares them, or gives their values.
!>
!> One routine for each keyword names its fields, with unit, meaning, bounds and default, and says
!> where each value goes. Its first visit declares the keyword, for the parser, the checks of its
!> fields and the manual, and leaves all values alone. Each later one reads a keyword of the deck.
module plydyn_deck_visitor
   use plydyn_base_precision, only : wp
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_declaration, only : field_type, integer_field, name_length, new_field, &
      & new_keyword, real_field, text_field, word_field, words_field
   use plydyn_deck_values, only : longest_word, split_words
   implicit none
   private

   !> A visit of one keyword
   !>
   !> Procedures take the name of a field as `name`, its meaning as `sentence`, and where its value
   !> goes as `value`. A field without `default` is required.
   type, public, extends(cards_type) :: visitor_type
      !> Whether the values of the cards are read; else they are declared
      logical :: reads = .false.
      !> Whether the visit is within sets or rows that repeat
      logical, private :: is_repeating = .false.
   contains
      procedure :: declare
      procedure :: keyword
      procedure :: remark
      procedure :: example
      procedure :: card
      procedure :: next
      procedure :: width
      procedure :: title
      procedure :: text_line
      procedure :: integer => visit_integer
      procedure :: flag
      procedure :: choice
      procedure :: real => visit_real
      procedure :: nonnegative
      procedure :: positive
      procedure :: word
      procedure :: words
      procedure :: unused
      procedure :: zero_is_default
   end type visitor_type

contains

   !> Begin a declaration
   pure subroutine declare(self, name)
      class(visitor_type), intent(inout) :: self
      !> Name of the keyword without the star
      character(*), intent(in) :: name

      self%name = name
      self%declaration = new_keyword(name)
      allocate (self%row_line(0))
   end subroutine declare

   !> What the keyword is, before its fields
   pure subroutine keyword(self, own, sentence, once, suffixes, alias, change)
      class(visitor_type), intent(inout) :: self
      !> `extension` or `standard`
      logical, intent(in) :: own
      !> What it is for
      character(*), intent(in) :: sentence
      !> Whether a deck may have it only once
      logical, intent(in), optional :: once
      !> Suffixes that add a card in front; LS-DYNA's number form of the name; what the deck of a
      !> restart changes by it: without that, a restart cannot have the keyword
      character(*), intent(in), optional :: suffixes, alias, change

      if (self%reads) return
      self%declaration%own = own
      self%declaration%sentence = sentence
      if (present(once)) self%declaration%once = once
      if (present(suffixes)) self%declaration%suffixes = suffixes
      if (present(alias)) self%declaration%alias = alias
      if (present(change)) self%declaration%change = change
   end subroutine keyword

   !> Paragraph for the manual
   pure subroutine remark(self, words)
      class(visitor_type), intent(inout) :: self
      !> The paragraph
      character(*), intent(in) :: words

      if (.not. self%reads) self%declaration%remark = words
   end subroutine remark

   !> Example for the manual, and where it explains the keyword
   pure subroutine example(self, see, lines)
      class(visitor_type), intent(inout) :: self
      !> Heading of `manual/theory.md` as a link, or page and heading
      character(*), intent(in) :: see
      !> Its lines, with bars between them; they fit the deck of `manual/decks.md`, with nodes 1 to
      !> 25 and elements 1 to 4
      character(*), intent(in) :: lines

      integer :: i

      if (self%reads) return
      self%declaration%theory = see
      self%declaration%example = lines//repeat("|", min(1, len(lines)))
      do i = 1, len(self%declaration%example)
         if (self%declaration%example(i:i) == "|") self%declaration%example(i:i) = achar(10)
      end do
   end subroutine example

   !> Begin the next card
   pure subroutine card(self, optional, repeated)
      class(visitor_type), intent(inout) :: self
      !> Whether it may be missing at the end of the keyword; whether it is a last one of many rows
      logical, intent(in), optional :: optional, repeated

      if (.not. self%reads) call self%declaration%add_card(optional, repeated)
   end subroutine card

   !> Go to the next set of cards, or to the next row of a last card behind others; false when there
   !> is no other. A declaration has one.
   logical function next(self, optional)
      class(visitor_type), intent(inout) :: self
      !> Whether there may be no rows
      logical, intent(in), optional :: optional

      if (self%is_repeating) self%nth = self%nth + 1
      next = self%nth <= merge(self%sets(), 1, self%reads)
      if (.not. (self%reads .or. self%is_repeating)) then
         if (size(self%declaration%cards) > 0) then
            call self%declaration%add_card(optional, repeated=.true.)
         else
            self%declaration%repeated = .true.
         end if
      end if
      self%is_repeating = next
      if (.not. next) self%nth = 1
   end function next

   !> Width of the fields that follow, in columns
   pure subroutine width(self, columns)
      class(visitor_type), intent(inout) :: self
      !> The width
      integer, intent(in) :: columns

      self%declaration%width = columns
   end subroutine width

   !> Title of a thing, on a card that the suffix TITLE adds in front
   pure subroutine title(self, value)
      class(visitor_type), intent(inout) :: self
      character(:), allocatable, intent(inout) :: value

      if (self%reads) then
         value = self%entry("TITLE")
      else
         self%declaration%suffixes = "TITLE"
      end if
   end subroutine title

   !> A card that is one line of text
   pure subroutine text_line(self, name, sentence, value)
      class(visitor_type), intent(inout) :: self
      character(*), intent(in) :: name, sentence
      character(:), allocatable, intent(inout) :: value

      if (self%reads) then
         value = self%entry(name)
      else
         call self%declaration%add_card()
         call self%declaration%append(new_field(name, text_field, sentence, .false.))
      end if
   end subroutine text_line

   !> An integer
   pure subroutine visit_integer(self, name, sentence, value, default, least, most, allowed)
      class(visitor_type), intent(inout) :: self
      character(*), intent(in) :: name, sentence
      integer, intent(inout) :: value
      !> Value of a blank, smallest and largest value
      integer, intent(in), optional :: default, least, most
      !> The values that are accepted
      integer, intent(in), optional :: allowed(:)

      type(field_type) :: field

      if (self%reads) then
         value = self%whole(name)
         return
      end if
      field = new_field(name, integer_field, sentence, .not. present(default))
      if (present(default)) field%default = default
      if (present(least)) field%least = least
      if (present(most)) field%most = most
      if (present(allowed)) field%allowed = real(allowed, wp)
      call self%declaration%append(field)
   end subroutine visit_integer

   !> A choice between 0 and 1, which is true
   pure subroutine flag(self, name, sentence, value, default)
      class(visitor_type), intent(inout) :: self
      character(*), intent(in) :: name, sentence
      logical, intent(inout) :: value
      !> Value of a blank; 0 if it is not given
      integer, intent(in), optional :: default

      integer :: number, usual

      usual = 0
      if (present(default)) usual = default
      call self%integer(name, sentence, number, default=usual, allowed=[0, 1])
      if (self%reads) value = number == 1
   end subroutine flag

   !> A choice between the numbers from 0 on, which the program has others for; a blank is 0
   pure subroutine choice(self, name, sentence, value, numbers)
      class(visitor_type), intent(inout) :: self
      character(*), intent(in) :: name, sentence
      integer, intent(inout) :: value
      !> What they are in the program
      integer, intent(in) :: numbers(0:)

      integer :: i, number

      call self%integer(name, sentence, number, default=0, allowed=[(i, i=0, ubound(numbers, 1))])
      if (self%reads) value = numbers(number)
   end subroutine choice

   !> A real number
   pure subroutine visit_real(self, name, dimension, sentence, value, default, least, most)
      class(visitor_type), intent(inout) :: self
      !> With the dimension in words
      character(*), intent(in) :: name, dimension, sentence
      real(wp), intent(inout) :: value
      !> Value of a blank, smallest and largest value
      real(wp), intent(in), optional :: default, least, most

      type(field_type) :: field

      if (self%reads) then
         value = self%number(name)
         return
      end if
      field = new_field(name, real_field, sentence, .not. present(default))
      field%dimension = dimension
      if (present(default)) field%default = default
      if (present(least)) field%least = least
      if (present(most)) field%most = most
      call self%declaration%append(field)
   end subroutine visit_real

   !> A real number of 0 or more; a blank is 0
   pure subroutine nonnegative(self, name, dimension, sentence, value)
      class(visitor_type), intent(inout) :: self
      character(*), intent(in) :: name, dimension, sentence
      real(wp), intent(inout) :: value

      call self%real(name, dimension, sentence, value, default=0.0_wp, least=0.0_wp)
   end subroutine nonnegative

   !> A real number above 0, or above another bound
   pure subroutine positive(self, name, dimension, sentence, value, default, most, above)
      class(visitor_type), intent(inout) :: self
      character(*), intent(in) :: name, dimension, sentence
      real(wp), intent(inout) :: value
      !> Value of a blank, largest value, bound; 0 if it is not given
      real(wp), intent(in), optional :: default, most, above

      call self%real(name, dimension, sentence, value, default=default, most=most)
      if (self%reads) return
      associate (card => self%declaration%cards(size(self%declaration%cards)))
         card%fields(size(card%fields))%above = 0.0_wp
         if (present(above)) card%fields(size(card%fields))%above = above
      end associate
   end subroutine positive

   !> A word
   pure subroutine word(self, name, sentence, value, words, required)
      class(visitor_type), intent(inout) :: self
      character(*), intent(in) :: name, sentence
      character(:), allocatable, intent(inout) :: value
      !> Words that are accepted, separated by blanks
      character(*), intent(in) :: words
      !> False when it may be blank
      logical, intent(in) :: required

      type(field_type) :: field

      if (self%reads) then
         value = self%entry(name)
      else
         field = new_field(name, word_field, sentence, required)
         field%words = words
         call self%declaration%append(field)
      end if
   end subroutine word

   !> A line of words, separated by blanks or commas
   pure subroutine words(self, name, sentence, value, known)
      class(visitor_type), intent(inout) :: self
      character(*), intent(in) :: name, sentence
      character(longest_word), allocatable, intent(inout) :: value(:)
      !> Words that are accepted, separated by blanks
      character(*), intent(in) :: known

      type(field_type) :: field

      if (self%reads) then
         value = split_words(self%entry(name))
      else
         field = new_field(name, words_field, sentence, .true.)
         field%words = known
         call self%declaration%append(field)
      end if
   end subroutine words

   !> Fields that are refused unless they are blank or hold a neutral value
   pure subroutine unused(self, names, neutral, word, successor)
      class(visitor_type), intent(inout) :: self
      !> Names on the card, separated by blanks
      character(*), intent(in) :: names
      !> Values that change nothing; 0 if not given
      real(wp), intent(in), optional :: neutral(:)
      !> Words that change nothing, for fields that hold a word
      character(*), intent(in), optional :: word
      !> What to use in place of fields that earlier versions had
      character(*), intent(in), optional :: successor

      character(longest_word), allocatable :: list(:)
      type(field_type) :: field
      integer :: i

      if (self%reads) return
      field = new_field("", merge(word_field, real_field, present(word)), "not supported", .false.)
      field%supported = .false.
      field%dimension = ""
      field%allowed = [0.0_wp]
      if (present(word)) field%words = word
      if (present(neutral)) field%allowed = neutral
      if (present(successor)) then
         field%successor = successor
         field%sentence = "removed: "//successor
      end if
      list = split_words(names)
      do i = 1, size(list)
         field%name = list(i) (:name_length)
         call self%declaration%append(field)
      end do
   end subroutine unused

   !> Make a zero in the last field stand for its default, as in LS-DYNA
   pure subroutine zero_is_default(self)
      class(visitor_type), intent(inout) :: self

      if (self%reads) return
      associate (card => self%declaration%cards(size(self%declaration%cards)))
         card%fields(size(card%fields))%zero_is_default = .true.
      end associate
   end subroutine zero_is_default

end module plydyn_deck_visitor
