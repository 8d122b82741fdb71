!> Findings are kept, counted, and cut after some of a kind.
program test_deck_report
   use plydyn_deck_report, only : severity_error, severity_note, severity_warning, max_per_kind, &
      & deck_location_type, report_type
   use plydyn_base_text, only : text
   use testing, only : begin, check, finish
   implicit none

   type(report_type) :: report
   type(deck_location_type) :: place
   integer :: i

   call begin("refuse")
   call check(.not. report%has_errors(), "a new report has no errors")
   call report%warn(place, "odd", "even")
   call report%note(place, "so it is", "so be it")
   call check(.not. report%has_errors(), "warnings and notes are no errors")
   do i = 1, 100
      call report%refuse(place, "node "//text(i)//" is not defined", "a node")
   end do
   call check(report%count(severity_error), 100, "all errors are counted")
   call check(report%count(severity_warning) == 1 .and. report%count(severity_note) == 1, &
      & "each gravity by itself")
   call check(report%shown, max_per_kind + 2, "some of a kind are shown")
   call report%refuse(place, "'7O' is not a number", "70")
   call report%refuse(place, "'8O' is not a number", "80")
   call check(size(report%kinds), 4, "quotations do not make a kind")
   place%keyword = "*NODE"
   call report%refuse(place, "'9O' is not a number", "90")
   call check(size(report%kinds), 5, "keywords do")
   do i = 1, 20
      call report%refuse(place, repeat("x", i), "y")
   end do
   call check(size(report%kinds), 25, "there may be many kinds")
   call check(report%findings(report%shown)%wrong == repeat("x", 20), "the last finding is last")

   call finish()
end program test_deck_report
