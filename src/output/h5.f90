!> A file of HDF5 being written: groups, attributes, whole datasets and datasets that grow.
!>
!> Files have the earliest format of the library, so that a file whose run was killed opens again
!> with all that was flushed, and no lock, so that a running job can be looked at. Objects inside
!> a file are named by their path, such as `VTKHDF/Steps/Values`. Arrays keep the order of their
!> memory: `values(components, rows)` here is a table of rows by components for C and Python.
module plydyn_output_h5
   use, intrinsic :: iso_c_binding, only : c_loc
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_output, fail
   use plydyn_base_files, only : rename_file
   use plydyn_base_precision, only : wp
   use plydyn_output_h5_raw, only : append_rows, close_file, create_file, create_group, &
      & create_series, flush_file, hid_t, is_integer, is_long, is_real, numbers_type, &
      & store_byte, store_double, store_integer, store_long, store_single, write_attribute, &
      & write_dataset, write_text_attribute
   use plydyn_output_text_file, only : try_text
   implicit none
   private

   public :: store_byte, store_double, store_integer, store_long, store_single

   !> A handle that the library refuses
   integer(hid_t), parameter :: no_file = -1_hid_t

   !> A file being written
   type, public :: h5_file_type
      private
      !> Path of the file
      character(:), allocatable :: path
      !> Handle of the file
      integer(hid_t) :: id = no_file
      !> True between `create` and `close` or the first failure
      logical :: opened = .false.
   contains
      procedure :: create
      procedure :: is_open
      procedure :: rename
      procedure :: make_group
      procedure :: write_text
      !> Give an object of the file an attribute of numbers, or give it anew with the same shape
      generic :: write_number => write_integer, write_integers, write_real
      !> Write a dataset whole
      generic :: write_values => write_integer_list, write_integer_table, write_real_list, &
         & write_real_table
      procedure :: make_series
      !> Add rows to a dataset made by `make_series`
      generic :: append => append_longs, append_reals, append_real_rows
      procedure :: flush => flush_all
      procedure :: close => close_whole
      procedure, private :: write_integer, write_integers, write_real, write_integer_list, &
         & write_integer_table, write_real_list, write_real_table, append_longs, append_reals, &
         & append_real_rows, confirm
   end type h5_file_type

contains

   !> Create the file, in place of one that was there
   subroutine create(this, path, error)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the file; its folder must exist
      character(*), intent(in) :: path
      !> Why the file could not be created
      type(error_type), allocatable, intent(out) :: error

      this%path = trim(path)
      call try_text(this%path, error)
      if (allocated(error)) return
      call create_file(this%path, this%id, this%opened)
      call this%confirm(this%opened, "the file", error)
   end subroutine create

   !> True between `create` and `close` or the first failure
   pure logical function is_open(this)
      class(h5_file_type), intent(in) :: this

      is_open = this%opened
   end function is_open

   !> Give the file another name, in place of a file that has it
   subroutine rename(this, path, error)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Its new path, on the same disk
      character(*), intent(in) :: path
      !> Why it keeps its name
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      call rename_file(this%path, path, good)
      if (good) then
         this%path = path
      else
         call fail(error, exit_output, "cannot rename "//this%path//" to "//path)
      end if
   end subroutine rename

   !> Make a group
   subroutine make_group(this, name, error)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the group in the file; the groups above it must exist
      character(*), intent(in) :: name
      !> Why it could not be made
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      call create_group(this%id, name, good)
      call this%confirm(good, name, error)
   end subroutine make_group

   !> Attribute of text, of exactly its length; trailing blanks are left out
   subroutine write_text(this, place, name, value, error)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the group or dataset that gets the attribute
      character(*), intent(in) :: place
      !> Name of the attribute
      character(*), intent(in) :: name
      !> Its value
      character(*), intent(in) :: value
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      ! the library has no text without length: a single null reads as none
      if (len_trim(value) > 0) then
         call write_text_attribute(this%id, place, name, trim(value), good)
      else
         call write_text_attribute(this%id, place, name, achar(0), good)
      end if
      call this%confirm(good, place//"/"//name, error)
   end subroutine write_text

   !> Attribute of one integer
   subroutine write_integer(this, place, name, value, error)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the group or dataset that gets the attribute
      character(*), intent(in) :: place
      !> Name of the attribute
      character(*), intent(in) :: name
      !> Its value
      integer, intent(in), target :: value
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      call write_attribute(this%id, place, name, &
         & numbers_type(c_loc(value), [integer ::], is_integer, store_long), good)
      call this%confirm(good, place//"/"//name, error)
   end subroutine write_integer

   !> Attribute of several integers
   subroutine write_integers(this, place, name, value, error)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the group or dataset that gets the attribute
      character(*), intent(in) :: place
      !> Name of the attribute
      character(*), intent(in) :: name
      !> Its value
      integer, intent(in), target, contiguous :: value(:)
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      call write_attribute(this%id, place, name, &
         & numbers_type(c_loc(value), shape(value), is_integer, store_long), good)
      call this%confirm(good, place//"/"//name, error)
   end subroutine write_integers

   !> Attribute of one real
   subroutine write_real(this, place, name, value, error)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the group or dataset that gets the attribute
      character(*), intent(in) :: place
      !> Name of the attribute
      character(*), intent(in) :: name
      !> Its value
      real(wp), intent(in), target :: value
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      call write_attribute(this%id, place, name, &
         & numbers_type(c_loc(value), [integer ::], is_real, store_double), good)
      call this%confirm(good, place//"/"//name, error)
   end subroutine write_real

   !> Dataset of a list of integers
   subroutine write_integer_list(this, name, values, storage, error)
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

      logical :: good

      call write_dataset(this%id, name, &
         & numbers_type(c_loc(values), shape(values), is_integer, storage), good)
      call this%confirm(good, name, error)
   end subroutine write_integer_list

   !> Dataset of a table of integers
   subroutine write_integer_table(this, name, values, storage, error)
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

      logical :: good

      call write_dataset(this%id, name, &
         & numbers_type(c_loc(values), shape(values), is_integer, storage), good)
      call this%confirm(good, name, error)
   end subroutine write_integer_table

   !> Dataset of a list of reals
   subroutine write_real_list(this, name, values, storage, error)
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

      logical :: good

      call write_dataset(this%id, name, &
         & numbers_type(c_loc(values), shape(values), is_real, storage), good)
      call this%confirm(good, name, error)
   end subroutine write_real_list

   !> Dataset of a table of reals
   subroutine write_real_table(this, name, values, storage, error)
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

      logical :: good

      call write_dataset(this%id, name, &
         & numbers_type(c_loc(values), shape(values), is_real, storage), good)
      call this%confirm(good, name, error)
   end subroutine write_real_table

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

      call create_series(this%id, name, width, max(1, rows_per_chunk), storage, good)
      call this%confirm(good, name, error)
   end subroutine make_series

   !> Add long integers: a list of whole rows
   subroutine append_longs(this, name, values, error)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to add
      integer(int64), intent(in), target, contiguous :: values(:)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      call append_rows(this%id, name, &
         & numbers_type(c_loc(values), shape(values), is_long, store_long), good)
      call this%confirm(good, name, error)
   end subroutine append_longs

   !> Add reals: a list of whole rows
   subroutine append_reals(this, name, values, error)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to add
      real(wp), intent(in), target, contiguous :: values(:)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      call append_rows(this%id, name, &
         & numbers_type(c_loc(values), shape(values), is_real, store_double), good)
      call this%confirm(good, name, error)
   end subroutine append_reals

   !> Add rows of reals
   subroutine append_real_rows(this, name, values, error)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What to add, (width, rows)
      real(wp), intent(in), target, contiguous :: values(:, :)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      call append_rows(this%id, name, &
         & numbers_type(c_loc(values), shape(values), is_real, store_double), good)
      call this%confirm(good, name, error)
   end subroutine append_real_rows

   !> Hand all that was written to the operating system: it outlives a kill of this process
   subroutine flush_all(this, error)
      class(h5_file_type), intent(inout) :: this
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      call flush_file(this%id, good)
      call this%confirm(good, "what is not yet on the disk", error)
   end subroutine flush_all

   !> Write what is left and close the file; nothing happens when it is not open
   subroutine close_whole(this, error)
      class(h5_file_type), intent(inout) :: this
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      if (.not. this%opened) return
      this%opened = .false.
      call close_file(this%id, good)
      call this%confirm(good, "what is not yet on the disk", error)
   end subroutine close_whole

   !> Turn what went wrong into an error
   !>
   !> From then on the file is left alone, as closing it would spoil what was flushed before.
   subroutine confirm(this, good, quantity, error)
      !> The file
      class(h5_file_type), intent(inout) :: this
      !> True when all went well
      logical, intent(in) :: good
      !> What was to be written
      character(*), intent(in) :: quantity
      !> The error, when there is one
      type(error_type), allocatable, intent(out) :: error

      if (good) return
      this%opened = .false.
      this%id = no_file
      call fail(error, exit_output, "cannot write "//quantity//" to "//this%path &
         & //": its disk must have room and be writable")
   end subroutine confirm

end module plydyn_output_h5
