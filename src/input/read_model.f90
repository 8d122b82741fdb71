!> From a deck to a model: the reader of every keyword in its stage, then the checks.
module plydyn_input_read_model
   use plydyn_base_archive, only : archive_type
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : upper_case
   use plydyn_deck_deck, only : conclude, deck_type, read_decks
   use plydyn_deck_report, only : deck_location_type
   use plydyn_input_catalogue, only : catalogue_type, new_catalogue
   use plydyn_input_change_list, only : list_changes
   use plydyn_input_changes, only : apply_changes, changes_of, warn_of_nothing
   use plydyn_input_check_model, only : check_model
   use plydyn_input_check_solid, only : refuse_kind
   use plydyn_input_defaults, only : begin_model, end_model
   use plydyn_input_keyword_row, only : for_bricks, for_plates, index_of_row, keyword_row_type, &
      & stage_element, stages
   use plydyn_input_keywords, only : all_rows
   use plydyn_input_wrong_keywords, only : weigh_errors
   use plydyn_input_manual, only : keyword_manual
   use plydyn_input_time_origins, only : new_time_origins
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_decks_of_run, keyword_manual

contains

   !> Read the stored decks of a run, and one that begins or changes it
   subroutine read_decks_of_run(archive, path, time, model, messages, error)
      !> The decks so far, and numbers for parameters; gets the files of the new one
      type(archive_type), intent(inout) :: archive
      !> Path of the new deck, empty for none
      character(*), intent(in) :: path
      !> Time from which the run follows it
      real(wp), intent(in) :: time
      type(model_type), intent(out) :: model
      !> Warnings and notes for the listing, empty without any
      character(:), allocatable, intent(out) :: messages
      !> Everything that is wrong with the decks, in one text
      type(error_type), allocatable, intent(out) :: error

      type(catalogue_type) :: catalogue
      type(deck_type) :: deck
      type(keyword_row_type), allocatable :: rows(:)

      catalogue = new_catalogue()
      rows = all_rows()
      call read_decks(archive, path, rows%declaration, deck, catalogue%report)
      catalogue%has_unread = deck%has_unread
      catalogue%is_incomplete = deck%is_incomplete
      call note_rigid_body(deck, catalogue)
      call apply_changes(deck, catalogue)
      catalogue%times = new_time_origins(deck, [archive%bundles%start, time])
      call begin_model(model)
      if (len(path) > 0) then
         model%changes = changes_of(deck)
         if (.not. catalogue%report%has_errors()) model%change_list = list_changes(deck)
         call warn_of_nothing(deck, catalogue)
      end if
      call read_keywords(deck, rows, catalogue, model)
      call end_model(deck, model)
      call weigh_errors(deck, catalogue)
      call check_model(model, catalogue)
      call conclude(deck, catalogue%report, messages, error)
      if (len(path) == 0) return
      call archive%add_bundle(deck%source%bundle(size(archive%bundles) + 1))
      archive%bundles(size(archive%bundles))%start = time
   end subroutine read_decks_of_run

   !> Note a material of rigid bodies, which are spheres here and have no mesh
   subroutine note_rigid_body(deck, catalogue)
      type(deck_type), intent(in) :: deck
      type(catalogue_type), intent(inout) :: catalogue

      character(:), allocatable :: line
      type(deck_location_type) :: place
      integer :: i

      do i = 1, size(deck%keywords)
         if (.not. deck%keywords(i)%is_unread) cycle
         line = upper_case(deck%source%line(deck%keywords(i)%line))
         if (index(line, "*MAT_RIGID") /= 1 .and. index(line, "*MAT_020") /= 1) cycle
         catalogue%has_other_solids = .true.
         place%line = deck%keywords(i)%line
         call catalogue%report%note(place, "the deck has rigid elements", "plydyn-pre translate " &
            & //"makes a sphere of a meshed ball, and one part of stacked ones")
         return
      end do
   end subroutine note_rigid_body

   !> Read the keywords of a deck, stage by stage and in their order
   subroutine read_keywords(deck, rows, catalogue, model)
      type(deck_type), intent(in) :: deck
      !> Rows of all keywords
      type(keyword_row_type), intent(in) :: rows(:)
      !> Numbers of everything so far
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      integer :: i, place(size(deck%keywords)), stage

      do i = 1, size(place)
         place(i) = index_of_row(rows, deck%keywords(i)%name)
      end do
      do stage = 1, stages
         do i = 1, size(place)
            if (place(i) == 0) cycle
            if (rows(place(i))%stage /= stage) cycle
            call rows(place(i))%read(deck%keywords(i), catalogue, model)
         end do
         if (stage /= stage_element .or. catalogue%has_other_solids) cycle
         call check_elements(deck, rows, place, model, catalogue)
      end do
      do i = 1, size(place)
         if (place(i) == 0 .or. catalogue%report%has_errors()) cycle
         if (associated(rows(place(i))%check)) then
            call rows(place(i))%check(deck%keywords(i), catalogue, model)
         end if
      end do
   end subroutine read_keywords

   !> Refuse keywords that do not go with the elements of the deck
   subroutine check_elements(deck, rows, place, model, catalogue)
      type(deck_type), intent(in) :: deck
      type(keyword_row_type), intent(in) :: rows(:)
      !> Row of each keyword of the deck; 0 for one that a restart has replaced
      integer, intent(in) :: place(:)
      !> Has all elements
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i
      logical :: has_bricks

      has_bricks = size(model%mesh%brick_id) > 0
      do i = 1, size(place)
         if (place(i) == 0) cycle
         if (rows(place(i))%elements /= merge(for_plates, for_bricks, has_bricks)) cycle
         associate (keyword => deck%keywords(i))
            call refuse_kind(keyword%name, keyword%head(), has_bricks, catalogue%report)
         end associate
      end do
   end subroutine check_elements

end module plydyn_input_read_model
