!> Row of a keyword: its declaration, reader, stage of reading and elements.
module plydyn_input_keyword_row
   use plydyn_deck_cards, only : cards_type
   use plydyn_deck_declaration, only : keyword_type
   use plydyn_input_catalogue, only : catalogue_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: index_of_row

   !> Stages of reading, in their order. A reader refers only to what earlier stages have read:
   !> definitions refer to nothing, tables to curves, materials to curves and tables, parts to
   !> materials, elements to nodes and parts, sets to nodes and elements, laminates to parts,
   !> constraints to supports and motions
   integer, parameter, public :: stage_definition = 1, stage_table = 2, stage_material = 3, &
      & stage_part = 4, stage_element = 5, stage_set = 6, stage_laminate = 7, stage_support = 8, &
      & stage_load = 9, stage_constraint = 10, stage_control = 11, stage_output = 12
   integer, parameter, public :: stages = stage_output

   !> Elements that a keyword is for
   integer, parameter, public :: for_all = 0, for_plates = 1, for_bricks = 2

   !> One keyword
   type, public :: keyword_row_type
      !> Its cards, for the parser and the manual
      type(keyword_type) :: declaration
      !> Takes its cards into the model; none for a keyword without anything to read
      procedure(read_cards), pointer, nopass :: read => null()
      !> Stage at which it is read
      integer :: stage = 0
      !> `for_all`, `for_plates` or `for_bricks`
      integer :: elements = for_all
      !> Looks at its cards again when the whole deck has been read; none for most keywords
      procedure(read_cards), pointer, nopass :: check => null()
   end type keyword_row_type

   !> All keywords, in the order of the manual
   type, public :: keyword_list_type
      !> Room for the rows; as many as `count` are in use
      type(keyword_row_type), allocatable :: rows(:)
      !> Number of rows
      integer :: count = 0
   contains
      procedure :: add
      procedure :: add_unread
      procedure, private :: append
   end type keyword_list_type

   abstract interface
      !> Take the cards of one keyword into the model
      subroutine read_cards(cards, catalogue, model)
         import :: cards_type, catalogue_type, model_type
         implicit none
         !> The keyword
         type(cards_type), intent(in) :: cards
         !> Numbers of everything so far; gets new ones, and findings
         type(catalogue_type), intent(inout) :: catalogue
         type(model_type), intent(inout) :: model
      end subroutine read_cards
   end interface

   !> Rows that fit before the list grows
   integer, parameter :: first_room = 128

contains

   !> Add a keyword that is read
   subroutine add(self, declaration, reader, stage, elements, check)
      class(keyword_list_type), intent(inout) :: self
      !> Its cards
      type(keyword_type), intent(in) :: declaration
      !> Takes its cards into the model
      procedure(read_cards) :: reader
      !> Stage at which it is read
      integer, intent(in) :: stage
      !> `for_all`, which is the default, `for_plates` or `for_bricks`
      integer, intent(in), optional :: elements
      !> Looks at its cards again at the end
      procedure(read_cards), optional :: check

      type(keyword_row_type) :: row

      row%declaration = declaration
      row%read => reader
      row%stage = stage
      if (present(elements)) row%elements = elements
      if (present(check)) row%check => check
      call self%append(row)
   end subroutine add

   !> Add keywords that no reader reads: those of the parser, ignored and refused ones
   subroutine add_unread(self, declarations)
      class(keyword_list_type), intent(inout) :: self
      !> Their declarations
      type(keyword_type), intent(in) :: declarations(:)

      type(keyword_row_type) :: row
      integer :: i

      do i = 1, size(declarations)
         row%declaration = declarations(i)
         call self%append(row)
      end do
   end subroutine add_unread

   !> Append a row
   subroutine append(self, row)
      class(keyword_list_type), intent(inout) :: self
      type(keyword_row_type), intent(in) :: row

      type(keyword_row_type), allocatable :: longer(:)

      if (.not. allocated(self%rows)) allocate (self%rows(first_room))
      if (self%count == size(self%rows)) then
         allocate (longer(2*self%count))
         longer(:self%count) = self%rows
         call move_alloc(longer, self%rows)
      end if
      self%count = self%count + 1
      self%rows(self%count) = row
   end subroutine append

   !> Index of the row of a keyword; 0 if there is none of that name
   pure integer function index_of_row(rows, name) result(i)
      !> Rows of all keywords
      type(keyword_row_type), intent(in) :: rows(:)
      !> Name as declared
      character(*), intent(in) :: name

      do i = 1, size(rows)
         if (rows(i)%declaration%name == name) return
      end do
      i = 0
   end function index_of_row

end module plydyn_input_keyword_row
