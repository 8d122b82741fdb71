!> What the deck of a restart may change, and what becomes of the decks before it.
program test_input_changes
   use plydyn_base_archive, only : archive_type
   use plydyn_base_error, only : error_type
   use plydyn_base_files, only : remove_file
   use plydyn_base_precision, only : wp
   use plydyn_input_read_model, only : read_decks_of_run
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, check_error, finish, write_lines
   implicit none

   character(*), parameter :: path = "test_input_changes.k"
   character(*), parameter :: first_deck = "*KEYWORD|*CONTROL_TERMINATION|1.0,|" &
      & //"*PARAMETER|R scale,2.0|*NODE|1,0.,0.|2,1.,0.|3,1.,1.|4,0.,1.|" &
      & //"*ELEMENT_SHELL|1,1,1,2,3,4|" &
      & //"*PART_COMPOSITE|one|1|1,1.0,0.0|*MAT_ELASTIC|1,1.0,1.0,0.3|*SET_NODE_LIST|1|1,2|" &
      & //"*BOUNDARY_SPC_SET|1,0,1,1,1|*DEFINE_CURVE|1|0.,0.|1.,1.|" &
      & //"*LOAD_NODE_SET|1,3,1,&scale|*DATABASE_BINARY_D3DUMP|100,|*END|"
   type(archive_type) :: archive
   type(model_type) :: model
   character(:), allocatable :: messages
   type(error_type), allocatable :: error

   call first()
   call changed()
   call again()
   call refused()
   call finish()

contains

   !> A run that begins
   subroutine first()
      call begin("first deck")
      allocate (archive%bundles(0))
      archive%parameters = "Scale=5.0"//new_line("a")
      call read_text(first_deck)
      call check(.not. allocated(error), "it is read")
      call check(size(archive%bundles) == 1, "it is kept")
      call check(model%request%kept_cycles == 100, "restart files are asked for")
      call check(model%point_loads(1)%scale, 5.0_wp, 0.0_wp, "the command line sets a parameter")
      call check(.not. model%changes%conditions .and. .not. model%changes%end, "nothing changes")
   end subroutine first

   !> A deck that replaces supports
   subroutine changed()
      call begin("deck of a restart")
      call read_text("*KEYWORD|*SET_NODE_LIST|2|3,4|*BOUNDARY_SPC_SET|2,0,0,0,1|*END|")
      call check(.not. allocated(error), "it is read, though set 1 is not used any more")
      call check(model%changes%conditions .and. .not. model%changes%end, "supports change")
      call check(size(model%supports) == 1 .and. all(model%supports(1)%nodes == [3, 4]), &
         & "new supports replace all old ones")
      call check(size(model%point_loads) == 1, "loads stay")
      call check(size(archive%bundles) == 2, "both decks are kept")
      call check(model%change_list(2)%kind == "supports" .and. model%change_list(2)%words == &
         & "removed 1 (BOUNDARY_SPC_SET 1), added 1 (BOUNDARY_SPC_SET 2)", "supports are named")
      call check(size(model%change_list) == 2, "with the new set, and nothing else")
      call check(model%request%field_interval, 0.05_wp, 1.0e-15_wp, &
         & "twenty states of the first end")
   end subroutine changed

   !> A restart without a deck, then with one more
   subroutine again()
      call begin("decks before")
      call read_decks_of_run(archive, "", 0.0_wp, model, messages, error)
      call check(.not. allocated(error) .and. all(model%supports(1)%nodes == [3, 4]), &
         & "are read from what is kept")
      call check(.not. model%changes%conditions, "they change nothing any more")
      call check(size(model%change_list), 0, "nor is there a list of changes")
      call read_text("*KEYWORD|*CONTROL_TERMINATION|3.0,|*DATABASE_GLSTAT|0.1,|*END|")
      call check(.not. allocated(error) .and. model%changes%end, "a later deck has another end")
      call check(model%control%end_time, 3.0_wp, 0.0_wp, "which counts")
      call check(model%request%energy_interval, 0.1_wp, 0.0_wp, "an interval as well")
      call check(model%request%field_interval, 0.05_wp, 1.0e-15_wp, "that of the fields stays")
      call check(.not. model%changes%step, "the step stays")
      call check(model%change_list(1)%words == "ENDTIM 1 to 3", "the end is listed")
      call check(model%change_list(2)%words == "DT none to 0.1", "and the first interval")
      call read_text("*KEYWORD|*CONTROL_TIMESTEP|0.0,0.8,0,0.0,-0.5|*END|")
      call check(.not. allocated(error) .and. model%changes%step, "another step")
      call check(model%control%mass_scaled_step, 0.5_wp, 0.0_wp, "for which mass is added")
      call read_text("*KEYWORD|*CONTROL_TIMESTEP|0.0,0.7|*END|")
      call check(model%control%mass_scaled_step, 0.0_wp, 0.0_wp, "until a deck takes it away")
      call check(model%change_list(1)%words == "TSSFAC 0.8 to 0.7, DT2MS -0.5 to 0", &
         & "fields that differ are listed")
      call check(model%control%step_factor, 0.7_wp, 0.0_wp, "the last card counts")
      call read_text("*KEYWORD|*PARAMETER|R end,3.0|*TITLE|as before|*END|")
      call check(index(messages, "changes.k:6: the deck changes nothing") > 0, "a deck in vain")
      call read_decks_of_run(archive, "", 0.0_wp, model, messages, error)
      call check(index(messages, "the deck changes nothing") == 0, "is reported once")
   end subroutine again

   !> Decks that change too much
   subroutine refused()
      call begin("deck refused")
      call read_text("*KEYWORD|*MAT_ELASTIC|2,1.0,1.0,0.3|*END|")
      call check_error(error, "*MAT_ELASTIC: a restart cannot change this", "a material")
      call read_text("*KEYWORD|*CONTROL_TIMESTEP|0.1,0.8|*END|")
      call check_error(error, "DTINIT: the first step of the run has been made", "a first step")
      call read_text("*KEYWORD|*DATABASE_FIELD|stress|*END|")
      call check_error(error, "*DATABASE_FIELD: a restart cannot change this", "fields")
      call read_text("*KEYWORD|*SET_NODE_LIST|9|3,4|*END|")
      call check_error(error, "node set 9 is never used", "a new set that is not used")
      call read_text("*KEYWORD|*CONTROL_TERMINATION|3.0,|")
      call check_error(error, "does not end with *END", "a deck cut short")
      call read_text("*CONTROL_TERMINATION|3.0,|*END|")
      call check_error(error, "does not begin with *KEYWORD", "a deck without its head")
   end subroutine refused

   !> Read a deck whose lines are parted by bars, and forget the file
   subroutine read_text(text)
      character(*), intent(in) :: text

      call write_lines(path, text)
      call read_decks_of_run(archive, path, 0.0_wp, model, messages, error)
      call remove_file(path)
      if (allocated(error)) call drop_last()
   end subroutine read_text

   !> A deck that is refused ends the program; here the next one takes its place
   subroutine drop_last()
      type(archive_type) :: shorter
      integer :: i

      allocate (shorter%bundles(0))
      do i = 1, size(archive%bundles) - 1
         call shorter%add_bundle(archive%bundles(i))
      end do
      shorter%parameters = archive%parameters
      archive = shorter
   end subroutine drop_last

end program test_input_changes
