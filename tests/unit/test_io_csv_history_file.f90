!> Files of histories: text of numbers, lines in the file.
program test_io_csv_history_file
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_io_csv_history_file, only : history_file_type, new_row, number_text, row_type
   use plydyn_method_clock, only : clock_type
   use plydyn_state_file_positions, only : new_file_positions, file_positions_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_io_csv_history_file.csv"

   call numbers()
   call lines()
   call goes_on()
   call refusals()
   call finish()

contains

   !> Text of numbers
   subroutine numbers()
      call begin("number_text")
      call check(adjustl(number_text(0.0_wp)) == "0", "zero")
      call check(adjustl(number_text(-42.0_wp)) == "-42", "a whole number has no exponent")
      call check(adjustl(number_text(-1.0_wp/3.0_wp)) == "-3.333333333E-01", "ten digits")
      call check(adjustl(number_text(1.0e10_wp)) == "1.000000000E+10", "eleven digits are too many")
      call check(adjustl(number_text(-1.5e-101_wp)) == "-1.500000000E-101", "a long exponent")
      call check(adjustl(number_text(9.9999999999e-100_wp)) == "1.000000000E-099", &
         & "an exponent that rounding makes short")
      call check(adjustl(number_text(5.0e-100_wp)) == "5.000000000E-100", "and one that is not")
      call check(adjustl(number_text(huge(1.0_wp))) == "1.797693135E+308", "the largest")
   end subroutine numbers

   !> Lines of a file
   subroutine lines()
      type(history_file_type) :: history
      type(error_type), allocatable :: error
      type(row_type) :: row
      character(80) :: line
      integer :: unit, status

      call begin("history")
      call put([0.0_wp, 2.5_wp, 1.0_wp], row)
      call check(row%columns, 3, "three columns are counted")
      call history%open(path, row, new_file_positions("x"), error)
      call check(.not. allocated(error), "opens")
      row = new_row(row%columns)
      call put([0.0_wp, 2.5_wp, 1.0_wp], row)
      call history%write_line(row, error)
      call history%flush(error)
      call check(.not. allocated(error), "flushes")
      row = new_row(row%columns)
      call put([1.0_wp, -1.0e-3_wp, 7.0_wp], row)
      call history%write_line(row, error)
      call history%close(error)
      call check(.not. allocated(error) .and. .not. history%opened, "closes")
      open (newunit=unit, file=path, status="old", action="read")
      read (unit, "(a)") line
      call check(line == "time [s],force [N],share", "headers have units")
      read (unit, "(a)") line
      call check(line == "0,2.500000000E+00,1", "numbers are separated by commas")
      read (unit, "(a)") line
      call check(line == "1,-1.000000000E-03,7", "a line after a flush follows")
      read (unit, "(a)", iostat=status) line
      call check(status /= 0, "nothing else")
      close (unit, status="delete")
   end subroutine lines

   !> Time, force and share
   subroutine put(values, row)
      real(wp), intent(in) :: values(3)
      type(row_type), intent(inout) :: row

      call row%put("time", "s", values(1))
      call row%put(["force"], "N", values(2:2))
      call row%put("share", "", values(3))
   end subroutine put

   !> A row of one column
   function column(name, unit, value) result(row)
      character(*), intent(in) :: name, unit
      !> None for a heading
      real(wp), intent(in), optional :: value
      type(row_type) :: row

      call row%put(name, unit, 0.0_wp)
      if (.not. present(value)) return
      row = new_row(row%columns)
      call row%put(name, unit, value)
   end function column

   !> A file that an earlier run wrote
   subroutine goes_on()
      type(history_file_type) :: history
      type(error_type), allocatable :: error
      type(file_positions_type) :: positions
      type(clock_type) :: clock
      character(80) :: line
      integer :: i, unit, status

      call begin("history goes on")
      positions = new_file_positions("test_io_csv_history_file")
      call history%open(path, column("time ", "s"), positions, error)
      call history%write_line(column("time", "s", 1.0_wp), error)
      call history%write_line(column("time", "s", 3.0_wp), error)
      call history%mark(clock, positions, error)
      call check(.not. allocated(error), "the position is noted")
      call check(size(positions%list) == 1 .and. positions%list(1)%amount == 13, "thirteen bytes")
      call history%write_line(column("time", "s", 5.0_wp), error)
      call history%close(error)
      call history%open(path, column("force", "N"), positions, error)
      call check_error(error, "must have the columns", "other columns than before")
      call history%open(path, column("t", " "), positions, error)
      call check_error(error, "must have the columns", "headers that only begin alike")
      call history%open(path, column("time ", "s"), positions, error)
      call check(.not. allocated(error), "the same columns")
      call history%write_line(column("time", "s", 4.0_wp), error)
      call history%close(error)
      open (newunit=unit, file=path, status="old", action="read")
      do i = 1, 4
         read (unit, "(a)") line
      end do
      call check(line == "4", "lines after the place are dropped, new ones follow")
      read (unit, "(a)", iostat=status) line
      call check(status /= 0, "nothing else")
      close (unit)
      call delete(path)
      call history%open(path, column("time ", "s"), positions, error)
      call check_error(error, "as the run left it", "a file that is not there")
   end subroutine goes_on

   !> What cannot be written
   subroutine refusals()
      type(history_file_type) :: history
      type(error_type), allocatable :: error
      type(row_type) :: row

      call begin("history refuses")
      call history%open("no/such/folder/x.csv", column("time", "s"), new_file_positions("x"), error)
      call check_error(error, "no/such/folder/x.csv", "a folder that is not there")
      call check(.not. history%opened, "it stays closed")
      call history%open(path, column("time", "s"), new_file_positions("x"), error)
      row = column("time", "s", 0.0_wp)
      call row%put("force", "N", 1.0_wp)
      call history%write_line(row, error)
      call check_error(error, "a value for each column", "a line too long")
      call history%close(error)
      call delete(path)
   end subroutine refusals

   !> Remove a file
   subroutine delete(name)
      character(*), intent(in) :: name

      integer :: unit

      open (newunit=unit, file=name)
      close (unit, status="delete")
   end subroutine delete

end program test_io_csv_history_file
