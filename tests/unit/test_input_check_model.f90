!> A model is complete, and all of it is used.
program test_input_check_model
   use decks, only : plate, read_lines
   use plydyn_base_error, only : error_type, exit_input
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_input_check_model.k"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages

   call begin("check_presence")
   call read_lines(path, "*KEYWORD|*END", model, messages, error)
   call check_error(error, "the deck has no nodes", "nodes")
   call check_error(error, "the deck has no elements", "elements")
   call check_error(error, "the deck has no part", "a part")
   call check_error(error, "the deck has no end time", "an end time")
   call check(error%code, exit_input, "the exit code is that of input")

   call begin("check_presence, warnings")
   call read_plate("*DATABASE_NODOUT|0.1,|")
   call check(.not. allocated(error), "node histories without nodes are no error")
   call check(index(messages, "there are no nodes to write") > 0, "but make a warning")

   call begin("check_all_used")
   call read_plate("*SET_NODE_LIST|1,|1,2|")
   call check_error(error, "node set 1 is never used", "a set")
   call read_plate("*SET_SHELL_LIST|1,|11,|")
   call check_error(error, "shell set 1 is never used", "a set of elements")
   call read_plate("*DEFINE_BOX|1,0.,1.,0.,1.,0.,1.|")
   call check_error(error, "box 1 is never used", "a box")
   call read_plate("*MAT_COHESIVE_ELASTIC|6,0.,0,0,2.0e5,3.0e5|")
   call check_error(error, "interface material 6 is never used", "an interface material")

   call begin("check_duplicates")
   call read_plate("*SET_NODE_LIST|1,|1,2|*SET_NODE_LIST|1,|3,4|*BOUNDARY_SPC_SET|1,0,1|")
   call check_error(error, "node set 1 is defined twice", "a set")
   call read_plate("*DATABASE_PROFILE|1,0.,0.|1,0.5,0.5|")
   call check_error(error, "profile 1 is defined twice", "a profile")

   call begin("check_parts")
   call read_plate("*PART_COMPOSITE|other|8,|5,0.1|")
   call check_error(error, "part 8 has no elements", "a part without elements")

   call finish()

contains

   !> Write the plate and some more lines, parted by bars, and read it all
   subroutine read_plate(more)
      !> Lines behind those of the plate
      character(*), intent(in) :: more

      call read_lines(path, plate//more//"*END", model, messages, error)
   end subroutine read_plate

end program test_input_check_model
