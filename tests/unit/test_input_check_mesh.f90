!> A mesh lies in a plane, counter-clockwise, without strays.
program test_input_check_mesh
   use decks, only : plate, read_lines
   use plydyn_base_error, only : error_type
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_input_check_mesh.k"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages

   call begin("check_plane")
   call read_nodes("1,0.,0.,2.|2,1.,0.,2.|3,1.,1.,2.|4,0.,1.,2.|")
   call check(.not. allocated(error), "any height is a plane")
   call read_nodes("1,0.,0.,0.|2,1.,0.,0.|3,1.,1.,1.e-9|4,0.,1.,0.|")
   call check(.not. allocated(error), "rounding is forgiven")
   call read_nodes("1,0.,0.,0.|2,1.,0.,0.|3,1.,1.,1.e-3|4,0.,1.,0.|")
   call check_error(error, "node 3 lies at z = 0.001", "a bulge is not")

   call begin("check_quad")
   call read_nodes("1,0.,0.|2,0.,1.|3,1.,1.|4,1.,0.|")
   call check_error(error, "element 11 is clockwise", "clockwise")
   call read_nodes("1,0.,0.|2,1.,0.|3,0.3,0.3|4,0.,1.|")
   call check_error(error, "folded at a corner", "an arrow head")
   call read_nodes("1,0.,0.|2,1.,0.|3,0.,1.|4,1.,1.|")
   call check_error(error, "folded at a corner", "a bow tie")
   call read_nodes("1,0.,0.|2,1.,0.|3,2.,0.|4,3.,0.|")
   call check_error(error, "has no area", "a line")
   call read_nodes("1,0.,0.|2,1.,0.|3,1.,1.|4,0.9,1.|")
   call check(.not. allocated(error), "a skew quad is none of them")

   call begin("check_middles")
   call read_middles("5,0.7,0.|6,1.,0.5|7,0.7,1.|8,0.,0.5|9,0.5,0.5|")
   call check(.not. allocated(error), "sides may be parted unevenly")
   call read_middles("5,0.75,0.|6,1.,0.5|7,0.75,1.|8,0.,0.5|9,0.5,0.5|")
   call check_error(error, "is folded: its Jacobian", "but not at a quarter")
   call read_middles("5,0.8,0.|6,1.,0.5|7,0.7,1.|8,0.,0.5|9,0.5,0.5|")
   call check_error(error, "node 5 far from the middle of its side", "nor beyond")
   call read_middles("5,0.5,0.|6,1.,0.5|7,0.5,1.|8,0.,0.5|9,0.5,0.8|")
   call check_error(error, "node 9 far from its centre", "which the centre may not be, either")
   call read_middles("5,0.5,0.2|6,1.2,0.5|7,0.5,1.2|8,0.2,0.5|9,0.7,0.7|")
   call check(.not. allocated(error), "it goes with curved sides")

   call begin("check_twins")
   call read_plate("*ELEMENT_SHELL|12,7,2,3,4,1|")
   call check_error(error, "element 12 has the corners of element 11", "one quad twice")
   call read_plate("*NODE|5,0.,-1.|6,1.,-1.|7,-1.,0.|8,-1.,1.|*ELEMENT_SHELL|12,7,5,6,2,1|" &
      & //"13,7,7,1,4,8|14,7,2,1,5,6|")
   call check_error(error, "element 14 has the corners of element 12", "behind others at a corner")

   call begin("check_strays")
   call read_plate("*NODE|9,5.,5.|")
   call check_error(error, "node 9 belongs to no element", "a stray node")

   call finish()

contains

   !> Write the plate and some more lines, parted by bars, and read it all
   subroutine read_plate(more)
      !> Lines behind those of the plate
      character(*), intent(in) :: more

      call read_lines(path, plate//more//"*END", model, messages, error)
   end subroutine read_plate

   !> Read the plate with mid-sides and a centre
   subroutine read_middles(nodes)
      !> Lines of nodes 5 to 9
      character(*), intent(in) :: nodes

      integer, parameter :: element = index(plate, "*ELEMENT")
      integer, parameter :: corners = index(plate, "1,2,3,4|") + len("1,2,3,4")

      call read_lines(path, plate(:element - 1)//nodes//plate(element:corners - 1) &
         & //",5,6,7,8,9"//plate(corners:)//"*END", model, messages, error)
   end subroutine read_middles

   !> Read the plate with other nodes
   subroutine read_nodes(nodes)
      !> Lines of the nodes
      character(*), intent(in) :: nodes

      integer, parameter :: begin = index(plate, "*NODE|") + len("*NODE|")
      integer, parameter :: finish = index(plate, "*ELEMENT")

      call read_lines(path, plate(:begin - 1)//nodes//plate(finish:)//"*END", model, messages, &
         & error)
   end subroutine read_nodes

end program test_input_check_mesh
