!> Lines of a deck and of its include files, each with its file and number.
program test_deck_source
   use plydyn_deck_report, only : severity_error, severity_warning, report_type
   use plydyn_deck_source, only : add_source, begin_source, source_type
   use testing, only : begin, check, finish
   implicit none

   character(*), parameter :: feed = achar(10), windows = achar(13)//achar(10)
   type(source_type) :: source
   type(report_type) :: report

   call begin("add_source")
   call write_file("source_1.k", "*KEYWORD"//feed//"$ comment"//feed//"*NODE"//feed//feed &
      & //"  1  "//feed//"*END"//feed//"rest")
   call read_alone("source_1.k")
   call check(source%line_count, 5, "comments are gone, blank lines are kept")
   call check(source%where(2) == "source_1.k:3", "lines keep their numbers")
   call check(source%line(4) == "  1" .and. source%width(4) == 3, "blanks at the end are cut")
   call check(source%is_keyword(2) .and. .not. source%is_keyword(4), "stars make keywords")
   call check(source%ended, "the end is seen")
   call check(report%count(severity_warning), 1, "text after it makes a warning")

   call begin("line ends")
   call write_file("source_2.k", char(239)//char(187)//char(191)//"*KEYWORD"//windows//"  1" &
      & //windows//"*END")
   call read_alone("source_2.k")
   call check(source%line_count, 3, "lines of Windows and a last line without end")
   call check(source%line(2) == "  1" .and. source%width(2) == 3, "carry no line end")
   call check(source%line(1) == "*KEYWORD", "a byte order mark is no part of the first line")
   call write_file("source_3.k", "")
   call read_alone("source_3.k")
   call check(source%line_count <= 1 .and. .not. source%ended, "an empty file has no end")

   call begin("include")
   call write_file("source_4.k", "*KEYWORD"//feed//"*INCLUDE"//feed//"source_5.k"//feed &
      & //"source_6.k"//feed//"*END"//feed)
   call write_file("source_5.k", "*NODE"//feed//"5"//feed//"*END"//feed)
   call write_file("source_6.k", "*PART"//feed//"6"//feed)
   call read_alone("source_4.k")
   call check(report%count(severity_error), 0, "two files are found")
   call check(source%where(6) == "source_5.k:2", "the first one comes first")
   call check(source%where(9) == "source_6.k:2", "the second one comes second")
   call check(source%where(10) == "source_4.k:5", "the deck goes on behind them")
   call check(source%ended, "and ends")

   call begin("include, errors")
   call write_file("source_7.k", "*KEYWORD"//feed//"*INCLUDE"//feed//"source_8.k"//feed//"*END")
   call write_file("source_8.k", "*INCLUDE"//feed//"source_7.k"//feed)
   call read_alone("source_7.k")
   call check(report%count(severity_error), 1, "a cycle is an error")
   call check(source%where(report%findings(report%shown)%place%line) == "source_8.k:2", &
      & "at the line that closes it")
   call write_file("source_9.k", "*INCLUDE"//feed//"nowhere.k"//feed)
   call read_alone("source_9.k")
   call check(report%count(severity_error), 2, "a missing file is an error")
   call read_alone("nowhere.k")
   call check(report%count(severity_error), 3, "also as the deck itself")
   call check(source%ended, "whose end nobody misses")
   call write_file("source_10.k", char(137)//"HDF"//windows//char(26))
   call read_alone("source_10.k")
   call check(report%count(severity_error), 4, "so is a restart file in place of a deck")
   call write_file("source_11.toml", "title = 'an impact'"//feed)
   call read_alone("source_11.toml")
   call check(index(report%findings(report%shown)%wrong, "is a recipe, not a deck") > 0, &
      & "and a recipe")
   call write_file("source_12.toml", "*KEYWORD"//feed//"*END"//feed)
   call read_alone("source_12.toml")
   call check(report%count(severity_error), 5, "but not a deck that is called like one")

   call finish()

contains

   !> Read a deck that nothing stands before
   subroutine read_alone(path)
      !> Path of the deck
      character(*), intent(in) :: path

      call begin_source(source)
      call add_source(path, source, report)
   end subroutine read_alone

   !> Write a file byte by byte
   subroutine write_file(path, content)
      !> Its path
      character(*), intent(in) :: path
      !> Everything in it
      character(*), intent(in) :: content

      integer :: unit

      open (newunit=unit, file=path, access="stream", form="unformatted", status="replace", &
         & action="write")
      write (unit) content
      close (unit)
   end subroutine write_file

end program test_deck_source
