!> Numbers that are brought to a file: what they are in memory, how they are stored, and where they
!> lie.
module plydyn_io_hdf5_numbers
   use, intrinsic :: iso_c_binding, only : c_ptr
   use, intrinsic :: iso_fortran_env, only : int64
   implicit none
   private

   public :: bytes_of

   !> Kinds of number in memory: default integers, long integers, reals of the working precision,
   !> and characters
   integer, parameter, public :: is_integer = 1, is_long = 2, is_real = 3, is_byte = 4
   !> Ways to store a number in the file, whatever it is in memory
   integer, parameter, public :: store_byte = 1, store_integer = 2, store_long = 3, &
      & store_single = 4, store_double = 5

   !> Where rows lie in a file: as many of them one behind the other as a run has
   type, public :: dataset_layout_type
      !> Bytes of a row, rows of a run, and rows of the first run before the first row
      integer(int64) :: row_bytes = 0, rows_per_run = huge(1), before = 0
      !> Bytes of the file before each run
      integer(int64), allocatable :: start(:)
   contains
      procedure :: place
      procedure :: left
   end type dataset_layout_type

   !> Numbers in memory, and how they are stored
   type, public :: numbers_type
      !> Where they are
      type(c_ptr) :: address
      !> Extent of the array; of no size for a single number
      integer, allocatable :: extent(:)
      !> One of `is_…`
      integer :: number = is_real
      !> One of `store_…`
      integer :: storage = store_double
   end type numbers_type

   !> The rows that a rank has of those that all ranks write: the same ones of each level
   type, public :: hyperslab_type
      !> Rows of a level, and levels
      integer :: whole = 0, levels = 1
      !> Rows of a level before those of this rank, and how many this rank has
      integer :: first = 0, count = 0
   end type hyperslab_type

contains

   !> Bytes of the file before a row
   pure integer(int64) function place(self, row)
      class(dataset_layout_type), intent(in) :: self
      !> The row, from 0
      integer(int64), intent(in) :: row

      associate (behind => self%before + row)
         place = self%start(1 + behind/self%rows_per_run) &
            & + self%row_bytes*mod(behind, self%rows_per_run)
      end associate
   end function place

   !> Rows of the run that a row is in, from it on
   pure integer(int64) function left(self, row)
      class(dataset_layout_type), intent(in) :: self
      !> The row, from 0
      integer(int64), intent(in) :: row

      left = self%rows_per_run - mod(self%before + row, self%rows_per_run)
   end function left

   !> Bytes of a number in the file
   pure integer(int64) function bytes_of(storage)
      !> One of `store_…`
      integer, intent(in) :: storage

      bytes_of = 8
      if (storage == store_byte) bytes_of = 1
      if (storage == store_integer .or. storage == store_single) bytes_of = 4
   end function bytes_of

end module plydyn_io_hdf5_numbers
