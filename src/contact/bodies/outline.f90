!> Outline of a flat face: a rectangle with rounded corners, a circle or a strip with round ends.
!>
!> All of them are rounded rectangles: the corners of a circle have its radius, those of a strip
!> half of its width.
module plydyn_contact_bodies_outline
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
      procedure :: find_depth
   end type outline_type

contains

   !> A circle
   pure type(outline_type) function circle_outline(centre, radius, is_hole) result(self)
      !> Centre, length
      real(wp), intent(in) :: centre(2)
      !> Radius, length
      real(wp), intent(in) :: radius
      !> Whether the body lies outside of it
      logical, intent(in) :: is_hole

      self%centre(:) = centre
      self%half(:) = radius
      self%corner = radius
      self%is_hole = is_hole
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
   pure subroutine find_depth(self, place, depth, inward)
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
   end subroutine find_depth

end module plydyn_contact_bodies_outline
