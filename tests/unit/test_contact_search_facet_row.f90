!> Rows at kinks between facets: the mean of the normals there.
program test_contact_search_facet_row
   use plydyn_base_precision, only : wp
   use plydyn_contact_search_facet_row, only : normal_at_kink, set_row
   use plydyn_contact_search_surface, only : closest_point_type, new_surface, surface_type
   use plydyn_contact_solve_constraint, only : constraints_type, new_constraints
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: round_off = 1.0e-14_wp
   !> Four squares around the origin, counter-clockwise from the one at -x, -y
   integer, parameter :: facet(4, 4) = reshape( &
      & [1, 2, 5, 4, 2, 3, 6, 5, 5, 6, 9, 8, 4, 5, 8, 7], [4, 4])
   real(wp), parameter :: slope = 0.3_wp

   call check_edge()
   call check_corner()
   call check_free_edge()
   call check_row()
   call finish()

contains

   !> Nine points of a square of side two, raised by the slope times |x|
   function valley() result(position)
      real(wp) :: position(3, 9)

      integer :: i

      do i = 1, 9
         position(:2, i) = [real(mod(i - 1, 3) - 1, wp), real((i - 1)/3 - 1, wp)]
         position(3, i) = slope*abs(position(1, i))
      end do
   end function valley

   !> On an edge between two facets
   subroutine check_edge()
      type(surface_type) :: surface
      real(wp) :: position(3, 9)

      call begin("normal_at_kink, edge")
      position(:, :) = valley()
      call new_surface(surface, facet, 9, 1)
      call check(normal_at_kink(surface, position, at(1, 1.0_wp, -0.2_wp)), &
         & [0.0_wp, 0.0_wp, 1.0_wp], round_off, "the mean of both sides")
      ! inclined along the edge, too
      position(3, :) = position(3, :) + 0.4_wp*position(2, :)
      call check(normal_at_kink(surface, position, at(2, -1.0_wp, 0.1_wp)), &
         & [0.0_wp, -0.4_wp, 1.0_wp]/sqrt(1.16_wp), round_off, "perpendicular to the edge")
      call new_surface(surface, facet, 9, -1)
      call check(normal_at_kink(surface, position, at(2, -1.0_wp, 0.1_wp)), &
         & [0.0_wp, 0.4_wp, -1.0_wp]/sqrt(1.16_wp), round_off, "of the bottom face")
   end subroutine check_edge

   !> On the corner of four facets, from each of them
   subroutine check_corner()
      real(wp), parameter :: ends(2, 4) = reshape( &
         & [1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp, -1.0_wp], [2, 4])
      type(surface_type) :: surface
      real(wp) :: position(3, 9)
      integer :: f

      call begin("normal_at_kink, corner")
      position(:, :) = valley()
      position(3, :) = position(3, :) + slope*abs(position(2, :))
      call new_surface(surface, facet, 9, 1)
      do f = 1, 4
         call check(normal_at_kink(surface, position, at(f, ends(1, f), ends(2, f))), &
            & [0.0_wp, 0.0_wp, 1.0_wp], round_off, "the mean of four")
      end do
   end subroutine check_corner

   !> A free edge may be a plane of symmetry
   subroutine check_free_edge()
      type(surface_type) :: surface
      real(wp) :: position(3, 9)

      call begin("normal_at_kink, free edge")
      position(:, :) = valley()
      call new_surface(surface, facet, 9, 1)
      call check(normal_at_kink(surface, position, at(1, -1.0_wp, 0.3_wp)), &
         & [0.0_wp, 0.0_wp, 1.0_wp], round_off, "mirrored in the plane x = -1")
      call check(normal_at_kink(surface, position, at(1, 0.2_wp, -1.0_wp)), &
         & [slope, 0.0_wp, 1.0_wp]/sqrt(1.0_wp + slope**2), round_off, "in the plane y = -1")
      call check(normal_at_kink(surface, position, at(1, 1.0_wp, -1.0_wp)), &
         & [0.0_wp, 0.0_wp, 1.0_wp], round_off, "where the edge between two ends")
      call check(normal_at_kink(surface, position, at(1, -1.0_wp, -1.0_wp)), &
         & [0.0_wp, 0.0_wp, 1.0_wp], round_off, "at the corner of two planes")
   end subroutine check_free_edge

   !> Gap and weights of a row near the edge
   subroutine check_row()
      real(wp), parameter :: along = sqrt(1.0_wp + slope**2), depth = 0.01_wp
      type(surface_type) :: surface
      type(constraints_type) :: rows
      type(closest_point_type) :: closest
      real(wp) :: position(3, 9)

      call begin("set_row")
      position(:, :) = valley()
      call new_surface(surface, facet, 9, 1)
      call new_constraints(rows, 4)
      call rows%add(1, 0.0_wp)
      closest = at(1, 1.0_wp - 1.0e-5_wp, 0.0_wp)
      closest%normal(:) = [slope, 0.0_wp, 1.0_wp]/along
      closest%gap_vector(:) = -depth*closest%normal
      call set_row(surface, position, closest, rows, 1)
      call check(rows%gap(1), -depth/along, round_off, "along the mean normal")
      call check(rows%weight(:, 1), [0.0_wp, 0.5_wp, 0.5_wp, 0.0_wp], round_off, "on the edge")
      closest%local(1) = 0.5_wp
      call set_row(surface, position, closest, rows, 1)
      call check(rows%gap(1), -depth, round_off, "along the normal of the facet")
      call check(rows%normal(:, 1), closest%normal, round_off, "which it takes")
   end subroutine check_row

   !> A point of a facet
   pure type(closest_point_type) function at(number, xi, eta) result(closest)
      integer, intent(in) :: number
      real(wp), intent(in) :: xi, eta

      closest%facet = number
      closest%local(:) = [xi, eta]
   end function at

end program test_contact_search_facet_row
