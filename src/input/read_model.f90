!> From a deck to a model: every keyword has one reader, and what it refers to is read before it.
module plydyn_input_read_model
   use plydyn_base_archive, only : archive_type
   use plydyn_base_error, only : error_type
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_deck, only : conclude, deck_type, read_decks
   use plydyn_input_catalogue, only : catalogue_type, new_catalogue
   use plydyn_input_changes, only : apply_changes, changes_of, warn_of_nothing
   use plydyn_input_check_model, only : check_model
   use plydyn_input_defaults, only : begin_model, end_model
   use plydyn_input_keywords, only : all_keywords
   use plydyn_input_manual, only : keyword_manual
   use plydyn_input_model_readers, only : check_elements, read_element, read_independent, &
      & read_laminate, read_material, read_part, read_plain_material, read_set, read_table
   use plydyn_input_run_readers, only : check_request, read_control, read_load, read_request, &
      & read_support
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_decks_of_run, keyword_manual

   abstract interface
      !> Take the cards of one keyword into the model, if the keyword is one of the stage
      subroutine stage(cards, catalogue, model)
         import :: cards_type, catalogue_type, model_type
         implicit none
         !> The keyword
         type(cards_type), intent(in) :: cards
         !> Numbers of everything so far; gets new ones, and findings
         type(catalogue_type), intent(inout) :: catalogue
         !> The model
         type(model_type), intent(inout) :: model
      end subroutine stage
   end interface

contains

   !> Read the stored decks of a run, and one that begins or changes it
   subroutine read_decks_of_run(archive, path, model, messages, error)
      !> The decks so far, and numbers for parameters; gets the files of the new one
      type(archive_type), intent(inout) :: archive
      !> Path of the new deck, empty for none
      character(*), intent(in) :: path
      !> The model
      type(model_type), intent(out) :: model
      !> Warnings and notes for the listing, empty without any
      character(:), allocatable, intent(out) :: messages
      !> Everything that is wrong with the decks, in one text
      type(error_type), allocatable, intent(out) :: error

      type(catalogue_type) :: catalogue
      type(deck_type) :: deck

      catalogue = new_catalogue()
      call read_decks(archive, path, all_keywords(), deck, catalogue%report)
      call apply_changes(deck, catalogue)
      call begin_model(model)
      if (len(path) > 0) then
         model%changes = changes_of(deck)
         call warn_of_nothing(deck, catalogue)
      end if
      call read_stage(deck, read_independent, catalogue, model)
      call read_stage(deck, read_plain_material, catalogue, model)
      call read_stage(deck, read_table, catalogue, model)
      call read_stage(deck, read_material, catalogue, model)
      call read_stage(deck, read_part, catalogue, model)
      call read_stage(deck, read_element, catalogue, model)
      call read_stage(deck, check_elements, catalogue, model)
      call read_stage(deck, read_set, catalogue, model)
      call read_stage(deck, read_laminate, catalogue, model)
      call read_stage(deck, read_support, catalogue, model)
      call read_stage(deck, read_load, catalogue, model)
      call read_stage(deck, read_control, catalogue, model)
      call read_stage(deck, read_request, catalogue, model)
      call read_stage(deck, check_request, catalogue, model)
      call end_model(deck, model)
      call check_model(model, catalogue)
      call conclude(deck, catalogue%report, messages, error)
      if (len(path) > 0) call archive%add_bundle(deck%source%bundle(size(archive%bundles) + 1))
   end subroutine read_decks_of_run

   !> Let one stage see all keywords of the deck in their order
   subroutine read_stage(deck, take, catalogue, model)
      !> The deck
      type(deck_type), intent(in) :: deck
      !> The stage
      procedure(stage) :: take
      !> Numbers of everything so far
      type(catalogue_type), intent(inout) :: catalogue
      !> The model
      type(model_type), intent(inout) :: model

      integer :: i

      do i = 1, size(deck%keywords)
         call take(deck%keywords(i), catalogue, model)
      end do
   end subroutine read_stage

end module plydyn_input_read_model
