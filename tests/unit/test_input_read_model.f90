!> A deck may have its keywords in any order, in several files, and be large.
program test_input_read_model
   use decks, only : read_file
   use plydyn_base_error, only : error_type, exit_input
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, check_error, finish, write_lines
   implicit none

   character(*), parameter :: path = "test_input_read_model.k", other = "test_input_read_model_2.k"
   !> Quads along an edge of a large plate
   integer, parameter :: many = 200
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages

   call begin("order")
   call write_lines(path, "*KEYWORD|*CONTACT_IMPACTOR|1,1,1,1|*IMPACTOR_SPHERE|1,5.,1.,0.,0.,6.|" &
      & //"0.,0.,-1.|*BOUNDARY_SPC_SET|1,0,1,0,1|*SET_NODE_LIST|1,|3,|*SECTION_LAYERWISE|1,|" &
      & //"*ELEMENT_SHELL|1,1,1,2,3,4|*PART_COMPOSITE|p|1,|1,0.1|*MAT_ELASTIC|1,1.e-9,1.e5,0.|" &
      & //"*NODE|1,0.,0.|2,1.,0.|3,1.,1.|4,0.,1.|*CONTROL_TERMINATION|1.0,|*END")
   call read_file(path, model, messages, error)
   call check(.not. allocated(error), "a deck upside down is read")
   call check(len(messages), 0, "and there is nothing to say about it")

   call begin("include")
   call write_lines(other, "*NODE|1,0.,0.|2,1.,0.|3,1.,1.|4,0.,1.|")
   call write_lines(path, "*KEYWORD|*ELEMENT_SHELL|1,1,1,2,3,4|*PART_COMPOSITE|p|1,|1,0.1|" &
      & //"*MAT_ELASTIC|1,1.,1.,0.|*INCLUDE|"//other//"|*CONTROL_TERMINATION|1.0,|*END")
   call read_file(path, model, messages, error)
   call check(.not. allocated(error), "a deck in two files is read")
   call check(size(model%mesh%node_id), 4, "with the nodes of the second one")

   call begin("large decks")
   call write_large()
   call read_file(path, model, messages, error)
   call check(.not. allocated(error), "are read")
   call check(size(model%mesh%quad_id), many**2, "with all their elements")

   call begin("rigid elements")
   call write_lines(path, "*KEYWORD|*NODE|1,0.,0.|2,1.,0.|3,1.,1.|4,0.,1.|*ELEMENT_SHELL|" &
      & //"1,1,1,2,3,4|*PART_COMPOSITE|p|1,|1,0.1|*MAT_ELASTIC|1,1.,1.,0.|*MAT_RIGID|2,1.,1.,0.|" &
      & //"*CONTROL_TERMINATION|1.0,|*END")
   call read_file(path, model, messages, error)
   call check_error(error, "the deck has rigid elements", "what makes a sphere of them is said")

   call begin("errors")
   call read_file("nowhere.k", model, messages, error)
   call check_error(error, "the file 'nowhere.k' cannot be read", "a deck that is not there")
   call check(error%code, exit_input, "has the exit code of input")

   call finish()

contains

   !> Write a large deck in fixed columns
   subroutine write_large()
      integer :: i, j, unit

      open (newunit=unit, file=path, status="replace", action="write")
      write (unit, "(a)") "*KEYWORD", "*CONTROL_TERMINATION", "1.0,", "*MAT_ELASTIC", &
         & "1,1.e-9,1.e5,0.", "*PART_COMPOSITE", "p", "1,", "1,0.1", "*NODE"
      do j = 0, many
         do i = 0, many
            write (unit, "(i8,3es16.8)") j*(many + 1) + i + 1, real(i), real(j), 0.0
         end do
      end do
      write (unit, "(a)") "*ELEMENT_SHELL"
      do j = 0, many - 1
         do i = 1, many
            associate (first => j*(many + 1) + i, above => (j + 1)*(many + 1) + i)
               write (unit, "(6i8)") j*many + i, 1, first, first + 1, above + 1, above
            end associate
         end do
      end do
      write (unit, "(a)") "*END"
      close (unit)
   end subroutine write_large

end program test_input_read_model
