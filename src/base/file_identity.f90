!> Which file a path names: its kind, its size, and its inode, which two paths of one file share.
!>
!> The call is Linux' `statx`, whose structure has the same layout on every processor.
module plydyn_base_file_identity
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_int, c_int16_t, c_int32_t, &
      & c_int64_t, c_null_char, c_ptr
   use, intrinsic :: iso_fortran_env, only : int64
   implicit none
   private

   public :: identity_of, identity_of_open, is_same_file, make_folder, real_path

   !> Kinds of files
   integer, parameter, public :: no_file = 0, regular_file = 1, folder_file = 2, link_file = 3, &
      & pipe_file = 4, other_file = 5

   !> A file as the operating system identifies it
   type, public :: file_identity_type
      !> One of the kinds above
      integer :: kind = no_file
      !> Names that the file has
      integer :: links = 0
      !> Bytes
      integer(int64) :: length = 0
      !> Device and number on it
      integer(int64) :: inode(3) = 0
   end type file_identity_type

   !> What `statx` fills; the rest of its 256 bytes is not looked at
   type, bind(c) :: statx_type
      integer(c_int32_t) :: mask, block_size
      integer(c_int64_t) :: attributes
      integer(c_int32_t) :: links, user, group
      integer(c_int16_t) :: mode, spare
      integer(c_int64_t) :: inode, length, blocks, attributes_mask
      integer(c_int64_t) :: times(8)
      integer(c_int32_t) :: of_device(2), device(2)
      integer(c_int64_t) :: rest(14)
   end type statx_type

   !> As `statx` numbers the current folder, not to follow a link, and the basic members
   integer(c_int), parameter :: current_folder = -100, no_follow = 256, basic = 2047
   !> As `statx` numbers the file of a descriptor itself
   integer(c_int), parameter :: itself = 4096
   !> Bits of the mode that say the kind, and the kinds
   integer, parameter :: kind_bits = int(o"170000"), regular_bits = int(o"100000"), &
      & folder_bits = int(o"040000"), link_bits = int(o"120000"), pipe_bits = int(o"010000"), &
      & sixteen_bits = int(z"ffff")
   !> Longest path that the operating system accepts
   integer, parameter :: longest_path = 4096
   !> Rights of a new folder, less what the user's mask takes away
   integer(c_int), parameter :: all_rights = int(o"777", c_int)

   interface
      integer(c_int) function c_statx(folder, path, flags, mask, found) bind(c, name="statx")
         import :: c_char, c_int, statx_type
         implicit none
         integer(c_int), value :: folder, flags, mask
         character(kind=c_char), intent(in) :: path(*)
         type(statx_type), intent(out) :: found
      end function c_statx

      type(c_ptr) function c_realpath(path, whole) bind(c, name="realpath")
         import :: c_char, c_ptr, longest_path
         implicit none
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(inout) :: whole(longest_path)
      end function c_realpath

      integer(c_int) function c_mkdir(path, rights) bind(c, name="mkdir")
         import :: c_char, c_int
         implicit none
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: rights
      end function c_mkdir
   end interface

contains

   !> What a path names
   type(file_identity_type) function identity_of(path, follow) result(identity)
      !> Path of the file
      character(*), intent(in) :: path
      !> Whether to look at what a link leads to, not at the link
      logical, intent(in) :: follow

      identity = look_at(current_folder, path, merge(0_c_int, no_follow, follow))
   end function identity_of

   !> What an open file is, also after its name has gone
   type(file_identity_type) function identity_of_open(descriptor) result(identity)
      !> Descriptor of POSIX
      integer, intent(in) :: descriptor

      identity = look_at(int(descriptor, c_int), "", itself)
   end function identity_of_open

   !> Ask the operating system
   type(file_identity_type) function look_at(folder, path, flags) result(identity)
      !> Folder that the path begins in, or the file itself
      integer(c_int), intent(in) :: folder
      !> Path of the file
      character(*), intent(in) :: path
      !> How `statx` is to look
      integer(c_int), intent(in) :: flags

      type(statx_type) :: found

      if (c_statx(folder, path//c_null_char, flags, basic, found) /= 0) return
      identity%links = int(found%links)
      identity%length = int(found%length, int64)
      identity%inode(:) = [int(found%inode, int64), int(found%device, int64)]
      select case (iand(iand(int(found%mode), sixteen_bits), kind_bits))
      case (regular_bits); identity%kind = regular_file
      case (folder_bits); identity%kind = folder_file
      case (link_bits); identity%kind = link_file
      case (pipe_bits); identity%kind = pipe_file
      case default; identity%kind = other_file
      end select
   end function look_at

   !> Whether two identities are those of one file that is there
   pure logical function is_same_file(one, other)
      type(file_identity_type), intent(in) :: one, other

      is_same_file = one%kind /= no_file .and. one%kind == other%kind &
         & .and. all(one%inode == other%inode)
   end function is_same_file

   !> Path from the root on, without links; empty when there is no such file
   function real_path(path) result(whole)
      !> Path of a file or a folder
      character(*), intent(in) :: path
      character(:), allocatable :: whole

      character(kind=c_char) :: buffer(longest_path)
      integer :: length

      whole = ""
      if (.not. c_associated(c_realpath(path//c_null_char, buffer))) return
      length = findloc(buffer, c_null_char, 1) - 1
      whole = transfer(buffer(:length), repeat(" ", length))
   end function real_path

   !> Make a folder, and those above it, where they are not there
   subroutine make_folder(path, good)
      !> Path of the folder
      character(*), intent(in) :: path
      !> Whether it is there now
      logical, intent(out) :: good

      type(file_identity_type) :: identity
      integer :: i
      integer(c_int) :: status

      do i = 2, len(path)
         if (path(i:i) == "/") status = c_mkdir(path(:i - 1)//c_null_char, all_rights)
      end do
      ! a folder that exists already is no failure, anything else is
      status = c_mkdir(path//c_null_char, all_rights)
      identity = identity_of(path, follow=.true.)
      good = identity%kind == folder_file
   end subroutine make_folder

end module plydyn_base_file_identity
