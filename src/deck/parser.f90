!> Parses the lines of a deck into keywords with their cards.
module plydyn_deck_parser
   use plydyn_base_text, only : upper_case
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_declaration, only : keyword_type
   use plydyn_deck_definitions, only : check_uses, define_expressions, define_values
   use plydyn_deck_lookup, only : declare, shown_name
   use plydyn_deck_parameter, only : parameter_table_type
   use plydyn_deck_report, only : deck_location_type, report_type
   use plydyn_deck_source, only : source_type
   use plydyn_deck_rows, only : read_rows
   use plydyn_deck_values, only : longest_word, split_words
   implicit none
   private

   public :: parse

   !> Keywords without fields, which have no format
   character(*), parameter :: structural(5) = [character(21) :: "KEYWORD", "END", "INCLUDE", &
      & "INCLUDE_PATH", "INCLUDE_PATH_RELATIVE"]

   !> Parts of a keyword line
   type :: head_type
      !> Name in capitals, without star and marks, and words after the name
      character(:), allocatable :: name, options
      !> Mark of the format after the name: +, - or blank
      character(1) :: mark = " "
   end type head_type

   !> State of the parser between keywords
   type :: context_type
      !> Parameters defined so far
      type(parameter_table_type) :: parameters
      !> Whether the fields of each file have 20 columns, and whether its *KEYWORD has been read
      logical, allocatable :: long(:), opened(:)
   end type context_type

contains

   !> Read all keywords of a deck
   subroutine parse(source, keywords, settings, cards, report)
      !> The deck
      type(source_type), intent(in) :: source
      !> Declarations of the keywords that are known
      type(keyword_type), intent(in) :: keywords(:)
      !> Parameters from the command line, as in `velocity=3.0`, each with a line feed
      character(*), intent(in) :: settings
      !> The keywords of the deck in their order
      type(cards_type), allocatable, intent(out) :: cards(:)
      !> Findings
      type(report_type), intent(inout) :: report

      type(context_type) :: context
      integer, allocatable :: heads(:)
      integer :: i

      ! with the line behind the last keyword
      heads = pack([(i, i=1, source%line_count + 1)], [(source%is_keyword(i), i=1, &
         & source%line_count), .true.])
      allocate (cards(size(heads) - 1))
      allocate (context%long(source%file_count), context%opened(source%file_count))
      context%long(:) = .false.
      context%opened(:) = .false.
      call context%parameters%set(settings, report)
      call check_begins(source, heads, report)
      do i = 1, size(cards)
         call parse_keyword(source, keywords, heads(i), heads(i + 1) - 1, context, cards(i), report)
         call check_once(cards(:i), report)
      end do
      call context%parameters%check_settings(report)
      call check_uses(source, context%parameters, report)
      call check_end(source, report)
   end subroutine parse

   !> Every deck begins with *KEYWORD
   subroutine check_begins(source, heads, report)
      type(source_type), intent(in) :: source
      !> Lines that begin keywords, and the line behind the last one
      integer, intent(in) :: heads(:)
      type(report_type), intent(inout) :: report

      integer :: filled, first, i, k, root

      root = 0
      do i = 1, source%line_count
         if (source%root(i) == root) cycle
         root = source%root(i)
         first = heads(count(heads < i) + 1)
         filled = findloc([(source%width(k) > 0, k=i, first - 1)], .true., 1)
         if (filled > 0) then
            call report%refuse(deck_location_type(line=i + filled - 1), "a line before the first " &
               & //"keyword", "*KEYWORD on the first line")
         else if (first <= source%line_count) then
            if (index(upper_case(source%line(first)), "*KEYWORD") /= 1) call report%refuse( &
               & deck_location_type(line=first), "the deck does not begin with *KEYWORD", &
               & "*KEYWORD as the first keyword")
         end if
      end do
   end subroutine check_begins

   !> A deck ends with *END, so that a truncated file is noticed
   subroutine check_end(source, report)
      type(source_type), intent(in) :: source
      type(report_type), intent(inout) :: report

      integer :: i

      if (source%ended) return
      do i = source%line_count, 1, -1
         if (source%files(source%lines(i)%file)%parent == 0) exit
      end do
      call report%refuse(deck_location_type(line=i), "the deck does not end with *END and may be " &
         & //"truncated", "*END as the last line")
   end subroutine check_end

   !> Some keywords may occur only once in a deck
   subroutine check_once(cards, report)
      !> The keywords so far
      type(cards_type), intent(in) :: cards(:)
      type(report_type), intent(inout) :: report

      integer :: i

      associate (new => cards(size(cards)))
         if (len(new%name) == 0 .or. .not. new%declaration%once) return
         do i = 1, size(cards) - 1
            if (cards(i)%name /= new%name .or. cards(i)%root /= new%root) cycle
            call report%refuse(new%head(), "the keyword occurs twice in the deck", &
               & "the keyword only once", cards(i)%line)
            return
         end do
      end associate
   end subroutine check_once

   !> Read one keyword
   subroutine parse_keyword(source, keywords, first, last, context, cards, report)
      type(source_type), intent(in) :: source
      type(keyword_type), intent(in) :: keywords(:)
      !> Its first and last line
      integer, intent(in) :: first, last
      type(context_type), intent(inout) :: context
      type(cards_type), intent(inout) :: cards
      type(report_type), intent(inout) :: report

      type(head_type) :: head
      type(deck_location_type) :: place
      integer :: filled, i

      call split_head(source%line(first), head)
      place%line = first
      place%keyword = "*"//shown_name(head%name)
      cards%name = ""
      cards%line = first
      cards%root = source%root(first)
      allocate (cards%row_line(0))
      call inherit_format(source, source%lines(first)%file, context)
      cards%long = head%mark == "+" .or. (context%long(source%lines(first)%file) &
         & .and. head%mark /= "-")
      call check_head(head, place, report)
      select case (head%name)
      case ("KEYWORD")
         call open_file(source%lines(first)%file, head%options, place, context, report)
         call check_no_card(source, first, last, report)
      case ("PARAMETER", "PARAMETER_LOCAL")
         call define_values(source, first + 1, last, cards%long, context%parameters, report)
      case ("PARAMETER_EXPRESSION", "PARAMETER_EXPRESSION_LOCAL")
         call define_expressions(source, first + 1, last, cards%long, context%parameters, report)
      case ("COMMENT", "END")
         continue
      case ("INCLUDE", "INCLUDE_PATH", "INCLUDE_PATH_RELATIVE")
         call check_include(source, first, last, place, report)
      case default
         call declare(head%name, keywords, place, cards, report)
         if (len(cards%name) == 0) return
         filled = findloc([(source%width(i) > 0, i=first + 1, last)], .true., 1, back=.true.)
         call read_rows(source, filled, context%parameters, cards, report)
      end select
   end subroutine parse_keyword

   !> Nothing stands behind a keyword but the mark of its format, and options behind *KEYWORD
   subroutine check_head(head, place, report)
      type(head_type), intent(in) :: head
      type(deck_location_type), intent(in) :: place
      type(report_type), intent(inout) :: report

      if (any(head%name == structural) .and. head%mark /= " ") call report%refuse(place, &
         & "'"//head%mark//"' after the keyword", "the keyword alone on its line; *KEYWORD " &
         & //"LONG=Y gives all fields 20 columns")
      if (len(head%options) > 0 .and. head%name /= "KEYWORD") call report%refuse(place, &
         & "'"//shown_name(head%options)//"' after the keyword", "the keyword alone on its line")
   end subroutine check_head

   !> No card may follow *KEYWORD
   subroutine check_no_card(source, first, last, report)
      type(source_type), intent(in) :: source
      !> Its first and last line
      integer, intent(in) :: first, last
      type(report_type), intent(inout) :: report

      integer :: i

      i = first + findloc([(source%width(i) > 0, i=first + 1, last)], .true., 1)
      if (i > first) call report%refuse(deck_location_type(line=i), "a card without a keyword", &
         & "a keyword above it, such as *TITLE, with its star in column 1")
   end subroutine check_no_card

   !> *INCLUDE has a path, and what it includes begins with a keyword
   subroutine check_include(source, first, last, place, report)
      type(source_type), intent(in) :: source
      !> Its first line, and the last one before the next keyword
      integer, intent(in) :: first, last
      type(deck_location_type), intent(in) :: place
      type(report_type), intent(inout) :: report

      integer :: i, paths

      paths = 0
      do i = first + 1, last
         if (source%width(i) == 0) cycle
         if (source%lines(i)%file == source%lines(first)%file) then
            paths = paths + 1
         else
            call check_no_card(source, i - 1, last, report)
            exit
         end if
      end do
      if (paths == 0) call report%refuse(place, "the path is missing", "a path on the next line")
   end subroutine check_include

   !> Name, options and mark of a keyword line
   pure subroutine split_head(line, head)
      !> The line, star first
      character(*), intent(in) :: line
      type(head_type), intent(out) :: head

      integer :: name_end

      name_end = scan(line//" ", " ,"//achar(9)) - 1
      head%name = upper_case(line(2:name_end))
      head%options = trim(adjustl(line(name_end + 1:)))
      if (head%options == "+" .or. head%options == "-") then
         head%mark = head%options
         head%options = ""
      end if
      if (len(head%name) == 0) return
      associate (final => head%name(len(head%name):))
         if (final /= "+" .and. final /= "-") return
         head%mark = final
      end associate
      head%name = head%name(:len(head%name) - 1)
   end subroutine split_head

   !> A file without *KEYWORD has the format of the file that includes it
   pure subroutine inherit_format(source, file, context)
      type(source_type), intent(in) :: source
      !> Index of the file
      integer, intent(in) :: file
      !> Receives the format
      type(context_type), intent(inout) :: context

      if (context%opened(file)) return
      context%opened(file) = .true.
      if (source%files(file)%parent > 0) then
         context%long(file) = context%long(source%files(file)%parent)
      end if
   end subroutine inherit_format

   !> Options of *KEYWORD
   subroutine open_file(file, options, place, context, report)
      !> Index of the file
      integer, intent(in) :: file
      !> Words after *KEYWORD
      character(*), intent(in) :: options
      type(deck_location_type), intent(in) :: place
      !> Receives the format
      type(context_type), intent(inout) :: context
      type(report_type), intent(inout) :: report

      character(longest_word), allocatable :: words(:)
      character(:), allocatable :: name
      integer :: i

      context%long(file) = .false.
      words = split_words(upper_case(options))
      do i = 1, size(words)
         name = words(i) (:scan(words(i)//"=", "=") - 1)
         select case (name)
         case ("LONG")
            context%long(file) = words(i) == "LONG=Y"
            if (all(words(i) /= ["LONG=Y", "LONG=S"])) call report%refuse(place, &
               & "'"//trim(words(i))//"' after *KEYWORD", "LONG=Y for fields of 20 columns, " &
               & //"LONG=S or nothing for the usual ones")
         case ("MEMORY", "MEMORY2", "NCPU", "ID", "PROJECT", "STAGE")
            call report%warn(place, "'"//trim(words(i))//"' is ignored", &
               & "nothing, or LONG=Y for fields of 20 columns")
         case default
            call report%refuse(place, "'"//trim(words(i))//"' after *KEYWORD", &
               & "nothing, or LONG=Y for fields of 20 columns")
         end select
      end do
   end subroutine open_file

end module plydyn_deck_parser
