!> From a deck to a model: defaults for what the deck does not give, the reader of every keyword in
!> its stage, then the checks.
module plydyn_input_read_model
   use plydyn_base_archive, only : archive_type
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : upper_case
   use plydyn_deck_deck, only : conclude, deck_type, read_decks
   use plydyn_deck_report, only : deck_location_type
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : catalogue_type, new_catalogue
   use plydyn_input_change_list, only : list_changes
   use plydyn_input_changes, only : apply_changes, changes_of, set_times, warn_of_bodies, &
      & warn_of_nothing
   use plydyn_input_check_model, only : check_model, weigh_errors
   use plydyn_input_keyword_row, only : for_bricks, for_plates, keyword_row_type, stage_element, &
      & stages
   use plydyn_input_keywords, only : all_rows, keyword_manual
   use plydyn_model_cracks, only : prepare_cracks
   use plydyn_model_model, only : model_type
   use plydyn_input_mesh, only : new_mesh
   use plydyn_law_law, only : scalar_names, shows_fibre_damage, shows_shear_damage
   implicit none
   private

   public :: keyword_manual, read_decks_of_run

   !> Field states, lines of the history of delamination and profiles of each place in a run that
   !> does not say how many
   integer, parameter :: usual_states = 20, usual_lines = 1000, usual_profiles = 100

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

      type(card_visitor_type) :: card
      type(deck_type) :: deck
      type(keyword_row_type), allocatable :: rows(:)
      character(:), allocatable :: problem

      card%catalogue = new_catalogue()
      associate (catalogue => card%catalogue)
         rows = all_rows()
         call read_decks(archive, path, rows%declaration, deck, catalogue%report)
         catalogue%has_unread = deck%has_unread
         catalogue%is_incomplete = deck%is_incomplete
         call note_rigid_body(deck, catalogue)
         call apply_changes(deck, catalogue)
         call set_times(deck, [archive%bundles%start, time], catalogue)
         call begin_model(model)
         if (len(path) > 0) then
            model%changes = changes_of(deck)
            if (.not. catalogue%report%has_errors()) model%change_list = &
               & list_changes(deck, rows%declaration)
            call warn_of_nothing(deck, catalogue)
            call warn_of_bodies(deck, catalogue)
         end if
         call read_keywords(deck, rows, card, model)
         call end_model(deck, model)
         call weigh_errors(deck, catalogue)
         call check_model(model, catalogue)
         call conclude(deck, catalogue%report, messages, error)
         ! what is wrong with cracks has been reported
         if (.not. allocated(error)) call prepare_cracks(model, problem)
         if (len(path) == 0) return
         call archive%add_bundle(deck%source%bundle(size(archive%bundles) + 1))
         archive%bundles(size(archive%bundles))%start = time
      end associate
   end subroutine read_decks_of_run

   !> Note a material of rigid bodies, which are spheres here and have no mesh
   subroutine note_rigid_body(deck, catalogue)
      type(deck_type), intent(in) :: deck
      type(catalogue_type), intent(inout) :: catalogue

      character(:), allocatable :: line
      integer :: i

      do i = 1, size(deck%keywords)
         if (.not. deck%keywords(i)%is_unread) cycle
         line = upper_case(deck%source%line(deck%keywords(i)%line))
         if (index(line, "*MAT_RIGID") /= 1 .and. index(line, "*MAT_020") /= 1) cycle
         catalogue%has_other_solids = .true.
         call catalogue%report%note(deck_location_type(line=deck%keywords(i)%line), "the deck " &
            & //"has rigid elements", "plydyn-pre translate makes a sphere of a meshed ball, and " &
            & //"one part of stacked ones")
         return
      end do
   end subroutine note_rigid_body

   !> Read the keywords of a deck, stage by stage and in their order
   subroutine read_keywords(deck, rows, card, model)
      type(deck_type), intent(in) :: deck
      type(keyword_row_type), intent(in) :: rows(:)
      !> Visits the keywords, with the numbers of everything so far
      type(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      integer :: i, place(size(deck%keywords)), stage

      card%reads = .true.
      do i = 1, size(place)
         place(i) = merge(deck%keywords(i)%known, 0, len(deck%keywords(i)%name) > 0)
      end do
      do stage = 1, stages
         do i = 1, size(place)
            if (place(i) == 0) cycle
            if (rows(place(i))%stage /= stage) cycle
            card%cards_type = deck%keywords(i)
            call rows(place(i))%visit(card, model)
         end do
         if (stage /= stage_element .or. card%catalogue%has_other_solids) cycle
         call check_elements(deck, rows, place, model, card%catalogue)
      end do
      do i = 1, size(place)
         if (place(i) == 0 .or. card%catalogue%report%has_errors()) cycle
         if (associated(rows(place(i))%look_again)) then
            card%cards_type = deck%keywords(i)
            call rows(place(i))%look_again(card, model)
         end if
      end do
   end subroutine read_keywords

   !> Refuse keywords of plates in a deck with bricks, and those of bricks in one without them
   subroutine check_elements(deck, rows, place, model, catalogue)
      type(deck_type), intent(in) :: deck
      type(keyword_row_type), intent(in) :: rows(:)
      !> Row of each keyword of the deck; 0 for one that a restart has replaced
      integer, intent(in) :: place(:)
      !> Has all elements
      type(model_type), intent(in) :: model
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i
      logical :: has_bricks

      has_bricks = size(model%mesh%brick_id) > 0
      do i = 1, size(place)
         if (place(i) == 0) cycle
         if (rows(place(i))%elements /= merge(for_plates, for_bricks, has_bricks)) cycle
         associate (keyword => deck%keywords(i))
            if (has_bricks) then
               call catalogue%report%refuse(keyword%head(), "*"//keyword%name//" does not go " &
                  & //"with bricks", "plates alone, or bricks alone and no keyword that needs " &
                  & //"plies, faces or quads")
            else
               call catalogue%report%refuse(keyword%head(), "*"//keyword%name//" needs bricks", &
                  & "bricks (*ELEMENT_SOLID), or a laminate with its plies in *PART_COMPOSITE, " &
                  & //"and *SECTION_LAYERWISE")
            end if
         end associate
      end do
   end subroutine check_elements

   !> An empty model
   subroutine begin_model(model)
      type(model_type), intent(inout) :: model

      model%title = ""
      model%mesh = new_mesh()
      allocate (model%parts(0), model%materials(0), model%interface_materials(0))
      allocate (model%change_list(0))
      allocate (model%curves(0), model%supports(0), model%motions(0), model%initial_velocities(0))
      allocate (model%constraints(0), model%initial_damages(0), model%crack_zones(0))
      allocate (model%point_loads(0), model%line_loads(0), model%pressures(0))
      allocate (model%segment_loads(0), model%body_loads(0))
      allocate (model%impactors(0), model%contacts(0), model%fixtures(0))
      allocate (model%request%fields(0), model%request%nodes(0), model%request%profiles(0))
   end subroutine begin_model

   !> What the deck does not say
   subroutine end_model(deck, model)
      type(deck_type), intent(in) :: deck
      type(model_type), intent(inout) :: model

      integer :: i

      do i = 1, size(model%materials)
         model%materials(i)%place = place_of(deck, model%materials(i)%line)
         model%materials(i)%radius_place = place_of(deck, model%materials(i)%radius_line)
      end do
      model%control%curve_place = place_of(deck, model%control%curve_line)
      model%control%step_place = place_of(deck, model%control%step_line)
      model%control%damping_place = place_of(deck, model%control%damping_line)
      do i = 1, size(model%contacts)
         associate (contact => model%contacts(i))
            contact%place = place_of(deck, contact%line)
            if (contact%line > 0) contact%is_later = deck%source%root(contact%line) > 1
         end associate
      end do
      do i = 1, size(model%fixtures)
         model%fixtures(i)%place = place_of(deck, model%fixtures(i)%line)
      end do
      do i = 1, size(model%request%profiles)
         if (model%request%profiles(i)%interval < 0.0_wp) then
            model%request%profiles(i)%interval = model%control%planned_end/usual_profiles
         end if
         model%request%profiles(i)%place = place_of(deck, model%request%profiles(i)%line)
      end do
      associate (request => model%request)
         if (size(request%fields) == 0) then
            request%fields = [character(len(request%fields)) :: &
               & "displacement", "velocity", "stress"]
            if (any(model%materials%is_damaged())) request%fields = [request%fields, &
               & scalar_names(shows_fibre_damage:shows_shear_damage)]
         end if
         if (request%field_interval <= 0.0_wp) then
            request%field_interval = model%control%planned_end/usual_states
         end if
         if (request%delamination_interval < 0.0_wp) then
            request%delamination_interval = model%control%planned_end/usual_lines
         end if
      end associate
   end subroutine end_model

   !> File and number of a line, empty for none
   pure function place_of(deck, line) result(place)
      type(deck_type), intent(in) :: deck
      !> Index of the line
      integer, intent(in) :: line
      character(:), allocatable :: place

      place = ""
      if (line > 0) place = deck%source%where(line)
   end function place_of

end module plydyn_input_read_model
