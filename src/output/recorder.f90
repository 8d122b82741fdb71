!> Something that fills a history of its own.
module plydyn_output_recorder
   use plydyn_base_error, only : error_type
   use plydyn_output_history, only : history_type
   use plydyn_output_places, only : places_type
   implicit none
   private

   !> The file, which an extension opens and adds lines to
   type, public :: recorder_type
      !> The file; not open where nothing is asked for
      type(history_type) :: history
   contains
      procedure :: mark
      procedure :: close => close_recorder
   end type recorder_type

contains

   !> Put all lines on the disk, and note how far the file goes
   subroutine mark(self, places, error)
      class(recorder_type), intent(inout) :: self
      !> Places in all files
      type(places_type), intent(inout) :: places
      !> Why they are not all there
      type(error_type), allocatable, intent(out) :: error

      call self%history%mark(places, error)
   end subroutine mark

   !> Close the file
   subroutine close_recorder(self, error)
      class(recorder_type), intent(inout) :: self
      !> Why it could not be closed
      type(error_type), allocatable, intent(out) :: error

      call self%history%close(error)
   end subroutine close_recorder

end module plydyn_output_recorder
