!> The border of a face against the exact sphere.
!>
!> A contact node beyond the border touches nothing. A sphere over it would sink between nodes that
!> have slipped off and nodes above the face, until one of them is found far below. So no side of
!> the border may enter the sphere: each that does makes a row at its closest point to the centre.
!> None is made where the centre lies over the side to the digit: it may be a plane of symmetry.
module plydyn_contact_search_free_edge
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : constraints_type
   use plydyn_contact_search_neighbours, only : sides
   use plydyn_contact_search_surface, only : surface_type
   use plydyn_fem_shape, only : bilinear_nodes, shape_functions
   implicit none
   private

   public :: collect_rim, rim_gap

   !> Steps of Newton's method before giving up, and the step that is the last
   integer, parameter :: most_steps = 30
   real(wp), parameter :: last_step = 1.0e-9_wp

   !> A centre this close to the plane above a side is in it, as a share of the radius
   real(wp), parameter :: least_offset = 1.0e-6_wp

   !> A side never bulges out farther from its ends than this many times the distance between them
   real(wp), parameter :: largest_bulge = 1.5_wp

   !> Closest point of a side to the centre
   type :: edge_contact_type
      !> Where it is on the side, from -1 to 1 counter-clockwise
      real(wp) :: along = 0.0_wp
      !> From there to the centre, length
      real(wp) :: arm(3) = 0.0_wp
      !> How far the centre is beside the side, seen from above, length
      real(wp) :: offset = 0.0_wp
   end type edge_contact_type

contains

   !> Make a row of every side of the border inside the sphere
   pure subroutine collect_rim(surface, facets, position, centre, radius, rows)
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Facets to look at
      integer, intent(in) :: facets(:)
      !> Trial positions of the surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Trial centre of the sphere, length
      real(wp), intent(in) :: centre(3)
      !> Of the sphere, length
      real(wp), intent(in) :: radius
      !> The constraints; a row of the border belongs to no node, 0
      type(constraints_type), intent(inout) :: rows

      type(edge_contact_type) :: touch
      integer :: i, s

      do i = 1, size(facets)
         do s = 1, sides
            if (surface%neighbour(s, facets(i)) /= 0) cycle
            if (is_far(surface, facets(i), s, position, centre, radius)) cycle
            touch = touch_of(surface, facets(i), s, position, centre)
            if (touch%offset <= least_offset*radius) cycle
            if (norm2(touch%arm) < radius) call add_row(surface, facets(i), s, touch, radius, rows)
         end do
      end do
   end subroutine collect_rim

   !> Least distance of the sphere from a side of the border, negative when one is inside; huge when
   !> there is none within a length
   pure real(wp) function rim_gap(surface, facets, position, centre, radius, reach)
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Facets to look at
      integer, intent(in) :: facets(:)
      !> Surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the sphere, length
      real(wp), intent(in) :: centre(3)
      !> Of the sphere, length
      real(wp), intent(in) :: radius
      !> Sides as near as this count, length
      real(wp), intent(in) :: reach

      type(edge_contact_type) :: touch
      integer :: i, s

      rim_gap = huge(1.0_wp)
      do i = 1, size(facets)
         do s = 1, sides
            if (surface%neighbour(s, facets(i)) /= 0) cycle
            if (is_far(surface, facets(i), s, position, centre, radius + reach)) cycle
            touch = touch_of(surface, facets(i), s, position, centre)
            if (touch%offset <= least_offset*radius) cycle
            if (norm2(touch%arm) < radius + reach) rim_gap = min(rim_gap, norm2(touch%arm) - radius)
         end do
      end do
   end function rim_gap

   !> Whether no point of a side can be as near as a distance
   pure logical function is_far(surface, facet, side, position, centre, distance)
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Facet, and side of it
      integer, intent(in) :: facet, side
      !> Surface points, length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the sphere, length
      real(wp), intent(in) :: centre(3)
      !> Length
      real(wp), intent(in) :: distance

      associate (from => position(:, surface%facet(side, facet)), &
         & to => position(:, surface%facet(modulo(side, sides) + 1, facet)))
         is_far = norm2(from - centre) > distance + largest_bulge*norm2(to - from)
      end associate
   end function is_far

   !> Closest point of a side to the centre
   pure function touch_of(surface, facet, side, position, centre) result(touch)
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Facet, and side of it
      integer, intent(in) :: facet, side
      !> Surface points, length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre of the sphere, length
      real(wp), intent(in) :: centre(3)
      type(edge_contact_type) :: touch

      real(wp) :: first(3), last(3), middle(3), slope(3), square(3)

      first(:) = position(:, surface%facet(side, facet)) - centre
      last(:) = position(:, surface%facet(modulo(side, sides) + 1, facet)) - centre
      middle(:) = 0.5_wp*(first + last)
      if (surface%nodes > bilinear_nodes) then
         middle(:) = position(:, surface%facet(sides + side, facet)) - centre
      end if
      slope(:) = 0.5_wp*(last - first)
      square(:) = 0.5_wp*(first + last) - middle
      touch%along = closest_along(middle, slope, square)
      touch%arm(:) = -(middle + touch%along*(slope + touch%along*square))
      slope(:) = slope + 2.0_wp*touch%along*square
      touch%offset = abs(touch%arm(1)*slope(2) - touch%arm(2)*slope(1)) &
         & /max(norm2(slope(:2)), tiny(1.0_wp))
   end function touch_of

   !> Where a parabola from -1 to 1 comes closest to the origin
   pure real(wp) function closest_along(constant, linear, square) result(along)
      !> Its coefficients, length
      real(wp), intent(in) :: constant(3), linear(3), square(3)

      real(wp) :: before, curve, slope(3), value(3)
      integer :: iteration

      along = 0.0_wp
      do iteration = 1, most_steps
         before = along
         value(:) = constant + along*(linear + along*square)
         slope(:) = linear + 2.0_wp*along*square
         curve = sum(slope**2) + 2.0_wp*dot_product(value, square)
         if (curve <= 0.0_wp) curve = sum(slope**2)
         along = along - dot_product(value, slope)/max(curve, tiny(1.0_wp))
         along = min(max(along, -1.0_wp), 1.0_wp)
         if (abs(along - before) <= last_step) exit
      end do
   end function closest_along

   !> Make a row of a side inside the sphere
   pure subroutine add_row(surface, facet, side, touch, radius, rows)
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Facet, and side of it
      integer, intent(in) :: facet, side
      !> Its closest point
      type(edge_contact_type), intent(in) :: touch
      !> Of the sphere, length
      real(wp), intent(in) :: radius
      !> The constraints
      type(constraints_type), intent(inout) :: rows

      real(wp) :: place(2), slope(2, surface%nodes)

      select case (side)
      case (1)
         place(:) = [touch%along, -1.0_wp]
      case (2)
         place(:) = [1.0_wp, touch%along]
      case (3)
         place(:) = [-touch%along, 1.0_wp]
      case default
         place(:) = [-1.0_wp, -touch%along]
      end select
      call rows%add(0, 0.0_wp)
      associate (row => rows%count)
         rows%point(:, row) = surface%facet(:, facet)
         rows%gap(row) = norm2(touch%arm) - radius
         rows%normal(:, row) = touch%arm/norm2(touch%arm)
         call shape_functions(surface%nodes, place(1), place(2), rows%weight(:, row), slope)
      end associate
   end subroutine add_row

end module plydyn_contact_search_free_edge
