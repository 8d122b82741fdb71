!> Field files: put in place, marked, continued; what cannot be written is named.
program test_io_vtkhdf_vtkhdf
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_state_file_positions, only : new_file_positions, file_positions_type
   use plydyn_io_vtkhdf_vtkhdf, only : hyperslab_type, piece_type, vtkhdf_type
   use plydyn_parallel_comm, only : comm_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_io_vtkhdf_vtkhdf.vtkhdf"
   integer, parameter :: hexahedron = 12
   real(wp), parameter :: points(3, 8) = reshape(real([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, &
      & 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1], wp), [3, 8])
   integer, parameter :: connectivity(8, 1) = reshape([0, 1, 2, 3, 4, 5, 6, 7], [8, 1])
   type(vtkhdf_type) :: file
   type(file_positions_type) :: places
   type(error_type), allocatable :: error

   call grids()
   call point_fields()
   call continuation()
   call delete()
   call finish()

contains

   !> Creation
   subroutine grids()
      call begin("create")
      call file%create_grid("no/such/folder/a.vtkhdf", comm_type(), grid(), error)
      call check_error(error, "no/such/folder/a.vtkhdf", "a folder that is not there")
      call check(.not. file%is_open(), "the file stays closed")
      call file%create_grid(path, comm_type(), grid(), error)
      call check(.not. allocated(error) .and. file%is_open(), "a grid that is right")
   end subroutine grids

   !> One cell, written by one rank
   function grid() result(piece)
      type(piece_type) :: piece

      piece%points = hyperslab_type(whole=8, count=8)
      piece%cells = hyperslab_type(whole=1, count=1)
      piece%position = points
      piece%connectivity = connectivity
      piece%kind = hexahedron
   end function grid

   !> Fields on points
   subroutine point_fields()
      real(wp) :: vector(3, 8)
      logical :: exists

      call begin("write_point_data")
      places = new_file_positions("test_io_vtkhdf_vtkhdf")
      vector(:, :) = 0.0_wp
      call file%add_cell_data("ply", [1])
      call file%declare_point_data("velocity", 3)
      inquire (file=path, exist=exists)
      call check(.not. exists, "the file is not in its place")
      call file%put_in_place(places, error)
      inquire (file=path, exist=exists)
      call check(exists .and. .not. allocated(error), "and then it is")
      call file%write_point_data("velocity", vector)
      call file%end_step(0.0_wp, error)
      call check(.not. allocated(error), "a whole state")
      call file%mark(places, error)
      call check(places%list(1)%amount == 1, "one state is noted")
      call file%write_point_data("speed", vector)
      call file%end_step(1.0_wp, error)
      call check_error(error, "cannot write VTKHDF/PointData/speed to "//path, &
         & "what could not be written is named")
      call file%close(error)
      call check(.not. allocated(error) .and. .not. file%is_open(), "closes")
      call file%close(error)
      call check(.not. allocated(error), "closing again does nothing")
      call file%end_step(1.0_wp, error)
      call check_error(error, path, "nothing is written to a closed file")
   end subroutine point_fields

   !> A file of an earlier run that goes on, and one that has not the states
   subroutine continuation()
      type(vtkhdf_type) :: other

      call begin("put_in_place")
      call other%create_grid(path, comm_type(), grid(), error)
      call other%add_cell_data("ply", [1])
      call other%declare_point_data("velocity", 3)
      call other%put_in_place(places, error)
      call check(.not. allocated(error), "takes over the state that is noted")
      call other%mark(places, error)
      call check(places%list(2)%amount == 1, "which counts")
      call other%close(error)
      places%list(:)%amount = 2
      call other%create_grid(path, comm_type(), grid(), error)
      call other%declare_point_data("velocity", 3)
      call other%put_in_place(places, error)
      call check_error(error, "cannot go on with "//path, "but not one that is not there")
      call other%close(error)
   end subroutine continuation

   !> Remove the file
   subroutine delete()
      integer :: unit

      open (newunit=unit, file=path)
      close (unit, status="delete")
      open (newunit=unit, file=path//".part")
      close (unit, status="delete")
   end subroutine delete

end program test_io_vtkhdf_vtkhdf
