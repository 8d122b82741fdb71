!> Suggestions in place of keywords that are not known.
program test_deck_lookup
   use plydyn_deck_declaration, only : integer_field, keyword_type, new_field, &
      & new_keyword, text_field
   use plydyn_deck_lookup, only : keyword_advice
   use testing, only : begin, check, finish
   implicit none

   type(keyword_type) :: known(5)

   known(1) = new_keyword("PART_COMPOSITE_LONG")
   call known(1)%append(new_field("TITLE", text_field, "title of the part", .false.))
   known(2) = new_keyword("PART_COMPOSITE")
   call known(2)%append(new_field("TITLE", text_field, "title of the part", .false.))
   known(3) = new_keyword("NODE")
   call known(3)%append(new_field("NID", integer_field, "number of the node", .true.))
   known(4) = new_keyword("MAT_022")
   known(5) = new_keyword("MAT_ELASTIC")

   call begin("keyword_advice")
   call check(advice("NODES") == "perhaps *NODE", "a letter too many")
   call check(advice("MAT_ELASTC") == "perhaps *MAT_ELASTIC", "a letter too few")
   call check(index(advice("MAT_262"), "MAT_022") == 0, "another number is another material")
   call check(index(advice("MAT_22"), "MAT_022") == 0, "whatever its length")
   call check(index(advice("MAT_262_TITLE"), "MAT_022") == 0, "with an option too")
   call check(advice("PART_COMPOSITE_TITLE") == "*PART_COMPOSITE without _TITLE: its first card " &
      & //"is the title in any case", "no option for a title that is there: " &
      & //advice("PART_COMPOSITE_TITLE"))
   call check(advice("NODE_ID") == "*NODE without _ID", "nor for a number: "//advice("NODE_ID"))
   call check(advice("PART_COMPOSIT_TITLE") == "perhaps *PART_COMPOSITE", "misspelt besides: " &
      & //advice("PART_COMPOSIT_TITLE"))
   call finish()

contains

   !> The suggestion for a name
   function advice(name) result(words)
      character(*), intent(in) :: name
      character(:), allocatable :: words

      words = keyword_advice(name, known)
   end function advice

end program test_deck_lookup
