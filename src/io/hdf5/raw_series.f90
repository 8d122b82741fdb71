!> Calls of HDF5 for datasets that grow.
module plydyn_io_hdf5_raw_series
   use, intrinsic :: iso_c_binding, only : c_int, c_int64_t
   use, intrinsic :: iso_fortran_env, only : int64
   use hdf5, only : h5dclose_f, h5dcreate_f, h5dget_create_plist_f, h5dget_space_f, h5dget_type_f, &
      & h5dopen_f, h5dset_extent_f, h5dwrite_f, h5pclose_f, h5pget_chunk_f, h5pset_chunk_f, &
      & h5s_unlimited_f, h5sclose_f, h5screate_simple_f, h5sget_simple_extent_dims_f, &
      & h5sget_simple_extent_ndims_f, h5tclose_f, h5tget_size_f, hid_t, hsize_t, size_t
   use plydyn_io_hdf5_numbers, only : numbers_type, dataset_layout_type, hyperslab_type
   use plydyn_io_hdf5_raw, only : create_plan, select_slab, type_in_file, type_in_memory
   use plydyn_io_hdf5_raw_file, only : handle_type
   implicit none
   private

   public :: create_series, append_rows, add_rows

   interface
      !> Where a chunk of a dataset lies, which HDF5 1.10 tells in C only
      integer(c_int) function c_chunk_info(dataset, offset, filters, start, bytes) &
         & bind(c, name="H5Dget_chunk_info_by_coord")
         import :: c_int, c_int64_t
         implicit none
         integer(c_int64_t), value :: dataset
         integer(c_int64_t), intent(in) :: offset(*)
         integer(c_int), intent(out) :: filters
         integer(c_int64_t), intent(out) :: start, bytes
      end function c_chunk_info
   end interface

contains

   !> Create a dataset of no rows that can grow
   subroutine create_series(file, name, width, rows_per_chunk, storage, good)
      !> The file
      type(handle_type), intent(in) :: file
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
      call h5dcreate_f(file%id, name, type_in_file(storage), space, dataset, status(4), plan)
      call h5dclose_f(dataset, status(5))
      call h5sclose_f(space, status(6))
      call h5pclose_f(plan, status(7))
      good = all(status >= 0)
   end subroutine create_series

   !> Add rows at the end of a dataset that can grow; the storage is as it was created
   subroutine append_rows(file, name, numbers, good)
      !> The file
      type(handle_type), intent(in) :: file
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to add: whole rows
      type(numbers_type), intent(in) :: numbers
      !> True when all went well
      logical, intent(out) :: good

      integer(hsize_t) :: before
      integer(hid_t) :: dataset, memory, space
      integer :: added, status(7)

      added = numbers%extent(size(numbers%extent))
      call h5dopen_f(file%id, name, dataset, status(1))
      call grow(dataset, numbers%extent, before, status(2))
      call h5dget_space_f(dataset, space, status(3))
      call select_slab(space, before, hyperslab_type(whole=added, count=added), memory, status(4))
      call h5dwrite_f(dataset, type_in_memory(numbers%number), numbers%address, status(5), memory, &
         & space)
      call h5sclose_f(memory, status(6))
      call h5sclose_f(space, status(7))
      good = all(status >= 0)
      call h5dclose_f(dataset, status(1))
      good = good .and. status(1) >= 0
   end subroutine append_rows

   !> Add rows at the end of a dataset that can grow, whose numbers are brought by others
   subroutine add_rows(file, name, extent, room, good)
      !> The file
      type(handle_type), intent(in) :: file
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> Extent of all that is added
      integer, intent(in) :: extent(:)
      !> Where the rows lie
      type(dataset_layout_type), intent(out) :: room
      !> True when all went well
      logical, intent(out) :: good

      integer(hsize_t) :: before, chunk(2)
      integer(hid_t) :: dataset, kind, plan
      integer(size_t) :: number_bytes
      integer :: rank, status(9)

      rank = size(extent)
      call h5dopen_f(file%id, name, dataset, status(1))
      call grow(dataset, extent, before, status(2))
      call h5dget_create_plist_f(dataset, plan, status(3))
      ! says of how many extents the chunk is
      call h5pget_chunk_f(plan, rank, chunk, status(4))
      status(4) = status(4) - rank
      call h5pclose_f(plan, status(5))
      call h5dget_type_f(dataset, kind, status(6))
      call h5tget_size_f(kind, number_bytes, status(7))
      call h5tclose_f(kind, status(8))
      room%row_bytes = number_bytes*product(extent(:rank - 1))
      good = all(status(:8) >= 0)
      if (good) then
         room%rows_per_run = chunk(rank)
         room%before = mod(before, chunk(rank))
         call find_chunks(dataset, rank, chunk(rank), before, before + extent(rank) - 1, room, good)
      end if
      call h5dclose_f(dataset, status(9))
      good = good .and. status(9) >= 0
   end subroutine add_rows

   !> Where the chunks lie that hold some rows
   subroutine find_chunks(dataset, rank, rows_per_chunk, first, last, room, good)
      integer(hid_t), intent(in) :: dataset
      !> Extents of the dataset
      integer, intent(in) :: rank
      !> Rows of a chunk, first row and last, from 0
      integer(hsize_t), intent(in) :: rows_per_chunk, first, last
      type(dataset_layout_type), intent(inout) :: room
      logical, intent(out) :: good

      integer(hsize_t) :: bytes, k, place(rank)
      integer(c_int) :: filters, status

      good = .true.
      associate (before => first/rows_per_chunk)
         allocate (room%start(last/rows_per_chunk - before + 1), source=0_int64)
         do k = 1, size(room%start)
            ! in C's order: rows first
            place(:) = 0
            place(1) = (before + k - 1)*rows_per_chunk
            status = c_chunk_info(dataset, place, filters, room%start(k), bytes)
            good = good .and. status >= 0
         end do
      end associate
   end subroutine find_chunks

   !> Make room at the end of a dataset
   subroutine grow(dataset, added, before, status)
      !> Handle of the dataset
      integer(hid_t), intent(in) :: dataset
      !> Extent of the numbers to add: a table of the dataset's width, or a list
      integer, intent(in) :: added(:)
      !> Rows before the room
      integer(hsize_t), intent(out) :: before
      !> Negative when the numbers do not fit or a call failed
      integer, intent(out) :: status

      integer(hsize_t) :: most(2), rows(2)
      integer(hid_t) :: space
      integer :: calls(5), rank

      status = -1
      rows(:) = 0
      before = 0
      call h5dget_space_f(dataset, space, calls(1))
      call h5sget_simple_extent_ndims_f(space, rank, calls(2))
      if (rank < 1 .or. rank > 2) return
      call h5sget_simple_extent_dims_f(space, rows, most, calls(3))
      call h5sclose_f(space, calls(4))
      associate (all => product(int(added, hsize_t)), new => added(size(added)))
         if (all /= new*product(rows(:rank - 1))) return
         before = rows(rank)
         rows(rank) = before + new
      end associate
      call h5dset_extent_f(dataset, rows, calls(5))
      status = minval(calls)
   end subroutine grow

end module plydyn_io_hdf5_raw_series
