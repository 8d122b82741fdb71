!> Files of HDF5 being written, with errors as values: datasets, and datasets that grow.
!>
!> Arrays keep the order of their memory: `values(components, rows)` here is a table of rows by
!> components for C and Python. Where several ranks write a file, each of them gives the rows that
!> it has, and says by a slab where they go; without a slab all ranks give the same, and the root
!> writes it.
module plydyn_output_h5
   use, intrinsic :: iso_c_binding, only : c_loc
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_output_h5_file, only : h5_base_type
   use plydyn_output_h5_raw_file, only : half_index
   use plydyn_output_h5_raw, only : append_rows, create_series, is_byte, is_integer, is_long, &
      & is_real, numbers_type, slab_type, store_byte, store_double, store_integer, store_long, &
      & store_single, write_dataset
   implicit none
   private

   public :: slab_type, store_byte, store_double, store_integer, store_long, store_single

   !> Bytes of a node in the index of a dataset that grows, and of the first rows of a list
   integer(int64), parameter :: node_bytes = 24*2**10

   !> A file being written
   type, public, extends(h5_base_type) :: h5_file_type
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
         & write_real_table, append_longs, append_reals, append_real_rows, write_all, slab_of
   end type h5_file_type

contains

   !> Dataset of a list of integers
   subroutine write_integer_list(this, name, values, storage, error, slab)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      integer, intent(in), target, contiguous :: values(:)
      !> One of `store_byte`, `store_integer`, `store_long`
      integer, intent(in) :: storage
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error
      !> Where the rows of this rank go
      type(slab_type), intent(in), optional :: slab

      call this%write_all(name, numbers_type(c_loc(values), shape(values), is_integer, storage), &
         & this%slab_of(size(values, 1), slab), error)
   end subroutine write_integer_list

   !> Dataset of a table of integers
   subroutine write_integer_table(this, name, values, storage, error, slab)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      integer, intent(in), target, contiguous :: values(:, :)
      !> One of `store_byte`, `store_integer`, `store_long`
      integer, intent(in) :: storage
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error
      !> Where the rows of this rank go
      type(slab_type), intent(in), optional :: slab

      call this%write_all(name, numbers_type(c_loc(values), shape(values), is_integer, storage), &
         & this%slab_of(size(values, 2), slab), error)
   end subroutine write_integer_table

   !> Dataset of a list of reals
   subroutine write_real_list(this, name, values, storage, error, slab)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      real(wp), intent(in), target, contiguous :: values(:)
      !> `store_single` or `store_double`
      integer, intent(in) :: storage
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error
      !> Where the rows of this rank go
      type(slab_type), intent(in), optional :: slab

      call this%write_all(name, numbers_type(c_loc(values), shape(values), is_real, storage), &
         & this%slab_of(size(values, 1), slab), error)
   end subroutine write_real_list

   !> Dataset of a table of reals
   subroutine write_real_table(this, name, values, storage, error, slab)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      real(wp), intent(in), target, contiguous :: values(:, :)
      !> `store_single` or `store_double`
      integer, intent(in) :: storage
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error
      !> Where the rows of this rank go
      type(slab_type), intent(in), optional :: slab

      call this%write_all(name, numbers_type(c_loc(values), shape(values), is_real, storage), &
         & this%slab_of(size(values, 2), slab), error)
   end subroutine write_real_table

   !> Dataset of the characters of a text, which is the same on all ranks
   subroutine write_bytes(this, name, content, error)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to write
      character(*), intent(in), target :: content
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      call this%write_all(name, numbers_type(c_loc(content), [len(content)], is_byte, store_byte), &
         & this%slab_of(len(content)), error)
   end subroutine write_bytes

   !> Make sure of room, and write a dataset
   subroutine write_all(this, name, numbers, slab, error)
      class(h5_file_type), intent(inout) :: this
      character(*), intent(in) :: name
      !> What this rank writes, and where it goes
      type(numbers_type), intent(in) :: numbers
      type(slab_type), intent(in) :: slab
      type(error_type), allocatable, intent(out) :: error

      !> Most bytes of a number
      integer(int64), parameter :: most_bytes = 8
      integer :: width
      logical :: good

      width = product(numbers%extent(:size(numbers%extent) - 1))
      call this%reserve(most_bytes*width*slab%whole*slab%levels, error)
      if (allocated(error)) return
      call write_dataset(this%handle, name, numbers, slab, good)
      call this%confirm(good, name, error)
   end subroutine write_all

   !> The slab that is asked for, or the one by which the root writes all
   pure type(slab_type) function slab_of(this, rows, slab)
      class(h5_file_type), intent(in) :: this
      !> Rows there are
      integer, intent(in) :: rows
      type(slab_type), intent(in), optional :: slab

      slab_of = slab_type(whole=rows, count=rows)
      if (present(slab)) then
         slab_of = slab
      else if (.not. this%is_root()) then
         slab_of%count = 0
      end if
   end function slab_of

   !> Make a dataset of no rows to which rows can be added
   subroutine make_series(this, name, width, rows_per_chunk, storage, error)
      !> The file
      class(h5_file_type), intent(inout) :: this
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

      this%series = this%series + 1
      call create_series(this%handle, name, width, max(1, rows_per_chunk), storage, good)
      call this%confirm(good, name, error)
   end subroutine make_series

   !> Make sure of room for an entry in all datasets that grow, the same number of rows each time
   subroutine reserve_rows(this, bytes, entry, error)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Bytes of the rows of all ranks
      integer(int64), intent(in) :: bytes
      !> Entries before it
      integer, intent(in) :: entry
      !> The disk is full
      type(error_type), allocatable, intent(out) :: error

      integer(int64) :: index_bytes

      ! each index gets its first node, and two more when that is full and split
      index_bytes = 0
      if (mod(entry, half_index) == 0) index_bytes = merge(1, 2, entry == 0)*this%series*node_bytes
      call this%reserve(bytes + index_bytes, error)
   end subroutine reserve_rows

   !> Add long integers: a list of whole rows
   subroutine append_longs(this, name, values, error, slab)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to add
      integer(int64), intent(in), target, contiguous :: values(:)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error
      !> Where the rows of this rank go
      type(slab_type), intent(in), optional :: slab

      logical :: good

      call append_rows(this%handle, name, numbers_type(c_loc(values), shape(values), is_long, &
         & store_long), this%slab_of(size(values, 1), slab), good)
      call this%confirm(good, name, error)
   end subroutine append_longs

   !> Add reals: a list of whole rows
   subroutine append_reals(this, name, values, error, slab)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to add
      real(wp), intent(in), target, contiguous :: values(:)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error
      !> Where the rows of this rank go
      type(slab_type), intent(in), optional :: slab

      logical :: good

      call append_rows(this%handle, name, numbers_type(c_loc(values), shape(values), is_real, &
         & store_double), this%slab_of(size(values, 1), slab), good)
      call this%confirm(good, name, error)
   end subroutine append_reals

   !> Add rows of reals
   subroutine append_real_rows(this, name, values, error, slab)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to add, (width, rows)
      real(wp), intent(in), target, contiguous :: values(:, :)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error
      !> Where the rows of this rank go
      type(slab_type), intent(in), optional :: slab

      logical :: good

      call append_rows(this%handle, name, numbers_type(c_loc(values), shape(values), is_real, &
         & store_double), this%slab_of(size(values, 2), slab), good)
      call this%confirm(good, name, error)
   end subroutine append_real_rows

end module plydyn_output_h5
