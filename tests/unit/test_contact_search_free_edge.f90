!> Free edges of a face stay outside of the sphere, except where they may be planes of symmetry.
program test_contact_search_free_edge
   use ball, only : ball_body
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : constraints_type, new_constraints
   use plydyn_contact_search_free_edge, only : collect_edges
   use plydyn_contact_search_surface, only : new_surface, surface_type
   use sample, only : flat_surface
   use testing, only : begin, check, finish
   implicit none

   !> A square of side two around the origin, of four facets with nine points each
   integer, parameter :: squares = 2, points = (2*squares + 1)**2, facets(4) = [1, 2, 3, 4]

   real(wp), parameter :: round_off = 1.0e-12_wp

   real(wp) :: flat(3, points), gap
   integer :: facet(9, squares**2)
   type(surface_type) :: surface

   call flat_surface(squares, flat, facet)
   call new_surface(surface, facet, size(flat, 2), 1)
   call check_straight()
   call check_inside()
   call check_corner()
   call check_curved()
   call check_search_distance()
   call finish()

contains

   !> The closest point of a straight side: distance, normal, and weights that give its position
   subroutine check_straight()
      real(wp), parameter :: arm(3) = [0.3_wp, 0.0_wp, 0.4_wp]
      type(constraints_type) :: rows
      real(wp) :: closest(3)
      integer :: side

      call begin("collect_edges, straight")
      do side = 1, 4
         closest(:) = turned([1.0_wp, 0.5_wp, 0.0_wp], side)
         call new_constraints(rows, 9)
         call collect_edges(surface, facets, flat, closest + turned(arm, side), &
            & ball_body(0.6_wp), 0.0_wp, gap, rows)
         call check(rows%count, 1, "one side holds the sphere")
         call check(rows%gap(1), -0.1_wp, round_off, "depth of the edge")
         call check(rows%normal(:, 1), turned(arm, side)/0.5_wp, round_off, "towards the centre")
         call check(matmul(flat(:, rows%point(:, 1)), rows%weight(:, 1)), closest, round_off, &
            & "weights at the closest point")
         call check(sum(rows%weight(:, 1)), 1.0_wp, round_off, "the force is whole")
      end do
   end subroutine check_straight

   !> A row where the centre is above the face, none where it is above the side itself
   subroutine check_inside()
      type(constraints_type) :: rows

      call begin("collect_edges, inside")
      call new_constraints(rows, 9)
      call collect_edges(surface, facets, flat, [1.0_wp, 0.5_wp, 0.4_wp], ball_body(0.45_wp), &
         & 0.0_wp, gap, rows)
      call check(rows%count, 0, "nothing on a plane of symmetry")
      call collect_edges(surface, facets, flat, [1.5_wp, 0.5_wp, 0.4_wp], ball_body(0.6_wp), &
         & 0.0_wp, gap, rows)
      call check(rows%count, 0, "nothing where the edge is outside")
      call collect_edges(surface, facets, flat, [0.7_wp, 0.5_wp, 0.4_wp], ball_body(0.6_wp), &
         & 0.0_wp, gap, rows)
      call check(rows%count, 1, "a row where the centre is over the face")
      call check(rows%gap(1), -0.1_wp, round_off, "depth of the edge")
   end subroutine check_inside

   !> Over a corner both sides end in the same point
   subroutine check_corner()
      type(constraints_type) :: rows
      integer :: row

      call begin("collect_edges, corner")
      call new_constraints(rows, 9)
      call collect_edges(surface, facets, flat, [1.2_wp, 1.3_wp, 0.6_wp], ball_body(0.8_wp), &
         & 0.0_wp, gap, rows)
      call check(rows%count, 2, "two sides")
      do row = 1, 2
         call check(rows%gap(row), -0.1_wp, round_off, "depth of the corner")
         call check(rows%normal(:, row), [0.2_wp, 0.3_wp, 0.6_wp]/0.7_wp, round_off, "normal")
      end do
   end subroutine check_corner

   !> On a side x = 1.2 - 0.8 (y - 0.5)^2 from y = 0 to 1: along its normal at y = 0.75
   subroutine check_curved()
      real(wp), parameter :: closest(3) = [1.15_wp, 0.75_wp, 0.0_wp]
      real(wp), parameter :: out(3) = [1.0_wp, 0.4_wp, 0.0_wp]
      type(constraints_type) :: rows
      real(wp) :: position(3, points), centre(3)
      integer :: i

      call begin("collect_edges, curved")
      position(:, :) = flat
      i = minloc(abs(flat(1, :) - 1.0_wp) + abs(flat(2, :) - 0.5_wp), dim=1)
      position(1, i) = 1.2_wp
      centre(:) = closest + 0.3_wp*out/norm2(out) + [0.0_wp, 0.0_wp, 0.4_wp]
      call new_constraints(rows, 9)
      call collect_edges(surface, facets, position, centre, ball_body(0.6_wp), 0.0_wp, gap, rows)
      call check(rows%count, 1, "one side holds the sphere")
      call check(rows%gap(1), -0.1_wp, round_off, "depth")
      call check(matmul(position(:, rows%point(:, 1)), rows%weight(:, 1)), closest, 1.0e-9_wp, &
         & "closest point")
   end subroutine check_curved

   !> The gap is that of the nearest side within the search distance
   subroutine check_search_distance()
      real(wp), parameter :: height = 0.4_wp, y = 0.3_wp

      call begin("collect_edges, gap")
      call find_gap([1.3_wp, y, height], 0.4_wp)
      call check(gap, 0.1_wp, round_off, "gap to the edge")
      call find_gap([0.7_wp, y, height], 0.6_wp)
      call check(gap, -0.1_wp, round_off, "depth of the edge")
      call find_gap([1.0_wp, y, height], 0.6_wp)
      call check(gap > 1.0_wp, "the centre is above the side")
      call find_gap([1.3_wp, y, height], 0.2_wp)
      call check(gap > 1.0_wp, "the edge is beyond the search distance")
   end subroutine check_search_distance

   !> Gap of a sphere, without rows
   subroutine find_gap(centre, radius)
      real(wp), intent(in) :: centre(3), radius

      call collect_edges(surface, facets, flat, centre, ball_body(radius), 0.2_wp, gap)
   end subroutine find_gap

   !> A vector turned by quarter turns about z: that of side 2 to another side
   pure function turned(vector, side) result(other)
      real(wp), intent(in) :: vector(3)
      integer, intent(in) :: side
      real(wp) :: other(3)

      integer :: k

      other(:) = vector
      do k = 1, modulo(side - 2, 4)
         other(:) = [-other(2), other(1), other(3)]
      end do
   end function turned

end program test_contact_search_free_edge
