!> Finds the declaration of a keyword by name, or a suggestion for an unknown name.
module plydyn_deck_lookup
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_declaration, only : is_ignored, is_read, is_refused, keyword_type, text_field
   use plydyn_deck_nearest, only : nearest_word
   use plydyn_deck_report, only : deck_location_type, report_type
   use plydyn_deck_values, only : split_words
   implicit none
   private

   public :: declare, find_keyword, keyword_advice, shown_name

   !> Longest name of a keyword
   integer, parameter :: longest_name = 64

   !> Letters of a name that a message repeats
   integer, parameter :: longest_shown = 80

contains

   !> Find the declaration of a keyword
   subroutine declare(name, keywords, place, cards, report)
      !> Name without star, in capitals
      character(*), intent(in) :: name
      !> Declarations of the keywords that are known
      type(keyword_type), intent(in) :: keywords(:)
      !> Position of the keyword
      type(deck_location_type), intent(in) :: place
      !> Receives name and declaration if the keyword is read
      type(cards_type), intent(inout) :: cards
      !> Findings
      type(report_type), intent(inout) :: report

      character(:), allocatable :: advice, stem, suffix
      integer :: i

      suffix = ""
      stem = name
      i = find_keyword(name, keywords)
      if (i == 0) then
         suffix = name(index(name, "_", back=.true.) + 1:)
         stem = name(:max(len(name) - len(suffix) - 1, 0))
         i = find_keyword(stem, keywords)
         if (i > 0) then
            if (keywords(i)%status == is_read .and. &
               & .not. any(split_words(keywords(i)%suffixes) == suffix)) i = 0
         end if
      end if
      if (i == 0) i = find_family(name, keywords)
      cards%is_unread = i == 0
      if (i > 0) cards%is_unread = keywords(i)%status == is_refused
      if (i == 0) then
         call report%refuse(place, "'*"//shown_name(name)//"' is not a keyword of plydyn", &
            & keyword_advice(name, keywords))
      else if (keywords(i)%status == is_refused) then
         call report%refuse(place, "'*"//name//"' is not supported", keywords(i)%remark)
      else if (keywords(i)%status == is_ignored) then
         advice = keywords(i)%remark
         if (len(advice) == 0) advice = "no change needed: the results do not depend on it"
         call report%warn(place, "'*"//name//"' is ignored", advice)
      else
         cards%name = keywords(i)%name
         cards%known = i
         cards%declaration = keywords(i)
         if (len(suffix) > 0) cards%declaration = keywords(i)%with_suffix(suffix)
      end if
   end subroutine declare

   !> A name as a message repeats it, or what stands behind it
   pure function shown_name(name) result(shown)
      !> Of any length
      character(*), intent(in) :: name
      character(:), allocatable :: shown

      shown = name
      if (len(name) > longest_shown) shown = name(:longest_shown)//"..."
   end function shown_name

   !> Index of a keyword; 0 if there is none of that name
   pure integer function find_keyword(name, keywords) result(i)
      !> Name without star, in capitals
      character(*), intent(in) :: name
      !> Declarations of the keywords that are known
      type(keyword_type), intent(in) :: keywords(:)

      do i = 1, size(keywords)
         if (keywords(i)%name == name) return
         if (len(keywords(i)%alias) > 0 .and. keywords(i)%alias == name) return
      end do
      i = 0
   end function find_keyword

   !> Suggestion in place of an option _TITLE or _ID that a keyword does not have; empty without one
   function option_advice(name, keywords) result(words)
      character(*), intent(in) :: name
      type(keyword_type), intent(in) :: keywords(:)
      character(:), allocatable :: words

      integer :: bar, i

      words = ""
      bar = index(name, "_", back=.true.)
      if (bar == 0) return
      if (.not. any(name(bar:) == [character(6) :: "_TITLE", "_ID"])) return
      i = find_keyword(name(:bar - 1), keywords)
      if (i == 0) return
      if (keywords(i)%status /= is_read) return
      words = "*"//name(:bar - 1)//" without "//name(bar:)
      if (size(keywords(i)%cards) == 0) return
      if (keywords(i)%cards(1)%fields(1)%kind == text_field) words = words &
         & //": its first card is the title in any case"
   end function option_advice

   !> Suggestion in place of an unknown keyword
   function keyword_advice(name, keywords) result(words)
      !> Name without star, in capitals
      character(*), intent(in) :: name
      !> Declarations of the keywords that are known
      type(keyword_type), intent(in) :: keywords(:)
      character(:), allocatable :: words

      character(longest_name) :: known(size(keywords))
      character(:), allocatable :: stem
      integer :: i

      words = option_advice(name, keywords)
      if (len(words) > 0) return
      do i = 1, size(keywords)
         known(i) = ""
         if (keywords(i)%status /= is_read) cycle
         if (.not. differ_in_digits(name, keywords(i)%name)) known(i) = keywords(i)%name
      end do
      words = sisters(name, known)
      if (len(words) > 0) return
      words = "one of those that 'plydyn --keywords' lists"
      stem = name
      i = 0
      do while (len(stem) > 0)
         i = nearest_word(stem, known)
         if (i > 0) exit
         ! try again without the last option of the name
         stem = stem(:index(stem, "_", back=.true.) - 1)
      end do
      if (i > 0) words = "perhaps *"//trim(known(i))
   end function keyword_advice

   !> The known names of which a name is the beginning, up to an underscore; empty for none
   pure function sisters(name, known) result(words)
      character(*), intent(in) :: name, known(:)
      character(:), allocatable :: words

      integer :: i

      words = ""
      do i = 1, size(known)
         if (index(known(i), name//"_") /= 1) cycle
         if (len(words) > 0) words = words//", "
         words = words//"*"//trim(known(i))
      end do
      if (index(words, ", ") > 0) words = "one of "//words
   end function sisters

   !> Whether both names have numbers, and others: *MAT_262 is no misspelt *MAT_022
   pure logical function differ_in_digits(one, other) result(differ)
      character(*), intent(in) :: one, other

      character(:), allocatable :: digits

      differ = .false.
      digits = digits_of(other)
      if (len(digits) == 0) return
      differ = len(digits_of(one)) > 0 .and. digits_of(one) /= digits
   end function differ_in_digits

   !> The digits of a name
   pure function digits_of(name) result(digits)
      character(*), intent(in) :: name
      character(:), allocatable :: digits

      character(len(name)) :: found
      integer :: count, i

      count = 0
      do i = 1, len(name)
         if (name(i:i) < "0" .or. name(i:i) > "9") cycle
         count = count + 1
         found(count:count) = name(i:i)
      end do
      digits = found(:count)
   end function digits_of

   !> Index of the family that a name belongs to, such as `CONTACT_*TIE`: all names that begin with
   !> the text before the star and have the text after it; 0 for none
   pure integer function find_family(name, keywords) result(i)
      character(*), intent(in) :: name
      type(keyword_type), intent(in) :: keywords(:)

      integer :: star

      do i = 1, size(keywords)
         star = index(keywords(i)%name, "*")
         if (star == 0 .or. star > len(name) + 1) cycle
         if (name(:star - 1) /= keywords(i)%name(:star - 1)) cycle
         if (index(name(star:), keywords(i)%name(star + 1:)) > 0) return
      end do
      i = 0
   end function find_family

end module plydyn_deck_lookup
