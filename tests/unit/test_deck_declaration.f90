!> Declarations hold what they are given.
program test_deck_declaration
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : integer_field, keyword_type, new_keyword, extension, &
      & real_field, &
      & text_field, word_field
   use testing, only : begin, check, finish
   implicit none

   type(keyword_type) :: keyword, titled
   integer :: card, place

   keyword = new_keyword("BALL", extension, "A ball.", suffixes="TITLE ID")
   call keyword%add_card()
   call keyword%add_integer("IID", "number", least=1)
   call keyword%add_real("RADIUS", "length", "radius", above=0.0_wp)
   call keyword%add_unused("A B C", neutral=[0.0_wp, 1.0_wp])
   keyword%width = 16
   call keyword%add_card(optional=.true.)
   call keyword%add_real("SF", "-", "factor", default=1.0_wp)
   call keyword%zero_is_default()
   call keyword%add_list("NID", 3, "node")

   call begin("add_card")
   call check(size(keyword%cards), 2, "a card for each call")
   call check(keyword%cards(2)%optional .and. .not. keyword%cards(1)%optional, "as declared")
   call check(size(keyword%cards(1)%fields), 5, "unused fields by their names")

   call begin("find_field")
   call keyword%find_field("RADIUS", card, place)
   call check(card == 1 .and. place == 2, "finds a field")
   call keyword%find_field("C", card, place)
   call check(card == 1 .and. place == 5, "and an unused one")
   call keyword%find_field("NID3", card, place)
   call check(card == 2 .and. place == 4, "and a member of a list")
   call keyword%find_field("DIAMETER", card, place)
   call check(card == 0 .and. place == 0, "and no field that there is not")

   call begin("fields")
   associate (fields => keyword%cards(1)%fields)
      call check(fields(1)%kind == integer_field .and. all(fields(2:)%kind == real_field), &
         & "have their kinds")
      call check(all(fields(:2)%required) .and. .not. any(fields(3:)%required), &
         & "are required or not")
      call check(all(fields%width == 10), "are ten columns wide")
      call check(.not. fields(3)%supported, "are not supported when unused")
   end associate
   associate (fields => keyword%cards(2)%fields)
      call check(all(fields%width == 16), "or as wide as declared")
      call check(fields(1)%zero_is_default .and. .not. fields(1)%required, "have a default")
      call check(fields(2)%required .and. .not. fields(3)%required, &
         & "a list has one member at least")
   end associate

   call begin("with_suffix")
   titled = keyword%with_suffix("TITLE")
   call check(size(titled%cards), 3, "a card in front")
   call check(titled%cards(1)%fields(1)%kind, text_field, "that is a text")
   titled = keyword%with_suffix("ID")
   call check(titled%cards(1)%fields(2)%kind, word_field, "or a number and a heading")
   call check(size(keyword%cards), 2, "the declaration itself stays")

   call finish()
end program test_deck_declaration
