!> Calls of HDF5 that make datasets and write rows of them.
!>
!> Each procedure says whether every call went well. Numbers come as an address, the kind of number
!> that lies there, and how it is stored. Extents are in Fortran's order.
module plydyn_io_hdf5_raw
   use, intrinsic :: iso_c_binding, only : c_ptr
   use, intrinsic :: iso_fortran_env, only : int64
   use hdf5, only : h5_integer_kind, h5_real_kind, h5d_fill_time_never_f, h5dclose_f, h5dcreate_f, &
      & h5dget_space_f, h5dset_extent_f, h5dwrite_f, h5kind_to_type, &
      & h5p_dataset_create_f, h5pclose_f, h5pcreate_f, h5pset_chunk_f, h5pset_fill_time_f, &
      & h5pset_fletcher32_f, h5pset_obj_track_times_f, h5s_select_set_f, h5s_unlimited_f, &
      & h5sclose_f, h5screate_simple_f, h5sget_simple_extent_dims_f, h5sget_simple_extent_ndims_f, &
      & h5sselect_hyperslab_f, h5t_ieee_f32le, h5t_ieee_f64le, h5t_std_i32le, h5t_std_i64le, &
      & h5t_std_u8le, hid_t, hsize_t
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: create_dataset, extend_dataset, select_rows, type_in_memory, write_rows

   !> Kinds of number in memory: default integers, reals of the working precision, and characters
   integer, parameter, public :: is_integer = 1, is_real = 2, is_byte = 3
   !> Ways to store a number in the file, whatever it is in memory
   integer, parameter, public :: store_byte = 1, store_integer = 2, store_long = 3, &
      & store_single = 4, store_double = 5

   !> How a dataset is stored
   type, public :: storage_type
      !> Extent of the dataset, rows last; of no rows for one that grows
      integer, allocatable :: extent(:)
      !> One of `store_…`
      integer :: storage = store_double
      !> Rows of a chunk; 0 for a dataset in one piece
      integer :: chunk_rows = 0
      !> Whether rows can be added, and whether each chunk has a check sum
      logical :: grows = .false., is_checked = .false.
   end type storage_type

contains

   !> Create a dataset
   subroutine create_dataset(file, name, storage, good)
      !> Handle of the file
      integer(hid_t), intent(in) :: file
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> How it is stored
      type(storage_type), intent(in) :: storage
      !> True when all went well
      logical, intent(out) :: good

      integer(hsize_t), dimension(size(storage%extent)) :: chunk, extent, most
      integer(hid_t) :: creation, dataset, space
      integer :: rank, status(10)

      status(:) = 0
      rank = size(storage%extent)
      extent(:) = storage%extent
      most(:) = extent
      if (storage%grows) most(rank) = h5s_unlimited_f
      chunk(:) = extent
      chunk(rank) = storage%chunk_rows
      ! the same run makes the same file: no time of day
      call h5pcreate_f(h5p_dataset_create_f, creation, status(1))
      call h5pset_obj_track_times_f(creation, .false., status(2))
      call h5pset_fill_time_f(creation, h5d_fill_time_never_f, status(3))
      if (storage%chunk_rows > 0) call h5pset_chunk_f(creation, rank, chunk, status(4))
      if (storage%is_checked) call h5pset_fletcher32_f(creation, status(5))
      call h5screate_simple_f(rank, extent, space, status(6), most)
      call h5dcreate_f(file, name, type_in_file(storage%storage), space, dataset, status(7), &
         & creation)
      call h5dclose_f(dataset, status(8))
      call h5sclose_f(space, status(9))
      call h5pclose_f(creation, status(10))
      good = all(status >= 0)
   end subroutine create_dataset

   !> Add rows, not yet written, at the end of a dataset
   subroutine extend_dataset(dataset, added, before, good)
      !> Handle of the dataset, a list or a table
      integer(hid_t), intent(in) :: dataset
      !> Rows to add
      integer(int64), intent(in) :: added
      !> Rows before them
      integer(int64), intent(out) :: before
      !> True when all went well
      logical, intent(out) :: good

      integer(hsize_t) :: most(2), rows(2)
      integer(hid_t) :: space
      integer :: rank, status(5)

      call h5dget_space_f(dataset, space, status(1))
      call h5sget_simple_extent_ndims_f(space, rank, status(2))
      call h5sget_simple_extent_dims_f(space, rows, most, status(3))
      call h5sclose_f(space, status(4))
      before = rows(rank)
      rows(rank) = before + added
      call h5dset_extent_f(dataset, rows(:rank), status(5))
      good = all(status >= 0)
   end subroutine extend_dataset

   !> Write consecutive rows of a dataset
   subroutine write_rows(dataset, first, rows, number, address, good)
      !> Handle of the dataset, a list or a table
      integer(hid_t), intent(in) :: dataset
      !> Rows before the first, and how many there are
      integer(int64), intent(in) :: first, rows
      !> Kind of their numbers, one of `is_…`, and where they are, one behind the other
      integer, intent(in) :: number
      type(c_ptr), intent(in) :: address
      !> True when all went well
      logical, intent(out) :: good

      integer(hid_t) :: memory, space
      integer :: status(5)

      call h5dget_space_f(dataset, space, status(1))
      call select_rows(space, first, rows, memory, status(2))
      call h5dwrite_f(dataset, type_in_memory(number), address, status(3), memory, space)
      call h5sclose_f(memory, status(4))
      call h5sclose_f(space, status(5))
      good = all(status >= 0)
   end subroutine write_rows

   !> Select consecutive rows in the space of a dataset, and make the space in memory for them
   subroutine select_rows(space, first, rows, memory, status)
      !> Handle of the space of the dataset, a list or a table
      integer(hid_t), intent(in) :: space
      !> Rows before the first, and how many there are
      integer(int64), intent(in) :: first, rows
      !> Handle of the space in memory
      integer(hid_t), intent(out) :: memory
      !> Negative when the dataset has not so many rows or a call failed
      integer, intent(out) :: status

      integer(hsize_t) :: count(2), most(2), start(2)
      integer :: calls(4), rank

      memory = -1
      status = -1
      call h5sget_simple_extent_ndims_f(space, rank, calls(1))
      if (rank < 1 .or. rank > 2) return
      call h5sget_simple_extent_dims_f(space, count, most, calls(2))
      if (first + rows > count(rank)) return
      start(:) = 0
      start(rank) = first
      count(rank) = rows
      call h5screate_simple_f(rank, count, memory, calls(3))
      call h5sselect_hyperslab_f(space, h5s_select_set_f, start, count, calls(4))
      status = minval([calls(1), calls(3:)])
   end subroutine select_rows

   !> The library's type of numbers in memory
   integer(hid_t) function type_in_memory(number)
      !> One of `is_…`
      integer, intent(in) :: number

      select case (number)
      case (is_byte)
         type_in_memory = h5t_std_u8le
      case (is_integer)
         type_in_memory = h5kind_to_type(kind(0), h5_integer_kind)
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
