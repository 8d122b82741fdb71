!> Coupling of contact rows: columns of A = G M^-1 G^T, the gap changes by a unit multiplier.
!>
!> Rows lie in the lanes of vectors. A multiplier moves only the points of one facet, so a column is
!> a sum of as many vectors as a facet has points.
module plydyn_contact_solve_coupling
   use plydyn_base_precision, only : lanes, wp
   use plydyn_contact_solve_constraint, only : constraints_type
   implicit none
   private

   public :: new_coupling

   !> Weights of all rows at the points of any row, ordered by point
   type, public :: coupling_type
      !> Number of rows, padded to whole vectors
      integer :: rows = 0
      !> Local index of the points of each row, (points of a row, rows)
      integer, allocatable, private :: local_index(:, :)
      !> Displacement of its points by a unit multiplier of a row, (3, points of a row, rows)
      real(wp), allocatable, private :: displacement(:, :, :)
      !> Weight of each local point in each row, (rows, local points), and the normals, (rows, 3):
      !> one-dimensional, as the number of rows changes in every step
      real(wp), allocatable, private :: weight(:), normal(:)
      !> Local index of each surface point; zero between calls
      integer, allocatable, private :: index_of(:)
   contains
      procedure :: set_rows
      procedure :: find_column
   end type coupling_type

contains

   !> A coupling without rows
   pure subroutine new_coupling(self, points)
      !> The coupling
      type(coupling_type), intent(out) :: self
      !> Number of surface points
      integer, intent(in) :: points

      allocate (self%index_of(points), source=0)
      allocate (self%local_index(0, 0), self%displacement(0, 0, 0), self%weight(0), self%normal(0))
   end subroutine new_coupling

   !> Set the rows of a step
   pure subroutine set_rows(self, rows, inverse_mass)
      !> The coupling
      class(coupling_type), intent(inout) :: self
      !> The constraints
      type(constraints_type), intent(in) :: rows
      !> Inverse mass of the surface points along x, y, z, (3, points), zero where held
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)

      integer :: i, touched, row

      call reserve(self, size(rows%point, 1), size(rows%gap))
      call number_points(self, rows, touched)
      self%rows = lanes*((rows%count + lanes - 1)/lanes)
      if (size(self%weight) < self%rows*touched) then
         deallocate (self%weight)
         allocate (self%weight(2*self%rows*touched))
      end if
      self%weight(:self%rows*touched) = 0.0_wp
      self%normal(:3*self%rows) = 0.0_wp
      do row = 1, rows%count
         self%normal(row:3*self%rows:self%rows) = rows%normal(:, row)
         do i = 1, size(rows%point, 1)
            self%weight(self%rows*(self%local_index(i, row) - 1) + row) = rows%weight(i, row)
            self%displacement(:, i, row) = rows%weight(i, row) &
               & *inverse_mass(:3, rows%point(i, row))*rows%normal(:, row)
         end do
      end do
   end subroutine set_rows

   !> Number the points of all rows
   pure subroutine number_points(self, rows, touched)
      type(coupling_type), intent(inout) :: self
      type(constraints_type), intent(in) :: rows
      !> Number of local points
      integer, intent(out) :: touched

      integer :: i, row

      touched = 0
      do row = 1, rows%count
         do i = 1, size(rows%point, 1)
            associate (local_index => self%index_of(rows%point(i, row)))
               if (local_index == 0) then
                  touched = touched + 1
                  local_index = touched
               end if
               self%local_index(i, row) = local_index
            end associate
         end do
      end do
      do row = 1, rows%count
         self%index_of(rows%point(:, row)) = 0
      end do
   end subroutine number_points

   !> Gap change of every row by a unit multiplier of one row, one over mass; zero in padding
   pure subroutine find_column(self, rows, row, impactor_inverse, column)
      !> The coupling
      class(coupling_type), intent(in) :: self
      !> The constraints
      type(constraints_type), intent(in) :: rows
      !> Row of the multiplier
      integer, intent(in) :: row
      !> Inverse mass of the impactor along x, y, z, zero where held
      real(wp), intent(in) :: impactor_inverse(3)
      !> Column of A, (rows)
      real(wp), intent(out) :: column(self%rows)

      call find_gap_changes(self%rows, size(rows%point, 1), self%local_index(:, row), &
         & self%displacement(:, :, row), impactor_inverse*rows%normal(:, row), self%weight, &
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
   pure subroutine reserve(self, points, capacity)
      type(coupling_type), intent(inout) :: self
      !> Points of a row, and rows
      integer, intent(in) :: points, capacity

      if (size(self%local_index, 2) >= capacity) return
      deallocate (self%local_index, self%displacement, self%normal)
      allocate (self%local_index(points, capacity), source=0)
      allocate (self%displacement(3, points, capacity), self%normal(3*(capacity + lanes)), &
         & source=0.0_wp)
   end subroutine reserve

end module plydyn_contact_solve_coupling
