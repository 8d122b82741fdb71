!> Coulomb friction on the rows of a contact pair.
!>
!> The slip of a row is the motion of the impactor relative to the plate at the point of the row
!> over the step, along the surface. A multiplier p along the surface (force times the time step
!> squared) either ends it (stick) or is mu times the normal multiplier against it (slip). It is the
!> increment of the step: no path is kept, and the elastic memory of sticking is that of the plate.
!>
!> Rows are solved one after the other in their order, each exactly, until none changes: the
!> Gauss-Seidel method of Jourdan, Alart and Jean (1998). Multipliers are vectors along the surface
!> and not components along two tangents, so that no direction is preferred.
module plydyn_contact_solve_sliding
   use plydyn_base_matrix, only : cross
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : add_force, constraints_type, correction_type, &
      & gap_change, new_correction, relative_motion
   use plydyn_contact_solve_coulomb, only : friction_type
   implicit none
   private

   public :: new_sliding

   !> Most sweeps over the rows: with more rows than points there are many solutions, between which
   !> sweeps move on without end
   integer, parameter :: most_sweeps = 30
   !> Change of a multiplier in the last sweep over the largest multiplier
   real(wp), parameter :: last_change = 1.0e-12_wp

   !> Motion of plate and impactor over a step before contact, and what friction does to it
   type, public :: step_motion_type
      !> Motion of the surface points, (3, points), length
      real(wp), allocatable :: point(:, :)
      !> Motion of the centre, and rotation
      real(wp) :: centre(3) = 0.0_wp, rotation(3) = 0.0_wp
      !> Rotation that friction adds
      real(wp) :: rotation_correction(3) = 0.0_wp
      !> Multiplier of the rows that slide: on the impactor, about its centre, and on the surface
      !> points, of which only those of rows are set, (3, points); mass times length
      real(wp) :: force(3) = 0.0_wp, moment(3) = 0.0_wp
      real(wp), allocatable :: point_force(:, :)
   end type step_motion_type

   !> Friction of a contact pair; its corrections of a step
   type, public :: sliding_type
      !> Whether there is any
      logical :: is_active = .false.
      type(friction_type), private :: friction
      !> Radius of the impactor, and inverse moment of inertia, zero where it does not turn
      real(wp), private :: radius = 0.0_wp, inverse_inertia = 0.0_wp
      !> Gaps of the trial positions, and slip without friction along the surface, (3, rows); length
      real(wp), allocatable, private :: gap(:), slip(:, :)
      !> Slip by a unit multiplier, one over mass
      real(wp), allocatable, private :: compliance(:)
      !> Corrections by friction
      type(correction_type), private :: correction
   contains
      procedure :: start
      procedure :: find_slips
      procedure :: limit_rows
      procedure :: shift_gaps
      procedure :: finish
   end type sliding_type

contains

   !> Friction of a pair
   pure subroutine new_sliding(self, friction, radius, inverse_inertia, points)
      type(sliding_type), intent(out) :: self
      !> Coefficients
      type(friction_type), intent(in) :: friction
      !> Radius of the impactor, length; its inverse moment of inertia, zero where it does not turn
      real(wp), intent(in) :: radius, inverse_inertia
      !> Number of surface points
      integer, intent(in) :: points

      self%is_active = friction%static > 0.0_wp
      if (.not. self%is_active) return
      self%friction = friction
      self%radius = radius
      self%inverse_inertia = inverse_inertia
      call new_correction(self%correction, points)
      allocate (self%gap(0), self%slip(3, 0), self%compliance(0))
   end subroutine new_sliding

   !> Begin a step without friction
   pure subroutine start(self, rows, inverse_mass, motion)
      class(sliding_type), intent(inout) :: self
      type(constraints_type), intent(inout) :: rows
      !> Inverse mass of the surface points along x, y, z, (3, points), zero where held
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      !> Motion over the step; loses its corrections
      type(step_motion_type), intent(inout) :: motion

      integer :: i, row

      if (size(self%gap) < rows%count) then
         deallocate (self%gap, self%slip, self%compliance)
         associate (capacity => size(rows%gap))
            allocate (self%gap(capacity), self%slip(3, capacity), self%compliance(capacity))
         end associate
      end if
      self%gap(:rows%count) = rows%gap(:rows%count)
      rows%friction(:, :rows%count) = 0.0_wp
      do row = 1, rows%count
         self%compliance(row) = maxval(rows%impactor_inverse) &
            & + (self%radius + rows%gap(row))**2*self%inverse_inertia
         do i = 1, size(rows%point, 1)
            self%compliance(row) = self%compliance(row) &
               & + rows%weight(i, row)**2*maxval(inverse_mass(:3, rows%point(i, row)))
         end do
      end do
      call self%correction%clear()
      call self%correction%list_points(rows)
      do i = 1, self%correction%count
         motion%point_force(:, self%correction%point(i)) = 0.0_wp
      end do
      motion%rotation_correction(:) = 0.0_wp
      motion%force(:) = 0.0_wp
      motion%moment(:) = 0.0_wp
   end subroutine start

   !> Slips of the rows without friction, along the surface
   pure subroutine find_slips(self, rows, correction, motion)
      class(sliding_type), intent(inout) :: self
      type(constraints_type), intent(in) :: rows
      !> By the normal multipliers
      type(correction_type), intent(in) :: correction
      !> Motion over the step before contact
      type(step_motion_type), intent(in) :: motion

      integer :: row

      do row = 1, rows%count
         self%slip(:, row) = along(rows%normal(:, row), &
            & relative_motion(rows, row, correction%displacement, correction%impactor) &
            & + relative_motion(rows, row, motion%point, motion%centre &
            & + cross(motion%rotation, arm(self, rows, row))))
      end do
   end subroutine find_slips

   !> Multipliers along the surface for the normal multipliers that the rows have
   pure subroutine limit_rows(self, rows, inverse_mass, dt, motion)
      class(sliding_type), intent(inout) :: self
      type(constraints_type), intent(inout) :: rows
      !> As in `start`
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      !> Time step
      real(wp), intent(in) :: dt
      !> Gets the correction of the rotation
      type(step_motion_type), intent(inout) :: motion

      real(wp) :: added(3), change, largest, tangent(3)
      integer :: row, sweep
      logical :: is_idle

      do sweep = 1, most_sweeps
         change = 0.0_wp
         largest = 0.0_wp
         do row = 1, rows%count
            is_idle = rows%multiplier(row) <= 0.0_wp .and. all(abs(rows%friction(:, row)) <= 0.0_wp)
            if (is_idle) cycle
            added(:) = relative_motion(rows, row, self%correction%displacement, &
               & self%correction%impactor + cross(motion%rotation_correction, arm(self, rows, row)))
            call self%friction%limit(self%slip(:, row) + along(rows%normal(:, row), added) &
               & - self%compliance(row)*rows%friction(:, row), self%compliance(row), &
               & rows%multiplier(row), dt, tangent, rows%slides(row))
            added(:) = tangent - rows%friction(:, row)
            rows%friction(:, row) = tangent
            call add_force(rows, row, added, inverse_mass, self%correction)
            motion%rotation_correction(:) = motion%rotation_correction &
               & + self%inverse_inertia*cross(arm(self, rows, row), added)
            change = max(change, maxval(abs(added)))
            largest = max(largest, rows%multiplier(row))
         end do
         if (change <= last_change*largest) exit
      end do
   end subroutine limit_rows

   !> Gaps that the normal multipliers have to close after friction
   pure subroutine shift_gaps(self, rows, change)
      class(sliding_type), intent(in) :: self
      type(constraints_type), intent(inout) :: rows
      !> Largest change of a gap, over the largest penetration of the trial positions
      real(wp), intent(out) :: change

      real(wp) :: gap
      integer :: row

      change = 0.0_wp
      do row = 1, rows%count
         gap = self%gap(row) + gap_change(rows, row, self%correction)
         change = max(change, abs(gap - rows%gap(row)))
         rows%gap(row) = gap
      end do
      change = change/maxval(-self%gap(:rows%count))
   end subroutine shift_gaps

   !> Add the corrections by friction to those by the normal multipliers
   pure subroutine finish(self, rows, correction, motion)
      class(sliding_type), intent(in) :: self
      !> The constraints; get the gaps of the trial positions again
      type(constraints_type), intent(inout) :: rows
      !> By the normal multipliers in, by all out
      type(correction_type), intent(inout) :: correction
      !> Gets the multipliers of rows that slide
      type(step_motion_type), intent(inout) :: motion

      integer :: i, k, row

      rows%gap(:rows%count) = self%gap(:rows%count)
      do i = 1, correction%count
         k = correction%point(i)
         correction%displacement(:, k) = correction%displacement(:, k) &
            & + self%correction%displacement(:, k)
      end do
      correction%impactor(:) = correction%impactor + self%correction%impactor
      do row = 1, rows%count
         if (.not. rows%slides(row) .or. rows%multiplier(row) <= 0.0_wp) cycle
         associate (tangent => rows%friction(:, row))
            motion%force(:) = motion%force + tangent
            motion%moment(:) = motion%moment + cross(arm(self, rows, row), tangent)
            do i = 1, size(rows%point, 1)
               k = rows%point(i, row)
               motion%point_force(:, k) = motion%point_force(:, k) - rows%weight(i, row)*tangent
            end do
         end associate
      end do
   end subroutine finish

   !> From the centre to the point of a row, length
   pure function arm(self, rows, row)
      type(sliding_type), intent(in) :: self
      type(constraints_type), intent(in) :: rows
      integer, intent(in) :: row
      real(wp) :: arm(3)

      arm(:) = -(self%radius + self%gap(row))*rows%normal(:, row)
   end function arm

   !> Share of a vector along a surface
   pure function along(normal, vector)
      !> Unit normal of the surface
      real(wp), intent(in) :: normal(3)
      real(wp), intent(in) :: vector(3)
      real(wp) :: along(3)

      along(:) = vector - dot_product(vector, normal)*normal
   end function along

end module plydyn_contact_solve_sliding
