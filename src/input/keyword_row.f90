!> Row of a keyword: its declaration, visit, stage of reading and elements.
module plydyn_input_keyword_row
   use plydyn_deck_declaration, only : keyword_type
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_model_model, only : model_type
   implicit none
   private

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
      !> Declares its fields, and takes them into the model
      procedure(visit_card), pointer, nopass :: visit => null()
      !> Looks at its cards again when the whole deck has been read; none for most keywords
      procedure(visit_card), pointer, nopass :: look_again => null()
      !> Stage at which it is read, 0 for never; `for_all`, `for_plates` or `for_bricks`
      integer :: stage = 0, elements = for_all
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
      !> Visit the fields of one keyword in their order, which declares them or reads their values
      subroutine visit_card(card, model)
         import :: card_visitor_type, model_type
         implicit none
         class(card_visitor_type), intent(inout) :: card
         !> Gets the values; untouched by a declaration
         type(model_type), intent(inout) :: model
      end subroutine visit_card
   end interface

   !> Rows that fit before the list grows
   integer, parameter :: first_room = 128

contains

   !> Add a keyword
   subroutine add(self, name, visit, stage, elements, check)
      class(keyword_list_type), intent(inout) :: self
      !> Its name without the star
      character(*), intent(in) :: name
      !> Visits its fields
      procedure(visit_card) :: visit
      !> Stage at which it is read, by default never; `for_plates` or `for_bricks`, by default all
      integer, intent(in), optional :: stage, elements
      !> Looks at its cards again at the end
      procedure(visit_card), optional :: check

      type(card_visitor_type) :: card
      type(model_type) :: model
      type(keyword_row_type) :: row

      call card%declare(name)
      call visit(card, model)
      row%declaration = card%declaration
      row%visit => visit
      if (present(stage)) row%stage = stage
      if (present(elements)) row%elements = elements
      if (present(check)) row%look_again => check
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

end module plydyn_input_keyword_row
