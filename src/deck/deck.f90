!> A deck: its lines, its keywords, and what is wrong with it.
module plydyn_deck_deck
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_declaration, only : keyword_type
   use plydyn_deck_parser, only : parse
   use plydyn_deck_render, only : count_text, findings_text
   use plydyn_deck_report, only : grave_error, grave_note, grave_warning, report_type
   use plydyn_deck_source, only : read_source, source_type
   implicit none
   private

   public :: read_deck, conclude

   !> Everything of a deck but its meaning
   type, public :: deck_type
      !> Its lines
      type(source_type) :: source
      !> Its keywords in their order
      type(cards_type), allocatable :: keywords(:)
   end type deck_type

contains

   !> Read a deck: every value is checked against its declaration
   subroutine read_deck(path, known, deck, report)
      !> Path of the deck
      character(*), intent(in) :: path
      !> Declarations of the keywords that are known
      type(keyword_type), intent(in) :: known(:)
      !> The deck
      type(deck_type), intent(out) :: deck
      !> Findings
      type(report_type), intent(inout) :: report

      call read_source(path, deck%source, report)
      call parse(deck%source, known, deck%keywords, report)
   end subroutine read_deck

   !> All findings as text: warnings and notes to tell, errors as one error
   subroutine conclude(deck, report, messages, error)
      !> The deck
      type(deck_type), intent(in) :: deck
      !> Findings
      type(report_type), intent(in) :: report
      !> Warnings and notes, empty without any
      character(:), allocatable, intent(out) :: messages
      !> All findings with their count, if there are errors among them
      type(error_type), allocatable, intent(out) :: error

      messages = findings_text(report, deck%source, [grave_warning, grave_note])
      if (.not. report%has_errors()) return
      call fail(error, exit_input, findings_text(report, deck%source, [grave_error, grave_warning, &
         & grave_note])//count_text(report))
   end subroutine conclude

end module plydyn_deck_deck
