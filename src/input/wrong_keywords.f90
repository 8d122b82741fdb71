!> What keywords with errors leave open. Numbers in them may refer to something, which is then not
!> reported as never used; laminates are not compared where one of them could not be read.
module plydyn_input_wrong_keywords
   use plydyn_base_text, only : upper_case
   use plydyn_deck_cards, only : cards_type, is_wrong
   use plydyn_deck_deck, only : deck_type
   use plydyn_deck_declaration, only : integer_field
   use plydyn_deck_report, only : severity_error
   use plydyn_input_catalogue, only : a_node, a_quad, catalogue_type
   implicit none
   private

   public :: weigh_errors

   !> Beginnings of the names of keywords that describe laminates
   character(*), parameter :: of_laminates(3) = [character(10) :: "*PART", "*SECTION", "*INTERFACE"]
   !> Digits of the longest number
   integer, parameter :: longest_number = 9

contains

   !> Mark what wrong keywords may refer to, and what cannot be judged because of them
   subroutine weigh_errors(deck, catalogue)
      !> The deck
      type(deck_type), intent(in) :: deck
      !> Has all findings of the readers; gets the marks
      type(catalogue_type), intent(inout) :: catalogue

      integer :: f, k

      associate (report => catalogue%report)
         ! errors that are not shown have no place
         if (sum(report%count) > report%shown) catalogue%is_incomplete = .true.
         do f = 1, report%shown
            if (report%findings(f)%severity /= severity_error) cycle
            k = count(deck%keywords%line <= report%findings(f)%place%line)
            if (k > 0) call weigh_keyword(deck, k, catalogue)
         end do
      end associate
   end subroutine weigh_errors

   !> Mark what one of them may refer to
   subroutine weigh_keyword(deck, k, catalogue)
      type(deck_type), intent(in) :: deck
      !> Which keyword
      integer, intent(in) :: k
      type(catalogue_type), intent(inout) :: catalogue

      character(:), allocatable :: name
      integer :: i, last

      name = upper_case(deck%source%line(deck%keywords(k)%line))
      if (has_wrong_integer(deck%keywords(k))) catalogue%is_incomplete = .true.
      do i = 1, size(of_laminates)
         if (index(name, trim(of_laminates(i))) == 1) catalogue%parts_are_sound = .false.
      end do
      if (deck%keywords(k)%is_unread) catalogue%parts_are_sound = .false.
      if (index(name, "*NODE") == 1 .or. index(name, "*ELEMENT") == 1) return
      last = deck%source%line_count
      if (k < size(deck%keywords)) last = deck%keywords(k + 1)%line - 1
      do i = deck%keywords(k)%line + 1, last
         call mark_numbers(deck%source%line(i), catalogue)
      end do
   end subroutine weigh_keyword

   !> Whether a whole number of a keyword could not be read: it may be that of anything
   pure logical function has_wrong_integer(cards) result(has)
      type(cards_type), intent(in) :: cards

      integer :: c, card, r

      has = .false.
      if (.not. allocated(cards%state)) return
      do r = 1, size(cards%state, 2)
         card = cards%card_of_row(r)
         associate (fields => cards%declaration%cards(card)%fields)
            do c = 1, min(size(fields), size(cards%state, 1))
               has = has .or. (fields(c)%kind == integer_field .and. cards%state(c, r) == is_wrong)
            end do
         end associate
      end do
   end function has_wrong_integer

   !> Mark all that has one of the numbers of a line, whatever it is
   subroutine mark_numbers(line, catalogue)
      !> The line
      character(*), intent(in) :: line
      type(catalogue_type), intent(inout) :: catalogue

      integer :: first, kind, number, past, place

      if (index(line, "&") > 0) catalogue%is_incomplete = .true.
      past = 1
      do
         first = past + verify(line(past:), " ,") - 1
         if (first < past) return
         past = first + scan(line(first:)//" ", " ,") - 1
         associate (word => line(first:past - 1))
            if (verify(word, "0123456789") > 0 .or. len(word) > longest_number) cycle
            read (word, *) number
         end associate
         do kind = 1, size(catalogue%registers)
            if (kind == a_node .or. kind == a_quad) cycle
            call catalogue%registers(kind)%refer(number, place)
         end do
      end do
   end subroutine mark_numbers

end module plydyn_input_wrong_keywords
