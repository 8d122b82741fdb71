!> The row of a point below a facet: points of the facet, weights, normal and gap.
!>
!> Where facets meet there may be a kink without a unique normal. A row there acts on the point of
!> the kink along the mean of the normals of all facets there, which preserves symmetry. This normal
!> belongs to the surface and not to the impactor: it is perpendicular to the edge, so that sliding
!> along the edge does no work, and on the way across what it does against the one facet it gets
!> back from the other. A free edge may be a plane of symmetry, so that a facet there counts
!> together with its mirror image in the vertical plane through the edge.
module plydyn_contact_search_facet_row
   use plydyn_base_matrix, only : cross
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : constraints_type
   use plydyn_contact_search_surface, only : closest_point_type, on_sides, sides, surface_type
   use plydyn_fem_shape, only : shape_functions
   implicit none
   private

   public :: normal_at_kink, set_row

   !> Distance from a side, in local coordinates, within which a point is at the kink
   real(wp), parameter :: kink_width = 1.0e-4_wp

   !> Most facets that meet at a corner, as a bound of walks
   integer, parameter :: most_facets = 100
   !> Nodes of a facet at most
   integer, parameter :: most_nodes = 9

   !> Normals of the facets around a point, and the planes in which they are mirrored
   type :: facets_around_type
      !> Sum of the normals
      real(wp) :: total(3) = 0.0_wp
      !> Normals of the vertical planes through free edges there
      real(wp) :: mirror(3, 2) = 0.0_wp
      !> Number of these planes
      integer :: mirrors = 0
   end type facets_around_type

contains

   !> Set points, weights, normal and gap of a row; the gap is that to the closest point, so that it
   !> is continuous across the kink
   pure subroutine set_row(surface, position, closest, rows, row)
      type(surface_type), intent(in) :: surface
      !> Surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> Closest point
      type(closest_point_type), intent(in) :: closest
      type(constraints_type), intent(inout) :: rows
      integer, intent(in) :: row

      type(closest_point_type) :: kink
      logical :: at_kink(2)
      real(wp) :: slope(2, surface%nodes)

      kink = closest
      at_kink(:) = abs(closest%local) > 1.0_wp - kink_width
      kink%local(:) = merge(sign(1.0_wp, closest%local), closest%local, at_kink)
      rows%point(:, row) = surface%facet(:, closest%facet)
      rows%normal(:, row) = closest%normal
      if (any(at_kink)) rows%normal(:, row) = normal_at_kink(surface, position, kink)
      rows%gap(row) = dot_product(rows%normal(:, row), closest%gap_vector)
      call shape_functions(surface%nodes, kink%local(1), kink%local(2), rows%weight(:, row), slope)
   end subroutine set_row

   !> Unit normal, outward of the plate
   pure function normal_at_kink(surface, position, closest) result(normal)
      type(surface_type), intent(in) :: surface
      !> Surface points, (3, points), length
      real(wp), contiguous, intent(in) :: position(:, :)
      !> A point on one side of its facet, or on two
      type(closest_point_type), intent(in) :: closest
      real(wp) :: normal(3)

      type(facets_around_type) :: around
      integer :: i, s
      logical :: is_around, touches(sides)

      touches(:) = on_sides(closest%local)
      around%total(:) = facet_normal(surface%side, tangents(surface, position, closest))
      is_around = .false.
      do s = 1, sides
         if (is_around) exit
         if (touches(s)) call walk(surface, position, closest, s, around, is_around)
      end do
      do i = 1, around%mirrors
         associate (across => around%mirror(:, i))
            around%total(:) = around%total - dot_product(around%total, across)*across
         end associate
      end do
      normal(:) = around%total/norm2(around%total)
   end function normal_at_kink

   !> Add the normals of the facets around a point, from one side of the first on
   pure subroutine walk(surface, position, start, first, around, is_around)
      type(surface_type), intent(in) :: surface
      real(wp), contiguous, intent(in) :: position(:, :)
      !> The first facet and the point, and the side that is crossed first
      type(closest_point_type), intent(in) :: start
      integer, intent(in) :: first
      type(facets_around_type), intent(inout) :: around
      !> Whether the walk came back to its start
      logical, intent(out) :: is_around

      type(closest_point_type) :: here
      integer :: before, i, side

      here = start
      side = first
      is_around = .false.
      do i = 1, most_facets
         if (surface%neighbour(side, here%facet) == 0) then
            call add_mirror(surface, position, here, side, around)
            return
         end if
         before = here%facet
         call surface%enter_neighbour(side, here)
         is_around = here%facet == start%facet
         if (is_around) return
         around%total(:) = around%total &
            & + facet_normal(surface%side, tangents(surface, position, here))
         ! on across the other side on which the point lies
         side = findloc(on_sides(here%local) .and. surface%neighbour(:, here%facet) /= before, &
            & .true., dim=1, back=.true.)
         if (side == 0) return
      end do
   end subroutine walk

   !> Mirror the normals in the vertical plane through a free side
   pure subroutine add_mirror(surface, position, here, side, around)
      type(surface_type), intent(in) :: surface
      real(wp), contiguous, intent(in) :: position(:, :)
      type(closest_point_type), intent(in) :: here
      integer, intent(in) :: side
      type(facets_around_type), intent(inout) :: around

      real(wp) :: across(3), tangent(3, 2)

      tangent(:, :) = tangents(surface, position, here)
      associate (along => tangent(:, 2 - modulo(side, 2)))
         across(:) = [along(2), -along(1), 0.0_wp]
      end associate
      if (norm2(across) <= 0.0_wp) return
      around%mirrors = around%mirrors + 1
      around%mirror(:, around%mirrors) = across/norm2(across)
   end subroutine add_mirror

   !> Unit normal of one facet, outward of the plate
   pure function facet_normal(side, tangent) result(normal)
      !> Side of the plate, 1 above and -1 below, and tangents along xi and eta, length
      real(wp), intent(in) :: side, tangent(3, 2)
      real(wp) :: normal(3)

      normal(:) = side*cross(tangent(:, 1), tangent(:, 2))
      normal(:) = normal/norm2(normal)
   end function facet_normal

   !> Tangents of a facet along xi and eta, length
   pure function tangents(surface, position, closest) result(tangent)
      type(surface_type), intent(in) :: surface
      real(wp), contiguous, intent(in) :: position(:, :)
      type(closest_point_type), intent(in) :: closest
      real(wp) :: tangent(3, 2)

      real(wp) :: slope(2, most_nodes), weight(most_nodes)
      integer :: c, k

      associate (n => surface%nodes)
         call shape_functions(n, closest%local(1), closest%local(2), weight(:n), slope(:, :n))
      end associate
      tangent(:, :) = 0.0_wp
      do k = 1, surface%nodes
         do c = 1, 2
            tangent(:, c) = tangent(:, c) + slope(c, k)*position(:, surface%facet(k, closest%facet))
         end do
      end do
   end function tangents

end module plydyn_contact_search_facet_row
