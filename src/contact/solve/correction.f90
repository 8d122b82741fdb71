!> What contact adds to the points of the surface: of thousands of points some tens move.
module plydyn_contact_solve_correction
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : constraints_type
   implicit none
   private

   public :: new_correction

   !> The move of each point, and which points can have moved
   type, public :: correction_type
      !> Zero but at listed points, (3, points), length
      real(wp), allocatable :: move(:, :)
      !> Points of the rows, each once, in the first `count` places
      integer, allocatable :: point(:)
      !> How many these are
      integer :: count = 0
      !> Whether a point is listed
      logical, allocatable, private :: listed(:)
   contains
      procedure :: clear
      procedure :: list
      procedure :: farthest
   end type correction_type

contains

   !> Nothing moves
   pure subroutine new_correction(self, points)
      !> The correction
      type(correction_type), intent(out) :: self
      !> Points of the surface
      integer, intent(in) :: points

      allocate (self%move(3, points), source=0.0_wp)
      allocate (self%point(points), source=0)
      allocate (self%listed(points), source=.false.)
   end subroutine new_correction

   !> Take back all moves, and the list
   pure subroutine clear(self)
      !> The correction
      class(correction_type), intent(inout) :: self

      integer :: i

      do i = 1, self%count
         self%move(:, self%point(i)) = 0.0_wp
         self%listed(self%point(i)) = .false.
      end do
      self%count = 0
   end subroutine clear

   !> List the points of all rows
   pure subroutine list(self, rows)
      !> The correction, clear
      class(correction_type), intent(inout) :: self
      !> The constraints
      type(constraints_type), intent(in) :: rows

      integer :: i, k, row

      do row = 1, rows%count
         do i = 1, size(rows%point, 1)
            k = rows%point(i, row)
            if (self%listed(k)) cycle
            self%listed(k) = .true.
            self%count = self%count + 1
            self%point(self%count) = k
         end do
      end do
   end subroutine list

   !> How far the point has moved that has moved most, length
   pure real(wp) function farthest(self)
      !> The correction
      class(correction_type), intent(in) :: self

      integer :: i

      farthest = 0.0_wp
      do i = 1, self%count
         farthest = max(farthest, sum(self%move(:, self%point(i))**2))
      end do
      farthest = sqrt(farthest)
   end function farthest

end module plydyn_contact_solve_correction
