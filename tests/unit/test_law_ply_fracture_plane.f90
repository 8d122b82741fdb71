!> Plane of fracture: its angle and its onset under stresses of which the strength is known, and
!> that it turns with the stress about the fibres.
program test_law_ply_fracture_plane
   use fracture_point, only : fracture_ply, fracture_point_type, new_fracture_point
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_fracture_constants, only : fracture_batch_type, fracture_constants_type
   use plydyn_law_ply_fracture_fibres, only : fibres_type
   use plydyn_law_ply_fracture_history, only : matrix_damage, plane_cosine, plane_sine
   use plydyn_law_ply_fracture_plane, only : exposure_bound, find_plane, refine_plane
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp
   !> Planes are found to 15 degrees over 2**18, twice which the search may be off
   real(wp), parameter :: angle_error = 15.0_wp/2.0_wp**17
   !> What such an angle costs of the exposure, and round-off
   real(wp), parameter :: exposure_error = 1.0e-8_wp

   call test_uniaxial()
   call test_strength_across()
   call test_turned()
   call test_bound()
   call test_plane_is_kept()
   call finish()

contains

   !> Angle and exposure of the most exposed plane of a stress
   subroutine find(ply, stress, angle, exposure)
      type(fracture_constants_type), intent(in) :: ply
      real(wp), intent(in) :: stress(6)
      real(wp), intent(out) :: angle, exposure

      type(fracture_batch_type) :: batch
      real(wp) :: c(lanes), all_lanes(lanes), s(lanes), stresses(lanes, 6)
      integer :: l

      do l = 1, lanes
         call batch%set_lane(l, ply)
      end do
      stresses(:, :) = spread(stress, 1, lanes)
      call find_plane(batch, stresses, c, s, all_lanes)
      call refine_plane(batch, stresses, c, s, all_lanes)
      angle = atan2(s(1), c(1))/degree
      exposure = all_lanes(1)
   end subroutine find

   !> Tension opens the plane across it, compression shears that of the card, at YT and YC
   subroutine test_uniaxial()
      type(fracture_constants_type) :: ply
      real(wp) :: angle, exposure
      integer :: i

      ply = fracture_ply()
      call begin("uniaxial stress across the fibres")
      call find(ply, [0.0_wp, 62.3_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], angle, exposure)
      call check(angle, 0.0_wp, angle_error, "tension opens the plane 1-3")
      call check(exposure, 1.0_wp, exposure_error, "at YT")
      do i = 50, 56, 3
         ply%fracture_angle = real(i, wp)
         call find(ply, [0.0_wp, -199.8_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], angle, exposure)
         call check(abs(angle), real(i, wp), angle_error, "compression shears its plane")
         call check(exposure, 1.0_wp, exposure_error, "at YC")
      end do
      ! in-situ strengths: YT beyond the shear strength still opens a plane across the tension
      ply = fracture_ply()
      ply%matrix_strength(1) = 160.1_wp
      call find(ply, [0.0_wp, 160.1_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], angle, exposure)
      call check(angle, 0.0_wp, angle_error, "tension of a ply that others constrain")
      call check(exposure, 1.0_wp, exposure_error, "at its YT")
      ply = fracture_ply()
      call find(ply, [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 92.3_wp, 0.0_wp], angle, exposure)
      call check(abs(angle), 90.0_wp, angle_error, "shear 13 splits the plane 1-2")
      call check(exposure, 1.0_wp, exposure_error, "at S12")
   end subroutine test_uniaxial

   !> Shear strength across the fibres of IM7/8552: 75.3 MPa of YC 199.8 MPa and 53 degrees
   subroutine test_strength_across()
      type(fracture_constants_type) :: ply

      ply = fracture_ply()
      call begin("strength across the fibres")
      call check(ply%cross_strength(), 75.3_wp, 0.05_wp, "as published")
      ! at alpha both measures of friction are -1/tan(2 alpha) = eta over the strength
      call check(ply%pressure_gain()*ply%cross_strength(), -1.0_wp/tan(106.0_wp*degree), &
         & 1.0e-14_wp, "friction is that of the angle")
   end subroutine test_strength_across

   !> A stress turned about the fibres has its plane turned with it, and the same exposure
   subroutine test_turned()
      type(fracture_constants_type) :: ply
      real(wp), parameter :: stress(6, 3) = reshape([ &
         & 0.0_wp, 40.0_wp, -30.0_wp, 50.0_wp, 10.0_wp, 15.0_wp, &
         & 0.0_wp, -180.0_wp, -30.0_wp, 20.0_wp, 35.0_wp, -25.0_wp, &
         & 0.0_wp, -60.0_wp, 30.0_wp, -70.0_wp, 0.0_wp, 20.0_wp], [6, 3])
      real(wp) :: angle, exposure, first, most, turn
      integer :: i, k

      ply = fracture_ply()
      call begin("turned about the fibres")
      do k = 1, 3
         call find(ply, stress(:, k), first, most)
         do i = 1, 7
            turn = 23.0_wp*i
            call find(ply, turned(stress(:, k), turn*degree), angle, exposure)
            call check(exposure, most, exposure_error, "the same exposure")
            ! the exposure is flat at its largest: 1e-16 of it is 1e-8 of a radian
            call check(modulo(angle - first - turn + 90.0_wp, 180.0_wp) - 90.0_wp, 0.0_wp, &
               & 2.0_wp*angle_error, "the plane turns with the stress")
         end do
      end do
   end subroutine test_turned

   !> Stress in axes whose 2 and 3 are turned back, so that the state is turned by an angle
   pure function turned(stress, angle) result(now)
      real(wp), intent(in) :: stress(6), angle
      real(wp) :: now(6)

      real(wp) :: r(3, 3), s(3, 3)

      s(:, :) = reshape([stress([1, 4, 5]), stress([4, 2, 6]), stress([5, 6, 3])], [3, 3])
      r(:, :) = 0.0_wp
      r(1, 1) = 1.0_wp
      r(2, 2:) = [cos(angle), -sin(angle)]
      r(3, 2:) = [sin(angle), cos(angle)]
      s(:, :) = matmul(r, matmul(s, transpose(r)))
      now(:) = [s(1, 1), s(2, 2), s(3, 3), s(1, 2), s(1, 3), s(2, 3)]
   end function turned

   !> No plane is more exposed than the bound that saves the search
   subroutine test_bound()
      type(fracture_constants_type) :: ply
      type(fracture_batch_type) :: batch
      type(fibres_type) :: fibres
      real(wp) :: angle, energy(lanes), exposure, random(6), strength(lanes)
      integer :: i, l
      logical :: holds

      ply = fracture_ply()
      do l = 1, lanes
         call batch%set_lane(l, ply)
      end do
      fibres%after(:) = 1.0_wp
      fibres%sheared(:) = 1.0_wp
      call begin("bound of the exposure")
      holds = .true.
      do i = 1, 500
         call random_number(random)
         random(:) = 200.0_wp*(random - 0.5_wp)
         call find(ply, random, angle, exposure)
         call exposure_bound(batch, spread(random, 1, lanes), fibres, strength, energy)
         holds = holds .and. exposure**2 <= strength(1)*(1.0_wp + 1.0e-12_wp)
      end do
      call check(holds, "it is never exceeded")
   end subroutine test_bound

   !> A point keeps its plane, whatever comes
   subroutine test_plane_is_kept()
      type(fracture_point_type) :: point
      real(wp) :: kept(2)

      call begin("a plane once made")
      point = new_fracture_point(fracture_ply(), [0.5_wp, 0.1_wp])
      ! onset at 199.8/9080 = 0.022004; beyond it by a share of 7e-4 at most, the whole plane has
      ! that share of a lateral stress, and so many radians its angle
      call point%pull(2, -0.02200_wp, 20)
      call point%pull(2, -0.02202_wp, 2)
      call check(abs(point%angle()), 53.0_wp, 7.0e-4_wp/degree, "compression shears its plane")
      kept(:) = point%history([plane_cosine, plane_sine])
      call check(point%history(matrix_damage) > 0.0_wp, "and damages it")
      call point%lead([0.0_wp, 0.02_wp, 0.0_wp, 0.03_wp, 0.0_wp, 0.0_wp], 50)
      call check(maxval(abs(point%history([plane_cosine, plane_sine]) - kept)), 0.0_wp, 0.0_wp, &
         & "stays where it is")
   end subroutine test_plane_is_kept

end program test_law_ply_fracture_plane
