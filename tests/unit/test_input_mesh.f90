!> Nodes and elements reach the mesh.
program test_input_mesh
   use decks, only : plate, read_lines
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_input_mesh.k"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages

   call begin("read_node, read_element_quad")
   call read_plate("")
   call check(.not. allocated(error), "a good deck is read")
   associate (mesh => model%mesh)
      call check(all(mesh%node_id == [1, 2, 3, 4]), "node numbers")
      call check(mesh%position(:, 3), [1.0_wp, 1.0_wp, 0.0_wp], 0.0_wp, "positions")
      call check(all(mesh%quad_id == [11]), "element numbers")
      call check(all(mesh%quad_part == [1]), "parts by their index")
      call check(all(mesh%quad_node(:, 1) == [1, 2, 3, 4]), "nodes by their index")
   end associate

   call begin("several blocks")
   call read_plate("*NODE|90,2.,0.,0.|80,2.,1.,0.|*ELEMENT_SHELL|9,7,2,90,80,3|")
   call check(.not. allocated(error), "are read")
   call check(all(model%mesh%quad_id == [11, 9]), "elements in the order of the deck")
   call check(all(model%mesh%quad_node(:, 2) == [2, 5, 6, 3]), "nodes in any order of numbers")

   call begin("quads of nine nodes")
   call read_nine("*ELEMENT_PLATE_Q9|1,7|1,3,9,7,2,6,8,4,5|")
   call check(.not. allocated(error), "of our own keyword are read")
   call check(all(model%mesh%quad_node(:, 1) == [1, 3, 9, 7, 2, 6, 8, 4, 5]), "in their order")
   call read_nine("*ELEMENT_SHELL|1,7,1,3,9,7,2,6,8,4,5|")
   call check(.not. allocated(error), "and of gmsh's line")
   call check(all(model%mesh%quad_node(:, 1) == [1, 3, 9, 7, 2, 6, 8, 4, 5]), "in the same order")

   call begin("errors")
   call read_plate("*ELEMENT_SHELL|12,7,1,2,3,44|")
   call check_error(error, "card 1 N4: node 44 is not defined", "an undefined node")
   call read_plate("*ELEMENT_SHELL|11,7,1,2,3,4|")
   call check_error(error, "element 11 is defined twice", "a number twice")
   call read_plate("*ELEMENT_SHELL|12,7,1,2,3,3|")
   call check_error(error, "a triangle", "a triangle")
   call read_plate("*ELEMENT_SHELL|12,7,1,2,3,1|")
   call check_error(error, "node 1 is in the element twice", "a node twice")

   call finish()

contains

   !> Write the plate and some more lines, parted by bars, and read it all
   subroutine read_plate(more)
      !> Lines behind those of the plate
      character(*), intent(in) :: more

      call read_lines(path, plate//more//"*END", model, messages, error)
   end subroutine read_plate

   !> Read a plate of nine nodes, three by three, with an element
   subroutine read_nine(element)
      !> Lines of the element
      character(*), intent(in) :: element

      integer, parameter :: nodes_at = index(plate, "*NODE"), plies_at = index(plate, "*MAT")

      call read_lines(path, plate(:nodes_at - 1)//"*NODE|1,0.,0.|2,1.,0.|3,2.,0.|4,0.,1.|5,1.,1.|" &
         & //"6,2.,1.|7,0.,2.|8,1.,2.|9,2.,2.|"//element//plate(plies_at:)//"*END", model, &
         & messages, error)
   end subroutine read_nine

end program test_input_mesh
