!> Files of HDF5 being written by the root: datasets, and datasets that grow.
!>
!> Arrays keep the order of their memory: `values(components, rows)` here is a table of rows by
!> components for C and Python. Objects inside a file are named by their path, such as
!> `VTKHDF/Steps/Values`. Where each rank has a band of the rows it says so by a hyperslab, and the
!> root receives the bands in parts; without a hyperslab it writes what it has itself.
module plydyn_io_hdf5_output
   use, intrinsic :: iso_c_binding, only : c_loc, c_ptr
   use, intrinsic :: iso_fortran_env, only : int64
   use hdf5, only : h5d_fill_time_never_f, h5dclose_f, h5dcreate_f, h5dget_space_f, h5dopen_f, &
      & h5dset_extent_f, h5dwrite_f, h5p_dataset_create_f, h5pclose_f, h5pcreate_f, &
      & h5pset_chunk_f, h5pset_fill_time_f, h5pset_fletcher32_f, h5pset_obj_track_times_f, &
      & h5s_unlimited_f, h5sclose_f, h5screate_simple_f, h5sget_simple_extent_dims_f, &
      & h5sget_simple_extent_ndims_f, h5t_ieee_f32le, h5t_ieee_f64le, h5t_std_i32le, &
      & h5t_std_i64le, h5t_std_u8le, hid_t, hsize_t
   use plydyn_base_precision, only : wp
   use plydyn_io_hdf5_file, only : hdf5_file_type
   use plydyn_io_hdf5_input, only : hdf5_input_type, is_byte, is_real, select_rows, type_in_memory
   implicit none
   private

   !> Ways to store a number in the file, whatever it is in memory
   integer, parameter, public :: store_byte = 1, store_integer = 2, store_long = 3, &
      & store_single = 4, store_double = 5
   !> Most numbers that are sent or copied at once, and numbers of a chunk that has a check sum: it
   !> fits into the cache of the library
   integer, parameter :: numbers_at_once = 2**18, numbers_per_chunk = 2**16

   !> How a dataset is stored
   type :: storage_type
      !> Extent of the dataset, rows last; of no rows for one that grows
      integer, allocatable :: extent(:)
      !> One of `store_…`
      integer :: storage = store_double
      !> Rows of a chunk; 0 for a dataset in one piece
      integer :: chunk_rows = 0
      !> Whether rows can be added, and whether each chunk has a check sum
      logical :: grows = .false., is_checked = .false.
   end type storage_type

   !> The rows that a rank has of those that all ranks write: the same ones of each level
   type, public :: hyperslab_type
      !> Rows of a level, and levels
      integer :: whole = 0, levels = 1
      !> Rows of a level before those of this rank, and how many this rank has
      integer :: first = 0, count = 0
   end type hyperslab_type

   !> A file being written
   type, public, extends(hdf5_file_type) :: hdf5_output_type
   contains
      procedure :: write_values
      procedure :: write_bytes
      procedure :: make_series
      procedure :: append
      procedure :: copy_rows
   end type hdf5_output_type

contains

   !> Write a dataset whole
   subroutine write_values(self, name, extent, values, storage, hyperslab)
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> Extent of the array of this rank, rows last
      integer, intent(in) :: extent(:)
      !> The array, of any rank; a real holds every integer exactly
      real(wp), intent(in) :: values(product(extent))
      !> One of `store_…`
      integer, intent(in) :: storage
      !> Where the rows of this rank go
      type(hyperslab_type), intent(in), optional :: hyperslab

      integer(hid_t) :: dataset
      integer :: whole(size(extent))

      whole(:) = extent
      whole(size(whole)) = rows_of_all(extent, hyperslab)
      call create_dataset(self, name, whole_storage(self, whole, storage), dataset)
      call gather_rows(self, name, dataset, 0_int64, extent, values, hyperslab)
      call close_dataset(self, name, dataset)
   end subroutine write_values

   !> Dataset of the characters of a text, which is the same on all ranks
   subroutine write_bytes(self, name, content)
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      character(*), intent(in), target :: content

      integer(hid_t) :: dataset

      call create_dataset(self, name, whole_storage(self, [len(content)], store_byte), dataset)
      if (len(content) > 0) call write_rows(self, name, dataset, 0_int64, len(content, int64), &
         & is_byte, c_loc(content))
      call close_dataset(self, name, dataset)
   end subroutine write_bytes

   !> Make a dataset of no rows to which rows can be added
   subroutine make_series(self, name, width, rows_per_chunk, storage)
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> Numbers in a row; 0 for a list of numbers
      integer, intent(in) :: width
      !> Rows that lie together in the file: best as many as are added at once
      integer, intent(in) :: rows_per_chunk
      !> One of `store_…`
      integer, intent(in) :: storage

      type(storage_type) :: stored
      integer(hid_t) :: dataset

      stored = storage_type([width, 0], storage, max(1, rows_per_chunk), grows=.true.)
      if (width == 0) stored%extent = [0]
      call create_dataset(self, name, stored, dataset)
      call close_dataset(self, name, dataset)
   end subroutine make_series

   !> Add rows to a dataset made by `make_series`
   subroutine append(self, name, extent, values, hyperslab)
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> Extent of the array of this rank, rows last, and the array, of any rank
      integer, intent(in) :: extent(:)
      real(wp), intent(in) :: values(product(extent))
      !> Where the rows of this rank go
      type(hyperslab_type), intent(in), optional :: hyperslab

      integer(int64) :: before
      integer(hid_t) :: dataset

      call open_dataset(self, name, dataset)
      call extend_dataset(self, name, dataset, int(rows_of_all(extent, hyperslab), int64), before)
      call gather_rows(self, name, dataset, before, extent, values, hyperslab)
      call close_dataset(self, name, dataset)
   end subroutine append

   !> Add the first rows that a dataset has in another file; the root reads and writes them
   subroutine copy_rows(self, name, width, rows, other, is_there)
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in both files
      character(*), intent(in) :: name
      !> Numbers in a row, and rows to copy
      integer, intent(in) :: width
      integer(int64), intent(in) :: rows
      !> The other file
      type(hdf5_input_type), intent(in) :: other
      !> Whether the other file has these rows; true but on the root
      logical, intent(out) :: is_there

      integer(int64) :: before, done
      real(wp), allocatable, target :: piece(:, :)
      integer(hid_t) :: dataset

      is_there = .true.
      call open_dataset(self, name, dataset)
      call extend_dataset(self, name, dataset, rows, before)
      done = 0
      do while (self%writes() .and. is_there .and. done < rows)
         allocate (piece(width, min(rows - done, int(max(1, numbers_at_once/width), int64))))
         call other%read_rows(name, done, piece, is_there)
         if (is_there) call write_rows(self, name, dataset, done, size(piece, 2, int64), is_real, &
            & c_loc(piece))
         done = done + size(piece, 2)
         deallocate (piece)
      end do
      call close_dataset(self, name, dataset)
   end subroutine copy_rows

   !> Rows that all ranks write
   pure integer function rows_of_all(extent, hyperslab) result(rows)
      !> Extent of the array of this rank
      integer, intent(in) :: extent(:)
      type(hyperslab_type), intent(in), optional :: hyperslab

      rows = extent(size(extent))
      if (present(hyperslab)) rows = hyperslab%whole*hyperslab%levels
   end function rows_of_all

   !> How a dataset that does not grow is stored
   pure function whole_storage(self, extent, storage) result(stored)
      type(hdf5_output_type), intent(in) :: self
      integer, intent(in) :: extent(:), storage
      type(storage_type) :: stored

      stored = storage_type(extent=extent, storage=storage)
      if (.not. self%is_checked .or. any(extent == 0)) return
      stored%is_checked = .true.
      associate (rows => extent(size(extent)))
         stored%chunk_rows = min(rows, max(1, numbers_per_chunk/(product(extent)/rows)))
      end associate
   end function whole_storage

   !> Send the rows of each rank to the root in parts, which writes them
   subroutine gather_rows(self, name, dataset, before, extent, values, hyperslab)
      type(hdf5_output_type), intent(inout) :: self
      character(*), intent(in) :: name
      !> The dataset and the rows in it before those of all ranks, on the root
      integer(hid_t), intent(in) :: dataset
      integer(int64), intent(in) :: before
      !> The array of this rank
      integer, intent(in) :: extent(:)
      real(wp), intent(in) :: values(product(extent))
      type(hyperslab_type), intent(in), optional :: hyperslab

      real(wp), allocatable, target :: piece(:)
      type(hyperslab_type) :: all
      integer(int64) :: here
      real(wp) :: band(2)
      integer :: done, level, most, r, rows, width

      all = hyperslab_type(whole=extent(size(extent)), count=extent(size(extent)))
      if (present(hyperslab)) all = hyperslab
      width = product(extent(:size(extent) - 1))
      most = max(1, numbers_at_once/width)
      allocate (piece(width*most))
      do r = 0, merge(self%comm%ranks - 1, 0, present(hyperslab))
         if (r /= self%comm%rank .and. .not. self%comm%is_root()) cycle
         band(:) = [all%first, all%count]
         call self%comm%send_to_root(r, band)
         do level = 0, all%levels - 1
            do done = 0, nint(band(2)) - 1, most
               rows = min(most, nint(band(2)) - done)
               here = width*(int(level, int64)*nint(band(2)) + done)
               if (r == self%comm%rank) piece(:width*rows) = values(here + 1:here + width*rows)
               call self%comm%send_to_root(r, piece(:width*rows))
               call write_rows(self, name, dataset, before + int(level, int64)*all%whole &
                  & + nint(band(1)) + done, int(rows, int64), is_real, c_loc(piece))
            end do
         end do
      end do
   end subroutine gather_rows

   ! calls of the library, on the root before the first failure

   !> Create a dataset and leave it open
   subroutine create_dataset(self, name, stored, dataset)
      type(hdf5_output_type), intent(inout) :: self
      character(*), intent(in) :: name
      type(storage_type), intent(in) :: stored
      !> Its handle
      integer(hid_t), intent(out) :: dataset

      integer(hsize_t), dimension(size(stored%extent)) :: chunk, extent, most
      integer(hid_t) :: creation, space
      integer :: rank, status(9)

      dataset = -1_hid_t
      if (.not. self%writes()) return
      status(:) = 0
      rank = size(stored%extent)
      extent(:) = stored%extent
      most(:) = extent
      if (stored%grows) most(rank) = h5s_unlimited_f
      chunk(:) = extent
      chunk(rank) = stored%chunk_rows
      ! the same run makes the same file: no time of day
      call h5pcreate_f(h5p_dataset_create_f, creation, status(1))
      call h5pset_obj_track_times_f(creation, .false., status(2))
      call h5pset_fill_time_f(creation, h5d_fill_time_never_f, status(3))
      if (stored%chunk_rows > 0) call h5pset_chunk_f(creation, rank, chunk, status(4))
      if (stored%is_checked) call h5pset_fletcher32_f(creation, status(5))
      call h5screate_simple_f(rank, extent, space, status(6), most)
      call h5dcreate_f(self%id, name, type_in_file(stored%storage), space, dataset, status(7), &
         & creation)
      call h5sclose_f(space, status(8))
      call h5pclose_f(creation, status(9))
      call self%note(all(status >= 0), name)
   end subroutine create_dataset

   !> Open a dataset
   subroutine open_dataset(self, name, dataset)
      type(hdf5_output_type), intent(inout) :: self
      character(*), intent(in) :: name
      integer(hid_t), intent(out) :: dataset

      integer :: status

      dataset = -1_hid_t
      if (.not. self%writes()) return
      call h5dopen_f(self%id, name, dataset, status)
      call self%note(status >= 0, name)
   end subroutine open_dataset

   !> Close a dataset, and write what is held back of it
   subroutine close_dataset(self, name, dataset)
      type(hdf5_output_type), intent(inout) :: self
      character(*), intent(in) :: name
      integer(hid_t), intent(in) :: dataset

      integer :: status

      if (.not. self%writes()) return
      call h5dclose_f(dataset, status)
      call self%note(status >= 0, name)
   end subroutine close_dataset

   !> Add rows, not yet written, at the end of a dataset
   subroutine extend_dataset(self, name, dataset, added, before)
      type(hdf5_output_type), intent(inout) :: self
      character(*), intent(in) :: name
      integer(hid_t), intent(in) :: dataset
      !> Rows to add, and rows before them
      integer(int64), intent(in) :: added
      integer(int64), intent(out) :: before

      integer(hsize_t) :: most(2), rows(2)
      integer(hid_t) :: space
      integer :: rank, status(5)

      before = 0
      if (.not. self%writes()) return
      call h5dget_space_f(dataset, space, status(1))
      call h5sget_simple_extent_ndims_f(space, rank, status(2))
      call h5sget_simple_extent_dims_f(space, rows, most, status(3))
      call h5sclose_f(space, status(4))
      before = rows(rank)
      rows(rank) = before + added
      call h5dset_extent_f(dataset, rows(:rank), status(5))
      call self%note(all(status >= 0), name)
   end subroutine extend_dataset

   !> Write consecutive rows of a dataset
   subroutine write_rows(self, name, dataset, first, rows, number, address)
      type(hdf5_output_type), intent(inout) :: self
      character(*), intent(in) :: name
      integer(hid_t), intent(in) :: dataset
      !> Rows before the first, and how many there are
      integer(int64), intent(in) :: first, rows
      !> Kind of their numbers, one of `is_…`, and where they are, one behind the other
      integer, intent(in) :: number
      type(c_ptr), intent(in) :: address

      integer(hid_t) :: memory, space
      integer :: status(5)

      if (.not. self%writes()) return
      call h5dget_space_f(dataset, space, status(1))
      call select_rows(space, first, rows, memory, status(2))
      call h5dwrite_f(dataset, type_in_memory(number), address, status(3), memory, space)
      call h5sclose_f(memory, status(4))
      call h5sclose_f(space, status(5))
      call self%note(all(status >= 0), name)
   end subroutine write_rows

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

end module plydyn_io_hdf5_output
