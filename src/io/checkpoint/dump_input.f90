!> Restart files being read. Each rank opens the file and reads what it needs. HDF5 refuses to read
!> what is not what was written.
module plydyn_io_checkpoint_dump_input
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_archive, only : archive_type, bundle_type
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_memory, only : release_clear_pages
   use plydyn_base_precision, only : lanes, wp
   use plydyn_base_text, only : text
   use plydyn_io_checkpoint_dump, only : deck_group, dump_format, dump_kind, end_length, &
      & ending_mark, run_group, state_group, table_end
   use plydyn_io_checkpoint_state_layout, only : part_type, state_layout_type
   use plydyn_io_hdf5_input, only : hdf5_input_type
   use plydyn_io_input_guard, only : number_of_dump
   use plydyn_io_job, only : job_type
   use plydyn_model_control, only : changes_type
   use plydyn_state_exchange, only : exchange_state, exchange_type
   use plydyn_state_file_positions, only : file_position_type, new_file_positions
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> Arrays that belong to supports and loads
   character(*), parameter :: conditions(3) = [character(16) :: "load_factor", "support_force", &
      & "support_velocity"]

   !> A restart file being read
   type, public, extends(exchange_type) :: dump_input_type
      private
      !> The file
      type(hdf5_input_type) :: file
      !> Its path
      character(:), allocatable :: path
      !> Which places of the arrays this rank reads
      type(state_layout_type) :: parts
      !> What the deck of the restart changes: the file has other supports, loads or bodies
      type(changes_type) :: changes
      !> How the tables of results ended
      character(:), allocatable :: ends
      !> The first thing that went wrong
      type(error_type), allocatable :: error
   contains
      procedure :: open => open_dump
      procedure :: read_job
      procedure :: compare_results
      procedure :: read_state
      procedure :: reals => read_reals
      procedure :: integers => read_integers
   end type dump_input_type

contains

   !> Open a restart file
   subroutine open_dump(self, path, error)
      class(dump_input_type), intent(inout) :: self
      !> Path of the file
      character(*), intent(in) :: path
      !> The file is not one
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: kind
      integer :: form, width
      logical :: exists, good

      self%path = path
      inquire (file=path, exist=exists)
      if (.not. exists) then
         call fail(error, exit_input, "there is no restart file "//path//": one is named " &
            & //"JOB.dump01 or JOB.runrsf")
         return
      end if
      call self%file%open(path, good)
      if (.not. good) then
         call fail(error, exit_input, path//" is no restart file, or not a whole one: it must be " &
            & //"a file JOB.dump01 or JOB.runrsf that plydyn wrote to its end")
         return
      end if
      call self%file%read_text(run_group, "kind", kind, good)
      if (.not. good .or. kind /= dump_kind) then
         call fail(error, exit_input, path//" is a file of HDF5, but no restart file of plydyn: " &
            & //"one is named JOB.dump01 or JOB.runrsf")
         return
      end if
      call self%file%read_number(run_group, "format", form, good)
      if (good) call self%file%read_number(run_group, "lanes", width, good)
      if (good) good = form == dump_format .and. width == lanes
      if (.not. good) call fail(error, exit_input, path//" was written by a plydyn that arranges " &
         & //"its data in another way: it must be read by the version that wrote it")
   end subroutine open_dump

   !> The decks, and where the files of results were
   subroutine read_job(self, job, error)
      class(dump_input_type), intent(inout) :: self
      !> Gets the decks, its own name beside the restart file, and the places in its files; its
      !> version is that of the program that wrote
      type(job_type), intent(inout) :: job
      !> The file is damaged
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: endings, name
      logical :: good(7)
      real(wp) :: clock(1)

      good(:) = .true.
      call self%file%read_text(run_group, "version", job%version, good(1))
      call self%file%read_text(run_group, "job", name, good(2))
      call self%file%read_text(run_group, "parameters", job%archive%parameters, good(3))
      call self%file%read_text(run_group, "endings", endings, good(4))
      call self%file%read_number(run_group, "dumps", job%dumps, good(5))
      job%path = self%path(:index(self%path, "/", back=.true.))//name
      job%dumps = max(job%dumps, number_of_dump(self%path))
      if (all(good)) call read_places(self, endings, job, good(5))
      if (all(good)) call read_decks(self, job%archive, good(6))
      if (all(good)) call self%file%read_reals(state_group//"/time", clock, good(7))
      job%start_time = clock(1)
      if (.not. all(good(:6))) then
         call fail(error, exit_input, self%path//" is damaged: go on from another restart file")
      else if (.not. good(7)) then
         call fail(error, exit_input, self%path//" is damaged: the time is not what was " &
            & //"written; go on from another restart file")
      end if
      if (.not. allocated(error)) job%deck = job%archive%bundles(1)%documents(1)%path
   end subroutine read_job

   !> Refuse to go on with tables that are not those of the run; one that is not there is not
   !> compared. The root must come here before anything is written to them
   subroutine compare_results(self, job, error)
      class(dump_input_type), intent(in) :: self
      !> As `read_job` gave it
      type(job_type), intent(in) :: job
      !> A file is of another run
      type(error_type), allocatable, intent(out) :: error

      character(end_length) :: found
      integer :: i

      associate (positions => job%places)
         do i = 1, size(positions%list)
            found = table_end(positions, i)
            associate (kept => self%ends(end_length*(i - 1) + 1:end_length*i))
               if (found == kept .or. found == "" .or. kept == "") cycle
            end associate
            call fail(error, exit_input, positions%job//trim(positions%list(i)%ending)//" is of " &
               & //"another run than the restart file: bring back the results that belong to it, " &
               & //"or give the restart files of its own with -j JOB")
            return
         end do
      end associate
   end subroutine compare_results

   !> How far the files of results had been written
   subroutine read_places(self, endings, job, good)
      class(dump_input_type), intent(inout) :: self
      character(*), intent(in) :: endings
      type(job_type), intent(inout) :: job
      logical, intent(out) :: good

      real(wp), allocatable :: table(:)
      integer :: first, i, last

      job%places = new_file_positions(job%path)
      allocate (table(max(0, self%file%extent(run_group//"/places"))))
      call self%file%read_reals(run_group//"/places", table, good)
      if (good) call self%file%read_bytes(run_group//"/ends", self%ends, good)
      if (good) good = len(self%ends) == end_length*(size(table)/3)
      if (.not. good) return
      first = 1
      do i = 1, size(table)/3
         last = first + index(endings(first:), ending_mark) - 2
         associate (row => table(3*i - 2:3*i))
            call job%places%add(job%path//endings(first:last), &
               & file_position_type(amount=nint(row(1), &
               & int64), interval=row(2), next=nint(row(3), int64)))
         end associate
         first = last + 2
      end do
   end subroutine read_places

   !> The decks, word for word
   subroutine read_decks(self, archive, good)
      class(dump_input_type), intent(in) :: self
      type(archive_type), intent(inout) :: archive
      logical, intent(out) :: good

      type(bundle_type) :: bundle
      character(:), allocatable :: content, group, path
      integer :: d
      real(wp), allocatable :: starts(:)

      good = self%file%has(deck_group)
      allocate (archive%bundles(0))
      do while (good)
         group = deck_group//"/"//text(size(archive%bundles) + 1)
         if (.not. self%file%has(group)) exit
         if (allocated(bundle%documents)) deallocate (bundle%documents)
         allocate (bundle%documents(0))
         d = 1
         do while (self%file%has(group//"/"//text(d)))
            call self%file%read_bytes(group//"/"//text(d), content, good)
            if (good) call self%file%read_text(group//"/"//text(d), "path", path, good)
            if (.not. good) return
            call bundle%add_document(path, content)
            d = d + 1
         end do
         call archive%add_bundle(bundle)
      end do
      good = good .and. size(archive%bundles) > 0
      if (good) then
         allocate (starts(size(archive%bundles)))
         call self%file%read_reals(run_group//"/starts", starts, good)
         archive%bundles%start = starts
      end if
      if (good) good = size(archive%bundles(1)%documents) > 0
   end subroutine read_decks

   !> Read the state and close the file; all ranks must come here
   subroutine read_state(self, parts, changes, state, error)
      class(dump_input_type), intent(inout) :: self
      !> Which places of the arrays this rank reads
      type(state_layout_type), intent(in) :: parts
      !> Supports, loads and bodies that are not those of the file are left alone
      type(changes_type), intent(in) :: changes
      !> The state, with the arrays of the model allocated; those that are not take any length
      type(state_type), intent(inout) :: state
      !> The file is damaged or not for this model; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      self%parts = parts
      self%changes = changes
      call exchange_state(self, state)
      call release_clear_pages(state%history)
      call self%file%close()
      if (allocated(self%error)) call move_alloc(self%error, error)
      call parts%comm%broadcast_error(error)
   end subroutine read_state

   !> Whether an array is not the file's: it belongs to supports, loads or bodies of the deck of the
   !> restart. Contacts begin anew where any body does
   logical function is_new(self, name)
      class(dump_input_type), intent(in) :: self
      !> Name of the array
      character(*), intent(in) :: name

      is_new = self%changes%conditions .and. any(conditions == name)
      if (is_new .or. .not. self%changes%bodies) return
      is_new = index(name, "contact_") == 1
      if (index(name, "impactor_") == 1 .or. index(name, "fixture_") == 1) then
         is_new = .not. self%file%has(state_group//"/"//name)
      end if
   end function is_new

   !> Read an array, unless something went wrong before
   subroutine read_reals(self, name, values)
      class(dump_input_type), intent(inout) :: self
      character(*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: values(:)

      logical :: good

      if (is_new(self, name)) return
      if (self%parts%is_divided(name)) then
         call read_part(self, name, values)
         return
      end if
      if (allocated(self%error)) return
      if (.not. allocated(values)) then
         allocate (values(max(0, self%file%extent(state_group//"/"//name))))
      end if
      call self%file%read_reals(state_group//"/"//name, values, good)
      if (.not. good) call complain(self, name, size(values))
   end subroutine read_reals

   !> Read a band of an array, and get from other ranks what this one has. After an error, too: all
   !> ranks send their bands to those that wait for them
   subroutine read_part(self, name, values)
      class(dump_input_type), intent(inout) :: self
      character(*), intent(in) :: name
      real(wp), intent(inout), contiguous :: values(:)

      real(wp), allocatable :: band(:, :)
      type(part_type) :: part
      logical :: good

      part = self%parts%part(name)
      allocate (band(1, part%had%count), source=0.0_wp)
      if (.not. allocated(self%error)) then
         good = self%file%extent(state_group//"/"//name) == part%had%whole
         if (good) call self%file%read_rows(state_group//"/"//name, int(part%had%first, int64), &
            & band, good)
         if (.not. good) call complain(self, name, part%had%whole)
      end if
      call part%had%scatter(band(1, :), values)
   end subroutine read_part

   !> Read an array, unless something went wrong before
   subroutine read_integers(self, name, values)
      class(dump_input_type), intent(inout) :: self
      character(*), intent(in) :: name
      integer, allocatable, intent(inout) :: values(:)

      logical :: good

      if (allocated(self%error)) return
      if (is_new(self, name)) return
      if (.not. allocated(values)) then
         allocate (values(max(0, self%file%extent(state_group//"/"//name))))
      end if
      call self%file%read_integers(state_group//"/"//name, values, good)
      if (.not. good) call complain(self, name, size(values))
   end subroutine read_integers

   !> An array that cannot be read
   subroutine complain(self, name, length)
      class(dump_input_type), intent(inout) :: self
      character(*), intent(in) :: name
      !> Numbers that the model has of it
      integer, intent(in) :: length

      if (self%file%extent(state_group//"/"//name) == length) then
         call fail(self%error, exit_input, self%path//" is damaged: the "//name//" is not what " &
            & //"was written; go on from another restart file")
      else
         call fail(self%error, exit_input, self%path//" does not hold the "//name//" of the " &
            & //"model that its deck describes: it is damaged, or of another version of plydyn")
      end if
   end subroutine complain

end module plydyn_io_checkpoint_dump_input
