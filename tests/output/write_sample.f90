!> Writes a small VTKHDF file for `test_reads_back.py`: write_sample PATH STATES [HELD]
!>
!> Two 27-node hexahedra side by side, a scalar, a vector and a tensor whose values tell state,
!> point and component. Several ranks write as much of the points as each other, and the
!> cells likewise. With HELD the program says `pause` in the midst of that state,
!> where nothing of it is counted yet, and waits for a line. An error is printed; the exit is 5.
program write_sample
   use plydyn_base_error, only : error_type, exit_output
   use plydyn_base_precision, only : wp
   use plydyn_state_file_positions, only : new_file_positions
   use plydyn_io_vtkhdf_vtkhdf, only : piece_type, hyperslab_type, vtkhdf_type
   use plydyn_parallel_comm, only : comm_type, leave_ranks, start_ranks, stop_ranks
   use plydyn_parallel_owner_reduction, only : band_start
   implicit none

   integer, parameter :: nodes = 27, hexahedra = 2, cell_type = 29
   !> Places of the nodes of VTK's 27-node hexahedron, twice their coordinates in a unit cube
   integer, parameter :: place(3, 27) = reshape([ &
      & 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0, 0, 2, 2, 0, 2, 2, 2, 2, 0, 2, 2, &
      & 1, 0, 0, 2, 1, 0, 1, 2, 0, 0, 1, 0, 1, 0, 2, 2, 1, 2, 1, 2, 2, 0, 1, 2, &
      & 0, 0, 1, 2, 0, 1, 2, 2, 1, 0, 2, 1, 0, 1, 1, 2, 1, 1, 1, 0, 1, 1, 2, 1, &
      & 1, 1, 0, 1, 1, 2, 1, 1, 1], [3, 27])
   type(comm_type) :: comm
   type(hyperslab_type) :: points, cells
   type(vtkhdf_type) :: file
   type(error_type), allocatable :: error
   character(256) :: path, word
   integer :: states, held, k

   call get_command_argument(1, path)
   call get_command_argument(2, word)
   read (word, *) states
   held = 0
   call get_command_argument(3, word)
   if (len_trim(word) > 0) read (word, *) held

   call start_ranks(comm)
   points = band(nodes*hexahedra)
   cells = band(hexahedra)
   call start()
   call leave_on_error()
   do k = 1, states
      call write_state(k)
      call leave_on_error()
   end do
   call file%close(error)
   call leave_on_error()
   call stop_ranks(comm)

contains

   !> Rows that this rank writes
   type(hyperslab_type) function band(rows)
      integer, intent(in) :: rows

      band%whole = rows
      band%first = band_start(rows, comm%rank, comm%ranks)
      band%count = band_start(rows, comm%rank + 1, comm%ranks) - band%first
   end function band

   !> The part of the grid that this rank writes
   function grid() result(piece)
      type(piece_type) :: piece

      real(wp) :: position(3, nodes*hexahedra)
      integer :: i

      position(:, :nodes) = 0.5_wp*place
      position(:, nodes + 1:) = 0.5_wp*place
      position(1, nodes + 1:) = position(1, nodes + 1:) + 2.0_wp
      piece%points = points
      piece%cells = cells
      piece%position = position(:, points%first + 1:points%first + points%count)
      piece%connectivity = reshape([(nodes*cells%first + i, i=0, nodes*cells%count - 1)], &
         & [nodes, cells%count])
      piece%kind = cell_type
   end function grid

   !> The grid and what is told about it; each rank its part
   subroutine start()
      integer, parameter :: ply(2) = [1, 2]
      real(wp), parameter :: angle(2) = [45.0_wp, -45.0_wp], normals(3, 2) = &
         & reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp], [3, 2])
      integer :: first, last

      first = cells%first + 1
      last = cells%first + cells%count
      call file%create_grid(path, comm, grid(), error)
      if (allocated(error)) return
      call file%describe("title", "Sample of two cells")
      call file%describe("length", "")
      call file%add_table("plies", [character(9) :: "ply", "angle", "thickness"], &
         & reshape([1.0_wp, 45.0_wp, 0.1_wp, 2.0_wp, -45.0_wp, 0.2_wp], [3, 2]))
      call file%add_cell_data("ply", ply(first:last))
      call file%add_cell_data("angle", angle(first:last))
      call file%add_cell_data("fibre", normals(:, first:last))
      call file%declare_point_data("pressure", 1)
      call file%declare_point_data("displacement", 3)
      call file%declare_point_data("stress", 6)
      call file%put_in_place(new_file_positions(path), error)
   end subroutine start

   !> One state: value = 1000 x state + point + component/10
   subroutine write_state(state)
      integer, intent(in) :: state

      real(wp) :: values(6, points%count)
      integer :: i, c

      do i = 1, size(values, 2)
         values(:, i) = 1000.0_wp*state + points%first + i + [(0.1_wp*c, c=1, 6)]
      end do
      call file%write_point_data("pressure", values(:1, :))
      call file%write_point_data("displacement", values(:3, :))
      if (state == held) then
         if (comm%is_root()) then
            write (*, "(a)") "pause"
            flush (6)
            read (*, *)
         end if
      end if
      call file%write_point_data("stress", values)
      call file%end_step(0.1_wp*state, error)
   end subroutine write_state

   !> Print the error, if there is one, and leave; closing a file that cannot be written is tried
   subroutine leave_on_error()
      if (.not. allocated(error)) return
      if (comm%is_root()) write (*, "(a)") error%message
      flush (6)
      call file%close(error)
      call leave_ranks(comm)
      stop exit_output
   end subroutine leave_on_error

end program write_sample
