!> The list of all keywords, in the order of the manual, and what it prints.
!>
!> A new keyword is a routine that visits its fields, and its row in the list of its family.
module plydyn_input_keywords
   use plydyn_base_error, only : error_type, exit_usage, fail
   use plydyn_base_text, only : upper_case
   use plydyn_deck_declaration, only : is_ignored, is_read, is_refused, keyword_type
   use plydyn_deck_keyword_json, only : keywords_json
   use plydyn_deck_lookup, only : find_keyword, keyword_advice
   use plydyn_deck_manual, only : keyword_index, keyword_list, keyword_page
   use plydyn_input_control, only : add_control
   use plydyn_input_crack_lines, only : add_crack_lines
   use plydyn_input_damage, only : add_damaged_materials
   use plydyn_input_fixture, only : add_fixtures
   use plydyn_input_impactor, only : add_impactors
   use plydyn_input_interface, only : add_interfaces
   use plydyn_input_keyword_row, only : keyword_list_type, keyword_row_type
   use plydyn_input_load, only : add_loads
   use plydyn_input_material, only : add_elastic_materials
   use plydyn_input_mesh, only : add_mesh
   use plydyn_input_metal, only : add_metals
   use plydyn_input_output, only : add_output
   use plydyn_input_part, only : add_parts
   use plydyn_input_solid, only : add_solids
   use plydyn_input_support, only : add_supports
   use plydyn_input_unsupported_keywords, only : ignored_keywords, refused_keywords
   implicit none
   private

   public :: all_keywords, all_rows, keyword_manual

   character(*), parameter :: line_feed = achar(10)
   !> What stands in the place of a name to get all declarations as JSON
   character(*), parameter :: as_json = "--json"

contains

   !> Rows of all keywords, in the order of the manual
   function all_rows() result(rows)
      type(keyword_row_type), allocatable :: rows(:)

      type(keyword_list_type) :: list

      call add_control(list)
      call add_mesh(list)
      call add_parts(list)
      call add_elastic_materials(list)
      call add_metals(list)
      call add_damaged_materials(list)
      call add_solids(list)
      call add_interfaces(list)
      call add_crack_lines(list)
      call add_supports(list)
      call add_loads(list)
      call add_impactors(list)
      call add_fixtures(list)
      call add_output(list)
      call list%add_unread(ignored_keywords())
      call list%add_unread(refused_keywords())
      rows = list%rows(:list%count)
   end function all_rows

   !> Declarations of all keywords
   function all_keywords() result(keywords)
      type(keyword_type), allocatable :: keywords(:)

      type(keyword_row_type), allocatable :: rows(:)

      rows = all_rows()
      keywords = rows%declaration
   end function all_keywords

   !> Pages of all keywords, or the page of one, in markdown; all declarations as JSON
   subroutine keyword_manual(name, pages, error)
      !> Name of a keyword with or without star, in either case; empty for all; `--json`
      character(*), intent(in) :: name
      !> The pages
      character(:), allocatable, intent(out) :: pages
      !> There is no such keyword
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: bare
      type(keyword_type), allocatable :: keywords(:)
      integer :: i

      keywords = all_keywords()
      if (len_trim(name) == 0) then
         pages = all_pages(keywords)
         return
      else if (name == as_json) then
         pages = keywords_json(keywords)
         return
      end if
      bare = upper_case(trim(name))
      if (bare(1:1) == "*") bare = bare(2:)
      i = find_keyword(bare, keywords)
      if (i > 0) then
         pages = keyword_page(keywords(i))
      else
         call fail(error, exit_usage, "there is no keyword *"//bare//": right would be " &
            & //keyword_advice(bare, keywords))
      end if
   end subroutine keyword_manual

   !> Pages of all keywords
   function all_pages(keywords) result(pages)
      !> Their declarations
      type(keyword_type), intent(in) :: keywords(:)
      character(:), allocatable :: pages

      integer :: i

      pages = "# Keywords"//line_feed//line_feed//"The examples fit the deck of [Writing a " &
         & //"deck](decks.md#a-whole-deck), with what they name, such as a curve, beside them." &
         & //line_feed//line_feed//keyword_index(keywords)
      do i = 1, size(keywords)
         if (keywords(i)%status == is_read) pages = pages//keyword_page(keywords(i))
      end do
      pages = pages//"# Keywords that are known and ignored"//line_feed//line_feed &
         & //keyword_list(keywords, is_ignored) &
         & //line_feed//"# Keywords that are refused with advice"//line_feed//line_feed &
         & //keyword_list(keywords, is_refused)
   end function all_pages

end module plydyn_input_keywords
