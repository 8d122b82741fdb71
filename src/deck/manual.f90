!> Pages of the keyword manual, generated from the declarations.
module plydyn_deck_manual
   use plydyn_base_text, only : lower_case, text
   use plydyn_deck_declaration, only : field_type, integer_field, is_ignored, &
      & is_read, is_refused, keyword_type, real_field, word_field, words_field
   use plydyn_deck_values, only : range_words
   implicit none
   private

   public :: keyword_index, keyword_page, keyword_list

   character(*), parameter :: line_feed = achar(10)

contains

   !> Page of one keyword in markdown
   function keyword_page(keyword) result(page)
      !> Its declaration
      type(keyword_type), intent(in) :: keyword
      character(:), allocatable :: page

      integer :: i

      page = "## *"//keyword%name//line_feed//line_feed
      select case (keyword%status)
      case (is_ignored)
         page = page//"Known and ignored: it does not change the results."//line_feed
         if (len(keyword%remark) > 0) page = page//"Right would be: "//keyword%remark//"." &
            & //line_feed
      case (is_refused)
         page = page//"Refused; right would be: "//keyword%remark//"."//line_feed
      case default
         page = page//keyword%sentence//line_feed
         if (len(keyword%remark) > 0) page = page//line_feed//keyword%remark//line_feed
         page = page//origin_text(keyword)
         do i = 1, size(keyword%cards)
            page = page//card_text(keyword, i)
         end do
         if (allocated(keyword%example)) page = page//example_text(keyword)
      end select
      page = page//line_feed
   end function keyword_page

   !> Table of the keywords that are read, each with a link to its page
   function keyword_index(keywords) result(words)
      !> Their declarations
      type(keyword_type), intent(in) :: keywords(:)
      character(:), allocatable :: words

      integer :: i

      words = "| keyword | what it is for |"//line_feed//"|---|---|"//line_feed
      do i = 1, size(keywords)
         if (keywords(i)%status /= is_read) cycle
         words = words//"| [*"//keywords(i)%name//"](#"//lower_case(keywords(i)%name)//") | " &
            & //keywords(i)%sentence//" |"//line_feed
      end do
      words = words//line_feed
   end function keyword_index

   !> Names of the keywords of one status, in one paragraph
   function keyword_list(keywords, status) result(words)
      !> Their declarations
      type(keyword_type), intent(in) :: keywords(:)
      !> `is_ignored` or `is_refused`
      integer, intent(in) :: status
      character(:), allocatable :: words

      integer :: i

      words = ""
      do i = 1, size(keywords)
         if (keywords(i)%status /= status) cycle
         if (status == is_ignored) words = words//"`*"//keywords(i)%name//"` "
         if (status == is_ignored .and. len(keywords(i)%remark) > 0) then
            words = words//"(right would be "//keywords(i)%remark//") "
         end if
         if (status == is_refused) words = words//"- `*"//keywords(i)%name//"`: right would be " &
            & //keywords(i)%remark//line_feed
      end do
      words = words//line_feed
   end function keyword_list

   !> Origin of the keyword, its suffixes, and how often it may occur
   function origin_text(keyword) result(words)
      type(keyword_type), intent(in) :: keyword
      character(:), allocatable :: words

      words = line_feed//"Cards of LS-DYNA."
      if (keyword%own) words = line_feed//"A keyword of plydyn."
      if (len(keyword%alias) > 0) words = words//" Also `*"//keyword%alias//"`."
      if (keyword%suffixes == "TITLE") words = words//" `_TITLE` adds a line with a title in front."
      if (keyword%suffixes == "ID") words = words &
         & //" `_ID` adds a card with a number and a title in front."
      if (keyword%once) words = words//" Once in a deck."
      if (len(keyword%change) > 0) words = words//" A restart may have it."
      if (keyword%repeated .and. size(keyword%cards) == 1) then
         words = words//" Any number of cards."
      else if (keyword%repeated) then
         words = words//" Any number of sets of the cards."
      end if
      words = words//line_feed
   end function origin_text

   !> Example of a keyword, and where the manual explains it
   function example_text(keyword) result(words)
      type(keyword_type), intent(in) :: keyword
      character(:), allocatable :: words

      words = line_feed//"Example"//line_feed//line_feed//"```"//line_feed//"*"//keyword%name &
         & //line_feed//keyword%example//"```"//line_feed
      if (index(keyword%theory, ".md#") > 0) then
         words = words//line_feed//"[Use]("//keyword%theory//")"//line_feed
      else if (len(keyword%theory) > 0) then
         words = words//line_feed//"[Theory](theory.md#"//keyword%theory//")"//line_feed
      end if
   end function example_text

   !> Table of one card
   function card_text(keyword, number) result(words)
      type(keyword_type), intent(in) :: keyword
      !> Number of the card
      integer, intent(in) :: number
      character(:), allocatable :: words

      integer :: begin, i

      associate (card => keyword%cards(number))
         words = line_feed//"Card "//text(number)
         if (card%repeated .and. card%optional) then
            words = words//", any number or none"
         else if (card%repeated) then
            words = words//", any number"
         else if (card%optional) then
            words = words//", may be missing"
         end if
         words = words//line_feed//line_feed &
            & //"| field | columns | accepts | default | meaning |"//line_feed &
            & //"|---|---|---|---|---|"//line_feed
         begin = 1
         do i = 1, size(card%fields)
            words = words//field_text(card%fields(i), begin)
            begin = begin + card%fields(i)%width
         end do
      end associate
   end function card_text

   !> Row of one field
   function field_text(field, begin) result(row)
      type(field_type), intent(in) :: field
      !> Its first column
      integer, intent(in) :: begin
      character(:), allocatable :: row

      row = "| "//trim(field%name)//" | "//text(begin)//"-"//text(begin + field%width - 1)//" | " &
         & //accepted_text(field)//" | "//default_text(field)//" | "//field%sentence//" |" &
         & //line_feed
   end function field_text

   !> Values that a field accepts
   function accepted_text(field) result(words)
      type(field_type), intent(in) :: field
      character(:), allocatable :: words

      select case (field%kind)
      case (integer_field, real_field)
         words = range_words(field)
      case (word_field, words_field)
         words = field%words
         if (len(words) == 0) words = "text"
      case default
         words = "text"
      end select
   end function accepted_text

   !> Value of a blank field
   function default_text(field) result(words)
      type(field_type), intent(in) :: field
      character(:), allocatable :: words

      words = "blank"
      if (field%required) then
         words = "required"
      else if (field%kind == integer_field .or. field%kind == real_field) then
         if (field%supported) words = text(field%default)
         if (field%zero_is_default) words = words//", also for 0"
      end if
   end function default_text

end module plydyn_deck_manual
