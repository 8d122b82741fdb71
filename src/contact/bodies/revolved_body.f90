!> Rigid body of revolution about an axis: the body of an impactor.
!>
!> Its outline is that of a convex core, widened by a radius: a sphere is a widened point, a
!> hemisphere on a rod a widened line, a cylinder with round edges a widened cylinder, a cone with a
!> round tip a widened cone. The distance from it is therefore that from its core less a radius.
module plydyn_contact_bodies_revolved_body
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: cone_body, cylinder_body, sphere_body, tup_body

   !> A body relative to its centre, a point of its axis inside of it
   type, public :: revolved_body_type
      !> Largest distance of its surface from the axis, length
      real(wp) :: radius = 0.0_wp
      !> Radius by which the core is widened, that of a round tip or edge, length
      real(wp) :: rounding = 0.0_wp
      !> Unit vector along the axis, from the tip to the back; zero when not known yet
      real(wp) :: axis(3) = 0.0_wp
      !> Outline of the core from the tip to the back: along the axis and across, (2, corners)
      real(wp), allocatable :: corner(:, :)
      !> Length of the body behind its centre; a rod is endless in contact
      real(wp) :: length = 0.0_wp
   contains
      procedure :: find_gap
      procedure :: find_core
      procedure :: lowest_height
      procedure :: lowest_point
      procedure :: vertical_gap
      procedure :: volume
   end type revolved_body_type

   !> Angles, radians
   real(wp), parameter :: right_angle = acos(0.0_wp), two_pi = 4.0_wp*right_angle
   !> Length of a rod over its radius: one without an end
   real(wp), parameter :: rod_length = 1.0e6_wp
   !> Most steps of Newton's method, and the gap at convergence over the radius
   integer, parameter :: max_steps = 60
   real(wp), parameter :: last_gap = 1.0e-13_wp
   !> Slope along which a line only just comes closer to the body
   real(wp), parameter :: least_slope = 1.0e-9_wp

contains

   !> A sphere around its centre
   pure type(revolved_body_type) function sphere_body(radius) result(self)
      !> Length
      real(wp), intent(in) :: radius

      self%radius = radius
      self%rounding = radius
      self%corner = reshape([0.0_wp, 0.0_wp], [2, 1])
      self%length = radius
   end function sphere_body

   !> A hemisphere around its centre, with a rod of its radius behind it
   pure type(revolved_body_type) function tup_body(radius, rod) result(self)
      !> Radius, and length of the rod, length
      real(wp), intent(in) :: radius, rod

      self%radius = radius
      self%rounding = radius
      self%corner = reshape([0.0_wp, 0.0_wp, rod_length*radius, 0.0_wp], [2, 2])
      self%length = rod
   end function tup_body

   !> A cylinder around its centre, with round edges at both ends
   pure type(revolved_body_type) function cylinder_body(radius, length, edge) result(self)
      !> Radius, length, and radius of the edges, at most half of the length and the radius, length
      real(wp), intent(in) :: radius, length, edge

      self%radius = radius
      self%rounding = edge
      associate (half => 0.5_wp*length - edge)
         self%corner = reshape([-half, 0.0_wp, -half, radius - edge, half, radius - edge, &
            & half, 0.0_wp], [2, 4])
      end associate
      self%length = 0.5_wp*length
   end function cylinder_body

   !> A cone with a round tip, with a rod behind it; the centre is where the rod begins
   pure type(revolved_body_type) function cone_body(radius, angle, tip, rod) result(self)
      !> Radius of the rod, length; angle between the axis and the side, radians
      real(wp), intent(in) :: radius, angle
      !> Radius of the tip, and of the edge between cone and rod; length of the rod, length
      real(wp), intent(in) :: tip, rod

      self%radius = radius
      self%rounding = tip
      associate (across => radius - tip)
         self%corner = reshape([-across/tan(angle), 0.0_wp, 0.0_wp, across, &
            & rod_length*radius, across], [2, 3])
      end associate
      self%length = rod
   end function cone_body

   !> Gap between a point and the body
   pure subroutine find_gap(self, arm, gap, normal)
      class(revolved_body_type), intent(in) :: self
      !> From the point to the centre, length
      real(wp), intent(in) :: arm(3)
      !> Distance from the surface, negative when the point is inside, length
      real(wp), intent(out) :: gap
      !> Unit vector from the point towards the body; zero at the centre of a sphere
      real(wp), intent(out) :: normal(3)

      call self%find_core(arm, gap, normal)
      gap = gap - self%rounding
   end subroutine find_gap

   !> Distance of a point from the core
   pure subroutine find_core(self, arm, distance, normal)
      class(revolved_body_type), intent(in) :: self
      !> From the point to the centre, length
      real(wp), intent(in) :: arm(3)
      !> Negative when the point is inside, length
      real(wp), intent(out) :: distance
      !> As in `find_gap`
      real(wp), intent(out) :: normal(3)

      real(wp) :: across, away(3), slope(2)

      if (size(self%corner, 2) == 1) then
         distance = norm2(arm)
         normal(:) = arm/max(distance, tiny(distance))
      else
         associate (along => -dot_product(arm, self%axis))
            away(:) = -arm - along*self%axis
            across = norm2(away)
            call find_distance(self%corner, [along, across], distance, slope)
         end associate
         normal(:) = -slope(1)*self%axis - slope(2)/max(across, tiny(across))*away
      end if
   end subroutine find_core

   !> Signed distance from a convex outline, and its gradient
   pure subroutine find_distance(corner, place, distance, slope)
      !> Corners from the tip to the back, and the place: along the axis and across, length
      real(wp), intent(in) :: corner(:, :), place(2)
      !> Negative inside, length
      real(wp), intent(out) :: distance
      !> Unit vector away from the outline
      real(wp), intent(out) :: slope(2)

      real(wp) :: arm(2), depth, edge(2), from_corner(2), nearest, outermost, outward(2), share
      integer :: i

      nearest = huge(1.0_wp)
      outermost = -huge(1.0_wp)
      do i = 1, size(corner, 2) - 1
         edge(:) = corner(:, i + 1) - corner(:, i)
         from_corner(:) = place - corner(:, i)
         share = min(max(dot_product(from_corner, edge)/sum(edge**2), 0.0_wp), 1.0_wp)
         arm(:) = from_corner - share*edge
         if (sum(arm**2) < nearest) then
            nearest = sum(arm**2)
            slope(:) = arm
         end if
         depth = (from_corner(2)*edge(1) - from_corner(1)*edge(2))/norm2(edge)
         if (depth > outermost) then
            outermost = depth
            outward(:) = [-edge(2), edge(1)]/norm2(edge)
         end if
      end do
      ! a single line encloses nothing
      if (outermost > 0.0_wp .or. size(corner, 2) == 2) then
         distance = sqrt(nearest)
         slope(:) = slope/max(distance, tiny(distance))
      else
         distance = outermost
         slope(:) = outward
      end if
   end subroutine find_distance

   !> Height of the lowest point above the centre, negative, length
   pure real(wp) function lowest_height(self, side) result(height)
      class(revolved_body_type), intent(in) :: self
      !> 1 when heights are along z, -1 against it
      integer, intent(in) :: side

      associate (upward => side*self%axis(3))
         height = minval(upward*self%corner(1, :) &
            & - sqrt(max(0.0_wp, 1.0_wp - upward**2))*self%corner(2, :)) - self%rounding
      end associate
   end function lowest_height

   !> Lowest point relative to the centre, the middle of them where there are several, length
   pure function lowest_point(self, side) result(point)
      class(revolved_body_type), intent(in) :: self
      !> 1 when heights are along z, -1 against it
      integer, intent(in) :: side
      real(wp) :: point(3)

      real(wp) :: downward(3), height(size(self%corner, 2)), lean
      logical :: is_lowest(size(self%corner, 2))

      associate (upward => side*self%axis(3))
         lean = sqrt(max(0.0_wp, 1.0_wp - upward**2))
         height(:) = upward*self%corner(1, :) - lean*self%corner(2, :)
         is_lowest(:) = height <= minval(height) + last_gap*self%radius
         downward(:) = upward*self%axis - [0.0_wp, 0.0_wp, real(side, wp)]
         ! across the axis; the faces of an upright body are level
         if (lean > least_slope) downward(:) = downward/lean
         point(:) = (sum(self%corner(1, :), is_lowest)*self%axis &
            & + sum(self%corner(2, :), is_lowest)*downward)/count(is_lowest)
         point(3) = point(3) - side*self%rounding
      end associate
   end function lowest_point

   !> Height of the underside of the body above a point, negative when the point is above it; huge
   !> when it is beside the body, length
   !>
   !> The gap is a convex function of the height, which Newton's method approaches from below.
   pure real(wp) function vertical_gap(self, arm, side) result(above)
      class(revolved_body_type), intent(in) :: self
      !> From the point to the centre, length
      real(wp), intent(in) :: arm(3)
      !> 1 when heights are along z, -1 against it
      integer, intent(in) :: side

      real(wp) :: gap, normal(3), trial(3)
      integer :: iteration

      above = side*arm(3) + self%lowest_height(side)
      trial(:) = arm
      do iteration = 1, max_steps
         trial(3) = arm(3) - side*above
         call self%find_gap(trial, gap, normal)
         if (gap <= last_gap*self%radius) return
         if (side*normal(3) <= least_slope) exit
         above = above + gap/(side*normal(3))
      end do
      above = huge(1.0_wp)
   end function vertical_gap

   !> Volume, with the rod as long as it is, length cubed: of a frustum for each straight side, and
   !> the integral of the squared distance from the axis along each arc
   pure real(wp) function volume(self)
      class(revolved_body_type), intent(in) :: self

      real(wp) :: angle(2), cosine(2), edge(2), from(2), run
      integer :: c, last

      last = size(self%corner, 2)
      volume = 0.0_wp
      angle(2) = 0.0_wp
      do c = 1, last
         angle(1) = angle(2)
         angle(2) = 2.0_wp*right_angle
         if (c < last) then
            edge(:) = self%corner(:, c + 1) - self%corner(:, c)
            angle(2) = atan2(edge(1), edge(2))
         end if
         ! the end of a rod is flat
         if (c == last .and. self%corner(1, c) > self%length) exit
         from(:) = self%corner(:, c)
         cosine(:) = cos(angle)
         associate (r => self%rounding)
            volume = volume + two_pi*0.5_wp*r*(from(2)**2*(cosine(1) - cosine(2)) &
               & + from(2)*r*(angle(2) - angle(1) - (sin(2.0_wp*angle(2)) &
               & - sin(2.0_wp*angle(1)))*0.5_wp) + r**2*(cosine(1) - cosine(2) &
               & - (cosine(1)**3 - cosine(2)**3)/3.0_wp))
         end associate
         if (c == last) exit
         ! from the end of the arc along the side, as far as a rod goes
         from(:) = from + self%rounding*[-cosine(2), sin(angle(2))]
         run = edge(1)
         if (from(1) + run > self%length + self%rounding) run = max(0.0_wp, self%length - from(1))
         if (abs(edge(1)) > 0.0_wp) edge(:) = edge*(run/edge(1))
         volume = volume + two_pi/6.0_wp*run*(3.0_wp*from(2)**2 + 3.0_wp*from(2)*edge(2) &
            & + edge(2)**2)
      end do
   end function volume

end module plydyn_contact_bodies_revolved_body
