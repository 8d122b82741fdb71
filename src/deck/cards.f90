!> Cards of one keyword: values by field name, each with its position in the deck.
module plydyn_deck_cards
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : keyword_type, line_width, long_width, text_field
   use plydyn_deck_report, only : deck_location_type
   implicit none
   private

   !> State of a field; an absent field differs from a zero
   integer, parameter, public :: is_absent = 0, is_given = 1, is_wrong = 2

   !> One keyword of a deck with its cards
   !>
   !> Procedures take the name of a field as `name`. Their `nth` is the number of the set of cards
   !> where the keyword repeats them, or of the row of a repeated last card; the default is that of
   !> the cards.
   type, public :: cards_type
      !> Name as declared, empty for a keyword that is not read
      character(:), allocatable :: name
      !> Whether it is unknown or refused: what it would have defined is missing
      logical :: is_unread = .false.
      !> Its index in the list of known keywords; 0 for one that is not read
      integer :: known = 0
      !> What the keyword declares, its suffixes included
      type(keyword_type) :: declaration
      !> Whether every field has 20 columns
      logical :: long = .false.
      !> Line of the keyword, an index into the lines of the source
      integer :: line = 0
      !> Number of the deck that it belongs to, directly or by include files
      integer :: root = 1
      !> Line of each row, and whether it is in free format
      integer, allocatable :: row_line(:)
      logical, allocatable :: row_free(:)
      !> Numbers, (fields, rows); the default where a field is absent
      real(wp), allocatable :: value(:, :)
      !> `is_absent`, `is_given` or `is_wrong`, (fields, rows)
      integer, allocatable :: state(:, :)
      !> Words and texts, (fields, rows); no rows for a keyword without any
      character(line_width), allocatable :: text(:, :)
      !> Set of cards, or row of a repeated last card, that is looked at
      integer :: nth = 1
   contains
      procedure :: sets
      procedure :: has
      procedure :: is_fine
      procedure :: number
      procedure :: whole
      procedure :: entry => text_of
      procedure :: head
      procedure :: place
      procedure :: place_in_row
      procedure :: line_of
      procedure :: column_width
      procedure :: card_of_row
      procedure :: shown_card
      procedure, private :: find
   end type cards_type

contains

   !> Number of sets of cards, or of rows of a last card that is repeated
   pure integer function sets(self)
      class(cards_type), intent(in) :: self

      integer :: cards

      sets = 0
      if (size(self%row_line) == 0) return
      cards = size(self%declaration%cards)
      sets = size(self%row_line)
      if (self%declaration%repeated) then
         sets = sets/cards
      else if (self%declaration%cards(cards)%repeated) then
         sets = max(sets - cards + 1, 0)
      else
         sets = min(sets, 1)
      end if
   end function sets

   !> Whether a field is given and valid
   pure logical function has(self, name, nth)
      class(cards_type), intent(in) :: self
      character(*), intent(in) :: name
      integer, intent(in), optional :: nth

      integer :: column, row

      call self%find(name, column, row, nth)
      has = row > 0
      if (has) has = self%state(column, row) == is_given
   end function has

   !> Whether a field is valid or absent: no error has been reported for it, or for its card
   pure logical function is_fine(self, name)
      class(cards_type), intent(in) :: self
      character(*), intent(in) :: name

      integer :: card, column, row

      call self%find(name, column, row)
      if (row > 0) then
         is_fine = self%state(column, row) /= is_wrong
      else
         call self%declaration%find_field(name, card, column)
         is_fine = card == 0
         if (card > 0) is_fine = self%declaration%cards(card)%optional
      end if
   end function is_fine

   !> Number in a field; its default when it is absent
   pure real(wp) function number(self, name, nth)
      class(cards_type), intent(in) :: self
      character(*), intent(in) :: name
      integer, intent(in), optional :: nth

      integer :: card, column, row

      call self%find(name, column, row, nth)
      if (row > 0) then
         number = self%value(column, row)
      else
         call self%declaration%find_field(name, card, column)
         number = self%declaration%cards(card)%fields(column)%default
      end if
   end function number

   !> Integer in a field; its default when it is absent
   pure integer function whole(self, name, nth)
      class(cards_type), intent(in) :: self
      character(*), intent(in) :: name
      integer, intent(in), optional :: nth

      whole = nint(self%number(name, nth))
   end function whole

   !> Word or text in a field; empty when it is absent
   pure function text_of(self, name) result(word)
      class(cards_type), intent(in) :: self
      character(*), intent(in) :: name
      character(:), allocatable :: word

      integer :: column, row

      word = ""
      call self%find(name, column, row)
      if (row > 0) word = trim(self%text(column, row))
   end function text_of

   !> Position of the keyword
   pure type(deck_location_type) function head(self)
      class(cards_type), intent(in) :: self

      head%line = self%line
      head%keyword = "*"//self%declaration%name
   end function head

   !> Position of a field
   pure type(deck_location_type) function place(self, name, nth)
      class(cards_type), intent(in) :: self
      character(*), intent(in) :: name
      integer, intent(in), optional :: nth

      integer :: column, row

      call self%find(name, column, row, nth)
      if (row > 0) then
         place = self%place_in_row(row, column)
      else
         place = self%head()
         place%field = trim(name)
      end if
   end function place

   !> Position of a field by its row and its index on the card
   pure type(deck_location_type) function place_in_row(self, row, column) result(place)
      class(cards_type), intent(in) :: self
      integer, intent(in) :: row, column

      integer :: card

      card = self%card_of_row(row)
      place = self%head()
      place%field = trim(self%declaration%cards(card)%fields(column)%name)
      place%line = self%row_line(row)
      place%card = self%shown_card(row)
      if (self%row_free(row)) place%comma = column
      place%first = sum(self%column_width(card, column - 1)) + 1
      place%last = sum(self%column_width(card, column))
   end function place_in_row

   !> Line of a field
   pure integer function line_of(self, name) result(line)
      class(cards_type), intent(in) :: self
      character(*), intent(in) :: name

      integer :: column, row

      call self%find(name, column, row)
      line = self%line
      if (row > 0) line = self%row_line(row)
   end function line_of

   !> Widths of the first fields of a card, in columns
   pure function column_width(self, card, fields) result(width)
      class(cards_type), intent(in) :: self
      !> Number of the card, and number of fields
      integer, intent(in) :: card, fields
      integer :: width(fields)

      width(:) = self%declaration%cards(card)%fields(:fields)%width
      if (.not. self%long) return
      width(:) = max(width, long_width)
      where (self%declaration%cards(card)%fields(:fields)%kind == text_field) width = line_width
   end function column_width

   !> Number of the card in a row
   pure integer function card_of_row(self, row) result(card)
      class(cards_type), intent(in) :: self
      !> Row of the keyword
      integer, intent(in) :: row

      integer :: cards

      cards = size(self%declaration%cards)
      card = min(row, cards)
      if (self%declaration%repeated) card = modulo(row - 1, cards) + 1
   end function card_of_row

   !> Number of the card in a row, as the manual counts; 0 for a card that a suffix adds
   pure integer function shown_card(self, row) result(card)
      class(cards_type), intent(in) :: self
      !> Row of the keyword
      integer, intent(in) :: row

      card = max(0, self%card_of_row(row) - self%declaration%leading_cards)
   end function shown_card

   !> Column and row of a field; row 0 when the deck has no such card
   pure subroutine find(self, name, column, row, nth)
      class(cards_type), intent(in) :: self
      character(*), intent(in) :: name
      !> Index of the field on its card, and row of the keyword
      integer, intent(out) :: column, row
      integer, intent(in), optional :: nth

      integer :: card, n

      n = self%nth
      if (present(nth)) n = nth
      call self%declaration%find_field(name, card, column)
      row = card
      if (card == 0) return
      if (self%declaration%repeated) then
         row = (n - 1)*size(self%declaration%cards) + card
      else if (self%declaration%cards(card)%repeated) then
         row = card + n - 1
      end if
      if (row > size(self%row_line)) row = 0
   end subroutine find

end module plydyn_deck_cards
