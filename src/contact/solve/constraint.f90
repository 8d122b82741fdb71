!> Contact constraints of one step: points, weights, normals, gaps and multipliers of the rows, and
!> the displacements by which multipliers correct the surface points.
!>
!> A row requires g + n.(u_impactor - sum_k N_k u_k) >= 0. The rows are the matrix G of the paper's
!> eq. 18 along the normal n: one row for each contact node instead of three. Friction adds a vector
!> along the surface. The gap is linearised at the trial positions, once per step, as in the paper.
module plydyn_contact_solve_constraint
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: add_force, gap_change, new_constraints, new_correction, relative_motion

   !> Number of rows of the first allocation
   integer, parameter :: first_capacity = 64

   !> Rows as flat arrays with the row as the last index
   type, public :: constraints_type
      !> Rows in use
      integer :: count = 0
      !> Inverse mass of the impactor along x, y, z, zero where it is held or led
      real(wp) :: impactor_inverse(3) = 0.0_wp
      !> Contact node or surface point of each row, 0 for a free edge
      integer, allocatable :: source(:)
      !> Surface points of each row, (points of a row, rows)
      integer, allocatable :: point(:, :)
      !> Their weights N_k, (points of a row, rows)
      real(wp), allocatable :: weight(:, :)
      !> Unit normal from the plate towards the impactor, (3, rows)
      real(wp), allocatable :: normal(:, :)
      !> Gap of the trial positions, length
      real(wp), allocatable :: gap(:)
      !> Multiplier times the time step squared, mass times length: initial guess in, solution out
      real(wp), allocatable :: multiplier(:)
      !> Multiplier along the surface, on the impactor, (3, rows), and whether it is at its limit:
      !> only of pairs with friction
      real(wp), allocatable :: friction(:, :)
      logical, allocatable :: slides(:)
   contains
      procedure :: add
      procedure :: remove
   end type constraints_type

   !> Corrections of the impactor and of every surface point, and the list of the points of contact
   !> rows, tens out of thousands
   type, public :: correction_type
      !> Of the impactor, and of the points, zero at those that are not listed, (3, points); length
      real(wp) :: impactor(3) = 0.0_wp
      real(wp), allocatable :: displacement(:, :)
      !> Points of the rows, each once, in the first `count` entries
      integer, allocatable :: point(:)
      !> Number of listed points
      integer :: count = 0
      !> Place of each point in the list, 0 where it is not listed
      integer, allocatable :: place(:)
   contains
      procedure :: clear
      procedure :: list_points
      procedure :: largest_displacement
   end type correction_type

contains

   !> Room for some rows
   pure subroutine new_constraints(self, points)
      type(constraints_type), intent(out) :: self
      !> Points of a row: 1, 4 or 9
      integer, intent(in) :: points

      allocate (self%source(first_capacity), source=0)
      allocate (self%point(points, first_capacity), source=0)
      allocate (self%weight(points, first_capacity), source=0.0_wp)
      allocate (self%normal(3, first_capacity), self%friction(3, first_capacity), source=0.0_wp)
      allocate (self%gap(first_capacity), self%multiplier(first_capacity), source=0.0_wp)
      allocate (self%slides(first_capacity), source=.false.)
   end subroutine new_constraints

   !> Add a row; the caller sets its points, weights, normal and gap
   pure subroutine add(self, source, multiplier)
      class(constraints_type), intent(inout) :: self
      !> Contact node or surface point, 0 for a free edge
      integer, intent(in) :: source
      !> Initial guess of the multiplier, mass times length
      real(wp), intent(in) :: multiplier

      if (self%count == size(self%source)) call enlarge(self)
      self%count = self%count + 1
      self%source(self%count) = source
      self%multiplier(self%count) = multiplier
   end subroutine add

   !> Remove a row
   pure subroutine remove(self, row)
      class(constraints_type), intent(inout) :: self
      !> Its index
      integer, intent(in) :: row

      associate (last => self%count)
         self%source(row:last - 1) = self%source(row + 1:last)
         self%point(:, row:last - 1) = self%point(:, row + 1:last)
         self%weight(:, row:last - 1) = self%weight(:, row + 1:last)
         self%normal(:, row:last - 1) = self%normal(:, row + 1:last)
         self%gap(row:last - 1) = self%gap(row + 1:last)
         self%multiplier(row:last - 1) = self%multiplier(row + 1:last)
      end associate
      self%count = self%count - 1
   end subroutine remove

   !> Double the number of allocated rows; what the new ones hold is of no meaning
   pure subroutine enlarge(self)
      type(constraints_type), intent(inout) :: self

      associate (points => size(self%point, 1), capacity => 2*size(self%source))
         self%source = [self%source, self%source]
         self%point = reshape([self%point, self%point], [points, capacity])
         self%weight = reshape([self%weight, self%weight], [points, capacity])
         self%normal = reshape([self%normal, self%normal], [3, capacity])
         self%gap = [self%gap, self%gap]
         self%multiplier = [self%multiplier, self%multiplier]
         self%friction = reshape([self%friction, self%friction], [3, capacity])
         self%slides = [self%slides, self%slides]
      end associate
   end subroutine enlarge

   !> Add the displacement corrections of a multiplier at one row: the paper's eq. 17
   pure subroutine add_force(rows, row, force, inverse_mass, correction)
      type(constraints_type), intent(in) :: rows
      integer, intent(in) :: row
      !> Multiplier on the impactor times the time step squared, mass times length
      real(wp), intent(in) :: force(3)
      !> Inverse mass of the surface points along x, y, z, (3, points), zero where held
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      type(correction_type), intent(inout) :: correction

      integer :: i

      do i = 1, size(rows%point, 1)
         associate (k => rows%point(i, row))
            correction%displacement(:, k) = correction%displacement(:, k) &
               & - rows%weight(i, row)*inverse_mass(:3, k)*force
         end associate
      end do
      correction%impactor(:) = correction%impactor + rows%impactor_inverse*force
   end subroutine add_force

   !> Change of the gap of a row by displacement corrections, length
   pure real(wp) function gap_change(rows, row, correction)
      type(constraints_type), intent(in) :: rows
      integer, intent(in) :: row
      type(correction_type), intent(in) :: correction

      real(wp) :: relative(3)

      relative(:) = relative_motion(rows, row, correction%displacement, correction%impactor)
      gap_change = relative(1)*rows%normal(1, row) + relative(2)*rows%normal(2, row) &
         & + relative(3)*rows%normal(3, row)
   end function gap_change

   !> Motion of the impactor relative to the plate at the point of a row, length
   pure function relative_motion(rows, row, displacement, impactor) result(relative)
      type(constraints_type), intent(in) :: rows
      integer, intent(in) :: row
      !> Motion of the surface points, (3, points), and of the impactor there, length
      real(wp), contiguous, intent(in) :: displacement(:, :)
      real(wp), intent(in) :: impactor(3)
      real(wp) :: relative(3)

      integer :: i, k

      relative(:) = impactor
      do i = 1, size(rows%point, 1)
         k = rows%point(i, row)
         relative(:) = relative - rows%weight(i, row)*displacement(:3, k)
      end do
   end function relative_motion

   !> Zero corrections
   pure subroutine new_correction(self, points)
      type(correction_type), intent(out) :: self
      !> Number of surface points
      integer, intent(in) :: points

      allocate (self%displacement(3, points), source=0.0_wp)
      allocate (self%point(points), self%place(points), source=0)
   end subroutine new_correction

   !> Reset corrections and list to zero
   pure subroutine clear(self)
      class(correction_type), intent(inout) :: self

      integer :: i

      do i = 1, self%count
         self%displacement(:, self%point(i)) = 0.0_wp
         self%place(self%point(i)) = 0
      end do
      self%count = 0
      self%impactor(:) = 0.0_wp
   end subroutine clear

   !> List the points of all rows
   pure subroutine list_points(self, rows)
      !> The correction, cleared
      class(correction_type), intent(inout) :: self
      type(constraints_type), intent(in) :: rows

      integer :: i, k, row

      do row = 1, rows%count
         do i = 1, size(rows%point, 1)
            k = rows%point(i, row)
            if (self%place(k) > 0) cycle
            self%count = self%count + 1
            self%point(self%count) = k
            self%place(k) = self%count
         end do
      end do
   end subroutine list_points

   !> Largest magnitude of a correction, length
   pure real(wp) function largest_displacement(self)
      class(correction_type), intent(in) :: self

      integer :: i

      largest_displacement = 0.0_wp
      do i = 1, self%count
         largest_displacement = max(largest_displacement, &
            & sum(self%displacement(:, self%point(i))**2))
      end do
      largest_displacement = sqrt(largest_displacement)
   end function largest_displacement

end module plydyn_contact_solve_constraint
