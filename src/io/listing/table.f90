!> Tables and sections of the listing, in plain text.
!>
!> A table writes to a unit, cell by cell: the line ends with its last column. Numbers stand to the
!> right, texts to the left.
module plydyn_io_listing_table
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: write_section

   !> Longest head and longest number
   integer, parameter :: cell_length = 40
   !> Blanks between two columns
   character(*), parameter :: gap = "  "

   !> A column
   type :: column_type
      !> Head of the column, with its unit
      character(cell_length) :: head = ""
      !> Characters of a cell
      integer :: width = 0
      !> Fortran's edit descriptor of the values, such as `f10.3`; `a` for texts
      character(16) :: form = "a"
   end type column_type

   !> A table being written
   type, public :: table_type
      private
      !> Unit to write to
      integer :: unit = -1
      !> Columns from left to right
      type(column_type), allocatable :: columns(:)
      !> Columns of the present line that are filled
      integer :: filled = 0
      !> Line in the making
      character(:), allocatable :: line
   contains
      procedure :: start
      procedure :: add_column
      procedure :: write_heads
      !> Fill the next cell
      generic :: put => add_cell, put_integer, put_real, put_reals
      procedure, private :: add_cell, put_integer, put_real, put_reals
   end type table_type

contains

   !> Title of a section: a blank line, the title, and a line under it
   subroutine write_section(unit, title)
      !> Unit to write to
      integer, intent(in) :: unit
      !> Title
      character(*), intent(in) :: title

      write (unit, "(/,a,/,a,/)") trim(title), repeat("-", len_trim(title))
   end subroutine write_section

   !> Start a table without columns
   subroutine start(self, unit)
      class(table_type), intent(out) :: self
      !> Unit to write to
      integer, intent(in) :: unit

      self%unit = unit
      self%columns = [column_type ::]
      self%line = ""
   end subroutine start

   !> Add a column at the right
   subroutine add_column(self, head, width, form)
      class(table_type), intent(inout) :: self
      !> Head of the column, with its unit
      character(*), intent(in) :: head
      !> Characters of a cell; more where the head needs them
      integer, intent(in) :: width
      !> Fortran's edit descriptor of the values, such as `f10.3`; `a` for texts
      character(*), intent(in) :: form

      self%columns = [self%columns, column_type(head, max(width, len_trim(head)), form)]
   end subroutine add_column

   !> Write the headers and a line under them
   subroutine write_heads(self)
      class(table_type), intent(inout) :: self

      integer :: i

      do i = 1, size(self%columns)
         call self%add_cell(trim(self%columns(i)%head))
      end do
      do i = 1, size(self%columns)
         call self%add_cell(repeat("-", self%columns(i)%width))
      end do
   end subroutine write_heads

   !> Fill the next cell with an integer
   subroutine put_integer(self, value)
      class(table_type), intent(inout) :: self
      !> What to write
      integer, intent(in) :: value

      character(cell_length) :: word

      write (word, "("//self%columns(self%filled + 1)%form//")") value
      call self%add_cell(trim(adjustl(word)))
   end subroutine put_integer

   !> Fill the next cell with a real; one that does not fit the column's form gets an exponent
   subroutine put_real(self, value)
      class(table_type), intent(inout) :: self
      !> What to write
      real(wp), intent(in) :: value

      character(cell_length) :: word

      write (word, "("//self%columns(self%filled + 1)%form//")") value
      if (index(word, "*") > 0) write (word, "(es12.4)") value
      call self%add_cell(trim(adjustl(word)))
   end subroutine put_real

   !> Fill the next cells with reals
   subroutine put_reals(self, values)
      class(table_type), intent(inout) :: self
      !> What to write
      real(wp), intent(in) :: values(:)

      integer :: i

      do i = 1, size(values)
         call self%put_real(values(i))
      end do
   end subroutine put_reals

   !> Add a cell to the line; the last column ends the line
   subroutine add_cell(self, word)
      class(table_type), intent(inout) :: self
      !> What to write, longer than the column if need be
      character(*), intent(in) :: word

      character(:), allocatable :: padding

      self%filled = self%filled + 1
      if (self%filled > 1) self%line = self%line//gap
      associate (column => self%columns(self%filled))
         padding = repeat(" ", max(0, column%width - len(word)))
         if (column%form == "a") then
            self%line = self%line//word//padding
         else
            self%line = self%line//padding//word
         end if
      end associate
      if (self%filled < size(self%columns)) return
      write (self%unit, "(a)") trim(self%line)
      self%line = ""
      self%filled = 0
   end subroutine add_cell

end module plydyn_io_listing_table
