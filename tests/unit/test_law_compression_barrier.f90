!> The barrier against material that is turned inside out
program test_law_compression_barrier
   use plydyn_base_precision, only : wp
   use plydyn_law_compression_barrier, only : add_barrier_stress, barrier_energy, &
      & barrier_ratio, barrier_stiffness, barrier_stress, volume_ratio
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: modulus = 3.0_wp, small = 1.0e-6_wp
   real(wp) :: change(3, 3), h(3, 3), rotation(3, 3), stress(3, 3), turned(3, 3)
   real(wp) :: high, low, work
   integer :: i

   call begin("volume_ratio")
   h(:, :) = 0.0_wp
   h(1, 1) = 0.5_wp
   h(2, 2) = -0.2_wp
   h(3, 3) = 1.0_wp
   call check(volume_ratio(h), 1.5_wp*0.8_wp*2.0_wp, 1.0e-15_wp, "product of the stretches")
   h(:, :) = 0.0_wp
   h(1, 3) = 0.7_wp
   call check(volume_ratio(h), 1.0_wp, 1.0e-15_wp, "simple shear keeps the volume")

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
   stress(:, :) = 0.0_wp
   call add_barrier_stress(modulus, h, stress)
   work = barrier_stress(modulus, volume_ratio(h))*(volume_ratio(h + small*change) &
      & - volume_ratio(h - small*change))/(2.0_wp*small)
   call check(sum(stress*change), work, 1.0e-8_wp, "its power is that of the pressure on volume")
   rotation(:, :) = reshape([0.6_wp, 0.8_wp, 0.0_wp, -0.8_wp, 0.6_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
      & 1.0_wp], [3, 3])
   turned(:, :) = 0.0_wp
   do i = 1, 3
      h(i, i) = h(i, i) + 1.0_wp
   end do
   h(:, :) = matmul(rotation, h)
   do i = 1, 3
      h(i, i) = h(i, i) - 1.0_wp
   end do
   call add_barrier_stress(modulus, h, turned)
   call check(maxval(abs(turned - matmul(rotation, stress))), 0.0_wp, 1.0e-14_wp, &
      & "it turns with the material")
   call finish()
end program test_law_compression_barrier
