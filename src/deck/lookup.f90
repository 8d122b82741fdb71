!> Finds the declaration of a keyword by name, or a suggestion for an unknown name.
module plydyn_deck_lookup
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_declaration, only : is_ignored, is_refused, keyword_type
   use plydyn_deck_nearest, only : nearest_word
   use plydyn_deck_report, only : file_position_type, report_type
   use plydyn_deck_values, only : split_words
   implicit none
   private

   public :: declare, find_keyword, keyword_advice

   !> Longest name of a keyword
   integer, parameter :: longest_name = 64

contains

   !> Find the declaration of a keyword
   subroutine declare(name, keywords, place, cards, report)
      !> Name without star, in capitals
      character(*), intent(in) :: name
      !> Declarations of the keywords that are known
      type(keyword_type), intent(in) :: keywords(:)
      !> Position of the keyword
      type(file_position_type), intent(in) :: place
      !> Receives name and declaration if the keyword is read
      type(cards_type), intent(inout) :: cards
      !> Findings
      type(report_type), intent(inout) :: report

      character(:), allocatable :: stem, suffix
      integer :: i

      suffix = ""
      stem = name
      i = find_keyword(name, keywords)
      if (i == 0) then
         suffix = name(index(name, "_", back=.true.) + 1:)
         stem = name(:max(len(name) - len(suffix) - 1, 0))
         i = find_keyword(stem, keywords)
         if (i > 0) then
            if (.not. any(split_words(keywords(i)%suffixes) == suffix)) i = 0
         end if
      end if
      if (i == 0) then
         call report%refuse(place, "'*"//name//"' is not a keyword of plydyn", &
            & keyword_advice(name, keywords))
      else if (keywords(i)%status == is_refused) then
         call report%refuse(place, "'*"//name//"' is not supported", keywords(i)%remark)
      else if (keywords(i)%status == is_ignored) then
         if (len(keywords(i)%remark) > 0) then
            call report%warn(place, "'*"//name//"' is ignored", keywords(i)%remark)
         else
            call report%warn(place, "'*"//name//"' is ignored", &
               & "no change needed: the results do not depend on it")
         end if
      else
         cards%name = keywords(i)%name
         cards%declaration = keywords(i)
         if (len(suffix) > 0) cards%declaration = keywords(i)%with_suffix(suffix)
      end if
   end subroutine declare

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

      do i = 1, size(keywords)
         known(i) = keywords(i)%name
      end do
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

end module plydyn_deck_lookup
