!> Visits the fields of a keyword with the numbers that the deck defines: what a field refers to is
!> looked up, and findings are reported where they stand.
module plydyn_input_card_visitor
   use plydyn_deck_declaration, only : name_length
   use plydyn_deck_visitor, only : visitor_type
   use plydyn_base_text, only : digits => text
   use plydyn_input_catalogue, only : catalogue_type
   implicit none
   private

   !> A visit of one keyword of the deck
   type, public, extends(visitor_type) :: card_visitor_type
      !> Numbers of everything so far, and findings
      type(catalogue_type) :: catalogue
   contains
      procedure :: define
      procedure :: refer
      procedure :: look_up
      procedure :: members
      procedure :: list
      procedure :: refuse
      procedure :: warn
      procedure :: warn_idle
      procedure :: note
   end type card_visitor_type

contains

   !> A number that the keyword defines
   subroutine define(self, kind, name, sentence, value)
      class(card_visitor_type), intent(inout) :: self
      !> What has the number, such as `a_node`
      integer, intent(in) :: kind
      character(*), intent(in) :: name, sentence
      integer, intent(inout) :: value

      call self%integer(name, sentence, value, least=1)
      if (self%reads) call self%catalogue%define(kind, self%cards_type, name)
   end subroutine define

   !> A number of something that another keyword defines; a 0 that is allowed is nothing
   subroutine refer(self, kind, name, sentence, index, default, least)
      class(card_visitor_type), intent(inout) :: self
      !> What has the number, such as `a_node`
      integer, intent(in) :: kind
      character(*), intent(in) :: name, sentence
      !> Its index in the order of definition; 0 for nothing, and for an undefined one
      integer, intent(inout) :: index
      !> Value of a blank, and smallest value; 1 if it is not given
      integer, intent(in), optional :: default, least

      integer :: fewest, number

      fewest = 1
      if (present(least)) fewest = least
      call self%integer(name, sentence, number, default=default, least=fewest)
      if (.not. self%reads) return
      index = 0
      if (number > 0) call self%catalogue%find(kind, self%cards_type, name, index)
   end subroutine refer

   !> Index of what a field refers to that has been visited; 0 for nothing, and for an undefined one
   subroutine look_up(self, kind, name, index)
      class(card_visitor_type), intent(inout) :: self
      !> What has the number, such as `a_node`
      integer, intent(in) :: kind
      character(*), intent(in) :: name
      integer, intent(out) :: index

      call self%catalogue%find(kind, self%cards_type, name, index)
   end subroutine look_up

   !> The number of a set
   subroutine members(self, kind, name, sentence, list, default, least)
      class(card_visitor_type), intent(inout) :: self
      !> `a_node_set` or `a_quad_set`
      integer, intent(in) :: kind
      character(*), intent(in) :: name, sentence
      !> Indices of its nodes or quads; unallocated for a 0 that is allowed
      integer, allocatable, intent(inout) :: list(:)
      !> Value of a blank, and 0 where that is allowed
      integer, intent(in), optional :: default, least

      integer :: number

      call self%integer(name, sentence, number, default, merge(0, 1, present(least)))
      if (.not. self%reads) return
      if (allocated(list)) deallocate (list)
      if (number == 0 .and. present(least)) return
      call self%catalogue%find_set(kind, self%cards_type, name, list)
   end subroutine members

   !> Fields that list numbers, of all rows: `NID` is NID1, NID2 and so on; trailing blanks are no
   !> members
   subroutine list(self, kind, name, number, sentence, indices)
      class(card_visitor_type), intent(inout) :: self
      !> What has the numbers, such as `a_node`
      integer, intent(in) :: kind
      !> Name without number
      character(*), intent(in) :: name
      !> Fields on the card
      integer, intent(in) :: number
      !> What a member is
      character(*), intent(in) :: sentence
      !> Indices of the members in the order of definition
      integer, allocatable, intent(inout) :: indices(:)

      character(name_length) :: names(number)
      integer :: i, members, nth, unset

      do i = 1, number
         names(i) = name//digits(i)
         if (self%reads) cycle
         if (i == 1) call self%integer(trim(names(i)), sentence, unset, least=1)
         if (i > 1) call self%integer(trim(names(i)), sentence, unset, default=0, least=1)
      end do
      if (.not. self%reads) return
      if (allocated(indices)) deallocate (indices)
      allocate (indices(number*self%sets()), source=0)
      members = 0
      do nth = 1, self%sets()
         do i = 1, number
            if (.not. self%has(names(i), nth)) cycle
            members = members + 1
            call self%catalogue%find(kind, self%cards_type, trim(names(i)), indices(members), nth)
         end do
      end do
      indices = pack(indices, indices > 0)
   end subroutine list

   !> Report an error at a field
   subroutine refuse(self, name, wrong, right)
      class(card_visitor_type), intent(inout) :: self
      !> Name of the field, what is wrong, and what would be right
      character(*), intent(in) :: name, wrong, right

      call self%catalogue%report%refuse(self%place(name), wrong, right)
   end subroutine refuse

   !> Report a warning at a field
   subroutine warn(self, name, wrong, right)
      class(card_visitor_type), intent(inout) :: self
      !> Name of the field, what is suspicious, and what to do about it
      character(*), intent(in) :: name, wrong, right

      call self%catalogue%report%warn(self%place(name), wrong, right)
   end subroutine warn

   !> Warn of a field that something else leaves without effect, in a deck without errors so far: a
   !> value that was refused counts as 0, and would seem to be missing
   subroutine warn_idle(self, name, right)
      class(card_visitor_type), intent(inout) :: self
      !> Name of the field, and what would give it an effect
      character(*), intent(in) :: name, right

      if (self%catalogue%report%has_errors()) return
      call self%warn(name, name//" is without effect", right//", or 0 here")
   end subroutine warn_idle

   !> Report a note at a field
   subroutine note(self, name, what, why)
      class(card_visitor_type), intent(inout) :: self
      !> Name of the field, what is noted, and the reason
      character(*), intent(in) :: name, what, why

      call self%catalogue%report%note(self%place(name), what, why)
   end subroutine note

end module plydyn_input_card_visitor
