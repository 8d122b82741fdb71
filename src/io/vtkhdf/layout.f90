!> Where things lie in a VTKHDF file: the groups, the grid, and the lists of states.
module plydyn_io_vtkhdf_layout
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_precision, only : wp
   use plydyn_io_hdf5_input, only : hdf5_input_type
   use plydyn_io_hdf5_output, only : hdf5_output_type, hyperslab_type, store_byte, store_double, &
      & store_long
   implicit none
   private

   public :: add_state, copy_states, count_states, make_groups, make_list, make_steps, write_grid

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
   character(*), parameter, public :: states_group = "VTKHDF/Steps"
   character(*), parameter :: steps = states_group//"/"
   !> List of the times of the states
   character(*), parameter :: state_times = steps//"Values"
   !> Lists that have the same number for every state, as the grid is fixed: their widths, as in
   !> `make_series`, and the numbers
   character(*), parameter :: fixed_lists(5) = [character(21) :: "NumberOfParts", "PartOffsets", &
      & "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"]
   integer, parameter :: fixed_widths(5) = [0, 0, 0, 1, 1]
   real(wp), parameter :: fixed_numbers(5) = [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]

   !> The part of a grid that a rank writes
   type, public :: piece_type
      !> Rows of its points, and of its cells
      type(hyperslab_type) :: points, cells
      !> Places, (3, points)
      real(wp), allocatable :: position(:, :)
      !> VTK's type of the cells, the same of all
      integer :: kind = 0
      !> Points of its cells, counted from 0, (points of a cell, cells)
      integer, allocatable :: connectivity(:, :)
   end type piece_type

contains

   !> Make all groups
   subroutine make_groups(file)
      !> The file, new
      class(hdf5_output_type), intent(inout) :: file

      character(*), parameter :: groups(7) = [character(29) :: "VTKHDF", "VTKHDF/PointData", &
         & "VTKHDF/CellData", "VTKHDF/Steps", "VTKHDF/Steps/PointDataOffsets", &
         & "VTKHDF/Steps/CellDataOffsets", own_group]
      integer :: i

      do i = 1, size(groups)
         call file%make_group(trim(groups(i)))
      end do
      call file%write_numbers("VTKHDF", "Version", format_version)
      call file%write_text("VTKHDF", "Type", "UnstructuredGrid")
   end subroutine make_groups

   !> Write the grid, as one piece of the file
   subroutine write_grid(file, piece)
      class(hdf5_output_type), intent(inout) :: file
      !> What this rank writes
      type(piece_type), intent(in) :: piece

      integer :: i, last

      associate (points => piece%points, cells => piece%cells, &
         & corners => size(piece%connectivity, 1))
         call file%write_values("VTKHDF/NumberOfPoints", [1], &
            & [real(points%whole*points%levels, wp)], store_long)
         call file%write_values("VTKHDF/NumberOfCells", [1], [real(cells%whole, wp)], store_long)
         call file%write_values("VTKHDF/NumberOfConnectivityIds", [1], &
            & [real(corners*cells%whole, wp)], store_long)
         call file%write_values("VTKHDF/Points", shape(piece%position), piece%position, &
            & store_double, points)
         call file%write_values("VTKHDF/Connectivity", [corners*cells%count], &
            & real(piece%connectivity, wp), store_long, hyperslab_type(whole=corners*cells%whole, &
            & first=corners*cells%first, count=corners*cells%count))
         ! where each cell starts, and behind the last one of all also where that one ends
         last = cells%first + cells%count
         if (last < cells%whole) last = last - 1
         call file%write_values("VTKHDF/Offsets", [last + 1 - cells%first], &
            & [(real(corners*i, wp), i=cells%first, last)], store_long, &
            & hyperslab_type(whole=cells%whole + 1, first=cells%first, &
            & count=last + 1 - cells%first))
         call file%write_values("VTKHDF/Types", [cells%count], &
            & spread(real(piece%kind, wp), 1, cells%count), store_byte, cells)
      end associate
   end subroutine write_grid

   !> Make the lists of states, all empty
   subroutine make_steps(file)
      class(hdf5_output_type), intent(inout) :: file

      integer :: i

      call count_states(file, 0)
      call file%make_series(state_times, 0, states_per_chunk, store_double)
      do i = 1, size(fixed_lists)
         call make_list(file, trim(fixed_lists(i)), fixed_widths(i))
      end do
   end subroutine make_steps

   !> Make a list with one number per state
   subroutine make_list(file, name, width)
      class(hdf5_output_type), intent(inout) :: file
      !> Name of the list in the group of the states
      character(*), intent(in) :: name
      !> 0 for a list, 1 for a table of one column
      integer, intent(in) :: width

      call file%make_series(steps//name, width, states_per_chunk, store_long)
   end subroutine make_list

   !> Add a state whose data are written: its place and its time
   subroutine add_state(file, time, lists, starts)
      class(hdf5_output_type), intent(inout) :: file
      !> Time of the state
      real(wp), intent(in) :: time
      !> Lists of all fields
      character(*), intent(in) :: lists(:)
      !> Row at which each of them starts for this state, from 0
      integer(int64), intent(in) :: starts(:)

      integer :: i

      do i = 1, size(fixed_lists)
         call file%append(steps//trim(fixed_lists(i)), [1], [fixed_numbers(i)])
      end do
      do i = 1, size(lists)
         call file%append(steps//trim(lists(i)), [1], [real(starts(i), wp)])
      end do
      call file%append(state_times, [1], [time])
   end subroutine add_state

   !> Copy what was said of the first states of another file
   subroutine copy_states(file, states, lists, other, is_there)
      class(hdf5_output_type), intent(inout) :: file
      !> How many
      integer, intent(in) :: states
      !> Lists of all fields
      character(*), intent(in) :: lists(:)
      !> The file that has them
      type(hdf5_input_type), intent(in) :: other
      !> Whether it does
      logical, intent(out) :: is_there

      integer :: i

      call file%copy_rows(state_times, 1, int(states, int64), other, is_there)
      do i = 1, size(fixed_lists)
         if (is_there) call file%copy_rows(steps//trim(fixed_lists(i)), 1, int(states, int64), &
            & other, is_there)
      end do
      do i = 1, size(lists)
         if (is_there) call file%copy_rows(steps//trim(lists(i)), 1, int(states, int64), other, &
            & is_there)
      end do
   end subroutine copy_states

   !> Count the states that are complete
   subroutine count_states(file, states)
      class(hdf5_output_type), intent(inout) :: file
      !> How many there are
      integer, intent(in) :: states

      call file%write_numbers(states_group, "NSteps", [states])
   end subroutine count_states

end module plydyn_io_vtkhdf_layout
