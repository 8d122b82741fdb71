!> Shear follows its curve, unloads with the first modulus and never heals.
program test_law_ply_batch_shear
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_shear_curve, only : new_power_curve, new_table_curve, shape_exponential, &
      & shear_curve_type
   use plydyn_law_ply_batch_shear, only : batch_shear_type
   use plydyn_law_ply_shear_path, only : advance
   use testing, only : begin, check, finish
   implicit none

   !> Modulus of the paper's Table 5
   real(wp), parameter :: modulus = 6.0e3_wp
   !> A lane of each shape
   integer, parameter :: line = 1, exponential = 2, table = 3, longer = 4, power = 5
   !> Ramberg and Osgood for IM7/8552
   real(wp), parameter :: coefficient = 4.06e-9_wp, exponent = 5.4_wp, power_modulus = 5290.0_wp

   type(batch_shear_type) :: law
   real(wp) :: peak(lanes), set(lanes), plastic_work(lanes)

   call set_lanes()
   call test_cycle()
   call test_shapes()
   call test_energy()
   call test_lost()
   call test_steep_table()
   call test_unloading()
   call test_short_way()
   call test_digits()
   call finish()

contains

   !> One lane of each shape
   subroutine set_lanes()
      type(shear_curve_type) :: curve

      call law%set_lane(line, modulus, curve)
      curve%shape = shape_exponential
      curve%asymptote = 93.6_wp
      call law%set_lane(exponential, modulus, curve)
      call law%set_lane(table, modulus, new_table_curve([0.0_wp, 0.01_wp, 0.03_wp], &
         & [0.0_wp, 60.0_wp, 80.0_wp]))
      call law%set_lane(longer, modulus, new_table_curve( &
         & [0.0_wp, 0.005_wp, 0.01_wp, 0.02_wp, 0.04_wp], &
         & [0.0_wp, 30.0_wp, 50.0_wp, 70.0_wp, 90.0_wp]))
      call law%set_lane(power, power_modulus, new_power_curve(coefficient, exponent))
   end subroutine set_lanes

   !> The reference cycle of an independent program, to its printed digits
   subroutine test_cycle()
      real(wp), parameter :: strain(14) = [0.01_wp, 0.02_wp, 0.03_wp, 0.02_wp, 0.015_wp, 0.0_wp, &
         & -0.015_wp, -0.02_wp, -0.03_wp, -0.04_wp, -0.02_wp, 0.03_wp, 0.04_wp, 0.045_wp]
      real(wp), parameter :: stress(14) = [44.296_wp, 67.629_wp, 79.920_wp, 19.920_wp, 0.0_wp, &
         & 0.0_wp, 0.0_wp, -19.920_wp, -79.920_wp, -86.394_wp, 0.0_wp, 26.394_wp, 86.394_wp, &
         & 88.370_wp]
      real(wp) :: found(14), stays(14), loss(14)
      integer :: i

      call begin("advance")
      call rest()
      do i = 1, 14
         found(i) = stress_after(strain(i), exponential)
         stays(i) = set(exponential)
         loss(i) = plastic_work(exponential)
      end do
      call check(found, stress, 5.0e-4_wp, "gives the stresses of an independent program")
      call check(stays([3, 10]), [0.01668_wp, 0.02560_wp], 5.0e-6_wp, "and the strains that stay")
      call check(all(loss(4:9) <= 0.0_wp), "loses no energy below the largest strain")
   end subroutine test_cycle

   !> A table a little steeper than the modulus, as it may be, is the modulus there: nothing is lost
   subroutine test_steep_table()
      real(wp), parameter :: last(2) = [0.01_wp, 0.03_wp], excess = 1.009_wp, part = 0.6_wp
      real(wp) :: before(lanes)
      type(batch_shear_type) :: own
      integer :: l

      call begin("a table as steep as it may be")
      do l = 1, lanes
         call own%set_lane(l, modulus, new_table_curve([0.0_wp, last], &
            & [0.0_wp, excess*modulus*last(1), modulus*last(1)]))
      end do
      peak(:) = last(1)
      set(:) = 0.0_wp
      call own%find_set(1, peak, set)
      call check(set, spread(0.0_wp, 1, lanes), 1.0e-12_wp*last(1), "leaves nothing")
      call check(own%plastic_work(peak, set), spread(0.0_wp, 1, lanes), &
         & 1.0e-12_wp*modulus*last(1)**2, &
         & "and loses nothing")

      ! steep where some strain has already stayed
      do l = 1, lanes
         call own%set_lane(l, modulus, new_table_curve([0.0_wp, last], &
            & [0.0_wp, part*modulus*last(1), &
            & modulus*(part*last(1) + excess*(last(2) - last(1)))]))
      end do
      peak(:) = last(1)
      call own%find_set(1, peak, set)
      before(:) = own%plastic_work(peak, set)
      call check(set, spread((1.0_wp - part)*last(1), 1, lanes), 1.0e-12_wp*last(1), "stays")
      peak(:) = last(2)
      call own%find_set(1, peak, set)
      call check(set, spread((1.0_wp - part)*last(1), 1, lanes), 1.0e-12_wp*last(1), "as it is")
      call check(own%plastic_work(peak, set), before, 1.0e-12_wp*before(1), "at no cost")
   end subroutine test_steep_table

   !> Every shape is the curve it says
   subroutine test_shapes()
      real(wp) :: tau
      integer :: i

      call begin("curve_stress")
      call rest()
      call check(stress_after(0.2_wp, line), 1200.0_wp, 1.0e-10_wp, "a line goes on")
      call check(set(line), 0.0_wp, 1.0e-15_wp, "and leaves nothing behind")
      call rest()
      call check(stress_after(0.005_wp, table), 30.0_wp, 1.0e-12_wp, "a table starts as a line")
      call check(stress_after(0.02_wp, table), 70.0_wp, 1.0e-12_wp, "is a line between its points")
      call check(set(table), 0.02_wp - 70.0_wp/modulus, 1.0e-15_wp, "leaves what does not unload")
      call check(stress_after(0.05_wp, table), 100.0_wp, 1.0e-12_wp, "goes on behind the last")
      call rest()
      call check(stress_after(0.03_wp, longer), 80.0_wp, 1.0e-12_wp, "may have more points")
      do i = 1, 5
         call rest()
         tau = stress_after(0.02_wp*real(i, wp), power)
         call check((tau + coefficient*tau**exponent)/power_modulus, 0.02_wp*real(i, wp), &
            & 1.0e-14_wp, "a power curve has its strain, in one step")
      end do
      call rest()
      do i = 1, 1000
         tau = stress_after(1.0e-4_wp*real(i, wp), power)
      end do
      call check((tau + coefficient*tau**exponent)/power_modulus, 0.1_wp, 1.0e-14_wp, &
         & "and in many")
   end subroutine test_shapes

   !> Energy lost is the area between the curve and the line of unloading
   subroutine test_energy()
      real(wp), parameter :: reached = 0.0508_wp, asymptote = 93.6_wp
      integer, parameter :: steps = 4000
      real(wp) :: area, loss, tau
      integer :: i

      call begin("work")
      call rest()
      loss = 0.0_wp
      do i = 1, steps
         tau = stress_after(reached*real(i, wp)/real(steps, wp), exponential)
         loss = loss + plastic_work(exponential)
      end do
      ! integral of the exponential from zero, less what unloading gives back
      area = asymptote*(reached - tau/modulus) - tau**2/(2.0_wp*modulus)
      call check(loss, area, 1.0e-6_wp*area, "is the area that unloading does not give back")
      call check(loss, 2.68_wp, 5.0e-3_wp, "is the 2.68 MJ/m3 of an independent program")
   end subroutine test_energy

   !> Of every shape it is the area under the curve, by quadrature, less what unloading gives back
   subroutine test_lost()
      integer, parameter :: intervals = 4000
      real(wp), parameter :: reached = 0.044_wp
      real(wp) :: area(lanes), found(lanes), none(lanes), strain(lanes), stress(lanes)
      integer :: i
      logical :: grows

      call begin("lost")
      none(:) = 0.0_wp
      area(:) = 0.0_wp
      do i = 1, intervals
         ! the tables bend where intervals meet
         strain(:) = reached*(real(i, wp) - 0.5_wp)/intervals
         call law%curve_stress(1, strain, none, stress)
         area(:) = area + stress*reached/intervals
      end do
      call law%curve_stress(1, spread(reached, 1, lanes), none, stress)
      call rest()
      call advance(law, spread(reached, 1, lanes), peak, set, plastic_work, grows)
      found(:) = law%plastic_work(peak, set)
      call check(found(line), 0.0_wp, 0.0_wp, "nothing along a line")
      call check(found([exponential, table, longer]), area([exponential, table, longer]) &
         & - stress([exponential, table, longer])**2/(2.0_wp*modulus), 1.0e-6_wp, &
         & "is the area that unloading does not give back")
      call check(found(power), area(power) - stress(power)**2/(2.0_wp*power_modulus), 1.0e-6_wp, &
         & "after Ramberg and Osgood too")
      call check(plastic_work, found, 0.0_wp, "all of it in one step")
   end subroutine test_lost

   !> Nothing changes below the largest strain, nor along a line
   subroutine test_unloading()
      real(wp) :: before(lanes), strain(lanes)
      logical :: grows

      call begin("unloading")
      call rest()
      call advance(law, spread(0.02_wp, 1, lanes), peak, set, plastic_work, grows)
      call check(grows, "tells that a strain has grown")
      before(:) = set
      call advance(law, spread(0.01_wp, 1, lanes), peak, set, plastic_work, grows)
      call check(.not. grows .and. maxval(abs(plastic_work)) <= 0.0_wp, "and that none has")
      call check(set, before, 0.0_wp, "what stays stays to the last bit")
      call check(peak(line) + set(line), 0.0_wp, 0.0_wp, "a line remembers nothing")
      strain(:) = 0.0_wp
      strain(exponential) = 0.03_wp
      call advance(law, strain, peak, set, plastic_work, grows)
      call check(plastic_work(exponential) > 0.0_wp, "a lane goes on")
      call check(peak(table), 0.02_wp, 0.0_wp, "where another, held at 0, keeps its history")
   end subroutine test_unloading

   !> In short steps the way is that in one step
   subroutine test_short_way()
      real(wp), parameter :: asymptote = 93.6_wp, reached = 0.03_wp
      !> From long steps to such as a run takes
      integer, parameter :: steps(3) = [2000, 20000, 200000]
      type(shear_curve_type) :: curve
      type(batch_shear_type) :: short
      real(wp) :: area, spent, tau
      integer :: i, k, l
      logical :: grows

      call begin("short way")
      curve%shape = shape_exponential
      curve%asymptote = asymptote
      do l = 2, lanes
         call short%set_lane(l, modulus, curve)
      end do
      tau = asymptote*rise(modulus*reached/asymptote)
      area = asymptote*(reached - tau/modulus) - tau**2/(2.0_wp*modulus)
      do k = 1, size(steps)
         call rest()
         spent = 0.0_wp
         do i = 1, steps(k)
            call advance(short, spread(reached*real(i, wp)/real(steps(k), wp), 1, lanes), peak, &
               & set, plastic_work, grows)
            spent = spent + plastic_work(exponential)
         end do
         call check(peak(exponential), reached, 0.0_wp, "the largest strain")
         call check(set(exponential), reached - tau/modulus, 1.0e-15_wp*sqrt(real(steps(k), wp)), &
            & "what stays is what the curve leaves")
         call check(spent, area, (modulus*reached/asymptote/steps(k))**2*area &
            & + 1.0e-12_wp*area, "and the work is the area")
         call check(set(line) + peak(line), 0.0_wp, 0.0_wp, "nothing changes along a line")
      end do
   end subroutine test_short_way

   !> The exponential has its digits from the smallest strain to the largest
   subroutine test_digits()
      integer, parameter :: steps = 2000
      real(wp), parameter :: asymptote = 93.6_wp
      type(shear_curve_type) :: curve
      type(batch_shear_type) :: alone
      real(wp) :: exact, none(lanes), off, stays(lanes), strain(lanes), stress(lanes), worst
      integer :: i

      call begin("digits")
      none(:) = 0.0_wp
      worst = 0.0_wp
      off = 0.0_wp
      curve%shape = shape_exponential
      curve%asymptote = asymptote
      call alone%set_lane(exponential, modulus, curve)
      do i = 1, steps
         ! up to 50 asymptotes, where the curve has long been flat
         strain(:) = asymptote/modulus*(0.5_wp**mod(i, 40))*50.0_wp*real(i, wp)/real(steps, wp)
         call law%curve_stress(1, strain, none, stress)
         exact = rise(modulus*strain(1)/asymptote)
         worst = max(worst, abs(stress(exponential)/asymptote - exact)/exact)
         none(exponential) = strain(1)
         call alone%find_set(1, none, stays)
         none(exponential) = 0.0_wp
         off = max(off, abs(stays(exponential) - strain(1) + asymptote/modulus*exact)/strain(1))
      end do
      call check(off < 4.0_wp*epsilon(1.0_wp), "what stays too, as a share of the strain")
      call check(worst < 4.0_wp*epsilon(1.0_wp), "no error beyond four of the last digit")
   end subroutine test_digits

   !> 1 - exp(-x) without cancellation: 2 exp(-x/2) sinh(x/2)
   pure real(wp) function rise(x)
      real(wp), intent(in) :: x

      rise = 2.0_wp*exp(-0.5_wp*x)*sinh(0.5_wp*x)
   end function rise

   !> Back to the history of a new point
   subroutine rest()
      peak(:) = 0.0_wp
      set(:) = 0.0_wp
   end subroutine rest

   !> Stress of a lane after all lanes have moved to a strain
   real(wp) function stress_after(strain, lane) result(stress)
      !> Shear strain
      real(wp), intent(in) :: strain
      !> Lane to look at
      integer, intent(in) :: lane

      real(wp) :: size(lanes)
      logical :: grows

      size(:) = abs(strain)
      call advance(law, size, peak, set, plastic_work, grows)
      stress = sign(merge(power_modulus, modulus, lane == power) &
         & *max(abs(strain) - set(lane), 0.0_wp), strain)
   end function stress_after

end program test_law_ply_batch_shear
