!> Sets, boxes and curves hold what the deck says.
program test_input_set
   use decks, only : plate, read_lines
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_input_set.k"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages

   call begin("read_set_list")
   call read_plate("*SET_NODE_LIST_TITLE|edge|1,|2,1|4,|*BOUNDARY_SPC_SET|1,0,1|")
   call check(.not. allocated(error), "is read")
   call check(all(model%supports(1)%nodes == [2, 1, 4]), "nodes in their order")
   call read_plate("*SET_NODE_LIST|1,|2,1,2|*BOUNDARY_SPC_SET|1,0,1|")
   call check(size(model%supports(1)%nodes), 2, "a node that is named twice counts once")
   call check(index(messages, "the set names 1 number twice") > 0, "and makes a warning")

   call begin("read_set_node_general")
   call read_plate("*DEFINE_BOX|3,-1.,0.5,-1.,2.,-1.,1.|*SET_NODE_GENERAL|1,|BOX,3|NODE,2,1|" &
      & //"*BOUNDARY_SPC_SET|1,0,1|")
   call check(.not. allocated(error), "is read")
   call check(all(model%supports(1)%nodes == [1, 2, 4]), "the union of its rules")
   call read_plate("*SET_NODE_GENERAL|1,|ALL|*BOUNDARY_SPC_SET|1,0,1|")
   call check(size(model%supports(1)%nodes), 4, "all nodes")
   call read_plate("*SET_NODE_GENERAL|1,|PART,7|*BOUNDARY_SPC_SET|1,0,1|")
   call check_error(error, "'PART' is not a value of OPTION", "an option that is not supported")
   call read_plate("*SET_NODE_GENERAL|1,|NODE|*BOUNDARY_SPC_SET|1,0,1|")
   call check_error(error, "the rule names nothing", "a rule without numbers")

   call begin("read_set_list")
   call read_plate("*SET_SHELL_LIST|4,|11,|*LOAD_FACE_PRESSURE|4,1,0|")
   call check(.not. allocated(error), "is read")
   call check(all(model%pressures(1)%quads == [1]), "elements by their index")

   call begin("read_define_curve")
   call read_plate("*DEFINE_CURVE|8,0,2.0,3.0,0.5,1.0|0.0,1.0|1.0,2.0|*LOAD_BODY_Z|8,|")
   call check(.not. allocated(error), "is read")
   call check(model%curves(1)%x, [1.0_wp, 3.0_wp], 0.0_wp, "offset, then factor of the abscissa")
   call check(model%curves(1)%y, [6.0_wp, 9.0_wp], 0.0_wp, "offset, then factor of the ordinate")
   call read_plate("*DEFINE_CURVE|8,|0.0,1.0|0.0,2.0|*LOAD_BODY_Z|8,|")
   call check_error(error, "the abscissa does not increase", "a step")
   call read_plate("*DEFINE_CURVE|8,|0.0,1.0|*LOAD_BODY_Z|8,|")
   call check_error(error, "one point", "a curve of one point")
   call read_plate("*DEFINE_CURVE|8,|0.0,1.0|1.0,1.0|")
   call check_error(error, "curve 8 is never used", "a curve that nothing uses")

   call finish()

contains

   !> Write the plate and some more lines, parted by bars, and read it all
   subroutine read_plate(more)
      !> Lines behind those of the plate
      character(*), intent(in) :: more

      call read_lines(path, plate//more//"*END", model, messages, error)
   end subroutine read_plate

end program test_input_set
