!> Rigid body with a flat face along the plate and rounded edges: the body of a fixture.
!>
!> A plane with a window, a ring, a punch or a bar differ in their outlines only. All of these are
!> rounded rectangles: the corners of a circle have its radius, those of a strip with round ends
!> half of its width. Within the edge radius of an outline the face bends down along a quarter of a
!> circle; a bar is a strip whose edge radius is half of its width.
module plydyn_contact_bodies_flat_body
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: circle_outline, rectangle_outline, strip_outline

   !> A rounded rectangle that bounds a body from outside, or from inside as the edge of a hole
   type, public :: outline_type
      !> Centre, length
      real(wp) :: centre(2) = 0.0_wp
      !> Unit vector along the first side
      real(wp) :: axis(2) = [1.0_wp, 0.0_wp]
      !> Half the length along the axis and across it, length
      real(wp) :: half(2) = 0.0_wp
      !> Radius of the corners, length
      real(wp) :: corner = 0.0_wp
      !> Whether the body lies outside of it
      logical :: is_hole = .false.
   contains
      procedure :: find_depth => depth_in_outline
   end type outline_type

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
      procedure :: find_depth => depth_in_body
      procedure :: find_gap
   end type flat_body_type

   !> Share of the size of an outline within which a place lies on it
   real(wp), parameter :: on_outline = 1.0e-9_wp

contains

   !> A circle
   pure type(outline_type) function circle_outline(centre, radius, is_hole) result(self)
      !> Centre, length
      real(wp), intent(in) :: centre(2)
      !> Radius, length
      real(wp), intent(in) :: radius
      !> Whether the body lies outside of it
      logical, intent(in) :: is_hole

      self = rectangle_outline(centre, spread(2.0_wp*radius, 1, 2), radius, is_hole)
   end function circle_outline

   !> A rectangle with sides along x and y
   pure type(outline_type) function rectangle_outline(centre, sides, corner, is_hole) result(self)
      !> Centre, length
      real(wp), intent(in) :: centre(2)
      !> Length along x and y
      real(wp), intent(in) :: sides(2)
      !> Radius of the corners, length
      real(wp), intent(in) :: corner
      !> Whether the body lies outside of it
      logical, intent(in) :: is_hole

      self%centre(:) = centre
      self%half(:) = 0.5_wp*sides
      self%corner = corner
      self%is_hole = is_hole
   end function rectangle_outline

   !> A strip around a line between two places
   pure type(outline_type) function strip_outline(first, last, radius) result(self)
      !> Ends of the line, apart, length
      real(wp), intent(in) :: first(2), last(2)
      !> Half the width of the strip, length
      real(wp), intent(in) :: radius

      real(wp) :: length

      length = norm2(last - first)
      self%centre(:) = 0.5_wp*(first + last)
      self%axis(:) = (last - first)/length
      self%half(:) = [0.5_wp*length + radius, radius]
      self%corner = radius
   end function strip_outline

   !> How far a place lies within the body, negative outside
   pure subroutine depth_in_outline(self, place, depth, inward)
      class(outline_type), intent(in) :: self
      !> Place in the plane, length
      real(wp), intent(in) :: place(2)
      !> Distance from the outline, positive on the side of the body, length
      real(wp), intent(out) :: depth
      !> Unit vector along which the depth grows
      real(wp), intent(out) :: inward(2)

      real(wp) :: beyond(2), distance, local(2), outward(2)
      integer :: c

      ! the place along the sides, and how far it lies beyond the centres of the corners
      local(1) = dot_product(self%axis, place - self%centre)
      local(2) = self%axis(1)*(place(2) - self%centre(2)) &
         & - self%axis(2)*(place(1) - self%centre(1))
      beyond(:) = abs(local) - self%half + self%corner
      outward(:) = 0.0_wp
      if (all(beyond > 0.0_wp)) then
         distance = norm2(beyond)
         outward(:) = sign(beyond/distance, local)
      else
         c = merge(1, 2, beyond(1) >= beyond(2))
         distance = beyond(c)
         outward(c) = sign(1.0_wp, local(c))
      end if
      depth = self%corner - distance
      inward(1) = -(self%axis(1)*outward(1) - self%axis(2)*outward(2))
      inward(2) = -(self%axis(2)*outward(1) + self%axis(1)*outward(2))
      if (.not. self%is_hole) return
      depth = -depth
      inward(:) = -inward
   end subroutine depth_in_outline

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
   pure subroutine depth_in_body(self, place, depth, inward)
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
   end subroutine depth_in_body

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
