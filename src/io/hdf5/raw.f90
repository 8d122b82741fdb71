!> Calls of HDF5 that write what is in a file, bundled; `plydyn_io_hdf5_raw_series` has those for
!> datasets that grow, `plydyn_io_hdf5_raw_file` those for the file itself,
!> `plydyn_io_hdf5_input` those that read. No other module uses the library.
!>
!> Each procedure makes one thing in a file and says whether every call went well; the module
!> `plydyn_io_hdf5_output` turns that into errors. Numbers come as an address, the kind of number
!> that lies there, and how it is stored. Extents are in Fortran's order. Room in the file is taken
!> when a thing is made, and never filled in advance: others than the library may write there.
module plydyn_io_hdf5_raw
   use, intrinsic :: iso_c_binding, only : c_loc
   use, intrinsic :: iso_fortran_env, only : int64
   use hdf5, only : h5_integer_kind, h5_real_kind, h5aclose_f, h5acreate_f, h5aexists_f, &
      & h5aopen_f, h5awrite_f, h5d_alloc_time_early_f, h5d_fill_time_never_f, h5dclose_f, &
      & h5dcreate_f, h5dget_offset_f, h5dwrite_f, h5gclose_f, h5gcreate_f, h5kind_to_type, &
      & h5oclose_f, h5oopen_f, h5p_dataset_create_f, h5pclose_f, h5pcreate_f, &
      & h5pset_alloc_time_f, h5pset_fill_time_f, h5pset_obj_track_times_f, h5s_scalar_f, &
      & h5s_select_set_f, h5sclose_f, h5screate_f, h5screate_simple_f, &
      & h5sget_simple_extent_dims_f, h5sget_simple_extent_ndims_f, h5sselect_hyperslab_f, &
      & h5sselect_none_f, h5t_ieee_f32le, h5t_ieee_f64le, h5t_native_character, h5t_std_i32le, &
      & h5t_std_i64le, h5t_std_u8le, h5t_str_nullpad_f, h5tclose_f, h5tcopy_f, h5tset_size_f, &
      & h5tset_strpad_f, hid_t, hsize_t, size_t
   use plydyn_base_precision, only : wp
   use plydyn_io_hdf5_numbers, only : bytes_of, is_byte, is_integer, is_long, numbers_type, &
      & dataset_layout_type, hyperslab_type, store_byte, store_integer, store_long, store_single
   use plydyn_io_hdf5_raw_file, only : handle_type
   implicit none
   private

   public :: create_group, write_text_attribute, write_attribute, write_dataset, make_dataset
   public :: create_plan, select_slab, type_in_file, type_in_memory

contains

   !> Create a group
   subroutine create_group(file, name, good)
      !> The file
      type(handle_type), intent(in) :: file
      !> Path of the group in the file
      character(*), intent(in) :: name
      !> True when all went well
      logical, intent(out) :: good

      integer(hid_t) :: group
      integer :: status(2)

      call h5gcreate_f(file%id, name, group, status(1))
      call h5gclose_f(group, status(2))
      good = all(status >= 0)
   end subroutine create_group

   !> Write an attribute of text, of exactly its length
   subroutine write_text_attribute(file, place, name, value, good)
      !> The file
      type(handle_type), intent(in) :: file
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
      call h5oopen_f(file%id, place, object, status(5))
      call h5acreate_f(object, name, string, space, attribute, status(6))
      call h5awrite_f(attribute, string, c_loc(value), status(7))
      call h5aclose_f(attribute, status(8))
      call h5oclose_f(object, status(9))
      call h5sclose_f(space, status(10))
      call h5tclose_f(string, status(11))
      good = all(status >= 0)
   end subroutine write_text_attribute

   !> Write an attribute of numbers: in place when it is there, else create it
   subroutine write_attribute(file, place, name, numbers, good)
      !> The file
      type(handle_type), intent(in) :: file
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
      call h5oopen_f(file%id, place, object, status(1))
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
   subroutine write_dataset(file, name, numbers, good)
      !> The file
      type(handle_type), intent(in) :: file
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      type(numbers_type), intent(in) :: numbers
      !> True when all went well
      logical, intent(out) :: good

      integer(hid_t) :: dataset
      integer :: status(3)

      call create_dataset(file, name, numbers%extent, numbers%storage, dataset, status(1))
      status(2) = 0
      if (all(numbers%extent > 0)) call h5dwrite_f(dataset, type_in_memory(numbers%number), &
         & numbers%address, status(2))
      call h5dclose_f(dataset, status(3))
      good = all(status >= 0)
   end subroutine write_dataset

   !> Create a dataset whose numbers are brought by others
   subroutine make_dataset(file, name, extent, storage, room, good)
      !> The file
      type(handle_type), intent(in) :: file
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> Its extent, and how it is stored
      integer, intent(in) :: extent(:), storage
      !> Where its rows lie
      type(dataset_layout_type), intent(out) :: room
      !> True when all went well
      logical, intent(out) :: good

      integer(hid_t) :: dataset
      integer(int64) :: first
      integer :: status(3)

      call create_dataset(file, name, extent, storage, dataset, status(1))
      first = 0
      status(2) = 0
      if (all(extent > 0)) call h5dget_offset_f(dataset, first, status(2))
      call h5dclose_f(dataset, status(3))
      good = all(status >= 0)
      room = dataset_layout_type(row_bytes=bytes_of(storage)*product(extent(:size(extent) - 1)), &
         & start=[first])
   end subroutine make_dataset

   !> Create a dataset
   subroutine create_dataset(file, name, extent, storage, dataset, status)
      type(handle_type), intent(in) :: file
      character(*), intent(in) :: name
      integer, intent(in) :: extent(:), storage
      !> Its handle
      integer(hid_t), intent(out) :: dataset
      !> Negative when it went wrong
      integer, intent(out) :: status

      integer(hid_t) :: plan, space
      integer :: calls(5)

      call create_plan(plan, calls(1))
      call create_space(extent, space, calls(2))
      call h5dcreate_f(file%id, name, type_in_file(storage), space, dataset, calls(3), plan)
      call h5sclose_f(space, calls(4))
      call h5pclose_f(plan, calls(5))
      status = minval(calls)
   end subroutine create_dataset

   !> Select a slab in the space of a dataset, and make the space in memory for it
   subroutine select_slab(space, before, slab, memory, status)
      !> Handle of the space of the dataset, a list or a table
      integer(hid_t), intent(in) :: space
      !> Rows of the dataset before all levels
      integer(hsize_t), intent(in) :: before
      !> The slab
      type(hyperslab_type), intent(in) :: slab
      !> Handle of the space in memory
      integer(hid_t), intent(out) :: memory
      !> Negative when the dataset is neither or a call failed
      integer, intent(out) :: status

      integer(hsize_t) :: block(2), count(2), most(2), start(2), stride(2)
      integer :: calls(5), rank

      status = -1
      calls(:) = 0
      call h5sget_simple_extent_ndims_f(space, rank, calls(1))
      if (rank < 1 .or. rank > 2) return
      call h5sget_simple_extent_dims_f(space, block, most, calls(2))
      start(:) = 0
      stride(:) = 1
      count(:) = 1
      start(rank) = before + slab%first
      stride(rank) = slab%whole
      count(rank) = slab%levels
      block(rank) = slab%count*count(rank)
      call h5screate_simple_f(rank, block, memory, calls(3))
      block(rank) = slab%count
      if (slab%count > 0) then
         call h5sselect_hyperslab_f(space, h5s_select_set_f, start, count, calls(4), stride, block)
      else
         call h5sselect_none_f(space, calls(4))
         call h5sselect_none_f(memory, calls(5))
      end if
      status = minval(calls)
   end subroutine select_slab

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

   !> Creation of a dataset without the time of day, so that the same run makes the same file, and
   !> with its room at once, as several ranks need it
   subroutine create_plan(plan, status)
      !> Handle of the creation
      integer(hid_t), intent(out) :: plan
      !> Negative when it went wrong
      integer, intent(out) :: status

      integer :: calls(4)

      call h5pcreate_f(h5p_dataset_create_f, plan, calls(1))
      call h5pset_obj_track_times_f(plan, .false., calls(2))
      call h5pset_alloc_time_f(plan, h5d_alloc_time_early_f, calls(3))
      call h5pset_fill_time_f(plan, h5d_fill_time_never_f, calls(4))
      status = minval(calls)
   end subroutine create_plan

   !> The library's type of numbers in memory
   integer(hid_t) function type_in_memory(number)
      !> One of `is_…`
      integer, intent(in) :: number

      select case (number)
      case (is_byte)
         type_in_memory = h5t_std_u8le
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

end module plydyn_io_hdf5_raw
