!> Keeps a state in memory, by the names of its arrays.
module state_memory
   use plydyn_base_precision, only : wp
   use plydyn_state_exchange, only : exchange_type
   implicit none
   private

   !> A named array
   type :: array_type
      character(:), allocatable :: name
      real(wp), allocatable :: real(:)
      integer, allocatable :: integer(:)
   end type array_type

   !> Keeps arrays in memory
   type, public, extends(exchange_type) :: memory_type
      !> Gives what it has, or takes
      logical :: reads = .false.
      !> What it has
      type(array_type), allocatable :: arrays(:)
   contains
      procedure :: reals
      procedure :: integers
      procedure :: index_of
   end type memory_type

contains

   !> Take or give an array of reals
   subroutine reals(self, name, values)
      class(memory_type), intent(inout) :: self
      character(*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: values(:)

      if (self%reads) then
         values = self%arrays(self%index_of(name))%real
      else
         self%arrays = [self%arrays, array_type(name, values, [integer ::])]
      end if
   end subroutine reals

   !> Take or give an array of integers
   subroutine integers(self, name, values)
      class(memory_type), intent(inout) :: self
      character(*), intent(in) :: name
      integer, allocatable, intent(inout) :: values(:)

      if (self%reads) then
         values = self%arrays(self%index_of(name))%integer
      else
         self%arrays = [self%arrays, array_type(name, [real(wp) ::], values)]
      end if
   end subroutine integers

   !> Where the array of a name is
   pure integer function index_of(self, name)
      class(memory_type), intent(in) :: self
      character(*), intent(in) :: name

      do index_of = 1, size(self%arrays)
         if (self%arrays(index_of)%name == name) return
      end do
   end function index_of

end module state_memory
