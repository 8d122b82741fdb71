!> A file of HDF5 being written, by one rank or by several together: its life, its groups, and the
!> attributes of what is in it. `plydyn_io_hdf5_output` adds the datasets.
!>
!> Files have the earliest format of the library, so that a file whose run was killed opens again
!> with all that was flushed, and no lock, so that a running job can be looked at. Objects inside
!> a file are named by their path, such as `VTKHDF/Steps/Values`.
!>
!> Several ranks call all procedures together, and get the same error. The root alone has the file
!> open with the library, and makes all things in it; to long datasets each rank brings its numbers
!> by itself, where the root says that there is room for them. So no rank ever waits for one whose
!> disk has failed but where all agree on what happened.
module plydyn_io_hdf5_file
   use, intrinsic :: iso_c_binding, only : c_loc
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_output, fail
   use plydyn_base_files, only : has_room, rename_file
   use plydyn_base_precision, only : wp
   use plydyn_io_checkpoint_distributed_file, only : distributed_file_type
   use plydyn_io_hdf5_numbers, only : is_integer, is_real, numbers_type, dataset_layout_type, &
      & hyperslab_type, &
      & store_double, store_long
   use plydyn_io_hdf5_raw, only : create_group, write_attribute, write_text_attribute
   use plydyn_io_hdf5_raw_file, only : close_file, create_file, flush_file, handle_type
   use plydyn_io_csv_text_file, only : try_text
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   !> Bytes of the library's own data that come with a dataset, or with rows, and more
   integer(int64), parameter :: overhead = 2_int64**14

   !> A file being written
   type, public :: hdf5_file_type
      !> Path of the file
      character(:), allocatable :: path
      !> Its handle, of the root; for extensions
      type(handle_type) :: handle
      !> The file as each of several ranks writes it
      type(distributed_file_type), private :: bands
      !> The ranks that write it
      type(comm_type), private :: comm
      !> True between `create` and `close` or the first failure
      logical, private :: opened = .false.
   contains
      procedure :: create
      procedure :: is_open
      procedure :: is_root
      procedure :: is_alone
      procedure :: agree
      procedure :: bring
      procedure :: reserve
      procedure :: rename
      procedure :: make_group
      procedure :: write_text
      !> Give an object of the file an attribute of numbers, or give it anew with the same shape
      generic :: write_number => write_integer, write_integers, write_real
      procedure :: flush => flush_all
      procedure :: close => close_whole
      procedure :: confirm
      procedure, private :: write_integer, write_integers, write_real
   end type hdf5_file_type

contains

   !> Create the file, in place of one that was there
   subroutine create(self, path, comm, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Path of the file; its folder must exist
      character(*), intent(in) :: path
      !> The ranks that write it together
      type(comm_type), intent(in) :: comm
      !> Why the file could not be created
      type(error_type), allocatable, intent(out) :: error

      self%path = trim(path)
      self%comm = comm
      if (comm%is_root()) call try_text(self%path, error)
      call comm%broadcast(error)
      if (allocated(error)) return
      self%opened = .true.
      if (comm%is_root()) call create_file(self%path, self%handle, self%opened)
      call self%confirm(self%opened, "the file", error)
      if (allocated(error) .or. self%is_alone()) return
      call self%bands%open(self%path, self%opened)
      call self%confirm(self%opened, "the file", error)
   end subroutine create

   !> True between `create` and `close` or the first failure
   pure logical function is_open(self)
      class(hdf5_file_type), intent(in) :: self

      is_open = self%opened
   end function is_open

   !> Whether this is the only rank that writes, or the root of several
   pure logical function is_root(self)
      class(hdf5_file_type), intent(in) :: self

      is_root = self%comm%is_root()
   end function is_root

   !> Whether one rank alone writes the file
   pure logical function is_alone(self)
      class(hdf5_file_type), intent(in) :: self

      is_alone = self%comm%ranks == 1
   end function is_alone

   !> Bring the rows of each of several ranks to the file
   subroutine bring(self, numbers, slab, room, good)
      !> The file
      class(hdf5_file_type), intent(in) :: self
      !> What this rank has
      type(numbers_type), intent(in) :: numbers
      !> Which rows these are
      type(hyperslab_type), intent(in) :: slab
      !> Where all rows lie, as the root knows
      type(dataset_layout_type), intent(in) :: room
      !> True when all went well here
      logical, intent(out) :: good

      type(dataset_layout_type) :: same

      same = room
      call tell_room(self%comm, same)
      call self%bands%write(numbers, slab, same, good)
   end subroutine bring

   !> Let all ranks know where rows lie
   subroutine tell_room(comm, room)
      type(comm_type), intent(in) :: comm
      !> The root's in, the same on all ranks out; none of its numbers needs all digits of a real
      type(dataset_layout_type), intent(inout) :: room

      integer, parameter :: others = 3
      integer :: runs(1)
      real(wp), allocatable :: told(:)

      if (comm%is_root()) runs(1) = size(room%start)
      call comm%broadcast(runs)
      allocate (told(others + runs(1)))
      if (comm%is_root()) told(:) = [real(wp) :: room%row_bytes, room%rows_per_run, room%before, &
         & room%start]
      call comm%broadcast(told)
      if (comm%is_root()) return
      room%row_bytes = nint(told(1), int64)
      room%rows_per_run = nint(told(2), int64)
      room%before = nint(told(3), int64)
      room%start = nint(told(others + 1:), int64)
   end subroutine tell_room

   !> Whether all went well on all ranks that write the file
   subroutine agree(self, good)
      class(hdf5_file_type), intent(in) :: self
      !> Whether it did on this rank in, the same on all ranks out
      logical, intent(inout) :: good

      call self%comm%all_true(good)
   end subroutine agree

   !> Make sure of room for numbers, and for what the library adds
   subroutine reserve(self, bytes, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Bytes of the numbers of all ranks
      integer(int64), intent(in) :: bytes
      !> The disk is full
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      good = self%opened
      if (good .and. self%is_root()) good = has_room(self%path, bytes + overhead)
      call self%confirm(good, "what is to come", error)
   end subroutine reserve

   !> Give the file another name, in place of a file that has it
   subroutine rename(self, path, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Its new path, on the same disk
      character(*), intent(in) :: path
      !> Why it keeps its name
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      good = .true.
      if (self%is_root()) call rename_file(self%path, path, good)
      call self%comm%all_true(good)
      if (good) then
         self%path = path
      else
         call fail(error, exit_output, "cannot rename "//self%path//" to "//path)
      end if
   end subroutine rename

   !> Make a group
   subroutine make_group(self, name, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Path of the group in the file; the groups above it must exist
      character(*), intent(in) :: name
      !> Why it could not be made
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      good = .true.
      if (self%is_root()) call create_group(self%handle, name, good)
      call self%confirm(good, name, error)
   end subroutine make_group

   !> Attribute of text, of exactly its length; trailing blanks are left out
   subroutine write_text(self, place, name, value, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Path of the group or dataset that gets the attribute
      character(*), intent(in) :: place
      !> Name of the attribute
      character(*), intent(in) :: name
      !> Its value
      character(*), intent(in) :: value
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      good = .true.
      if (self%is_root()) then
         ! the library has no text without length: a single null reads as none
         if (len_trim(value) > 0) then
            call write_text_attribute(self%handle, place, name, trim(value), good)
         else
            call write_text_attribute(self%handle, place, name, achar(0), good)
         end if
      end if
      call self%confirm(good, place//"/"//name, error)
   end subroutine write_text

   !> Attribute of one integer
   subroutine write_integer(self, place, name, value, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Path of the group or dataset that gets the attribute
      character(*), intent(in) :: place
      !> Name of the attribute
      character(*), intent(in) :: name
      !> Its value
      integer, intent(in), target :: value
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      good = .true.
      if (self%is_root()) call write_attribute(self%handle, place, name, &
         & numbers_type(c_loc(value), [integer ::], is_integer, store_long), good)
      call self%confirm(good, place//"/"//name, error)
   end subroutine write_integer

   !> Attribute of several integers
   subroutine write_integers(self, place, name, value, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Path of the group or dataset that gets the attribute
      character(*), intent(in) :: place
      !> Name of the attribute
      character(*), intent(in) :: name
      !> Its value
      integer, intent(in), target, contiguous :: value(:)
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      good = .true.
      if (self%is_root()) call write_attribute(self%handle, place, name, &
         & numbers_type(c_loc(value), shape(value), is_integer, store_long), good)
      call self%confirm(good, place//"/"//name, error)
   end subroutine write_integers

   !> Attribute of one real
   subroutine write_real(self, place, name, value, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Path of the group or dataset that gets the attribute
      character(*), intent(in) :: place
      !> Name of the attribute
      character(*), intent(in) :: name
      !> Its value
      real(wp), intent(in), target :: value
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      good = .true.
      if (self%is_root()) call write_attribute(self%handle, place, name, &
         & numbers_type(c_loc(value), [integer ::], is_real, store_double), good)
      call self%confirm(good, place//"/"//name, error)
   end subroutine write_real

   !> Hand all that was written to the operating system: it outlives a kill of this process
   subroutine flush_all(self, error)
      class(hdf5_file_type), intent(inout) :: self
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      good = .true.
      if (.not. self%is_alone()) then
         ! first the numbers, of which the root then says that they are there
         call self%bands%secure(good)
         call self%comm%all_true(good)
      end if
      if (good .and. self%is_root()) call flush_file(self%handle, good)
      call self%confirm(good, "what is not yet on the disk", error)
   end subroutine flush_all

   !> Write what is left and close the file; nothing happens when it is not open
   subroutine close_whole(self, error)
      class(hdf5_file_type), intent(inout) :: self
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good, is_closed

      if (.not. self%opened) return
      self%opened = .false.
      call self%bands%close(good)
      is_closed = .true.
      if (self%is_root()) call close_file(self%handle, is_closed)
      good = good .and. is_closed
      call self%confirm(good, "what is not yet on the disk", error)
   end subroutine close_whole

   !> Turn what went wrong on any rank into an error
   !>
   !> From then on the file is left alone, as closing it would spoil what was flushed before.
   subroutine confirm(self, good, quantity, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> True when all went well
      logical, intent(in) :: good
      !> What was to be written
      character(*), intent(in) :: quantity
      !> The error, when there is one
      type(error_type), allocatable, intent(out) :: error

      logical :: all_good

      all_good = good
      call self%comm%all_true(all_good)
      if (all_good) return
      self%opened = .false.
      self%handle = handle_type()
      call fail(error, exit_output, "cannot write "//quantity//" to "//self%path &
         & //": its disk must have room and be writable, and no other run the same job")
   end subroutine confirm

end module plydyn_io_hdf5_file
