!> Restart files: everything with which a run goes on as if nothing had happened.
!>
!> One file of HDF5 holds the decks word for word, the state, and how far every file of results had
!> been written. It is written beside its place and renamed when it is whole and on the disk, so
!> that a kill at any moment leaves the one before. Arrays are in the order of the whole model: of
!> those that ranks have parts of, each writes a band.
module plydyn_io_checkpoint_dump
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_archive, only : archive_type
   use plydyn_base_error, only : error_type, exit_output, fail
   use plydyn_base_files, only : remove_file, secure_file
   use plydyn_base_precision, only : lanes, wp
   use plydyn_base_text, only : text
   use plydyn_io_checkpoint_check_sum, only : sum_name, sum_text, sums_of
   use plydyn_io_hdf5_output, only : hdf5_output_type, store_double, store_integer
   use plydyn_io_job, only : job_type
   use plydyn_state_file_positions, only : file_positions_type
   use plydyn_io_checkpoint_state_layout, only : part_type, state_layout_type
   use plydyn_state_exchange, only : exchange_state, exchange_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: sums_of_run, write_dump

   !> What the file says it is, and the version of its layout: a new one whenever columns of points,
   !> histories or what contact remembers are arranged anew
   character(*), parameter, public :: dump_kind = "restart file of plydyn"
   integer, parameter, public :: dump_format = 6
   !> Groups
   character(*), parameter, public :: run_group = "run", deck_group = "decks", &
      & state_group = "state"
   !> Between two endings of files
   character(1), parameter, public :: ending_mark = "/"

   !> Behind the name of a file that is not whole yet
   character(*), parameter :: in_the_making = ".part"

   !> Writes a state
   type, extends(exchange_type) :: state_writer_type
      !> The file
      type(hdf5_output_type) :: file
      !> What this rank has of it
      type(state_layout_type) :: parts
      !> The first thing that went wrong
      type(error_type), allocatable :: error
   contains
      procedure :: reals => write_reals
      procedure :: integers => write_integers
   end type state_writer_type

contains

   !> Write a restart file, in place of one that was there; all ranks must come here
   subroutine write_dump(path, job, places, parts, state, error)
      !> Path of the file
      character(*), intent(in) :: path
      !> The job, the same on all ranks
      type(job_type), intent(in) :: job
      !> How far the files of results have been written, the same on all ranks
      type(file_positions_type), intent(in) :: places
      !> Which places of the arrays this rank has
      type(state_layout_type), intent(in) :: parts
      !> Its state, with the memory of contacts
      type(state_type), intent(inout) :: state
      !> Why the file is not there, the same on all ranks; one that was there before still is
      type(error_type), allocatable, intent(out) :: error

      type(state_writer_type) :: writer

      writer%parts = parts
      call writer%file%create(path//in_the_making, parts%comm, error)
      if (allocated(error)) return
      call write_run(writer%file, job, places, error)
      if (.not. allocated(error)) call write_decks(writer%file, job%archive, error)
      if (.not. allocated(error)) call writer%file%make_group(state_group, error)
      if (.not. allocated(error)) then
         call exchange_state(writer, state)
         if (allocated(writer%error)) call move_alloc(writer%error, error)
      end if
      if (.not. allocated(error)) call writer%file%close(error)
      if (.not. allocated(error)) call put_in_place(writer%file, path, error)
      if (allocated(error) .and. parts%comm%is_root()) call remove_file(path//in_the_making)
   end subroutine write_dump

   !> Give a whole file its name, once all that any rank wrote is on the disk
   subroutine put_in_place(file, path, error)
      type(hdf5_output_type), intent(inout) :: file
      character(*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error

      logical :: good

      ! each rank: what it wrote may be held back by the machine that it runs on
      call secure_file(file%path, good)
      call file%agree(good)
      if (good) call file%rename(path, error)
      if (.not. good .or. allocated(error)) call fail(error, exit_output, &
         & "cannot bring the restart file "//path//" to its disk")
   end subroutine put_in_place

   !> What kind of file this is, and where the files of results were
   subroutine write_run(file, job, places, error)
      type(hdf5_output_type), intent(inout) :: file
      type(job_type), intent(in) :: job
      type(file_positions_type), intent(in) :: places
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: endings
      real(wp), allocatable :: table(:, :)
      integer :: i

      call file%make_group(run_group, error)
      if (allocated(error)) return
      call file%write_text(run_group, "kind", dump_kind, error)
      if (allocated(error)) return
      call file%write_text(run_group, "version", job%version, error)
      if (allocated(error)) return
      call file%write_text(run_group, "job", job%path(index(job%path, "/", back=.true.) + 1:), &
         & error)
      if (allocated(error)) return
      call file%write_text(run_group, "parameters", job%archive%parameters, error)
      if (allocated(error)) return
      call file%write_number(run_group, "format", dump_format, error)
      if (allocated(error)) return
      call file%write_number(run_group, "lanes", lanes, error)
      if (allocated(error)) return
      call file%write_number(run_group, "dumps", job%dumps, error)
      if (allocated(error)) return
      endings = ""
      allocate (table(3, size(places%list)))
      do i = 1, size(places%list)
         associate (place => places%list(i))
            endings = endings//trim(place%ending)//ending_mark
            table(:, i) = [real(place%amount, wp), place%interval, real(place%next, wp)]
         end associate
      end do
      call file%write_text(run_group, "endings", endings, error)
      if (allocated(error)) return
      call file%write_values(run_group//"/places", table, store_double, error)
      if (.not. allocated(error)) call file%write_text(run_group, sum_name, &
         & sum_text(sums_of_run(job%archive%parameters, endings, reshape(table, [size(table)]))), &
         & error)
   end subroutine write_run

   !> Sums of what a restart file says of its run
   pure function sums_of_run(parameters, endings, places) result(sums)
      !> Numbers for parameters, endings of files, and how far these were written
      character(*), intent(in) :: parameters, endings
      real(wp), intent(in) :: places(:)
      integer(int64) :: sums(2)

      sums(:) = sums_of(parameters//endings) + sums_of(places, 0)
   end function sums_of_run

   !> The decks, word for word
   subroutine write_decks(file, archive, error)
      type(hdf5_output_type), intent(inout) :: file
      type(archive_type), intent(in) :: archive
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: group, name
      integer :: b, d

      call file%make_group(deck_group, error)
      if (allocated(error)) return
      do b = 1, size(archive%bundles)
         group = deck_group//"/"//text(b)
         call file%make_group(group, error)
         if (allocated(error)) return
         do d = 1, size(archive%bundles(b)%documents)
            associate (document => archive%bundles(b)%documents(d))
               name = group//"/"//text(d)
               call file%write_bytes(name, document%content, error)
               if (allocated(error)) return
               call file%write_text(name, "path", document%path, error)
               if (allocated(error)) return
               call file%write_text(name, sum_name, sum_text(sums_of(document%content)), error)
               if (allocated(error)) return
            end associate
         end do
      end do
   end subroutine write_decks

   !> Write an array, unless something went wrong before
   subroutine write_reals(self, name, values)
      class(state_writer_type), intent(inout) :: self
      character(*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: values(:)

      real(wp), allocatable :: band(:)
      integer(int64) :: sums(2, 1)
      type(part_type) :: part

      if (allocated(self%error)) return
      if (self%parts%is_divided(name)) then
         part = self%parts%part(name)
         allocate (band(part%counted%count), source=0.0_wp)
         call part%counted%gather(values, band)
         call self%file%write_values(state_group//"/"//name, band, store_double, self%error, &
            & part%slab())
         sums(:, 1) = sums_of(band, part%had%first)
         call self%parts%comm%sum(sums)
      else
         call self%file%write_values(state_group//"/"//name, values, store_double, self%error)
         sums(:, 1) = sums_of(values, 0)
      end if
      call write_sums(self, name, sums(:, 1))
   end subroutine write_reals

   !> Write an array, unless something went wrong before
   subroutine write_integers(self, name, values)
      class(state_writer_type), intent(inout) :: self
      character(*), intent(in) :: name
      integer, allocatable, intent(inout) :: values(:)

      if (allocated(self%error)) return
      call self%file%write_values(state_group//"/"//name, values, store_integer, self%error)
      call write_sums(self, name, sums_of(values))
   end subroutine write_integers

   !> Say beside an array what its numbers add up to
   subroutine write_sums(self, name, sums)
      class(state_writer_type), intent(inout) :: self
      character(*), intent(in) :: name
      integer(int64), intent(in) :: sums(2)

      if (.not. allocated(self%error)) call self%file%write_text(state_group//"/"//name, sum_name, &
         & sum_text(sums), self%error)
   end subroutine write_sums

end module plydyn_io_checkpoint_dump
