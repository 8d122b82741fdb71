!> Contact of the free edges of a face with the exact body of an impactor.
!>
!> Contact nodes outside a free edge have no facet below them, and between two nodes a body could
!> penetrate the edge. Each side of a facet at a free edge that enters the body therefore makes a
!> row at its point closest to it. A side whose normal lies in its own vertical plane makes none: it
!> may be a plane of symmetry.
module plydyn_contact_search_free_edge
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_revolved_body, only : revolved_body_type
   use plydyn_contact_solve_constraint, only : constraints_type
   use plydyn_contact_search_surface, only : point_of_side, sides, surface_type
   use plydyn_fem_shape, only : bilinear_nodes, shape_functions
   implicit none
   private

   public :: collect_edges

   !> Most steps of Newton's method, and the largest step at convergence
   integer, parameter :: max_steps = 30
   real(wp), parameter :: last_step = 1.0e-9_wp

   !> Steps of bisection
   integer, parameter :: bisections = 50

   !> Offset of the core from the vertical plane of a side, over the radius, that counts as zero
   real(wp), parameter :: least_offset = 1.0e-6_wp

   !> Largest distance of a side's points from its ends over the distance between the ends
   real(wp), parameter :: largest_bulge = 1.5_wp

   !> Closest point of a side to a body
   type :: edge_contact_type
      !> Coordinate along the side, from -1 to 1 counter-clockwise
      real(wp) :: local = 0.0_wp
      !> Gap there, length, and unit vector towards the body
      real(wp) :: gap = 0.0_wp, normal(3) = 0.0_wp
      !> Horizontal distance of the tangent from a point along the normal, of the core for a sphere;
      !> length
      real(wp) :: offset = 0.0_wp
   end type edge_contact_type

   !> A side as a parabola relative to the centre
   type :: parabola_type
      !> Coefficients of the powers of its coordinate, length
      real(wp) :: constant(3) = 0.0_wp, linear(3) = 0.0_wp, square(3) = 0.0_wp
   contains
      procedure :: tangent
      procedure :: arm
   end type parabola_type

contains

   !> Smallest distance of the body from a free edge, negative when one is inside, and a row of
   !> every edge inside
   pure subroutine collect_edges(surface, facets, position, centre, body, search_distance, gap, &
      & rows)
      type(surface_type), intent(in) :: surface
      !> Facets to test
      integer, intent(in) :: facets(:)
      !> Trial positions of the surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Trial centre of the body, length
      real(wp), intent(in) :: centre(3)
      type(revolved_body_type), intent(in) :: body
      !> Largest distance of edges from it, length
      real(wp), intent(in) :: search_distance
      !> The smallest distance; huge when none lies within the search distance, length
      real(wp), intent(out) :: gap
      !> Get the rows, where they are wanted; the source of an edge row is 0
      type(constraints_type), optional, intent(inout) :: rows

      type(edge_contact_type) :: closest
      integer :: i, s

      gap = huge(1.0_wp)
      do i = 1, size(facets)
         do s = 1, sides
            if (surface%neighbour(s, facets(i)) /= 0) cycle
            closest = closest_edge_point(surface, facets(i), s, position, centre, body, &
               & search_distance)
            if (closest%offset <= least_offset*body%radius) cycle
            if (closest%gap < search_distance) gap = min(gap, closest%gap)
            if (closest%gap < 0.0_wp .and. present(rows)) then
               call add_row(surface, facets(i), s, closest, rows)
            end if
         end do
      end do
   end subroutine collect_edges

   !> Closest point of a side to the body; none, with no offset, where every point of the side is
   !> farther away than the search distance
   pure function closest_edge_point(surface, facet, side, position, centre, body, search_distance) &
      & result(closest)
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: facet, side
      real(wp), contiguous, intent(in) :: position(:, :)
      real(wp), intent(in) :: centre(3)
      type(revolved_body_type), intent(in) :: body
      real(wp), intent(in) :: search_distance
      type(edge_contact_type) :: closest

      type(parabola_type) :: edge
      real(wp) :: away, first(3), last(3), length, middle(3), normal(3), tangent(3)

      first(:) = position(:, surface%facet(side, facet)) - centre
      last(:) = position(:, surface%facet(modulo(side, sides) + 1, facet)) - centre
      call body%find_core(-first, away, normal)
      if (away > body%rounding + search_distance + largest_bulge*norm2(last - first)) return
      middle(:) = 0.5_wp*(first + last)
      if (surface%nodes > bilinear_nodes) then
         middle(:) = position(:, surface%facet(sides + side, facet)) - centre
      end if
      edge = parabola_type(middle, 0.5_wp*(last - first), 0.5_wp*(first + last) - middle)
      if (size(body%corner, 2) == 1) then
         closest%local = closest_coordinate(edge)
         length = norm2(edge%arm(closest%local))
      else
         closest%local = least_gap_coordinate(edge, body)
         length = body%radius
      end if
      call body%find_gap(edge%arm(closest%local), closest%gap, closest%normal)
      tangent(:) = edge%tangent(closest%local)
      closest%offset = length*abs(closest%normal(1)*tangent(2) - closest%normal(2)*tangent(1)) &
         & /max(norm2(tangent(:2)), tiny(1.0_wp))
   end function closest_edge_point

   !> Direction of growing coordinate, length
   pure function tangent(self, local)
      class(parabola_type), intent(in) :: self
      !> From -1 to 1
      real(wp), intent(in) :: local
      real(wp) :: tangent(3)

      tangent(:) = self%linear + 2.0_wp*local*self%square
   end function tangent

   !> From a point to the centre, length
   pure function arm(self, local)
      class(parabola_type), intent(in) :: self
      !> From -1 to 1
      real(wp), intent(in) :: local
      real(wp) :: arm(3)

      arm(:) = -(self%constant + local*(self%linear + local*self%square))
   end function arm

   !> Coordinate from -1 to 1 of the smallest gap: bisection of its slope, which grows along a
   !> straight side
   pure real(wp) function least_gap_coordinate(edge, body) result(local)
      type(parabola_type), intent(in) :: edge
      type(revolved_body_type), intent(in) :: body

      real(wp) :: gap, normal(3), range(2)
      integer :: iteration

      range(:) = [-1.0_wp, 1.0_wp]
      do iteration = 1, bisections
         local = 0.5_wp*sum(range)
         call body%find_gap(edge%arm(local), gap, normal)
         if (dot_product(normal, edge%tangent(local)) > 0.0_wp) then
            range(1) = local
         else
            range(2) = local
         end if
      end do
   end function least_gap_coordinate

   !> Coordinate from -1 to 1 at which a parabola is closest to the origin
   pure real(wp) function closest_coordinate(edge) result(local)
      type(parabola_type), intent(in) :: edge

      real(wp) :: before, curve, inward(3), slope(3)
      integer :: iteration

      local = 0.0_wp
      do iteration = 1, max_steps
         before = local
         inward(:) = edge%arm(local)
         slope(:) = edge%tangent(local)
         curve = sum(slope**2) - 2.0_wp*dot_product(inward, edge%square)
         if (curve <= 0.0_wp) curve = sum(slope**2)
         local = local + dot_product(inward, slope)/max(curve, tiny(1.0_wp))
         local = min(max(local, -1.0_wp), 1.0_wp)
         if (abs(local - before) <= last_step) exit
      end do
   end function closest_coordinate

   !> Make a row of a side that enters the body
   pure subroutine add_row(surface, facet, side, closest, rows)
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: facet, side
      !> Point of the side closest to the body
      type(edge_contact_type), intent(in) :: closest
      type(constraints_type), intent(inout) :: rows

      real(wp) :: facet_local(2), slope(2, surface%nodes)

      facet_local(:) = point_of_side(side, closest%local)
      call rows%add(0, 0.0_wp)
      associate (row => rows%count)
         rows%point(:, row) = surface%facet(:, facet)
         rows%gap(row) = closest%gap
         rows%normal(:, row) = closest%normal
         call shape_functions(surface%nodes, facet_local(1), facet_local(2), rows%weight(:, row), &
            & slope)
      end associate
   end subroutine add_row

end module plydyn_contact_search_free_edge
