!> Text files whose last line is known to be on the disk.
!>
!> The run-time library of gfortran reports no full disk: lines in its buffer are dropped without
!> an error. So a file is closed now and then, its size on the disk is compared
!> with what was written, and it is opened again at its end.
module plydyn_io_csv_text_file
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_output, fail
   use plydyn_base_file_identity, only : file_identity_type, identity_of, link_file, no_file, &
      & regular_file
   use plydyn_base_files, only : cut_file, remove_file
   implicit none
   private

   public :: append_to, close_text, create_text, end_text, has_header, try_text

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

      call take_name(path, error)
      if (allocated(error)) return
      open (newunit=unit, file=path, status="replace", action="write", access="stream", &
         & form="formatted", iostat=status, iomsg=reason)
      if (status /= 0) call fail(error, exit_output, "cannot create "//path//": "//trim(reason))
   end subroutine create_text

   !> Make sure that what is written under a name goes to no other file: a link is removed, so is
   !> one of several names of a file
   subroutine take_name(path, error)
      !> Path of a file to be created
      character(*), intent(in) :: path
      !> Why the name cannot be had
      type(error_type), allocatable, intent(out) :: error

      type(file_identity_type) :: identity

      identity = identity_of(path, follow=.false.)
      select case (identity%kind)
      case (no_file)
         return
      case (link_file)
      case (regular_file)
         if (identity%links == 1) return
      case default
         call fail(error, exit_output, "cannot create "//path//": it is there and no regular file")
         return
      end select
      call remove_file(path)
      identity = identity_of(path, follow=.false.)
      if (identity%kind /= no_file) call fail(error, exit_output, "cannot create "//path//": it " &
         & //"is a link, which cannot be removed")
   end subroutine take_name

   !> Find the reason why a path cannot be opened, in words of the run-time library
   subroutine try_text(path, error)
      !> Path of the file
      character(*), intent(in) :: path
      !> Why it cannot be written
      type(error_type), allocatable, intent(out) :: error

      character(256) :: reason
      integer :: unit, status

      call take_name(path, error)
      if (allocated(error)) return
      open (newunit=unit, file=path, action="readwrite", iostat=status, iomsg=reason)
      if (status /= 0) then
         call fail(error, exit_output, "cannot create "//path//": "//trim(reason))
         return
      end if
      close (unit)
   end subroutine try_text

   !> Drop the bytes of a text file behind some length
   subroutine end_text(path, length, error, header)
      !> Path of the file
      character(*), intent(in) :: path
      !> Bytes that stay
      integer(int64), intent(in) :: length
      !> Why they do not
      type(error_type), allocatable, intent(out) :: error
      !> First line that it must have
      character(*), intent(in), optional :: header

      integer(int64) :: kept
      integer :: status, unit
      logical :: good

      call refuse_link(path, error)
      if (allocated(error)) return
      open (newunit=unit, file=path, status="old", action="readwrite", access="stream", &
         & form="formatted", iostat=status)
      if (status /= 0) then
         call fail(error, exit_output, "cannot go on with "//path//": it must be there and " &
            & //"writable, as the run left it")
         return
      end if
      inquire (unit=unit, size=kept)
      close (unit)
      good = .true.
      if (present(header)) good = has_header(path, header)
      good = good .and. kept >= length
      if (good) call cut_file(path, length, good)
      if (.not. good) call fail(error, exit_output, "cannot go on with "//path//": it must have " &
         & //"the columns and all lines that it had when the restart file was written")
   end subroutine end_text

   !> Whether a text file is there and begins with some line
   logical function has_header(path, header)
      !> Path of the file, and the line
      character(*), intent(in) :: path, header

      ! one character more than the header shows whether the line is longer
      character(len(header) + 1) :: found
      integer :: status, unit

      has_header = .false.
      open (newunit=unit, file=path, status="old", action="read", access="stream", &
         & form="formatted", iostat=status)
      if (status /= 0) return
      read (unit, "(a)", iostat=status) found
      close (unit)
      has_header = status == 0 .and. found == header
   end function has_header

   !> Open a text file at its end
   subroutine append_to(path, unit, error)
      !> Path of the file
      character(*), intent(in) :: path
      !> Unit to write lines to
      integer, intent(out) :: unit
      !> Why it cannot be opened
      type(error_type), allocatable, intent(out) :: error

      character(256) :: reason
      integer :: status

      call refuse_link(path, error)
      if (allocated(error)) return
      open (newunit=unit, file=path, status="unknown", position="append", action="write", &
         & access="stream", form="formatted", iostat=status, iomsg=reason)
      if (status /= 0) call fail(error, exit_output, "cannot go on with "//path//": "//trim(reason))
   end subroutine append_to

   !> Refuse to go on with a file through a link to it
   subroutine refuse_link(path, error)
      !> Path of the file
      character(*), intent(in) :: path
      !> It is a link
      type(error_type), allocatable, intent(out) :: error

      type(file_identity_type) :: identity

      identity = identity_of(path, follow=.false.)
      if (identity%kind == link_file) call fail(error, exit_output, "cannot go on with "//path &
         & //": it must be a file, and is a link")
   end subroutine refuse_link

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
      ! a file that was removed meanwhile is not a failure
      if (status == 0 .and. (kept >= written .or. .not. exists)) return
      call fail(error, exit_output, "cannot write to "//path//": its disk must have room, " &
         & //"and no other run the same job")
   end subroutine close_text

end module plydyn_io_csv_text_file
