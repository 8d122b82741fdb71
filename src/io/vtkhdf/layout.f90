!> Where things lie in a VTKHDF file: the groups, the grid, and the lists of states.
module plydyn_io_vtkhdf_layout
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_io_hdf5_output, only : hdf5_output_type, hyperslab_type, store_byte, store_double, &
      & store_long
   implicit none
   private

   public :: make_groups, write_grid, make_steps, make_offsets, add_state

   !> Groups of the fields, and the one of our own
   character(*), parameter, public :: point_data = "VTKHDF/PointData/", &
      & cell_data = "VTKHDF/CellData/", own_group = "plydyn"
   !> Lists of where the fields of each state start
   character(*), parameter, public :: point_data_offsets = "PointDataOffsets/", &
      & cell_data_offsets = "CellDataOffsets/"

   !> Version of the format
   integer, parameter :: format_version(2) = [2, 0]
   !> States whose times lie together in the file
   integer, parameter :: states_per_chunk = 256
   !> Group of the states
   character(*), parameter :: steps = "VTKHDF/Steps/"
   !> List of the times of the states
   character(*), parameter, public :: state_times = steps//"Values"
   !> Lists that are 0 in every state, as the grid stands still, and tables of one column that are
   character(*), parameter :: still_lists(2) = [character(12) :: "PartOffsets", "PointOffsets"]
   character(*), parameter :: still_tables(2) = &
      & [character(21) :: "CellOffsets", "ConnectivityIdOffsets"]

   !> The part of a grid that a rank writes
   type, public :: piece_type
      !> Rows of its points, and of its cells
      type(hyperslab_type) :: points, cells
      !> Numbers before its own in the list of the points of all cells, and in the whole list
      integer :: before = 0, all_ends = 0
      !> Places, (3, points)
      real(wp), allocatable :: position(:, :)
      !> Points of its cells, one cell after the other, counted from 0
      integer, allocatable :: connectivity(:)
      !> Where each of its cells starts in the whole list, from 0; behind the last cell of all also
      !> where that one ends
      integer, allocatable :: offset(:)
      !> VTK's types of its cells
      integer, allocatable :: kind(:)
   end type piece_type

contains

   !> Make all groups
   subroutine make_groups(file, error)
      !> The file, new
      type(hdf5_output_type), intent(inout) :: file
      !> Why they could not be made
      type(error_type), allocatable, intent(out) :: error

      character(*), parameter :: groups(7) = [character(29) :: "VTKHDF", "VTKHDF/PointData", &
         & "VTKHDF/CellData", "VTKHDF/Steps", "VTKHDF/Steps/PointDataOffsets", &
         & "VTKHDF/Steps/CellDataOffsets", own_group]
      integer :: i

      do i = 1, size(groups)
         call file%make_group(trim(groups(i)), error)
         if (allocated(error)) return
      end do
      call file%write_number("VTKHDF", "Version", format_version, error)
      if (allocated(error)) return
      call file%write_text("VTKHDF", "Type", "UnstructuredGrid", error)
   end subroutine make_groups

   !> Write the grid, in one part for whoever reads it
   subroutine write_grid(file, piece, error)
      !> The file
      type(hdf5_output_type), intent(inout) :: file
      !> What this rank writes
      type(piece_type), intent(in) :: piece
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      character(*), parameter :: names(3) = [character(23) :: "NumberOfPoints", &
         & "NumberOfCells", "NumberOfConnectivityIds"]
      integer :: sizes(3), i

      sizes(:) = [piece%points%whole*piece%points%levels, piece%cells%whole, piece%all_ends]
      do i = 1, size(names)
         call file%write_values("VTKHDF/"//trim(names(i)), sizes(i:i), store_long, error)
         if (allocated(error)) return
      end do
      call file%write_values("VTKHDF/Points", piece%position, store_double, error, piece%points)
      if (allocated(error)) return
      call file%write_values("VTKHDF/Connectivity", piece%connectivity, store_long, error, &
         & hyperslab_type(whole=piece%all_ends, first=piece%before, count=size(piece%connectivity)))
      if (allocated(error)) return
      call file%write_values("VTKHDF/Offsets", piece%offset, store_long, error, &
         & hyperslab_type(whole=piece%cells%whole + 1, first=piece%cells%first, &
         & count=size(piece%offset)))
      if (allocated(error)) return
      call file%write_values("VTKHDF/Types", piece%kind, store_byte, error, piece%cells)
   end subroutine write_grid

   !> Make the lists of states, all empty
   subroutine make_steps(file, error)
      !> The file
      type(hdf5_output_type), intent(inout) :: file
      !> Why they could not be made
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      call count_states(file, 0, error)
      if (allocated(error)) return
      call file%make_series(state_times, 0, states_per_chunk, store_double, error)
      if (allocated(error)) return
      call make_offsets(file, "NumberOfParts", error)
      if (allocated(error)) return
      do i = 1, size(still_lists)
         call make_offsets(file, trim(still_lists(i)), error)
         if (allocated(error)) return
         call file%make_series(steps//trim(still_tables(i)), 1, states_per_chunk, store_long, &
            & error)
         if (allocated(error)) return
      end do
   end subroutine make_steps

   !> Make a list with one number per state
   subroutine make_offsets(file, name, error)
      !> The file
      type(hdf5_output_type), intent(inout) :: file
      !> Name of the list in the group of the states
      character(*), intent(in) :: name
      !> Why it could not be made
      type(error_type), allocatable, intent(out) :: error

      call file%make_series(steps//name, 0, states_per_chunk, store_long, error)
   end subroutine make_offsets

   !> Add a state whose data are written: its place, its time, and last its count, so that a
   !> process killed at any moment leaves a file with all states before
   subroutine add_state(file, state, time, moving, start, still, error)
      !> The file
      type(hdf5_output_type), intent(inout) :: file
      !> Number of the state, from 1
      integer, intent(in) :: state
      !> Time of the state
      real(wp), intent(in) :: time
      !> Lists of the fields that are written anew with each state
      character(*), intent(in) :: moving(:)
      !> Row at which these fields start for this state, from 0
      integer(int64), intent(in) :: start
      !> Lists of the fields that are written once
      character(*), intent(in) :: still(:)
      !> Why it could not be added
      type(error_type), allocatable, intent(out) :: error

      call add_number(file, ["NumberOfParts"], 1_int64, error)
      if (allocated(error)) return
      call add_number(file, still_lists, 0_int64, error)
      if (allocated(error)) return
      call add_number(file, still_tables, 0_int64, error)
      if (allocated(error)) return
      call add_number(file, still, 0_int64, error)
      if (allocated(error)) return
      call add_number(file, moving, start, error)
      if (allocated(error)) return
      call file%append(state_times, [time], error)
      if (allocated(error)) return
      call file%flush(error)
      if (allocated(error)) return
      call count_states(file, state, error)
      if (allocated(error)) return
      call file%flush(error)
   end subroutine add_state

   !> Add the same number to several lists
   subroutine add_number(file, names, number, error)
      type(hdf5_output_type), intent(inout) :: file
      !> Names of the lists in the group of the states
      character(*), intent(in) :: names(:)
      !> What to add
      integer(int64), intent(in) :: number
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(names)
         call file%append(steps//trim(names(i)), [number], error)
         if (allocated(error)) return
      end do
   end subroutine add_number

   !> Tell how many states there are
   subroutine count_states(file, states, error)
      type(hdf5_output_type), intent(inout) :: file
      !> States that are complete
      integer, intent(in) :: states
      type(error_type), allocatable, intent(out) :: error

      call file%write_number("VTKHDF/Steps", "NSteps", states, error)
   end subroutine count_states

end module plydyn_io_vtkhdf_layout
