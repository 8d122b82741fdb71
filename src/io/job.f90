!> A job: paths of its files, origin of the run, units of screen and listing, its decks; what the
!> root knows of it goes to all ranks. An observer that writes results of a job.
module plydyn_io_job
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_archive, only : archive_type
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_io_job_lock, only : job_lock_type
   use plydyn_method_observer, only : observer_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_state_file_positions, only : file_position_type, file_positions_type, &
      & new_file_positions
   implicit none
   private

   public :: broadcast_archive, broadcast_file_positions, broadcast_job

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

   !> Results of a job
   type, abstract, public, extends(observer_type) :: output_type
   contains
      procedure(open_output), deferred :: open
   end type output_type

   abstract interface
      !> Create the files, or go on with those of an earlier run. Nothing is opened where the deck
      !> asks for no such results. All ranks come here
      subroutine open_output(self, job, simulation, error)
         import :: error_type, job_type, output_type, simulation_type
         implicit none
         class(output_type), intent(inout) :: self
         !> The job, the same on all ranks
         type(job_type), intent(in) :: job
         class(simulation_type), intent(in) :: simulation
         !> Why a file could not be created; the same on all ranks
         type(error_type), allocatable, intent(out) :: error
      end subroutine open_output
   end interface

contains

   !> Write a note on the screen and in the listing, which the root alone has
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

   !> Let all ranks have the names of the job, its count of restart files, and the places in its
   !> files
   subroutine broadcast_job(comm, job)
      type(comm_type), intent(in) :: comm
      !> The root's in, the same on all ranks out
      type(job_type), intent(inout) :: job

      integer :: dumps(1)

      call comm%broadcast(job%path)
      call comm%broadcast(job%deck)
      call comm%broadcast(job%version)
      dumps(1) = job%dumps
      call comm%broadcast(dumps)
      job%dumps = dumps(1)
      call broadcast_file_positions(comm, job%path, job%places)
   end subroutine broadcast_job

   !> Let all ranks have the decks and the parameters of the root
   subroutine broadcast_archive(comm, archive)
      type(comm_type), intent(in) :: comm
      !> The root's in, the same on all ranks out
      type(archive_type), intent(inout) :: archive

      integer :: b, count(1), d
      real(wp) :: start(1)

      if (comm%ranks == 1) return
      call comm%broadcast(archive%parameters)
      if (comm%is_root()) count(1) = size(archive%bundles)
      call comm%broadcast(count)
      if (.not. comm%is_root()) then
         if (allocated(archive%bundles)) deallocate (archive%bundles)
         allocate (archive%bundles(count(1)))
      end if
      do b = 1, size(archive%bundles)
         associate (bundle => archive%bundles(b))
            start(1) = bundle%start
            call comm%broadcast(start)
            bundle%start = start(1)
            if (comm%is_root()) count(1) = size(bundle%documents)
            call comm%broadcast(count)
            if (.not. comm%is_root()) allocate (bundle%documents(count(1)))
            do d = 1, size(bundle%documents)
               call comm%broadcast(bundle%documents(d)%path)
               call comm%broadcast(bundle%documents(d)%content)
            end do
         end associate
      end do
   end subroutine broadcast_archive

   !> Let all ranks have the places
   subroutine broadcast_file_positions(comm, path, places)
      type(comm_type), intent(in) :: comm
      !> Path of the results without endings
      character(*), intent(in) :: path
      !> The root's in, the same on all ranks out
      type(file_positions_type), intent(inout) :: places

      character(:), allocatable :: ending
      real(wp) :: row(3)
      integer :: count(1), i

      if (comm%ranks == 1) return
      count(1) = size(places%list)
      call comm%broadcast(count)
      if (.not. comm%is_root()) then
         places = new_file_positions(path)
         deallocate (places%list)
         allocate (places%list(count(1)))
      end if
      do i = 1, count(1)
         associate (place => places%list(i))
            ending = place%ending
            row(:) = [real(place%amount, wp), place%interval, real(place%next, wp)]
            call comm%broadcast(ending)
            call comm%broadcast(row)
            place = file_position_type(ending, nint(row(1), int64), row(2), nint(row(3), int64))
         end associate
      end do
   end subroutine broadcast_file_positions

end module plydyn_io_job
