!> Writes a small VTKHDF file for `test_reads_back.py`: write_sample PATH STATES [HELD]
!>
!> A 27-node and an 8-node hexahedron side by side, a scalar, a vector and a tensor whose values
!> tell state, point and component. With HELD the program says `pause` in the midst of that state,
!> where nothing of it is counted yet, and waits for a line. An error is printed; the exit is 5.
program write_sample
   use plydyn_base_error, only : error_type, exit_output
   use plydyn_base_precision, only : wp
   use plydyn_output_places, only : new_places
   use plydyn_output_vtkhdf, only : vtkhdf_type
   implicit none

   integer, parameter :: nodes(2) = [27, 8], cell_types(2) = [29, 12]
   !> Places of the nodes of VTK's 27-node hexahedron, twice their coordinates in a unit cube
   integer, parameter :: place(3, 27) = reshape([ &
      & 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0, 0, 2, 2, 0, 2, 2, 2, 2, 0, 2, 2, &
      & 1, 0, 0, 2, 1, 0, 1, 2, 0, 0, 1, 0, 1, 0, 2, 2, 1, 2, 1, 2, 2, 0, 1, 2, &
      & 0, 0, 1, 2, 0, 1, 2, 2, 1, 0, 2, 1, 0, 1, 1, 2, 1, 1, 1, 0, 1, 1, 2, 1, &
      & 1, 1, 0, 1, 1, 2, 1, 1, 1], [3, 27])
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

   call start()
   call leave_on_error()
   do k = 1, states
      call write_state(k)
      call leave_on_error()
   end do
   call file%close(error)
   call leave_on_error()

contains

   !> The grid and what is told about it
   subroutine start()
      real(wp) :: points(3, sum(nodes)), normals(3, 2)
      integer :: i

      points(:, :27) = 0.5_wp*place
      points(:, 28:) = 0.5_wp*place(:, :8)
      points(1, 28:) = points(1, 28:) + 2.0_wp
      normals(:, :) = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp], [3, 2])
      call file%create(path, points, [(i, i=0, 34)], [0, 27, 35], cell_types, error)
      if (allocated(error)) return
      call file%describe("title", "Sample of two cells", error)
      if (allocated(error)) return
      call file%describe("length", "", error)
      if (allocated(error)) return
      call file%add_table("plies", [character(9) :: "ply", "angle", "thickness"], &
         & reshape([1.0_wp, 45.0_wp, 0.1_wp, 2.0_wp, -45.0_wp, 0.2_wp], [3, 2]), error)
      if (allocated(error)) return
      call file%add_cell_data("ply", [1, 2], error)
      if (allocated(error)) return
      call file%add_cell_data("angle", [45.0_wp, -45.0_wp], error)
      if (allocated(error)) return
      call file%add_cell_data("fibre", normals, error)
      if (allocated(error)) return
      call file%declare_point_data("pressure", 1, error)
      if (allocated(error)) return
      call file%declare_point_data("displacement", 3, error)
      if (allocated(error)) return
      call file%declare_point_data("stress", 6, error)
      if (allocated(error)) return
      call file%settle(new_places(path), error)
   end subroutine start

   !> One state: value = 1000 x state + point + component/10
   subroutine write_state(state)
      integer, intent(in) :: state

      real(wp) :: values(6, sum(nodes)), vectors(3, sum(nodes)), scalars(sum(nodes))
      integer :: i, c

      do i = 1, size(values, 2)
         values(:, i) = 1000.0_wp*state + i + [(0.1_wp*c, c=1, 6)]
      end do
      scalars(:) = values(1, :)
      vectors(:, :) = values(:3, :)
      call file%begin_step(0.1_wp*state)
      call file%write_point_data("pressure", scalars, error)
      if (allocated(error)) return
      call file%write_point_data("displacement", vectors, error)
      if (allocated(error)) return
      if (state == held) then
         write (*, "(a)") "pause"
         flush (6)
         read (*, *)
      end if
      call file%write_point_data("stress", values, error)
      if (allocated(error)) return
      call file%end_step(error)
   end subroutine write_state

   !> Print the error, if there is one, and leave; closing a file that cannot be written is tried
   subroutine leave_on_error()
      if (.not. allocated(error)) return
      write (*, "(a)") error%message
      call file%close(error)
      stop exit_output
   end subroutine leave_on_error

end program write_sample
