!> What the deck of a restart changes, in words for the listing.
module plydyn_input_change_list
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_declaration, only : field_type, integer_field, keyword_type
   use plydyn_deck_deck, only : deck_type
   use plydyn_model_control, only : change_type
   implicit none
   private

   public :: list_changes

   !> Most numbers of removed or added cards that a line shows
   integer, parameter :: most_shown = 12
   !> One card, or set of cards, of a kind
   type :: item_type
      !> Index of its keyword in the deck, and number of the set of cards there
      integer :: keyword = 0, nth = 0
   end type item_type

contains

   !> What the last deck changes, one line for each kind of cards and for each keyword with
   !> settings; empty without a deck before it
   pure function list_changes(deck, known) result(list)
      !> Decks, one after the other; keywords that are replaced or deleted have no name any more
      type(deck_type), intent(in) :: deck
      !> Declarations of all keywords
      type(keyword_type), intent(in) :: known(:)
      type(change_type), allocatable :: list(:)

      integer :: i, k
      character(:), allocatable :: kind, words

      list = [change_type ::]
      if (deck%last <= 1) return
      do k = 1, size(known)
         kind = known(k)%change
         if (len(kind) == 0 .or. any([(list(i)%kind == kind, i=1, size(list))])) cycle
         if (known(k)%once) then
            words = change_of_settings(deck, known(k)%name)
         else
            words = change_of_cards(deck, kind)
         end if
         if (len(words) > 0) list = [list, change_type(kind, words)]
      end do
   end function list_changes

   !> Cards of a kind that stay, go and come; empty when the last deck has none and removes none
   pure function change_of_cards(deck, kind) result(words)
      type(deck_type), intent(in) :: deck
      !> What the cards are, as declared
      character(*), intent(in) :: kind
      character(:), allocatable :: words

      type(item_type), allocatable :: added(:), removed(:)
      integer :: i, j, kept

      removed = [item_type ::]
      added = [item_type ::]
      do i = 1, size(deck%keywords)
         if (kind_of(deck%keywords(i)) /= kind) cycle
         if (is_removed(deck, i)) removed = [removed, items_of(deck%keywords(i), i)]
         if (deck%keywords(i)%root < deck%last) cycle
         added = [added, items_of(deck%keywords(i), i)]
      end do
      kept = 0
      do i = size(removed), 1, -1
         do j = 1, size(added)
            if (.not. are_equal(deck, removed(i), added(j))) cycle
            removed = [removed(:i - 1), removed(i + 1:)]
            added = [added(:j - 1), added(j + 1:)]
            kept = kept + 1
            exit
         end do
      end do
      words = ""
      if (kept > 0) words = ", kept "//text(kept)
      words = words//counted("removed", deck, removed)//counted("added", deck, added)
      words = words(3:)
   end function change_of_cards

   !> What the cards of a keyword are, replaced and deleted ones included; empty where a restart
   !> cannot change them
   pure function kind_of(cards) result(kind)
      type(cards_type), intent(in) :: cards
      character(:), allocatable :: kind

      kind = ""
      if (cards%is_unread .or. .not. allocated(cards%declaration%change)) return
      ! what it deletes is listed with the other bodies
      if (index(cards%declaration%name, "DELETE_") /= 1) kind = cards%declaration%change
   end function kind_of

   !> Whether the last deck removes a keyword of an earlier one
   pure logical function is_removed(deck, i)
      type(deck_type), intent(in) :: deck
      !> Index of the keyword
      integer, intent(in) :: i

      integer :: k, newest, root

      associate (keywords => deck%keywords)
         is_removed = .false.
         root = keywords(i)%root
         if (root == deck%last .or. len(keywords(i)%name) > 0) return
         select case (kind_of(keywords(i)))
         case ("supports", "prescribed motions", "loads")
            ! those of the newest deck before the last one are removed by the last one
            newest = 0
            do k = 1, size(keywords)
               if (family_of(keywords(k)) /= family_of(keywords(i))) cycle
               if (keywords(k)%root < deck%last) newest = max(newest, keywords(k)%root)
            end do
            is_removed = root == newest
         case ("impactors", "contact faces")
            is_removed = names_body(deck, "IMPACTOR", keywords(i)%whole("IID"))
         case ("fixtures")
            is_removed = names_body(deck, "FIXTURE", keywords(i)%whole("FID"))
         case default
            continue
         end select
      end associate
   end function is_removed

   !> Kind of cards that are replaced together: supports and motions are one family
   pure function family_of(cards) result(family)
      type(cards_type), intent(in) :: cards
      character(:), allocatable :: family

      family = kind_of(cards)
      if (family == "prescribed motions") family = "supports"
   end function family_of

   !> Whether the last deck deletes a body
   pure logical function names_body(deck, kind, id)
      type(deck_type), intent(in) :: deck
      !> IMPACTOR or FIXTURE
      character(*), intent(in) :: kind
      !> Number of the body
      integer, intent(in) :: id

      integer :: i, nth

      names_body = .false.
      do i = 1, size(deck%keywords)
         if (deck%keywords(i)%name /= "DELETE_"//kind) cycle
         if (deck%keywords(i)%root /= deck%last) cycle
         do nth = 1, deck%keywords(i)%sets()
            names_body = names_body .or. deck%keywords(i)%whole(kind(:1)//"ID", nth) == id
         end do
      end do
   end function names_body

   !> Each set of cards of a keyword that repeats them, or the keyword
   pure function items_of(cards, i) result(items)
      type(cards_type), intent(in) :: cards
      !> Index of the keyword
      integer, intent(in) :: i
      type(item_type), allocatable :: items(:)

      integer :: nth

      items = [(item_type(i, nth), nth=1, merge(cards%sets(), 1, cards%declaration%repeated))]
   end function items_of

   !> Whether two sets of cards say the same
   pure logical function are_equal(deck, one, other)
      type(deck_type), intent(in) :: deck
      type(item_type), intent(in) :: one, other

      integer :: rows

      are_equal = .false.
      associate (a => deck%keywords(one%keyword), b => deck%keywords(other%keyword))
         if (a%declaration%name /= b%declaration%name) return
         if (.not. a%declaration%repeated .or. .not. b%declaration%repeated) return
         rows = size(a%declaration%cards)
         if (size(b%declaration%cards) /= rows) return
         are_equal = all(abs(a%value(:, (one%nth - 1)*rows + 1:one%nth*rows) &
            & - b%value(:, (other%nth - 1)*rows + 1:other%nth*rows)) <= 0.0_wp)
      end associate
   end function are_equal

   !> Number of removed or added cards, with their keywords and numbers; empty without any
   pure function counted(verb, deck, items) result(words)
      !> What happens to them
      character(*), intent(in) :: verb
      type(deck_type), intent(in) :: deck
      type(item_type), intent(in) :: items(:)
      character(:), allocatable :: words

      integer :: i, row
      character(:), allocatable :: name

      words = ""
      if (size(items) == 0) return
      words = ", "//verb//" "//text(size(items))//" ("
      name = ""
      do i = 1, size(items)
         associate (cards => deck%keywords(items(i)%keyword))
            if (i > 1) words = words//merge(", ", "; ", cards%declaration%name == name)
            if (i > most_shown) then
               words = words//"..."
               exit
            end if
            if (cards%declaration%name /= name) words = words//cards%declaration%name//" "
            name = cards%declaration%name
            row = (items(i)%nth - 1)*size(cards%declaration%cards) &
               & + cards%declaration%leading_cards + 1
            words = words//text(nint(cards%value(1, row)))
         end associate
      end do
      words = words//")"
   end function counted

   !> Fields of a keyword that differ from the last one before; empty when the last deck has none
   pure function change_of_settings(deck, name) result(words)
      type(deck_type), intent(in) :: deck
      character(*), intent(in) :: name
      character(:), allocatable :: words

      integer :: before, i, now

      words = ""
      before = 0
      now = 0
      do i = 1, size(deck%keywords)
         if (deck%keywords(i)%name /= name) cycle
         if (now > 0) before = now
         now = i
      end do
      if (now == 0) return
      if (deck%keywords(now)%root < deck%last) return
      select case (name)
      case ("TITLE")
         words = deck%keywords(now)%entry("TITLE")
      case ("CONTROL_STAGE")
         words = "the beginning of the run"
         if (deck%keywords(now)%whole("TIME") == 1) words = "the restart"
      case default
         words = change_of_fields(deck, before, now)
      end select
   end function change_of_settings

   !> Names and values of fields that differ between two keywords of one name; without an earlier
   !> one those that are not the default
   pure function change_of_fields(deck, before, now) result(words)
      type(deck_type), intent(in) :: deck
      !> Index of the earlier one, 0 for none, and of the later one
      integer, intent(in) :: before, now
      character(:), allocatable :: words

      integer :: c, f
      character(:), allocatable :: old, new

      words = ""
      associate (cards => deck%keywords(now))
         do c = 1, size(cards%declaration%cards)
            do f = 1, size(cards%declaration%cards(c)%fields)
               associate (field => cards%declaration%cards(c)%fields(f))
                  if (.not. field%supported) cycle
                  new = number(field, cards%number(field%name))
                  old = number(field, field%default)
                  if (before > 0) old = number(field, deck%keywords(before)%number(field%name))
                  if (old == new .and. (before > 0 .or. .not. field%required)) cycle
                  if (before == 0) old = "none"
                  words = words//", "//trim(field%name)//" "//old//" to "//new
               end associate
            end do
         end do
      end associate
      words = words(3:)
      if (len(words) == 0) words = trim(merge("as before       ", "none to defaults", before > 0))
   end function change_of_fields

   !> Text of the value of a field
   pure function number(field, value) result(words)
      type(field_type), intent(in) :: field
      real(wp), intent(in) :: value
      character(:), allocatable :: words

      if (field%kind == integer_field) then
         words = text(nint(value))
      else
         words = text(value)
      end if
   end function number

end module plydyn_input_change_list
