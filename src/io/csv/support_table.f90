!> Choice of the file of support forces. A restart may bring other supports: their forces have other
!> columns and a table of their own, beside the table that ends there.
module plydyn_io_csv_support_table
   use plydyn_base_error, only : error_type
   use plydyn_base_text, only : text
   use plydyn_io_job, only : job_type
   use plydyn_state_file_positions, only : new_file_positions, file_position_type, &
      & file_positions_type
   use plydyn_io_csv_text_file, only : end_text, has_header
   implicit none
   private

   public :: choose_table

contains

   !> Find the table to begin or to go on with, and let those before it end where the restart file
   !> was written
   subroutine choose_table(job, header, is_changed, path, ended, error)
      !> The job
      type(job_type), intent(in) :: job
      !> Heads of the columns
      character(*), intent(in) :: header
      !> Whether a deck of a restart may have brought other supports
      logical, intent(in) :: is_changed
      !> Path of the table
      character(:), allocatable, intent(out) :: path
      !> Places of the tables before it
      type(file_positions_type), intent(out) :: ended
      !> A table before it is not as the run left it
      type(error_type), allocatable, intent(out) :: error

      type(file_position_type) :: place
      integer :: number

      ended = new_file_positions(job%path)
      number = 1
      do
         path = table_path(job, number)
         place = job%places%at(path)
         if (place%amount < 0) exit
         number = number + 1
         ! the last one goes on unless its columns are others
         if (.not. is_known(job, number)) then
            if (.not. is_changed) return
            if (has_header(path, header)) return
         end if
         call end_text(path, place%amount, error)
         if (allocated(error)) return
         call ended%add(path, place)
      end do
      if (number > 1) call job%note("other supports act from here on: their forces are in "//path)
   end subroutine choose_table

   !> Whether the restart file has a position in a table
   pure logical function is_known(job, number)
      type(job_type), intent(in) :: job
      !> Number of the table
      integer, intent(in) :: number

      type(file_position_type) :: place

      place = job%places%at(table_path(job, number))
      is_known = place%amount >= 0
   end function is_known

   !> Path of a table
   pure function table_path(job, number) result(path)
      !> The job
      type(job_type), intent(in) :: job
      !> Number of the table
      integer, intent(in) :: number
      character(:), allocatable :: path

      path = job%path//".supports"
      if (number > 1) path = path//"_"//text(number)
      path = path//".csv"
   end function table_path

end module plydyn_io_csv_support_table
