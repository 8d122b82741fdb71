!> Files of HDF5 being written by the root: datasets, and datasets that grow.
!>
!> Arrays keep the order of their memory: `values(components, rows)` here is a table of rows by
!> components for C and Python. Objects inside a file are named by their path, such as
!> `VTKHDF/Steps/Values`. Where each rank has a band of the rows it says so by a hyperslab, and the
!> root receives the bands in parts; without a hyperslab it writes what it has itself.
module plydyn_io_hdf5_output
   use, intrinsic :: iso_c_binding, only : c_loc
   use, intrinsic :: iso_fortran_env, only : int64
   use hdf5, only : h5dclose_f, h5dopen_f, hid_t
   use plydyn_base_precision, only : wp
   use plydyn_io_hdf5_file, only : hdf5_file_type
   use plydyn_io_hdf5_input, only : hdf5_input_type
   use plydyn_io_hdf5_raw, only : create_dataset, extend_dataset, is_byte, is_real, storage_type, &
      & store_byte, store_double, store_integer, store_long, store_single, write_rows
   implicit none
   private

   public :: store_byte, store_double, store_integer, store_long, store_single

   !> Most numbers that are sent or copied at once, and numbers of a chunk that has a check sum: it
   !> fits into the cache of the library
   integer, parameter :: numbers_at_once = 2**18, numbers_per_chunk = 2**16

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
      !> Write a dataset whole
      generic :: write_values => write_integer_list, write_real_list, write_real_table
      procedure :: write_bytes
      procedure :: make_series
      !> Add rows to a dataset made by `make_series`
      generic :: append => append_list, append_table
      procedure :: copy_rows
      procedure, private :: write_integer_list, write_real_list, write_real_table, append_list, &
         & append_table
   end type hdf5_output_type

contains

   !> Dataset of a list of integers; a real holds every one of them exactly
   subroutine write_integer_list(self, name, values, storage, hyperslab)
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      integer, intent(in) :: values(:)
      !> One of `store_…`
      integer, intent(in) :: storage
      !> Where the rows of this rank go
      type(hyperslab_type), intent(in), optional :: hyperslab

      call self%write_values(name, real(values, wp), storage, hyperslab)
   end subroutine write_integer_list

   !> Dataset of a list of reals
   subroutine write_real_list(self, name, values, storage, hyperslab)
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      real(wp), intent(in), contiguous :: values(:)
      !> One of `store_…`
      integer, intent(in) :: storage
      !> Where the rows of this rank go
      type(hyperslab_type), intent(in), optional :: hyperslab

      call write_table(self, name, values, 1, [rows_of_all(size(values), hyperslab)], storage, &
         & hyperslab)
   end subroutine write_real_list

   !> Dataset of a table of reals
   subroutine write_real_table(self, name, values, storage, hyperslab)
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write, (width, rows)
      real(wp), intent(in), contiguous :: values(:, :)
      !> One of `store_…`
      integer, intent(in) :: storage
      !> Where the rows of this rank go
      type(hyperslab_type), intent(in), optional :: hyperslab

      call write_table(self, name, reshape(values, [size(values)]), size(values, 1), &
         & [size(values, 1), rows_of_all(size(values, 2), hyperslab)], storage, hyperslab)
   end subroutine write_real_table

   !> Rows that all ranks write
   pure integer function rows_of_all(rows, hyperslab)
      !> Rows of this rank
      integer, intent(in) :: rows
      type(hyperslab_type), intent(in), optional :: hyperslab

      rows_of_all = rows
      if (present(hyperslab)) rows_of_all = hyperslab%whole*hyperslab%levels
   end function rows_of_all

   !> Make a dataset and write it
   subroutine write_table(self, name, values, width, extent, storage, hyperslab)
      type(hdf5_output_type), intent(inout) :: self
      character(*), intent(in) :: name
      !> Rows of this rank, one behind the other
      real(wp), intent(in), contiguous :: values(:)
      !> Numbers in a row
      integer, intent(in) :: width
      !> Extent of what all ranks write
      integer, intent(in) :: extent(:)
      integer, intent(in) :: storage
      type(hyperslab_type), intent(in), optional :: hyperslab

      integer(hid_t) :: dataset
      logical :: good

      if (self%writes()) then
         call create_dataset(self%id, name, whole_storage(self, extent, storage), good)
         call self%note(good, name)
      end if
      call open_dataset(self, name, dataset)
      call gather_rows(self, name, dataset, 0_int64, values, width, hyperslab)
      call close_dataset(self, name, dataset)
   end subroutine write_table

   !> Open a dataset, on the root before the first failure
   subroutine open_dataset(self, name, dataset)
      type(hdf5_output_type), intent(inout) :: self
      character(*), intent(in) :: name
      !> Its handle
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

   !> Dataset of the characters of a text, which is the same on all ranks
   subroutine write_bytes(self, name, content)
      !> The file
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      character(*), intent(in), target :: content

      integer(hid_t) :: dataset
      logical :: good

      if (.not. self%writes()) return
      call create_dataset(self%id, name, whole_storage(self, [len(content)], store_byte), good)
      call self%note(good, name)
      call open_dataset(self, name, dataset)
      if (self%writes() .and. len(content) > 0) then
         call write_rows(dataset, 0_int64, len(content, int64), is_byte, c_loc(content), good)
         call self%note(good, name)
      end if
      call close_dataset(self, name, dataset)
   end subroutine write_bytes

   !> Make a dataset of no rows to which rows can be added
   subroutine make_series(self, name, width, rows_per_chunk, storage)
      !> The file
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
      logical :: good

      if (.not. self%writes()) return
      stored = storage_type([width, 0], storage, max(1, rows_per_chunk), grows=.true.)
      if (width == 0) stored%extent = [0]
      call create_dataset(self%id, name, stored, good)
      call self%note(good, name)
   end subroutine make_series

   !> Add numbers to a list
   subroutine append_list(self, name, values, hyperslab)
      !> The file
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to add
      real(wp), intent(in), contiguous :: values(:)
      !> Where the numbers of this rank go
      type(hyperslab_type), intent(in), optional :: hyperslab

      call append_rows(self, name, values, 1, hyperslab)
   end subroutine append_list

   !> Add rows to a table
   subroutine append_table(self, name, values, hyperslab)
      !> The file
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to add, (width, rows)
      real(wp), intent(in), contiguous :: values(:, :)
      !> Where the rows of this rank go
      type(hyperslab_type), intent(in), optional :: hyperslab

      call append_rows(self, name, reshape(values, [size(values)]), size(values, 1), hyperslab)
   end subroutine append_table

   !> Add rows to a list or a table
   subroutine append_rows(self, name, values, width, hyperslab)
      type(hdf5_output_type), intent(inout) :: self
      character(*), intent(in) :: name
      real(wp), intent(in), contiguous :: values(:)
      !> Numbers in a row
      integer, intent(in) :: width
      type(hyperslab_type), intent(in), optional :: hyperslab

      integer(int64) :: before
      integer(hid_t) :: dataset
      logical :: good

      before = 0
      call open_dataset(self, name, dataset)
      if (self%writes()) then
         call extend_dataset(dataset, int(rows_of_all(size(values)/width, hyperslab), int64), &
            & before, good)
         call self%note(good, name)
      end if
      call gather_rows(self, name, dataset, before, values, width, hyperslab)
      call close_dataset(self, name, dataset)
   end subroutine append_rows

   !> Send the rows of each rank to the root in parts, which writes them
   subroutine gather_rows(self, name, dataset, before, values, width, hyperslab)
      type(hdf5_output_type), intent(inout) :: self
      character(*), intent(in) :: name
      !> The dataset and the rows in it before those of all ranks, on the root
      integer(hid_t), intent(in) :: dataset
      integer(int64), intent(in) :: before
      !> Rows of this rank
      real(wp), intent(in), contiguous, target :: values(:)
      integer, intent(in) :: width
      type(hyperslab_type), intent(in), optional :: hyperslab

      real(wp), allocatable, target :: piece(:)
      type(hyperslab_type) :: all
      integer(int64) :: here, row
      integer :: band(2), done, level, most, r, rows

      all = hyperslab_type(whole=size(values)/width, count=size(values)/width)
      if (present(hyperslab)) all = hyperslab
      most = max(1, numbers_at_once/width)
      allocate (piece(width*most))
      do r = 0, merge(self%comm%ranks - 1, 0, present(hyperslab))
         if (r /= self%comm%rank .and. .not. self%comm%is_root()) cycle
         band(:) = [all%first, all%count]
         call self%comm%send_to_root(r, band)
         do level = 0, all%levels - 1
            do done = 0, band(2) - 1, most
               rows = min(most, band(2) - done)
               here = width*(int(level, int64)*band(2) + done)
               if (r == self%comm%rank) piece(:width*rows) = values(here + 1:here + width*rows)
               call self%comm%send_to_root(r, piece(:width*rows))
               row = before + int(level, int64)*all%whole + band(1) + done
               call put_piece(self, name, dataset, row, rows, piece)
            end do
         end do
      end do
   end subroutine gather_rows

   !> Write a piece, on the root before the first failure
   subroutine put_piece(self, name, dataset, first, rows, piece)
      type(hdf5_output_type), intent(inout) :: self
      character(*), intent(in) :: name
      integer(hid_t), intent(in) :: dataset
      !> Rows of the dataset before it, and rows of it
      integer(int64), intent(in) :: first
      integer, intent(in) :: rows
      real(wp), intent(in), contiguous, target :: piece(:)

      logical :: good

      if (.not. self%writes()) return
      call write_rows(dataset, first, int(rows, int64), is_real, c_loc(piece), good)
      call self%note(good, name)
   end subroutine put_piece

   !> Add the first rows that a dataset has in another file; the root reads and writes them
   subroutine copy_rows(self, name, width, rows, other, is_there)
      !> The file
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
      logical :: good

      is_there = .true.
      call open_dataset(self, name, dataset)
      if (.not. self%writes()) return
      call extend_dataset(dataset, rows, before, good)
      done = 0
      do while (good .and. is_there .and. done < rows)
         allocate (piece(width, min(rows - done, int(max(1, numbers_at_once/width), int64))))
         call other%read_rows(name, done, piece, is_there)
         if (is_there) call write_rows(dataset, done, size(piece, 2, int64), &
            & is_real, c_loc(piece), good)
         done = done + size(piece, 2)
         deallocate (piece)
      end do
      call self%note(good, name)
      call close_dataset(self, name, dataset)
   end subroutine copy_rows

end module plydyn_io_hdf5_output
