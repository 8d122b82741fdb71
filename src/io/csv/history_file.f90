!> Histories: columns of numbers over time, as comma-separated values with one line of headers.
!>
!> A number has ten significant digits; a whole number of up to ten digits is written as such. The
!> same run writes the same bytes. Lines reach the disk about once a second and on closing.
module plydyn_io_csv_history_file
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_output, fail
   use plydyn_base_files, only : secure_file
   use plydyn_base_precision, only : wp
   use plydyn_io_csv_text_file, only : append_to, close_text, create_text, end_text
   use plydyn_method_clock, only : clock_type
   use plydyn_state_file_positions, only : file_position_type, file_positions_type
   implicit none
   private

   public :: new_row, number_text

   !> Longest text of a number
   integer, parameter :: number_length = 18
   !> Significant digits of a number
   integer, parameter :: significant = 10
   !> Whole numbers below this are written without exponent
   real(wp), parameter :: whole_limit = 1.0e10_wp
   !> Numbers below and from here on have exponents of three digits, by rounding perhaps
   real(wp), parameter :: short_from = 1.0e-99_wp, short_to = 9.999999999e99_wp
   !> Seconds between two flushes
   real(wp), parameter :: seconds_in_memory = 1.0_wp

   !> A row of a history. In a first pass it takes the names and units of its columns, later their
   !> values
   type, public :: row_type
      !> Whether names are taken, and no values
      logical :: is_heading = .true.
      !> The line of headers, such as `time [s],force [N]`
      character(:), allocatable :: header
      !> Columns so far, and the values of all
      integer :: columns = 0
      real(wp), allocatable :: value(:)
   contains
      generic :: put => put_one, put_some
      procedure, private :: put_one, put_some
   end type row_type

   !> A file of a history, on the root
   type, public :: history_file_type
      private
      !> Path of the file, its unit, and numbers in a line
      character(:), allocatable :: path
      integer :: unit = -1, columns = 0
      !> Line in the making
      character(:), allocatable :: line
      !> Clock at the last flush
      integer(int64) :: secured = 0_int64
      !> True between `open` and `close`
      logical, public :: opened = .false.
   contains
      procedure :: open => open_history
      procedure :: write_line
      procedure :: mark => mark_history
      procedure :: flush => flush_history
      procedure :: close => close_history
   end type history_file_type

contains

   !> Name, unit or value of the next column
   pure subroutine put_one(self, name, unit, value)
      class(row_type), intent(inout) :: self
      !> Name and unit; a blank unit for none
      character(*), intent(in) :: name, unit
      !> The value; of no use to a heading
      real(wp), intent(in) :: value

      self%columns = self%columns + 1
      if (.not. self%is_heading) then
         if (self%columns <= size(self%value)) self%value(self%columns) = value
         return
      end if
      if (self%columns == 1) self%header = ""
      if (self%columns > 1) self%header = self%header//","
      self%header = self%header//trim(name)
      if (len_trim(unit) > 0) self%header = self%header//" ["//trim(unit)//"]"
   end subroutine put_one

   !> The same of some columns with one unit
   pure subroutine put_some(self, names, unit, values)
      class(row_type), intent(inout) :: self
      !> Name of each, and their unit
      character(*), intent(in) :: names(:), unit
      !> Value of each
      real(wp), intent(in) :: values(:)
      integer :: i

      do i = 1, size(values)
         call self%put_one(names(i), unit, values(i))
      end do
   end subroutine put_some

   !> A row that takes values
   pure type(row_type) function new_row(columns) result(self)
      !> How many, as a heading counts them
      integer, intent(in) :: columns

      self%is_heading = .false.
      allocate (self%value(columns), source=0.0_wp)
   end function new_row

   !> Create the file and write the headers, or append to a file
   subroutine open_history(self, path, heading, positions, error)
      class(history_file_type), intent(inout) :: self
      !> Path of the file; a file that was there is replaced
      character(*), intent(in) :: path
      !> A row of headers
      type(row_type), intent(in) :: heading
      !> Where to go on with files of an earlier run; a file that is not there is created
      type(file_positions_type), intent(in) :: positions
      !> Why the file could not be created, or there is no going on with it
      type(error_type), allocatable, intent(out) :: error

      type(file_position_type) :: position

      self%path = trim(path)
      position = positions%at(self%path)
      if (position%amount < 0) then
         call create_text(self%path, self%unit, error)
         if (allocated(error)) return
         write (self%unit, "(a)") heading%header
      else
         call end_text(self%path, position%amount, error, heading%header)
         if (.not. allocated(error)) call append_to(self%path, self%unit, error)
         if (allocated(error)) return
      end if
      self%columns = heading%columns
      if (allocated(self%line)) deallocate (self%line)
      allocate (character((number_length + 1)*self%columns) :: self%line)
      self%opened = .true.
      call self%flush(error)
   end subroutine open_history

   !> Write a line
   subroutine write_line(self, row, error)
      class(history_file_type), intent(inout) :: self
      !> Has the values of all columns
      type(row_type), intent(in) :: row
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      character(number_length) :: word
      integer(int64) :: now, rate
      integer :: first, i, length, status

      if (row%columns /= self%columns) then
         call fail(error, exit_output, self%path//": a line must have a value for each column")
         return
      end if
      length = 0
      do i = 1, self%columns
         word = number_text(row%value(i))
         first = verify(word, " ")
         self%line(length + 1:length + number_length - first + 2) = word(first:)//","
         length = length + number_length - first + 2
      end do
      ! the comma after the last number is left out
      write (self%unit, "(a)", iostat=status) self%line(:length - 1)
      if (status /= 0) then
         call fail(error, exit_output, "cannot write to "//self%path//": its disk must have " &
            & //"room, and no other run the same job")
         return
      end if
      call system_clock(now, rate)
      if (now - self%secured > seconds_in_memory*rate) call self%flush(error)
   end subroutine write_line

   !> Put all lines on the disk, and add how far the file has been written
   subroutine mark_history(self, clock, positions, error)
      class(history_file_type), intent(inout) :: self
      !> Instants of its lines
      type(clock_type), intent(in) :: clock
      !> Positions in all files
      type(file_positions_type), intent(inout) :: positions
      !> Why the lines are not all there
      type(error_type), allocatable, intent(out) :: error

      integer(int64) :: bytes

      if (.not. self%opened) return
      call self%flush(error)
      if (allocated(error)) return
      inquire (file=self%path, size=bytes)
      call secure_file(self%path, error)
      if (.not. allocated(error)) call positions%add(self%path, clock%mark(bytes))
   end subroutine mark_history

   !> Put all lines on the disk
   subroutine flush_history(self, error)
      class(history_file_type), intent(inout) :: self
      !> Why they are not all there
      type(error_type), allocatable, intent(out) :: error

      if (.not. self%opened) return
      call close_text(self%path, self%unit, error)
      if (.not. allocated(error)) call append_to(self%path, self%unit, error)
      self%opened = .not. allocated(error)
      call system_clock(self%secured)
   end subroutine flush_history

   !> Put all lines on the disk and close the file; nothing happens when it is not open
   subroutine close_history(self, error)
      class(history_file_type), intent(inout) :: self
      !> Why the lines are not all there
      type(error_type), allocatable, intent(out) :: error

      if (.not. self%opened) return
      self%opened = .false.
      call close_text(self%path, self%unit, error)
   end subroutine close_history

   !> A number with ten significant digits, to the right
   pure function number_text(value) result(word)
      !> The number
      real(wp), intent(in) :: value
      character(number_length) :: word

      real(wp) :: magnitude

      if (.not. ieee_is_finite(value)) then
         write (word, "(f18.0)") value
         return
      end if
      magnitude = abs(value)
      if (magnitude < whole_limit .and. abs(value - anint(value)) <= 0.0_wp) then
         write (word, "(i18)") int(value, int64)
      else if (magnitude < short_from .or. magnitude >= short_to) then
         write (word, "(es18.9e3)") value
      else
         word = short_text(value)
      end if
   end function number_text

   !> A number with an exponent of two digits, by integers: formatting by the run-time
   !> library, for many more digits, would take most of a short run
   pure function short_text(value) result(word)
      !> The number, not zero
      real(wp), intent(in) :: value
      character(number_length) :: word

      integer, parameter :: ten = 10, zero = iachar("0"), point = 5, mark = 15
      integer(int64) :: digits
      integer :: exponent, i, rest

      exponent = floor(log10(abs(value)))
      digits = nint(abs(value)*10.0_wp**(significant - 1 - exponent), int64)
      if (digits >= int(ten, int64)**significant) then
         exponent = exponent + 1
         digits = nint(abs(value)*10.0_wp**(significant - 1 - exponent), int64)
      else if (digits < int(ten, int64)**(significant - 1)) then
         exponent = exponent - 1
         digits = nint(abs(value)*10.0_wp**(significant - 1 - exponent), int64)
      end if
      word = ""
      do i = mark - 1, point - 1, -1
         if (i == point) cycle
         word(i:i) = achar(zero + int(mod(digits, int(ten, int64))))
         digits = digits/ten
      end do
      word(point:point) = "."
      if (value < 0.0_wp) word(point - 2:point - 2) = "-"
      rest = abs(exponent)
      word(mark:) = merge("E-", "E+", exponent < 0)//achar(zero + rest/ten) &
         & //achar(zero + mod(rest, ten))
   end function short_text

end module plydyn_io_csv_history_file
