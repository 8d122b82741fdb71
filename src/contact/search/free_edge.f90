!> Contact of the free edges of a face with the exact sphere.
!>
!> Contact nodes outside a free edge have no facet below them, and between two nodes a sphere could
!> penetrate the edge. Each side of a facet at a free edge that enters the sphere therefore makes a
!> row at its point closest to the centre. A side exactly below the centre makes none: it may be a
!> plane of symmetry.
module plydyn_contact_search_free_edge
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : constraints_type
   use plydyn_contact_search_neighbours, only : sides
   use plydyn_contact_search_surface, only : surface_type
   use plydyn_fem_shape, only : bilinear_nodes, shape_functions
   implicit none
   private

   public :: collect_edges, edge_gap

   !> Most steps of Newton's method, and the largest step at convergence
   integer, parameter :: max_steps = 30
   real(wp), parameter :: last_step = 1.0e-9_wp

   !> Offset of the centre from the vertical plane of a side, over the radius, that counts as zero
   real(wp), parameter :: least_offset = 1.0e-6_wp

   !> Largest distance of a side's points from its ends over the distance between the ends
   real(wp), parameter :: largest_bulge = 1.5_wp

   !> Closest point of a side to the centre
   type :: edge_contact_type
      !> Coordinate along the side, from -1 to 1 counter-clockwise
      real(wp) :: local = 0.0_wp
      !> From the closest point to the centre, length
      real(wp) :: arm(3) = 0.0_wp
      !> Horizontal distance of the centre from the tangent, length
      real(wp) :: offset = 0.0_wp
   end type edge_contact_type

contains

   !> Make a row of every free edge inside the sphere
   pure subroutine collect_edges(surface, facets, position, centre, radius, rows)
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Facets to test
      integer, intent(in) :: facets(:)
      !> Trial positions of the surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Trial centre of the sphere, length
      real(wp), intent(in) :: centre(3)
      !> Of the sphere, length
      real(wp), intent(in) :: radius
      !> The constraints; the source of an edge row is 0
      type(constraints_type), intent(inout) :: rows

      type(edge_contact_type) :: closest
      integer :: i, s

      do i = 1, size(facets)
         do s = 1, sides
            if (surface%neighbour(s, facets(i)) /= 0) cycle
            if (is_out_of_range(surface, facets(i), s, position, centre, radius)) cycle
            closest = closest_edge_point(surface, facets(i), s, position, centre)
            if (closest%offset <= least_offset*radius) cycle
            if (norm2(closest%arm) >= radius) cycle
            call add_row(surface, facets(i), s, closest, radius, rows)
         end do
      end do
   end subroutine collect_edges

   !> Smallest distance of the sphere from a free edge, negative when one is inside; huge when none
   !> lies within the search distance, length
   pure real(wp) function edge_gap(surface, facets, position, centre, radius, search_distance)
      !> The surface
      type(surface_type), intent(in) :: surface
      !> Facets to test
      integer, intent(in) :: facets(:)
      !> Surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Centre and radius of the sphere, largest distance of edges from it, length
      real(wp), intent(in) :: centre(3), radius, search_distance

      type(edge_contact_type) :: closest
      integer :: i, s
      real(wp) :: range

      edge_gap = huge(1.0_wp)
      range = radius + search_distance
      do i = 1, size(facets)
         do s = 1, sides
            if (surface%neighbour(s, facets(i)) /= 0) cycle
            if (is_out_of_range(surface, facets(i), s, position, centre, range)) cycle
            closest = closest_edge_point(surface, facets(i), s, position, centre)
            if (closest%offset <= least_offset*radius) cycle
            if (norm2(closest%arm) < range) edge_gap = min(edge_gap, norm2(closest%arm) - radius)
         end do
      end do
   end function edge_gap

   !> Whether every point of a side is farther from the centre than a distance
   pure logical function is_out_of_range(surface, facet, side, position, centre, distance)
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: facet, side
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3), distance

      associate (from => position(:, surface%facet(side, facet)), &
         & to => position(:, surface%facet(modulo(side, sides) + 1, facet)))
         is_out_of_range = norm2(from - centre) > distance + largest_bulge*norm2(to - from)
      end associate
   end function is_out_of_range

   !> Closest point of a side to the centre
   pure function closest_edge_point(surface, facet, side, position, centre) result(closest)
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: facet, side
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)
      type(edge_contact_type) :: closest

      real(wp) :: first(3), last(3), middle(3), slope(3), square(3)

      first(:) = position(:, surface%facet(side, facet)) - centre
      last(:) = position(:, surface%facet(modulo(side, sides) + 1, facet)) - centre
      middle(:) = 0.5_wp*(first + last)
      if (surface%nodes > bilinear_nodes) then
         middle(:) = position(:, surface%facet(sides + side, facet)) - centre
      end if
      slope(:) = 0.5_wp*(last - first)
      square(:) = 0.5_wp*(first + last) - middle
      closest%local = closest_coordinate(middle, slope, square)
      closest%arm(:) = -(middle + closest%local*(slope + closest%local*square))
      slope(:) = slope + 2.0_wp*closest%local*square
      closest%offset = abs(closest%arm(1)*slope(2) - closest%arm(2)*slope(1)) &
         & /max(norm2(slope(:2)), tiny(1.0_wp))
   end function closest_edge_point

   !> Coordinate from -1 to 1 at which a parabola is closest to the origin
   pure real(wp) function closest_coordinate(constant, linear, square) result(local)
      !> Its coefficients, length
      real(wp), intent(in) :: constant(3), linear(3), square(3)

      real(wp) :: before, curve, slope(3), value(3)
      integer :: iteration

      local = 0.0_wp
      do iteration = 1, max_steps
         before = local
         value(:) = constant + local*(linear + local*square)
         slope(:) = linear + 2.0_wp*local*square
         curve = sum(slope**2) + 2.0_wp*dot_product(value, square)
         if (curve <= 0.0_wp) curve = sum(slope**2)
         local = local - dot_product(value, slope)/max(curve, tiny(1.0_wp))
         local = min(max(local, -1.0_wp), 1.0_wp)
         if (abs(local - before) <= last_step) exit
      end do
   end function closest_coordinate

   !> Make a row of a side that enters the sphere
   pure subroutine add_row(surface, facet, side, closest, radius, rows)
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: facet, side
      !> Point of the side closest to the centre
      type(edge_contact_type), intent(in) :: closest
      !> Radius of the sphere, length
      real(wp), intent(in) :: radius
      type(constraints_type), intent(inout) :: rows

      real(wp) :: facet_local(2), slope(2, surface%nodes)

      select case (side)
      case (1)
         facet_local(:) = [closest%local, -1.0_wp]
      case (2)
         facet_local(:) = [1.0_wp, closest%local]
      case (3)
         facet_local(:) = [-closest%local, 1.0_wp]
      case default
         facet_local(:) = [-1.0_wp, -closest%local]
      end select
      call rows%add(0, 0.0_wp)
      associate (row => rows%count)
         rows%point(:, row) = surface%facet(:, facet)
         rows%gap(row) = norm2(closest%arm) - radius
         rows%normal(:, row) = closest%arm/norm2(closest%arm)
         call shape_functions(surface%nodes, facet_local(1), facet_local(2), rows%weight(:, row), &
            & slope)
      end associate
   end subroutine add_row

end module plydyn_contact_search_free_edge
