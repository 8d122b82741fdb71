!> Ratio of volumes, strain, stresses and turned axes at a point
program test_fem_kinematics
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_kinematics, only : find_cauchy, find_piola, find_strain, turn_strain, &
      & turn_stress, turn_stress_back, volume_ratios
   use testing, only : begin, check, finish
   implicit none

   !> Positions of xx, yy, zz, xy, xz, yz in a tensor; cosine and sine of an angle of 3, 4 and 5
   integer, parameter :: row(6) = [1, 2, 3, 1, 1, 2], column(6) = [1, 2, 3, 2, 3, 3]
   real(wp), parameter :: c = 0.6_wp, s = 0.8_wp, close = 1.0e-14_wp, small = 1.0e-6_wp
   !> A displacement gradient, its rate, and a stress, with no symmetry
   real(wp), parameter :: gradient(3, 3) = reshape([-0.3_wp, 0.1_wp, 0.05_wp, -0.2_wp, 0.25_wp, &
      & 0.1_wp, 0.3_wp, -0.1_wp, 0.2_wp], [3, 3])
   real(wp), parameter :: rate(3, 3) = reshape([0.3_wp, -0.7_wp, 0.2_wp, 0.5_wp, 0.1_wp, -0.4_wp, &
      & 0.6_wp, 0.2_wp, -0.9_wp], [3, 3])
   real(wp), parameter :: second(6) = [3.0_wp, -5.0_wp, 7.0_wp, 11.0_wp, -13.0_wp, 17.0_wp]
   real(wp) :: f(3, 3), h(lanes, 3, 3), p(lanes, 3, 3), turn(lanes, 2), unity(3, 3), volume
   real(wp) :: e(lanes, 6), later(lanes, 6), stress(lanes, 6)
   integer :: k, l

   unity(:, :) = 0.0_wp
   do k = 1, 3
      unity(k, k) = 1.0_wp
   end do
   turn(:, 1) = c
   turn(:, 2) = s
   call look_at_volume()
   call look_at_strain()
   call look_at_stress()
   call look_at_axes()
   call finish()

contains

   !> Each lane has a volume of its own
   subroutine look_at_volume()
      real(wp) :: ratio(lanes)

      call begin("volume_ratios")
      h(:, :, :) = 0.0_wp
      do l = 1, lanes
         h(l, 1, 1) = 0.1_wp*l
         h(l, 2, 2) = -0.05_wp*l
         h(l, 3, 3) = 0.2_wp*l
         ! a column of a triangular matrix changes no determinant
         h(l, 1, 3) = 0.3_wp*l
      end do
      ratio(:) = volume_ratios(h)
      do l = 1, lanes
         call check(ratio(l), (1.0_wp + 0.1_wp*l)*(1.0_wp - 0.05_wp*l)*(1.0_wp + 0.2_wp*l), &
            & close, "product of the stretches")
      end do
      h(:, :, :) = spread(matmul(rotation(), gradient + unity) - unity, 1, lanes)
      later(:, 1) = volume_ratios(spread(gradient, 1, lanes))
      ratio(:) = volume_ratios(h)
      call check(ratio(lanes), later(lanes, 1), close, "a rotation keeps it")
   end subroutine look_at_volume

   !> E = (F^T F - I)/2, with engineering shear
   subroutine look_at_strain()
      real(wp) :: tensor(3, 3)

      call begin("find_strain")
      h(:, :, :) = spread(gradient, 1, lanes)
      tensor(:, :) = 0.5_wp*(matmul(transpose(gradient + unity), gradient + unity) - unity)
      call find_strain(h, .true., e)
      do k = 1, 6
         call check(e(2, k), merge(1.0_wp, 2.0_wp, k <= 3)*tensor(row(k), column(k)), close, &
            & "of Green and Lagrange")
      end do
      tensor(:, :) = 0.5_wp*(gradient + transpose(gradient))
      call find_strain(h, .false., e)
      do k = 1, 6
         call check(e(2, k), merge(1.0_wp, 2.0_wp, k <= 3)*tensor(row(k), column(k)), close, &
            & "linear")
      end do
      call find_strain(spread(rotation() - unity, 1, lanes), .true., e)
      call check(maxval(abs(e)), 0.0_wp, close, "none of a rotation")
   end subroutine look_at_strain

   !> The power of P on the rate of F is that of S on the rate of E; Cauchy stress is P F^T / J
   subroutine look_at_stress()
      real(wp) :: power

      call begin("find_piola")
      h(:, :, :) = spread(gradient, 1, lanes)
      stress(:, :) = spread(second, 1, lanes)
      call find_piola(h, stress, spread(2.5_wp, 1, lanes), .true., p)
      call find_strain(h - small*spread(rate, 1, lanes), .true., e)
      call find_strain(h + small*spread(rate, 1, lanes), .true., later)
      power = dot_product(second, later(5, :) - e(5, :))/(2.0_wp*small)
      call check(sum(p(5, :, :)*rate), 2.5_wp*power, 1.0e-8_wp, "power times weight")
      call find_piola(h, stress, spread(2.5_wp, 1, lanes), .false., p)
      call check(p(5, 2, 1), 2.5_wp*second(4), close, "with small displacement the stress")
      call check(p(5, 3, 3), 2.5_wp*second(3), close, "the same along z")

      call begin("find_cauchy")
      call find_piola(h, stress, spread(1.0_wp, 1, lanes), .true., p)
      f(:, :) = gradient + unity
      later(:, 1) = volume_ratios(h)
      volume = later(1, 1)
      f(:, :) = matmul(p(1, :, :), transpose(f))/volume
      call find_cauchy(h, stress)
      do k = 1, 6
         call check(stress(1, k), f(row(k), column(k)), 1.0e-13_wp, "P F^T / J")
         call check(stress(1, k), f(column(k), row(k)), 1.0e-13_wp, "symmetric")
      end do
   end subroutine look_at_stress

   !> Tensors turned by matrices; energy knows no axes
   subroutine look_at_axes()
      real(wp) :: expected(3, 3)

      call begin("turn_stress")
      stress(:, :) = spread(second, 1, lanes)
      expected(:, :) = matmul(transpose(rotation()), matmul(tensor_of(second), rotation()))
      call turn_stress(turn, stress)
      do k = 1, 6
         call check(stress(7, k), expected(row(k), column(k)), 1.0e-13_wp, "R^T S R")
      end do
      h(:, :, :) = spread(gradient, 1, lanes)
      call find_strain(h, .false., e)
      volume = dot_product(e(7, :), second)
      call turn_strain(turn, e)
      call check(dot_product(e(7, :), stress(7, :)), volume, 1.0e-13_wp, "strain turns along")
      call turn_stress_back(turn, stress)
      call check(maxval(abs(stress(7, :) - second)), 0.0_wp, 1.0e-13_wp, "and back")
   end subroutine look_at_axes

   !> From the turned axes to those before: a rotation about z
   function rotation() result(r)
      real(wp) :: r(3, 3)

      r(:, :) = reshape([c, s, 0.0_wp, -s, c, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
   end function rotation

   !> Symmetric tensor of its components
   function tensor_of(component) result(tensor)
      real(wp), intent(in) :: component(6)
      real(wp) :: tensor(3, 3)

      tensor(:, :) = reshape(component([1, 4, 5, 4, 2, 6, 5, 6, 3]), [3, 3])
   end function tensor_of

end program test_fem_kinematics
