!> Checks of a model as a whole, and what keywords with errors leave open: numbers in them may refer
!> to something, which is then not reported as never used; laminates are not compared where one of
!> them could not be read.
module plydyn_input_check_model
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text, upper_case
   use plydyn_deck_cards, only : cards_type, is_wrong
   use plydyn_deck_deck, only : deck_type
   use plydyn_deck_declaration, only : integer_field
   use plydyn_deck_report, only : deck_location_type, severity_error
   use plydyn_input_catalogue, only : a_box, a_curve, a_material, a_node, a_node_set, a_part, &
      & a_quad, a_quad_set, a_solid_section, a_table, an_hourglass, an_impactor, &
      & an_interface_material, catalogue_type
   use plydyn_input_check_fixture, only : check_fixtures
   use plydyn_input_check_impact, only : check_impact, check_sense
   use plydyn_input_check_motion, only : check_acted_on, check_supports
   use plydyn_input_check_mesh, only : check_bricks, check_joined, check_mesh, refuse_averages
   use plydyn_input_check_plies, only : check_layups, check_plies
   use plydyn_input_check_units, only : check_units
   use plydyn_model_layers, only : is_same_structure, new_layers
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: check_model, weigh_errors

   !> Beginnings of the names of keywords that describe laminates
   character(*), parameter :: of_laminates(3) = [character(10) :: "*PART", "*SECTION", "*INTERFACE"]
   !> Digits of the longest number
   integer, parameter :: longest_number = 9

contains

   !> Mark what wrong keywords may refer to, and what cannot be judged because of them
   subroutine weigh_errors(deck, catalogue)
      !> The deck
      type(deck_type), intent(in) :: deck
      !> Has all findings of the readers; gets the marks
      type(catalogue_type), intent(inout) :: catalogue

      integer :: f, k

      associate (report => catalogue%report)
         ! errors that are not shown have no place
         if (sum(report%count) > report%shown) catalogue%is_incomplete = .true.
         do f = 1, report%shown
            if (report%findings(f)%severity /= severity_error) cycle
            k = count(deck%keywords%line <= report%findings(f)%place%line)
            if (k > 0) call weigh_keyword(deck, k, catalogue)
         end do
      end associate
   end subroutine weigh_errors

   !> Mark what one of them may refer to
   subroutine weigh_keyword(deck, k, catalogue)
      type(deck_type), intent(in) :: deck
      !> Which keyword
      integer, intent(in) :: k
      type(catalogue_type), intent(inout) :: catalogue

      character(:), allocatable :: name
      integer :: i, last

      name = upper_case(deck%source%line(deck%keywords(k)%line))
      if (has_wrong_integer(deck%keywords(k))) catalogue%is_incomplete = .true.
      do i = 1, size(of_laminates)
         if (index(name, trim(of_laminates(i))) == 1) catalogue%parts_are_sound = .false.
      end do
      if (deck%keywords(k)%is_unread) catalogue%parts_are_sound = .false.
      if (index(name, "*NODE") == 1 .or. index(name, "*ELEMENT") == 1) return
      last = deck%source%line_count
      if (k < size(deck%keywords)) last = deck%keywords(k + 1)%line - 1
      do i = deck%keywords(k)%line + 1, last
         call mark_numbers(deck%source%line(i), catalogue)
      end do
   end subroutine weigh_keyword

   !> Whether a whole number of a keyword could not be read: it may be that of anything
   pure logical function has_wrong_integer(cards) result(has)
      type(cards_type), intent(in) :: cards

      integer :: c, card, r

      has = .false.
      if (.not. allocated(cards%state)) return
      do r = 1, size(cards%state, 2)
         card = cards%card_of_row(r)
         associate (fields => cards%declaration%cards(card)%fields)
            do c = 1, min(size(fields), size(cards%state, 1))
               has = has .or. (fields(c)%kind == integer_field .and. cards%state(c, r) == is_wrong)
            end do
         end associate
      end do
   end function has_wrong_integer

   !> Mark all that has one of the numbers of a line, whatever it is
   subroutine mark_numbers(line, catalogue)
      character(*), intent(in) :: line
      type(catalogue_type), intent(inout) :: catalogue

      integer :: first, kind, number, past, place

      if (index(line, "&") > 0) catalogue%is_incomplete = .true.
      past = 1
      do
         first = past + verify(line(past:), " ,") - 1
         if (first < past) return
         past = first + scan(line(first:)//" ", " ,") - 1
         associate (word => line(first:past - 1))
            if (verify(word, "0123456789") > 0 .or. len(word) > longest_number) cycle
            read (word, *) number
         end associate
         do kind = 1, size(catalogue%registers)
            if (kind == a_node .or. kind == a_quad) cycle
            call catalogue%registers(kind)%refer(number, place)
         end do
      end do
   end subroutine mark_numbers

   !> Check a model that has been read
   subroutine check_model(model, catalogue)
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i

      do i = 1, size(catalogue%registers)
         call catalogue%check_duplicates(i)
      end do
      call check_apart(a_material, an_interface_material, "material", catalogue)
      call check_apart(a_curve, a_table, "curve or table", catalogue)
      call check_presence(model, catalogue)
      if (catalogue%has_other_solids) then
         continue
      else if (catalogue%mesh_is_sound .and. size(model%mesh%brick_id) > 0) then
         call check_bricks(model%mesh, catalogue)
         call refuse_averages(model%materials, catalogue)
      else if (catalogue%mesh_is_sound) then
         call check_mesh(model%mesh, catalogue)
         call check_joined(model%mesh, catalogue)
      end if
      call check_all_used(catalogue)
      call check_parts(model, catalogue)
      if (catalogue%mesh_is_sound .and. size(model%parts) > 0 .and. .not. catalogue%has_unread) then
         call check_impact(model, catalogue)
      end if
      if (.not. catalogue%report%has_errors()) call check_fixtures(model, catalogue)
      if (.not. catalogue%report%has_errors()) call check_sense(model, catalogue)
      if (.not. catalogue%report%has_errors()) call check_supports(model, catalogue)
      if (.not. catalogue%report%has_errors()) call check_acted_on(model, catalogue)
      if (.not. catalogue%report%has_errors()) call check_layups(model, catalogue)
      if (.not. catalogue%report%has_errors()) call check_units(model, catalogue)
      if (.not. catalogue%report%has_errors()) call check_plies(model, catalogue)
   end subroutine check_model

   !> Two kinds that share their numbers have none in common
   subroutine check_apart(first, second, what, catalogue)
      !> The kinds
      integer, intent(in) :: first, second
      !> What both are
      character(*), intent(in) :: what
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i, other

      associate (ones => catalogue%registers(first), others => catalogue%registers(second))
         do i = 1, others%count
            other = ones%index_of(others%id(i))
            if (other == 0 .or. others%id(i) == 0) cycle
            call catalogue%report%refuse(catalogue%location(second, i), what//" " &
               & //text(others%id(i))//" is defined twice", "a number of its own", ones%line(other))
         end do
      end associate
   end subroutine check_apart

   !> What every deck needs
   subroutine check_presence(model, catalogue)
      type(model_type), intent(in) :: model
      type(catalogue_type), intent(inout) :: catalogue

      if (catalogue%has_unread) return
      if (size(model%mesh%node_id) == 0) then
         call catalogue%report%refuse(deck_location_type(), "the deck has no nodes", "*NODE")
      end if
      if (size(model%mesh%quad_id) + size(model%mesh%brick_id) == 0) then
         call catalogue%report%refuse(deck_location_type(), "the deck has no elements", &
            & "*ELEMENT_SHELL, *ELEMENT_PLATE_Q9 or *ELEMENT_SOLID")
      end if
      if (size(model%parts) == 0) then
         call catalogue%report%refuse(deck_location_type(), "the deck has no part", &
            & "*PART_COMPOSITE")
      end if
      if (model%control%end_time <= 0.0_wp .and. .not. catalogue%end_is_reported) then
         call catalogue%report%refuse(deck_location_type(), "the deck has no end time", &
            & "*CONTROL_TERMINATION with ENDTIM")
      end if
   end subroutine check_presence

   !> What is defined is used
   subroutine check_all_used(catalogue)
      type(catalogue_type), intent(inout) :: catalogue

      if (catalogue%is_incomplete) return
      call catalogue%check_unused(a_node_set, "a keyword that uses the set, or no set")
      call catalogue%check_unused(a_quad_set, "a keyword that uses the set, or no set")
      call catalogue%check_unused(a_box, "*SET_NODE_GENERAL that uses the box, or no box")
      call catalogue%check_unused(a_curve, "a keyword that uses the curve, or no curve")
      call catalogue%check_unused(a_solid_section, "*PART that uses the section, or no section")
      call catalogue%check_unused(an_hourglass, "*PART that uses the control, or no control")
      call catalogue%check_unused(a_table, "a material that uses the table, or no table")
      call catalogue%check_unused(a_material, "a ply of the material, or no material")
      call catalogue%check_unused(an_interface_material, &
         & "*INTERFACE_COHESIVE that uses the material, or no material")
      call catalogue%check_unused(an_impactor, "*CONTACT_IMPACTOR for the impactor, or no impactor")
   end subroutine check_all_used

   !> Every part has elements, where all elements could be read
   subroutine check_parts(model, catalogue)
      type(model_type), intent(in) :: model
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i

      if (.not. catalogue%mesh_is_sound .or. catalogue%has_unread) return
      if (size(model%mesh%quad_id) + size(model%mesh%brick_id) == 0) return
      do i = 1, size(model%parts)
         if (any(model%mesh%quad_part == i) .or. any(model%mesh%brick_part == i)) cycle
         call catalogue%report%refuse(catalogue%location(a_part, i), "part " &
            & //text(model%parts(i)%id)//" has no elements", "elements with this part, or no part")
      end do
      if (size(model%mesh%brick_id) == 0 .and. catalogue%parts_are_sound) then
         call check_layers(model, catalogue)
      end if
   end subroutine check_parts

   !> All parts have the same layers
   subroutine check_layers(model, catalogue)
      type(model_type), intent(in) :: model
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i

      do i = 2, size(model%parts)
         if (is_same_structure(new_layers(model%parts(1)), new_layers(model%parts(i)))) cycle
         call catalogue%report%refuse(catalogue%location(a_part, i), "part " &
            & //text(model%parts(i)%id)//" has other layers than part " &
            & //text(model%parts(1)%id), "plies of the same thickness, order and number of " &
            & //"layers in all parts, and the same cards of *INTERFACE_COHESIVE; angles and " &
            & //"materials of plies may differ", catalogue%registers(a_part)%line(1))
      end do
   end subroutine check_layers

end module plydyn_input_check_model
