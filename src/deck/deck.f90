!> A deck: its lines and keywords, and the conclusion from its findings.
module plydyn_deck_deck
   use plydyn_base_archive, only : archive_type
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_declaration, only : keyword_type
   use plydyn_deck_parser, only : parse
   use plydyn_deck_render, only : count_text, findings_text
   use plydyn_deck_report, only : severity_error, severity_note, severity_warning, report_type
   use plydyn_deck_source, only : add_source, begin_source, source_type
   implicit none
   private

   public :: read_decks, conclude

   !> A deck before its keywords are interpreted
   type, public :: deck_type
      !> Its lines
      type(source_type) :: source
      !> Its keywords in their order
      type(cards_type), allocatable :: keywords(:)
      !> Number of the last of several decks, one after the other
      integer :: last = 0
      !> A file of it could not be read; a file or a keyword of it
      logical :: is_incomplete = .false., has_unread = .false.
   end type deck_type

contains

   !> Read the stored decks of a run and one more deck; check every value against its declaration
   subroutine read_decks(archive, path, known, deck, report)
      !> The stored decks, and numbers for parameters from the command line
      type(archive_type), intent(in) :: archive
      !> Path of the deck that follows, empty for none
      character(*), intent(in) :: path
      !> Declarations of the keywords that are known
      type(keyword_type), intent(in) :: known(:)
      !> All decks, one after the other
      type(deck_type), intent(out) :: deck
      !> Findings
      type(report_type), intent(inout) :: report

      integer :: i

      call begin_source(deck%source)
      do i = 1, size(archive%bundles)
         call add_source(archive%bundles(i)%documents(1)%path, deck%source, report, &
            & archive%bundles(i))
      end do
      if (len(path) > 0) call add_source(path, deck%source, report)
      deck%is_incomplete = report%has_errors()
      call parse(deck%source, known, archive%parameters, deck%keywords, report)
      deck%last = maxval([0, deck%keywords%root])
      deck%has_unread = deck%is_incomplete .or. any(deck%keywords%is_unread)
   end subroutine read_decks

   !> Findings as text: warnings and notes as messages, errors as one error
   subroutine conclude(deck, report, messages, error)
      !> The deck
      type(deck_type), intent(in) :: deck
      !> Findings
      type(report_type), intent(in) :: report
      !> Warnings and notes, empty without any
      character(:), allocatable, intent(out) :: messages
      !> All findings with their count, if there are errors among them
      type(error_type), allocatable, intent(out) :: error

      messages = findings_text(report, deck%source, [severity_warning, severity_note])
      if (.not. report%has_errors()) return
      call fail(error, exit_input, findings_text(report, deck%source, [severity_error, &
         & severity_warning, severity_note])//count_text(report))
   end subroutine conclude

end module plydyn_deck_deck
