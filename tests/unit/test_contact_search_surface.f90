!> Closest point on the facets of a surface.
program test_contact_search_surface
   use plydyn_base_precision, only : wp
   use plydyn_contact_search_surface, only : closest_point_type, new_surface, surface_type
   use plydyn_fem_shape, only : biquadratic_nodes, local_nodes, shape_functions
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: round_off = 1.0e-12_wp

   call check_neighbours()
   call check_brute_force()
   call check_flat_grid(4)
   call check_flat_grid(9)
   call check_sides_of_plate()
   call check_free_edge()
   call check_fold()
   call check_line()
   call check_inclined_line()
   call finish()

contains

   !> Facets beyond the sides of three squares in an L, the first in the corner, and one apart
   subroutine check_neighbours()
      integer, parameter :: facet(4, 4) = reshape( &
         & [1, 2, 5, 4, 2, 3, 6, 5, 5, 8, 7, 4, 9, 10, 11, 12], [4, 4])
      type(surface_type) :: surface
      integer :: f

      call begin("new_surface, neighbours")
      call new_surface(surface, facet, 12, 1)
      associate (neighbour => surface%neighbour)
         ! side s runs from corner s to the next
         call check(neighbour(2, 1), 2, "to the right")
         call check(neighbour(4, 2), 1, "and back")
         call check(neighbour(3, 1), 3, "up")
         call check(neighbour(4, 3), 1, "and back down, whichever corner comes first")
         call check(count(neighbour > 0), 4, "all other sides are at the border")
         do f = 1, size(facet, 2)
            call check(all(neighbour(:, f) /= f), "nobody is his own neighbour")
         end do
      end associate
   end subroutine check_neighbours

   !> One warped facet with nine points
   subroutine warped_facet(position, facet)
      !> Points, length
      real(wp), intent(out) :: position(3, 9)
      !> The facet
      integer, intent(out) :: facet(9, 1)

      integer :: i

      facet(:, 1) = [(i, i=1, 9)]
      position(:2, :) = 1.5_wp*local_nodes(biquadratic_nodes)
      position(1, :) = position(1, :) + 0.1_wp*position(2, :)**2
      position(3, :) = 0.2_wp*position(1, :)**2 - 0.15_wp*position(2, :)**2 &
         & + 0.1_wp*position(1, :)*position(2, :)
   end subroutine warped_facet

   !> The distance found is the least of a fine scan, and the gap vector is normal inside
   subroutine check_brute_force()
      integer, parameter :: points = 7, scan = 400
      real(wp), parameter :: point(3, points) = reshape([0.2_wp, 0.3_wp, 0.5_wp, &
         & -0.7_wp, 0.6_wp, -0.4_wp, 1.1_wp, -1.2_wp, 0.02_wp, 0.0_wp, 0.0_wp, 0.9_wp, &
         & 2.5_wp, 0.4_wp, 0.3_wp, -1.9_wp, -2.0_wp, 0.1_wp, 0.9_wp, 3.0_wp, -0.5_wp], [3, points])
      real(wp) :: position(3, 9), n(9), dn(2, 9), least, tangential
      integer :: facet(9, 1), i, j, p
      type(surface_type) :: surface
      type(closest_point_type) :: closest

      call begin("project, one warped facet")
      call warped_facet(position, facet)
      call new_surface(surface, facet, size(position, 2), 1)
      do p = 1, points
         closest = surface%start_point(position, point(:, p), [1])
         call surface%project(position, point(:, p), closest)
         least = huge(1.0_wp)
         do j = 0, scan
            do i = 0, scan
               call shape_functions(9, 2.0_wp*i/scan - 1.0_wp, 2.0_wp*j/scan - 1.0_wp, n, dn)
               least = min(least, norm2(point(:, p) - matmul(position, n)))
            end do
         end do
         ! a scan misses the minimum by half its mesh at most, and that by a second-order amount
         associate (found => norm2(closest%gap_vector))
            call check(found <= least + round_off, "not farther than the scan")
            call check(found >= least - 1.0e-3_wp, "not nearer than a point of the facet")
         end associate
         call shape_functions(9, closest%local(1), closest%local(2), n, dn)
         call check(closest%gap_vector, point(:, p) - matmul(position, n), round_off, &
            & "the gap vector starts at the closest point")
         if (closest%is_outside) cycle
         tangential = norm2(matmul(closest%gap_vector, transpose(matmul(dn, transpose(position)))))
         ! the last step, of 1e-4 in local coordinates, leaves its square
         call check(tangential, 0.0_wp, 1.0e-8_wp, "the gap vector is normal to the facet")
         call check(abs(closest%gap), norm2(closest%gap_vector), round_off, "the gap is its length")
      end do
   end subroutine check_brute_force

   !> On a flat grid the closest point is under the point, whichever facet one starts from
   subroutine check_flat_grid(nodes)
      !> Points of a facet
      integer, intent(in) :: nodes

      integer, parameter :: along = 5, points = 4
      real(wp), parameter :: point(3, points) = reshape([0.3_wp, 4.4_wp, 0.7_wp, 2.0_wp, 2.0_wp, &
         & -0.2_wp, 4.9_wp, 0.1_wp, 1.0_wp, 3.0_wp, 1.5_wp, 0.0_wp], [3, points])
      real(wp), allocatable :: position(:, :)
      integer, allocatable :: facet(:, :)
      real(wp) :: n(nodes), dn(2, nodes)
      integer :: start, p
      type(surface_type) :: surface
      type(closest_point_type) :: closest

      call begin("project, flat grid")
      call make_grid(along, nodes, position, facet)
      call new_surface(surface, facet, size(position, 2), 1)
      do p = 1, points
         do start = 1, along**2
            closest = surface%start_point(position, point(:, p), [start])
            call surface%project(position, point(:, p), closest)
            call shape_functions(nodes, closest%local(1), closest%local(2), n, dn)
            call check(matmul(position(:2, facet(:, closest%facet)), n), point(:2, p), round_off, &
               & "the closest point is under the point")
            call check(closest%gap, point(3, p), round_off, "the gap is the height")
            call check(.not. closest%is_outside, "the surface is under the point")
         end do
      end do
   end subroutine check_flat_grid

   !> The normal points out of the plate: up on the top face, down on the bottom face
   subroutine check_sides_of_plate()
      real(wp), allocatable :: position(:, :)
      integer, allocatable :: facet(:, :)
      integer :: side
      type(surface_type) :: surface
      type(closest_point_type) :: closest

      call begin("project, faces")
      call make_grid(2, 4, position, facet)
      do side = -1, 1, 2
         call new_surface(surface, facet, size(position, 2), side)
         closest = surface%start_point(position, [0.6_wp, 0.7_wp, 0.25_wp], [1, 2, 3, 4])
         call surface%project(position, [0.6_wp, 0.7_wp, 0.25_wp], closest)
         call check(closest%normal, [0.0_wp, 0.0_wp, real(side, wp)], round_off, "outward normal")
         call check(closest%gap, side*0.25_wp, round_off, "positive outside")
      end do
   end subroutine check_sides_of_plate

   !> Above a free edge counts as above the surface, beyond it as outside
   subroutine check_free_edge()
      real(wp), allocatable :: position(:, :)
      integer, allocatable :: facet(:, :)
      type(surface_type) :: surface
      type(closest_point_type) :: closest

      call begin("project, free edge")
      call make_grid(3, 9, position, facet)
      call new_surface(surface, facet, size(position, 2), 1)
      closest%facet = 5
      call surface%project(position, [3.0_wp, 1.2_wp, 0.1_wp], closest)
      call check(.not. closest%is_outside, "a point above the free edge has the surface below it")
      call check(closest%gap, 0.1_wp, round_off, "gap above the free edge")
      call surface%project(position, [3.0_wp, 3.0_wp, -0.1_wp], closest)
      call check(.not. closest%is_outside, "a point under the corner has the surface over it")
      call check(closest%gap, -0.1_wp, round_off, "gap at the corner")
      call surface%project(position, [3.5_wp, 1.2_wp, -0.1_wp], closest)
      call check(closest%is_outside, "a point beyond the free edge is outside")
      call check(closest%gap_vector, [0.5_wp, 0.0_wp, -0.1_wp], round_off, "from the free edge")
      call surface%project(position, [-0.3_wp, -0.4_wp, 0.0_wp], closest)
      call check(closest%is_outside, "a point beyond the corner is outside")
      call check(norm2(closest%gap_vector), 0.5_wp, round_off, "distance from the corner")
   end subroutine check_free_edge

   !> Below a valley between two facets the kink is closest, and the point is not outside
   subroutine check_fold()
      real(wp), allocatable :: position(:, :)
      integer, allocatable :: facet(:, :)
      type(surface_type) :: surface
      type(closest_point_type) :: closest

      call begin("project, fold")
      call make_grid(2, 9, position, facet)
      position(3, :) = 0.2_wp*abs(position(1, :) - 1.0_wp)
      call new_surface(surface, facet, size(position, 2), 1)
      closest%facet = 4
      call surface%project(position, [1.01_wp, 0.5_wp, -0.1_wp], closest)
      call check(closest%gap_vector, [0.01_wp, 0.0_wp, -0.1_wp], round_off, "from the kink")
      call check(.not. closest%is_outside, "the surface is there")
   end subroutine check_fold

   !> Where the facet at a free edge is inclined outwards, a line in the plane of the edge hits it
   subroutine check_line()
      real(wp), parameter :: across(3) = [0.0_wp, 0.0_wp, -2.0_wp]
      real(wp), allocatable :: position(:, :)
      integer, allocatable :: facet(:, :)
      type(surface_type) :: surface
      type(closest_point_type) :: closest

      call begin("is_missed")
      call make_grid(2, 9, position, facet)
      position(3, :) = 0.2_wp*position(1, :)
      call new_surface(surface, facet, size(position, 2), 1)
      closest%facet = 1
      call surface%project(position, [0.0_wp, 0.5_wp, -0.1_wp], closest)
      call check(closest%is_outside, "outside along the normal")
      call check(.not. surface%line_misses(closest, across), "not along the plane of the free edge")
      call check(surface%line_misses(closest, [0.1_wp, 0.0_wp, -1.0_wp]), &
         & "but on a line from outside")
      call surface%project(position, [-1.0e-3_wp, 0.5_wp, -0.1_wp], closest)
      call check(surface%line_misses(closest, across), "a point outside of that plane is missed")
      call surface%project(position, [1.0e-3_wp, 0.5_wp, -0.1_wp], closest)
      call check(.not. surface%line_misses(closest, across), "one inside is not")
      call surface%project(position, [0.0_wp, 2.0_wp, -0.1_wp], closest)
      call check(.not. surface%line_misses(closest, across), "nor one under the corner")
      call surface%project(position, [0.0_wp, 2.1_wp, -0.1_wp], closest)
      call check(surface%line_misses(closest, across), "but beyond the corner")
   end subroutine check_line

   !> A facet inclined along its free edge and across: a point in the vertical plane through it is
   !> not beyond it, though the tangents are not perpendicular
   subroutine check_inclined_line()
      real(wp), allocatable :: position(:, :)
      integer, allocatable :: facet(:, :)
      type(surface_type) :: surface
      type(closest_point_type) :: closest

      call begin("line_misses, inclined along the edge")
      call make_grid(2, 9, position, facet)
      position(3, :) = 0.2_wp*position(1, :) - 0.3_wp*position(2, :)
      call new_surface(surface, facet, size(position, 2), 1)
      closest%facet = 1
      call surface%project(position, [0.0_wp, 0.5_wp, -0.3_wp], closest)
      call check(.not. surface%line_misses(closest, [0.0_wp, 0.0_wp, -1.0_wp]), "in the plane")
      call check(surface%line_misses(closest, [1.0e-3_wp, 0.0_wp, -1.0_wp]), "from outside")
      call check(.not. surface%line_misses(closest, [-1.0e-3_wp, 0.0_wp, -1.0_wp]), "from inside")
   end subroutine check_inclined_line

   !> A flat grid of squares of side one
   subroutine make_grid(along, nodes, position, facet)
      !> Facets along one side
      integer, intent(in) :: along
      !> Points of a facet
      integer, intent(in) :: nodes
      !> Points, (3, points)
      real(wp), allocatable, intent(out) :: position(:, :)
      !> Facets, (nodes, facets)
      integer, allocatable, intent(out) :: facet(:, :)

      integer :: degree, f, i, j, line
      real(wp) :: local(2, nodes)

      degree = merge(1, 2, nodes == 4)
      line = degree*along + 1
      allocate (position(3, line**2), facet(nodes, along**2))
      do j = 1, line
         do i = 1, line
            position(:, i + (j - 1)*line) = [i - 1.0_wp, j - 1.0_wp, 0.0_wp]/degree
         end do
      end do
      local(:, :) = local_nodes(nodes)
      do f = 1, along**2
         do i = 1, nodes
            facet(i, f) = 1 + degree*modulo(f - 1, along) + nint(0.5_wp*degree*(local(1, i) + 1)) &
               & + line*(degree*((f - 1)/along) + nint(0.5_wp*degree*(local(2, i) + 1)))
         end do
      end do
   end subroutine make_grid

end program test_contact_search_surface
