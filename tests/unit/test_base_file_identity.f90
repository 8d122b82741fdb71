!> What paths name: kinds of files, and whether two paths name one file.
program test_base_file_identity
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_file_identity, only : file_identity_type, folder_file, identity_of, &
      & is_same_file, link_file, make_folder, no_file, other_file, real_path, regular_file
   use testing, only : begin, check, finish
   implicit none

   character(*), parameter :: name = "test_base_file_identity_1", folder = "test_base_file_folder"

   call kinds()
   call inodes()
   call folders()
   call finish()

contains

   !> Kinds
   subroutine kinds()
      type(file_identity_type) :: identity

      call begin("identity_of")
      call write_file(name)
      identity = identity_of(name, follow=.false.)
      call check(identity%kind, regular_file, "a file is regular")
      call check(identity%links, 1, "it has one name")
      call check(identity%length == 5_int64, "its length is that of its bytes")
      identity = identity_of("/proc", follow=.true.)
      call check(identity%kind, folder_file, "a folder")
      identity = identity_of("/dev/zero", follow=.true.)
      call check(identity%kind, other_file, "a device is none of both")
      identity = identity_of("/proc/self/exe", follow=.false.)
      call check(identity%kind, link_file, "a link")
      identity = identity_of("/proc/self/exe", follow=.true.)
      call check(identity%kind, regular_file, "what a link leads to")
      identity = identity_of("/proc/no such file", follow=.true.)
      call check(identity%kind, no_file, "nothing")
   end subroutine kinds

   !> One file by two paths
   subroutine inodes()
      type(file_identity_type) :: one

      call begin("is_same_file")
      one = identity_of(name, follow=.true.)
      call check(is_same_file(one, identity_of("./"//name, follow=.true.)), "in other words")
      call check(.not. is_same_file(one, identity_of("/proc", follow=.true.)), "another file")
      one = identity_of("/proc/no such file", follow=.true.)
      call check(.not. is_same_file(one, one), "what is not there is no file")
      call check(real_path("/proc/../proc/.") == "/proc", "a path without detours")
      call check(len(real_path("/proc/no such file")), 0, "no path without a file")
   end subroutine inodes

   !> Folders
   subroutine folders()
      logical :: good

      call begin("make_folder")
      call make_folder(folder//"/in/it", good)
      call check(good, "with those above it")
      call make_folder(folder, good)
      call check(good, "one that is there")
      call make_folder(name//"/below", good)
      call check(.not. good, "none below a file")
   end subroutine folders

   !> A file of five bytes
   subroutine write_file(path)
      character(*), intent(in) :: path
      integer :: unit

      open (newunit=unit, file=path, status="replace", action="write")
      write (unit, "(a)") "1234"
      close (unit)
   end subroutine write_file

end program test_base_file_identity
