!> Files of HDF5 being written, with errors as values: datasets, and datasets that grow.
!>
!> Arrays keep the order of their memory: `values(components, rows)` here is a table of rows by
!> components for C and Python. Where several ranks write a file, each of them brings the rows that
!> it has, and says by a slab where they go; without one the root writes, whatever the others have.
module plydyn_io_hdf5_output
   use, intrinsic :: iso_c_binding, only : c_loc
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_io_hdf5_file, only : hdf5_file_type
   use plydyn_io_hdf5_raw_file, only : half_index
   use plydyn_io_hdf5_numbers, only : is_byte, is_integer, is_long, is_real, numbers_type, &
      & dataset_layout_type, hyperslab_type, store_byte, store_double, store_integer, store_long, &
      & store_single
   use plydyn_io_hdf5_raw, only : make_dataset, write_dataset
   use plydyn_io_hdf5_raw_series, only : add_rows, append_rows, create_series
   implicit none
   private

   public :: hyperslab_type, store_byte, store_double, store_integer, store_long, store_single

   !> Bytes of a node in the index of a dataset that grows, and of the first rows of a list
   integer(int64), parameter :: node_bytes = 24*2**10

   !> A file being written
   type, public, extends(hdf5_file_type) :: hdf5_output_type
      !> Datasets that grow
      integer, private :: series = 0
   contains
      !> Write a dataset whole
      generic :: write_values => write_integer_list, write_integer_table, write_real_list, &
         & write_real_table
      procedure :: write_bytes
      procedure :: make_series
      procedure :: reserve_rows
      !> Add rows to a dataset made by `make_series`
      generic :: append => append_longs, append_reals, append_real_rows
      procedure, private :: write_integer_list, write_integer_table, write_real_list, &
         & write_real_table, append_longs, append_reals, append_real_rows, write_all, append_all
   end type hdf5_output_type

contains

   !> Dataset of a list of integers
   subroutine write_integer_list(self, name, values, storage, error, slab)
      !> The file
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      integer, intent(in), target, contiguous :: values(:)
      !> One of `store_byte`, `store_integer`, `store_long`
      integer, intent(in) :: storage
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error
      !> Where the rows of this rank go
      type(hyperslab_type), intent(in), optional :: slab

      call self%write_all(name, numbers_type(c_loc(values), shape(values), is_integer, storage), &
         & error, slab)
   end subroutine write_integer_list

   !> Dataset of a table of integers
   subroutine write_integer_table(self, name, values, storage, error, slab)
      !> The file
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      integer, intent(in), target, contiguous :: values(:, :)
      !> One of `store_byte`, `store_integer`, `store_long`
      integer, intent(in) :: storage
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error
      !> Where the rows of this rank go
      type(hyperslab_type), intent(in), optional :: slab

      call self%write_all(name, numbers_type(c_loc(values), shape(values), is_integer, storage), &
         & error, slab)
   end subroutine write_integer_table

   !> Dataset of a list of reals
   subroutine write_real_list(self, name, values, storage, error, slab)
      !> The file
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      real(wp), intent(in), target, contiguous :: values(:)
      !> `store_single` or `store_double`
      integer, intent(in) :: storage
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error
      !> Where the rows of this rank go
      type(hyperslab_type), intent(in), optional :: slab

      call self%write_all(name, numbers_type(c_loc(values), shape(values), is_real, storage), &
         & error, slab)
   end subroutine write_real_list

   !> Dataset of a table of reals
   subroutine write_real_table(self, name, values, storage, error, slab)
      !> The file
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      real(wp), intent(in), target, contiguous :: values(:, :)
      !> `store_single` or `store_double`
      integer, intent(in) :: storage
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error
      !> Where the rows of this rank go
      type(hyperslab_type), intent(in), optional :: slab

      call self%write_all(name, numbers_type(c_loc(values), shape(values), is_real, storage), &
         & error, slab)
   end subroutine write_real_table

   !> Dataset of the characters of a text, which is the same on all ranks
   subroutine write_bytes(self, name, content, error)
      !> The file
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      character(*), intent(in), target :: content
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      call self%write_all(name, numbers_type(c_loc(content), [len(content)], is_byte, store_byte), &
         & error)
   end subroutine write_bytes

   !> Make sure of room, and write a dataset
   subroutine write_all(self, name, numbers, error, slab)
      class(hdf5_output_type), intent(inout) :: self
      character(*), intent(in) :: name
      !> What this rank writes
      type(numbers_type), intent(in) :: numbers
      type(error_type), allocatable, intent(out) :: error
      !> Where it goes
      type(hyperslab_type), intent(in), optional :: slab

      !> Most bytes of a number
      integer(int64), parameter :: most_bytes = 8
      integer :: whole(size(numbers%extent))
      logical :: good
      type(dataset_layout_type) :: room

      whole(:) = extent_of_all(numbers, slab)
      call self%reserve(most_bytes*product(int(whole, int64)), error)
      if (allocated(error)) return
      good = .true.
      if (self%is_alone() .or. .not. present(slab)) then
         if (self%is_root()) call write_dataset(self%handle, name, numbers, good)
      else
         if (self%is_root()) call make_dataset(self%handle, name, whole, numbers%storage, room, &
            & good)
         call self%confirm(good, name, error)
         if (allocated(error)) return
         call self%bring(numbers, slab, room, good)
      end if
      call self%confirm(good, name, error)
   end subroutine write_all

   !> Add rows to a dataset for which there is room
   subroutine append_all(self, name, numbers, error, slab)
      class(hdf5_output_type), intent(inout) :: self
      character(*), intent(in) :: name
      !> What this rank adds
      type(numbers_type), intent(in) :: numbers
      type(error_type), allocatable, intent(out) :: error
      !> Where it goes among the rows that all ranks add
      type(hyperslab_type), intent(in), optional :: slab

      logical :: good
      type(dataset_layout_type) :: room

      good = .true.
      if (self%is_alone() .or. .not. present(slab)) then
         if (self%is_root()) call append_rows(self%handle, name, numbers, good)
      else
         if (self%is_root()) call add_rows(self%handle, name, extent_of_all(numbers, slab), room, &
            & good)
         call self%confirm(good, name, error)
         if (allocated(error)) return
         call self%bring(numbers, slab, room, good)
      end if
      call self%confirm(good, name, error)
   end subroutine append_all

   !> Extent of what all ranks write together
   pure function extent_of_all(numbers, slab) result(whole)
      type(numbers_type), intent(in) :: numbers
      type(hyperslab_type), intent(in), optional :: slab
      integer :: whole(size(numbers%extent))

      whole(:) = numbers%extent
      if (present(slab)) whole(size(whole)) = slab%whole*slab%levels
   end function extent_of_all

   !> Make a dataset of no rows to which rows can be added
   subroutine make_series(self, name, width, rows_per_chunk, storage, error)
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
      !> Why it could not be made
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      self%series = self%series + 1
      good = .true.
      if (self%is_root()) call create_series(self%handle, name, width, max(1, rows_per_chunk), &
         & storage, good)
      call self%confirm(good, name, error)
   end subroutine make_series

   !> Make sure of room for an entry in all datasets that grow, the same number of rows each time
   subroutine reserve_rows(self, bytes, entry, error)
      !> The file
      class(hdf5_output_type), intent(inout) :: self
      !> Bytes of the rows of all ranks
      integer(int64), intent(in) :: bytes
      !> Entries before it
      integer, intent(in) :: entry
      !> The disk is full
      type(error_type), allocatable, intent(out) :: error

      integer(int64) :: index_bytes

      ! each index gets its first node, and two more when that is full and split
      index_bytes = 0
      if (mod(entry, half_index) == 0) index_bytes = merge(1, 2, entry == 0)*self%series*node_bytes
      call self%reserve(bytes + index_bytes, error)
   end subroutine reserve_rows

   !> Add long integers: a list of whole rows
   subroutine append_longs(self, name, values, error, slab)
      !> The file
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to add
      integer(int64), intent(in), target, contiguous :: values(:)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error
      !> Where the rows of this rank go
      type(hyperslab_type), intent(in), optional :: slab

      call self%append_all(name, numbers_type(c_loc(values), shape(values), is_long, store_long), &
         & error, slab)
   end subroutine append_longs

   !> Add reals: a list of whole rows
   subroutine append_reals(self, name, values, error, slab)
      !> The file
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to add
      real(wp), intent(in), target, contiguous :: values(:)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error
      !> Where the rows of this rank go
      type(hyperslab_type), intent(in), optional :: slab

      call self%append_all(name, numbers_type(c_loc(values), shape(values), is_real, &
         & store_double), error, slab)
   end subroutine append_reals

   !> Add rows of reals
   subroutine append_real_rows(self, name, values, error, slab)
      !> The file
      class(hdf5_output_type), intent(inout) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to add, (width, rows)
      real(wp), intent(in), target, contiguous :: values(:, :)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error
      !> Where the rows of this rank go
      type(hyperslab_type), intent(in), optional :: slab

      call self%append_all(name, numbers_type(c_loc(values), shape(values), is_real, &
         & store_double), error, slab)
   end subroutine append_real_rows

end module plydyn_io_hdf5_output
