!> Laminates have their plies and layers.
program test_input_part
   use decks, only : plate, read_lines
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_model_layup, only : faces_tied
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_input_part.k"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages

   call begin("read_part_composite")
   call read_plate("")
   associate (part => model%parts(1))
      call check(part%id == 7 .and. part%title == "plate", "number and title")
      call check(part%plies%thickness, [0.25_wp, 0.25_wp, 0.5_wp], 0.0_wp, "thicknesses")
      call check(part%plies%angle, [0.0_wp, 90.0_wp, 0.0_wp], 0.0_wp, "angles")
      call check(all(part%plies%id == [1, 2, 3]), "numbers by place")
      call check(all(part%plies%order == 2) .and. all(part%plies%layers == 1), "usual expansion")
      call check(all(part%joint == faces_tied) .and. size(part%joint) == 2, "tied interfaces")
      call check(part%bottom_offset, -0.5_wp, 0.0_wp, "nodes in the mid-plane")
   end associate
   call read_with("*PART_COMPOSITE_LONG|p|7,0,0.,1.|5,0.25,0.,0,30|5,0.25,0.,0,20|")
   call check(all(model%parts(1)%plies%id == [30, 20]), "numbers as given")
   call check(model%parts(1)%bottom_offset, -1.0_wp, 0.0_wp, "nodes on the top face")
   call read_with("*PART_COMPOSITE_LONG|p|7,|5,0.25,0.,0,2|5,0.25,0.,0,0|")
   call check_error(error, "ply 2 is in the part twice", "a number twice")

   call begin("read_part_composite")
   call read_with("*PART_COMPOSITE|p|7,|5,0.25,0.,0,5,0.25,45.|5,0.5,90.|")
   call check(.not. allocated(error), "is read")
   call check(model%parts(1)%plies%angle, [0.0_wp, 45.0_wp, 90.0_wp], 0.0_wp, &
      & "an odd number of plies")
   call read_with("*PART_COMPOSITE|p|7,16|5,0.25,0.|")
   call check(index(messages, "ELFORM is without effect") > 0, "an element form makes a note")
   call read_with("*PART_COMPOSITE|p|7,|5,0.25,0.|5,0.5,90.|")
   call check_error(error, "a ply is missing within the stack", "a gap in the stack")
   call read_with("*PART_COMPOSITE|p|7,|5,0.25,0.,0,5|")
   call check_error(error, "THICK2: the ply has no thickness", "a ply without thickness")
   call read_with("*PART_COMPOSITE|p|7,|5,0.25,0.,0,0,0.25|")
   call check_error(error, "the second ply has no material", "a ply without material")

   call begin("read_section_layerwise")
   call read_plate("*SECTION_LAYERWISE|7,0,3,1,2,4|2,3,1,5|")
   call check(.not. allocated(error), "is read")
   call check(model%parts(1)%lobatto, "Gauss-Lobatto points")
   call check(all(model%parts(1)%plies%order == [3, 1, 1]), "orders")
   call check(all(model%parts(1)%plies%layers == [1, 5, 5]), "layers")
   call read_plate("*SECTION_LAYERWISE|7,0,3,0,1|")
   call check_error(error, "NQPLAN = 1 is not supported", "reduced quadrature")
   call read_plate("*SECTION_LAYERWISE|7,|3,2,1,5|")
   call check_error(error, "PLYID2 lies below PLYID1", "a range upside down")
   call read_plate("*SECTION_LAYERWISE|7,1|")
   call check_error(error, "THEORY cannot be 1", "another theory")

   call finish()

contains

   !> Write the plate and some more lines, parted by bars, and read it all
   subroutine read_plate(more)
      !> Lines behind those of the plate
      character(*), intent(in) :: more

      call read_lines(path, plate//more//"*END", model, messages, error)
   end subroutine read_plate

   !> Read the plate with another laminate
   subroutine read_with(part)
      !> Lines of the laminate
      character(*), intent(in) :: part

      call read_lines(path, plate(:index(plate, "*PART") - 1)//part//"*END", model, messages, error)
   end subroutine read_with

end program test_input_part
