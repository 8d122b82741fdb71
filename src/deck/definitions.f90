!> *PARAMETER and *PARAMETER_EXPRESSION: from lines to parameters.
module plydyn_deck_definitions
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : lower_case
   use plydyn_deck_declaration, only : long_width, usual_width
   use plydyn_deck_expression, only : evaluate, is_name_part
   use plydyn_deck_layout, only : last_column, locate, span_type
   use plydyn_deck_number, only : read_real
   use plydyn_deck_parameter, only : parameter_length, parameter_table_type, parameter_type
   use plydyn_deck_report, only : deck_location_type, fault_type, report_type
   use plydyn_deck_source, only : source_type
   implicit none
   private

   public :: check_uses, define_values, define_expressions

   !> Names and values on a card of *PARAMETER
   integer, parameter :: fields_on_card = 8

contains

   !> Refuse values of the command line for parameters that no field and no expression names
   subroutine check_uses(source, parameters, report)
      !> The deck
      type(source_type), intent(in) :: source
      type(parameter_table_type), intent(in) :: parameters
      !> Findings
      type(report_type), intent(inout) :: report

      character(:), allocatable :: name
      integer :: s

      do s = 1, size(parameters%settings)
         name = trim(parameters%settings(s)%name)
         if (parameters%find(name) == 0 .or. is_used(source, name)) cycle
         call report%refuse(deck_location_type(), "'-p "//name//"' on the command line: the deck " &
            & //"defines this parameter and does not use it", "&"//name//" in a field, or no -p")
      end do
   end subroutine check_uses

   !> Whether a field names a parameter, or an expression
   logical function is_used(source, name)
      type(source_type), intent(in) :: source
      !> Name in lower case
      character(*), intent(in) :: name

      character(:), allocatable :: line
      integer :: i
      logical :: in_expressions

      is_used = .true.
      in_expressions = .false.
      do i = 1, source%line_count
         line = lower_case(source%line(i))
         if (source%is_keyword(i)) in_expressions = index(line, "*parameter_expression") == 1
         if (in_expressions) then
            if (has_word(line(own_end(line) + 1:), name)) return
         else if (index(line, "&") > 0) then
            if (has_word(line, "&"//name)) return
         end if
      end do
      is_used = .false.
   end function is_used

   !> Last character of the name that a line of expressions defines
   pure integer function own_end(line)
      character(*), intent(in) :: line

      own_end = index(line, ",")
      if (own_end == 0) own_end = min(usual_width, len(line))
      if (verify(line(:own_end), " ") == 0) own_end = 0
   end function own_end

   !> Whether a line has a word that is no part of a longer one
   pure logical function has_word(line, word)
      character(*), intent(in) :: line, word

      character(len(line) + 2) :: padded
      integer :: at, behind

      padded = " "//line
      has_word = .false.
      do at = 2, len(padded) - len(word)
         behind = at + len(word)
         if (padded(at:behind - 1) /= word) cycle
         has_word = .not. any(is_name_part([padded(at - 1:at - 1), padded(behind:behind)]))
         if (has_word) return
      end do
   end function has_word

   !> The cards of *PARAMETER: `R name` and a number, up to four pairs on a line
   subroutine define_values(source, first, last, long, parameters, report)
      !> The deck
      type(source_type), intent(in) :: source
      !> First and last line of the cards
      integer, intent(in) :: first, last
      !> Fields of 20 columns
      logical, intent(in) :: long
      !> Parameters
      type(parameter_table_type), intent(inout) :: parameters
      !> Findings
      type(report_type), intent(inout) :: report

      type(span_type) :: spans(fields_on_card)
      character(:), allocatable :: line
      integer :: trailing, i, k, width(fields_on_card)

      width = merge(long_width, usual_width, long)
      do i = first, last
         line = source%line(i)
         call locate(line(:last_column(line, width, long)), width, spans, trailing)
         do k = 1, fields_on_card, 2
            if (spans(k)%first <= spans(k)%last) call define_value(spans(k), spans(k + 1))
         end do
         if (trailing > 0) then
            call report%refuse(location(i, trailing, "PARAMETER"), "text after the last field", &
               & "four pairs of name and value on a line")
         end if
      end do

   contains

      !> One pair of a line
      subroutine define_value(name, number)
         type(span_type), intent(in) :: name, number

         type(parameter_type) :: parameter
         character(:), allocatable :: value
         integer :: wrong_at

         value = line(number%first:number%last)
         if (len(value) == 0) then
            call report%refuse(location(i, name%last, "PARAMETER"), "the value is blank", &
               & "name and value in separate fields, or separated by a comma: R name, 1.5")
            return
         end if
         call read_real(value, parameter%value, wrong_at)
         if (wrong_at > 0) then
            call report%refuse(location(i, number%first + wrong_at - 1, "PARAMETER"), "'"//value &
               & //"' is not a number", "a number; *PARAMETER_EXPRESSION takes expressions")
            parameter%is_wrong = .true.
         end if
         call define(line(name%first:name%last), i, name%first, "PARAMETER", parameter, &
            & parameters, report)
      end subroutine define_value

   end subroutine define_values

   !> The cards of *PARAMETER_EXPRESSION: `R name` and an expression, one on a line; a line whose
   !> name is blank continues the expression
   subroutine define_expressions(source, first, last, long, parameters, report)
      !> The deck
      type(source_type), intent(in) :: source
      !> First and last line of the cards
      integer, intent(in) :: first, last
      !> Names of 20 columns
      logical, intent(in) :: long
      !> Parameters
      type(parameter_table_type), intent(inout) :: parameters
      !> Findings
      type(report_type), intent(inout) :: report

      character(:), allocatable :: line, more
      integer :: begin, i, width

      width = merge(long_width, usual_width, long)
      i = first
      do while (i <= last)
         begin = i
         line = source%line(i)
         do i = begin + 1, last
            more = source%line(i)
            if (len(more) == 0 .or. verify(more, " ") <= width) exit
            line = line//" "//more(width + 1:)
         end do
         if (len(line) > 0) call define_expression()
      end do

   contains

      !> One parameter, of a line with its continuation lines
      subroutine define_expression()
         type(parameter_type) :: parameter
         type(fault_type) :: fault
         character(*), parameter :: keyword = "PARAMETER_EXPRESSION"
         integer :: behind, name_end

         name_end = min(width, len(line))
         behind = name_end + 1
         if (index(line(:name_end), ",") > 0) then
            name_end = index(line, ",") - 1
            behind = name_end + 2
         end if
         call evaluate(line(behind:), parameters, parameter%value, fault)
         if (fault%at > 0) then
            call report%refuse(location(begin, behind + fault%at - 1, keyword), fault%wrong, &
               & fault%right)
            parameter%value = 0.0_wp
            parameter%is_wrong = .true.
         end if
         call define(line(:name_end), begin, 1, keyword, parameter, parameters, report)
      end subroutine define_expression

   end subroutine define_expressions

   !> Add a parameter whose value is known
   subroutine define(head, i, column, keyword, parameter, parameters, report)
      !> Letter and name
      character(*), intent(in) :: head
      !> Line, and column of the letter
      integer, intent(in) :: i, column
      !> Name of the keyword
      character(*), intent(in) :: keyword
      !> Its value
      type(parameter_type), intent(inout) :: parameter
      type(parameter_table_type), intent(inout) :: parameters
      type(report_type), intent(inout) :: report

      character(:), allocatable :: letter, name
      integer :: known

      letter = head(1:1)
      name = trim(adjustl(head(2:)))
      known = parameters%find(name)
      call parameters%choose(name, parameter%value)
      if (index("RrIi", letter) == 0) then
         call report%refuse(location(i, column, keyword), "'"//letter//"' is not a type of " &
            & //"parameter", "R for a real number, I for an integer, then the name")
      else if (.not. is_name(name)) then
         call report%refuse(location(i, column + 1, keyword), "'"//name//"' is not a name", &
            & "a letter, then letters, digits and _, at most 32 in all")
      else if (known > 0) then
         call report%refuse(location(i, column, keyword), "the parameter '"//name &
            & //"' is defined twice", "another name", parameters%list(known)%line)
      else if (index("Ii", letter) > 0 .and. abs(parameter%value - anint(parameter%value)) &
         & > 0.0_wp) then
         call report%refuse(location(i, column, keyword), "the parameter '"//name &
            & //"' is an integer (I) with a fraction", "a whole value, or R in place of I")
      else
         parameter%name = name
         parameter%whole = index("Ii", letter) > 0
         parameter%line = i
         call parameters%add(parameter)
      end if
   end subroutine define

   !> Whether a text can be the name of a parameter
   pure logical function is_name(name)
      character(*), intent(in) :: name

      character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"

      is_name = len(name) > 0 .and. len(name) <= parameter_length
      if (is_name) is_name = scan(name(1:1), letters) > 0 &
         & .and. verify(name, letters//"0123456789_") == 0
   end function is_name

   !> Position of a character
   pure type(deck_location_type) function location(line, column, keyword)
      !> Line, and column
      integer, intent(in) :: line, column
      !> Name of the keyword
      character(*), intent(in) :: keyword

      location%line = line
      location%first = column
      location%last = column
      location%keyword = "*"//keyword
   end function location

end module plydyn_deck_definitions
