!> Active-set solution of unilateral contact: forward increment Lagrange multipliers (eqs 16, 17).
!>
!> With the multipliers times the time step squared p, the gaps of the trial positions g and the
!> matrix A = G M^-1 G^T, the problem is the linear complementarity p >= 0, g + A p >= 0,
!> p.(g + A p) = 0. It is solved by the method of Lawson and Hanson (1974) for non-negative least
!> squares: rows are activated one by one, the deepest penetration first, and deactivated where
!> their multiplier would be negative. The method is finite and deterministic.
!>
!> Several contact nodes on one facet make A singular. A redundant row is not activated, since the
!> active ones have closed its gap already. A relative increase `ridge` of the diagonal makes A
!> definite and leaves that fraction of the step's penetration. Displacements are unique;
!> multipliers of redundant rows are not. The active set of the last step is the initial guess.
module plydyn_contact_solve_multiplier
   use plydyn_base_precision, only : lanes, wp
   use plydyn_contact_solve_constraint, only : add_force, constraints_type, correction_type
   use plydyn_contact_solve_matrix, only : cholesky_factor_type, coupling_type
   implicit none
   private

   !> Relative increase of the diagonal of A
   real(wp), parameter :: ridge = 1.0e-13_wp

   !> Penetration that counts as zero, over the largest of the trial positions
   real(wp), parameter :: tolerance = 1.0e-11_wp

   !> Most activations per row of the problem
   integer, parameter :: max_entries = 3

   !> The active rows, and the work arrays of the method
   type, public :: active_set_type
      !> Active rows, in the order of the factor
      integer, allocatable, private :: row(:)
      !> Whether each row is active
      logical, allocatable, private :: is_active(:)
      !> Rows whose gap no multiplier can open
      logical, allocatable, private :: redundant(:)
      !> Multipliers that close the gaps of all active rows, mass times length
      real(wp), allocatable, private :: trial(:)
      !> Gaps with the multipliers, (rows), length
      real(wp), allocatable, private :: gap(:)
      !> Computes columns of A; the columns of rows that have been active in the step
      type(coupling_type), private :: coupling
      real(wp), allocatable, private :: matrix(:, :)
      !> Factor of A of the active rows
      type(cholesky_factor_type), private :: factor
   contains
      procedure :: solve_unilateral
   end type active_set_type

contains

   !> Find multipliers and displacement corrections
   pure subroutine solve_unilateral(self, rows, inverse_mass, correction)
      class(active_set_type), intent(inout) :: self
      !> The constraints, with initial guesses in, multipliers out
      type(constraints_type), intent(inout) :: rows
      !> Inverse mass of the surface points along x, y, z, (3, points), zero where held
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      !> Zero in, with the points of the rows
      type(correction_type), intent(inout) :: correction

      integer :: entry_count, entering, i, row
      real(wp) :: least_gap

      call initialise(self, rows, inverse_mass, correction)
      least_gap = tolerance*minval(rows%gap(:rows%count))
      entering = 0
      do entry_count = 0, max_entries*rows%count
         call solve_active_set(self, rows, entering)
         call find_gaps(self, rows)
         entering = most_violated(self, rows%count, least_gap)
         if (entering == 0) exit
         call activate(self, rows, entering)
      end do
      do i = 1, self%factor%count
         row = self%row(i)
         call add_force(rows, row, rows%multiplier(row)*rows%normal(:, row), inverse_mass, &
            & correction)
      end do
   end subroutine solve_unilateral

   !> Start with the rows of positive initial guess
   pure subroutine initialise(self, rows, inverse_mass, correction)
      class(active_set_type), intent(inout) :: self
      type(constraints_type), intent(inout) :: rows
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      type(correction_type), intent(in) :: correction

      integer :: n, row

      call reserve(self, size(rows%gap))
      call self%coupling%set_rows(rows, inverse_mass, correction)
      self%is_active(:rows%count) = .false.
      self%redundant(:rows%count) = .false.
      n = 0
      do row = 1, rows%count
         if (.not. rows%multiplier(row) > 0.0_wp) cycle
         call find_column(self, rows, row)
         if (self%redundant(row)) cycle
         n = n + 1
         self%row(n) = row
         self%is_active(row) = .true.
      end do
      call self%factor%fill(self%row(:n), self%matrix, ridge)
   end subroutine initialise

   !> Allocate as many rows as the constraints have
   pure subroutine reserve(self, capacity)
      type(active_set_type), intent(inout) :: self
      !> Rows
      integer, intent(in) :: capacity

      integer :: whole

      if (allocated(self%row)) then
         if (size(self%row) >= capacity) return
         deallocate (self%row, self%is_active, self%redundant, self%trial, self%gap, self%matrix)
      end if
      whole = lanes*((capacity + lanes - 1)/lanes)
      allocate (self%row(capacity), source=0)
      allocate (self%is_active(capacity), self%redundant(capacity), source=.false.)
      allocate (self%trial(capacity), self%gap(whole), self%matrix(whole, capacity), &
         & source=0.0_wp)
   end subroutine reserve

   !> Find the column of A of a row; without compliance the row is redundant
   pure subroutine find_column(self, rows, row)
      type(active_set_type), intent(inout) :: self
      type(constraints_type), intent(inout) :: rows
      integer, intent(in) :: row

      call self%coupling%find_column(rows, row, self%matrix(:self%coupling%rows, row))
      if (self%matrix(row, row) > 0.0_wp) return
      self%redundant(row) = .true.
      rows%multiplier(row) = 0.0_wp
   end subroutine find_column

   !> Activate a row
   pure subroutine activate(self, rows, row)
      class(active_set_type), intent(inout) :: self
      type(constraints_type), intent(inout) :: rows
      integer, intent(in) :: row

      integer :: n

      n = self%factor%count
      call find_column(self, rows, row)
      if (self%redundant(row)) return
      associate (column => self%matrix(:, row))
         call self%factor%append(column(self%row(:n)), (1.0_wp + ridge)*column(row), &
            & ridge*column(row))
      end associate
      self%row(n + 1) = row
      self%is_active(row) = .true.
   end subroutine activate

   !> Close the gaps of the active rows, deactivating rows of negative multiplier on the way
   pure subroutine solve_active_set(self, rows, entering)
      class(active_set_type), intent(inout) :: self
      !> The constraints, multipliers in and out
      type(constraints_type), intent(inout) :: rows
      !> Row just activated, 0 for none; it is redundant if its multiplier would be negative at once
      integer, intent(in) :: entering

      integer :: i, leaving, n, row
      real(wp) :: fraction, fraction_here

      do
         n = self%factor%count
         self%trial(:n) = -rows%gap(self%row(:n))
         call self%factor%solve(self%trial(:n))
         leaving = 0
         fraction = 1.0_wp
         do i = 1, n
            if (self%trial(i) > 0.0_wp) cycle
            row = self%row(i)
            fraction_here = rows%multiplier(row) &
               & /max(rows%multiplier(row) - self%trial(i), tiny(1.0_wp))
            if (leaving > 0 .and. fraction_here >= fraction) cycle
            fraction = fraction_here
            leaving = i
         end do
         do i = 1, n
            row = self%row(i)
            rows%multiplier(row) = rows%multiplier(row) &
               & + fraction*(self%trial(i) - rows%multiplier(row))
         end do
         if (leaving == 0) return
         self%redundant(self%row(leaving)) = self%row(leaving) == entering .and. fraction <= 0.0_wp
         call deactivate(self, rows, leaving)
      end do
   end subroutine solve_active_set

   !> Deactivate a row
   pure subroutine deactivate(self, rows, leaving)
      class(active_set_type), intent(inout) :: self
      type(constraints_type), intent(inout) :: rows
      !> Its index in the order of the factor
      integer, intent(in) :: leaving

      integer :: n

      n = self%factor%count
      rows%multiplier(self%row(leaving)) = 0.0_wp
      self%is_active(self%row(leaving)) = .false.
      call self%factor%remove(leaving)
      self%row(leaving:n - 1) = self%row(leaving + 1:n)
   end subroutine deactivate

   !> Gaps of all rows with the multipliers
   pure subroutine find_gaps(self, rows)
      type(active_set_type), intent(inout) :: self
      type(constraints_type), intent(in) :: rows

      integer :: i, k, row

      self%gap(:rows%count) = rows%gap(:rows%count)
      do i = 1, self%factor%count
         row = self%row(i)
         !$omp simd
         do k = 1, self%coupling%rows
            self%gap(k) = self%gap(k) + self%matrix(k, row)*rows%multiplier(row)
         end do
      end do
   end subroutine find_gaps

   !> Inactive row of deepest penetration, 0 when none penetrates
   pure integer function most_violated(self, rows, least_gap)
      class(active_set_type), intent(in) :: self
      !> Number of rows
      integer, intent(in) :: rows
      !> Gap that counts as closed
      real(wp), intent(in) :: least_gap

      integer :: row
      real(wp) :: least

      most_violated = 0
      least = least_gap
      do row = 1, rows
         if (self%is_active(row) .or. self%redundant(row)) cycle
         if (self%gap(row) >= least) cycle
         least = self%gap(row)
         most_violated = row
      end do
   end function most_violated

end module plydyn_contact_solve_multiplier
