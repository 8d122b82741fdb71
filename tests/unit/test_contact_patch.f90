!> Patches in contact: tributary areas, uniform pressure, a row between points, sums of pairs.
program test_contact_patch
   use plydyn_base_precision, only : wp
   use plydyn_contact_patch, only : contact_patch_type, new_patch, point_areas
   use plydyn_contact_solve_constraint, only : constraints_type, correction_type, &
      & new_constraints, new_correction
   use sample, only : flat_surface
   use testing, only : begin, check, finish
   implicit none

   !> 2 x 2 squares of side one with nine points each, the middle at the origin
   integer, parameter :: squares = 2, points = (2*squares + 1)**2
   real(wp), parameter :: dt = 2.0_wp, round_off = 1.0e-13_wp

   integer :: facet(9, squares**2)
   real(wp) :: area(points), position(3, points)

   call flat_surface(squares, position, facet)
   area(:) = point_areas(facet, position)
   call test_areas()
   call test_uniform()
   call test_row()
   call finish()

contains

   !> Simpson's rule: 1/36 at corners, 4/36 at sides, 16/36 in the middle of each square
   subroutine test_areas()
      call begin("point_areas")
      call check(sum(area), real(squares**2, wp), round_off, "the area of the surface")
      call check(area(1), 1.0_wp/36.0_wp, round_off, "corner of one square")
      call check(area(2), 4.0_wp/36.0_wp, round_off, "side of one square")
      call check(area((points + 1)/2), 4.0_wp/36.0_wp, round_off, "corner of four squares")
      call check(area(7), 16.0_wp/36.0_wp, round_off, "middle of a square")
   end subroutine test_areas

   !> Forces of a uniform pressure, point by point
   subroutine test_uniform()
      real(wp), parameter :: pressure = 3.0_wp
      type(constraints_type) :: rows
      type(contact_patch_type) :: patch
      type(correction_type) :: correction
      integer :: k

      call begin("new_patch, uniform")
      call new_constraints(rows, 1)
      call new_correction(correction, points)
      correction%displacement(3, :) = -0.5_wp
      do k = 1, points
         ! the left half alone
         if (position(1, k) > 0.1_wp) cycle
         call add_point(rows, k, pressure*area(k)*dt**2)
      end do
      patch = new_patch(rows, area, position, correction, dt)
      call check(patch%rows, rows%count, "all rows press")
      call check(patch%largest_pressure, pressure, round_off*pressure, "the pressure")
      call check(patch%force, pressure*patch%area, round_off*patch%force, "force over area")
      call check(patch%centre(2:3), [0.0_wp, -0.5_wp], round_off, "centre on the moved face")
      ! the points on the line x = 0 have half of their area on the other side
      call check(patch%centre(1)*patch%area, sum(position(1, :)*area, position(1, :) < 0.1_wp), &
         & round_off, "centre of the area")
   end subroutine test_uniform

   !> A row of a contact node in the middle of a side: its force is at the point there
   subroutine test_row()
      type(constraints_type) :: rows
      type(contact_patch_type) :: patch
      type(correction_type) :: correction

      call begin("new_patch, row")
      call new_constraints(rows, 9)
      call new_correction(correction, points)
      call rows%add(5, 6.0_wp*dt**2)
      rows%point(:, 1) = facet(:, 1)
      rows%weight(:, 1) = [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.5_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.5_wp]
      call rows%add(6, 0.0_wp)
      rows%point(:, 2) = facet(:, 2)
      rows%weight(:, 2) = [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
      patch = new_patch(rows, area, position, correction, dt)
      call check(patch%rows, 1, "a row without force is not counted")
      call check(patch%area, area(facet(5, 1)) + area(facet(9, 1)), round_off, "points with force")
      call check(patch%largest_pressure, 3.0_wp/area(facet(5, 1)), 1.0e-11_wp, "on the smaller one")
      call check(patch%centre, 0.5_wp*(position(:, facet(5, 1)) + position(:, facet(9, 1))), &
         & round_off, "the place of the node")
      rows%count = 0
      patch = new_patch(rows, area, position, correction, dt)
      call check(patch%area, 0.0_wp, 0.0_wp, "no row, no patch")
   end subroutine test_row

   !> Add a row of one point
   subroutine add_point(rows, k, multiplier)
      type(constraints_type), intent(inout) :: rows
      integer, intent(in) :: k
      real(wp), intent(in) :: multiplier

      call rows%add(k, multiplier)
      rows%point(1, rows%count) = k
      rows%weight(1, rows%count) = 1.0_wp
   end subroutine add_point

end program test_contact_patch
