!> Restart files: everything with which a run goes on as if nothing had happened.
!>
!> One file of HDF5 holds the decks word for word, the state, and how far every file of results had
!> been written. It is written beside its place and renamed when it is whole and on the disk, so
!> that a kill at any moment leaves the one before. Arrays are in the order of the whole model; each
!> rank has a band of those that are divided. HDF5 keeps a check sum of each chunk of an array
!> (Fletcher32) and, in its latest format, of all metadata, the attributes among them.
module plydyn_io_checkpoint_dump
   use plydyn_base_archive, only : archive_type
   use plydyn_base_error, only : error_type
   use plydyn_base_files, only : bytes_of_file, remove_file
   use plydyn_base_precision, only : lanes, wp
   use plydyn_base_text, only : text
   use plydyn_io_checkpoint_state_layout, only : part_type, state_layout_type
   use plydyn_io_hdf5_output, only : hdf5_output_type, hyperslab_type, store_double, store_integer
   use plydyn_io_job, only : job_type
   use plydyn_state_exchange, only : exchange_state, exchange_type
   use plydyn_state_file_positions, only : file_positions_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: table_end, write_dump

   !> What the file says it is, and the version of its layout: a new one whenever columns of points,
   !> histories, the memory of contact or other numbers of the state are arranged anew, and whenever
   !> empty fields of the decks in it get another meaning
   character(*), parameter, public :: dump_kind = "restart file of plydyn"
   integer, parameter, public :: dump_format = 19
   !> Groups
   character(*), parameter, public :: run_group = "run", deck_group = "decks", &
      & state_group = "state"
   !> Between two endings of files
   character(1), parameter, public :: ending_mark = "/"

   !> Bytes of the end of a table that the file keeps: a table of another run under the same name
   !> ends otherwise there
   integer, parameter, public :: end_length = 64
   !> Behind the name of a file that is not whole yet
   character(*), parameter :: in_the_making = ".part"

   !> Writes a state
   type, extends(exchange_type) :: state_writer_type
      !> The file
      type(hdf5_output_type) :: file
      !> What this rank has of it
      type(state_layout_type) :: parts
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
      call writer%file%create(path//in_the_making, parts%comm, error, is_checked=.true.)
      if (.not. allocated(error)) call write_content(writer, job, places, state, error)
      if (.not. allocated(error)) call writer%file%secure(error)
      if (.not. allocated(error)) call writer%file%rename(path, error)
      if (allocated(error) .and. parts%comm%is_root()) call remove_file(path//in_the_making)
   end subroutine write_dump

   !> Write all that the file holds, and close it
   subroutine write_content(writer, job, places, state, error)
      type(state_writer_type), intent(inout) :: writer
      !> As in `write_dump`
      type(job_type), intent(in) :: job
      type(file_positions_type), intent(in) :: places
      type(state_type), intent(inout) :: state
      type(error_type), allocatable, intent(out) :: error

      call write_run(writer%file, job, places)
      call write_decks(writer%file, job%archive)
      associate (starts => job%archive%bundles%start)
         call writer%file%write_values(run_group//"/starts", shape(starts), starts, store_double)
      end associate
      call writer%file%make_group(state_group)
      call exchange_state(writer, state)
      call writer%file%close(error)
   end subroutine write_content

   !> What kind of file this is, and where the files of results were
   subroutine write_run(file, job, places)
      type(hdf5_output_type), intent(inout) :: file
      type(job_type), intent(in) :: job
      type(file_positions_type), intent(in) :: places

      character(:), allocatable :: endings, ends
      real(wp) :: table(3, size(places%list))
      integer :: i

      call file%make_group(run_group)
      call file%write_text(run_group, "kind", dump_kind)
      call file%write_text(run_group, "version", job%version)
      call file%write_text(run_group, "job", job%path(index(job%path, "/", back=.true.) + 1:))
      call file%write_text(run_group, "parameters", job%archive%parameters)
      call file%write_numbers(run_group, "format", [dump_format])
      call file%write_numbers(run_group, "lanes", [lanes])
      call file%write_numbers(run_group, "dumps", [job%dumps])
      endings = ""
      ends = ""
      do i = 1, size(places%list)
         associate (place => places%list(i))
            endings = endings//trim(place%ending)//ending_mark
            table(:, i) = [real(place%amount, wp), place%interval, real(place%next, wp)]
         end associate
         if (file%writes()) ends = ends//table_end(places, i)
      end do
      call file%write_text(run_group, "endings", endings)
      call file%write_bytes(run_group//"/ends", ends)
      call file%write_values(run_group//"/places", shape(table), table, store_double)
   end subroutine write_run

   !> The decks, word for word
   subroutine write_decks(file, archive)
      type(hdf5_output_type), intent(inout) :: file
      type(archive_type), intent(in) :: archive

      character(:), allocatable :: group, name
      integer :: b, d

      call file%make_group(deck_group)
      do b = 1, size(archive%bundles)
         group = deck_group//"/"//text(b)
         call file%make_group(group)
         do d = 1, size(archive%bundles(b)%documents)
            associate (document => archive%bundles(b)%documents(d))
               name = group//"/"//text(d)
               call file%write_bytes(name, document%content)
               call file%write_text(name, "path", document%path)
            end associate
         end do
      end do
   end subroutine write_decks

   !> Write an array
   subroutine write_reals(self, name, values)
      class(state_writer_type), intent(inout) :: self
      character(*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: values(:)

      real(wp), allocatable :: band(:)
      type(part_type) :: part

      if (self%parts%is_divided(name)) then
         part = self%parts%part(name)
         allocate (band(part%counted%count), source=0.0_wp)
         call part%counted%gather(values, band)
         call self%file%write_values(state_group//"/"//name, shape(band), band, store_double, &
            & hyperslab_type(whole=part%had%whole, first=part%had%first, count=part%had%count))
      else
         call self%file%write_values(state_group//"/"//name, shape(values), values, store_double)
      end if
   end subroutine write_reals

   !> Write an array of integers
   subroutine write_integers(self, name, values)
      class(state_writer_type), intent(inout) :: self
      character(*), intent(in) :: name
      integer, allocatable, intent(inout) :: values(:)

      call self%file%write_values(state_group//"/"//name, shape(values), real(values, wp), &
         & store_integer)
   end subroutine write_integers

   !> Last bytes of a table before its position; blank for a file that is none or not so long
   function table_end(positions, i) result(bytes)
      !> How far the files have been written
      type(file_positions_type), intent(in) :: positions
      !> Number of the file
      integer, intent(in) :: i
      character(end_length) :: bytes

      bytes = ""
      associate (position => positions%list(i))
         if (index(position%ending, ".csv ", back=.true.) == 0) return
         if (position%amount < end_length) return
         bytes = bytes_of_file(positions%job//trim(position%ending), &
            & position%amount - end_length, end_length)
      end associate
   end function table_end

end module plydyn_io_checkpoint_dump
