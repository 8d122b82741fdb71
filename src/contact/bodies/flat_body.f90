!> Rigid body with a flat face along the plate and rounded edges: the body of a fixture.
!>
!> A plane with a window, a ring, a punch or a bar differ in their outlines only. Within the edge
!> radius of an outline the face bends down along a quarter of a circle; a bar is a strip whose edge
!> radius is half of its width.
module plydyn_contact_bodies_flat_body
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_outline, only : outline_type
   implicit none
   private

   !> A body below the plate or above it
   type, public :: flat_body_type
      !> 1 when the body lies below the plate, -1 when above
      integer :: upward = 1
      !> Radius of its edges, length
      real(wp) :: edge = 0.0_wp
      !> Outlines of the face; the body lies within all of them, everywhere without any
      type(outline_type), allocatable :: outlines(:)
   contains
      procedure :: covers
      procedure :: find_depth
      procedure :: find_gap
   end type flat_body_type

   !> Share of the size of an outline within which a place lies on it
   real(wp), parameter :: on_outline = 1.0e-9_wp

contains

   !> Whether a place lies within the outlines
   pure logical function covers(self, place)
      class(flat_body_type), intent(in) :: self
      !> Place in the plane, length
      real(wp), intent(in) :: place(2)

      real(wp) :: depth, inward(2)

      call self%find_depth(place, depth, inward)
      covers = depth >= 0.0_wp
   end function covers

   !> How far a place lies within the outlines, negative outside
   pure subroutine find_depth(self, place, depth, inward)
      class(flat_body_type), intent(in) :: self
      !> Place in the plane, length
      real(wp), intent(in) :: place(2)
      !> Distance from the nearest outline, huge without any, length; zero if it is round-off
      real(wp), intent(out) :: depth
      !> Unit vector along which the depth grows
      real(wp), intent(out) :: inward(2)

      real(wp) :: other, direction(2)
      integer :: i

      depth = huge(1.0_wp)
      inward(:) = 0.0_wp
      do i = 1, size(self%outlines)
         call self%outlines(i)%find_depth(place, other, direction)
         if (abs(other - self%edge) <= on_outline*maxval(self%outlines(i)%half)) other = self%edge
         if (other >= depth) cycle
         depth = other
         inward(:) = direction
      end do
   end subroutine find_depth

   !> Gap of a point of the plate to the body
   pure subroutine find_gap(self, point, gap, normal)
      class(flat_body_type), intent(in) :: self
      !> Point of the plate; its height is that above the face of the body, length
      real(wp), intent(in) :: point(3)
      !> Distance from the body, negative when the point is inside
      real(wp), intent(out) :: gap
      !> Unit vector from the body to the plate
      real(wp), intent(out) :: normal(3)

      real(wp) :: across, depth, distance, height, inward(2)

      call self%find_depth(point(:2), depth, inward)
      height = self%upward*point(3)
      normal(:) = [0.0_wp, 0.0_wp, real(self%upward, wp)]
      gap = height
      if (depth >= self%edge) return
      ! beside the flat face: distance from the circle of the edge, or from the wall below it
      across = self%edge - depth
      if (height > -self%edge) then
         distance = norm2([across, height + self%edge])
         gap = distance - self%edge
         normal(:2) = -inward*across/distance
         normal(3) = self%upward*(height + self%edge)/distance
      else
         gap = -depth
         normal(:) = [-inward, 0.0_wp]
      end if
   end subroutine find_gap

end module plydyn_contact_bodies_flat_body
