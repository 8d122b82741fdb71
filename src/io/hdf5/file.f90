!> A file of HDF5 being written by the root: its life, its groups, and the attributes of what is in
!> it. `plydyn_io_hdf5_output` adds the datasets.
!>
!> Several ranks call all procedures together. The root alone calls the library, and after the first
!> failure leaves the file as it is: closing it would spoil what was flushed before. The failure
!> becomes an error of all ranks at `flush` and at `close`: no rank waits for one whose disk failed.
!>
!> Parallel HDF5 (1.10.8, Open MPI 4.1, collective writes) was tried in place of this and is worse.
!> Of ten runs on two ranks in which writes failed, six hung inside the library and three at the end
!> of MPI. On two cores with 4 ranks a restart file of 21,000 numbers took 31 ms in place of 2 ms, a
!> state of fields 8 ms in place of 1 ms; a file of 168 MB took 0.9 s either way.
module plydyn_io_hdf5_file
   use plydyn_base_error, only : error_type, exit_output, fail
   use plydyn_base_files, only : rename_file, secure_file
   use plydyn_io_csv_text_file, only : try_text
   use plydyn_io_hdf5_raw_file, only : close_file, create_file, create_group, flush_file, &
      & handle_type, write_attribute, write_text_attribute
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   !> A file being written
   type, public :: hdf5_file_type
      !> Path of the file
      character(:), allocatable :: path
      !> The ranks that write it; for extensions
      type(comm_type) :: comm
      !> Its handle, of the root; for extensions
      type(handle_type) :: handle
      !> Whether metadata and datasets have check sums
      logical :: is_checked = .false.
      !> True between `create` and `close` or the first failure reported to all ranks
      logical, private :: opened = .false.
      !> What could not be written first, on the root
      character(:), allocatable, private :: failed
   contains
      procedure :: create
      procedure :: is_open
      procedure :: make_group
      procedure :: write_text
      !> Give an object of the file an attribute of integers, or give it anew with the same shape
      generic :: write_number => write_integer, write_integers
      procedure :: flush => flush_whole
      procedure :: secure
      procedure :: rename
      procedure :: close => close_whole
      procedure :: writes
      procedure :: note
      procedure, private :: write_integer, write_integers, confirm
   end type hdf5_file_type

contains

   !> Create the file, in place of one that was there
   subroutine create(self, path, comm, error, is_checked)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Path of the file; its folder must exist
      character(*), intent(in) :: path
      !> The ranks that write it together
      type(comm_type), intent(in) :: comm
      !> Why the file could not be created
      type(error_type), allocatable, intent(out) :: error
      !> Whether metadata and datasets get check sums
      logical, intent(in), optional :: is_checked

      logical :: good

      self%path = trim(path)
      self%comm = comm
      self%is_checked = .false.
      if (present(is_checked)) self%is_checked = is_checked
      if (allocated(self%failed)) deallocate (self%failed)
      if (comm%is_root()) call try_text(self%path, error)
      call comm%broadcast(error)
      if (allocated(error)) return
      self%opened = .true.
      if (comm%is_root()) then
         call create_file(self%path, self%is_checked, self%handle, good)
         call self%note(good, "the file")
      end if
      call self%confirm(error)
   end subroutine create

   !> True between `create` and `close` or the first failure reported to all ranks
   pure logical function is_open(self)
      class(hdf5_file_type), intent(in) :: self

      is_open = self%opened
   end function is_open

   !> Whether this rank calls the library: the root, before the first failure
   pure logical function writes(self)
      class(hdf5_file_type), intent(in) :: self

      writes = self%opened .and. self%comm%is_root() .and. .not. allocated(self%failed)
   end function writes

   !> Keep the first failure
   subroutine note(self, good, quantity)
      class(hdf5_file_type), intent(inout) :: self
      !> False when something went wrong
      logical, intent(in) :: good
      !> What was to be written
      character(*), intent(in) :: quantity

      if (.not. good .and. .not. allocated(self%failed)) self%failed = quantity
   end subroutine note

   !> Turn a failure of the root into an error of all ranks
   subroutine confirm(self, error)
      class(hdf5_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      if (.not. self%opened) then
         call fail(error, exit_output, "cannot write to "//self%path//": it is not open")
         return
      end if
      if (allocated(self%failed)) call fail(error, exit_output, "cannot write "//self%failed &
         & //" to "//self%path//": its disk must have room and be writable, and no other run the " &
         & //"same job")
      call self%comm%broadcast(error)
      if (allocated(error)) self%opened = .false.
   end subroutine confirm

   !> Make a group
   subroutine make_group(self, name)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Path of the group in the file; the groups above it must exist
      character(*), intent(in) :: name

      logical :: good

      if (.not. self%writes()) return
      call create_group(self%handle, name, good)
      call self%note(good, name)
   end subroutine make_group

   !> Attribute of text, of exactly its length; trailing blanks are left out
   subroutine write_text(self, place, name, value)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Path of the group or dataset that gets the attribute, and name of the attribute
      character(*), intent(in) :: place, name
      !> Its value
      character(*), intent(in) :: value

      logical :: good

      if (.not. self%writes()) return
      ! the library has no text without length: a single null reads as none
      if (len_trim(value) > 0) then
         call write_text_attribute(self%handle, place, name, trim(value), good)
      else
         call write_text_attribute(self%handle, place, name, achar(0), good)
      end if
      call self%note(good, place//"/"//name)
   end subroutine write_text

   !> Attribute of one integer
   subroutine write_integer(self, place, name, value)
      class(hdf5_file_type), intent(inout) :: self
      !> Path of the group or dataset that gets the attribute, and its name
      character(*), intent(in) :: place, name
      !> Its value
      integer, intent(in) :: value

      call self%write_number(place, name, [value])
   end subroutine write_integer

   !> Attribute of several integers
   subroutine write_integers(self, place, name, values)
      class(hdf5_file_type), intent(inout) :: self
      !> Path of the group or dataset that gets the attribute, and its name
      character(*), intent(in) :: place, name
      !> Its values
      integer, intent(in) :: values(:)

      logical :: good

      if (.not. self%writes()) return
      call write_attribute(self%handle, place, name, values, good)
      call self%note(good, place//"/"//name)
   end subroutine write_integers

   !> Hand all that was written to the operating system: it outlives a kill of this process
   subroutine flush_whole(self, error)
      class(hdf5_file_type), intent(inout) :: self
      !> What could not be written since the last time
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      if (self%writes()) then
         call flush_file(self%handle, good)
         call self%note(good, "what is not yet on the disk")
      end if
      call self%confirm(error)
   end subroutine flush_whole

   !> Wait until all that was written is on the disk
   subroutine secure(self, error)
      class(hdf5_file_type), intent(inout) :: self
      !> Why it is not
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      good = .true.
      if (self%comm%is_root()) call secure_file(self%path, good)
      if (.not. good) call fail(error, exit_output, "cannot flush "//self%path//" to its " &
         & //"disk, which must have room and be writable")
      call self%comm%broadcast(error)
   end subroutine secure

   !> Give the file another name, in place of a file that has it
   subroutine rename(self, path, error)
      class(hdf5_file_type), intent(inout) :: self
      !> Its new path, on the same disk
      character(*), intent(in) :: path
      !> Why it keeps its name
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      good = .true.
      if (self%comm%is_root()) call rename_file(self%path, path, good)
      if (.not. good) call fail(error, exit_output, "cannot rename "//self%path//" to "//path &
         & //": their folder must be writable")
      call self%comm%broadcast(error)
      if (.not. allocated(error)) self%path = path
   end subroutine rename

   !> Write what is left and close the file; nothing happens when it is not open
   subroutine close_whole(self, error)
      class(hdf5_file_type), intent(inout) :: self
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      if (.not. self%opened) return
      if (self%writes()) then
         call close_file(self%handle, good)
         call self%note(good, "what is not yet on the disk")
      end if
      call self%confirm(error)
      self%opened = .false.
   end subroutine close_whole

end module plydyn_io_hdf5_file
