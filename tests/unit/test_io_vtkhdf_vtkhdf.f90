!> Field files: what does not fit is refused, with the file and the field in the message.
program test_io_vtkhdf_vtkhdf
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_state_file_positions, only : new_file_positions, file_positions_type
   use plydyn_io_vtkhdf_vtkhdf, only : piece_type, hyperslab_type, vtkhdf_type
   use plydyn_parallel_comm, only : comm_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_io_vtkhdf_vtkhdf.vtkhdf"
   integer, parameter :: hexahedron = 12
   real(wp), parameter :: points(3, 8) = reshape(real([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, &
      & 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1], wp), [3, 8])
   integer, parameter :: connectivity(8) = [0, 1, 2, 3, 4, 5, 6, 7]
   type(vtkhdf_type) :: file
   type(file_positions_type) :: places
   type(error_type), allocatable :: error

   call grids()
   call cell_fields()
   call point_fields()
   call delete()
   call finish()

contains

   !> Creation
   subroutine grids()
      call begin("create")
      call file%create("no/such/folder/a.vtkhdf", comm_type(), grid([0, 8]), error)
      call check_error(error, "no/such/folder/a.vtkhdf", "a folder that is not there")
      call check(.not. file%is_open(), "the file stays closed")
      call file%create(path, comm_type(), grid([0]), error)
      call check_error(error, "one offset per cell and one more", "too few offsets")
      call file%create(path, comm_type(), grid([0, 8]), error)
      call check(.not. allocated(error) .and. file%is_open(), "a grid that is right")
      call file%add_table("plies", ["ply"], reshape([1.0_wp, 2.0_wp], [2, 1]), error)
      call check_error(error, "a name for each column", "a table with too few names")
   end subroutine grids

   !> One cell, written by one rank
   function grid(offset) result(piece)
      !> Where the cell begins and ends
      integer, intent(in) :: offset(:)
      type(piece_type) :: piece

      piece%points = hyperslab_type(whole=8, count=8)
      piece%cells = hyperslab_type(whole=1, count=1)
      piece%all_ends = size(connectivity)
      piece%position = points
      piece%connectivity = connectivity
      piece%offset = offset
      piece%kind = [hexahedron]
   end function grid

   !> Fields on cells
   subroutine cell_fields()
      call begin("add_cell_data")
      call file%add_cell_data("ply", [1, 2], error)
      call check_error(error, "ply", "more values than cells")
      call file%add_cell_data("ply", [1], error)
      call check(.not. allocated(error), "a value per cell")
   end subroutine cell_fields

   !> Fields on points
   subroutine point_fields()
      real(wp) :: scalar(8), vector(3, 8)
      logical :: exists

      call begin("write_point_data")
      places = new_file_positions("test_io_vtkhdf_vtkhdf")
      scalar(:) = 0.0_wp
      vector(:, :) = 0.0_wp
      call file%declare_point_data("velocity", 3, error)
      call check(.not. allocated(error), "a field is declared")
      inquire (file=path, exist=exists)
      call check(.not. exists, "the file is not in its place")
      call file%settle(places, error)
      inquire (file=path, exist=exists)
      call check(exists, "and then it is")
      call file%begin_step(0.0_wp, error)
      call check(.not. allocated(error), "there is room for a state")
      call file%write_point_data("speed", scalar, error)
      call check_error(error, "speed must be declared", "a field that is not")
      call file%write_point_data("velocity", scalar, error)
      call check_error(error, "the components declared", "too few components")
      call file%end_step(error)
      call check_error(error, "state 1 lacks", "a state without its field")
      call file%write_point_data("velocity", vector, error)
      call check(.not. allocated(error), "the right shape")
      call file%write_point_data("velocity", vector, error)
      call check_error(error, "once per state", "the same field again")
      call file%end_step(error)
      call check(.not. allocated(error), "a whole state")
      call file%declare_point_data("pressure", 1, error)
      call check_error(error, "before the first state", "a field that comes late")
      call file%mark(places, error)
      call check(places%list(1)%amount == 1, "one state is noted")
      call file%close(error)
      call check(.not. allocated(error) .and. .not. file%is_open(), "closes")
      call file%close(error)
      call check(.not. allocated(error), "closing again does nothing")
      call file%begin_step(1.0_wp, error)
      call check_error(error, path, "nothing is written to a closed file")
   end subroutine point_fields

   !> Remove the file
   subroutine delete()
      integer :: unit

      open (newunit=unit, file=path)
      close (unit, status="delete")
   end subroutine delete

end program test_io_vtkhdf_vtkhdf
