!> Supports, motions and initial velocities act where the deck says.
program test_input_support
   use decks, only : plate, read_lines
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_model_support, only : all_planes, bottom_face, one_plane, prescribes_acceleration, &
      & prescribes_displacement, top_face
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_input_support.k"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages
   character(*), parameter :: edge = "*SET_NODE_LIST|1,|1,2|", &
      & curve = "*DEFINE_CURVE|3,|0.,0.|1.,1.|"

   call begin("read_boundary_spc_set")
   call read_plate(edge//"*BOUNDARY_SPC_SET_ID|4,clamp|1,0,1,1,1,1,1,1|")
   call check(.not. allocated(error), "is read")
   call check(all(model%supports(1)%direction), "all directions")
   call check(model%supports(1)%face, all_planes, "all planes")
   call check(model%supports(1)%name == "spc 1", "its force has a name")
   call read_plate(edge//"*BOUNDARY_SPC_SET|1,0,1,0,0,0,1,0|")
   call check_error(error, "DOFRY: the points of the plate have no rotations", "a rotation alone")

   call begin("read_boundary_face")
   call read_plate(edge//"*BOUNDARY_FACE|1,-1,0.0,0,0,1|1,0,0.25,1,0,0|")
   call check(.not. allocated(error), "is read")
   call check(all(model%supports%face == [bottom_face, one_plane]), "faces")
   call check(model%supports(2)%height, 0.25_wp, 0.0_wp, "height")
   call check(all(model%supports%name == [character(13) :: "face 1 bottom", "face 1 z 0.25"]), &
      & "names")
   call check(all(model%supports(1)%direction .eqv. [.false., .false., .true.]), "directions")

   call read_plate(edge//"*BOUNDARY_FACE|1,0,-0.5,0,0,1|1,0,0.5,1,0,0|")
   call check(all(model%supports%face == [bottom_face, top_face]), "planes at faces are faces")
   call read_plate(edge//"*BOUNDARY_FACE|1,0,0.3,1,0,0|")
   call check_error(error, "no thickness node lies at this height", "a plane between nodes")

   call begin("read_boundary_motion")
   call read_plate(edge//curve//"*BOUNDARY_PRESCRIBED_MOTION_SET|1,3,2,3,-2.0,0,0.5,0.1|1,1,1,3|")
   call check(.not. allocated(error), "is read")
   call check(all(model%motions%direction == [3, 1]), "directions")
   call check(all(model%motions%quantity == [prescribes_displacement, prescribes_acceleration]), &
      & "quantities")
   call check(model%motions%scale, [-2.0_wp, 1.0_wp], 0.0_wp, "factors")
   call check(model%motions(1)%birth, 0.1_wp, 0.0_wp, "begin")
   call check(model%motions(1)%death, 0.5_wp, 0.0_wp, "end")
   call check(model%motions(2)%death > 1.0e300_wp, "or no end")
   call check(all(model%motions%name == "motion 1"), "one name for one set")
   call check(index(messages, "move freely until then, and jump") > 0, "a displacement of later")
   call read_plate(edge//curve//"*BOUNDARY_PRESCRIBED_MOTION_SET|1,3,2,3,1.0,0,0.1,0.5|")
   call check_error(error, "the motion ends before it begins", "an end before the begin")

   call begin("read_boundary_motion")
   call read_plate(edge//"*BOUNDARY_FACE_MOTION|1,1,3,0,0,5.0|")
   call check(.not. allocated(error), "is read")
   call check(model%motions(1)%face, top_face, "face")
   call check(model%motions(1)%name == "face motion 1 top", "name")
   call check(model%curves(model%motions(1)%curve)%at(7.0_wp), 1.0_wp, 0.0_wp, "curve 0 is 1")
   call check(index(messages, "jump") == 0, "a velocity may begin at once")
   call read_plate(edge//"*BOUNDARY_FACE_MOTION|1,1,3,2,0,5.0|")
   call check(index(messages, "LCID: the points jump by 5 in the first step") > 0, &
      & "a displacement makes a jump then")

   call begin("read_initial_velocity")
   call read_plate("*INITIAL_VELOCITY|0,|0.,0.,-5.|*INITIAL_VELOCITY_NODE|3,1.,2.,3.|")
   call check(.not. allocated(error), "is read")
   call check(size(model%initial_velocities(1)%nodes), 4, "all nodes")
   call check(all(model%initial_velocities(2)%nodes == [3]), "one node")
   call check(model%initial_velocities(2)%velocity, [1.0_wp, 2.0_wp, 3.0_wp], 0.0_wp, "velocity")

   call finish()

contains

   !> Write the plate and some more lines, parted by bars, and read it all
   subroutine read_plate(more)
      !> Lines behind those of the plate
      character(*), intent(in) :: more

      call read_lines(path, plate//more//"*END", model, messages, error)
   end subroutine read_plate

end program test_input_support
