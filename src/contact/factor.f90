!> Cholesky factor of a symmetric matrix that grows and shrinks by a row at a time.
!>
!> LAPACK factorises once; an active set adds and drops constraints one by one, and a factor that
!> follows costs the square of the size instead of its cube. No threads, so the same bits always.
module plydyn_contact_factor
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> Size of the first allocation
   integer, parameter :: first_capacity = 32

   !> Factor L of a matrix L L^T
   type, public :: factor_type
      !> Rows of the matrix
      integer :: count = 0
      !> Lower triangle, larger than needed
      real(wp), allocatable, private :: lower(:, :)
      !> Inverse of each entry of its diagonal
      real(wp), allocatable, private :: inverse(:)
   contains
      procedure :: append
      procedure :: remove
      procedure :: solve
   end type factor_type

contains

   !> Add a last row to the matrix
   pure subroutine append(self, column, diagonal, least_pivot)
      !> The factor
      class(factor_type), intent(inout) :: self
      !> The new row left of the diagonal
      real(wp), intent(in) :: column(self%count)
      !> The new diagonal entry
      real(wp), intent(in) :: diagonal
      !> Smallest pivot, taken instead of one that round-off has spoilt
      real(wp), intent(in) :: least_pivot

      real(wp) :: row(self%count)
      integer :: n

      call grow(self)
      n = self%count
      row(:) = column
      call solve_lower(self, row)
      self%lower(n + 1, :n) = row
      self%lower(n + 1, n + 1) = sqrt(max(diagonal - sum(row**2), least_pivot))
      self%inverse(n + 1) = 1.0_wp/self%lower(n + 1, n + 1)
      self%count = n + 1
   end subroutine append

   !> Take a row and its column out of the matrix
   pure subroutine remove(self, row)
      !> The factor
      class(factor_type), intent(inout) :: self
      !> Which
      integer, intent(in) :: row

      integer :: i, j, n
      real(wp) :: cosine, length, old, sine

      n = self%count - 1
      do j = 1, n + 1
         do i = max(row, j - 1), n
            self%lower(i, j) = self%lower(i + 1, j)
         end do
      end do
      ! each row below now has an entry right of the diagonal: rotate it away
      do j = row, n
         length = hypot(self%lower(j, j), self%lower(j, j + 1))
         cosine = self%lower(j, j)/length
         sine = self%lower(j, j + 1)/length
         do i = j, n
            old = self%lower(i, j)
            self%lower(i, j) = cosine*old + sine*self%lower(i, j + 1)
            self%lower(i, j + 1) = cosine*self%lower(i, j + 1) - sine*old
         end do
         self%inverse(j) = 1.0_wp/self%lower(j, j)
      end do
      self%count = n
   end subroutine remove

   !> Solve with the whole matrix
   pure subroutine solve(self, vector)
      !> The factor
      class(factor_type), intent(in) :: self
      !> Right-hand side in, solution out
      real(wp), intent(inout) :: vector(self%count)

      integer :: i, j
      real(wp) :: total

      call solve_lower(self, vector)
      do j = self%count, 1, -1
         total = vector(j)
         !$omp simd reduction(-:total)
         do i = j + 1, self%count
            total = total - self%lower(i, j)*vector(i)
         end do
         vector(j) = total*self%inverse(j)
      end do
   end subroutine solve

   !> Solve with the lower triangle
   pure subroutine solve_lower(self, vector)
      !> The factor
      type(factor_type), intent(in) :: self
      !> Right-hand side in, solution out
      real(wp), intent(inout) :: vector(self%count)

      integer :: i, j

      do j = 1, self%count
         vector(j) = vector(j)*self%inverse(j)
         do i = j + 1, self%count
            vector(i) = vector(i) - self%lower(i, j)*vector(j)
         end do
      end do
   end subroutine solve_lower

   !> Make room for one more row
   pure subroutine grow(self)
      !> The factor
      type(factor_type), intent(inout) :: self

      real(wp), allocatable :: larger(:, :), longer(:)
      integer :: capacity

      if (.not. allocated(self%lower)) then
         allocate (self%lower(first_capacity, first_capacity), source=0.0_wp)
         allocate (self%inverse(first_capacity), source=0.0_wp)
      end if
      if (self%count < size(self%lower, 1)) return
      capacity = 2*size(self%lower, 1)
      allocate (larger(capacity, capacity), longer(capacity), source=0.0_wp)
      larger(:self%count, :self%count) = self%lower
      longer(:self%count) = self%inverse
      call move_alloc(larger, self%lower)
      call move_alloc(longer, self%inverse)
   end subroutine grow

end module plydyn_contact_factor
