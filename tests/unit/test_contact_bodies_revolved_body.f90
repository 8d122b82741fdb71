!> Gaps and normals of bodies of revolution, against closed forms.
program test_contact_bodies_revolved_body
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_revolved_body, only : cone_body, cylinder_body, revolved_body_type, &
      & sphere_body, tup_body
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: round_off = 1.0e-12_wp
   type(revolved_body_type) :: body

   call check_sphere()
   call check_tup()
   call check_cylinder()
   call check_cone()
   call check_gradient()
   call check_volume()
   call finish()

contains

   !> Distance from the sphere, with its sign, and its height above points
   subroutine check_sphere()
      call begin("sphere_body")
      body = upright(sphere_body(10.0_wp))
      call check_gap([0.0_wp, 0.0_wp, -10.5_wp], 0.5_wp, [0.0_wp, 0.0_wp, 1.0_wp], "below the pole")
      call check_gap([-4.0_wp, 0.0_wp, -3.0_wp], -5.0_wp, [0.8_wp, 0.0_wp, 0.6_wp], "inside")
      call check_gap([0.0_wp, 0.0_wp, 0.0_wp], -10.0_wp, [0.0_wp, 0.0_wp, 0.0_wp], "at its centre")
      call check(body%vertical_gap([6.0_wp, 0.0_wp, 9.0_wp], 1), 1.0_wp, round_off, &
         & "from a point up to the underside")
      call check(body%vertical_gap([0.0_wp, 0.0_wp, -3.0_wp], 1), -13.0_wp, round_off, &
         & "a plate that should be below is penetrated")
      call check(body%vertical_gap([0.0_wp, 0.0_wp, 3.0_wp], -1), -13.0_wp, round_off, "above")
      call check(body%vertical_gap([30.0_wp, 0.0_wp, 0.0_wp], 1) > 1.0e9_wp, "beside")
   end subroutine check_sphere

   !> A hemisphere below, a rod above
   subroutine check_tup()
      call begin("tup_body")
      body = upright(tup_body(10.0_wp, 0.0_wp))
      call check_gap([8.0_wp, 0.0_wp, -6.0_wp], 0.0_wp, [-0.8_wp, 0.0_wp, 0.6_wp], "hemisphere")
      call check_gap([0.0_wp, 12.0_wp, 70.0_wp], 2.0_wp, [0.0_wp, -1.0_wp, 0.0_wp], "rod")
      call check(body%lowest_height(1), -10.0_wp, round_off, "its tip")
   end subroutine check_tup

   !> Faces, wall and round edge, upright and lying
   subroutine check_cylinder()
      call begin("cylinder_body")
      body = upright(cylinder_body(5.0_wp, 8.0_wp, 1.0_wp))
      call check_gap([2.0_wp, 1.0_wp, -4.25_wp], 0.25_wp, [0.0_wp, 0.0_wp, 1.0_wp], "face")
      call check_gap([3.0_wp, 0.0_wp, -3.75_wp], -0.25_wp, [0.0_wp, 0.0_wp, 1.0_wp], "in the face")
      call check_gap([0.0_wp, 6.0_wp, 1.0_wp], 1.0_wp, [0.0_wp, -1.0_wp, 0.0_wp], "wall")
      call check_gap([4.0_wp + 1.2_wp, 0.0_wp, -3.0_wp - 1.6_wp], 1.0_wp, &
         & [-0.6_wp, 0.0_wp, 0.8_wp], "edge")
      call check(body%lowest_height(1), -4.0_wp, round_off, "its face")
      body%axis(:) = [1.0_wp, 0.0_wp, 0.0_wp]
      call check(body%lowest_height(1), -5.0_wp, round_off, "lying")
      call check_gap([2.0_wp, 0.0_wp, -5.5_wp], 0.5_wp, [0.0_wp, 0.0_wp, 1.0_wp], "side, lying")
      call check_gap([4.5_wp, 1.0_wp, 0.0_wp], 0.5_wp, [-1.0_wp, 0.0_wp, 0.0_wp], "end, lying")
      body = upright(cylinder_body(5.0_wp, 8.0_wp, 0.0_wp))
      call check_gap([4.0_wp, 0.0_wp, -3.5_wp], -0.5_wp, [0.0_wp, 0.0_wp, 1.0_wp], "sharp, inside")
      call check_gap([8.0_wp, 0.0_wp, -8.0_wp], 5.0_wp, [-0.6_wp, 0.0_wp, 0.8_wp], "sharp edge")
   end subroutine check_cylinder

   !> Side and round tip, whose centre lies a radius over the sine of the angle above the sharp tip
   subroutine check_cone()
      real(wp), parameter :: angle = atan(0.75_wp), tip = 1.0_wp, across = 4.0_wp - tip

      call begin("cone_body")
      body = upright(cone_body(4.0_wp, angle, tip, 0.0_wp))
      call check(body%lowest_height(1), -across/0.75_wp - tip, round_off, "its tip")
      call check_gap([0.0_wp, 0.0_wp, -across/0.75_wp - 3.0_wp], 2.0_wp, &
         & [0.0_wp, 0.0_wp, 1.0_wp], "below the tip")
      ! half-way along the side of the core, whose normal is (0.8, -0.6)
      call check_gap([0.5_wp*across + 0.8_wp*1.5_wp, 0.0_wp, -0.5_wp*across/0.75_wp &
         & - 0.6_wp*1.5_wp], 0.5_wp, [-0.8_wp, 0.0_wp, 0.6_wp], "side")
      call check_gap([0.0_wp, -7.0_wp, 9.0_wp], 3.0_wp, [0.0_wp, 1.0_wp, 0.0_wp], "rod")
      body = upright(cone_body(4.0_wp, angle, 0.0_wp, 0.0_wp))
      call check(body%vertical_gap([3.0_wp, 0.0_wp, 2.0_wp], 1), 2.0_wp - 1.0_wp/0.75_wp, &
         & round_off, "sharp, above a point")
   end subroutine check_cone

   !> The normal is the negative gradient of the gap, for a body that leans
   subroutine check_gradient()
      real(wp), parameter :: step = 1.0e-6_wp
      real(wp) :: gap(2), normal(3), other(3), place(3), shifted(3)
      integer :: c, k

      call begin("find_gap")
      do k = 1, 30
         body = cone_body(3.0_wp, 0.8_wp, 0.4_wp, 0.0_wp)
         if (k > 15) body = cylinder_body(3.0_wp, 5.0_wp, 0.5_wp)
         body%axis(:) = [0.48_wp, 0.6_wp, 0.64_wp]
         place(:) = [6.0_wp*sin(1.0_wp*k), 5.0_wp*cos(1.3_wp*k), -3.0_wp + 0.1_wp*k]
         call body%find_gap(place, gap(1), normal)
         do c = 1, 3
            shifted(:) = place
            shifted(c) = shifted(c) + step
            call body%find_gap(shifted, gap(1), other)
            shifted(c) = shifted(c) - 2.0_wp*step
            call body%find_gap(shifted, gap(2), other)
            ! the arm from the point to the centre shrinks where the point approaches
            call check((gap(1) - gap(2))/(2.0_wp*step), normal(c), 1.0e-5_wp, "gradient")
         end do
      end do
   end subroutine check_gradient

   !> Volumes: a ball, a rod with a hemisphere, a cylinder by Steiner's formula, a cone with a rod,
   !> and a round tip by the cap and the frustum of its cone
   subroutine check_volume()
      real(wp), parameter :: pi = acos(-1.0_wp), angle = atan(0.75_wp)

      call begin("volume")
      body = sphere_body(2.0_wp)
      call check(body%volume(), 4.0_wp/3.0_wp*pi*8.0_wp, round_off*40.0_wp, "ball")
      body = tup_body(2.0_wp, 5.0_wp)
      call check(body%volume(), 2.0_wp/3.0_wp*pi*8.0_wp + 20.0_wp*pi, round_off*100.0_wp, "tup")
      body = cylinder_body(3.0_wp, 7.0_wp, 0.0_wp)
      call check(body%volume(), 63.0_wp*pi, round_off*200.0_wp, "sharp cylinder")
      body = cylinder_body(3.0_wp, 7.0_wp, 1.0_wp)
      ! volume, surface and mean curvature of the core of radius 2 and length 5
      call check(body%volume(), 20.0_wp*pi + 28.0_wp*pi + (5.0_wp*pi + 2.0_wp*pi**2) &
         & + 4.0_wp/3.0_wp*pi, round_off*200.0_wp, "round cylinder")
      body = cone_body(3.0_wp, angle, 0.0_wp, 6.0_wp)
      call check(body%volume(), 12.0_wp*pi + 54.0_wp*pi, round_off*200.0_wp, "sharp cone")
   end subroutine check_volume

   !> Gap and normal of a point relative to the centre
   subroutine check_gap(place, gap, normal, what)
      real(wp), intent(in) :: place(3), gap, normal(3)
      character(*), intent(in) :: what

      real(wp) :: found, towards(3)

      call body%find_gap(-place, found, towards)
      call check(found, gap, round_off, what)
      call check(towards, normal, round_off, what//", normal")
   end subroutine check_gap

   !> A body with its tip down
   pure type(revolved_body_type) function upright(shape) result(turned)
      type(revolved_body_type), intent(in) :: shape

      turned = shape
      turned%axis(:) = [0.0_wp, 0.0_wp, 1.0_wp]
   end function upright

end program test_contact_bodies_revolved_body
