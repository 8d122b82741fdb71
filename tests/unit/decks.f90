!> Small decks for the tests of readers.
module decks
   use plydyn_base_archive, only : archive_type
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_input_read_model, only : read_decks_of_run
   use plydyn_model_model, only : model_type
   use testing, only : write_lines
   implicit none
   private

   public :: read_file, read_lines, with_material

   !> A plate of one quad and three plies, and how long; lines parted by bars, without an end
   character(*), parameter, public :: plate = "*KEYWORD|*CONTROL_TERMINATION|1.0,|*NODE|" &
      & //"1,0.,0.,0.|2,1.,0.,0.|3,1.,1.,0.|4,0.,1.,0.|*ELEMENT_SHELL|11,7,1,2,3,4|" &
      & //"*MAT_PLY_ELASTIC|5,1.6e-9,1.4e5,1.0e4,1.0e4,0.3,0.3,0.45|5000.,4000.,3500.|" &
      & //"*PART_COMPOSITE_LONG|plate|7,|5,0.25|5,0.25,90.|5,0.5|"

contains

   !> The plate with another material, and an end
   pure function with_material(material) result(text)
      !> Lines of the material, number 5
      character(*), intent(in) :: material
      character(:), allocatable :: text

      text = plate(:index(plate, "*MAT") - 1)//material//plate(index(plate, "*PART"):)//"*END"
   end function with_material

   !> Write a deck and read it as a run without earlier decks does
   subroutine read_lines(path, text, model, messages, error)
      !> Path of the deck
      character(*), intent(in) :: path
      !> Its lines, parted by bars
      character(*), intent(in) :: text
      !> The model
      type(model_type), intent(out) :: model
      !> Warnings and notes
      character(:), allocatable, intent(out) :: messages
      !> What is wrong with the deck
      type(error_type), allocatable, intent(out) :: error

      call write_lines(path, text)
      call read_file(path, model, messages, error)
   end subroutine read_lines

   !> Read a deck as a run without earlier decks does
   subroutine read_file(path, model, messages, error)
      !> Path of the deck
      character(*), intent(in) :: path
      !> The model
      type(model_type), intent(out) :: model
      !> Warnings and notes
      character(:), allocatable, intent(out) :: messages
      !> What is wrong with the deck
      type(error_type), allocatable, intent(out) :: error

      type(archive_type) :: archive

      allocate (archive%bundles(0))
      archive%parameters = ""
      call read_decks_of_run(archive, path, 0.0_wp, model, messages, error)
   end subroutine read_file

end module decks
