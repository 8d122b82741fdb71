!> VTKHDF 2.0: an unstructured grid that stands still, with fields that change from state to state.
!>
!> Read by ParaView and by `vtkHDFReader` of VTK 9.3 and later. Points and times are stored in
!> double precision, fields in single precision: they are looked at, not computed with. What does
!> not change is stored once; each state adds its point data, then its time, and last it is
!> counted, so that a file whose run was killed shows every state that was ended. The file is made
!> under a name of its own and gets its place when all that comes before the first state is there.
!> Symmetric tensors have VTK's order XX YY ZZ XY YZ XZ; the caller sorts them.
module plydyn_output_vtkhdf
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_output, fail
   use plydyn_base_files, only : secure_file
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_output_h5, only : h5_file_type, store_double, store_integer, store_single
   use plydyn_output_places, only : place_type, places_type
   use plydyn_output_text_file, only : try_text
   use plydyn_output_vtkhdf_copy, only : copy_states
   use plydyn_output_vtkhdf_layout, only : add_state, cell_data, cell_data_offsets, make_groups, &
      & make_offsets, make_steps, own_group, point_data, point_data_offsets, write_grid
   implicit none
   private

   !> Longest name of a field
   integer, parameter :: field_name_length = 32

   !> Most points whose values lie together in the file
   integer, parameter :: points_per_chunk = 2**24
   !> A field
   type :: field_type
      !> Name of the field
      character(field_name_length) :: name = ""
      !> Values per point or cell
      integer :: components = 1
      !> True once the state being written has the field
      logical :: written = .false.
   end type field_type

   !> Behind the name of a file that is not in its place yet
   character(*), parameter :: in_the_making = ".part"

   !> A file of states being written
   type, public :: vtkhdf_type
      private
      !> The file
      type(h5_file_type) :: file
      !> Its path, for messages
      character(:), allocatable :: path
      !> Sizes of the grid
      integer :: points = 0, cells = 0
      !> States that are complete
      integer :: states = 0
      !> Time of the state being written
      real(wp) :: time = 0.0_wp
      !> Fields on the points
      type(field_type), allocatable :: fields(:)
      !> Fields on the cells
      type(field_type), allocatable :: cell_fields(:)
   contains
      procedure :: create
      procedure :: is_open
      procedure :: describe
      procedure :: add_table
      !> Fields on the cells that never change; before the first state
      generic :: add_cell_data => add_cell_integers, add_cell_reals, add_cell_vectors
      procedure :: declare_point_data
      procedure :: settle
      procedure :: begin_step
      !> The values of a declared field in this state
      generic :: write_point_data => write_point_reals, write_point_vectors
      procedure :: end_step
      procedure :: mark
      procedure :: close => close_whole
      procedure, private :: add_cell_integers, add_cell_reals, add_cell_vectors, &
         & write_point_reals, write_point_vectors, note_cell_data, take_field, &
         & refuse
   end type vtkhdf_type

contains

   !> Create the file with its grid; `settle` gives it its place
   subroutine create(this, path, points, connectivity, offsets, types, error)
      !> The file
      class(vtkhdf_type), intent(inout) :: this
      !> Path of the file; a file that was there is replaced
      character(*), intent(in) :: path
      !> Places, (3, points)
      real(wp), intent(in), contiguous :: points(:, :)
      !> Points of all cells, one cell after the other, counted from 0
      integer, intent(in), contiguous :: connectivity(:)
      !> Where each cell starts in `connectivity`, from 0, and as last where it ends: cells + 1
      integer, intent(in), contiguous :: offsets(:)
      !> VTK's cell types
      integer, intent(in), contiguous :: types(:)
      !> Why the file could not be created
      type(error_type), allocatable, intent(out) :: error

      logical :: exists

      this%path = trim(path)
      this%points = size(points, 2)
      this%cells = size(types)
      this%states = 0
      this%fields = [field_type ::]
      this%cell_fields = [field_type ::]
      if (size(points, 1) /= 3 .or. size(offsets) /= size(types) + 1) then
         call this%refuse("the grid must have 3 coordinates per point, one offset per cell and " &
            & //"one more", error)
         return
      end if
      ! what is there already must be a file that can be replaced
      inquire (file=this%path, exist=exists)
      if (exists) call try_text(this%path, error)
      if (allocated(error)) return
      call this%file%create(this%path//in_the_making, error)
      if (allocated(error)) return
      call make_groups(this%file, error)
      if (allocated(error)) return
      call write_grid(this%file, points, connectivity, offsets, types, error)
      if (allocated(error)) return
      call make_steps(this%file, error)
      if (allocated(error)) return
      call this%file%flush(error)
   end subroutine create

   !> True between `create` and `close`
   pure logical function is_open(this)
      class(vtkhdf_type), intent(in) :: this

      is_open = this%file%is_open()
   end function is_open

   !> Say something about the file: an attribute of the group /plydyn, such as title or length
   subroutine describe(this, name, value, error)
      class(vtkhdf_type), intent(inout) :: this
      !> Name of the attribute
      character(*), intent(in) :: name
      !> Its text
      character(*), intent(in) :: value
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      call this%file%write_text(own_group, name, value, error)
   end subroutine describe

   !> Add a table to the group /plydyn, with the names of its columns as the attribute `columns`
   subroutine add_table(this, name, columns, values, error)
      class(vtkhdf_type), intent(inout) :: this
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
         call this%refuse("table "//name//" must have a name for each column", error)
         return
      end if
      head = trim(columns(1))
      do i = 2, size(columns)
         head = head//","//trim(columns(i))
      end do
      call this%file%write_values(own_group//"/"//name, values, store_double, error)
      if (allocated(error)) return
      call this%file%write_text(own_group//"/"//name, "columns", head, error)
   end subroutine add_table

   !> A number per cell
   subroutine add_cell_integers(this, name, values, error)
      class(vtkhdf_type), intent(inout) :: this
      !> Name of the field
      character(*), intent(in) :: name
      !> Values, (cells)
      integer, intent(in), contiguous :: values(:)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error

      call this%note_cell_data(name, size(values), error)
      if (allocated(error)) return
      call this%file%write_values(cell_data//name, values, store_integer, error)
   end subroutine add_cell_integers

   !> A real per cell
   subroutine add_cell_reals(this, name, values, error)
      class(vtkhdf_type), intent(inout) :: this
      !> Name of the field
      character(*), intent(in) :: name
      !> Values, (cells)
      real(wp), intent(in), contiguous :: values(:)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error

      call this%note_cell_data(name, size(values), error)
      if (allocated(error)) return
      call this%file%write_values(cell_data//name, values, store_single, error)
   end subroutine add_cell_reals

   !> Several reals per cell
   subroutine add_cell_vectors(this, name, values, error)
      class(vtkhdf_type), intent(inout) :: this
      !> Name of the field
      character(*), intent(in) :: name
      !> Values, (components, cells)
      real(wp), intent(in), contiguous :: values(:, :)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error

      call this%note_cell_data(name, size(values, 2), error)
      if (allocated(error)) return
      call this%file%write_values(cell_data//name, values, store_single, error)
   end subroutine add_cell_vectors

   !> Note a field on the cells: it has a list of offsets as well
   subroutine note_cell_data(this, name, cells, error)
      class(vtkhdf_type), intent(inout) :: this
      character(*), intent(in) :: name
      !> Cells that the values are for
      integer, intent(in) :: cells
      type(error_type), allocatable, intent(out) :: error

      if (this%states > 0 .or. cells /= this%cells) then
         call this%refuse("cell data "//name//" must come before the first state, with a value " &
            & //"for each of "//text(this%cells)//" cells", error)
         return
      end if
      this%cell_fields = [this%cell_fields, field_type(name)]
      call make_offsets(this%file, cell_data_offsets//name, error)
   end subroutine note_cell_data

   !> Announce a field on the points: every state must have it
   subroutine declare_point_data(this, name, components, error)
      !> The file
      class(vtkhdf_type), intent(inout) :: this
      !> Name of the field
      character(*), intent(in) :: name
      !> Values per point: 1, 3 for a vector, 6 for a symmetric tensor
      integer, intent(in) :: components
      !> Why it could not be made
      type(error_type), allocatable, intent(out) :: error

      if (this%states > 0) then
         call this%refuse("point data "//name//" must come before the first state", error)
         return
      end if
      this%fields = [this%fields, field_type(name, components)]
      call make_offsets(this%file, point_data_offsets//name, error)
      if (allocated(error)) return
      call this%file%make_series(point_data//name, merge(components, 0, components > 1), &
         & min(this%points, points_per_chunk), store_single, error)
   end subroutine declare_point_data

   !> Put the file in its place, once all fields are declared
   subroutine settle(this, places, error)
      class(vtkhdf_type), intent(inout) :: this
      !> Where to go on with files of an earlier run: their states are taken over
      type(places_type), intent(in) :: places
      !> Why the file could not be put there
      type(error_type), allocatable, intent(out) :: error

      type(place_type) :: place

      place = places%at(this%path)
      if (place%amount >= 0) then
         this%states = int(place%amount)
         call copy_states(this%path, this%states, this%points, this%fields%name, &
            & this%fields%components, cell_data_offsets//this%cell_fields%name, this%file, error)
         if (allocated(error)) return
      end if
      call this%file%rename(this%path, error)
   end subroutine settle

   !> Begin a state
   subroutine begin_step(this, time)
      class(vtkhdf_type), intent(inout) :: this
      !> Time of the state
      real(wp), intent(in) :: time

      this%time = time
      this%fields(:)%written = .false.
   end subroutine begin_step

   !> A real per point
   subroutine write_point_reals(this, name, values, error)
      !> The file
      class(vtkhdf_type), intent(inout) :: this
      !> Name of a declared field
      character(*), intent(in) :: name
      !> Values, (points)
      real(wp), intent(in), contiguous :: values(:)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error

      call this%take_field(name, [1, size(values)], error)
      if (allocated(error)) return
      call this%file%append(point_data//name, values, error)
   end subroutine write_point_reals

   !> Several reals per point
   subroutine write_point_vectors(this, name, values, error)
      !> The file
      class(vtkhdf_type), intent(inout) :: this
      !> Name of a declared field
      character(*), intent(in) :: name
      !> Values, (components, points)
      real(wp), intent(in), contiguous :: values(:, :)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error

      call this%take_field(name, shape(values), error)
      if (allocated(error)) return
      call this%file%append(point_data//name, values, error)
   end subroutine write_point_vectors

   !> Check that a field belongs to this state, has its shape and comes once
   subroutine take_field(this, name, extent, error)
      class(vtkhdf_type), intent(inout) :: this
      character(*), intent(in) :: name
      !> Components and points
      integer, intent(in) :: extent(2)
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(this%fields)
         associate (field => this%fields(i))
            if (field%name /= name) cycle
            if (field%written .or. any(extent /= [field%components, this%points])) exit
            field%written = .true.
            return
         end associate
      end do
      call this%refuse("point data "//name//" must be declared, and written once per state with " &
         & //"the components declared for each of "//text(this%points)//" points", error)
   end subroutine take_field

   !> End a state: when this returns, the state is in the file whatever happens to the process
   subroutine end_step(this, error)
      !> The file
      class(vtkhdf_type), intent(inout) :: this
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      if (.not. all(this%fields%written)) then
         call this%refuse("state "//text(this%states + 1)//" lacks a declared field", error)
         return
      end if
      call add_state(this%file, this%states + 1, this%time, &
         & point_data_offsets//this%fields%name, int(this%states, int64)*this%points, &
         & cell_data_offsets//this%cell_fields%name, error)
      if (allocated(error)) return
      this%states = this%states + 1
   end subroutine end_step

   !> Put all states on the disk, and note how many there are
   subroutine mark(this, places, error)
      class(vtkhdf_type), intent(inout) :: this
      !> Places in all files
      type(places_type), intent(inout) :: places
      !> Why they are not all there
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      if (.not. this%is_open()) return
      call this%file%flush(error)
      if (allocated(error)) return
      call secure_file(this%path, good)
      if (good) then
         call places%add(this%path, place_type(amount=int(this%states, int64)))
      else
         call fail(error, exit_output, "cannot bring "//this%path//" to its disk")
      end if
   end subroutine mark

   !> Close the file; nothing happens when it is not open
   subroutine close_whole(this, error)
      class(vtkhdf_type), intent(inout) :: this
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      call this%file%close(error)
   end subroutine close_whole

   !> Refuse what does not fit the file
   subroutine refuse(this, what, error)
      class(vtkhdf_type), intent(in) :: this
      !> What must be
      character(*), intent(in) :: what
      type(error_type), allocatable, intent(out) :: error

      call fail(error, exit_output, this%path//": "//what)
   end subroutine refuse

end module plydyn_output_vtkhdf
