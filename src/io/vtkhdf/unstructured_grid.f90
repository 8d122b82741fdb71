!> VTKHDF 2.0: an unstructured grid that is fixed, and what never changes on it.
!>
!> `plydyn_io_vtkhdf_vtkhdf` adds the fields that change from state to state.
module plydyn_io_vtkhdf_unstructured_grid
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_io_hdf5_output, only : hdf5_output_type, hyperslab_type, store_double, &
      & store_integer, store_single
   use plydyn_io_csv_text_file, only : try_text
   use plydyn_io_vtkhdf_layout, only : cell_data, cell_data_offsets, make_groups, make_list, &
      & make_steps, own_group, piece_type, write_grid
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   !> Longest name of a field
   integer, parameter, public :: field_name_length = 32

   !> Behind the name of a file that is not in its place yet
   character(*), parameter :: in_the_making = ".part"

   !> A file with its grid being written
   type, public :: grid_file_type
      !> The file; for extensions
      type(hdf5_output_type) :: file
      !> Its path in the end
      character(:), allocatable :: path
      !> Rows of the points and of the cells of this rank
      type(hyperslab_type) :: points, cells
      !> States that are complete
      integer :: states = 0
      !> Names of the fields on the cells
      character(field_name_length), allocatable :: cell_fields(:)
   contains
      procedure :: create
      procedure :: is_open
      procedure :: describe
      procedure :: add_table
      !> Fields on the cells that never change; before the first state
      generic :: add_cell_data => add_cell_integers, add_cell_reals, add_cell_vectors
      procedure, private :: add_cell_integers, add_cell_reals, add_cell_vectors
   end type grid_file_type

contains

   !> Create the file with its grid, under a name of its own
   subroutine create(self, path, comm, piece, error)
      !> The file
      class(grid_file_type), intent(inout) :: self
      !> Path of the file; a file that was there is replaced
      character(*), intent(in) :: path
      !> The ranks that write it together
      type(comm_type), intent(in) :: comm
      !> The grid, or the part of it that this rank writes
      type(piece_type), intent(in) :: piece
      !> Why the file could not be created
      type(error_type), allocatable, intent(out) :: error

      logical :: exists

      self%path = trim(path)
      self%points = piece%points
      self%cells = piece%cells
      self%states = 0
      self%cell_fields = [character(field_name_length) ::]
      ! what is there already must be a file that can be replaced
      inquire (file=self%path, exist=exists)
      if (exists .and. comm%is_root()) call try_text(self%path, error)
      call comm%broadcast(error)
      if (allocated(error)) return
      call self%file%create(self%path//in_the_making, comm, error)
      if (allocated(error)) return
      call make_groups(self%file)
      call write_grid(self%file, piece)
      call make_steps(self%file)
   end subroutine create

   !> True between `create` and `close`
   pure logical function is_open(self)
      class(grid_file_type), intent(in) :: self

      is_open = self%file%is_open()
   end function is_open

   !> Say something about the file: an attribute of the group /plydyn, such as title or length
   subroutine describe(self, name, value)
      class(grid_file_type), intent(inout) :: self
      !> Name of the attribute, and its text
      character(*), intent(in) :: name, value

      call self%file%write_text(own_group, name, value)
   end subroutine describe

   !> Add a table to the group /plydyn, with the names of its columns as the attribute `columns`
   subroutine add_table(self, name, columns, values)
      class(grid_file_type), intent(inout) :: self
      !> Name of the dataset
      character(*), intent(in) :: name
      !> Names of the columns
      character(*), intent(in) :: columns(:)
      !> Numbers, (columns, rows)
      real(wp), intent(in), contiguous :: values(:, :)

      character(:), allocatable :: head
      integer :: i

      head = trim(columns(1))
      do i = 2, size(columns)
         head = head//","//trim(columns(i))
      end do
      call self%file%write_values(own_group//"/"//name, values, store_double)
      call self%file%write_text(own_group//"/"//name, "columns", head)
   end subroutine add_table

   !> A number per cell
   subroutine add_cell_integers(self, name, values)
      class(grid_file_type), intent(inout) :: self
      !> Name of the field
      character(*), intent(in) :: name
      !> Values, (cells)
      integer, intent(in) :: values(:)

      call note_cell_data(self, name)
      call self%file%write_values(cell_data//name, values, store_integer, self%cells)
   end subroutine add_cell_integers

   !> A real per cell
   subroutine add_cell_reals(self, name, values)
      class(grid_file_type), intent(inout) :: self
      !> Name of the field
      character(*), intent(in) :: name
      !> Values, (cells)
      real(wp), intent(in), contiguous :: values(:)

      call note_cell_data(self, name)
      call self%file%write_values(cell_data//name, values, store_single, self%cells)
   end subroutine add_cell_reals

   !> Several reals per cell
   subroutine add_cell_vectors(self, name, values)
      class(grid_file_type), intent(inout) :: self
      !> Name of the field
      character(*), intent(in) :: name
      !> Values, (components, cells)
      real(wp), intent(in), contiguous :: values(:, :)

      call note_cell_data(self, name)
      call self%file%write_values(cell_data//name, values, store_single, self%cells)
   end subroutine add_cell_vectors

   !> Note a field on the cells: it has a list of offsets as well
   subroutine note_cell_data(self, name)
      class(grid_file_type), intent(inout) :: self
      character(*), intent(in) :: name

      self%cell_fields = [character(field_name_length) :: self%cell_fields, name]
      call make_list(self%file, cell_data_offsets//name, 0)
   end subroutine note_cell_data

end module plydyn_io_vtkhdf_unstructured_grid
