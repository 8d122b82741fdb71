!> Scanner of an expression, with its first error.
module plydyn_deck_scan
   implicit none
   private

   !> An expression with the position of the scanner
   type, public :: scan_type
      !> The expression
      character(:), allocatable :: text
      !> Next character
      integer :: at = 1
      !> Nesting depth of parentheses, functions, signs and powers
      integer :: depth = 0
      !> First wrong character; 0 when all is well
      integer :: wrong_at = 0
      !> What is wrong, and what would be right
      character(:), allocatable :: wrong, right
   contains
      procedure :: expect
      procedure :: next
      procedure :: pass_blanks
      procedure :: fail_at
   end type scan_type

contains

   !> Step over a character that is required next
   subroutine expect(self, mark)
      class(scan_type), intent(inout) :: self
      !> The character
      character(1), intent(in) :: mark

      if (self%next() == mark) then
         self%at = self%at + 1
      else
         call self%fail_at(self%at, "a '"//mark//"' is missing here", "a "//mark)
      end if
   end subroutine expect

   !> Next character that is not blank; a blank at the end and after an error
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

   !> Record an error unless there is one already
   subroutine fail_at(self, at, wrong, right)
      class(scan_type), intent(inout) :: self
      !> The wrong character
      integer, intent(in) :: at
      !> What is wrong, and what would be right
      character(*), intent(in) :: wrong, right

      if (self%wrong_at > 0) return
      self%wrong_at = at
      self%wrong = wrong
      self%right = right
   end subroutine fail_at

end module plydyn_deck_scan
