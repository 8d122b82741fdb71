!> Restart files: what was written is read, and nothing else is taken for one.
program test_io_checkpoint_dump
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_archive, only : bundle_type
   use plydyn_base_error, only : error_type
   use plydyn_base_files, only : remove_file
   use plydyn_base_precision, only : wp
   use plydyn_io_checkpoint_dump, only : write_dump
   use plydyn_io_checkpoint_dump_input, only : dump_input_type
   use plydyn_io_hdf5_output, only : hdf5_output_type
   use plydyn_io_job, only : job_type
   use plydyn_model_control, only : changes_type
   use plydyn_state_file_positions, only : new_file_positions, file_position_type
   use plydyn_io_checkpoint_state_layout, only : state_layout_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_state_state, only : constraint_state_type, state_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_io_checkpoint_dump.dump01"
   type(error_type), allocatable :: error
   type(job_type) :: job
   type(state_layout_type) :: alone
   type(state_type) :: state

   call write_one()
   call read_one()
   call other_conditions()
   call other_model()
   call other_files()
   call results_of_another_run()
   call count_of_files()
   call remove_file(path)
   call finish()

contains

   !> Write a file
   subroutine write_one()
      type(bundle_type) :: bundle
      logical :: exists

      call begin("write_dump")
      job%path = "test_io_checkpoint_dump"
      job%version = "0.1"
      job%dumps = 3
      job%places = new_file_positions(job%path)
      call job%places%add("test_io_checkpoint_dump.energy.csv", &
         & file_position_type(amount=12345678901_int64, &
         & interval=0.1_wp, next=7_int64))
      job%archive%parameters = "speed=3"//new_line("a")
      allocate (job%archive%bundles(0), bundle%documents(0))
      call bundle%add_document("deck.k", "*KEYWORD"//char(228)//new_line("a")//"*END")
      call bundle%add_document("empty.k", "")
      call job%archive%add_bundle(bundle)
      call fill(state)
      call write_dump(path, job, job%places, alone, state, error)
      call check(.not. allocated(error), "writes")
      inquire (file=path//".part", exist=exists)
      call check(.not. exists, "leaves nothing beside")
      call write_dump("no/such/folder/x", job, job%places, alone, state, error)
      call check_error(error, "no/such/folder/x", "a folder that is not there")
   end subroutine write_one

   !> A state of few numbers, none of them the same
   subroutine fill(state)
      type(state_type), intent(out) :: state

      state%time = 0.1_wp
      state%cycle = 17
      state%end%time = 2.0_wp
      state%end%largest_power = 2.25_wp
      state%step = 3.0_wp
      state%step_before = 4.0_wp
      state%sums%acceleration_square = 5.0_wp
      state%energies%momentum = [6.0_wp, 7.0_wp, 8.0_wp]
      state%displacement = [1.0_wp/3.0_wp, 2.0_wp, -0.0_wp]
      state%velocity = -state%displacement
      state%acceleration = 2.0_wp*state%displacement
      allocate (state%history(0), state%supports%load_factor(1), state%supports%force(2))
      state%supports%load_factor(:) = 9.0_wp
      state%supports%force(:) = [10.0_wp, 11.0_wp]
      state%supports%constraints = constraint_state_type([0.5_wp], [0.75_wp], [1.25_wp])
      allocate (state%supports%velocity(0), state%impactors(1), state%contacts(1), &
         & state%fixtures(1))
      state%fixtures(1)%impulse(:) = [1.5_wp, -2.5_wp, 3.5_wp]
      state%fixtures(1)%contacts = 4
      state%fixtures(1)%friction = 0.25_wp
      state%impactors(1)%centre(:) = [12.0_wp, 13.0_wp, 14.0_wp]
      state%impactors(1)%contacts = 15
      state%contacts(1)%places = [16, 17]
      state%contacts(1)%numbers = [18.0_wp]
   end subroutine fill

   !> Read it
   subroutine read_one()
      type(dump_input_type) :: dump
      type(job_type) :: found
      type(state_type) :: other

      call begin("read_dump")
      call dump%open(path, error)
      call check(.not. allocated(error), "opens")
      call dump%read_job(found, error)
      call check(.not. allocated(error), "tells its job")
      call check(found%path == "test_io_checkpoint_dump" .and. found%dumps == 3 &
         & .and. found%deck == &
         & "deck.k" .and. found%version == "0.1", "name, count, deck, version")
      associate (place => found%places%at("test_io_checkpoint_dump.energy.csv"))
         call check(place%amount == 12345678901_int64 .and. place%next == 7_int64, "places")
         call check(place%interval, 0.1_wp, 0.0_wp, "with their intervals")
      end associate
      call check(found%archive%bundles(1)%documents(1)%content == &
         & job%archive%bundles(1)%documents(1)%content, "decks, byte for byte")
      call check(len(found%archive%bundles(1)%documents(2)%content), 0, "an empty file too")
      call check(found%archive%parameters == job%archive%parameters, "and parameters")
      call like(other)
      call dump%read_state(alone, changes_type(), other, error)
      call check(.not. allocated(error), "tells its state")
      call check(other%displacement, state%displacement, 0.0_wp, "motion")
      call check(other%energies%momentum, state%energies%momentum, 0.0_wp, "energies")
      associate (fixture => other%fixtures(1))
         call check([fixture%impulse, fixture%friction, real(fixture%contacts, wp)], &
            & [1.5_wp, -2.5_wp, 3.5_wp, 0.25_wp, 4.0_wp], 0.0_wp, "fixtures")
      end associate
      associate (own => other%supports%constraints)
         call check([own%force, own%rate, own%displacement], [0.5_wp, 0.75_wp, 1.25_wp], 0.0_wp, &
            & "constraints")
      end associate
      call check(other%end%largest_power, 2.25_wp, 0.0_wp, "the largest load")
      call check(other%sums%acceleration_square, 5.0_wp, 0.0_wp, "sums")
      call check(other%cycle == 17 .and. other%impactors(1)%contacts == 15, "whole numbers")
      call check(all(other%contacts(1)%places == [16, 17]), "memory of a contact")
   end subroutine read_one

   !> A state with the extents of the one written
   subroutine like(other)
      type(state_type), intent(out) :: other

      call fill(other)
      other%displacement(:) = 0.0_wp
      other%end%largest_power = 0.0_wp
      other%supports%constraints%rate(:) = 0.0_wp
      other%impactors(1)%contacts = 0
      other%fixtures(1)%impulse(:) = 0.0_wp
      other%fixtures(1)%friction = 0.0_wp
      other%fixtures(1)%contacts = 0
      deallocate (other%contacts(1)%places, other%contacts(1)%numbers)
   end subroutine like

   !> A state whose supports and loads are not those of the file
   subroutine other_conditions()
      type(dump_input_type) :: dump
      type(state_type) :: other

      call begin("read_state with other supports")
      call like(other)
      deallocate (other%supports%force)
      allocate (other%supports%force(3), source=1.0_wp)
      call dump%open(path, error)
      call dump%read_state(alone, changes_type(conditions=.true.), other, error)
      call check(.not. allocated(error), "goes on")
      call check(other%supports%force, spread(1.0_wp, 1, 3), 0.0_wp, "leaves them alone")
      call check(other%displacement, state%displacement, 0.0_wp, "takes the motion")
   end subroutine other_conditions

   !> A state of another size
   subroutine other_model()
      type(dump_input_type) :: dump
      type(state_type) :: other

      call begin("read_state refuses")
      call like(other)
      other%velocity = [other%velocity, 1.0_wp]
      call dump%open(path, error)
      call dump%read_state(alone, changes_type(), other, error)
      call check_error(error, "does not hold the velocity", "another number of points")
   end subroutine other_model

   !> Files that are none
   subroutine other_files()
      type(dump_input_type) :: dump
      type(hdf5_output_type) :: file
      character(*), parameter :: foreign = "test_io_checkpoint_dump.h5"
      integer :: unit

      call begin("open_dump refuses")
      call dump%open("nowhere.dump01", error)
      call check_error(error, "no restart file nowhere.dump01", "no file")
      open (newunit=unit, file=foreign, status="replace")
      write (unit, "(a)") "no HDF5"
      close (unit)
      call dump%open(foreign, error)
      call check_error(error, "is no restart file, or not a whole one", "a text")
      call file%create(foreign, comm_type(), error)
      call file%make_group("run")
      call file%close(error)
      call dump%open(foreign, error)
      call check_error(error, "but no restart file of plydyn", "another file of HDF5")
      call remove_file(foreign)
   end subroutine other_files

   !> A table that ends otherwise than when the file was written
   subroutine results_of_another_run()
      character(*), parameter :: table = "test_io_checkpoint_dump.energy.csv"
      type(dump_input_type) :: dump(2)
      type(job_type) :: found(2)
      integer :: i

      call begin("compare_results")
      call write_table(table, 100)
      job%places = new_file_positions(job%path)
      call job%places%add(table, file_position_type(amount=90_int64))
      call write_dump(path, job, job%places, alone, state, error)
      do i = 1, 2
         call dump(i)%open(path, error)
         call dump(i)%read_job(found(i), error)
         call dump(i)%compare_results(found(i), error)
         if (i == 1) call check(.not. allocated(error), "the table that was there")
         if (i == 2) call check_error(error, table//" is of another run", "another one")
         call write_table(table, 99)
      end do
      call remove_file(table)
   end subroutine results_of_another_run

   !> Write a table whose numbers depend on its length
   subroutine write_table(name, length)
      character(*), intent(in) :: name
      integer, intent(in) :: length

      integer :: i, unit

      open (newunit=unit, file=name, status="replace", access="stream", form="formatted")
      write (unit, "(*(i1))") [(mod(length + i, 10), i=1, length)]
      close (unit)
   end subroutine write_table

   !> A file whose name has a higher number than it says
   subroutine count_of_files()
      type(dump_input_type) :: dump
      type(job_type) :: found

      call begin("read_job")
      job%dumps = 0
      call write_dump(path, job, job%places, alone, state, error)
      call dump%open(path, error)
      call dump%read_job(found, error)
      call check(found%dumps, 1, "the next file does not replace it")
   end subroutine count_of_files

end program test_io_checkpoint_dump
