!> Process zones and reduced strengths of HTS40/9772, table 6 of the paper, in mm, N, MPa.
program test_law_cohesive_process_zone_length
   use plydyn_base_precision, only : wp
   use plydyn_law_cohesive_process_zone_length, only : fitting_strength, least_stiffness_ratio, &
      & slender_zone, &
      & stiffness_ratio, strength_factor, zone_length, zone_lengths
   use testing, only : begin, check, finish
   implicit none

   !> E3, E1, G_Ic and G_IIc, N and S
   real(wp), parameter :: across = 10.3e3_wp, along = 153.0e3_wp
   real(wp), parameter :: toughness(2) = [0.28_wp, 0.79_wp], strength(2) = [62.3_wp, 92.3_wp]
   real(wp), parameter :: digit = 5.0e-4_wp
   real(wp), parameter :: spacing(6) = [0.25_wp, 0.5_wp, 0.75_wp, 1.0_wp, 1.5_wp, 2.0_wp]
   integer :: i

   call begin("zone_length")
   call check(zone_length(across, toughness, strength), [0.657_wp, 0.844_wp], digit, &
      & "of opening and of sliding, after Rice")

   call begin("slender_zone")
   call check(slender_zone(along, 0.25_wp, toughness, strength), [0.64_wp, 1.88_wp], 5.0e-3_wp, &
      & "between layers of 0.25 mm")
   call check(slender_zone(along, 0.5_wp, toughness, strength), [1.08_wp, 2.66_wp], 5.0e-3_wp, &
      & "between layers of 0.5 mm")
   call check(slender_zone(along, 1.0_wp, toughness, strength), [1.82_wp, 3.77_wp], 5.0e-3_wp, &
      & "between layers of 1 mm")

   call begin("zone_lengths")
   call check(zone_lengths(across, along, 0.25_wp, toughness, strength), [0.644_wp, 0.844_wp], &
      & digit, "take the smaller of both in each mode")

   call begin("fitting_strength")
   call check(fitting_strength(across, toughness(1), spacing), &
      & [58.3_wp, 41.2_wp, 33.7_wp, 29.1_wp, 23.8_wp, 20.6_wp], 0.05_wp, "of opening")
   call check(fitting_strength(across, toughness(2), spacing), &
      & [97.9_wp, 69.2_wp, 56.5_wp, 49.0_wp, 40.0_wp, 34.6_wp], 0.05_wp, "of sliding")

   call begin("strength_factor")
   call check([(strength_factor(across, toughness, strength, spacing(i)), i=1, 6)], &
      & [0.94_wp, 0.66_wp, 0.54_wp, 0.47_wp, 0.38_wp, 0.33_wp], 5.0e-3_wp, "keeps the mix of modes")
   call check(strength_factor(across, toughness, strength, 0.1_wp), 1.0_wp, &
      & 0.0_wp, "never raises a strength")

   call begin("stiffness_ratio")
   call check(stiffness_ratio(1373.3e3_wp, across, 0.25_wp), 33.3_wp, 0.05_wp, "of table 6")
   call check(least_stiffness_ratio*across/0.25_wp, 2060.0e3_wp, 1.0_wp, "asks for 2060 GPa/mm")
   call finish()
end program test_law_cohesive_process_zone_length
