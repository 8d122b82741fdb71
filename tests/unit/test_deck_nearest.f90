!> Misspelt words find what they were meant to be.
program test_deck_nearest
   use plydyn_deck_nearest, only : edit_distance, nearest_word
   use testing, only : begin, check, finish
   implicit none

   character(12), parameter :: known(*) = [character(12) :: "NODE", "PART", "DEFINE_CURVE", "TITLE"]

   call begin("edit_distance")
   call check(edit_distance("NODE", "NODE"), 0, "is zero for the same word")
   call check(edit_distance("NODES", "NODE"), 1, "counts a letter too many")
   call check(edit_distance("NDE", "NODE"), 1, "counts a missing letter")
   call check(edit_distance("NOTE", "NODE"), 1, "counts a wrong letter")
   call check(edit_distance("NDOE", "NODE"), 1, "counts two swapped letters once")
   call check(edit_distance("", "NODE"), 4, "is the length against an empty word")
   call check(edit_distance("kitten", "sitting"), 3, "is right for the usual example")

   call begin("nearest_word")
   call check(nearest_word("NODES", known), 1, "finds a node")
   call check(nearest_word("DEFINE_CRUVE", known), 3, "finds a curve")
   call check(nearest_word("TITEL", known), 4, "finds a title")
   call check(nearest_word("ELEPHANT", known), 0, "finds nothing near an elephant")

   call finish()
end program test_deck_nearest
