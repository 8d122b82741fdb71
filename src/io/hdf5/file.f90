!> A file of HDF5 being written by the root: its life, its groups, and the attributes of what is in
!> it. `plydyn_io_hdf5_output` adds the datasets, `plydyn_io_hdf5_input` reads; only they use the
!> library besides.
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
   use, intrinsic :: iso_c_binding, only : c_int, c_int64_t, c_loc
   use hdf5, only : h5_integer_kind, h5aclose_f, h5acreate_f, h5aexists_f, h5aopen_f, h5awrite_f, &
      & h5dont_atexit_f, h5eset_auto_f, h5f_acc_trunc_f, h5f_close_strong_f, h5f_libver_latest_f, &
      & h5f_scope_global_f, h5fclose_f, h5fcreate_f, h5fflush_f, h5gclose_f, h5gcreate_f, &
      & h5kind_to_type, h5oclose_f, h5oopen_f, h5open_f, h5p_file_access_f, h5p_file_create_f, &
      & h5p_group_create_f, h5pclose_f, h5pcreate_f, h5pset_fclose_degree_f, &
      & h5pset_file_locking_f, h5pset_istore_k_f, h5pset_obj_track_times_f, h5s_scalar_f, &
      & h5sclose_f, h5screate_f, h5screate_simple_f, h5t_native_character, h5t_std_i64le, &
      & h5t_str_nullpad_f, h5tclose_f, h5tcopy_f, h5tset_size_f, h5tset_strpad_f, hid_t, hsize_t, &
      & size_t
   use plydyn_base_error, only : error_type, exit_output, fail
   use plydyn_base_files, only : rename_file, secure_file
   use plydyn_io_csv_text_file, only : try_text
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   public :: prepare_access

   !> Half the entries in a node of the index of chunks: a dataset of up to twice as many chunks
   !> has one node, which a kill in the midst of a flush cannot leave half split
   integer, parameter :: half_index = 256

   !> A file being written
   type, public :: hdf5_file_type
      !> Path of the file
      character(:), allocatable :: path
      !> The ranks that write it; for extensions
      type(comm_type) :: comm
      !> Its handle in the library, of the root; for extensions
      integer(hid_t) :: id = -1_hid_t
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
      procedure :: write_numbers
      procedure :: flush => flush_whole
      procedure :: secure
      procedure :: rename
      procedure :: close => close_whole
      procedure :: writes
      procedure :: note
      procedure, private :: confirm
   end type hdf5_file_type

   interface
      !> Formats of what is made from now on, which HDF5 1.10 sets of an open file in C only
      integer(c_int) function c_set_format(file, lowest, highest) &
         & bind(c, name="H5Fset_libver_bounds")
         import :: c_int, c_int64_t
         implicit none
         integer(c_int64_t), value :: file
         integer(c_int), value :: lowest, highest
      end function c_set_format
   end interface

contains

   !> Create the file, in place of one that was there
   subroutine create(self, path, comm, error, is_checked)
      class(hdf5_file_type), intent(inout) :: self
      !> Path of the file; its folder must exist
      character(*), intent(in) :: path
      !> The ranks that write it together
      type(comm_type), intent(in) :: comm
      !> Why the file could not be created
      type(error_type), allocatable, intent(out) :: error
      !> Whether metadata and datasets get check sums
      logical, intent(in), optional :: is_checked

      self%path = trim(path)
      self%comm = comm
      self%is_checked = .false.
      if (present(is_checked)) self%is_checked = is_checked
      if (allocated(self%failed)) deallocate (self%failed)
      if (comm%is_root()) call try_text(self%path, error)
      call comm%broadcast(error)
      if (allocated(error)) return
      self%opened = .true.
      if (comm%is_root()) call create_empty(self)
      call self%confirm(error)
   end subroutine create

   !> Create a file without groups. Metadata have check sums in the latest format; in the earliest a
   !> file opens again with all that was flushed before a kill
   subroutine create_empty(self)
      class(hdf5_file_type), intent(inout) :: self

      integer(hid_t) :: access, creation
      integer :: status(6)
      logical :: good

      call prepare_access(access, good)
      call h5pcreate_f(h5p_file_create_f, creation, status(1))
      call h5pset_istore_k_f(creation, half_index, status(2))
      call h5fcreate_f(self%path, h5f_acc_trunc_f, self%id, status(3), creation, access)
      call h5pclose_f(creation, status(4))
      call h5pclose_f(access, status(5))
      status(6) = 0
      ! not from the start: HDF5 1.10 would put the time of day into the top group
      if (self%is_checked) then
         status(6) = c_set_format(self%id, h5f_libver_latest_f, h5f_libver_latest_f)
      end if
      call self%note(good .and. all(status >= 0), "the file")
   end subroutine create_empty

   !> Start the library, and prepare the opening of a file
   subroutine prepare_access(access, good)
      !> Handle of the access
      integer(hid_t), intent(out) :: access
      !> True when all went well
      logical, intent(out) :: good

      integer :: status(6)

      ! at its end the program must not flush files whose disk has failed: HDF5 would crash; this is
      ! refused when it is asked for again, which does not matter
      call h5dont_atexit_f(status(1))
      call h5open_f(status(2))
      call h5eset_auto_f(0, status(3))
      call h5pcreate_f(h5p_file_access_f, access, status(4))
      call h5pset_fclose_degree_f(access, h5f_close_strong_f, status(5))
      ! a running job can be looked at
      call h5pset_file_locking_f(access, .false., .true., status(6))
      good = all(status(2:) >= 0)
   end subroutine prepare_access

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
      class(hdf5_file_type), intent(inout) :: self
      !> Path of the group in the file; the groups above it must exist
      character(*), intent(in) :: name

      integer(hid_t) :: creation, group
      integer :: status(5)

      if (.not. self%writes()) return
      call h5pcreate_f(h5p_group_create_f, creation, status(1))
      call h5pset_obj_track_times_f(creation, .false., status(2))
      call h5gcreate_f(self%id, name, group, status(3), gcpl_id=creation)
      call h5gclose_f(group, status(4))
      call h5pclose_f(creation, status(5))
      call self%note(all(status >= 0), name)
   end subroutine make_group

   !> Attribute of text, of exactly its length; trailing blanks are left out
   subroutine write_text(self, place, name, value)
      class(hdf5_file_type), intent(inout) :: self
      !> Path of the group or dataset that gets the attribute, and name of the attribute
      character(*), intent(in) :: place, name
      !> Its value
      character(*), intent(in) :: value

      character(:), allocatable, target :: bytes
      integer(hid_t) :: string, space, object, attribute
      integer :: status(11)

      if (.not. self%writes()) return
      bytes = trim(value)
      ! the library has no text without length: a single null reads as none
      if (len(bytes) == 0) bytes = achar(0)
      call h5tcopy_f(h5t_native_character, string, status(1))
      call h5tset_size_f(string, int(len(bytes), size_t), status(2))
      call h5tset_strpad_f(string, h5t_str_nullpad_f, status(3))
      call h5screate_f(h5s_scalar_f, space, status(4))
      call h5oopen_f(self%id, place, object, status(5))
      call h5acreate_f(object, name, string, space, attribute, status(6))
      call h5awrite_f(attribute, string, c_loc(bytes), status(7))
      call h5aclose_f(attribute, status(8))
      call h5oclose_f(object, status(9))
      call h5sclose_f(space, status(10))
      call h5tclose_f(string, status(11))
      call self%note(all(status >= 0), place//"/"//name)
   end subroutine write_text

   !> Attribute of integers, stored as long ones: in place when it is there, with the same shape,
   !> else created
   subroutine write_numbers(self, place, name, values)
      class(hdf5_file_type), intent(inout) :: self
      !> Path of the group or dataset that gets the attribute, and its name
      character(*), intent(in) :: place, name
      !> Its values; one of them is a number, not a list
      integer, intent(in), target, contiguous :: values(:)

      integer(hid_t) :: object, attribute, space
      integer :: status(8)
      logical :: exists

      if (.not. self%writes()) return
      status(:) = 0
      call h5oopen_f(self%id, place, object, status(1))
      call h5aexists_f(object, name, exists, status(2))
      if (exists) then
         call h5aopen_f(object, name, attribute, status(3))
      else
         if (size(values) == 1) then
            call h5screate_f(h5s_scalar_f, space, status(3))
         else
            call h5screate_simple_f(1, shape(values, hsize_t), space, status(3))
         end if
         call h5acreate_f(object, name, h5t_std_i64le, space, attribute, status(4))
         call h5sclose_f(space, status(5))
      end if
      call h5awrite_f(attribute, h5kind_to_type(kind(0), h5_integer_kind), c_loc(values), status(6))
      call h5aclose_f(attribute, status(7))
      call h5oclose_f(object, status(8))
      call self%note(all(status >= 0), place//"/"//name)
   end subroutine write_numbers

   !> Hand all that was written to the operating system: it outlives a kill of this process
   subroutine flush_whole(self, error)
      class(hdf5_file_type), intent(inout) :: self
      !> What could not be written since the last time
      type(error_type), allocatable, intent(out) :: error

      integer :: status

      if (self%writes()) then
         call h5fflush_f(self%id, h5f_scope_global_f, status)
         call self%note(status >= 0, "what is not yet on the disk")
      end if
      call self%confirm(error)
   end subroutine flush_whole

   !> Wait until all that was written is on the disk
   subroutine secure(self, error)
      class(hdf5_file_type), intent(inout) :: self
      !> Why it is not
      type(error_type), allocatable, intent(out) :: error

      if (self%comm%is_root()) call secure_file(self%path, error)
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

      integer :: status

      if (.not. self%opened) return
      if (self%writes()) then
         call h5fclose_f(self%id, status)
         call self%note(status >= 0, "what is not yet on the disk")
      end if
      call self%confirm(error)
      self%opened = .false.
   end subroutine close_whole

end module plydyn_io_hdf5_file
