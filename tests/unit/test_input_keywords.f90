!> Declarations are complete, every keyword has a reader, and names do not get in each other's way.
program test_input_keywords
   use plydyn_base_error, only : error_type
   use plydyn_deck_declaration, only : field_type, is_read, keyword_type
   use plydyn_input_keyword_row, only : keyword_row_type, stages
   use plydyn_input_keywords, only : all_keywords, all_rows, keyword_manual
   use testing, only : begin, check, check_error, finish
   implicit none

   !> Keywords that say how the decks of a restart change those before, before anything is read
   character(*), parameter :: of_changes(3) = [character(15) :: "CONTROL_STAGE", &
      & "DELETE_IMPACTOR", "DELETE_FIXTURE"]

   type(keyword_type), allocatable :: keywords(:)
   type(keyword_row_type), allocatable :: rows(:)
   type(error_type), allocatable :: error
   character(:), allocatable :: pages
   integer :: card, i, k

   keywords = all_keywords()

   call begin("all_keywords")
   do i = 1, size(keywords)
      associate (keyword => keywords(i))
         call check(.not. any([(keywords(k)%name == keyword%name, k=1, i - 1)]), &
            & keyword%name//" is declared once")
         if (keyword%status /= is_read) cycle
         call check(len(keyword%sentence) > 0, keyword%name//" says what it is for")
         do card = 1, size(keyword%cards)
            call check_card(keyword%name, keyword%cards(card)%fields)
         end do
         if (keyword%own) call check_stem(keyword%name)
      end associate
   end do

   call begin("all_rows")
   rows = all_rows()
   do i = 1, size(rows)
      call check_reader(rows(i))
   end do

   call begin("keyword_manual")
   call keyword_manual("impactor_sphere", pages, error)
   call check(index(pages, &
      & "| RADIUS | 11-20 | a number (length)") > 0, "has a page with the fields of a keyword")
   call keyword_manual("*NODE", pages, error)
   call check(index(pages, "| X | 9-24 |") > 0, "with their columns")
   call keyword_manual("", pages, error)
   call check(index(pages, "## *DATABASE_PROFILE") > 0, "and holds all pages")
   call keyword_manual("IMPACTOR_SPEHRE", pages, error)
   call check_error(error, "perhaps *IMPACTOR_SPHERE", "and has advice for a misspelt one")

   call finish()

contains

   !> A keyword with anything to read has a reader at one of the stages; one that is ignored or
   !> refused has none
   subroutine check_reader(row)
      !> The keyword
      type(keyword_row_type), intent(in) :: row

      associate (keyword => row%declaration)
         if (keyword%status /= is_read) then
            call check(row%stage, 0, keyword%name//" is not read")
         else if (any(of_changes == keyword%name)) then
            call check(row%stage, 0, keyword%name//" is read before all others")
         else if (has_content(keyword)) then
            call check(associated(row%visit), keyword%name//" is read")
            call check(row%stage >= 1 .and. row%stage <= stages, keyword%name//" has a stage")
         else
            call check(row%stage, 0, keyword%name//" has nothing to read")
         end if
      end associate
   end subroutine check_reader

   !> Whether a card of a keyword has a field that means something; keywords of the parser have none
   logical function has_content(keyword)
      type(keyword_type), intent(in) :: keyword

      type(keyword_type) :: titled
      integer :: card

      has_content = .false.
      titled = keyword
      if (index(keyword%suffixes, "TITLE") > 0) titled = keyword%with_suffix("TITLE")
      do card = 1, size(titled%cards)
         has_content = has_content .or. any(titled%cards(card)%fields%supported)
      end do
   end function has_content

   !> Fields have names of their own and a sentence
   subroutine check_card(name, fields)
      !> Name of the keyword
      character(*), intent(in) :: name
      !> Fields of one of its cards
      type(field_type), intent(in) :: fields(:)

      integer :: f

      call check(size(fields) > 0, name//" has no empty card")
      do f = 1, size(fields)
         call check(count(fields%name == fields(f)%name), 1, name//" has one "//fields(f)%name)
         call check(len(fields(f)%sentence) > 0, name//" explains "//fields(f)%name)
      end do
   end subroutine check_card

   !> Clients that cut an unknown name at `_` from the right must not end at a known keyword
   subroutine check_stem(name)
      !> Name of a keyword of our own
      character(*), intent(in) :: name

      character(:), allocatable :: stem
      integer :: k

      stem = name
      do while (index(stem, "_") > 0)
         stem = stem(:index(stem, "_", back=.true.) - 1)
         do k = 1, size(keywords)
            if (keywords(k)%own) cycle
            call check(keywords(k)%name /= stem, name//" is not cut to *"//stem)
         end do
      end do
   end subroutine check_stem

end program test_input_keywords
