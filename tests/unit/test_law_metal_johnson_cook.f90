!> Johnson and Cook's yield stress against direct evaluation along a path, and over decades.
program test_law_metal_johnson_cook
   use metals, only : farthest_from_yield
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_metal_plastic, only : dissipated, effective_plastic_strain
   use plydyn_law_metal_johnson_cook, only : johnson_cook_constants_type, &
      & plastic_johnson_cook_type
   use testing, only : begin, check, finish
   implicit none

   !> A steel (MPa, s), with rates in the first half of the lanes
   real(wp), parameter :: young = 207.0e3_wp, poisson = 0.29_wp, shear = young/2.58_wp
   real(wp), parameter :: a = 792.0_wp, b = 510.0_wp, n = 0.26_wp, c = 0.014_wp
   !> Reference rates of the lanes with rates
   real(wp), parameter :: reference(lanes/2) = [1.0_wp, 1.0e-3_wp, 100.0_wp, 1.0e4_wp]

   type(plastic_johnson_cook_type) :: law
   integer :: lane

   do lane = 1, size(reference)
      call set_lane(law, lane, n, c, reference(lane))
   end do
   do lane = size(reference) + 1, lanes - 1
      call set_lane(law, lane, n, 0.0_wp, 1.0_wp)
   end do
   call test_path()
   call test_energy()
   call test_slopes()
   call test_decades()
   call test_recall()
   call finish()

contains

   !> Give a lane the steel with a power of strain, a sensitivity to the rate, and a reference rate
   pure subroutine set_lane(law, lane, exponent, sensitivity, rate)
      type(plastic_johnson_cook_type), intent(inout) :: law
      integer, intent(in) :: lane
      real(wp), intent(in) :: exponent, sensitivity, rate

      type(johnson_cook_constants_type) :: metal

      metal%young(:) = young
      metal%poisson(:) = poisson
      metal%yield = a
      metal%factor = b
      metal%exponent = exponent
      metal%sensitivity = sensitivity
      metal%reference_rate = rate
      call metal%set_lane(lane, law)
   end subroutine set_lane

   !> Yield stress as printed
   pure real(wp) function printed(strain, rate, lane)
      real(wp), intent(in) :: strain, rate
      integer, intent(in) :: lane

      printed = a + b*strain**n
      if (lane > size(reference)) return
      printed = printed*(1.0_wp + c*log(max(rate/reference(lane), 1.0_wp)))
   end function printed

   !> Shear with changing rate and steps: the stress is that of the formula at every step
   subroutine test_path()
      real(wp) :: before(lanes), expected, history(lanes, dissipated), rate, step
      real(wp) :: strain(lanes, 6), stress(lanes, 6), worst
      integer :: i, l

      call begin("path")
      history(:, :) = 0.0_wp
      strain(:, :) = 0.0_wp
      stress(:, :) = 0.0_wp
      worst = 0.0_wp
      do i = 1, 300
         step = 1.0e-6_wp*(1 + modulo(i, 3))
         strain(:, 4) = strain(:, 4) + 3000.0_wp*step*exp(sin(0.1_wp*i))
         before(:) = history(:, effective_plastic_strain)
         call law%update(step, strain, history, stress)
         do l = 1, lanes - 1
            rate = (history(l, effective_plastic_strain) - before(l))/step
            if (rate <= 0.0_wp) cycle
            expected = printed(history(l, effective_plastic_strain), rate, l)
            worst = max(worst, abs(sqrt(3.0_wp)*stress(l, 4)/expected - 1.0_wp))
         end do
      end do
      call check(minval(history(:lanes - 1, effective_plastic_strain)) > 0.5_wp, "flows")
      call check(worst, 0.0_wp, 1.0e-10_wp, "stress as printed")
      call check(stress(lanes, 4), 0.0_wp, 0.0_wp, "other lanes keep theirs")
      call check(stress(1, 4) > stress(3, 4), "the lower the reference, the higher")
      call check(stress(4, 4), stress(5, 4), 1.0e-9_wp, "no rise below the reference rate")
   end subroutine test_path

   !> Dissipation is the area under the curve
   subroutine test_energy()
      integer, parameter :: steps = 1000
      real(wp) :: flowed, history(lanes, dissipated), strain(lanes, 6), stress(lanes, 6)
      integer :: i

      call begin("dissipation")
      history(:, :) = 0.0_wp
      strain(:, :) = 0.0_wp
      do i = 1, steps
         strain(:, 4) = 0.5_wp*i/steps
         call law%update(0.0_wp, strain, history, stress)
      end do
      flowed = history(5, effective_plastic_strain)
      call check(history(5, dissipated)/flowed, a + b*flowed**n/(n + 1.0_wp), 0.02_wp, &
         & "is the area under the yield stress")
      call check(flowed, (0.5_wp - stress(5, 4)/shear)/sqrt(3.0_wp), 1.0e-14_wp, &
         & "plastic strain is what is not elastic")
   end subroutine test_energy

   !> Slopes against differences
   subroutine test_slopes()
      real(wp), parameter :: apart = 1.0e-6_wp
      real(wp) :: hardening(lanes), high(lanes), low(lanes), rate(lanes), slope(lanes)
      real(wp) :: strain(lanes), viscosity(lanes), yield(lanes)
      integer :: i

      call begin("slopes")
      do i = -6, 0
         strain(:) = 10.0_wp**i
         rate(:) = 500.0_wp*10.0_wp**i
         call law%yield_stress(strain*(1.0_wp - apart), rate, low, hardening, viscosity)
         call law%yield_stress(strain*(1.0_wp + apart), rate, high, hardening, viscosity)
         call law%yield_stress(strain, rate, yield, hardening, viscosity)
         call check(hardening*2.0_wp*apart*strain, high - low, 1.0e-9_wp, "by strain")
         call law%yield_stress(strain, rate*(1.0_wp - apart), low, slope, viscosity)
         call law%yield_stress(strain, rate*(1.0_wp + apart), high, slope, viscosity)
         call law%yield_stress(strain, rate, yield, hardening, viscosity)
         call check(viscosity*2.0_wp*apart*rate, high - low, 1.0e-9_wp, "by the rate")
      end do
   end subroutine test_slopes

   !> Powers, rates, steps and loads over many decades
   subroutine test_decades()
      type(plastic_johnson_cook_type) :: other
      integer :: i, l

      call begin("decades")
      do i = -4, 6, 2
         do l = 1, lanes
            call set_lane(other, l, 0.15_wp*l, 0.01_wp*(l - 1), 10.0_wp**i)
         end do
         call check(farthest_from_yield(other, 3.0_wp*shear), 0.0_wp, 1.0e-10_wp, &
            & "leave stress on the yield surface")
      end do
   end subroutine test_decades

   !> Once flow has ended, the stress stays where the rate has raised it
   subroutine test_recall()
      real(wp) :: history(lanes, dissipated), recalled(lanes, 6), strain(lanes, 6)
      real(wp) :: stress(lanes, 6)

      call begin("recall")
      history(:, :) = 0.0_wp
      strain(:, :) = 0.0_wp
      strain(:, 4) = 0.02_wp
      stress(:, :) = 0.0_wp
      recalled(:, :) = 0.0_wp
      call law%update(1.0e-6_wp, strain, history, stress)
      call law%stress_at(strain, history, recalled)
      call check(recalled(:, 4), stress(:, 4), 1.0e-9_wp, "is the stress of the step")
      call check(sqrt(3.0_wp)*recalled(1, 4) > printed(history(1, effective_plastic_strain), &
         & 0.0_wp, 1) + 1.0_wp, "above that without rate")
   end subroutine test_recall

end program test_law_metal_johnson_cook
