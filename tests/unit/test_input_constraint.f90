!> Linear constraints have the terms and the right-hand side that the deck says.
program test_input_constraint
   use decks, only : plate, read_lines
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : all_planes, bottom_face, prescribes_displacement, &
      & prescribes_velocity, top_face
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_input_constraint.k", &
      & curve = "*DEFINE_CURVE|3,|0.,0.|1.,1.|", jump = "*DEFINE_CURVE|3,|0.,0.5|1.,1.|", &
      & set = "*SET_NODE_LIST|1,|1,2|", lever = "*CONSTRAINED_FACE_LINEAR|5,2,3,-2.0|"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages

   call begin("read_constrained_linear, of LS-DYNA")
   call read_plate("*CONSTRAINED_LINEAR_GLOBAL|7,|1,3,2.0|2,3,-1.0|")
   call check(.not. allocated(error), "is read")
   associate (constraint => model%constraints(1))
      call check(constraint%id, 7, "number")
      call check(constraint%curve, 0, "the sum is zero")
      call check(all(constraint%terms%face == all_planes), "means over the thickness")
      call check(constraint%terms%coefficient, [2.0_wp, -1.0_wp], 0.0_wp, "coefficients")
   end associate
   call read_plate("*CONSTRAINED_LINEAR_GLOBAL|7,|")
   call check_error(error, "the constraint has no rows", "no rows")

   call begin("read_constrained_linear, of faces")
   call read_plate(curve//lever//"1,-1,3,-0.4|2,1,3,1.4|")
   call check(.not. allocated(error), "is read")
   associate (constraint => model%constraints(1))
      call check(constraint%quantity, prescribes_displacement, "a curve of the sum")
      call check(constraint%scale, -2.0_wp, 0.0_wp, "factor")
      call check(all(constraint%terms%face == [bottom_face, top_face]), "faces")
      call check(all(constraint%terms%node == [1, 2]), "nodes")
      call check(all(constraint%terms%direction == 3), "directions")
   end associate
   call check(index(messages, "jumps") == 0, "a sum that begins at zero")
   call read_plate(jump//lever//"1,-1,3,-0.4|2,1,3,1.4|")
   call check(index(messages, "LCID: the sum jumps by -1 in the first step") > 0, &
      & "one that does not")
   call read_plate(jump//"*CONSTRAINED_FACE_LINEAR|5,0,3|1,1,3,1.0|")
   call check(model%constraints(1)%quantity, prescribes_velocity, "a curve of the rate")
   call check(index(messages, "jumps") == 0, "which may begin at once")

   call begin("check_term")
   call read_plate(set//"*BOUNDARY_FACE|1,-1,0,0,0,1|" &
      & //"*CONSTRAINED_FACE_LINEAR|5|1,1,3,1.0|3,-1,3,1.0|")
   call check(.not. allocated(error), "another face than that of the support")
   call read_plate(set//"*BOUNDARY_FACE|1,-1,0,0,0,1|*CONSTRAINED_LINEAR_GLOBAL|5,|1,3,1.0|")
   call check_error(error, "DOF: the displacement of node 1", "a mean over a held face")
   call read_plate(set//curve//"*BOUNDARY_FACE_MOTION|1,1,1,2,3|" &
      & //"*CONSTRAINED_FACE_LINEAR|5|2,1,1,1.0|")
   call check_error(error, "DOF: the displacement of node 2", "a point that is moved")
   call read_plate("*CONSTRAINED_FACE_LINEAR|5|1,1,3,1.0|2,1,3,1.0|" &
      & //"*CONSTRAINED_FACE_LINEAR|6|1,-1,3,1.0|1,1,2,1.0|")
   call check(.not. allocated(error), "constraints of other faces and directions")
   call read_plate("*CONSTRAINED_FACE_LINEAR|5|1,1,3,1.0|*CONSTRAINED_LINEAR_GLOBAL|6,|1,3,1.0|")
   call check_error(error, "NID: constraint 5 has node 1", "a shared point")
   call read_plate("*CONSTRAINED_LINEAR_GLOBAL|6,|1,3,1.0|1,3,2.0|")
   call check_error(error, "NID: node 1 is in the constraint twice", "a point twice")
   call read_plate("*CONSTRAINED_LINEAR_GLOBAL|6,|1,3,0.0|")
   call check_error(error, "COEF: a coefficient of 0 constrains nothing", "no coefficient")

   call finish()

contains

   !> Write the plate and some more lines, parted by bars, and read it all
   subroutine read_plate(more)
      !> Lines behind the plate
      character(*), intent(in) :: more

      call read_lines(path, plate//more//"*END", model, messages, error)
   end subroutine read_plate

end program test_input_constraint
