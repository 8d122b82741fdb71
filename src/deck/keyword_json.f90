!> Declarations of keywords as JSON, for programs that write or read decks.
module plydyn_deck_keyword_json
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_declaration, only : field_type, integer_field, is_ignored, is_read, &
      & keyword_type, real_field, word_field, words_field
   use plydyn_deck_values, only : longest_word, split_words
   implicit none
   private

   public :: keywords_json

   character(*), parameter :: line_feed = achar(10)
   !> Names of the kinds of fields, in the order of their numbers
   character(*), parameter :: kind_names(5) = [character(7) :: "integer", "real", "word", "text", &
      & "words"]

contains

   !> A list with an object for each keyword, a line for each field
   function keywords_json(keywords) result(json)
      !> Their declarations
      type(keyword_type), intent(in) :: keywords(:)
      character(:), allocatable :: json

      integer :: i

      json = "["
      do i = 1, size(keywords)
         if (i > 1) json = json//","
         json = json//line_feed//"{"//entry("name", quoted(keywords(i)%name))
         if (keywords(i)%status == is_read) then
            json = json//", "//read_keyword(keywords(i))//"}"
         else
            json = json//", "//entry("status", quoted(trim(merge("ignored", "refused", &
               & keywords(i)%status == is_ignored))))//", " &
               & //entry("advice", quoted(keywords(i)%remark))//"}"
         end if
      end do
      json = json//line_feed//"]"
   end function keywords_json

   !> Entries of a keyword that is read
   function read_keyword(keyword) result(json)
      type(keyword_type), intent(in) :: keyword
      character(:), allocatable :: json

      integer :: i

      json = entry("status", quoted("read"))//", "//entry("own", truth(keyword%own))//"," &
         & //line_feed//" "//entry("sentence", quoted(keyword%sentence))//","//line_feed//" " &
         & //entry("remark", quoted(keyword%remark))//","//line_feed//" " &
         & //entry("once", truth(keyword%once))//", "//entry("repeated", truth(keyword%repeated)) &
         & //", "//entry("alias", quoted(keyword%alias))//", " &
         & //entry("suffixes", word_list(keyword%suffixes))//", " &
         & //entry("change", quoted(keyword%change))//","//line_feed//" "//'"cards": ['
      do i = 1, size(keyword%cards)
         if (i > 1) json = json//","
         associate (card => keyword%cards(i))
            json = json//line_feed//"  {"//entry("optional", truth(card%optional))//", " &
               & //entry("repeated", truth(card%repeated))//', "fields": [' &
               & //field_list(card%fields)//"]}"
         end associate
      end do
      json = json//"]"
   end function read_keyword

   !> The fields of a card, a line for each
   function field_list(fields) result(json)
      type(field_type), intent(in) :: fields(:)
      character(:), allocatable :: json

      integer :: first, i

      json = ""
      first = 1
      do i = 1, size(fields)
         if (i > 1) json = json//","
         json = json//line_feed//"   {"//entry("name", quoted(trim(fields(i)%name)))//", " &
            & //entry("kind", quoted(trim(kind_names(fields(i)%kind))))//", " &
            & //entry("columns", number_list([first, first + fields(i)%width - 1]*1.0_wp))//", " &
            & //limits(fields(i))//entry("sentence", quoted(fields(i)%sentence))//"}"
         first = first + fields(i)%width
      end do
   end function field_list

   !> What a field accepts; entries that say nothing are left out
   function limits(field) result(json)
      type(field_type), intent(in) :: field
      character(:), allocatable :: json

      json = ""
      if (field%kind == real_field .and. field%supported) json = json &
         & //entry("unit", quoted(field%dimension))//", "
      if (field%required) then
         json = json//entry("required", truth(.true.))//", "
      else if (field%supported .and. any(field%kind == [integer_field, real_field])) then
         json = json//entry("default", text(field%default))//", "
      end if
      if (.not. field%supported) json = json//entry("supported", truth(.false.))//", "
      if (field%zero_is_default) json = json//entry("zero_is_default", truth(.true.))//", "
      if (field%least > -huge(1.0_wp)) json = json//entry("least", text(field%least))//", "
      if (field%above > -huge(1.0_wp)) json = json//entry("above", text(field%above))//", "
      if (field%most < huge(1.0_wp)) json = json//entry("most", text(field%most))//", "
      if (allocated(field%allowed)) json = json//entry("allowed", number_list(field%allowed))//", "
      if (any(field%kind == [word_field, words_field])) json = json &
         & //entry("words", word_list(field%words))//", "
   end function limits

   !> A name and its value
   pure function entry(name, value) result(json)
      character(*), intent(in) :: name, value
      character(:), allocatable :: json

      json = '"'//name//'": '//value
   end function entry

   !> A text in quotes
   pure function quoted(words) result(json)
      character(*), intent(in) :: words
      character(:), allocatable :: json

      integer :: i

      json = '"'
      do i = 1, len(words)
         if (index('"\', words(i:i)) > 0) json = json//"\"
         json = json//words(i:i)
      end do
      json = json//'"'
   end function quoted

   !> True or false
   pure function truth(value) result(json)
      logical, intent(in) :: value
      character(:), allocatable :: json

      json = trim(merge("true ", "false", value))
   end function truth

   !> Words with blanks between them as a list
   pure function word_list(words) result(json)
      character(*), intent(in) :: words
      character(:), allocatable :: json

      character(longest_word), allocatable :: list(:)
      integer :: i

      list = split_words(words)
      json = "["
      do i = 1, size(list)
         if (i > 1) json = json//", "
         json = json//quoted(trim(list(i)))
      end do
      json = json//"]"
   end function word_list

   !> Numbers as a list
   function number_list(numbers) result(json)
      real(wp), intent(in) :: numbers(:)
      character(:), allocatable :: json

      integer :: i

      json = "["
      do i = 1, size(numbers)
         if (i > 1) json = json//", "
         json = json//text(numbers(i))
      end do
      json = json//"]"
   end function number_list

end module plydyn_deck_keyword_json
