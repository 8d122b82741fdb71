!> Outlines and rounded edges of the bodies of fixtures.
program test_contact_bodies_flat_body
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_flat_body, only : circle_outline, flat_body_type, outline_type, &
      & rectangle_outline, strip_outline
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: round_off = 1.0e-13_wp

   call check_rectangle()
   call check_strip()
   call check_window()
   call check_ring()
   call finish()

contains

   !> Depth of a place within an outline, whose gradient is the direction that comes with it
   subroutine check_depth(outline, place, expected, what)
      type(outline_type), intent(in) :: outline
      real(wp), intent(in) :: place(2), expected
      character(*), intent(in) :: what

      real(wp), parameter :: small = 1.0e-6_wp
      real(wp) :: ahead, depth, inward(2), unused(2)

      call outline%find_depth(place, depth, inward)
      call check(depth, expected, round_off, what)
      call check(norm2(inward), 1.0_wp, round_off, what//": unit direction")
      call outline%find_depth(place + small*inward, ahead, unused)
      call check((ahead - depth)/small, 1.0_wp, 1.0e-8_wp, what//": the depth grows along it")
   end subroutine check_depth

   !> A rectangle of 6 by 4 with corners of radius 1, from within and as a window
   subroutine check_rectangle()
      type(outline_type) :: outline

      call begin("rectangle_outline")
      outline = rectangle_outline([10.0_wp, 20.0_wp], [6.0_wp, 4.0_wp], 1.0_wp, .false.)
      call check_depth(outline, [12.5_wp, 20.0_wp], 0.5_wp, "inside, near the right side")
      call check_depth(outline, [10.0_wp, 17.0_wp], -1.0_wp, "outside, below")
      ! the centre of the corner lies at (12, 21)
      call check_depth(outline, [15.0_wp, 25.0_wp], -4.0_wp, "outside, beyond a corner")
      call check_depth(outline, [12.0_wp + 0.3_wp, 21.0_wp + 0.4_wp], 0.5_wp, "inside a corner")
      outline%is_hole = .true.
      call check_depth(outline, [15.0_wp, 25.0_wp], 4.0_wp, "beside a window")
      call check_depth(outline, [12.5_wp, 20.0_wp], -0.5_wp, "in a window")
   end subroutine check_rectangle

   !> A strip along the diagonal
   subroutine check_strip()
      type(outline_type) :: outline

      call begin("strip_outline")
      outline = strip_outline([0.0_wp, 0.0_wp], [3.0_wp, 4.0_wp], 0.5_wp)
      call check_depth(outline, [1.5_wp - 0.8_wp, 2.0_wp + 0.6_wp], -0.5_wp, "beside the strip")
      call check_depth(outline, [4.2_wp, 5.6_wp], -1.5_wp, "beyond its end")
   end subroutine check_strip

   !> A plane with a round window of radius 10 and edges of radius 2, below the plate and above it
   subroutine check_window()
      type(flat_body_type) :: body
      real(wp) :: gap, normal(3)

      call begin("find_gap")
      body%outlines = [circle_outline([0.0_wp, 0.0_wp], 10.0_wp, .true.)]
      body%edge = 2.0_wp
      call body%find_gap([12.0_wp, 0.0_wp, -0.25_wp], gap, normal)
      call check(gap, -0.25_wp, round_off, "penetration of the flat face")
      call check(normal, [0.0_wp, 0.0_wp, 1.0_wp], 0.0_wp, "along z")
      ! the circle of the edge has its centre at r = 12, z = -2
      call body%find_gap([0.0_wp, 12.0_wp - 1.2_wp*1.5_wp, -2.0_wp + 1.6_wp*1.5_wp], gap, normal)
      call check(gap, 1.0_wp, round_off, "distance from the edge")
      call check(normal, [0.0_wp, -0.6_wp, 0.8_wp], round_off, "across the edge")
      call body%find_gap([-(12.0_wp - 0.6_wp), 0.0_wp, -2.0_wp + 0.8_wp], gap, normal)
      call check(gap, -1.0_wp, round_off, "penetration of the edge")
      call check(normal, [0.6_wp, 0.0_wp, 0.8_wp], round_off, "out of the edge")
      call body%find_gap([10.5_wp, 0.0_wp, -5.0_wp], gap, normal)
      call check(gap, -0.5_wp, round_off, "penetration of the wall of the window")
      call check(normal, [-1.0_wp, 0.0_wp, 0.0_wp], round_off, "into the window")
      call body%find_gap([9.0_wp, 0.0_wp, -5.0_wp], gap, normal)
      call check(gap, 1.0_wp, round_off, "the plate may hang into the window")
      body%upward = -1
      call body%find_gap([-(12.0_wp - 0.6_wp), 0.0_wp, 2.0_wp - 0.8_wp], gap, normal)
      call check(gap, -1.0_wp, round_off, "the same above the plate")
      call check(normal, [0.6_wp, 0.0_wp, -0.8_wp], round_off, "which is pushed down")
   end subroutine check_window

   !> A ring with sharp edges carries the points on its circles, and none beside them
   subroutine check_ring()
      type(flat_body_type) :: body
      real(wp) :: angle, gap, normal(3)
      integer :: i

      call begin("ring")
      body%outlines = [circle_outline([0.0_wp, 0.0_wp], 8.0_wp, .false.), &
         & circle_outline([0.0_wp, 0.0_wp], 5.0_wp, .true.)]
      do i = 1, 50
         angle = 0.37_wp*i
         call body%find_gap([5.0_wp*cos(angle), 5.0_wp*sin(angle), -0.1_wp], gap, normal)
         call check(gap, -0.1_wp, round_off, "on the inner circle")
         call body%find_gap([8.0_wp*cos(angle), 8.0_wp*sin(angle), -0.1_wp], gap, normal)
         call check(gap, -0.1_wp, round_off, "on the outer circle")
         call body%find_gap([4.99_wp*cos(angle), 4.99_wp*sin(angle), -0.1_wp], gap, normal)
         call check(gap > 0.0_wp, "within the inner circle")
      end do
      call begin("covers")
      call check(body%covers([0.0_wp, 6.0_wp]), "a place between the circles")
      call check(body%covers([8.0_wp, 0.0_wp]), "one on a circle")
      call check(.not. body%covers([0.0_wp, 4.9_wp]), "none in the hole")
      call check(.not. body%covers([8.1_wp, 0.0_wp]), "none beside the ring")
   end subroutine check_ring

end program test_contact_bodies_flat_body
