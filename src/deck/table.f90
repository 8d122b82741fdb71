!> Reads the table of a keyword: one row for each card.
module plydyn_deck_table
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type, is_absent
   use plydyn_deck_declaration, only : keyword_type, text_field, word_field, words_field
   use plydyn_deck_parameter, only : parameter_table_type
   use plydyn_deck_report, only : deck_location_type, report_type
   use plydyn_deck_rows, only : read_row
   use plydyn_deck_source, only : source_type
   implicit none
   private

   public :: read_rows

contains

   !> Read the rows of a keyword
   subroutine read_rows(source, last, parameters, cards, report)
      !> The deck
      type(source_type), intent(in) :: source
      !> Last line of the keyword
      integer, intent(in) :: last
      !> Parameters defined so far
      type(parameter_table_type), intent(in) :: parameters
      !> Receives its rows
      type(cards_type), intent(inout) :: cards
      !> Findings
      type(report_type), intent(inout) :: report

      integer :: i, row, rows

      rows = last - cards%line
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
      !> The keyword
      type(cards_type), intent(in) :: cards
      !> Findings
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
      !> Its declaration
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
      !> The keyword
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

end module plydyn_deck_table
