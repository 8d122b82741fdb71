!> How far a push at one row opens the gaps of all rows: the columns of A = G M^-1 G^T.
!>
!> The rows are the lanes of vectors. Each row has weights at the few points of its facet, so a push
!> moves few of the points that the rows touch, and what that opens is a sum of as many vectors.
module plydyn_contact_solve_coupling
   use plydyn_base_precision, only : lanes, wp
   use plydyn_contact_solve_constraint, only : constraints_type
   implicit none
   private

   public :: new_coupling

   !> The rows of a step, seen from the points that they touch
   type, public :: coupling_type
      !> Rows of the step, with the empty ones that fill the last vector
      integer :: rows = 0
      !> Places of the points of each row among those touched, (points of a row, rows)
      integer, allocatable, private :: place(:, :)
      !> How far a unit push at each row moves its points, (3, points of a row, rows)
      real(wp), allocatable, private :: motion(:, :, :)
      !> Weight of each place in each row, and the normals: (rows, places) and (rows, 3), flat, as
      !> the rows are others in every step
      real(wp), allocatable, private :: weight(:), normal(:)
      !> Place of each surface point; zero between calls
      integer, allocatable, private :: place_of(:)
   contains
      procedure :: take
      procedure :: find_column
   end type coupling_type

contains

   !> No rows yet
   pure subroutine new_coupling(self, points)
      !> The coupling
      type(coupling_type), intent(out) :: self
      !> Number of surface points
      integer, intent(in) :: points

      allocate (self%place_of(points), source=0)
      allocate (self%place(0, 0), self%motion(0, 0, 0), self%weight(0), self%normal(0))
   end subroutine new_coupling

   !> Take the rows of a step
   pure subroutine take(self, rows, inverse_mass)
      !> The coupling
      class(coupling_type), intent(inout) :: self
      !> The constraints
      type(constraints_type), intent(in) :: rows
      !> Of the surface points along x, y, z, (3, points), zero where held
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)

      integer :: i, places, row

      call make_room(self, size(rows%point, 1), size(rows%gap))
      call find_places(self, rows, places)
      self%rows = lanes*((rows%count + lanes - 1)/lanes)
      if (size(self%weight) < self%rows*places) then
         deallocate (self%weight)
         allocate (self%weight(2*self%rows*places))
      end if
      self%weight(:self%rows*places) = 0.0_wp
      self%normal(:3*self%rows) = 0.0_wp
      do row = 1, rows%count
         self%normal(row:3*self%rows:self%rows) = rows%normal(:, row)
         do i = 1, size(rows%point, 1)
            self%weight(self%rows*(self%place(i, row) - 1) + row) = rows%weight(i, row)
            self%motion(:, i, row) = rows%weight(i, row)*inverse_mass(:3, rows%point(i, row)) &
               & *rows%normal(:, row)
         end do
      end do
   end subroutine take

   !> Number the points that any row touches
   pure subroutine find_places(self, rows, places)
      type(coupling_type), intent(inout) :: self
      type(constraints_type), intent(in) :: rows
      !> How many they are
      integer, intent(out) :: places

      integer :: i, row

      places = 0
      do row = 1, rows%count
         do i = 1, size(rows%point, 1)
            associate (place => self%place_of(rows%point(i, row)))
               if (place == 0) then
                  places = places + 1
                  place = places
               end if
               self%place(i, row) = place
            end associate
         end do
      end do
      do row = 1, rows%count
         self%place_of(rows%point(:, row)) = 0
      end do
   end subroutine find_places

   !> How far a unit push at one row opens every row, length over mass times length; zero behind
   !> the last
   pure subroutine find_column(self, rows, row, impactor_inverse, column)
      !> The coupling
      class(coupling_type), intent(in) :: self
      !> The constraints
      type(constraints_type), intent(in) :: rows
      !> Which row
      integer, intent(in) :: row
      !> Of the impactor along x, y, z, zero where held
      real(wp), intent(in) :: impactor_inverse(3)
      !> One number for each row
      real(wp), intent(out) :: column(self%rows)

      call open_rows(self%rows, size(rows%point, 1), self%place(:, row), self%motion(:, :, row), &
         & impactor_inverse*rows%normal(:, row), self%weight, self%normal, column)
   end subroutine find_column

   !> How far a motion of points, away from the impactor, and one of the impactor open every row
   pure subroutine open_rows(rows, points, place, motion, impactor_motion, weight, normal, opened)
      integer, intent(in) :: rows, points
      !> Places of the points
      integer, intent(in) :: place(points)
      !> How far they move, and the impactor
      real(wp), intent(in) :: motion(3, points), impactor_motion(3)
      real(wp), intent(in) :: weight(rows, *), normal(rows, 3)
      real(wp), intent(out) :: opened(rows)

      real(wp), dimension(lanes) :: x, y, z
      integer :: first, i, l

      do first = 0, rows - lanes, lanes
         x(:) = impactor_motion(1)
         y(:) = impactor_motion(2)
         z(:) = impactor_motion(3)
         do i = 1, points
            !$omp simd
            do l = 1, lanes
               x(l) = x(l) + motion(1, i)*weight(first + l, place(i))
               y(l) = y(l) + motion(2, i)*weight(first + l, place(i))
               z(l) = z(l) + motion(3, i)*weight(first + l, place(i))
            end do
         end do
         !$omp simd
         do l = 1, lanes
            opened(first + l) = x(l)*normal(first + l, 1) + y(l)*normal(first + l, 2) &
               & + z(l)*normal(first + l, 3)
         end do
      end do
   end subroutine open_rows

   !> Make room for as many rows as the constraints have room for
   pure subroutine make_room(self, points, capacity)
      type(coupling_type), intent(inout) :: self
      !> Points of a row, and rows
      integer, intent(in) :: points, capacity

      if (size(self%place, 2) >= capacity) return
      deallocate (self%place, self%motion, self%normal)
      allocate (self%place(points, capacity), source=0)
      allocate (self%motion(3, points, capacity), self%normal(3*(capacity + lanes)), &
         & source=0.0_wp)
   end subroutine make_room

end module plydyn_contact_solve_coupling
