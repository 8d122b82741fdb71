!> VTKHDF 2.0: an unstructured grid that is fixed, with fields that change from state to state.
!>
!> Read by ParaView and by `vtkHDFReader` of VTK 9.3 and later. Points and times are stored in
!> double precision, fields in single precision: they are looked at, not computed with. What does
!> not change is stored once; each state adds its point data, then its time, and last it is
!> counted, so that a file whose run was killed shows every state that was ended. The file is made
!> under a name of its own and gets its place when all that comes before the first state is there.
!> A restart copies the states that it goes on from: a file whose run was killed can be read, but
!> what was not flushed is half there, and writing to it again would not be safe.
!>
!> Several ranks write one file together: each gives the rows that it said it has, and all come to
!> every procedure. Symmetric tensors have VTK's order XX YY ZZ XY YZ XZ; the caller sorts them.
module plydyn_io_vtkhdf_vtkhdf
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_output, fail
   use plydyn_base_precision, only : wp
   use plydyn_io_hdf5_input, only : hdf5_input_type
   use plydyn_io_hdf5_output, only : hdf5_output_type, hyperslab_type, store_double, &
      & store_integer, store_single
   use plydyn_io_vtkhdf_layout, only : add_state, cell_data, cell_data_offsets, copy_states, &
      & count_states, make_groups, make_list, make_steps, own_group, piece_type, point_data, &
      & point_data_offsets, states_group, write_grid
   use plydyn_state_file_positions, only : file_position_type, file_positions_type
   use plydyn_io_csv_text_file, only : try_text
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   public :: hyperslab_type, piece_type

   !> Longest name of a field
   integer, parameter :: field_name_length = 32

   !> Behind the name of a file that is not in its place yet
   character(*), parameter :: in_the_making = ".part"

   !> A file of states being written
   type, public, extends(hdf5_output_type) :: vtkhdf_type
      private
      !> Its path in the end
      character(:), allocatable :: place
      !> Rows of the points and of the cells of this rank
      type(hyperslab_type) :: points, cells
      !> States that are complete
      integer :: states = 0
      !> Names of the fields on the cells
      character(field_name_length), allocatable :: cell_fields(:)
      !> Names of the fields on the points, and values per point of each
      character(field_name_length), allocatable :: fields(:)
      integer, allocatable :: components(:)
   contains
      procedure :: create_grid
      procedure :: describe
      procedure :: add_table
      !> Fields on the cells that never change; before the first state
      generic :: add_cell_data => add_cell_integers, add_cell_reals, add_cell_vectors
      procedure :: declare_point_data
      procedure :: put_in_place
      procedure :: write_point_data
      procedure :: end_step
      procedure :: mark
      procedure, private :: add_cell_integers, add_cell_reals, add_cell_vectors
   end type vtkhdf_type

   !> Most points whose values lie together in the file
   integer, parameter :: points_per_chunk = 2**24

   !> Characters of the name of a list of offsets
   integer, parameter :: list_length = len(point_data_offsets) + field_name_length

contains

   !> Points of the grid
   pure integer(int64) function all_points(self)
      class(vtkhdf_type), intent(in) :: self

      all_points = int(self%points%whole, int64)*self%points%levels
   end function all_points

   !> Announce a field on the points: every state must have it
   subroutine declare_point_data(self, name, components)
      class(vtkhdf_type), intent(inout) :: self
      !> Name of the field
      character(*), intent(in) :: name
      !> Values per point: 1, 3 for a vector, 6 for a symmetric tensor
      integer, intent(in) :: components

      self%fields = [character(field_name_length) :: self%fields, name]
      self%components = [self%components, components]
      call make_list(self, point_data_offsets//name, 0)
      call self%make_series(point_data//name, merge(components, 0, components > 1), &
         & int(min(all_points(self), int(points_per_chunk, int64))), store_single)
   end subroutine declare_point_data

   !> Put the file in its place, once all fields are declared
   subroutine put_in_place(self, positions, error)
      class(vtkhdf_type), intent(inout) :: self
      !> Where to go on with files of an earlier run: their states are taken over
      type(file_positions_type), intent(in) :: positions
      !> Why the file could not be put there
      type(error_type), allocatable, intent(out) :: error

      type(file_position_type) :: position

      position = positions%at(self%place)
      if (position%amount >= 0) then
         self%states = int(position%amount)
         call take_over(self, error)
         if (allocated(error)) return
         call count_states(self, self%states)
      end if
      call self%flush(error)
      if (.not. allocated(error)) call self%rename(self%place, error)
   end subroutine put_in_place

   !> Copy the states of an earlier run from the file that is in the place
   subroutine take_over(self, error)
      class(vtkhdf_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      type(hdf5_input_type) :: other
      logical :: good

      good = .true.
      if (self%writes()) then
         call other%open(self%place, good)
         if (good) call copy_all(self, other, good)
         call other%close()
      end if
      if (.not. good) call fail(error, exit_output, "cannot go on with "//self%place//": it must " &
         & //"be there with the fields of this deck and all states that it had when the restart " &
         & //"file was written")
      call self%comm%broadcast(error)
   end subroutine take_over

   !> Copy the states from another file, which is open on the root
   subroutine copy_all(self, other, good)
      class(vtkhdf_type), intent(inout) :: self
      type(hdf5_input_type), intent(in) :: other
      !> Whether it has them
      logical, intent(out) :: good

      integer :: found, i

      call other%read_number(states_group, "NSteps", found, good)
      if (good) good = found >= self%states
      do i = 1, size(self%fields)
         if (good) call self%copy_rows(point_data//trim(self%fields(i)), self%components(i), &
            & self%states*all_points(self), other, good)
      end do
      if (good) call copy_states(self, self%states, offset_lists(self), other, good)
   end subroutine copy_all

   !> Names of the lists of offsets of all fields, those on the cells first
   pure function offset_lists(self) result(lists)
      class(vtkhdf_type), intent(in) :: self
      character(list_length), allocatable :: lists(:)
      integer :: i

      lists = [character(list_length) :: (cell_data_offsets//self%cell_fields(i), &
         & i=1, size(self%cell_fields)), (point_data_offsets//self%fields(i), &
         & i=1, size(self%fields))]
   end function offset_lists

   !> The values of a declared field in this state
   subroutine write_point_data(self, name, values)
      class(vtkhdf_type), intent(inout) :: self
      !> Name of a declared field
      character(*), intent(in) :: name
      !> Values, (components, points)
      real(wp), intent(in), contiguous :: values(:, :)

      call self%append(point_data//name, shape(values), values, self%points)
   end subroutine write_point_data

   !> End a state with all declared fields: when this returns, the state is in the file whatever
   !> happens to the process
   subroutine end_step(self, time, error)
      class(vtkhdf_type), intent(inout) :: self
      !> Time of the state
      real(wp), intent(in) :: time
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      ! fields on the cells are written once
      call add_state(self, time, offset_lists(self), [spread(0_int64, 1, &
         & size(self%cell_fields)), spread(self%states*all_points(self), 1, size(self%fields))])
      call self%flush(error)
      if (allocated(error)) return
      call count_states(self, self%states + 1)
      call self%flush(error)
      if (.not. allocated(error)) self%states = self%states + 1
   end subroutine end_step

   !> Put all states on the disk, and note how many there are
   subroutine mark(self, positions, error)
      class(vtkhdf_type), intent(inout) :: self
      !> Places in all files
      type(file_positions_type), intent(inout) :: positions
      !> Why they are not all there
      type(error_type), allocatable, intent(out) :: error

      if (.not. self%is_open()) return
      call self%flush(error)
      if (.not. allocated(error)) call self%secure(error)
      if (.not. allocated(error)) call positions%add(self%place, &
         & file_position_type(amount=int(self%states, int64)))
   end subroutine mark

   !> Create the file with its grid, under a name of its own
   subroutine create_grid(self, path, comm, piece, error)
      class(vtkhdf_type), intent(inout) :: self
      !> Path of the file; a file that was there is replaced
      character(*), intent(in) :: path
      !> The ranks that write it together
      type(comm_type), intent(in) :: comm
      !> The grid, or the part of it that this rank writes
      type(piece_type), intent(in) :: piece
      !> Why the file could not be created
      type(error_type), allocatable, intent(out) :: error

      logical :: exists

      self%place = trim(path)
      self%points = piece%points
      self%cells = piece%cells
      self%states = 0
      self%cell_fields = [character(field_name_length) ::]
      self%fields = [character(field_name_length) ::]
      self%components = [integer ::]
      ! what is there already must be a file that can be replaced
      inquire (file=self%place, exist=exists)
      if (exists .and. comm%is_root()) call try_text(self%place, error)
      call comm%broadcast(error)
      if (.not. allocated(error)) call self%create(self%place//in_the_making, comm, error)
      if (allocated(error)) return
      call make_groups(self)
      call write_grid(self, piece)
      call make_steps(self)
   end subroutine create_grid

   !> Say something about the file: an attribute of the group /plydyn, such as title or length
   subroutine describe(self, name, value)
      class(vtkhdf_type), intent(inout) :: self
      !> Name of the attribute, and its text
      character(*), intent(in) :: name, value

      call self%write_text(own_group, name, value)
   end subroutine describe

   !> Add a table to the group /plydyn, with the names of its columns as the attribute `columns`
   subroutine add_table(self, name, columns, values)
      class(vtkhdf_type), intent(inout) :: self
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
      call self%write_values(own_group//"/"//name, shape(values), values, store_double)
      call self%write_text(own_group//"/"//name, "columns", head)
   end subroutine add_table

   !> A number per cell
   subroutine add_cell_integers(self, name, values)
      class(vtkhdf_type), intent(inout) :: self
      !> Name of the field
      character(*), intent(in) :: name
      !> Values, (cells)
      integer, intent(in) :: values(:)

      call add_cell_field(self, name, shape(values), real(values, wp), store_integer)
   end subroutine add_cell_integers

   !> A real per cell
   subroutine add_cell_reals(self, name, values)
      class(vtkhdf_type), intent(inout) :: self
      !> Name of the field
      character(*), intent(in) :: name
      !> Values, (cells)
      real(wp), intent(in), contiguous :: values(:)

      call add_cell_field(self, name, shape(values), values, store_single)
   end subroutine add_cell_reals

   !> Several reals per cell
   subroutine add_cell_vectors(self, name, values)
      class(vtkhdf_type), intent(inout) :: self
      !> Name of the field
      character(*), intent(in) :: name
      !> Values, (components, cells)
      real(wp), intent(in), contiguous :: values(:, :)

      call add_cell_field(self, name, shape(values), values, store_single)
   end subroutine add_cell_vectors

   !> A field on the cells: it has a list of offsets as well
   subroutine add_cell_field(self, name, extent, values, storage)
      class(vtkhdf_type), intent(inout) :: self
      character(*), intent(in) :: name
      integer, intent(in) :: extent(:), storage
      real(wp), intent(in) :: values(product(extent))

      self%cell_fields = [character(field_name_length) :: self%cell_fields, name]
      call make_list(self, cell_data_offsets//name, 0)
      call self%write_values(cell_data//name, extent, values, storage, self%cells)
   end subroutine add_cell_field

end module plydyn_io_vtkhdf_vtkhdf
