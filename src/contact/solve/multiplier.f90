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
module plydyn_contact_solve_multiplier
   use plydyn_base_precision, only : lanes, wp
   use plydyn_contact_solve_constraint, only : add_motion, constraints_type
   use plydyn_contact_solve_coupling, only : coupling_type, new_coupling
   use plydyn_contact_solve_cholesky_factor, only : cholesky_factor_type
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
      !> Gaps with the pushes, one for each row
      real(wp), allocatable, private :: gap(:)
      !> What makes the columns of A, and those of rows that have pressed in the step, each in the
      !> place of its row
      type(coupling_type), private :: coupling
      real(wp), allocatable, private :: matrix(:, :)
      !> A among the pressing rows
      type(cholesky_factor_type), private :: factor
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

      call new_coupling(self%coupling, points)
      allocate (self%row(0), self%presses(0), self%hopeless(0), self%closed(0), self%gap(0))
      allocate (self%matrix(0, 0))
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
         call find_gaps(self, rows)
         newest = deepest(self, rows%count, least_gap)
         if (newest == 0) exit
         call enter(self, rows, newest, impactor_inverse)
      end do
      impactor_motion(:) = 0.0_wp
      do row = 1, self%factor%count
         call add_motion(rows, self%row(row), rows%push(self%row(row)), inverse_mass, &
            & impactor_inverse, motion, impactor_motion)
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

      integer :: n, row

      call make_room(self, size(rows%gap))
      call self%coupling%take(rows, inverse_mass)
      self%presses(:rows%count) = .false.
      self%hopeless(:rows%count) = .false.
      n = 0
      do row = 1, rows%count
         if (.not. rows%push(row) > 0.0_wp) cycle
         call prepare(self, rows, row, impactor_inverse)
         if (self%hopeless(row)) cycle
         n = n + 1
         self%row(n) = row
         self%presses(row) = .true.
      end do
      call self%factor%fill(self%row(:n), self%matrix, ridge)
   end subroutine start

   !> Make room for as many rows as the constraints have room for
   pure subroutine make_room(self, capacity)
      type(active_set_type), intent(inout) :: self
      !> Rows
      integer, intent(in) :: capacity

      integer :: whole

      if (size(self%row) >= capacity) return
      whole = lanes*((capacity + lanes - 1)/lanes)
      deallocate (self%row, self%presses, self%hopeless, self%closed, self%gap, self%matrix)
      allocate (self%row(capacity), source=0)
      allocate (self%presses(capacity), self%hopeless(capacity), source=.false.)
      allocate (self%closed(capacity), self%gap(whole), self%matrix(whole, capacity), &
         & source=0.0_wp)
   end subroutine make_room

   !> Find the column of A of a row that is to press, or that nothing can open it
   pure subroutine prepare(self, rows, row, impactor_inverse)
      type(active_set_type), intent(inout) :: self
      type(constraints_type), intent(inout) :: rows
      integer, intent(in) :: row
      real(wp), intent(in) :: impactor_inverse(3)

      call self%coupling%find_column(rows, row, impactor_inverse, &
         & self%matrix(:self%coupling%rows, row))
      if (self%matrix(row, row) > 0.0_wp) return
      self%hopeless(row) = .true.
      rows%push(row) = 0.0_wp
   end subroutine prepare

   !> Let a row press
   pure subroutine enter(self, rows, row, impactor_inverse)
      !> The active set
      class(active_set_type), intent(inout) :: self
      !> The constraints
      type(constraints_type), intent(inout) :: rows
      !> Which row
      integer, intent(in) :: row
      !> Of the impactor
      real(wp), intent(in) :: impactor_inverse(3)

      integer :: n

      n = self%factor%count
      call prepare(self, rows, row, impactor_inverse)
      if (self%hopeless(row)) return
      associate (column => self%matrix(:, row))
         call self%factor%append(column(self%row(:n)), (1.0_wp + ridge)*column(row), &
            & ridge*column(row))
      end associate
      self%row(n + 1) = row
      self%presses(row) = .true.
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

   !> Gaps of all rows with the pushes
   pure subroutine find_gaps(self, rows)
      type(active_set_type), intent(inout) :: self
      type(constraints_type), intent(in) :: rows

      integer :: i, k, row

      self%gap(:rows%count) = rows%gap(:rows%count)
      do i = 1, self%factor%count
         row = self%row(i)
         !$omp simd
         do k = 1, self%coupling%rows
            self%gap(k) = self%gap(k) + self%matrix(k, row)*rows%push(row)
         end do
      end do
   end subroutine find_gaps

   !> Row that penetrates most among those that do not press, 0 when none does
   pure integer function deepest(self, rows, least_gap)
      !> The active set, with gaps
      class(active_set_type), intent(in) :: self
      !> How many rows
      integer, intent(in) :: rows
      !> Gap that counts as closed
      real(wp), intent(in) :: least_gap

      integer :: row
      real(wp) :: least

      deepest = 0
      least = least_gap
      do row = 1, rows
         if (self%presses(row) .or. self%hopeless(row)) cycle
         if (self%gap(row) >= least) cycle
         least = self%gap(row)
         deepest = row
      end do
   end function deepest

end module plydyn_contact_solve_multiplier
