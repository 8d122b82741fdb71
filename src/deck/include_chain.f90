!> Files that include each other: none leads back to itself, and there are not too many.
module plydyn_deck_include_chain
   use plydyn_base_file_identity, only : is_same_file
   use plydyn_base_text, only : text
   use plydyn_deck_file, only : file_type
   use plydyn_deck_report, only : deck_location_type, report_type
   implicit none
   private

   public :: check_chain

   !> Most files that lead from a deck to one that is included, and most files of all decks
   integer, parameter :: most_depth = 100, most_files = 10000

contains

   !> A file is none of those that lead to it, by whatever path, and there are not too many of them
   subroutine check_chain(files, file, place, report, is_fine)
      !> Files so far
      type(file_type), intent(in) :: files(:)
      !> The file, without its content
      type(file_type), intent(in) :: file
      !> Line that includes it
      type(deck_location_type), intent(in) :: place
      !> Findings
      type(report_type), intent(inout) :: report
      !> Whether it can be read
      logical, intent(out) :: is_fine

      integer :: ancestor

      is_fine = .false.
      ancestor = file%parent
      do while (ancestor > 0)
         associate (other => files(ancestor))
            if (other%path == file%path .or. is_same_file(other%identity, file%identity)) exit
         end associate
         ancestor = files(ancestor)%parent
      end do
      if (ancestor > 0) then
         call report%refuse(place, "the file '"//file%path//"' includes itself", &
            & "a file that does not lead back to one that is being read")
      else if (file%depth > most_depth) then
         call report%refuse(place, "the file '"//file%path//"' is the last of more than " &
            & //text(most_depth)//" that include each other", "files that are nested less deeply")
      else if (size(files) >= most_files) then
         call report%refuse(place, "the file '"//file%path//"' is one of more than " &
            & //text(most_files), "fewer *INCLUDE; a file may be included only where it is needed")
      else
         is_fine = .true.
      end if
   end subroutine check_chain

end module plydyn_deck_include_chain
