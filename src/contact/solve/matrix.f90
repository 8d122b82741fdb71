!> Matrix of contact rows: columns of A = G M^-1 G^T, the gap changes by a unit multiplier, and the
!> Cholesky factor of the rows that are active.
!>
!> Rows lie in the lanes of vectors. A multiplier moves only the points of one facet, so a column is
!> a sum of as many vectors as a facet has points.
!>
!> An active-set method adds and removes constraints one by one. An update of the factor costs the
!> square of its size, a new factorisation (as by LAPACK) its cube. The set of the last step is
!> factorised at once, eight rows in a vector, and without threads: the same bits in every run.
module plydyn_contact_solve_matrix
   use plydyn_base_precision, only : lanes, wp
   use plydyn_contact_solve_constraint, only : constraints_type, correction_type
   implicit none
   private

   !> Weights of all rows at the points of any row, ordered by point
   type, public :: coupling_type
      !> Number of rows, padded to whole vectors
      integer :: rows = 0
      !> Local index of the points of each row: place in the list of the correction,
      !> (points of a row, rows)
      integer, allocatable, private :: local_index(:, :)
      !> Displacement of its points by a unit multiplier of a row, (3, points of a row, rows)
      real(wp), allocatable, private :: displacement(:, :, :)
      !> Weight of each local point in each row, (rows, local points), and the normals, (rows, 3):
      !> one-dimensional, as the number of rows changes in every step
      real(wp), allocatable, private :: weight(:), normal(:)
   contains
      procedure :: set_rows
      procedure :: find_column
   end type coupling_type

   !> Size of the first allocation, of whole vectors
   integer, parameter :: first_capacity = 4*lanes

   !> Factor L of a matrix L L^T
   type, public :: cholesky_factor_type
      !> Rows of the matrix
      integer :: count = 0
      !> Lower triangle, with spare rows and columns
      real(wp), allocatable, private :: lower(:, :)
      !> Inverse of each entry of its diagonal
      real(wp), allocatable, private :: inverse(:)
   contains
      procedure :: fill
      procedure :: append
      procedure :: remove
      procedure :: solve
   end type cholesky_factor_type

contains

   !> Set the rows of a step
   pure subroutine set_rows(self, rows, inverse_mass, correction)
      class(coupling_type), intent(inout) :: self
      type(constraints_type), intent(in) :: rows
      !> Inverse mass of the surface points along x, y, z, (3, points), zero where held
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      !> Has the points of the rows
      type(correction_type), intent(in) :: correction

      integer :: i, row

      call reserve_rows(self, size(rows%point, 1), size(rows%gap))
      self%rows = lanes*((rows%count + lanes - 1)/lanes)
      associate (entries => self%rows*correction%count)
         if (size(self%weight) < entries) then
            deallocate (self%weight)
            allocate (self%weight(2*entries))
         end if
         self%weight(:entries) = 0.0_wp
      end associate
      self%normal(:3*self%rows) = 0.0_wp
      do row = 1, rows%count
         self%local_index(:, row) = correction%place(rows%point(:, row))
         self%normal(row:3*self%rows:self%rows) = rows%normal(:, row)
         do i = 1, size(rows%point, 1)
            self%weight(self%rows*(self%local_index(i, row) - 1) + row) = rows%weight(i, row)
            self%displacement(:, i, row) = rows%weight(i, row) &
               & *inverse_mass(:3, rows%point(i, row))*rows%normal(:, row)
         end do
      end do
   end subroutine set_rows

   !> Gap change of every row by a unit multiplier of one row, one over mass; zero in padding
   pure subroutine find_column(self, rows, row, column)
      class(coupling_type), intent(in) :: self
      type(constraints_type), intent(in) :: rows
      !> Row of the multiplier
      integer, intent(in) :: row
      !> Column of A, (rows)
      real(wp), intent(out) :: column(self%rows)

      call find_gap_changes(self%rows, size(rows%point, 1), self%local_index(:, row), &
         & self%displacement(:, :, row), rows%impactor_inverse*rows%normal(:, row), self%weight, &
         & self%normal, column)
   end subroutine find_column

   !> Gap change of every row by displacements of the impactor and, away from it, of points
   pure subroutine find_gap_changes(rows, points, local_index, displacement, impactor_correction, &
      & weight, normal, gap_change)
      integer, intent(in) :: rows, points
      !> Local indices of the points
      integer, intent(in) :: local_index(points)
      !> Displacements of points and impactor
      real(wp), intent(in) :: displacement(3, points), impactor_correction(3)
      real(wp), intent(in) :: weight(rows, *), normal(rows, 3)
      real(wp), intent(out) :: gap_change(rows)

      real(wp), dimension(lanes) :: x, y, z
      integer :: first, i, l

      do first = 0, rows - lanes, lanes
         x(:) = impactor_correction(1)
         y(:) = impactor_correction(2)
         z(:) = impactor_correction(3)
         do i = 1, points
            !$omp simd
            do l = 1, lanes
               x(l) = x(l) + displacement(1, i)*weight(first + l, local_index(i))
               y(l) = y(l) + displacement(2, i)*weight(first + l, local_index(i))
               z(l) = z(l) + displacement(3, i)*weight(first + l, local_index(i))
            end do
         end do
         !$omp simd
         do l = 1, lanes
            gap_change(first + l) = x(l)*normal(first + l, 1) + y(l)*normal(first + l, 2) &
               & + z(l)*normal(first + l, 3)
         end do
      end do
   end subroutine find_gap_changes

   !> Allocate as many rows as the constraints have
   pure subroutine reserve_rows(self, points, capacity)
      type(coupling_type), intent(inout) :: self
      !> Points of a row, and rows
      integer, intent(in) :: points, capacity

      if (allocated(self%local_index)) then
         if (size(self%local_index, 2) >= capacity) return
         deallocate (self%local_index, self%displacement, self%normal, self%weight)
      end if
      allocate (self%weight(0))
      allocate (self%local_index(points, capacity), source=0)
      allocate (self%displacement(3, points, capacity), self%normal(3*(capacity + lanes)), &
         & source=0.0_wp)
   end subroutine reserve_rows

   !> Factorise some rows and columns of a matrix
   pure subroutine fill(self, row, matrix, ridge)
      class(cholesky_factor_type), intent(inout) :: self
      !> Rows and columns, in the order of the factor
      integer, intent(in) :: row(:)
      !> The matrix, symmetric; entries above the diagonal in the order of the rows are not read
      real(wp), contiguous, intent(in) :: matrix(:, :)
      !> Relative increase of its diagonal, and smallest relative pivot
      real(wp), intent(in) :: ridge

      real(wp) :: diagonal(size(row))
      integer :: i, j

      self%count = size(row)
      call reserve(self, self%count)
      do j = 1, self%count
         diagonal(j) = matrix(row(j), row(j))
         do i = j + 1, self%count
            self%lower(i, j) = matrix(row(i), row(j))
         end do
      end do
      call factorise(size(self%inverse), self%count, diagonal, ridge, self%lower, self%inverse)
   end subroutine fill

   !> Columns of the factor from left to right, vectors of rows below the diagonal at a time
   pure subroutine factorise(capacity, count, diagonal, ridge, lower, inverse)
      !> Allocated rows, and rows in use
      integer, intent(in) :: capacity, count
      !> As in `fill`
      real(wp), intent(in) :: diagonal(count), ridge
      !> The matrix below the diagonal in, the factor out
      real(wp), intent(inout) :: lower(capacity, capacity)
      !> Inverse of its diagonal
      real(wp), intent(inout) :: inverse(capacity)

      real(wp) :: below(capacity), row(count), pivot
      integer :: first, j

      below(:count) = 1.0_wp
      below(count + 1:) = 0.0_wp
      do j = 1, count
         below(j) = 0.0_wp
         row(:j - 1) = lower(j, :j - 1)
         pivot = (1.0_wp + ridge)*diagonal(j) - sum(row(:j - 1)**2)
         pivot = sqrt(max(pivot, ridge*diagonal(j)))
         inverse(j) = 1.0_wp/pivot
         do first = 1 + lanes*(j/lanes), count, lanes
            call reduce(capacity, j, row, inverse(j), below(first), lower(first, 1))
         end do
         lower(j, j) = pivot
      end do
   end subroutine factorise

   !> One column of the factor in some rows
   pure subroutine reduce(capacity, column, row, inverse, below, lower)
      integer, intent(in) :: capacity, column
      !> Row of the diagonal, left of it, and the inverse of the diagonal
      real(wp), intent(in) :: row(column), inverse
      !> 1 in rows below the diagonal, else 0
      real(wp), intent(in) :: below(lanes)
      real(wp), intent(inout) :: lower(capacity, column)

      real(wp) :: total(lanes)
      integer :: k, l

      total(:) = lower(:lanes, column)
      do k = 1, column - 1
         !$omp simd
         do l = 1, lanes
            total(l) = total(l) - lower(l, k)*row(k)
         end do
      end do
      !$omp simd
      do l = 1, lanes
         lower(l, column) = total(l)*inverse*below(l)
      end do
   end subroutine reduce

   !> Append a row and a column to the matrix
   pure subroutine append(self, column, diagonal, least_pivot)
      class(cholesky_factor_type), intent(inout) :: self
      !> The new row left of the diagonal
      real(wp), intent(in) :: column(self%count)
      !> The new diagonal entry
      real(wp), intent(in) :: diagonal
      !> Smallest pivot: replaces one that round-off makes smaller
      real(wp), intent(in) :: least_pivot

      real(wp) :: row(self%count)
      integer :: n

      n = self%count
      call reserve(self, n + 1)
      row(:) = column
      call solve_lower(self, row)
      self%lower(n + 1, :n) = row
      self%lower(n + 1, n + 1) = sqrt(max(diagonal - sum(row**2), least_pivot))
      self%inverse(n + 1) = 1.0_wp/self%lower(n + 1, n + 1)
      self%count = n + 1
   end subroutine append

   !> Remove a row and its column from the matrix (Givens rotations)
   pure subroutine remove(self, row)
      class(cholesky_factor_type), intent(inout) :: self
      !> Its index in the order of the factor
      integer, intent(in) :: row

      integer :: i, j, n
      real(wp) :: cosine, length, old, sine

      n = self%count - 1
      do j = 1, n + 1
         do i = max(row, j - 1), n
            self%lower(i, j) = self%lower(i + 1, j)
         end do
      end do
      ! rotations remove the entry right of the diagonal of each row below
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
      class(cholesky_factor_type), intent(in) :: self
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
      type(cholesky_factor_type), intent(in) :: self
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

   !> Allocate room for some rows
   pure subroutine reserve(self, rows)
      type(cholesky_factor_type), intent(inout) :: self
      !> Number of rows
      integer, intent(in) :: rows

      real(wp), allocatable :: larger(:, :), longer(:)
      integer :: capacity, known

      known = 0
      if (allocated(self%inverse)) known = size(self%inverse)
      if (known > 0 .and. rows <= known) return
      capacity = max(known, first_capacity)
      do while (capacity < rows)
         capacity = 2*capacity
      end do
      allocate (larger(capacity, capacity), longer(capacity), source=0.0_wp)
      if (known > 0) then
         larger(:known, :known) = self%lower
         longer(:known) = self%inverse
      end if
      call move_alloc(larger, self%lower)
      call move_alloc(longer, self%inverse)
   end subroutine reserve

end module plydyn_contact_solve_matrix
