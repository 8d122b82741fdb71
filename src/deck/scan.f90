!> An expression that is read from left to right, and the first thing that is wrong with it.
module plydyn_deck_scan
   implicit none
   private

   !> An expression on its way to a number
   type, public :: scan_type
      !> The expression
      character(:), allocatable :: text
      !> Next character
      integer :: at = 1
      !> Parentheses, functions, signs and powers that the next character is within
      integer :: deep = 0
      !> First wrong character; 0 when all is well
      integer :: wrong_at = 0
      !> What is wrong, and what would be right
      character(:), allocatable :: wrong, right
   contains
      procedure :: expect
      procedure :: next
      procedure :: pass_blanks
      procedure :: stop_at
   end type scan_type

contains

   !> Step over a character that must come next
   subroutine expect(self, mark)
      class(scan_type), intent(inout) :: self
      !> The character
      character(1), intent(in) :: mark

      if (self%next() == mark) then
         self%at = self%at + 1
      else
         call self%stop_at(self%at, "a '"//mark//"' is missing here", "a "//mark)
      end if
   end subroutine expect

   !> The next character that is no blank; a blank at the end, and where something is wrong
   character(1) function next(self) result(c)
      class(scan_type), intent(inout) :: self

      call self%pass_blanks()
      c = " "
      if (self%wrong_at == 0 .and. self%at <= len(self%text)) c = self%text(self%at:self%at)
   end function next

   !> Step over blanks
   subroutine pass_blanks(self)
      class(scan_type), intent(inout) :: self

      do while (self%at <= len(self%text))
         if (self%text(self%at:self%at) /= " ") return
         self%at = self%at + 1
      end do
   end subroutine pass_blanks

   !> Keep the first thing that is wrong
   subroutine stop_at(self, at, wrong, right)
      class(scan_type), intent(inout) :: self
      !> The wrong character
      integer, intent(in) :: at
      !> What is wrong
      character(*), intent(in) :: wrong
      !> What would be right
      character(*), intent(in) :: right

      if (self%wrong_at > 0) return
      self%wrong_at = at
      self%wrong = wrong
      self%right = right
   end subroutine stop_at

end module plydyn_deck_scan
