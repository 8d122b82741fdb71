!> A file of HDF5 being read: datasets whole or by rows, and attributes of the kinds that
!> `plydyn_io_hdf5_output` writes.
module plydyn_io_hdf5_input
   use, intrinsic :: iso_c_binding, only : c_char, c_loc, c_ptr
   use, intrinsic :: iso_fortran_env, only : int64
   use hdf5, only : h5_integer_kind, h5_real_kind, h5aclose_f, h5aget_type_f, h5aopen_f, &
      & h5aread_f, h5dclose_f, h5dget_space_f, h5dopen_f, h5dread_f, h5f_acc_rdonly_f, h5fclose_f, &
      & h5fopen_f, h5kind_to_type, h5lexists_f, h5oclose_f, h5oopen_f, h5pclose_f, &
      & h5s_select_set_f, h5sclose_f, h5screate_simple_f, h5sget_simple_extent_dims_f, &
      & h5sget_simple_extent_ndims_f, h5sselect_hyperslab_f, h5t_std_u8le, h5tclose_f, &
      & h5tget_size_f, hid_t, hsize_t, size_t
   use plydyn_base_precision, only : wp
   use plydyn_io_hdf5_file, only : prepare_access
   implicit none
   private

   public :: select_rows, type_in_memory

   !> Kinds of number in memory: default integers, reals of the working precision, and characters
   integer, parameter, public :: is_integer = 1, is_real = 2, is_byte = 3

   !> A file being read
   type, public :: hdf5_input_type
      private
      !> Handle of the file
      integer(hid_t) :: id = -1_hid_t
   contains
      procedure :: open => open_input
      procedure :: has
      procedure :: extent
      procedure :: read_bytes
      procedure :: read_integers
      procedure :: read_reals
      procedure :: read_rows
      procedure :: read_number
      procedure :: read_text
      procedure :: close => close_input
   end type hdf5_input_type

contains

   !> Open a file
   subroutine open_input(self, path, good)
      class(hdf5_input_type), intent(inout) :: self
      !> Path of the file
      character(*), intent(in) :: path
      !> False when it is not there, no file of HDF5, or not whole
      logical, intent(out) :: good

      integer(hid_t) :: access
      integer :: status(2)

      call prepare_access(access, good)
      call h5fopen_f(path, h5f_acc_rdonly_f, self%id, status(1), access)
      call h5pclose_f(access, status(2))
      good = good .and. all(status >= 0)
   end subroutine open_input

   !> Whether there is a group or dataset
   logical function has(self, name)
      class(hdf5_input_type), intent(in) :: self
      !> Path in the file; the groups above it exist
      character(*), intent(in) :: name

      integer :: status

      call h5lexists_f(self%id, name, has, status)
      has = has .and. status >= 0
   end function has

   !> Numbers in a dataset; negative when there is none
   integer function extent(self, name)
      class(hdf5_input_type), intent(in) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name

      integer(hid_t) :: dataset, space
      integer(hsize_t) :: most(2), rows(2)
      integer :: rank, status(6)

      extent = -1
      call h5dopen_f(self%id, name, dataset, status(1))
      if (status(1) < 0) return
      rank = 0
      status(4) = -1
      rows(:) = 1
      call h5dget_space_f(dataset, space, status(2))
      call h5sget_simple_extent_ndims_f(space, rank, status(3))
      if (rank == 1 .or. rank == 2) call h5sget_simple_extent_dims_f(space, rows, most, status(4))
      call h5sclose_f(space, status(5))
      call h5dclose_f(dataset, status(6))
      if (all(status >= 0) .and. product(rows) <= huge(extent)) extent = int(product(rows))
   end function extent

   !> Read a dataset of characters
   subroutine read_bytes(self, name, content, good)
      class(hdf5_input_type), intent(in) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What is in it
      character(:), allocatable, intent(out), target :: content
      !> True when all went well
      logical, intent(out) :: good

      integer :: length

      length = self%extent(name)
      good = length >= 0
      allocate (character(max(0, length)) :: content)
      if (length > 0) call read_all(self%id, name, is_byte, c_loc(content), good)
   end subroutine read_bytes

   !> Read a dataset of integers
   subroutine read_integers(self, name, values, good)
      class(hdf5_input_type), intent(in) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What is in it, which must be as many as there are
      integer, intent(inout), target, contiguous :: values(:)
      !> True when all went well
      logical, intent(out) :: good

      good = self%extent(name) == size(values)
      if (good .and. size(values) > 0) call read_all(self%id, name, is_integer, c_loc(values), good)
   end subroutine read_integers

   !> Read a dataset of reals
   subroutine read_reals(self, name, values, good)
      class(hdf5_input_type), intent(in) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> What is in it, which must be as many as there are
      real(wp), intent(inout), target, contiguous :: values(:)
      !> True when all went well
      logical, intent(out) :: good

      good = self%extent(name) == size(values)
      if (good .and. size(values) > 0) call read_all(self%id, name, is_real, c_loc(values), good)
   end subroutine read_reals

   !> Read a dataset
   subroutine read_all(id, name, number, address, good)
      integer(hid_t), intent(in) :: id
      character(*), intent(in) :: name
      !> One of `is_…`
      integer, intent(in) :: number
      !> Room for all numbers
      type(c_ptr), intent(in) :: address
      logical, intent(out) :: good

      integer(hid_t) :: dataset
      type(c_ptr) :: buffer
      integer :: status(3)

      buffer = address
      call h5dopen_f(id, name, dataset, status(1))
      call h5dread_f(dataset, type_in_memory(number), buffer, status(2))
      call h5dclose_f(dataset, status(3))
      good = all(status >= 0)
   end subroutine read_all

   !> Read consecutive rows of a table, or numbers of a list
   subroutine read_rows(self, name, before, values, good)
      class(hdf5_input_type), intent(in) :: self
      !> Path of the dataset in the file
      character(*), intent(in) :: name
      !> Rows of the dataset before them
      integer(int64), intent(in) :: before
      !> What is in them, (width, rows); of width 1 for a list
      real(wp), intent(inout), target, contiguous :: values(:, :)
      !> False when there are not as many rows
      logical, intent(out) :: good

      integer(hid_t) :: dataset, memory, space
      integer(hsize_t) :: most(2), rows(2)
      type(c_ptr) :: address
      integer :: rank, status(8)

      good = size(values) == 0
      if (good) return
      call h5dopen_f(self%id, name, dataset, status(1))
      if (status(1) < 0) return
      call h5dget_space_f(dataset, space, status(2))
      call h5sget_simple_extent_ndims_f(space, rank, status(3))
      if (rank < 1 .or. rank > 2) return
      call h5sget_simple_extent_dims_f(space, rows, most, status(4))
      if (size(values, 1) /= product(rows(:rank - 1))) return
      call select_rows(space, before, size(values, 2, int64), memory, status(5))
      if (status(5) < 0) return
      address = c_loc(values)
      call h5dread_f(dataset, type_in_memory(is_real), address, status(6), memory, space)
      call h5sclose_f(memory, status(7))
      call h5sclose_f(space, status(8))
      call h5dclose_f(dataset, status(1))
      good = all(status >= 0)
   end subroutine read_rows

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

   !> Read an attribute of one integer
   subroutine read_number(self, place, name, value, good)
      class(hdf5_input_type), intent(in) :: self
      !> Path of the group or dataset that has the attribute, and name of the attribute
      character(*), intent(in) :: place, name
      !> Its value
      integer, intent(inout), target :: value
      !> True when there is such a number
      logical, intent(out) :: good

      integer(hid_t) :: attribute, object
      type(c_ptr) :: address
      integer :: status(5)

      good = .false.
      call h5oopen_f(self%id, place, object, status(1))
      if (status(1) < 0) return
      call h5aopen_f(object, name, attribute, status(2))
      if (status(2) >= 0) then
         address = c_loc(value)
         call h5aread_f(attribute, type_in_memory(is_integer), address, status(3))
         call h5aclose_f(attribute, status(4))
         good = all(status(3:4) >= 0)
      end if
      call h5oclose_f(object, status(5))
   end subroutine read_number

   !> Read an attribute of text
   subroutine read_text(self, place, name, value, good)
      class(hdf5_input_type), intent(in) :: self
      !> Path of the group or dataset that has the attribute, and name of the attribute
      character(*), intent(in) :: place, name
      !> Its value
      character(:), allocatable, intent(out) :: value
      !> True when there is such a text
      logical, intent(out) :: good

      integer(hid_t) :: attribute, object, string
      integer(size_t) :: length
      character(kind=c_char), allocatable, target :: bytes(:)
      type(c_ptr) :: address
      integer :: status(7)

      good = .false.
      value = ""
      call h5oopen_f(self%id, place, object, status(1))
      if (status(1) < 0) return
      call h5aopen_f(object, name, attribute, status(2))
      if (status(2) >= 0) then
         call h5aget_type_f(attribute, string, status(3))
         call h5tget_size_f(string, length, status(4))
         allocate (bytes(max(1_size_t, length)))
         address = c_loc(bytes)
         call h5aread_f(attribute, string, address, status(5))
         value = transfer(bytes, repeat(" ", size(bytes)))
         call h5tclose_f(string, status(6))
         call h5aclose_f(attribute, status(7))
         good = all(status(3:) >= 0)
         if (value == achar(0)) value = ""
      end if
      call h5oclose_f(object, status(7))
   end subroutine read_text

   !> Close the file; nothing happens when it is not open
   subroutine close_input(self)
      class(hdf5_input_type), intent(inout) :: self

      integer :: status

      if (self%id < 0) return
      call h5fclose_f(self%id, status)
      self%id = -1_hid_t
   end subroutine close_input

end module plydyn_io_hdf5_input
