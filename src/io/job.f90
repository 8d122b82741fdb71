!> A job: paths of its files, origin of the run, units of screen and listing.
module plydyn_io_job
   use plydyn_base_archive, only : archive_type
   use plydyn_base_precision, only : wp
   use plydyn_io_job_lock, only : job_lock_type
   use plydyn_state_file_positions, only : file_positions_type
   implicit none
   private

   !> In place of a unit; no unit that is opened anew has this number
   integer, parameter, public :: no_unit = -1

   !> Common data of all files of a run
   type, public :: job_type
      !> Path of the results without endings
      character(:), allocatable :: path
      !> Path of the deck, and version of the program
      character(:), allocatable :: deck, version
      !> Units of the progress line and of the listing
      integer :: screen = no_unit, listing = no_unit
      !> Decks, word for word
      type(archive_type) :: archive
      !> Where to go on with files of an earlier run; of no length for a run that begins
      type(file_positions_type) :: places
      !> Whether a run that goes on has files of its own
      logical :: is_renamed = .false.
      !> Time at which this run begins
      real(wp) :: start_time = 0.0_wp
      !> Kept restart files that were written so far
      integer :: dumps = 0
      !> Keeps other runs of the job away
      type(job_lock_type) :: lock
   contains
      procedure :: note
   end type job_type

contains

   !> Write a note on the screen and in the listing
   subroutine note(self, words)
      class(job_type), intent(in) :: self
      !> A line, or several
      character(*), intent(in) :: words

      if (self%screen /= no_unit) then
         write (self%screen, "(a)") words
         flush (self%screen)
      end if
      if (self%listing /= no_unit) then
         write (self%listing, "(a)") words
         flush (self%listing)
      end if
   end subroutine note

end module plydyn_io_job
