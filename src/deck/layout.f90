!> Field boundaries of a line: fixed columns, or commas in free format.
module plydyn_deck_layout
   implicit none
   private

   public :: locate, is_free, last_column

   character(*), parameter :: tab = achar(9)

   !> A range of columns; `last < first` when it is blank
   type, public :: span_type
      !> First and last column
      integer :: first = 1, last = 0
   end type span_type

   !> Columns of all cards
   integer, parameter :: columns_of_cards = 80

contains

   !> Whether a line is in free format
   pure logical function is_free(line)
      !> Line of a card
      character(*), intent(in) :: line

      is_free = index(line, ",") > 0
   end function is_free

   !> Last column that is read: in fixed columns a remark may stand behind those of all cards
   pure integer function last_column(line, width, long) result(last)
      !> Line of a card
      character(*), intent(in) :: line
      !> Width of each field
      integer, intent(in) :: width(:)
      !> Fields of 20 columns
      logical, intent(in) :: long

      last = min(len(line), max(sum(width), columns_of_cards*merge(2, 1, long)))
      if (is_free(line(:last))) last = len(line)
   end function last_column

   !> Find the fields of a line, without the blanks around them
   pure subroutine locate(line, width, spans, trailing)
      !> Line of a card
      character(*), intent(in) :: line
      !> Width of each field, for fixed format
      integer, intent(in) :: width(:)
      !> Columns of each field
      type(span_type), intent(out) :: spans(:)
      !> First column of text after the last field; 0 without any
      integer, intent(out) :: trailing

      logical :: free
      integer :: begin, i, length

      free = is_free(line)
      begin = 1
      do i = 1, size(width)
         length = width(i)
         if (free) length = comma_distance(line, begin)
         spans(i) = trim_span(line, begin, min(begin + length - 1, len(line)), free)
         begin = begin + length
         if (free) begin = begin + 1
      end do
      spans(size(width) + 1:) = span_type()
      begin = min(begin, len(line) + 1)
      trailing = verify(line(begin:), " ,"//tab)
      if (trailing > 0) trailing = begin + trailing - 1
   end subroutine locate

   !> A range without the blanks at its ends
   pure type(span_type) function trim_span(line, first, last, free) result(span)
      character(*), intent(in) :: line
      !> First and last column of the range
      integer, intent(in) :: first, last
      !> Free format, where tabs count as blanks
      logical, intent(in) :: free

      character(2) :: blanks

      blanks = merge(" "//tab, "  ", free)
      span%first = first + verify(line(first:last)//".", blanks) - 1
      span%last = last
      if (span%first <= last) span%last = first + verify(line(first:last), blanks, back=.true.) - 1
   end function trim_span

   !> Characters from a column to the next comma or the end
   pure integer function comma_distance(line, begin) result(distance)
      !> Line in free format
      character(*), intent(in) :: line
      !> Column to start from
      integer, intent(in) :: begin

      distance = 0
      if (begin > len(line)) return
      distance = index(line(begin:), ",") - 1
      if (distance < 0) distance = len(line) - begin + 1
   end function comma_distance

end module plydyn_deck_layout
