!> Curves of yield stress: which can be, and what lies between and beyond their points.
program test_law_metal_tabulated_curve
   use plydyn_base_precision, only : wp
   use plydyn_law_metal_tabulated, only : common_strains, is_yield_curve, stress_at, &
      & yield_curve_type
   use testing, only : begin, check, finish
   implicit none

   type(yield_curve_type) :: falling, flat, rising

   rising = curve([0.0_wp, 0.1_wp, 0.3_wp], [200.0_wp, 300.0_wp, 340.0_wp])
   falling = curve([0.0_wp, 0.2_wp], [200.0_wp, 150.0_wp])
   flat = curve([0.0_wp], [200.0_wp])

   call begin("is_yield_curve")
   call check(is_yield_curve(rising), "points that rise")
   call check(is_yield_curve(falling), "stress may fall")
   call check(is_yield_curve(flat), "one point will do")
   call check(.not. is_yield_curve(curve([0.1_wp], [200.0_wp])), "starts at zero")
   call check(.not. is_yield_curve(curve([0.0_wp, 0.0_wp], [200.0_wp, 300.0_wp])), "strain rises")
   call check(.not. is_yield_curve(curve([0.0_wp, 0.1_wp], [200.0_wp, 0.0_wp])), "stress remains")
   call check(.not. is_yield_curve(curve([0.0_wp, 0.1_wp], [200.0_wp])), "as many of both")

   call begin("stress_at")
   call check(stress_at(rising, [0.0_wp, 0.05_wp, 0.1_wp, 0.2_wp, 0.3_wp]), &
      & [200.0_wp, 250.0_wp, 300.0_wp, 320.0_wp, 340.0_wp], 1.0e-12_wp, "straight between points")
   call check(stress_at(rising, 0.8_wp), 440.0_wp, 1.0e-12_wp, "goes on rising")
   call check(stress_at(falling, [0.1_wp, 0.8_wp]), [175.0_wp, 150.0_wp], 1.0e-12_wp, &
      & "does not go on falling")
   call check(stress_at(flat, 0.8_wp), 200.0_wp, 0.0_wp, "stays at its one point")

   call begin("common_strains")
   call check(common_strains([rising, falling, flat]), [0.0_wp, 0.1_wp, 0.2_wp, 0.3_wp], 0.0_wp, &
      & "each once, in order")
   call finish()

contains

   !> A curve of points
   pure function curve(strain, stress)
      real(wp), intent(in) :: strain(:), stress(:)
      type(yield_curve_type) :: curve

      curve%strain = strain
      curve%stress = stress
   end function curve

end program test_law_metal_tabulated_curve
