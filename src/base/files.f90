!> File operations of POSIX that Fortran lacks: synchronise, rename, truncate, remove.
!>
!> None of the calls has a variable number of arguments, which `bind(c)` does not support.
module plydyn_base_files
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_int, c_int64_t, c_loc, &
      & c_null_char, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_output, fail
   use plydyn_base_file_identity, only : real_path
   implicit none
   private

   public :: cut_file, bytes_of_file, is_same_path, remove_file, rename_file, secure_file
   ! streams of C, for what needs a descriptor
   public :: c_fclose, c_fileno, c_fopen

   interface
      integer(c_int) function c_rename(from, to) bind(c, name="rename")
         import :: c_char, c_int
         implicit none
         character(kind=c_char), intent(in) :: from(*), to(*)
      end function c_rename

      integer(c_int) function c_remove(path) bind(c, name="remove")
         import :: c_char, c_int
         implicit none
         character(kind=c_char), intent(in) :: path(*)
      end function c_remove

      integer(c_int) function c_truncate(path, length) bind(c, name="truncate")
         import :: c_char, c_int, c_int64_t
         implicit none
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int64_t), value :: length
      end function c_truncate

      integer(c_int) function c_fsync(descriptor) bind(c, name="fsync")
         import :: c_int
         implicit none
         integer(c_int), value :: descriptor
      end function c_fsync

      integer(c_size_t) function c_pread(descriptor, bytes, count, before) bind(c, name="pread")
         import :: c_int, c_int64_t, c_ptr, c_size_t
         implicit none
         integer(c_int), value :: descriptor
         type(c_ptr), value :: bytes
         integer(c_size_t), value :: count
         integer(c_int64_t), value :: before
      end function c_pread

      type(c_ptr) function c_fopen(path, mode) bind(c, name="fopen")
         import :: c_char, c_ptr
         implicit none
         character(kind=c_char), intent(in) :: path(*), mode(*)
      end function c_fopen

      integer(c_int) function c_fileno(stream) bind(c, name="fileno")
         import :: c_int, c_ptr
         implicit none
         type(c_ptr), value :: stream
      end function c_fileno

      integer(c_int) function c_fclose(stream) bind(c, name="fclose")
         import :: c_int, c_ptr
         implicit none
         type(c_ptr), value :: stream
      end function c_fclose
   end interface

contains

   !> Rename a file atomically, replacing an existing one, and synchronise the directory
   subroutine rename_file(from, to, good)
      !> Path of the file
      character(*), intent(in) :: from
      !> Its new path, on the same file system
      character(*), intent(in) :: to
      !> Whether it succeeded
      logical, intent(out) :: good

      logical :: unused

      good = c_rename(from//c_null_char, to//c_null_char) == 0
      ! the result is ignored: some file systems do not support this for directories
      if (good) unused = is_synchronised(to(:index(to, "/", back=.true.))//".")
   end subroutine rename_file

   !> Whether two paths, of files that may not exist, name the same file
   logical function is_same_path(one, other)
      !> Paths; their folders must exist
      character(*), intent(in) :: one, other

      integer :: name, other_name

      name = index(one, "/", back=.true.) + 1
      other_name = index(other, "/", back=.true.) + 1
      is_same_path = one(name:) == other(other_name:)
      if (.not. is_same_path) return
      is_same_path = real_path(one(:name - 1)//".") == real_path(other(:other_name - 1)//".")
   end function is_same_path

   !> Synchronise a file with the disk
   subroutine secure_file(path, error)
      !> Path of the file
      character(*), intent(in) :: path
      !> It is not on the disk
      type(error_type), allocatable, intent(out) :: error

      if (.not. is_synchronised(path)) call fail(error, exit_output, "cannot flush "//path &
         & //" to its disk, which must have room and be writable")
   end subroutine secure_file

   !> Synchronise a file or a directory with the disk, and say whether it is
   logical function is_synchronised(path)
      character(*), intent(in) :: path

      type(c_ptr) :: stream
      integer(c_int) :: status(2)

      status(:) = -1
      stream = c_fopen(path//c_null_char, "r"//c_null_char)
      if (c_associated(stream)) then
         status(1) = c_fsync(c_fileno(stream))
         status(2) = c_fclose(stream)
      end if
      is_synchronised = all(status == 0)
   end function is_synchronised

   !> Bytes of a file, which may be open for writing: Fortran opens no file twice
   function bytes_of_file(path, before, count) result(bytes)
      !> Path of the file
      character(*), intent(in) :: path
      !> Bytes of the file before them
      integer(int64), intent(in) :: before
      !> How many there are
      integer, intent(in) :: count
      !> The bytes; none when the file has not so many
      character(:), allocatable :: bytes

      character(count), target :: found
      type(c_ptr) :: stream
      integer(c_int) :: status

      bytes = ""
      stream = c_fopen(path//c_null_char, "r"//c_null_char)
      if (.not. c_associated(stream)) return
      if (c_pread(c_fileno(stream), c_loc(found), int(count, c_size_t), int(before, c_int64_t)) &
         & == count) bytes = found
      status = c_fclose(stream)
   end function bytes_of_file

   !> Truncate a file
   subroutine cut_file(path, length, good)
      !> Path of the file
      character(*), intent(in) :: path
      !> New length, bytes
      integer(int64), intent(in) :: length
      !> Whether it succeeded
      logical, intent(out) :: good

      good = c_truncate(path//c_null_char, int(length, c_int64_t)) == 0
   end subroutine cut_file

   !> Remove a file, if it exists
   subroutine remove_file(path)
      !> Path of the file
      character(*), intent(in) :: path

      integer(c_int) :: status

      ! the result is ignored: the file may not exist
      status = c_remove(path//c_null_char)
   end subroutine remove_file

end module plydyn_base_files
