!> Points near a fixture: whatever touches it is listed, and lists last for hundreds of steps.
program test_contact_search_near_points
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_flat_body, only : flat_body_type, rectangle_outline
   use plydyn_contact_search_near_points, only : near_points_type, new_near_points
   use testing, only : begin, check, finish
   implicit none

   !> Points of a sheet, how far each moves in a step, and the steps
   integer, parameter :: side = 41, points = side**2, steps = 1200
   real(wp), parameter :: move = 1.0e-3_wp
   type(flat_body_type) :: base
   real(wp) :: place(3, points)

   base = flat_body_type(upward=1, edge=0.2_wp, outlines=[ &
      & rectangle_outline([0.0_wp, 0.0_wp], [6.0_wp, 4.0_wp], 0.5_wp, .true.)])
   call check_walk()
   call check_reach()
   call check_all()
   call finish()

contains

   !> A sheet slides over a window and sinks into it: all move alike, so that each bound is met
   subroutine check_walk()
      type(near_points_type) :: near
      integer :: made, step, touching
      logical :: misses

      call begin("approach")
      near = new_near_points(points)
      call lay_sheet()
      made = 0
      touching = 0
      misses = .false.
      do step = 1, steps
         place(1, :) = place(1, :) + 0.6_wp*move
         place(3, :) = place(3, :) - 0.8_wp*move
         call near%approach(move)
         if (near%is_due()) made = made + 1
         if (near%is_due()) call make_list(near)
         call compare(near, touching, misses)
      end do
      call check(.not. misses, "every point that touches is listed")
      call check(touching > points, "points touch")
      ! a list lasts while the way since is not above 500 moves
      call check(made, count([(mod(step, 501) == 1, step=1, steps)]), "how often it is listed anew")
   end subroutine check_walk

   !> Over a base without an edge, points below 500 moves are within reach
   subroutine check_reach()
      type(near_points_type) :: near

      call begin("list_if_near")
      base = flat_body_type(upward=-1)
      allocate (base%outlines(0))
      near = new_near_points(points)
      call lay_sheet()
      place(3, :) = -place(3, :)
      call near%approach(move)
      call make_list(near)
      associate (within => count(place(3, :) > -500.0_wp*move))
         call check(within > 0 .and. within < points, "some points are within reach")
         call check(near%count, within, "those and no others are listed")
      end associate
      call near%approach(499.0_wp*move)
      call check(.not. near%is_due(), "moves below the reach")
      call near%push(2.0_wp*move)
      call check(near%is_due(), "moves above the reach, and a push")
   end subroutine check_reach

   !> Without a bound on the motion all are listed, and again in the next step
   subroutine check_all()
      type(near_points_type) :: near
      integer :: i

      call begin("list_all")
      near = new_near_points(3)
      call near%list_all([2, 5, 9])
      call check(near%count == 3 .and. all(near%point == [2, 5, 9]), "all points")
      do i = 1, 2
         call near%approach(0.0_wp)
         call check(near%is_due(), "due in every step")
      end do
   end subroutine check_all

   !> A sheet of 8 by 8 in waves, above the face
   subroutine lay_sheet()
      integer :: i, j

      do j = 1, side
         do i = 1, side
            place(:, i + side*(j - 1)) = [0.2_wp*(i - 21), 0.2_wp*(j - 21), &
               & 0.45_wp + 0.4_wp*sin(0.7_wp*i)]
         end do
      end do
   end subroutine lay_sheet

   !> List the points anew
   subroutine make_list(near)
      type(near_points_type), intent(inout) :: near
      integer :: i

      call near%list_none()
      do i = 1, points
         call near%list_if_near(base, i, place(:, i))
      end do
   end subroutine make_list

   !> Count the points that touch, and look for one that is not listed
   subroutine compare(near, touching, misses)
      type(near_points_type), intent(in) :: near
      integer, intent(inout) :: touching
      logical, intent(inout) :: misses

      real(wp) :: gap, normal(3)
      integer :: i

      do i = 1, points
         call base%find_gap(place(:, i), gap, normal)
         if (gap >= 0.0_wp) cycle
         touching = touching + 1
         misses = misses .or. all(near%point(:near%count) /= i)
      end do
   end subroutine compare

end program test_contact_search_near_points
