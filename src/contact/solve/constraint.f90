!> Contact constraints of one step: which surface points press on the impactor, and which way.
!>
!> A row says that the gap, g + n.(u_impactor - sum_k N_k u_k), must not be negative. The rows are
!> the matrix G of the paper's eq. 18 taken along the normal n, one row per contact node instead of
!> three: the gap vector at the closest point has no other component, so nothing sticks.
!> The gap is linearised at the trial positions, once per step, as in the paper.
module plydyn_contact_solve_constraint
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: new_constraints, add_motion, opening

   !> Room for rows in the first allocation
   integer, parameter :: first_capacity = 64

   !> Rows as flat arrays, the row as the last index
   type, public :: constraints_type
      !> Rows in use
      integer :: count = 0
      !> Contact node or surface point that a row belongs to
      integer, allocatable :: source(:)
      !> Surface points of each row, (points of a row, rows)
      integer, allocatable :: point(:, :)
      !> Their weights N_k, (points of a row, rows)
      real(wp), allocatable :: weight(:, :)
      !> Unit normal from the plate towards the impactor, (3, rows)
      real(wp), allocatable :: normal(:, :)
      !> Gap of the trial positions, length
      real(wp), allocatable :: gap(:)
      !> Multiplier times the step squared, mass times length: a guess before, the solution after
      real(wp), allocatable :: push(:)
   contains
      procedure :: add
      procedure :: drop
   end type constraints_type

contains

   !> Make room for rows of so many points
   pure subroutine new_constraints(self, points)
      !> The rows
      type(constraints_type), intent(out) :: self
      !> Points of a row: 1, 4 or 9
      integer, intent(in) :: points

      call allocate_rows(self, points, first_capacity)
   end subroutine new_constraints

   !> Add a row whose points, weights, normal and gap the caller fills in
   pure subroutine add(self, source, push)
      !> The rows
      class(constraints_type), intent(inout) :: self
      !> Contact node or surface point that it belongs to
      integer, intent(in) :: source
      !> Guess of the solution, mass times length
      real(wp), intent(in) :: push

      if (self%count == size(self%source)) call enlarge(self)
      self%count = self%count + 1
      self%source(self%count) = source
      self%push(self%count) = push
   end subroutine add

   !> Leave a row out
   pure subroutine drop(self, row)
      !> The rows
      class(constraints_type), intent(inout) :: self
      !> Which
      integer, intent(in) :: row

      associate (last => self%count)
         self%source(row:last - 1) = self%source(row + 1:last)
         self%point(:, row:last - 1) = self%point(:, row + 1:last)
         self%weight(:, row:last - 1) = self%weight(:, row + 1:last)
         self%normal(:, row:last - 1) = self%normal(:, row + 1:last)
         self%gap(row:last - 1) = self%gap(row + 1:last)
         self%push(row:last - 1) = self%push(row + 1:last)
      end associate
      self%count = self%count - 1
   end subroutine drop

   !> Double the room for rows
   pure subroutine enlarge(self)
      !> The rows
      class(constraints_type), intent(inout) :: self

      type(constraints_type) :: larger

      call allocate_rows(larger, size(self%point, 1), 2*size(self%source))
      larger%count = self%count
      larger%source(:self%count) = self%source
      larger%point(:, :self%count) = self%point
      larger%weight(:, :self%count) = self%weight
      larger%normal(:, :self%count) = self%normal
      larger%gap(:self%count) = self%gap
      larger%push(:self%count) = self%push
      call move_alloc(larger%source, self%source)
      call move_alloc(larger%point, self%point)
      call move_alloc(larger%weight, self%weight)
      call move_alloc(larger%normal, self%normal)
      call move_alloc(larger%gap, self%gap)
      call move_alloc(larger%push, self%push)
   end subroutine enlarge

   !> Allocate rows
   pure subroutine allocate_rows(self, points, capacity)
      !> The rows
      type(constraints_type), intent(inout) :: self
      !> Points of a row
      integer, intent(in) :: points
      !> Number of rows
      integer, intent(in) :: capacity

      allocate (self%source(capacity), source=0)
      allocate (self%point(points, capacity), source=0)
      allocate (self%weight(points, capacity), source=0.0_wp)
      allocate (self%normal(3, capacity), source=0.0_wp)
      allocate (self%gap(capacity), self%push(capacity), source=0.0_wp)
   end subroutine allocate_rows

   !> Add what a push at one row moves: the paper's eq. 17
   pure subroutine add_motion(rows, row, push, inverse_mass, impactor_inverse, motion, &
      & impactor_motion)
      !> The constraints
      type(constraints_type), intent(in) :: rows
      !> Which row
      integer, intent(in) :: row
      !> Multiplier times the step squared, mass times length
      real(wp), intent(in) :: push
      !> Of the surface points along x, y, z, (3, points), zero where held
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      !> Of the impactor along x, y, z, zero where held
      real(wp), intent(in) :: impactor_inverse(3)
      !> Of the surface points, (3, points), length
      real(wp), contiguous, intent(inout) :: motion(:, :)
      !> Of the impactor, length
      real(wp), intent(inout) :: impactor_motion(3)

      integer :: i, k
      real(wp) :: force(3)

      force(:) = push*rows%normal(:, row)
      do i = 1, size(rows%point, 1)
         k = rows%point(i, row)
         motion(:3, k) = motion(:3, k) - rows%weight(i, row)*inverse_mass(:3, k)*force
      end do
      impactor_motion(:) = impactor_motion + impactor_inverse*force
   end subroutine add_motion

   !> How much a motion opens the gap of a row, length
   pure real(wp) function opening(rows, row, motion, impactor_motion)
      !> The constraints
      type(constraints_type), intent(in) :: rows
      !> Which row
      integer, intent(in) :: row
      !> Of the surface points, (3, points), length
      real(wp), contiguous, intent(in) :: motion(:, :)
      !> Of the impactor, length
      real(wp), intent(in) :: impactor_motion(3)

      integer :: i, k
      real(wp) :: relative(3)

      relative(:) = impactor_motion
      do i = 1, size(rows%point, 1)
         k = rows%point(i, row)
         relative(:) = relative - rows%weight(i, row)*motion(:3, k)
      end do
      opening = relative(1)*rows%normal(1, row) + relative(2)*rows%normal(2, row) &
         & + relative(3)*rows%normal(3, row)
   end function opening

end module plydyn_contact_solve_constraint
