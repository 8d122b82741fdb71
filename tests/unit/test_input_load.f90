!> Loads act where the deck says.
program test_input_load
   use decks, only : plate, read_lines
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_model_support, only : all_planes, bottom_face, top_face
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_input_load.k"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages
   character(*), parameter :: curve = "*DEFINE_CURVE|3,|0.,0.|1.,1.|"

   call begin("point loads")
   call read_plate(curve//"*SET_NODE_LIST|1,|1,2|*LOAD_NODE_SET|1,3,3,-2.|*LOAD_NODE_POINT|4,1,3|" &
      & //"*LOAD_FACE_POINT|2,1,3,0,-1.|3,2,3,0,-1.|")
   call check(.not. allocated(error), "are read")
   associate (loads => model%point_loads)
      call check(size(loads), 4, "one for each card")
      call check(all(loads(1)%nodes == [1, 2]), "nodes of a set")
      call check(loads%scale, [-2.0_wp, 1.0_wp, -1.0_wp, -1.0_wp], 0.0_wp, "factors")
      call check(all(loads%direction == [3, 1, 3, 3]), "directions")
      call check(all(loads%face == [all_planes, all_planes, top_face, all_planes]), "faces")
      call check(all(loads%curve == [1, 1, 2, 2]), "curves, the constant is made once")
   end associate

   call begin("line loads")
   call read_plate("*SET_NODE_LIST|1,|1,2|*LOAD_FACE_LINE|1,-1,2,0,4.|")
   call check(.not. allocated(error), "are read")
   call check(model%line_loads(1)%face, bottom_face, "face")
   call check(model%line_loads(1)%scale, 4.0_wp, 0.0_wp, "factor")

   call begin("pressures")
   call read_plate(curve//"*SET_SHELL_LIST|4,|11|*LOAD_SHELL_SET|4,3,2.|*LOAD_FACE_PRESSURE|" &
      & //"0,-1,0,0.5|")
   call check(.not. allocated(error), "are read")
   call check(all(model%pressures%face == [top_face, bottom_face]), "faces")
   call check(all(model%pressures(2)%quads == [1]), "all elements")

   call begin("body loads")
   call read_plate(curve//"*LOAD_BODY_X|3,|*LOAD_BODY_Z|3,9810.|")
   call check(.not. allocated(error), "are read")
   call check(all(model%body_loads%direction == [1, 3]), "directions")
   call check(model%body_loads(2)%scale, 9810.0_wp, 0.0_wp, "factor")
   call read_plate(curve//"*LOAD_BODY_Z|3,|*LOAD_BODY_Z|3,|")
   call check_error(error, "occurs twice in the deck", "one direction twice")
   call read_plate("*LOAD_BODY_Z|0,|")
   call check_error(error, "LCID cannot be 0", "no curve")

   call finish()

contains

   !> Write the plate and some more lines, parted by bars, and read it all
   subroutine read_plate(more)
      !> Lines behind those of the plate
      character(*), intent(in) :: more

      call read_lines(path, plate//more//"*END", model, messages, error)
   end subroutine read_plate

end program test_input_load
