!> Displacement corrections of the surface points by contact.
!>
!> Only points of contact rows are corrected, tens out of thousands: they are listed.
module plydyn_contact_solve_correction
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : constraints_type
   implicit none
   private

   public :: new_correction

   !> Correction of every surface point, and the points of contact rows
   type, public :: correction_type
      !> Correction, zero at points that are not listed, (3, points), length
      real(wp), allocatable :: displacement(:, :)
      !> Points of the rows, each once, in the first `count` entries
      integer, allocatable :: point(:)
      !> Number of listed points
      integer :: count = 0
      !> Whether a point is listed
      logical, allocatable, private :: listed(:)
   contains
      procedure :: clear
      procedure :: list_points
      procedure :: largest_displacement
   end type correction_type

contains

   !> Zero corrections
   pure subroutine new_correction(self, points)
      !> The correction
      type(correction_type), intent(out) :: self
      !> Number of surface points
      integer, intent(in) :: points

      allocate (self%displacement(3, points), source=0.0_wp)
      allocate (self%point(points), source=0)
      allocate (self%listed(points), source=.false.)
   end subroutine new_correction

   !> Reset corrections and list to zero
   pure subroutine clear(self)
      !> The correction
      class(correction_type), intent(inout) :: self

      integer :: i

      do i = 1, self%count
         self%displacement(:, self%point(i)) = 0.0_wp
         self%listed(self%point(i)) = .false.
      end do
      self%count = 0
   end subroutine clear

   !> List the points of all rows
   pure subroutine list_points(self, rows)
      !> The correction, cleared
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
   end subroutine list_points

   !> Largest magnitude of a correction, length
   pure real(wp) function largest_displacement(self)
      !> The correction
      class(correction_type), intent(in) :: self

      integer :: i

      largest_displacement = 0.0_wp
      do i = 1, self%count
         largest_displacement = max(largest_displacement, &
            & sum(self%displacement(:, self%point(i))**2))
      end do
      largest_displacement = sqrt(largest_displacement)
   end function largest_displacement

end module plydyn_contact_solve_correction
