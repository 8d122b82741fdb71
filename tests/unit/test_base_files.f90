!> Files: renamed, cut, removed, brought to the disk.
program test_base_files
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type
   use plydyn_base_files, only : bytes_of_file, cut_file, is_same_path, remove_file, rename_file, &
      & secure_file
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: one = "test_base_files_1", other = "test_base_files_2"

   call names()
   call paths()
   call lengths()
   call finish()

contains

   !> Names
   subroutine names()
      logical :: exists, good

      call begin("rename_file")
      call write_text(one, "new")
      call write_text(other, "older")
      call rename_file(one, other, good)
      inquire (file=one, exist=exists)
      call check(good .and. .not. exists, "the old name is gone")
      call check(bytes(other) == 3, "the file takes the place of another one")
      call rename_file(one, other, good)
      call check(.not. good, "a file that is not there has none")
      call check(bytes(other), 3, "a file that is not there replaces none")
      call remove_file(other)
      inquire (file=other, exist=exists)
      call check(.not. exists, "a file is removed")
   end subroutine names

   !> Paths in several words
   subroutine paths()
      call begin("is_same_path")
      call check(is_same_path("job", "./job"), "with and without the folder")
      call check(is_same_path("/proc//self/../job", "/proc/job"), "by a detour")
      call check(.not. is_same_path("job", "other"), "another name")
      call check(.not. is_same_path("job", "/job"), "another folder")
      call check(.not. is_same_path("/proc/job", "/job"), "a folder above")
   end subroutine paths

   !> Lengths
   subroutine lengths()
      type(error_type), allocatable :: error
      logical :: good

      call begin("cut_file")
      call write_text(one, "0123456789")
      call secure_file(one, error)
      call check(.not. allocated(error), "a file comes to the disk")
      call check(bytes_of_file(one, 3_int64, 4) == "3456", "some bytes are read")
      call check(len(bytes_of_file(one, 7_int64, 4)), 0, "but not behind its end")
      call cut_file(one, 4_int64, good)
      call check(good, "a file is cut")
      call check(bytes(one), 4, "where it is asked to")
      call remove_file(one)
      call cut_file(one, 4_int64, good)
      call check(.not. good, "a file that is not there cannot be cut")
      call secure_file(one, error)
      call check_error(error, "cannot flush "//one, "nor brought to the disk")
   end subroutine lengths

   !> Write a file of some bytes
   subroutine write_text(path, text)
      character(*), intent(in) :: path, text

      integer :: unit

      open (newunit=unit, file=path, access="stream", form="unformatted", status="replace")
      write (unit) text
      close (unit)
   end subroutine write_text

   !> Length of a file
   integer function bytes(path)
      character(*), intent(in) :: path

      inquire (file=path, size=bytes)
   end function bytes

end program test_base_files
