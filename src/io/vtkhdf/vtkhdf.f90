!> VTKHDF 2.0: an unstructured grid that stands still, with fields that change from state to state.
!>
!> Read by ParaView and by `vtkHDFReader` of VTK 9.3 and later. Points and times are stored in
!> double precision, fields in single precision: they are looked at, not computed with. What does
!> not change is stored once; each state adds its point data, then its time, and last it is
!> counted, so that a file whose run was killed shows every state that was ended. The file is made
!> under a name of its own and gets its place when all that comes before the first state is there.
!> Symmetric tensors have VTK's order XX YY ZZ XY YZ XZ; the caller sorts them.
!>
!> Several ranks write one file together: each gives the rows that it said it has, and all come to
!> every procedure.
module plydyn_io_vtkhdf_vtkhdf
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_output, fail
   use plydyn_base_files, only : secure_file
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_io_hdf5_output, only : hyperslab_type, store_single
   use plydyn_state_file_positions, only : file_position_type, file_positions_type
   use plydyn_io_vtkhdf_copy, only : copy_states
   use plydyn_io_vtkhdf_unstructured_grid, only : field_name_length, grid_file_type
   use plydyn_io_vtkhdf_layout, only : add_state, cell_data_offsets, make_offsets, piece_type, &
      & point_data, point_data_offsets
   implicit none
   private

   public :: piece_type, hyperslab_type

   !> Most points whose values lie together in the file
   integer, parameter :: points_per_chunk = 2**24
   !> Bytes of a value in the file
   integer(int64), parameter :: value_bytes = 4

   !> A field
   type :: field_type
      !> Name of the field
      character(field_name_length) :: name = ""
      !> Values per point
      integer :: components = 1
      !> True once the state being written has the field
      logical :: written = .false.
   end type field_type

   !> A file of states being written
   type, public, extends(grid_file_type) :: vtkhdf_type
      private
      !> Time of the state being written
      real(wp) :: time = 0.0_wp
      !> Fields on the points
      type(field_type), allocatable :: fields(:)
   contains
      procedure :: declare_point_data
      procedure :: settle
      procedure :: begin_step
      !> The values of a declared field in this state
      generic :: write_point_data => write_point_reals, write_point_vectors
      procedure :: end_step
      procedure :: mark
      procedure :: close => close_whole
      procedure, private :: write_point_reals, write_point_vectors, take_field, all_points
   end type vtkhdf_type

contains

   !> Points of the grid
   pure integer function all_points(self)
      class(vtkhdf_type), intent(in) :: self

      all_points = self%points%whole*self%points%levels
   end function all_points

   !> Announce a field on the points: every state must have it
   subroutine declare_point_data(self, name, components, error)
      !> The file
      class(vtkhdf_type), intent(inout) :: self
      !> Name of the field
      character(*), intent(in) :: name
      !> Values per point: 1, 3 for a vector, 6 for a symmetric tensor
      integer, intent(in) :: components
      !> Why it could not be made
      type(error_type), allocatable, intent(out) :: error

      if (self%states > 0) then
         call self%refuse("point data "//name//" must come before the first state", error)
         return
      end if
      if (.not. allocated(self%fields)) allocate (self%fields(0))
      self%fields = [self%fields, field_type(name, components)]
      call make_offsets(self%file, point_data_offsets//name, error)
      if (allocated(error)) return
      call self%file%make_series(point_data//name, merge(components, 0, components > 1), &
         & min(self%all_points(), points_per_chunk), store_single, error)
   end subroutine declare_point_data

   !> Put the file in its place, once all fields are declared
   subroutine settle(self, places, error)
      class(vtkhdf_type), intent(inout) :: self
      !> Where to go on with files of an earlier run: their states are taken over
      type(file_positions_type), intent(in) :: places
      !> Why the file could not be put there
      type(error_type), allocatable, intent(out) :: error

      type(file_position_type) :: place

      if (.not. allocated(self%fields)) allocate (self%fields(0))
      place = places%at(self%path)
      if (place%amount >= 0) then
         self%states = int(place%amount)
         call copy_states(self%path, self%states, self%points, self%fields%name, &
            & self%fields%components, cell_data_offsets//self%cell_fields, self%file, error)
         if (allocated(error)) return
      end if
      call self%file%flush(error)
      if (allocated(error)) return
      call self%file%rename(self%path, error)
   end subroutine settle

   !> Begin a state, if the disk has room for all of it
   subroutine begin_step(self, time, error)
      class(vtkhdf_type), intent(inout) :: self
      !> Time of the state
      real(wp), intent(in) :: time
      !> The disk is full
      type(error_type), allocatable, intent(out) :: error

      self%time = time
      self%fields(:)%written = .false.
      call self%file%reserve_rows(value_bytes*self%all_points()*sum(self%fields%components), &
         & self%states, error)
   end subroutine begin_step

   !> A real per point
   subroutine write_point_reals(self, name, values, error)
      !> The file
      class(vtkhdf_type), intent(inout) :: self
      !> Name of a declared field
      character(*), intent(in) :: name
      !> Values, (points)
      real(wp), intent(in), contiguous :: values(:)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error

      call self%take_field(name, [1, size(values)], error)
      if (allocated(error)) return
      call self%file%append(point_data//name, values, error, self%points)
   end subroutine write_point_reals

   !> Several reals per point
   subroutine write_point_vectors(self, name, values, error)
      !> The file
      class(vtkhdf_type), intent(inout) :: self
      !> Name of a declared field
      character(*), intent(in) :: name
      !> Values, (components, points)
      real(wp), intent(in), contiguous :: values(:, :)
      !> Why they could not be written
      type(error_type), allocatable, intent(out) :: error

      call self%take_field(name, shape(values), error)
      if (allocated(error)) return
      call self%file%append(point_data//name, values, error, self%points)
   end subroutine write_point_vectors

   !> Check that a field belongs to this state, has its shape and comes once
   subroutine take_field(self, name, extent, error)
      class(vtkhdf_type), intent(inout) :: self
      character(*), intent(in) :: name
      !> Components and points
      integer, intent(in) :: extent(2)
      type(error_type), allocatable, intent(out) :: error

      integer :: i, own

      own = self%points%count*self%points%levels
      do i = 1, size(self%fields)
         associate (field => self%fields(i))
            if (field%name /= name) cycle
            if (field%written .or. any(extent /= [field%components, own])) exit
            field%written = .true.
            return
         end associate
      end do
      call self%refuse("point data "//name//" must be declared, and written once per state with " &
         & //"the components declared for each of "//text(own)//" points", error)
   end subroutine take_field

   !> End a state: when this returns, the state is in the file whatever happens to the process
   subroutine end_step(self, error)
      !> The file
      class(vtkhdf_type), intent(inout) :: self
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      if (.not. all(self%fields%written)) then
         call self%refuse("state "//text(self%states + 1)//" lacks a declared field", error)
         return
      end if
      call add_state(self%file, self%states + 1, self%time, &
         & point_data_offsets//self%fields%name, int(self%states, int64)*self%all_points(), &
         & cell_data_offsets//self%cell_fields, error)
      if (allocated(error)) return
      self%states = self%states + 1
   end subroutine end_step

   !> Put all states on the disk, and note how many there are
   subroutine mark(self, places, error)
      class(vtkhdf_type), intent(inout) :: self
      !> Places in all files
      type(file_positions_type), intent(inout) :: places
      !> Why they are not all there
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      if (.not. self%is_open()) return
      call self%file%flush(error)
      if (allocated(error)) return
      good = .true.
      if (self%file%is_root()) call secure_file(self%path, good)
      call self%file%agree(good)
      if (good) then
         call places%add(self%path, file_position_type(amount=int(self%states, int64)))
      else
         call fail(error, exit_output, "cannot bring "//self%path//" to its disk")
      end if
   end subroutine mark

   !> Close the file; nothing happens when it is not open
   subroutine close_whole(self, error)
      class(vtkhdf_type), intent(inout) :: self
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      call self%file%close(error)
   end subroutine close_whole

end module plydyn_io_vtkhdf_vtkhdf
