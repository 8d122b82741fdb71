!> A visit declares the fields of a keyword, and a later one reads them.
program test_deck_visitor
   use plydyn_base_precision, only : wp
   use plydyn_deck_cards, only : is_given
   use plydyn_deck_declaration, only : integer_field, keyword_type, extension, real_field, &
      & text_field, word_field
   use plydyn_deck_visitor, only : visitor_type
   use testing, only : begin, check, finish
   implicit none

   type(visitor_type) :: card, reader
   type(keyword_type) :: titled
   integer :: kind, number, place, rows(3)
   logical :: is_on
   real(wp) :: factor, radius

   number = -1
   radius = -1.0_wp
   call card%declare("BALL")
   call visit(card)

   call begin("declare")
   call check(number == -1 .and. radius < 0.0_wp, "leaves values alone")
   associate (keyword => card%declaration)
      call check(keyword%name == "BALL" .and. keyword%own .and. keyword%sentence == "A ball.", &
         & "keeps what the keyword is")
      call check(keyword%change == "balls" .and. keyword%remark == "Round.", "and what it changes")
      call check(keyword%example == "1, 2.0"//achar(10)//"3.0"//achar(10), "lines of the example")
      call check(size(keyword%cards), 2, "a card for each call")
      call check(keyword%cards(2)%repeated .and. keyword%cards(2)%optional &
         & .and. .not. keyword%cards(1)%repeated, "rows on the last one")
      call check(size(keyword%cards(1)%fields), 7, "unused fields by their names")
   end associate

   call begin("find_field")
   call card%declaration%find_field("RADIUS", number, place)
   call check(number == 1 .and. place == 2, "finds a field")
   call card%declaration%find_field("C", number, place)
   call check(number == 1 .and. place == 5, "and an unused one")
   call card%declaration%find_field("DIAMETER", number, place)
   call check(number == 0 .and. place == 0, "and no field that there is not")

   call begin("fields")
   associate (fields => card%declaration%cards(1)%fields)
      call check(fields(1)%kind == integer_field .and. all(fields(2:5)%kind == real_field), &
         & "have their kinds")
      call check(all(fields(:2)%required) .and. .not. any(fields(3:)%required), &
         & "are required or not")
      call check(all(fields%width == 10), "are ten columns wide")
      call check(.not. fields(3)%supported, "are not supported when unused")
      call check(fields(2)%above >= 0.0_wp, "have bounds")
      call check(all(nint(fields(6)%allowed) == [0, 1]), "a flag is 0 or 1")
      call check(all(nint(fields(7)%allowed) == [0, 1, 2]), "a choice counts from 0")
   end associate
   associate (fields => card%declaration%cards(2)%fields)
      call check(all(fields%width == 16), "or as wide as declared")
      call check(fields(1)%zero_is_default .and. .not. fields(1)%required, "have a default")
   end associate

   call begin("with_suffix")
   titled = card%declaration%with_suffix("TITLE")
   call check(size(titled%cards), 3, "a card in front")
   call check(titled%cards(1)%fields(1)%kind, text_field, "that is a text")
   titled = card%declaration%with_suffix("ID")
   call check(titled%cards(1)%fields(2)%kind, word_field, "or a number and a heading")
   call check(size(card%declaration%cards), 2, "the declaration itself stays")

   call begin("read")
   call make_reader()
   call visit(reader)
   call check(number, 4, "an integer")
   call check(radius, 2.5_wp, 0.0_wp, "a real number")
   call check(is_on, "a flag")
   call check(kind, 30, "the number of the program for a choice")
   call check(all(rows == [7, 8, 9]), "and every row")
   call check(reader%nth, 1, "behind which the first counts again")

   call finish()

contains

   !> A keyword with a card, and rows
   subroutine visit(card)
      type(visitor_type), intent(inout) :: card

      call card%keyword(extension, "A ball.", suffixes="TITLE ID", change="balls")
      call card%remark("Round.")
      call card%example("11-contact", "1, 2.0|3.0")
      call card%integer("IID", "number", number, least=1)
      call card%positive("RADIUS", "length", "radius", radius)
      call card%unused("A B C", neutral=[0.0_wp, 1.0_wp])
      call card%flag("ON", "1 rolls", is_on)
      call card%choice("KIND", "what it is", kind, [10, 20, 30])
      call card%width(16)
      do while (card%next(optional=.true.))
         call card%real("SF", "-", "factor", factor, default=1.0_wp)
         call card%zero_is_default()
         if (card%reads) rows(card%nth) = nint(factor)
      end do
   end subroutine visit

   !> Cards with a row in front and three rows behind it
   subroutine make_reader()
      reader%reads = .true.
      reader%name = "BALL"
      reader%declaration = card%declaration
      reader%row_line = [11, 12, 13, 14]
      allocate (reader%row_free(4), source=.false.)
      allocate (reader%state(7, 4), source=is_given)
      allocate (reader%value(7, 4), source=0.0_wp)
      reader%value([1, 2, 6, 7], 1) = [4.0_wp, 2.5_wp, 1.0_wp, 2.0_wp]
      reader%value(1, 2:) = [7.0_wp, 8.0_wp, 9.0_wp]
   end subroutine make_reader

end program test_deck_visitor
