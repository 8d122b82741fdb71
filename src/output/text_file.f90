!> Text files whose last line is known to be on the disk.
!>
!> The run-time library of gfortran tells nobody when the disk is full: what it holds back is
!> dropped without an error. So a file is closed now and then, its size on the disk is compared
!> with what was written, and it is opened again at its end.
module plydyn_output_text_file
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_output, fail
   implicit none
   private

   public :: create_text, secure_text, close_text

contains

   !> Create a text file, in place of one that was there
   subroutine create_text(path, unit, error)
      !> Path of the file; its folder must exist
      character(*), intent(in) :: path
      !> Unit to write lines to
      integer, intent(out) :: unit
      !> Why the file could not be created
      type(error_type), allocatable, intent(out) :: error

      character(256) :: reason
      integer :: status

      open (newunit=unit, file=path, status="replace", action="write", access="stream", &
         & form="formatted", iostat=status, iomsg=reason)
      if (status /= 0) call fail(error, exit_output, "cannot create "//path//": "//trim(reason))
   end subroutine create_text

   !> Put all lines written so far on the disk, and see that they are there
   subroutine secure_text(path, unit, error)
      !> Path of the file
      character(*), intent(in) :: path
      !> Unit of the file, another one afterwards
      integer, intent(inout) :: unit
      !> Why the lines are not all there
      type(error_type), allocatable, intent(out) :: error

      character(256) :: reason
      integer :: status

      call close_text(path, unit, error)
      if (allocated(error)) return
      open (newunit=unit, file=path, status="unknown", position="append", action="write", &
         & access="stream", form="formatted", iostat=status, iomsg=reason)
      if (status /= 0) call fail(error, exit_output, "cannot go on with "//path//": "//trim(reason))
   end subroutine secure_text

   !> Close a text file and see that all its lines are on the disk
   subroutine close_text(path, unit, error)
      !> Path of the file
      character(*), intent(in) :: path
      !> Unit of the file
      integer, intent(in) :: unit
      !> Why the lines are not all there
      type(error_type), allocatable, intent(out) :: error

      integer(int64) :: written, kept
      integer :: status
      logical :: exists

      inquire (unit=unit, pos=written)
      written = written - 1
      close (unit, iostat=status)
      inquire (file=path, exist=exists, size=kept)
      ! a file that somebody removed meanwhile is no failure of ours
      if (status == 0 .and. (kept >= written .or. .not. exists)) return
      call fail(error, exit_output, "cannot write to "//path//": its disk must have room")
   end subroutine close_text

end module plydyn_output_text_file
