!> Tabulated yield stress against linear hardening, points of its own, and rates in between.
program test_law_metal_tabulated
   use metals, only : linear_metal
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_metal_plastic, only : dissipated, effective_plastic_strain
   use plydyn_law_metal_tabulated, only : plastic_curve_type, stress_at, tabulated_constants_type, &
      & yield_curve_type
   use plydyn_law_metal_kinematic, only : kinematic_constants_type, plastic_kinematic_type
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: young = 70.0e3_wp, poisson = 0.33_wp, shear = young/2.66_wp
   !> Lanes of the batch
   integer, parameter :: bent = 1, straight = 2, flat = 3, falling = 4, slow_fast = 5, decades = 6
   integer, parameter :: raised = 7, used = 7

   type(yield_curve_type) :: curves(2, lanes)
   type(plastic_curve_type) :: law

   call set_curves()
   call test_straight()
   call test_points()
   call test_rates()
   call test_path()
   call test_steps()
   call finish()

contains

   !> The materials, in an order that lets the law grow twice
   subroutine set_curves()
      integer :: l

      do l = 1, lanes
         curves(:, l) = [curve(0.0_wp, [0.0_wp], [150.0_wp]), curve(0.0_wp, [0.0_wp], [150.0_wp])]
      end do
      curves(1, bent) = curve(0.0_wp, [0.0_wp, 0.01_wp, 0.02_wp, 0.1_wp, 0.5_wp], &
         & [150.0_wp, 180.0_wp, 190.0_wp, 230.0_wp, 270.0_wp])
      curves(1, straight) = curve(0.0_wp, [0.0_wp, 0.007_wp, 0.02_wp], &
         & [150.0_wp, 150.0_wp + 0.007_wp*900.0_wp, 150.0_wp + 0.02_wp*900.0_wp])
      curves(1, falling) = curve(0.0_wp, [0.0_wp, 0.05_wp, 0.1_wp], [150.0_wp, 200.0_wp, 120.0_wp])
      curves(1, slow_fast) = curve(0.0_wp, [0.0_wp, 0.1_wp], [150.0_wp, 200.0_wp])
      curves(2, slow_fast) = curve(1000.0_wp, [0.0_wp, 0.2_wp], [250.0_wp, 300.0_wp])
      curves(1, decades) = curve(0.1_wp, [0.0_wp, 0.1_wp], [150.0_wp, 200.0_wp])
      curves(2, decades) = curve(1000.0_wp, [0.0_wp, 0.2_wp], [250.0_wp, 300.0_wp])
      curves(1, raised) = curves(1, bent)
      call set_lane(flat, 1)
      call set_lane(slow_fast, 2)
      call set_lane(bent, 1)
      call set_lane(straight, 1)
      call set_lane(falling, 1)
      call set_lane(decades, 2)
      call set_lane(raised, 1)
   end subroutine set_curves

   !> Give a lane its first curves
   subroutine set_lane(lane, number)
      integer, intent(in) :: lane, number

      type(tabulated_constants_type) :: metal

      metal%young(:) = young
      metal%poisson(:) = poisson
      metal%curves = curves(:number, lane)
      metal%logarithmic = lane == decades
      if (lane == raised) then
         metal%yield = 150.0_wp
         metal%rate = 40.0_wp
         metal%power = 5.0_wp
      end if
      call metal%set_lane(lane, law)
   end subroutine set_lane

   !> A curve of points
   pure function curve(rate, strain, stress)
      real(wp), intent(in) :: rate, strain(:), stress(:)
      type(yield_curve_type) :: curve

      curve%rate = rate
      curve%strain = strain
      curve%stress = stress
   end function curve

   !> A straight table is linear hardening, in all its consequences
   subroutine test_straight()
      real(wp) :: history(lanes, dissipated), linear_history(lanes, dissipated)
      real(wp) :: linear_stress(lanes, 6), strain(lanes, 6), stress(lanes, 6), turn, worst(2)
      type(kinematic_constants_type) :: metal
      type(plastic_kinematic_type) :: linear
      integer :: i

      call begin("straight table")
      metal = linear_metal(young, poisson, 150.0_wp, young*900.0_wp/(young + 900.0_wp), 1.0_wp)
      call metal%set_lane(straight, linear)
      history(:, :) = 0.0_wp
      linear_history(:, :) = 0.0_wp
      worst(:) = 0.0_wp
      do i = 1, 500
         turn = 0.02_wp*i
         strain(:, :) = spread(0.01_wp*[sin(turn), -cos(turn), 0.3_wp*turn, sin(2.0_wp*turn), &
            & cos(turn), turn], 1, lanes)
         call law%update(0.0_wp, strain, history, stress)
         call linear%update(0.0_wp, strain, linear_history, linear_stress)
         worst(1) = max(worst(1), maxval(abs(stress(straight, :) - linear_stress(straight, :))))
         worst(2) = max(worst(2), maxval(abs(history(straight, :) - linear_history(straight, :))))
      end do
      call check(history(straight, effective_plastic_strain) > 0.05_wp, "flows past the last point")
      call check(worst(1), 0.0_wp, 1.0e-8_wp, "the same stress")
      call check(worst(2), 0.0_wp, 1.0e-10_wp, "the same history")
   end subroutine test_straight

   !> Yield stress at, between and beyond points
   subroutine test_points()
      real(wp) :: hardening(lanes), strain(lanes), viscosity(lanes), yield(lanes)
      integer :: i, l

      call begin("points")
      do i = 0, 60
         strain(:) = 0.01_wp*i
         call law%yield_stress(strain, 0.0_wp*strain, yield, hardening, viscosity)
         do l = bent, used
            call check(yield(l), stress_at(curves(1, l), strain(l)), 1.0e-11_wp, &
               & "yield stress of the curve")
         end do
      end do
      call check(hardening(bent), 100.0_wp, 1.0e-9_wp, "goes on rising")
      call check(hardening(falling), 0.0_wp, 0.0_wp, "does not go on falling")
      call check(law%onset(falling), 120.0_wp, 0.0_wp, "may yield again where it fell")
   end subroutine test_points

   !> Yield stress between curves and outside of them
   subroutine test_rates()
      real(wp), parameter :: rates(6) = [0.0_wp, 1.0e-3_wp, 0.3_wp, 10.0_wp, 400.0_wp, 1.0e5_wp]
      real(wp), parameter :: apart = 1.0e-6_wp
      real(wp) :: expected(lanes), hardening(lanes), high(lanes), low(lanes), rate(lanes)
      real(wp) :: share(lanes), strain(lanes), viscosity(lanes), yield(lanes)
      integer :: i, l

      call begin("rates")
      strain(:) = 0.15_wp
      do i = 1, size(rates)
         rate(:) = rates(i)
         share(:) = 0.0_wp
         share(slow_fast) = min(rates(i)/1000.0_wp, 1.0_wp)
         share(decades) = min(log(max(rates(i)/0.1_wp, 1.0_wp))/log(1.0e4_wp), 1.0_wp)
         do l = 1, used
            expected(l) = stress_at(curves(1, l), strain(l)) + share(l) &
               & *(stress_at(curves(2, l), strain(l)) - stress_at(curves(1, l), strain(l)))
         end do
         expected(raised) = expected(raised) + 150.0_wp*(rates(i)/40.0_wp)**0.2_wp
         call law%yield_stress(strain, rate, yield, hardening, viscosity)
         call check(yield(:used), expected(:used), 1.0e-10_wp, "yield stress at a rate")
         call check(hardening(slow_fast), 500.0_wp - 250.0_wp*share(slow_fast), 1.0e-9_wp, &
            & "hardening at a rate")
         if (rates(i) <= 0.0_wp) cycle
         call law%yield_stress(strain, rate*(1.0_wp - apart), low, hardening, viscosity)
         call law%yield_stress(strain, rate*(1.0_wp + apart), high, hardening, viscosity)
         call law%yield_stress(strain, rate, yield, hardening, viscosity)
         call check(viscosity*2.0_wp*apart*rate, high - low, 1.0e-8_wp, "derivative by the rate")
      end do
   end subroutine test_rates

   !> Shear at changing rates: the stress is always that of the curves
   subroutine test_path()
      real(wp) :: before(lanes), hardening(lanes), history(lanes, dissipated), rate(lanes), step
      real(wp) :: strain(lanes, 6), stress(lanes, 6), viscosity(lanes), worst, yield(lanes)
      integer :: i

      call begin("path")
      history(:, :) = 0.0_wp
      strain(:, :) = 0.0_wp
      stress(:, :) = 0.0_wp
      worst = 0.0_wp
      do i = 1, 400
         step = 10.0_wp**(-2 - modulo(i, 6))
         strain(:, 4) = strain(:, 4) + 0.002_wp
         before(:) = history(:, effective_plastic_strain)
         call law%update(step, strain, history, stress)
         rate(:) = (history(:, effective_plastic_strain) - before)/step
         call law%yield_stress(history(:, effective_plastic_strain), rate, yield, hardening, &
            & viscosity)
         worst = max(worst, maxval(abs(sqrt(3.0_wp)*stress(:used, 4)/yield(:used) - 1.0_wp), &
            & rate(:used) > 0.0_wp))
      end do
      call check(minval(history(:used, effective_plastic_strain)) > 0.4_wp, "flows")
      call check(worst, 0.0_wp, 1.0e-10_wp, "stress of the curves")
      call check(stress(lanes, 4), 0.0_wp, 0.0_wp, "other lanes keep theirs")
   end subroutine test_path

   !> One step over many points: what small steps give in the end
   subroutine test_steps()
      real(wp) :: history(lanes, dissipated), strain(lanes, 6), stress(lanes, 6)
      real(wp) :: flowed, work
      integer :: i, run

      call begin("steps")
      do run = 1, 2
         history(:, :) = 0.0_wp
         strain(:, :) = 0.0_wp
         do i = 1, merge(1, 1000, run == 1)
            strain(:, 4) = 0.3_wp*i/merge(1, 1000, run == 1)
            call law%update(0.0_wp, strain, history, stress)
         end do
         flowed = (0.3_wp - stress(bent, 4)/shear)/sqrt(3.0_wp)
         call check(history(bent, effective_plastic_strain), flowed, 1.0e-12_wp, "plastic strain")
         call check(stress(bent, 4)*sqrt(3.0_wp), stress_at(curves(1, bent), flowed), 1.0e-9_wp, &
            & "straight to the curve")
      end do
      ! the area under the curve
      work = 1.65_wp + 1.85_wp + 0.08_wp*210.0_wp &
         & + (flowed - 0.1_wp)*(230.0_wp + 50.0_wp*(flowed - 0.1_wp))
      call check(history(bent, dissipated), work, 1.0e-4_wp, "dissipation")
   end subroutine test_steps

end program test_law_metal_tabulated
