!> Reads the rows of a keyword, one for each card, into numbers and words, field by field.
module plydyn_deck_rows
   use plydyn_base_text, only : printable, text, upper_case
   use plydyn_deck_cards, only : cards_type, is_absent, is_given, is_wrong
   use plydyn_deck_declaration, only : field_type, keyword_type, line_width, text_field, &
      & word_field, words_field
   use plydyn_deck_layout, only : is_free, last_column, locate, span_type
   use plydyn_deck_parameter, only : parameter_table_type
   use plydyn_deck_report, only : deck_location_type, fault_type, report_type
   use plydyn_deck_values, only : check_word, longest_word, range_words, read_number, split_words
   use plydyn_deck_source, only : source_type
   implicit none
   private

   public :: read_rows

   character(*), parameter :: tab = achar(9)

contains

   !> Read one row
   subroutine read_row(line, row, parameters, cards, report)
      character(*), intent(in) :: line
      integer, intent(in) :: row
      type(parameter_table_type), intent(in) :: parameters
      !> Gets values and states
      type(cards_type), intent(inout) :: cards
      type(report_type), intent(inout) :: report

      integer :: card

      card = cards%card_of_row(row)
      associate (fields => cards%declaration%cards(card)%fields)
         cards%value(:size(fields), row) = fields%default
         cards%state(:, row) = is_absent
         if (fields(1)%kind == text_field) then
            call read_text(line, row, cards, report)
         else if (fields(1)%kind == words_field) then
            call read_words(line, row, fields(1), cards, report)
         else if (index(line, tab) > 0 .and. .not. is_free(line)) then
            cards%state(:, row) = is_wrong
            call report%refuse(at_column(cards, row, index(line, tab)), &
               & "a tab in fixed columns", "blanks, or commas between the fields")
         else
            call read_fields(line, row, fields, parameters, cards, report)
         end if
      end associate
   end subroutine read_row

   !> A line of text
   subroutine read_text(line, row, cards, report)
      character(*), intent(in) :: line
      integer, intent(in) :: row
      !> Gets the text
      type(cards_type), intent(inout) :: cards
      type(report_type), intent(inout) :: report

      cards%text(1, row) = printable(adjustl(line))
      cards%state(1, row) = merge(is_given, is_absent, len_trim(line) > 0)
      if (len(line) > line_width) then
         call report%refuse(at_column(cards, row, line_width + 1), &
            & "the text is longer than 80 characters", "at most 80 characters")
      end if
   end subroutine read_text

   !> A line of words
   subroutine read_words(line, row, field, cards, report)
      character(*), intent(in) :: line
      integer, intent(in) :: row
      type(field_type), intent(in) :: field
      !> Gets the words in capitals
      type(cards_type), intent(inout) :: cards
      type(report_type), intent(inout) :: report

      character(longest_word), allocatable :: words(:)
      type(fault_type) :: fault
      integer :: i

      cards%text(1, row) = upper_case(line)
      cards%state(1, row) = is_given
      words = split_words(line)
      do i = 1, size(words)
         call check_word(field, trim(words(i)), fault)
         if (fault%at == 0) cycle
         cards%state(1, row) = is_wrong
         call report%refuse(at_column(cards, row, index(line, trim(words(i)))), fault%wrong, &
            & fault%right)
      end do
      if (len(line) > line_width) then
         cards%state(1, row) = is_wrong
         call report%refuse(at_column(cards, row, line_width + 1), "the line is longer than 80 " &
            & //"characters", "the names on several lines")
      end if
   end subroutine read_words

   !> The fields of a row
   subroutine read_fields(line, row, fields, parameters, cards, report)
      character(*), intent(in) :: line
      integer, intent(in) :: row
      type(field_type), intent(in) :: fields(:)
      type(parameter_table_type), intent(in) :: parameters
      type(cards_type), intent(inout) :: cards
      type(report_type), intent(inout) :: report

      type(span_type) :: spans(size(fields))
      integer :: trailing, i, last, width(size(fields))

      width(:) = cards%column_width(cards%card_of_row(row), size(fields))
      last = last_column(line, width, cards%long)
      call locate(line(:last), width, spans, trailing)
      cards%row_free(row) = is_free(line(:last))
      call check_boundaries(line, row, fields, spans, width, cards, report)
      do i = 1, size(fields)
         if (spans(i)%last < spans(i)%first) then
            call check_blank(row, i, fields(i), cards, report)
         else
            call read_field(i, spans(i), fields(i))
         end if
      end do
      if (trailing == 0) return
      call report%refuse(at_column(cards, row, trailing), "text after the last field", &
         & "at most "//text(size(fields))//" fields on this card, of which the last is " &
         & //trim(fields(size(fields))%name))

   contains

      !> A filled field
      subroutine read_field(i, span, field)
         integer, intent(in) :: i
         type(span_type), intent(in) :: span
         type(field_type), intent(in) :: field

         type(fault_type) :: fault
         type(deck_location_type) :: place

         if (field%kind == word_field) then
            call check_word(field, line(span%first:span%last), fault)
            cards%text(i, row) = printable(line(span%first:span%last))
            if (len(field%words) > 0) cards%text(i, row) = upper_case(cards%text(i, row))
         else
            call read_number(field, line(span%first:span%last), parameters, cards%value(i, row), &
               & fault)
         end if
         cards%state(i, row) = merge(is_given, is_wrong, fault%at == 0)
         if (fault%at == 0) return
         cards%value(i, row) = field%default
         if (len(fault%wrong) == 0) return
         fault%right = fault%right//comma_advice(line, span)
         place = cards%place_in_row(row, i)
         place%comma = 0
         place%first = span%first + fault%at - 1
         place%last = max(place%first, merge(span%last, 0, fault%at == 1))
         call report%refuse(place, fault%wrong, fault%right)
      end subroutine read_field

   end subroutine read_fields

   !> Report a number that crosses the boundary of two fields, which would be read as two numbers;
   !> in a row without commas
   subroutine check_boundaries(line, row, fields, spans, width, cards, report)
      character(*), intent(in) :: line
      integer, intent(in) :: row
      type(field_type), intent(in) :: fields(:)
      !> Where each field is, and its columns
      type(span_type), intent(in) :: spans(:)
      integer, intent(in) :: width(:)
      type(cards_type), intent(in) :: cards
      type(report_type), intent(inout) :: report

      integer :: boundary, i

      if (cards%row_free(row)) return
      boundary = 0
      do i = 1, size(width) - 1
         boundary = boundary + width(i)
         if (boundary >= len(line)) return
         ! a number may begin in the first column of its field behind one that is left blank
         if (spans(i)%first > spans(i)%last) cycle
         if (spans(i)%last /= boundary .or. spans(i + 1)%first /= boundary + 1) cycle
         if (any(fields(i:i + 1)%kind == word_field)) cycle
         if (any(spans(i:i + 1)%last - spans(i:i + 1)%first + 1 == width(i:i + 1))) cycle
         call report%refuse(at_column(cards, row, boundary), &
            & "'"//line(spans(i)%first:spans(i + 1)%last)//"' crosses the boundary between " &
            & //"columns "//text(boundary)//" and "//text(boundary + 1), &
            & "each value within its columns, or commas between all values of the line")
      end do
   end subroutine check_boundaries

   !> A blank field takes its default, unless it is required
   subroutine check_blank(row, i, field, cards, report)
      !> Row, field in it
      integer, intent(in) :: row, i
      type(field_type), intent(in) :: field
      type(cards_type), intent(inout) :: cards
      type(report_type), intent(inout) :: report

      if (.not. field%required) return
      cards%state(i, row) = is_wrong
      call report%refuse(cards%place_in_row(row, i), trim(field%name)//" is blank", &
         & range_words(field)//": "//field%sentence)
   end subroutine check_blank

   !> Advice where the first two fields of a line could be one number with a decimal comma
   pure function comma_advice(line, span) result(words)
      character(*), intent(in) :: line
      !> Where the second field is
      type(span_type), intent(in) :: span
      character(:), allocatable :: words

      character(*), parameter :: digits = "0123456789"

      words = ""
      if (span%first < 3) return
      if (line(span%first - 1:span%first - 1) == "," &
         & .and. verify(line(:span%first - 2), " +-"//digits) == 0 &
         & .and. index(digits, line(span%first:span%first)) > 0 &
         & .and. verify(line(span%first:span%last), digits//"eEdD+-") == 0) words = "; if " &
         & //line(:span%last)//" is one number, it needs a decimal point in place of the comma"
   end function comma_advice

   !> Position of a character
   type(deck_location_type) function at_column(cards, row, column) result(place)
      type(cards_type), intent(in) :: cards
      integer, intent(in) :: row
      !> Column of the character
      integer, intent(in) :: column

      place = cards%head()
      place%line = cards%row_line(row)
      place%card = cards%shown_card(row)
      place%first = column
      place%last = column
   end function at_column

   !> Read the rows of a keyword
   subroutine read_rows(source, filled, parameters, cards, report)
      !> The deck
      type(source_type), intent(in) :: source
      !> Lines of the keyword up to the last one that is not blank
      integer, intent(in) :: filled
      !> Parameters defined so far
      type(parameter_table_type), intent(in) :: parameters
      !> Receives its rows
      type(cards_type), intent(inout) :: cards
      !> Findings
      type(report_type), intent(inout) :: report

      integer :: i, row, rows

      rows = filled
      call check_count(rows, cards, report)
      call allocate_rows(rows, cards)
      cards%row_line(:) = [(cards%line + i, i=1, rows)]
      do row = 1, rows
         associate (line => source%lines(cards%line + row))
            call read_row(source%files(line%file)%content(line%first:line%last), row, &
               & parameters, cards, report)
         end associate
      end do
   end subroutine read_rows

   !> Check the number of rows, and ignore excess rows
   subroutine check_count(rows, cards, report)
      !> Number of rows, and of those that can be read
      integer, intent(inout) :: rows
      type(cards_type), intent(in) :: cards
      type(report_type), intent(inout) :: report

      type(deck_location_type) :: place
      integer :: leading, most, needed

      leading = cards%declaration%leading_cards
      most = size(cards%declaration%cards)
      needed = count(.not. cards%declaration%cards%optional)
      place = cards%head()
      if (rows < leading) then
         call report%refuse(place, "the title is missing", expected_text(cards%declaration))
      else if (rows < needed) then
         call report%refuse(place, "card "//text(rows + 1 - leading)//" is missing", &
            & expected_text(cards%declaration))
      else if (cards%declaration%repeated) then
         if (modulo(rows, most) == 0) return
         place%line = place%line + rows
         call report%refuse(place, "card "//text(modulo(rows, most) + 1 - leading) &
            & //" is missing after this line", "sets of "//expected_text(cards%declaration))
         rows = rows - modulo(rows, most)
      else if (rows > most .and. .not. cards%declaration%cards(most)%repeated) then
         place%line = place%line + most + 1
         call report%refuse(place, "one card too many", expected_text(cards%declaration))
         rows = most
      end if
   end subroutine check_count

   !> Number of cards that a keyword needs, in words
   pure function expected_text(keyword) result(words)
      type(keyword_type), intent(in) :: keyword
      character(:), allocatable :: words

      integer :: most, needed

      most = size(keyword%cards) - keyword%leading_cards
      needed = count(.not. keyword%cards%optional) - keyword%leading_cards
      words = text(needed)//" cards"
      if (needed == 1) words = "1 card"
      if (most > needed) words = text(needed)//" to "//text(most)//" cards"
      words = words//" under *"//keyword%name
      if (keyword%leading_cards > 0) words = words//" and its title"
   end function expected_text

   !> Allocate the rows of a keyword
   subroutine allocate_rows(rows, cards)
      !> Number of rows
      integer, intent(in) :: rows
      type(cards_type), intent(inout) :: cards

      integer :: fields, i, texts

      fields = 0
      texts = 0
      do i = 1, size(cards%declaration%cards)
         fields = max(fields, size(cards%declaration%cards(i)%fields))
         associate (kind => cards%declaration%cards(i)%fields%kind)
            if (any(kind == word_field .or. kind == words_field .or. kind == text_field)) then
               texts = rows
            end if
         end associate
      end do
      deallocate (cards%row_line)
      allocate (cards%row_line(rows), cards%row_free(rows), cards%value(fields, rows), &
         & cards%state(fields, rows), cards%text(fields, texts))
      cards%row_free(:) = .false.
      cards%state(:, :) = is_absent
      cards%text(:, :) = ""
   end subroutine allocate_rows

end module plydyn_deck_rows
