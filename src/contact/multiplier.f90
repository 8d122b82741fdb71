!> Forward increment Lagrange multipliers with release: the paper's eqs 16 and 17, never pulling.
!>
!> With p the multipliers times the step squared, g the gaps of the trial positions and A the
!> matrix G M^-1 G^T, the problem is: p >= 0, g + A p >= 0, and one of the two zero in every row.
!>
!> Several contact nodes on one facet make A singular. The active set takes rows in one by one, the
!> one that penetrates most first, and drops those that would pull (Lawson and Hanson's method for
!> non-negative least squares, finite and deterministic); a redundant row never enters because
!> the others have opened its gap already. A is made definite by raising its diagonal by `ridge`,
!> which leaves a penetration of that share of the step's. The motion is unique; the multipliers
!> are not when rows are redundant. The set of the last step is the first guess of the next.
module plydyn_contact_multiplier
   use plydyn_base_precision, only : wp
   use plydyn_contact_constraint, only : add_motion, clear_motion, constraints_type, opening
   use plydyn_contact_factor, only : factor_type
   implicit none
   private

   public :: new_active_set

   !> Share by which the diagonal of A is raised
   real(wp), parameter :: ridge = 1.0e-13_wp

   !> Penetration that is taken for none, as a share of the largest one before
   real(wp), parameter :: tolerance = 1.0e-11_wp

   !> Rows taken in per row of the problem before giving up
   integer, parameter :: most_entries = 3

   !> The rows that press, and the workspace of the method
   type, public :: active_set_type
      !> Rows that press, in the order of the factor
      integer, allocatable, private :: row(:)
      !> Whether a row presses
      logical, allocatable, private :: presses(:)
      !> Rows that nothing can open
      logical, allocatable, private :: hopeless(:)
      !> Solution with all pressing rows closed, mass times length
      real(wp), allocatable, private :: closed(:)
      !> What a unit push at one row moves, (3, points), zero between calls
      real(wp), allocatable, private :: unit_motion(:, :)
      !> A among the pressing rows
      type(factor_type), private :: factor
   contains
      procedure :: solve_unilateral
   end type active_set_type

contains

   !> Make the workspace for a surface
   pure subroutine new_active_set(self, points)
      !> The active set
      type(active_set_type), intent(out) :: self
      !> Number of surface points
      integer, intent(in) :: points

      allocate (self%unit_motion(3, points), source=0.0_wp)
      allocate (self%row(0), self%presses(0), self%hopeless(0), self%closed(0))
   end subroutine new_active_set

   !> Find the pushes and the motion that they make
   pure subroutine solve_unilateral(self, rows, inverse_mass, impactor_inverse, motion, &
      & impactor_motion)
      !> The active set
      class(active_set_type), intent(inout) :: self
      !> The constraints, with a guess of the pushes; the pushes out
      type(constraints_type), intent(inout) :: rows
      !> Of the surface points along x, y, z, (3, points), zero where held
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      !> Of the impactor along x, y, z, zero where held
      real(wp), intent(in) :: impactor_inverse(3)
      !> Of the surface points, (3, points), length; zero in
      real(wp), contiguous, intent(inout) :: motion(:, :)
      !> Of the impactor, length
      real(wp), intent(out) :: impactor_motion(3)

      integer :: entry_count, row, newest
      real(wp) :: least_gap

      call start(self, rows, inverse_mass, impactor_inverse)
      least_gap = tolerance*minval(rows%gap(:rows%count))
      newest = 0
      do entry_count = 0, most_entries*rows%count
         call settle(self, rows, newest)
         call clear_motion(rows, 1, rows%count, motion, impactor_motion)
         do row = 1, self%factor%count
            call add_motion(rows, self%row(row), rows%push(self%row(row)), inverse_mass, &
               & impactor_inverse, motion, impactor_motion)
         end do
         newest = deepest(self, rows, motion, impactor_motion, least_gap)
         if (newest == 0) return
         call enter(self, rows, newest, inverse_mass, impactor_inverse)
      end do
   end subroutine solve_unilateral

   !> Start with the rows whose guess presses
   pure subroutine start(self, rows, inverse_mass, impactor_inverse)
      !> The active set
      class(active_set_type), intent(inout) :: self
      !> The constraints, with a guess of the pushes
      type(constraints_type), intent(inout) :: rows
      !> Of the surface points
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      !> Of the impactor
      real(wp), intent(in) :: impactor_inverse(3)

      integer :: row

      if (size(self%row) < rows%count) then
         deallocate (self%row, self%presses, self%hopeless, self%closed)
         allocate (self%row(size(rows%gap)), source=0)
         allocate (self%presses(size(rows%gap)), self%hopeless(size(rows%gap)), source=.false.)
         allocate (self%closed(size(rows%gap)), source=0.0_wp)
      end if
      self%presses(:rows%count) = .false.
      self%hopeless(:rows%count) = .false.
      self%factor%count = 0
      do row = 1, rows%count
         if (rows%push(row) > 0.0_wp) call enter(self, rows, row, inverse_mass, impactor_inverse)
      end do
   end subroutine start

   !> Let a row press
   pure subroutine enter(self, rows, row, inverse_mass, impactor_inverse)
      !> The active set
      class(active_set_type), intent(inout) :: self
      !> The constraints
      type(constraints_type), intent(inout) :: rows
      !> Which row
      integer, intent(in) :: row
      !> Of the surface points
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      !> Of the impactor
      real(wp), intent(in) :: impactor_inverse(3)

      integer :: i, n
      real(wp) :: column(self%factor%count), diagonal, impactor_motion(3)

      n = self%factor%count
      impactor_motion(:) = 0.0_wp
      call add_motion(rows, row, 1.0_wp, inverse_mass, impactor_inverse, self%unit_motion, &
         & impactor_motion)
      diagonal = opening(rows, row, self%unit_motion, impactor_motion)
      do i = 1, n
         column(i) = opening(rows, self%row(i), self%unit_motion, impactor_motion)
      end do
      call clear_motion(rows, row, row, self%unit_motion, impactor_motion)
      if (diagonal > 0.0_wp) then
         call self%factor%append(column, (1.0_wp + ridge)*diagonal, ridge*diagonal)
         self%row(n + 1) = row
         self%presses(row) = .true.
      else
         self%hopeless(row) = .true.
         rows%push(row) = 0.0_wp
      end if
   end subroutine enter

   !> Close the gaps of the pressing rows; on the way, drop those that would pull
   pure subroutine settle(self, rows, newest)
      !> The active set
      class(active_set_type), intent(inout) :: self
      !> The constraints, pushes in and out
      type(constraints_type), intent(inout) :: rows
      !> Row that has just entered, 0 for none; if it would pull at once, it is given up
      integer, intent(in) :: newest

      integer :: i, leaving, n, row
      real(wp) :: share, share_here

      do
         n = self%factor%count
         self%closed(:n) = -rows%gap(self%row(:n))
         call self%factor%solve(self%closed(:n))
         leaving = 0
         share = 1.0_wp
         do i = 1, n
            if (self%closed(i) > 0.0_wp) cycle
            row = self%row(i)
            share_here = rows%push(row)/max(rows%push(row) - self%closed(i), tiny(1.0_wp))
            if (leaving > 0 .and. share_here >= share) cycle
            share = share_here
            leaving = i
         end do
         do i = 1, n
            row = self%row(i)
            rows%push(row) = rows%push(row) + share*(self%closed(i) - rows%push(row))
         end do
         if (leaving == 0) return
         self%hopeless(self%row(leaving)) = self%row(leaving) == newest .and. share <= 0.0_wp
         call leave(self, rows, leaving)
      end do
   end subroutine settle

   !> Let a row press no longer
   pure subroutine leave(self, rows, leaving)
      !> The active set
      class(active_set_type), intent(inout) :: self
      !> The constraints
      type(constraints_type), intent(inout) :: rows
      !> Its place in the order of the factor
      integer, intent(in) :: leaving

      integer :: n

      n = self%factor%count
      rows%push(self%row(leaving)) = 0.0_wp
      self%presses(self%row(leaving)) = .false.
      call self%factor%remove(leaving)
      self%row(leaving:n - 1) = self%row(leaving + 1:n)
   end subroutine leave

   !> Row that penetrates most among those that do not press, 0 when none does
   pure integer function deepest(self, rows, motion, impactor_motion, least_gap)
      !> The active set
      class(active_set_type), intent(in) :: self
      !> The constraints
      type(constraints_type), intent(in) :: rows
      !> Of the surface points
      real(wp), contiguous, intent(in) :: motion(:, :)
      !> Of the impactor
      real(wp), intent(in) :: impactor_motion(3)
      !> Gap that counts as closed
      real(wp), intent(in) :: least_gap

      integer :: row
      real(wp) :: gap, least

      deepest = 0
      least = least_gap
      do row = 1, rows%count
         if (self%presses(row) .or. self%hopeless(row)) cycle
         gap = rows%gap(row) + opening(rows, row, motion, impactor_motion)
         if (gap < least) then
            least = gap
            deepest = row
         end if
      end do
   end function deepest

end module plydyn_contact_multiplier
