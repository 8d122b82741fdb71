!> From the text of a deck to cards with values, states and places, and to findings as text.
program test_deck_deck
   use plydyn_base_archive, only : archive_type
   use plydyn_base_error, only : error_type, exit_input
   use plydyn_base_precision, only : wp
   use plydyn_deck_deck, only : conclude, deck_type, read_decks
   use plydyn_deck_declaration, only : is_ignored, is_refused, keyword_type, new_keyword, extension
   use plydyn_deck_report, only : deck_location_type, report_type
   use plydyn_deck_visitor, only : visitor_type
   use testing, only : begin, check, check_error, finish, write_lines
   implicit none

   character(*), parameter :: path = "deck_test.k"
   type(keyword_type) :: known(7)
   type(deck_type) :: deck
   type(error_type), allocatable :: error
   character(:), allocatable :: messages

   call declare()

   call begin("fixed columns")
   call read_text("*KEYWORD|*BALL|         1       2.5|       1.0|*END")
   associate (cards => deck%keywords(2))
      call check(.not. allocated(error), "a good deck is read")
      call check(cards%whole("IID"), 1, "an integer by its name")
      call check(cards%number("RADIUS"), 2.5_wp, 0.0_wp, "a real by its name")
      call check(cards%has("VX") .and. .not. cards%has("VY"), "absent fields are known as absent")
      call check([cards%number("VX"), cards%number("VY")], [1.0_wp, 7.0_wp], 0.0_wp, "and have " &
         & //"their default")
      call check(cards%line_of("VX"), 4, "lines are known")
   end associate

   call begin("free format, long, suffix and alias")
   call read_text("*KEYWORD|*ball_title|My ball, red|1, 2.5|*BALL+|                   2" &
      & //"                 3.0|*BALL_007|3,1.0|*END")
   call check(.not. allocated(error), "all of them are read")
   call check(deck%keywords(2)%entry("TITLE") == "My ball, red", "a comma in a title is text")
   call check(deck%keywords(2)%whole("IID"), 1, "cards follow the title")
   call check(deck%keywords(3)%number("RADIUS"), 3.0_wp, 0.0_wp, "twenty columns behind +")
   call check(deck%keywords(4)%name == "BALL" .and. deck%keywords(4)%known &
      & == deck%keywords(3)%known, "an alias is the keyword")
   call read_text("*KEYWORD LONG=Y|*BALL|                   2                 3.0|*BALL-" &
      & //"|         4       5.0|*END")
   call check(deck%keywords(2)%number("RADIUS"), 3.0_wp, 0.0_wp, "twenty columns by LONG=Y")
   call check(deck%keywords(3)%number("RADIUS"), 5.0_wp, 0.0_wp, "ten again behind -")

   call begin("sets and lists")
   call read_text("*KEYWORD|*POINT|       1     0.5|       2     1.5|*LIST|9,|1,2|3,|*END")
   call check(.not. allocated(error), "are read")
   call check(deck%keywords(2)%sets(), 2, "sets of cards are counted")
   call check(deck%keywords(2)%number("X", 2), 1.5_wp, 0.0_wp, "and read by their number")
   call check_list()

   call begin("parameters")
   call read_text("*KEYWORD|*PARAMETER|R r, 2.0, I n, 5|*PARAMETER_EXPRESSION|R d       2*r" &
      & //"|          + 1|*BALL|&n, &d|-&r,|*END")
   call check(.not. allocated(error), "are read")
   call check(deck%keywords(4)%whole("IID"), 5, "an integer")
   call check(deck%keywords(4)%number("RADIUS"), 5.0_wp, 0.0_wp, "an expression on two lines")
   call check(deck%keywords(4)%number("VX"), -2.0_wp, 0.0_wp, "and a negative one")

   call begin("errors")
   call read_text("*KEYWORD|*BALL|         1      7O.0|*BLAL|1|*OLD|*END")
   call check_error(error, "deck_test.k:3: *BALL card 1 RADIUS: '7O.0' is not a number", &
      & "a number that is none")
   call check_error(error, "    |          1      7O.0"//achar(10)//"    |                  ^", &
      & "with a caret under the O")
   call check_error(error, "'*BLAL' is not a keyword", "an unknown keyword")
   call check_error(error, "perhaps *BALL", "with the nearest one")
   call check_error(error, "'*OLD' is not supported"//achar(10)//"    | *OLD"//achar(10) &
      & //"  right would be: a *BALL", "a refused keyword with advice")
   call check_error(error, "3 errors", "and a count")
   call check(error%code, exit_input, "the exit code is that of input")
   call read_text("*KEYWORD|*BALL|         1|*END")
   call check_error(error, "RADIUS is blank", "a blank field")
   call read_text("*KEYWORD|*BALL "//repeat("x", 10000)//"|1, 2.5|*END")
   call check_error(error, "xxx...' after the keyword", "words behind a keyword")
   call check(len(error%message) < 1000, "as far as anybody reads them")
   call read_text("*KEYWORD|*BALL|1, 2.5|, 3.0|*END")
   call check(.not. allocated(error), "a blank between filled fields takes its default")
   call read_text("*KEYWORD|*POINT|       1     0.5      77|*END")
   call check_error(error, "text after the last field", "a field too many")
   call read_text("*KEYWORD|*BALL|1, 2.5|1.0|2.0|*END")
   call check_error(error, "deck_test.k:5: *BALL: one card too many", "a card too many")
   call read_text("*KEYWORD|*BALL|*END")
   call check_error(error, "card 1 is missing", "a missing card")
   call read_text("*KEYWORD|*BALL_TITLE|Red|         1      7O.0|*END")
   call check_error(error, "*BALL card 1 RADIUS: '7O.0'", "cards are counted behind the title")
   call read_text("*KEYWORD|*BALL_TITLE|Red|*END")
   call check_error(error, "card 1 is missing", "a missing card behind a title")
   call check_error(error, "cards under *BALL and its title", "with what the keyword takes")
   call read_text("*KEYWORD|*BALL_TITLE|*END")
   call check_error(error, "the title is missing", "a missing title")
   call read_text("*KEYWORD|*BALL|"//achar(9)//"1|*END")
   call check_error(error, "a tab in fixed columns", "a tab")
   call read_text("*KEYWORD|*BALL|         1  2.5|*PARAMETER|R a b|*END")
   call check_error(error, "the value is blank", "a parameter without value")
   call read_text("*KEYWORD|*PARAMETER|R a, 12x4|*END")
   call check_error(error, "'12x4' is not a number", "a parameter that is no number")
   call check_error(error, new_line("a")//"    |        ^", "the wrong letter is marked")
   call read_text("*KEYWORD|*ONCE|1,|*ONCE|2,|*END")
   call check_error(error, "twice in the deck (see deck_test.k:2)", "a keyword twice")

   call begin("warnings")
   call read_text("*KEYWORD MEMORY=20m|*SHOW|1 2 3|*BALL|1,2.5|*END")
   call check(.not. allocated(error), "are no errors")
   call check(index(messages, "'*SHOW' is ignored") > 0, "ignored keywords are reported")
   call check(index(messages, "'MEMORY=20M' is ignored") > 0, "ignored options too")

   call finish()

contains

   !> Some keywords to read
   subroutine declare()
      type(visitor_type) :: card
      character(32), allocatable :: words(:)
      integer :: n
      real(wp) :: x

      call start(card, "BALL", "A ball.")
      call card%keyword(extension, "A ball.", suffixes="TITLE", alias="BALL_007")
      call card%integer("IID", "number", n, least=1)
      call card%positive("RADIUS", "length", "radius", x)
      call card%card(optional=.true.)
      call card%real("VX", "length/time", "velocity", x, default=0.0_wp)
      call card%real("VY", "length/time", "velocity", x, default=7.0_wp)
      known(1) = card%declaration
      call start(card, "POINT", "Points.")
      call card%width(8)
      do while (card%next())
         call card%integer("NID", "number", n, least=1)
         call card%real("X", "length", "x", x)
      end do
      known(2) = card%declaration
      call start(card, "LIST", "A list.")
      call card%integer("SID", "number", n, least=1)
      do while (card%next())
         call card%integer("NID1", "member", n, least=1)
         call card%integer("NID2", "member", n, default=0, least=1)
      end do
      known(3) = card%declaration
      known(4) = new_keyword("OLD")
      known(4)%status = is_refused
      known(4)%remark = "a *BALL"
      known(5) = new_keyword("SHOW")
      known(5)%status = is_ignored
      call start(card, "ONCE", "")
      call card%keyword(extension, "", once=.true.)
      call card%integer("N", "number", n)
      known(6) = card%declaration
      call start(card, "WORDS", "")
      do while (card%next())
         call card%words("NAME", "names", words, "STRESS STRAIN")
      end do
      known(7) = card%declaration
   end subroutine declare

   !> Begin a declaration
   subroutine start(card, name, sentence)
      type(visitor_type), intent(out) :: card
      character(*), intent(in) :: name, sentence

      call card%declare(name)
      call card%keyword(extension, sentence)
   end subroutine start

   !> Write a deck whose lines are parted by bars, and read it
   subroutine read_text(text)
      !> The deck
      character(*), intent(in) :: text

      type(archive_type) :: archive
      type(report_type) :: report

      allocate (archive%bundles(0))
      archive%parameters = ""
      call write_lines(path, text)
      call read_decks(archive, path, known, deck, report)
      call conclude(deck, report, messages, error)
   end subroutine read_text

   !> Members of a list with their places
   subroutine check_list()
      type(deck_location_type) :: place

      associate (cards => deck%keywords(3))
         call check(cards%sets(), 2, "a list has the rows that are given")
         call check(all([cards%whole("NID1", 1), cards%whole("NID2", 1), cards%whole("NID1", 2)] &
            & == [1, 2, 3]), "its members in their order")
         call check(.not. cards%has("NID2", 2), "trailing blanks are none")
         place = cards%place("NID1", 2)
         call check(place%card == 2 .and. place%field == "NID1" .and. place%comma == 1, &
            & "each with its place")
      end associate
   end subroutine check_list

end program test_deck_deck
