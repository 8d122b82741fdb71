!> Fields are found in fixed columns and between commas.
program test_deck_layout
   use plydyn_deck_layout, only : is_free, last_column, locate, span_type
   use testing, only : begin, check, finish
   implicit none

   character(*), parameter :: tab = achar(9)
   type(span_type) :: spans(3)
   integer :: trailing

   call begin("locate, fixed columns")
   call locate("         1       2.5", [10, 10, 10], spans, trailing)
   call check(all(spans%first == [10, 18, 21]) .and. all(spans(:2)%last == [10, 20]), &
      & "finds values without the blanks around them")
   call check(spans(3)%last < spans(3)%first, "a field after the end of the line is blank")
   call check(trailing, 0, "no text after the fields")
   call locate("1234567890        22         3 x", [10, 10, 10], spans, trailing)
   call check(spans(1)%first == 1 .and. spans(1)%last == 10, "finds a full field")
   call check(trailing, 32, "text after the last field")
   call locate("", [10, 10, 10], spans, trailing)
   call check(all(spans%last < spans%first), "finds all fields of an empty line blank")

   call begin("locate, free format")
   call check(is_free("1, 2"), "is known by a comma")
   call locate("1, -2.5 ,3", [10, 10, 10], spans, trailing)
   call check(all(spans%first == [1, 4, 10]) .and. all(spans%last == [1, 7, 10]), &
      & "finds values between commas")
   call locate("1,,3", [10, 10, 10], spans, trailing)
   call check(spans(2)%last < spans(2)%first .and. spans(3)%first == 4, "finds an empty field")
   call locate("1,"//tab//"2,", [10, 10, 10], spans, trailing)
   call check(spans(2)%first == 4 .and. spans(2)%last == 4, "takes a tab as a blank")
   call check(trailing, 0, "lets a comma end the line")
   call locate("1,2,3,4", [10, 10, 10], spans, trailing)
   call check(trailing, 7, "finds a field too many")

   call begin("last_column")
   call check(last_column(repeat(" ", 81)//"a, b", [10, 10], .false.), 80, "leaves a remark out")
   call check(last_column(repeat("1", 81)//"a", spread(10, 1, 9), .false.), 82, "of all fields")
   call check(last_column(repeat(" ", 81)//"a", [20, 20], .true.), 82, "is 160 for long fields")
   call check(last_column("1,"//repeat(" ", 81)//"2", [10, 10], .false.), 84, &
      & "is the end of a line with commas")
   call check(last_column("1", [10, 10], .false.), 1, "is the end of a short line")

   call finish()
end program test_deck_layout
