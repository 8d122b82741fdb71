!> The barrier against material that is turned inside out
program test_law_compression_barrier
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_kinematics, only : volume_ratios
   use plydyn_law_compression_barrier, only : add_barrier_stress, barrier_energy, &
      & barrier_ratio, barrier_stiffness, barrier_stress
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: modulus = 3.0_wp, small = 1.0e-6_wp
   real(wp), parameter :: unity(3, 3) = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, &
      & 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
   real(wp) :: change(3, 3), h(3, 3), rotation(3, 3), stress(3, 3), turned(3, 3)
   real(wp) :: high, low, work
   integer :: i

   call begin("barrier_stress")
   call check(barrier_stress(modulus, 1.0_wp), 0.0_wp, 0.0_wp, "none without compression")
   call check(barrier_stress(modulus, barrier_ratio), 0.0_wp, 0.0_wp, "none where it begins")
   call check(barrier_stress(modulus, 0.4_wp), -1.2_wp, 1.0e-15_wp, "M (J0 - J)**2/J")
   call check(barrier_stress(modulus, 0.1_wp) < barrier_stress(modulus, 0.2_wp), "it grows")
   call check(barrier_stress(modulus, -0.5_wp) < barrier_stress(modulus, 0.02_wp), &
      & "it presses outwards where a step has passed zero")

   call begin("barrier_stiffness")
   do i = 1, 7
      low = barrier_stress(1.0_wp, 0.1_wp*i - small)
      high = barrier_stress(1.0_wp, 0.1_wp*i + small)
      call check(barrier_stiffness(0.1_wp*i), (high - low)/(2.0_wp*small), 1.0e-6_wp, &
         & "it is the slope of the stress")
   end do

   call begin("barrier_energy")
   call check(barrier_energy(barrier_ratio), 0.0_wp, 0.0_wp, "none where it begins")
   call check(barrier_energy(2.0_wp), 0.0_wp, 0.0_wp, "nor without compression")
   do i = 1, 7
      low = barrier_energy(0.1_wp*i - small)
      high = barrier_energy(0.1_wp*i + small)
      call check((high - low)/(2.0_wp*small), barrier_stress(1.0_wp, 0.1_wp*i), 1.0e-6_wp, &
         & "its slope is the stress")
   end do
   low = barrier_energy(-0.1_wp - small)
   high = barrier_energy(-0.1_wp + small)
   call check((high - low)/(2.0_wp*small), barrier_stress(1.0_wp, -0.1_wp), 1.0e-4_wp, &
      & "also where a step has passed zero")
   call check(barrier_energy(0.01_wp - small), barrier_energy(0.01_wp + small), 2.0e-4_wp, &
      & "and it has no jump where the denominator stays")

   ! power of the stress is modulus times the change of the energy, whatever the motion
   call begin("add_barrier_stress")
   h(:, :) = reshape([-0.3_wp, 0.1_wp, 0.05_wp, -0.2_wp, -0.25_wp, 0.1_wp, 0.3_wp, -0.1_wp, &
      & -0.2_wp], [3, 3])
   change(:, :) = reshape([0.3_wp, -0.7_wp, 0.2_wp, 0.5_wp, 0.1_wp, -0.4_wp, 0.6_wp, 0.2_wp, &
      & -0.9_wp], [3, 3])
   stress(:, :) = barrier_of(h)
   work = barrier_stress(modulus, ratio_of(h))*(ratio_of(h + small*change) &
      & - ratio_of(h - small*change))/(2.0_wp*small)
   call check(sum(stress*change), work, 1.0e-8_wp, "its power is that of the pressure on volume")
   rotation(:, :) = reshape([0.6_wp, 0.8_wp, 0.0_wp, -0.8_wp, 0.6_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
      & 1.0_wp], [3, 3])
   turned(:, :) = barrier_of(matmul(rotation, h + unity) - unity)
   call check(maxval(abs(turned - matmul(rotation, stress))), 0.0_wp, 1.0e-14_wp, &
      & "it turns with the material")
   call finish()

contains

   !> Ratio of volumes of one displacement gradient
   real(wp) function ratio_of(gradient)
      real(wp), intent(in) :: gradient(3, 3)

      real(wp) :: ratios(lanes)

      ratios(:) = volume_ratios(spread(gradient, 1, lanes))
      ratio_of = ratios(1)
   end function ratio_of

   !> Stress of the barrier on one lane; the others are at rest and keep what they had
   function barrier_of(gradient) result(one)
      real(wp), intent(in) :: gradient(3, 3)
      real(wp) :: one(3, 3)

      real(wp) :: all_lanes(lanes, 3, 3), gradients(lanes, 3, 3)
      integer, parameter :: lane = 3

      gradients(:, :, :) = 0.0_wp
      gradients(lane, :, :) = gradient
      all_lanes(:, :, :) = 7.0_wp
      all_lanes(lane, :, :) = 0.0_wp
      call add_barrier_stress(spread(modulus, 1, lanes), gradients, all_lanes)
      one(:, :) = all_lanes(lane, :, :)
      all_lanes(lane, :, :) = 7.0_wp
      call check(maxval(abs(all_lanes - 7.0_wp)), 0.0_wp, 0.0_wp, "none in lanes at rest")
   end function barrier_of

end program test_law_compression_barrier
