!> VTKHDF 2.0: an unstructured grid that stands still, and what never changes on it.
!>
!> `plydyn_io_vtkhdf_vtkhdf` adds the fields that change from state to state.
module plydyn_io_vtkhdf_unstructured_grid
   use plydyn_base_error, only : error_type, exit_output, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_io_hdf5_output, only : hdf5_output_type, hyperslab_type, store_double, &
      & store_integer, store_single
   use plydyn_io_csv_text_file, only : try_text
   use plydyn_io_vtkhdf_layout, only : cell_data, cell_data_offsets, make_groups, &
      & make_offsets, make_steps, own_group, piece_type, write_grid
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
      procedure :: refuse
      procedure, private :: add_cell_integers, add_cell_reals, add_cell_vectors, note_cell_data
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
      call check_piece(self, piece, error)
      if (allocated(error)) return
      ! what is there already must be a file that can be replaced
      inquire (file=self%path, exist=exists)
      if (exists .and. comm%is_root()) call try_text(self%path, error)
      call comm%broadcast(error)
      if (allocated(error)) return
      call self%file%create(self%path//in_the_making, comm, error)
      if (allocated(error)) return
      call make_groups(self%file, error)
      if (allocated(error)) return
      call write_grid(self%file, piece, error)
      if (allocated(error)) return
      call make_steps(self%file, error)
      if (allocated(error)) return
      call self%file%flush(error)
   end subroutine create

   !> Refuse a grid whose lists do not fit each other
   subroutine check_piece(self, piece, error)
      class(grid_file_type), intent(in) :: self
      type(piece_type), intent(in) :: piece
      type(error_type), allocatable, intent(out) :: error

      integer :: cells

      associate (last => piece%cells%first + piece%cells%count == piece%cells%whole)
         cells = size(piece%kind) + merge(1, 0, last .and. piece%cells%count > 0)
      end associate
      if (size(piece%position, 1) == 3 .and. size(piece%offset) == cells) return
      call self%refuse("the grid must have 3 coordinates per point, one offset per cell and one " &
         & //"more", error)
   end subroutine check_piece

   !> True between `create` and `close`
   pure logical function is_open(self)
      class(grid_file_type), intent(in) :: self

      is_open = self%file%is_open()
   end function is_open

   !> Say something about the file: an attribute of the group /plydyn, such as title or length
   subroutine describe(self, name, value, error)
      class(grid_file_type), intent(inout) :: self
      !> Name of the attribute
      character(*), intent(in) :: name
      !> Its text
      character(*), intent(in) :: value
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      call self%file%write_text(own_group, name, value, error)
   end subroutine describe

   !> Add a table to the group /plydyn, with the names of its columns as the attribute `columns`
   subroutine add_table(self, name, columns, values, error)
      class(grid_file_type), intent(inout) :: self
      !> Name of the dataset
      character(*), intent(in) :: name
      !> Names of the columns; written with commas between them
      character(*), intent(in) :: columns(:)
      !> Numbers, (columns, rows)
      real(wp), intent(in), contiguous :: values(:, :)
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: head
      integer :: i

      if (size(columns) /= size(values, 1) .or. size(columns) == 0) then
         call self%refuse("table "//name//" must have a name for each column", error)
         return
      end if
      head = trim(columns(1))
      do i = 2, size(columns)
         head = head//","//trim(columns(i))
      end do
      call self%file%write_values(own_group//"/"//name, values, store_double, error)
      if (allocated(error)) return
      call self%file%write_text(own_group//"/"//name, "columns", head, error)
   end subroutine add_table

   !> A number per cell
   subroutine add_cell_integers(self, name, values, error)
      class(grid_file_type), intent(inout) :: self
      !> Name of the field
      character(*), intent(in) :: name
      !> Values, (cells)
      integer, intent(in), contiguous :: values(:)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error

      call self%note_cell_data(name, size(values), error)
      if (allocated(error)) return
      call self%file%write_values(cell_data//name, values, store_integer, error, self%cells)
   end subroutine add_cell_integers

   !> A real per cell
   subroutine add_cell_reals(self, name, values, error)
      class(grid_file_type), intent(inout) :: self
      !> Name of the field
      character(*), intent(in) :: name
      !> Values, (cells)
      real(wp), intent(in), contiguous :: values(:)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error

      call self%note_cell_data(name, size(values), error)
      if (allocated(error)) return
      call self%file%write_values(cell_data//name, values, store_single, error, self%cells)
   end subroutine add_cell_reals

   !> Several reals per cell
   subroutine add_cell_vectors(self, name, values, error)
      class(grid_file_type), intent(inout) :: self
      !> Name of the field
      character(*), intent(in) :: name
      !> Values, (components, cells)
      real(wp), intent(in), contiguous :: values(:, :)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error

      call self%note_cell_data(name, size(values, 2), error)
      if (allocated(error)) return
      call self%file%write_values(cell_data//name, values, store_single, error, self%cells)
   end subroutine add_cell_vectors

   !> Note a field on the cells: it has a list of offsets as well
   subroutine note_cell_data(self, name, cells, error)
      class(grid_file_type), intent(inout) :: self
      character(*), intent(in) :: name
      !> Cells that the values are for
      integer, intent(in) :: cells
      type(error_type), allocatable, intent(out) :: error

      if (self%states > 0 .or. cells /= self%cells%count) then
         call self%refuse("cell data "//name//" must come before the first state, with a value " &
            & //"for each of "//text(self%cells%count)//" cells", error)
         return
      end if
      self%cell_fields = [character(field_name_length) :: self%cell_fields, name]
      call make_offsets(self%file, cell_data_offsets//name, error)
   end subroutine note_cell_data

   !> Refuse what does not fit the file
   subroutine refuse(self, what, error)
      class(grid_file_type), intent(in) :: self
      !> What must be
      character(*), intent(in) :: what
      type(error_type), allocatable, intent(out) :: error

      call fail(error, exit_output, self%path//": "//what)
   end subroutine refuse

end module plydyn_io_vtkhdf_unstructured_grid
