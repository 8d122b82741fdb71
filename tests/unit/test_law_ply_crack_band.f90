!> The width of the crack band is what a straight line through the quad says.
program test_law_ply_crack_band
   use plydyn_base_precision, only : wp
   use plydyn_law_ply_crack_band, only : band_length, brick_band_length, longest_length, &
      & rule_band, &
      & rule_gauss_point, rule_root_point, rule_root_quad, share_bilinear, share_biquadratic
   use testing, only : begin, check, finish
   implicit none

   !> Weights of the middle point of a line of three, and of its ends
   real(wp), parameter :: middle = 8.0_wp/9.0_wp, outer = 5.0_wp/9.0_wp
   real(wp), parameter :: along_x(2) = [1.0_wp, 0.0_wp], along_y(2) = [0.0_wp, 1.0_wp]
   !> A quad of 3 by 2
   real(wp), parameter :: rectangle(2, 2) = reshape([1.5_wp, 0.0_wp, 0.0_wp, 1.0_wp], [2, 2])
   !> Sides (2, 0) and (1, 2)
   real(wp), parameter :: slanted(2, 2) = reshape([1.0_wp, 0.0_wp, 0.5_wp, 1.0_wp], [2, 2])

   !> d(xi, eta, zeta)/d(x, y, z) of a brick of 3 by 2 by 1
   real(wp), parameter :: brick(3, 3) = reshape([2.0_wp/3.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, &
      & 0.0_wp, 0.0_wp, 0.0_wp, 2.0_wp], [3, 3])
   real(wp), parameter :: x(3) = [1.0_wp, 0.0_wp, 0.0_wp], z(3) = [0.0_wp, 0.0_wp, 1.0_wp]
   real(wp), parameter :: s3 = sqrt(0.5_wp)

   real(wp) :: turned(2, 2), c, s

   call begin("band_length")
   call check(band_length(rule_band, rectangle, along_x, [middle, outer], 1.0_wp, 6.0_wp), &
      & 3.0_wp, 1.0e-14_wp, "is the side of a rectangle along it")
   call check(band_length(rule_band, rectangle, along_y, [middle, outer], share_bilinear, 6.0_wp), &
      & 2.0_wp, 1.0e-14_wp, "is the other side across it")
   call check(band_length(rule_band, rectangle, along_x, [middle, outer], share_biquadratic, &
      & 6.0_wp), 13.0_wp/6.0_wp, 1.0e-14_wp, "is 13/18 of it with 9 nodes and 3 by 3 points")
   s = sqrt(0.5_wp)
   call check(band_length(rule_band, rectangle, [s, s], [middle, outer], 1.0_wp, 6.0_wp), &
      & sqrt(8.0_wp), 1.0e-14_wp, "ends at the nearer sides on an inclined line")
   call check(band_length(rule_band, slanted, along_x, [middle, outer], 1.0_wp, 4.0_wp), 2.0_wp, &
      & 1.0e-14_wp, "is the base of a parallelogram")
   call check(band_length(rule_band, slanted, [1.0_wp, 2.0_wp]/sqrt(5.0_wp), [middle, outer], &
      & 1.0_wp, 4.0_wp), sqrt(5.0_wp), 1.0e-14_wp, "is its slanted side along that")
   c = cos(0.7_wp)
   s = sin(0.7_wp)
   turned(:, :) = matmul(reshape([c, s, -s, c], [2, 2]), slanted)
   call check(band_length(rule_band, turned, [c, s], [middle, outer], 1.0_wp, 4.0_wp), 2.0_wp, &
      & 1.0e-14_wp, "turns with the quad")
   call check(band_length(rule_band, rectangle, -along_x, [middle, outer], 1.0_wp, 6.0_wp), &
      & 3.0_wp, 1.0e-14_wp, "has no sign")

   call check(band_length(rule_gauss_point, rectangle, along_x, [middle, outer], 1.0_wp, 6.0_wp), &
      & 1.5_wp*middle, 1.0e-14_wp, "can be the length of the point's own cell")
   call check(band_length(rule_gauss_point, rectangle, along_y, [middle, outer], 1.0_wp, 6.0_wp), &
      & outer, 1.0e-14_wp, "of which there are two")
   call check(band_length(rule_root_point, slanted, along_x, [middle, outer], 1.0_wp, 4.0_wp), &
      & sqrt(middle*outer), 1.0e-14_wp, "can be the root of the area of that cell")
   call check(band_length(rule_root_quad, slanted, along_x, [middle, outer], 1.0_wp, 4.0_wp), &
      & 2.0_wp, 1.0e-14_wp, "can be the root of the area of the quad")

   ! a brick of 3 by 2 by 1 with eight points
   call begin("brick_band_length")
   call check(brick_band_length(rule_band, brick, x, z, 1.0_wp, [0.75_wp, 6.0_wp]), 3.0_wp, &
      & 1.0e-14_wp, "is the side of a brick along it")
   call check(brick_band_length(rule_band, brick, [s3, s3, 0.0_wp], z, 1.0_wp, [0.75_wp, 6.0_wp]), &
      & sqrt(8.0_wp), 1.0e-14_wp, "ends at the nearer sides on an inclined line")
   call check(brick_band_length(rule_gauss_point, brick, x, z, 1.0_wp, [0.75_wp, 6.0_wp]), &
      & 1.5_wp, 1.0e-14_wp, "can be the length of the point's own part, one of eight")
   call check(brick_band_length(rule_gauss_point, brick, x, z, 2.0_wp, [6.0_wp, 6.0_wp]), 3.0_wp, &
      & 1.0e-14_wp, "which is the brick where there is one point")
   call check(brick_band_length(rule_root_point, brick, x, z, 1.0_wp, [0.75_wp, 6.0_wp]), &
      & sqrt(1.5_wp), 1.0e-14_wp, "can be the root of the area of that part in the ply")
   call check(brick_band_length(rule_root_quad, brick, x, z, 1.0_wp, [0.75_wp, 6.0_wp]), &
      & sqrt(6.0_wp), 1.0e-14_wp, "can be the root of the area of the brick in the ply")

   call begin("longest_length")
   call check(longest_length(153.0e3_wp, 91.6_wp, 2537.0_wp), 4.355_wp, 5.0e-4_wp, &
      & "is 2 E G/X**2: fibre tension of an independent program")
   call finish()
end program test_law_ply_crack_band
