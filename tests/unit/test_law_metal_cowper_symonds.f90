!> The rise with the rate against direct evaluation and differences.
program test_law_metal_cowper_symonds
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_metal_cowper_symonds, only : cowper_symonds_type
   use testing, only : begin, check, finish
   implicit none

   !> Difference of rates, as a share
   real(wp), parameter :: apart = 1.0e-6_wp
   !> Lane that feels no rate, lanes in which all rises and in which a given stress rises
   integer, parameter :: static = 1, whole = 2, given = 3

   type(cowper_symonds_type) :: rise
   real(wp) :: hardening(lanes), rate(lanes), viscosity(lanes), yield(lanes), yields(lanes, 2)
   integer :: i, side

   call begin("raise")
   call check(.not. rise%acts, "nothing to do at first")
   call rise%set_lane(whole, 40.0_wp, 5.0_wp)
   call rise%set_lane(given, 6500.0_wp, 4.0_wp, basis=200.0_wp)
   call check(rise%acts, "something to do then")
   do i = -3, 6
      do side = 1, 2
         rate(:) = 10.0_wp**i*(1.0_wp + merge(apart, -apart, side == 2))
         yields(:, side) = 300.0_wp
         viscosity(:) = 0.0_wp
         hardening(:) = 1000.0_wp
         call rise%raise(rate, yields(:, side), hardening, viscosity)
      end do
      rate(:) = 10.0_wp**i
      yield(:) = 300.0_wp
      viscosity(:) = 0.0_wp
      hardening(:) = 1000.0_wp
      call rise%raise(rate, yield, hardening, viscosity)
      call check(yield(static), 300.0_wp, 0.0_wp, "leaves other lanes alone")
      call check(yield(whole), 300.0_wp*(1.0_wp + (rate(1)/40.0_wp)**0.2_wp), 1.0e-10_wp, &
         & "all of the yield stress")
      call check(hardening(whole), 1000.0_wp*(1.0_wp + (rate(1)/40.0_wp)**0.2_wp), 1.0e-9_wp, &
         & "and of its slope")
      call check(yield(given), 300.0_wp + 200.0_wp*(rate(1)/6500.0_wp)**0.25_wp, 1.0e-10_wp, &
         & "a stress given")
      call check(hardening(given), 1000.0_wp, 0.0_wp, "not the slope then")
      call check(viscosity*2.0_wp*apart*rate, yields(:, 2) - yields(:, 1), 1.0e-9_wp, &
         & "derivative by the rate")
   end do
   yield(:) = 300.0_wp
   rate(:) = 0.0_wp
   call rise%raise(rate, yield, hardening, viscosity)
   call check(yield, spread(300.0_wp, 1, lanes), 1.0e-12_wp, "nothing at rest")
   call finish()
end program test_law_metal_cowper_symonds
