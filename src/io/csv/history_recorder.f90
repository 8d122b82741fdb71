!> Something that fills a history of its own.
module plydyn_io_csv_history_recorder
   use plydyn_base_error, only : error_type
   use plydyn_io_csv_history_file, only : history_type
   use plydyn_io_checkpoint_file_positions, only : file_positions_type
   implicit none
   private

   !> The file, which an extension opens and adds lines to
   type, public :: history_recorder_type
      !> The file; not open where nothing is asked for
      type(history_type) :: history
   contains
      procedure :: mark
      procedure :: close => close_recorder
   end type history_recorder_type

contains

   !> Put all lines on the disk, and note how far the file goes
   subroutine mark(self, places, error)
      class(history_recorder_type), intent(inout) :: self
      !> Places in all files
      type(file_positions_type), intent(inout) :: places
      !> Why they are not all there
      type(error_type), allocatable, intent(out) :: error

      call self%history%mark(places, error)
   end subroutine mark

   !> Close the file
   subroutine close_recorder(self, error)
      class(history_recorder_type), intent(inout) :: self
      !> Why it could not be closed
      type(error_type), allocatable, intent(out) :: error

      call self%history%close(error)
   end subroutine close_recorder

end module plydyn_io_csv_history_recorder
