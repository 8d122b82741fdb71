!> Tables of support forces over restarts that bring other supports.
program test_io_csv_support_history
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type
   use plydyn_io_job, only : job_type
   use plydyn_state_file_positions, only : new_file_positions, file_position_type, &
      & file_positions_type
   use plydyn_io_csv_support_history, only : choose_table
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: name = "test_io_csv_support_history"
   !> Two tables: heads and one line of two characters that a restart file tells of, and one more
   character(*), parameter :: tables(2) = [character(60) :: name//".supports.csv", &
      & name//".supports_2.csv"]
   type(error_type), allocatable :: error
   type(job_type) :: job
   type(file_positions_type) :: ended
   character(:), allocatable :: ending

   job%path = name
   call begin("choose_table")
   job%places = new_file_positions(name)
   call choose_table(job, "a", .true., ending, ended, error)
   call check(name//ending == trim(tables(1)) .and. size(ended%list) == 0, "a run that begins")

   call keep(1, "a")
   call choose_table(job, "b", .false., ending, ended, error)
   call check(name//ending == trim(tables(1)) .and. size(ended%list) == 0, &
      & "a restart without a deck")
   call choose_table(job, "a", .true., ending, ended, error)
   call check(name//ending == trim(tables(1)) .and. size(ended%list) == 0, "the same supports")
   call check(bytes(1), 6, "nothing is cut: the history does so")
   call choose_table(job, "ab", .true., ending, ended, error)
   call check(name//ending == trim(tables(2)) .and. size(ended%list) == 1, "other supports")
   call check(bytes(1), 4, "the table before ends where the restart file was written")
   call check(.not. allocated(error), "goes well")

   call keep(2, "ab")
   call choose_table(job, "ab", .false., ending, ended, error)
   call check(name//ending == trim(tables(2)) .and. size(ended%list) == 1, &
      & "a restart goes on in the last")
   call check(int(ended%list(1)%amount) == 4 .and. ended%list(1)%ending == ".supports.csv", &
      & "the next restart file tells of both")
   call choose_table(job, "a", .true., ending, ended, error)
   call check(ending == ".supports_3.csv" .and. size(ended%list) == 2, &
      & "the heads of an older table begin a new one")

   call remove(1)
   call choose_table(job, "ab", .false., ending, ended, error)
   call check_error(error, "it must be there", "a table that is gone")
   call remove(2)
   call finish()

contains

   !> Write a table, and note its first two lines
   subroutine keep(number, heads)
      !> Which
      integer, intent(in) :: number
      !> Its first line
      character(*), intent(in) :: heads
      integer :: unit

      open (newunit=unit, file=tables(number), status="replace", action="write", access="stream", &
         & form="formatted")
      write (unit, "(a)") heads, "1", "2"
      close (unit)
      call job%places%add(trim(tables(number)), file_position_type(amount=int(len(heads), &
         & int64) + 3_int64))
   end subroutine keep

   !> Size of a table
   integer function bytes(number)
      !> Which
      integer, intent(in) :: number

      inquire (file=tables(number), size=bytes)
   end function bytes

   !> Remove a table
   subroutine remove(number)
      !> Which
      integer, intent(in) :: number
      integer :: unit

      open (newunit=unit, file=tables(number), status="old")
      close (unit, status="delete")
   end subroutine remove

end program test_io_csv_support_history
