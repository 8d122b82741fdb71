!> Calls of HDF5 that write, bundled; `plydyn_output_h5_input` has those that read. No other module
!> uses the library's interface.
!>
!> Each procedure makes one thing in a file and says whether every call went well; the module
!> `plydyn_output_h5` turns that into errors. Numbers come as an address, the kind of number that
!> lies there, and how it is stored. Extents are in Fortran's order.
module plydyn_output_h5_raw
   use, intrinsic :: iso_c_binding, only : c_loc, c_ptr
   use, intrinsic :: iso_fortran_env, only : int64
   use hdf5, only : h5_integer_kind, h5_real_kind, h5aclose_f, h5acreate_f, h5aexists_f, &
      & h5aopen_f, h5awrite_f, h5dclose_f, h5dcreate_f, h5dget_space_f, h5dont_atexit_f, &
      & h5dopen_f, h5dset_extent_f, h5dwrite_f, h5eset_auto_f, h5f_acc_trunc_f, &
      & h5f_close_strong_f, h5f_scope_global_f, h5fclose_f, h5fcreate_f, h5fflush_f, h5gclose_f, &
      & h5gcreate_f, h5kind_to_type, h5oclose_f, h5oopen_f, h5open_f, h5p_dataset_create_f, &
      & h5p_file_access_f, h5p_file_create_f, h5pclose_f, h5pcreate_f, h5pset_chunk_f, &
      & h5pset_fclose_degree_f, h5pset_file_locking_f, h5pset_istore_k_f, &
      & h5pset_obj_track_times_f, h5s_scalar_f, h5s_select_set_f, h5s_unlimited_f, h5sclose_f, &
      & h5screate_f, h5screate_simple_f, h5sget_simple_extent_dims_f, &
      & h5sget_simple_extent_ndims_f, h5sselect_hyperslab_f, h5t_ieee_f32le, h5t_ieee_f64le, &
      & h5t_native_character, h5t_std_i32le, h5t_std_i64le, h5t_std_u8le, h5t_str_nullpad_f, &
      & h5tclose_f, h5tcopy_f, h5tset_size_f, h5tset_strpad_f, hid_t, hsize_t, size_t
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: create_file, flush_file, close_file, create_group, write_text_attribute, &
      & write_attribute, write_dataset, create_series, append_rows
   public :: hid_t, type_in_memory

   !> Kinds of number in memory: default integers, long integers, reals of the working precision
   integer, parameter, public :: is_integer = 1, is_long = 2, is_real = 3
   !> Ways to store a number in the file, whatever it is in memory
   integer, parameter, public :: store_byte = 1, store_integer = 2, store_long = 3, &
      & store_single = 4, store_double = 5

   !> Half the entries in a node of the index of chunks: a dataset of up to twice as many chunks
   !> has one node, which a kill in the midst of a flush cannot leave half split
   integer, parameter :: half_index = 256

   !> Numbers in memory, and how they are stored
   type, public :: numbers_type
      !> Where they are
      type(c_ptr) :: address
      !> Extent of the array; of no size for a single number
      integer, allocatable :: extent(:)
      !> `is_integer`, `is_long` or `is_real`
      integer :: number = is_real
      !> One of `store_…`
      integer :: storage = store_double
   end type numbers_type

contains

   !> Create a file, in place of one that was there
   subroutine create_file(path, id, good)
      !> Path of the file
      character(*), intent(in) :: path
      !> Handle of the file
      integer(hid_t), intent(out) :: id
      !> True when all went well
      logical, intent(out) :: good

      integer(hid_t) :: access, creation
      integer :: status(10)

      ! at the program's end the library is not to tidy up: after a failure it would crash, and
      ! whoever wants a file whole closes it; asked a second time it refuses, which is as well
      call h5dont_atexit_f(status(1))
      call h5open_f(status(1))
      call h5eset_auto_f(0, status(2))
      call h5pcreate_f(h5p_file_access_f, access, status(3))
      call h5pset_fclose_degree_f(access, h5f_close_strong_f, status(4))
      call h5pset_file_locking_f(access, .false., .true., status(5))
      call h5pcreate_f(h5p_file_create_f, creation, status(6))
      call h5pset_istore_k_f(creation, half_index, status(7))
      call h5fcreate_f(path, h5f_acc_trunc_f, id, status(8), creation, access)
      call h5pclose_f(creation, status(9))
      call h5pclose_f(access, status(10))
      good = all(status >= 0)
   end subroutine create_file

   !> Hand all that was written to the operating system: it outlives this process
   subroutine flush_file(id, good)
      !> Handle of the file
      integer(hid_t), intent(in) :: id
      !> True when all went well
      logical, intent(out) :: good

      integer :: status

      call h5fflush_f(id, h5f_scope_global_f, status)
      good = status >= 0
   end subroutine flush_file

   !> Close a file and all that is open in it
   subroutine close_file(id, good)
      !> Handle of the file
      integer(hid_t), intent(in) :: id
      !> True when all went well
      logical, intent(out) :: good

      integer :: status

      call h5fclose_f(id, status)
      good = status >= 0
   end subroutine close_file

   !> Create a group
   subroutine create_group(id, name, good)
      !> Handle of the file
      integer(hid_t), intent(in) :: id
      !> Path of the group in the file
      character(*), intent(in) :: name
      !> True when all went well
      logical, intent(out) :: good

      integer(hid_t) :: group
      integer :: status(2)

      call h5gcreate_f(id, name, group, status(1))
      call h5gclose_f(group, status(2))
      good = all(status >= 0)
   end subroutine create_group

   !> Write an attribute of text, of exactly its length
   subroutine write_text_attribute(id, place, name, value, good)
      !> Handle of the file
      integer(hid_t), intent(in) :: id
      !> Path of the group or dataset that gets the attribute
      character(*), intent(in) :: place
      !> Name of the attribute
      character(*), intent(in) :: name
      !> Its value, of at least one character
      character(*), intent(in), target :: value
      !> True when all went well
      logical, intent(out) :: good

      integer(hid_t) :: string, space, object, attribute
      integer :: status(11)

      call h5tcopy_f(h5t_native_character, string, status(1))
      call h5tset_size_f(string, int(len(value), size_t), status(2))
      call h5tset_strpad_f(string, h5t_str_nullpad_f, status(3))
      call h5screate_f(h5s_scalar_f, space, status(4))
      call h5oopen_f(id, place, object, status(5))
      call h5acreate_f(object, name, string, space, attribute, status(6))
      call h5awrite_f(attribute, string, c_loc(value), status(7))
      call h5aclose_f(attribute, status(8))
      call h5oclose_f(object, status(9))
      call h5sclose_f(space, status(10))
      call h5tclose_f(string, status(11))
      good = all(status >= 0)
   end subroutine write_text_attribute

   !> Write an attribute of numbers: in place when it is there, else create it
   subroutine write_attribute(id, place, name, numbers, good)
      !> Handle of the file
      integer(hid_t), intent(in) :: id
      !> Path of the group or dataset that gets the attribute
      character(*), intent(in) :: place
      !> Name of the attribute
      character(*), intent(in) :: name
      !> Its value
      type(numbers_type), intent(in) :: numbers
      !> True when all went well
      logical, intent(out) :: good

      integer(hid_t) :: object, attribute, space
      integer :: status(8)
      logical :: exists

      status(:) = 0
      call h5oopen_f(id, place, object, status(1))
      call h5aexists_f(object, name, exists, status(2))
      if (exists) then
         call h5aopen_f(object, name, attribute, status(3))
      else
         call create_space(numbers%extent, space, status(3))
         call h5acreate_f(object, name, type_in_file(numbers%storage), space, attribute, status(4))
         call h5sclose_f(space, status(5))
      end if
      call h5awrite_f(attribute, type_in_memory(numbers%number), numbers%address, status(6))
      call h5aclose_f(attribute, status(7))
      call h5oclose_f(object, status(8))
      good = all(status >= 0)
   end subroutine write_attribute

   !> Create a dataset and write all of it
   subroutine write_dataset(id, name, numbers, good)
      !> Handle of the file
      integer(hid_t), intent(in) :: id
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      type(numbers_type), intent(in) :: numbers
      !> True when all went well
      logical, intent(out) :: good

      integer(hid_t) :: dataset, plan, space
      integer :: status(7)

      status(:) = 0
      call create_plan(plan, status(1))
      call create_space(numbers%extent, space, status(2))
      call h5dcreate_f(id, name, type_in_file(numbers%storage), space, dataset, status(3), plan)
      if (product(numbers%extent) > 0) then
         call h5dwrite_f(dataset, type_in_memory(numbers%number), numbers%address, status(4))
      end if
      call h5dclose_f(dataset, status(5))
      call h5sclose_f(space, status(6))
      call h5pclose_f(plan, status(7))
      good = all(status >= 0)
   end subroutine write_dataset

   !> Create a dataset of no rows that can grow
   subroutine create_series(id, name, width, rows_per_chunk, storage, good)
      !> Handle of the file
      integer(hid_t), intent(in) :: id
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> Numbers in a row; 0 for a list of numbers
      integer, intent(in) :: width
      !> Rows that lie together in the file
      integer, intent(in) :: rows_per_chunk
      !> One of `store_…`
      integer, intent(in) :: storage
      !> True when all went well
      logical, intent(out) :: good

      integer(hsize_t) :: chunk(2), none(2), most(2)
      integer(hid_t) :: dataset, plan, space
      integer :: status(7), rank, first

      ! a list has the second extent only
      rank = merge(2, 1, width > 0)
      first = 3 - rank
      chunk(:) = int([width, rows_per_chunk], hsize_t)
      none(:) = [chunk(1), 0_hsize_t]
      most(:) = [chunk(1), h5s_unlimited_f]
      call create_plan(plan, status(1))
      call h5pset_chunk_f(plan, rank, chunk(first:), status(2))
      call h5screate_simple_f(rank, none(first:), space, status(3), most(first:))
      call h5dcreate_f(id, name, type_in_file(storage), space, dataset, status(4), plan)
      call h5dclose_f(dataset, status(5))
      call h5sclose_f(space, status(6))
      call h5pclose_f(plan, status(7))
      good = all(status >= 0)
   end subroutine create_series

   !> Add rows at the end of a dataset that can grow; its storage is as it was created
   subroutine append_rows(id, name, numbers, good)
      !> Handle of the file
      integer(hid_t), intent(in) :: id
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to add: whole rows
      type(numbers_type), intent(in) :: numbers
      !> True when all went well
      logical, intent(out) :: good

      integer(hsize_t) :: start(2), rows(2)
      integer(hid_t) :: dataset, memory_space, file_space
      integer :: status(9), rank

      call h5dopen_f(id, name, dataset, status(1))
      call grow(dataset, numbers%extent, rank, start, rows, status(2))
      call h5screate_simple_f(rank, rows, memory_space, status(3))
      call h5dget_space_f(dataset, file_space, status(4))
      call h5sselect_hyperslab_f(file_space, h5s_select_set_f, start, rows, status(5))
      call h5dwrite_f(dataset, type_in_memory(numbers%number), numbers%address, status(6), &
         & memory_space, file_space)
      call h5sclose_f(file_space, status(7))
      call h5sclose_f(memory_space, status(8))
      call h5dclose_f(dataset, status(9))
      good = all(status >= 0)
   end subroutine append_rows

   !> Make room at the end of a dataset
   subroutine grow(dataset, added, rank, start, rows, status)
      !> Handle of the dataset
      integer(hid_t), intent(in) :: dataset
      !> Extent of the numbers to add: a table of the dataset's width, or a list to fill whole rows
      integer, intent(in) :: added(:)
      !> Rank of the dataset, 1 or 2
      integer, intent(out) :: rank
      !> Where the room starts
      integer(hsize_t), intent(out) :: start(2)
      !> Extent of the room
      integer(hsize_t), intent(out) :: rows(2)
      !> Negative when the numbers do not fit or a call failed
      integer, intent(out) :: status

      integer(hsize_t) :: most(2)
      integer(hid_t) :: space
      integer :: calls(5)

      status = -1
      start(:) = 0
      rows(:) = 0
      call h5dget_space_f(dataset, space, calls(1))
      call h5sget_simple_extent_ndims_f(space, rank, calls(2))
      if (rank < 1 .or. rank > 2) return
      call h5sget_simple_extent_dims_f(space, rows, most, calls(3))
      call h5sclose_f(space, calls(4))
      if (size(added) == 2 .and. added(1) /= rows(1)) return
      start(rank) = rows(rank)
      rows(rank) = product(added)/product(rows(:rank - 1))
      if (product(rows(:rank)) /= product(added)) return
      ! the whole extent: the width of before, and the rows of before with those added
      most(:) = rows
      most(rank) = most(rank) + start(rank)
      call h5dset_extent_f(dataset, most, calls(5))
      status = minval(calls)
   end subroutine grow

   !> Space of an attribute or dataset of fixed extent
   subroutine create_space(extent, space, status)
      !> Extent of the array; of no size for a single number
      integer, intent(in) :: extent(:)
      !> Handle of the space
      integer(hid_t), intent(out) :: space
      !> Negative when it went wrong
      integer, intent(out) :: status

      if (size(extent) == 0) then
         call h5screate_f(h5s_scalar_f, space, status)
      else
         call h5screate_simple_f(size(extent), int(extent, hsize_t), space, status)
      end if
   end subroutine create_space

   !> Creation of a dataset without the time of day, so that the same run makes the same file
   subroutine create_plan(plan, status)
      !> Handle of the creation
      integer(hid_t), intent(out) :: plan
      !> Negative when it went wrong
      integer, intent(out) :: status

      integer :: calls(2)

      call h5pcreate_f(h5p_dataset_create_f, plan, calls(1))
      call h5pset_obj_track_times_f(plan, .false., calls(2))
      status = minval(calls)
   end subroutine create_plan

   !> The library's type of numbers in memory
   integer(hid_t) function type_in_memory(number)
      !> `is_integer`, `is_long` or `is_real`
      integer, intent(in) :: number

      select case (number)
      case (is_integer)
         type_in_memory = h5kind_to_type(kind(0), h5_integer_kind)
      case (is_long)
         type_in_memory = h5kind_to_type(int64, h5_integer_kind)
      case default
         type_in_memory = h5kind_to_type(wp, h5_real_kind)
      end select
   end function type_in_memory

   !> The library's type of numbers in the file
   integer(hid_t) function type_in_file(storage)
      !> One of `store_…`
      integer, intent(in) :: storage

      select case (storage)
      case (store_byte)
         type_in_file = h5t_std_u8le
      case (store_integer)
         type_in_file = h5t_std_i32le
      case (store_long)
         type_in_file = h5t_std_i64le
      case (store_single)
         type_in_file = h5t_ieee_f32le
      case default
         type_in_file = h5t_ieee_f64le
      end select
   end function type_in_file

end module plydyn_output_h5_raw
