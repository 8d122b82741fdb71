!> Texts of fields become numbers and words that the declaration accepts.
program test_deck_values
   use plydyn_base_precision, only : wp
   use plydyn_deck_parameter, only : parameter_table_type, parameter_type
   use plydyn_deck_report, only : fault_type
   use plydyn_deck_values, only : check_word, range_words, read_number, split_words
   use plydyn_deck_visitor, only : visitor_type
   use testing, only : begin, check, finish
   implicit none

   type(visitor_type) :: card
   character(:), allocatable :: word
   integer :: n
   real(wp) :: x
   type(parameter_table_type) :: table
   type(fault_type) :: fault

   call card%declare("BALL")
   call card%integer("ORDER", "order", n, least=1, most=4)
   call card%positive("RADIUS", "length", "radius", x)
   call card%unused("CID")
   call card%integer("FACE", "face", n, allowed=[-1, 1, 2])
   call card%word("UNIT", "unit", word, "MM CM M", required=.true.)
   call card%positive("SF", "-", "factor", x, default=0.9_wp)
   call card%zero_is_default()
   call table%add(parameter_type("n", 3.0_wp))
   call table%add(parameter_type("half", 0.5_wp))

   associate (fields => card%declaration%cards(1)%fields)
      call begin("read_number")
      call check_number(1, "3", 3.0_wp)
      call check_number(1, "&n", 3.0_wp)
      call check_number(2, "&half", 0.5_wp)
      call check_number(3, "0", 0.0_wp)
      call check_number(4, "-1", -1.0_wp)
      call check_number(6, "0.0", 0.9_wp)
      call check_number(6, "0.5", 0.5_wp)
      call check_fault(1, "5", 1, "ORDER cannot be 5")
      call check_fault(1, "3.5", 2, "not an integer")
      call check_fault(1, "0e-6", 1, "a zero with an exponent")
      call check_fault(2, "0.0e-6", 1, "a zero with an exponent")
      call check_number(1, "3.0", 3.0_wp)
      call check_fault(1, "&half", 1, "ORDER is an integer")
      call check_fault(1, "&m", 2, "no parameter 'm'")
      call check_fault(2, "-&half", 1, "RADIUS cannot be -0.5")
      call check_fault(2, "0.0", 1, "RADIUS cannot be 0")
      call check_fault(2, "7O.0", 2, "not a number")
      call check_fault(2, "1e101", 1, "RADIUS cannot be 1e101")
      call check_fault(2, "1e-101", 1, "RADIUS cannot be 1e-101")
      call check_fault(3, "4", 1, "CID = 4 is not supported")
      call check_fault(4, "0", 1, "FACE cannot be 0")

      call begin("check_word")
      call check_word(fields(5), "mm", fault)
      call check(fault%at, 0, "knows a word in either case")
      call check_word(fields(5), "mmm", fault)
      call check(fault%at == 1 .and. index(fault%right, "perhaps MM") > 0, "finds the nearest word")
      call check_word(fields(5), "furlong", fault)
      call check(index(fault%right, "one of MM CM M") > 0, "or lists them all")

      call begin("range_words")
      call check(range_words(fields(1)) == "an integer from 1 to 4", "two bounds")
      call check(range_words(fields(2)) == "a number (length) above 0", "one bound")
      call check(range_words(fields(4)) == "-1, 1 or 2", "choices")
      call check(range_words(fields(5)) == "one of MM CM M", "words")
   end associate

   call begin("split_words")
   call check(size(split_words(" a, b  c,")), 3, "blanks and commas part words")
   call check(size(split_words("")), 0, "an empty text has none")
   call check(all(split_words("ab cd") == ["ab", "cd"]), "words as they are")

   call finish()

contains

   !> A text and its number
   subroutine check_number(place, text, expected)
      !> Place of the field
      integer, intent(in) :: place
      !> What the field holds
      character(*), intent(in) :: text
      !> Its number
      real(wp), intent(in) :: expected

      real(wp) :: number

      call read_number(card%declaration%cards(1)%fields(place), text, table, number, fault)
      call check(fault%at, 0, text//" is accepted")
      call check(number, expected, 0.0_wp, text//" has its value")
   end subroutine check_number

   !> A text that is refused
   subroutine check_fault(place, text, at, fragment)
      !> Place of the field
      integer, intent(in) :: place
      !> What the field holds
      character(*), intent(in) :: text
      !> Its first wrong character
      integer, intent(in) :: at
      !> What the message must say
      character(*), intent(in) :: fragment

      real(wp) :: number

      call read_number(card%declaration%cards(1)%fields(place), text, table, number, fault)
      call check(fault%at, at, text//" is refused there")
      if (fault%at > 0) call check(index(fault%wrong, fragment) > 0, text//" says "//fragment)
   end subroutine check_fault

end program test_deck_values
