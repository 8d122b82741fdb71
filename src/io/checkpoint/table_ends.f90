!> How the tables of a job ended when a restart file was written: a table of another run under the
!> same name ends otherwise there.
module plydyn_io_checkpoint_table_ends
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_files, only : bytes_of_file
   use plydyn_state_file_positions, only : file_positions_type
   implicit none
   private

   public :: compare_ends, table_ends

   !> Bytes of the end of a table that a restart file keeps
   integer, parameter, public :: end_length = 64

contains

   !> Ends of all files in the order of their positions
   function table_ends(positions) result(ends)
      !> How far the files have been written
      type(file_positions_type), intent(in) :: positions
      character(:), allocatable :: ends

      integer :: i

      ends = ""
      do i = 1, size(positions%list)
         ends = ends//table_end(positions, i)
      end do
   end function table_ends

   !> Last bytes of a table before its position; blank for a file that is none or not so long
   function table_end(positions, i) result(bytes)
      type(file_positions_type), intent(in) :: positions
      !> Number of the file
      integer, intent(in) :: i
      character(end_length) :: bytes

      bytes = ""
      associate (position => positions%list(i))
         if (index(position%ending, ".csv ", back=.true.) == 0) return
         if (position%amount < end_length) return
         bytes = bytes_of_file(positions%job//trim(position%ending), &
            & position%amount - end_length, end_length)
      end associate
   end function table_end

   !> Refuse to go on with tables of another run; one that is not there is not compared
   subroutine compare_ends(positions, ends, error)
      !> How far the files had been written
      type(file_positions_type), intent(in) :: positions
      !> Their ends at that time, as from `table_ends`
      character(*), intent(in) :: ends
      !> A table ends otherwise
      type(error_type), allocatable, intent(out) :: error

      character(end_length) :: found
      integer :: i

      do i = 1, size(positions%list)
         found = table_end(positions, i)
         associate (kept => ends(end_length*(i - 1) + 1:end_length*i))
            if (found == kept .or. found == "" .or. kept == "") cycle
         end associate
         call fail(error, exit_input, positions%job//trim(positions%list(i)%ending)//" is of " &
            & //"another run than the restart file: bring back the results that belong to it, " &
            & //"or give the restart files of its own with -j JOB")
         return
      end do
   end subroutine compare_ends

end module plydyn_io_checkpoint_table_ends
