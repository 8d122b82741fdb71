!> Changes that the deck of a restart makes to the decks before it.
module plydyn_input_changes
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_deck, only : deck_type
   use plydyn_deck_declaration, only : extension
   use plydyn_deck_report, only : deck_location_type
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : catalogue_type
   use plydyn_model_control, only : changes_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: apply_changes, changes_of, control_stage, delete_body, set_times, warn_of_bodies, &
      & warn_of_nothing

   !> Keywords of which all those of earlier decks go when a later deck has one
   character(*), parameter :: replaced(2) = ["BOUNDARY_", "LOAD_    "]
   !> What a restart changes, in words
   character(*), parameter :: changeable = "supports, loads, impactors, fixtures, damping, the " &
      & //"time step, the end time, intervals of results, and the sets, boxes and curves for them"

contains

   !> Times of the deck of a restart
   subroutine control_stage(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      logical :: counts

      call card%keyword(extension, "Start of time in the deck of a restart (a stage).", &
         & once=.true., change="times count from")
      call card%remark("The end of the stage before is usually not known in advance. The time " &
         & //"of the restart file is therefore added to ENDTIM, BIRTH and DEATH, and to the " &
         & //"abscissas of the curves of this deck.")
      call card%example("running.md#restarting", "1")
      call card%flag("TIME", "1 ENDTIM, BIRTH, DEATH and the curves of this deck count from " &
         & //"the restart, 0 from the beginning of the run", counts, default=1)
   end subroutine control_stage

   !> Bodies that a restart removes
   subroutine delete_body(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      integer :: number

      call card%keyword(extension, "Bodies that a restart removes.", change="deleted bodies")
      call card%remark("For a deck that changes a run. New bodies need new numbers. The kinetic " &
         & //"energy of impactors leaves the energy balance as external work.")
      call card%example("running.md#restarting", "1")
      do while (card%next())
         call card%integer(merge("IID", "FID", card%name == "DELETE_IMPACTOR"), &
            & "number of the body", number, least=1)
      end do
   end subroutine delete_body

   !> Refuse what cannot be changed, and take out what is replaced
   subroutine apply_changes(deck, catalogue)
      !> Decks, one after the other; keywords that are replaced lose their names
      type(deck_type), intent(inout) :: deck
      !> Gets findings, and the number of lines of the decks before the last
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i, k

      do i = 1, size(deck%keywords)
         associate (own => deck%keywords(i))
            if (own%root > 1) then
               call check_allowed(own, catalogue)
               if (index(own%name, "DELETE_") == 1) call delete_bodies(deck, i, catalogue)
               if (own%name == "DELETE_FIXTURE" .and. own%root == deck%last) then
                  catalogue%removal_line = own%line
               end if
            else if (own%name == "CONTROL_STAGE" .or. index(own%name, "DELETE_") == 1) then
               call catalogue%report%refuse(own%head(), "the first deck of a run is no stage", &
                  & "the keyword in the deck of a restart")
            end if
         end associate
      end do
      do k = 1, size(replaced)
         call take_out(deck, trim(replaced(k)))
      end do
      do i = 1, deck%source%line_count
         if (deck%source%root(i) < deck%last) catalogue%stored_lines = i
      end do
   end subroutine apply_changes

   !> A restart changes loads, supports, bodies, the end and the instants of results, and no more;
   !> it has no first step
   subroutine check_allowed(keyword, catalogue)
      type(cards_type), intent(in) :: keyword
      type(catalogue_type), intent(inout) :: catalogue

      if (len(keyword%name) == 0) return
      if (len(keyword%declaration%change) == 0) call catalogue%report%refuse(keyword%head(), &
         & "a restart cannot change this", changeable)
      if (keyword%name /= "CONTROL_TIMESTEP") return
      if (keyword%number("DTINIT") > 0.0_wp) call catalogue%report%refuse(keyword%place("DTINIT"), &
         & "the first step of the run has been made", "0")
   end subroutine check_allowed

   !> Times from which the times of all decks count: those of a stage count from its restart
   pure subroutine set_times(deck, starts, catalogue)
      !> Decks, one after the other
      type(deck_type), intent(in) :: deck
      !> Time from which the run follows each of them
      real(wp), intent(in) :: starts(:)
      !> Gets the times
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i

      catalogue%start = starts
      catalogue%origin = spread(0.0_wp, 1, size(starts))
      do i = 1, size(deck%keywords)
         associate (keyword => deck%keywords(i))
            if (keyword%name == "CONTROL_STAGE") catalogue%origin(keyword%root) = &
               & merge(starts(keyword%root), 0.0_wp, keyword%whole("TIME") == 1)
         end associate
      end do
   end subroutine set_times

   !> What the last deck changes, when there are others before it
   pure function changes_of(deck) result(changes)
      !> Decks, one after the other
      type(deck_type), intent(in) :: deck
      type(changes_type) :: changes

      integer :: i, k

      do i = 1, size(deck%keywords)
         if (deck%keywords(i)%root < max(2, deck%last)) cycle
         associate (name => deck%keywords(i)%name)
            changes%conditions = changes%conditions &
               & .or. any([(index(name, trim(replaced(k))) == 1, k=1, size(replaced))])
            if (name == "CONTROL_TERMINATION") changes%end = .true.
            if (name == "CONTROL_TIMESTEP") changes%step = .true.
            if (name == "DAMPING_RELAXATION") changes%relaxation = .true.
            if (is_body_of(name, "IMPACTOR") .or. is_body_of(name, "FIXTURE") &
               & .or. index(name, "DELETE_") == 1) changes%bodies = .true.
         end associate
      end do
   end function changes_of

   !> Take bodies, and the contacts of impactors, out of the decks before
   subroutine delete_bodies(deck, i, catalogue)
      type(deck_type), intent(inout) :: deck
      !> Number of the keyword that names them
      integer, intent(in) :: i
      type(catalogue_type), intent(inout) :: catalogue

      character(:), allocatable :: field, kind
      integer :: id, k, nth
      logical :: is_found

      kind = deck%keywords(i)%name(len("DELETE_") + 1:)
      field = kind(:1)//"ID"
      do nth = 1, deck%keywords(i)%sets()
         id = deck%keywords(i)%whole(field, nth)
         is_found = .not. deck%keywords(i)%has(field, nth)
         do k = 1, size(deck%keywords)
            if (.not. is_body_of(deck%keywords(k)%name, kind)) cycle
            if (deck%keywords(k)%whole(field) /= id) cycle
            if (deck%keywords(k)%root >= deck%keywords(i)%root) then
               call catalogue%report%refuse(deck%keywords(k)%place(field), kind//" "//text(id) &
                  & //" was deleted", "a number that no body of the run has had")
            else
               is_found = .true.
               deck%keywords(k)%name = ""
            end if
         end do
         if (is_found) cycle
         if (is_deleted(deck%keywords(:i), kind, id, nth)) then
            call catalogue%report%refuse(deck%keywords(i)%place(field, nth), kind//" "//text(id) &
               & //" was deleted already", "each body once")
         else
            call catalogue%report%refuse(deck%keywords(i)%place(field, nth), "no deck before has " &
               & //kind//" "//text(id), "the number of a body that an earlier deck defines")
         end if
      end do
   end subroutine delete_bodies

   !> Whether some keywords, of the last one the sets of cards before one, delete a body
   pure logical function is_deleted(keywords, kind, id, set)
      type(cards_type), intent(in) :: keywords(:)
      !> IMPACTOR or FIXTURE
      character(*), intent(in) :: kind
      !> Number of the body, and of the set of cards
      integer, intent(in) :: id, set

      integer :: k, nth

      is_deleted = .false.
      do k = 1, size(keywords)
         if (keywords(k)%name /= "DELETE_"//kind) cycle
         do nth = 1, merge(set - 1, keywords(k)%sets(), k == size(keywords))
            is_deleted = is_deleted .or. keywords(k)%whole(kind(:1)//"ID", nth) == id
         end do
      end do
   end function is_deleted

   !> Whether a keyword defines bodies of a kind, or their contact
   pure logical function is_body_of(name, kind)
      !> Name of the keyword; IMPACTOR or FIXTURE
      character(*), intent(in) :: name, kind

      is_body_of = index(name, kind//"_") == 1 .or. name == "CONTACT_"//kind
   end function is_body_of

   !> Warn when the last deck changes nothing, unless something was refused already
   subroutine warn_of_nothing(deck, catalogue)
      !> Decks, one after the other
      type(deck_type), intent(in) :: deck
      !> Gets the warning
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i

      if (catalogue%report%has_errors() .or. deck%last <= 1) return
      do i = 1, size(deck%keywords)
         if (deck%keywords(i)%root < deck%last) cycle
         if (len(deck%keywords(i)%name) > 0 .and. deck%keywords(i)%name /= "TITLE") return
      end do
      call catalogue%report%warn(deck_location_type(line=deck%source%line_count), &
         & "the deck changes nothing", changeable)
   end subroutine warn_of_nothing

   !> Warn when the last deck holds the plate anew and leaves all bodies of the decks before
   subroutine warn_of_bodies(deck, catalogue)
      !> Decks, one after the other
      type(deck_type), intent(in) :: deck
      !> Gets the warning
      type(catalogue_type), intent(inout) :: catalogue

      integer :: holds, i, left
      logical :: is_new

      if (catalogue%report%has_errors() .or. deck%last <= 1) return
      holds = 0
      left = 0
      do i = size(deck%keywords), 1, -1
         associate (name => deck%keywords(i)%name)
            is_new = deck%keywords(i)%root == deck%last
            if (is_new .and. index(name, "BOUNDARY_") == 1) holds = i
            if (is_new .and. index(name, "DELETE_") == 1) return
            if (.not. is_new .and. (index(name, "IMPACTOR_") == 1 &
               & .or. index(name, "FIXTURE_") == 1)) left = left + 1
         end associate
      end do
      if (holds == 0 .or. left == 0) return
      call catalogue%report%warn(deck%keywords(holds)%head(), "the plate is held anew, and no " &
         & //"impactor or fixture of the decks before is removed: "//text(left)//" in all", &
         & "*DELETE_IMPACTOR and *DELETE_FIXTURE for those that are not to touch it any more")
   end subroutine warn_of_bodies

   !> Take out the keywords of a family from the decks before the last one that has any
   subroutine take_out(deck, family)
      type(deck_type), intent(inout) :: deck
      !> What their names begin with
      character(*), intent(in) :: family

      integer :: i, newest

      newest = 1
      do i = size(deck%keywords), 1, -1
         if (index(deck%keywords(i)%name, family) /= 1) cycle
         newest = max(newest, deck%keywords(i)%root)
         if (deck%keywords(i)%root < newest) deck%keywords(i)%name = ""
      end do
   end subroutine take_out

end module plydyn_input_changes
