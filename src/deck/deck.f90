!> A deck: its lines and keywords, and its findings as text: position, error, the line with a caret,
!> and the remedy.
module plydyn_deck_deck
   use plydyn_base_archive, only : archive_type
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_text, only : number_of, printable, text
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_declaration, only : keyword_type
   use plydyn_deck_layout, only : locate, span_type
   use plydyn_deck_parser, only : parse
   use plydyn_deck_report, only : deck_location_type, finding_type, max_per_kind, report_type, &
      & severity_error, severity_note, severity_warning
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

   !> Largest number of characters shown of a line
   integer, parameter :: most_shown = 160
   !> Prefix of a line of the deck in the text
   character(*), parameter :: gutter = "    | "
   character(*), parameter :: line_feed = achar(10)
   !> Names of severities, in the order of their numbers
   character(7), parameter :: severity_names(3) = [character(7) :: "error", "warning", "note"]

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

   !> All findings of some severities, in the order of the deck
   function findings_text(report, source, severities) result(words)
      type(report_type), intent(in) :: report
      type(source_type), intent(in) :: source
      !> Severities to show
      integer, intent(in) :: severities(:)
      character(:), allocatable :: words

      integer :: i, more, order(report%shown)

      words = ""
      call sort_by_line(report, order)
      do i = 1, report%shown
         associate (finding => report%findings(order(i)))
            if (all(severities /= finding%severity)) cycle
            words = words//finding_text(finding, source)
            if (any(report%findings(order(i + 1:))%kind == finding%kind)) cycle
            more = report%kinds(finding%kind)%count - max_per_kind
            if (more > 0) words = words//"... and "//text(more)//" more of this kind"//line_feed &
               & //line_feed
         end associate
      end do
   end function findings_text

   !> Number of errors and warnings
   function count_text(report) result(words)
      type(report_type), intent(in) :: report
      character(:), allocatable :: words

      words = number_of(report%count(severity_error), "error")
      if (report%count(severity_warning) == 0) return
      words = words//" and "//number_of(report%count(severity_warning), "warning")
   end function count_text

   !> Order of the findings by line, those without a line last
   pure subroutine sort_by_line(report, order)
      type(report_type), intent(in) :: report
      !> Indices of the findings
      integer, intent(out) :: order(:)

      integer :: i, k, line, lines(size(order))

      do i = 1, size(order)
         line = report%findings(i)%place%line
         if (line == 0) line = huge(line)
         k = i
         do while (k > 1)
            if (lines(k - 1) <= line) exit
            lines(k) = lines(k - 1)
            order(k) = order(k - 1)
            k = k - 1
         end do
         lines(k) = line
         order(k) = i
      end do
   end subroutine sort_by_line

   !> One finding
   function finding_text(finding, source) result(words)
      type(finding_type), intent(in) :: finding
      type(source_type), intent(in) :: source
      character(:), allocatable :: words

      words = trim(severity_names(finding%severity))//": "//place_text(finding%place, source) &
         & //finding%wrong
      if (finding%also > 0) words = words//" (see "//source%where(finding%also)//")"
      words = words//line_feed
      if (finding%place%line > 0) words = words//line_text(finding%place, source)
      if (finding%severity == severity_note) then
         words = words//"  "//finding%right//line_feed//line_feed
      else
         words = words//"  right would be: "//finding%right//line_feed//line_feed
      end if
      words = printable(words)
   end function finding_text

   !> File, line, keyword, card and field
   function place_text(place, source) result(words)
      type(deck_location_type), intent(in) :: place
      type(source_type), intent(in) :: source
      character(:), allocatable :: words

      words = ""
      if (place%line > 0) then
         words = source%where(place%line)//": "
      else if (place%line == 0 .and. source%file_count > 0) then
         ! of the deck as a whole, the newest one of a restart
         words = source%files(findloc(source%files(:source%file_count)%parent, 0, 1, &
            & back=.true.))%path//": "
      end if
      if (.not. allocated(place%keyword)) return
      if (len_trim(place%keyword) == 0) return
      words = words//trim(place%keyword)
      if (place%card > 0) words = words//" card "//text(place%card)
      if (allocated(place%field)) words = words//" "//place%field
      words = words//": "
   end function place_text

   !> The line of the deck, and a caret under the error
   function line_text(place, source) result(words)
      type(deck_location_type), intent(in) :: place
      type(source_type), intent(in) :: source
      character(:), allocatable :: words

      character(:), allocatable :: line
      integer :: first, last

      line = source%line(place%line)
      words = gutter//line(:min(len(line), most_shown))//line_feed
      call find_columns(place, line, first, last)
      if (first == 0 .or. first > most_shown) return
      words = words//gutter//blanks_under(line, first)//repeat("^", last - first + 1)//line_feed
   end function line_text

   !> Columns to mark with carets
   subroutine find_columns(place, line, first, last)
      type(deck_location_type), intent(in) :: place
      character(*), intent(in) :: line
      !> First and last column; zeros for no caret
      integer, intent(out) :: first, last

      type(span_type) :: spans(max(place%comma, 1))
      integer :: trailing

      first = place%first
      last = place%last
      if (place%comma > 0) then
         call locate(line, [(0, trailing=1, place%comma)], spans, trailing)
         first = spans(place%comma)%first
         last = max(spans(place%comma)%last, first)
      else if (first > 0 .and. first <= len(line)) then
         first = first + max(verify(line(first:min(last, len(line))), " "), 1) - 1
         last = max(first, min(last, len_trim(line(:min(last, len(line))))))
      else if (first > 0) then
         last = first
      end if
   end subroutine find_columns

   !> Blanks up to a column, with the tabs of the line, to align the caret
   pure function blanks_under(line, column) result(words)
      character(*), intent(in) :: line
      !> Column of the caret
      integer, intent(in) :: column
      character(:), allocatable :: words

      integer :: i

      words = repeat(" ", column - 1)
      do i = 1, min(column - 1, len(line))
         if (line(i:i) == achar(9)) words(i:i) = achar(9)
      end do
   end function blanks_under

end module plydyn_deck_deck
