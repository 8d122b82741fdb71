!> Permanent shear: stress and permanent strain of published curves, under loads that turn, and when
!> the matrix has cracked; crushing through the thickness.
program test_law_ply_fracture_permanent
   use fracture_point, only : fracture_ply, fracture_point_type, new_fracture_point
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : by_ply_plasticity
   use plydyn_law_ply_fracture_constants, only : fracture_constants_type
   use plydyn_law_ply_fracture_fracture, only : ply_fracture_type
   use plydyn_law_ply_fracture_history, only : crushed, histories, matrix_damage, &
      & plastic_shear
   use plydyn_law_ply_shear_curve, only : check_curve, new_power_curve, new_table_curve
   use testing, only : begin, check, check_error, finish
   implicit none

   !> Widths of crack bands that soften slowly
   real(wp), parameter :: widths(2) = [0.1_wp, 0.05_wp]
   !> Ramberg and Osgood of IM7/8552: strain = (stress + coefficient stress**exponent)/G12
   real(wp), parameter :: coefficient = 4.06e-9_wp/5290.0_wp, exponent = 5.4_wp
   !> Hardening of `fracture_ply`
   real(wp), parameter :: hardening = 0.05_wp
   !> Permanent strain that is neglected, and the last digit of the published strains
   real(wp), parameter :: neglected = 1.0e-6_wp, digit = 0.5e-5_wp
   !> A curve by points that leaves the origin below the modulus, and stiffens before its end
   real(wp), parameter :: strains(5) = [0.0_wp, 0.01_wp, 0.02_wp, 0.03_wp, 0.05_wp]
   real(wp), parameter :: stresses(5) = [0.0_wp, 21.73_wp, 40.38_wp, 63.0_wp, 80.16_wp]

   call test_power_curve()
   call test_hardening()
   call test_reversed()
   call test_points()
   call test_points_reversed()
   call test_steep_points()
   call test_mixed_lanes()
   call test_power_reversed()
   call test_frozen()
   call test_crushing()
   call finish()

contains

   !> IM7/8552 by Ramberg and Osgood, so strong that the matrix does not crack
   pure function power_ply() result(ply)
      type(fracture_constants_type) :: ply

      ply = strong_ply()
      ply%curve = new_power_curve(ply%shear(1)*coefficient, exponent)
   end function power_ply

   !> IM7/8552, the strengths of its matrix and shear ten times as large
   pure function strong_ply() result(ply)
      type(fracture_constants_type) :: ply

      ply = fracture_ply()
      ply%matrix_strength(:) = 10.0_wp*ply%matrix_strength
      ply%shear_strength = 10.0_wp*ply%shear_strength
      ply%matrix_toughness(:) = 1000.0_wp*ply%matrix_toughness
   end function strong_ply

   !> Strains of the table of the dossier, component by component
   subroutine test_power_curve()
      real(wp), parameter :: strain(6) = [0.00574_wp, 0.01060_wp, 0.02029_wp, 0.02964_wp, &
         & 0.04886_wp, 0.06733_wp]
      real(wp), parameter :: stress(6) = [30.0_wp, 50.0_wp, 70.0_wp, 80.0_wp, 92.3_wp, 100.0_wp]
      real(wp), parameter :: left(6) = [0.00007_wp, 0.00115_wp, 0.00706_wp, 0.01451_wp, &
         & 0.03142_wp, 0.04843_wp]
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp) :: slope
      integer :: component, i

      ply = power_ply()
      do component = 4, 5
         call begin("power curve of "//merge("12", "13", component == 4))
         point = new_fracture_point(ply, widths)
         do i = 1, size(strain)
            call point%lead(unit(component, strain(i)), 7)
            ! what half a digit of the strain is on the curve, and the neglected strain
            slope = ply%shear(1)/(1.0_wp + exponent*4.06e-9_wp*stress(i)**(exponent - 1.0_wp))
            call check(point%stress(component), stress(i), (digit + neglected)*ply%shear(1) &
               & *max(slope/ply%shear(1), 0.1_wp), "stress at the strain")
            call check(point%history(plastic_shear + component - 4), left(i), 2.0_wp*digit, &
               & "permanent strain")
         end do
      end do
   end subroutine test_power_curve

   !> The same ply with a curve by points
   pure function points_ply() result(ply)
      type(fracture_constants_type) :: ply

      ply = strong_ply()
      ply%shear(2) = 4.9e3_wp
      ply%curve = new_table_curve(strains, stresses)
   end function points_ply

   !> Stress and permanent strain at each point of the curve, and on its last line beyond; that of
   !> 23 is at stresses in the ratio of the strengths
   subroutine test_points()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp) :: left, ratio, stress, total, yields(3)
      integer :: i, k

      ply = points_ply()
      call begin("curve by points")
      do k = 1, 3
         ratio = merge(ply%cross_strength()/ply%shear_strength, 1.0_wp, k == 3)
         point = new_fracture_point(ply, widths)
         do i = 2, 6
            stress = merge(stresses(min(i, 5)), 2.0_wp*stresses(5) - stresses(4), i < 6)
            total = merge(strains(min(i, 5)), 2.0_wp*strains(5) - strains(4), i < 6)
            left = total - stress/ply%shear(1)
            ! the permanent strain that is neglected is missing in both
            call point%lead(unit(3 + k, left + ratio*stress/ply%shear(k) - neglected), 3)
            call check(point%stress(3 + k), ratio*stress, 1.0e-11_wp*stress, "stress of a point")
            call check(point%history(plastic_shear + k - 1), left - neglected, 1.0e-14_wp, &
               & "permanent strain of a point")
         end do
      end do
      call check(ply%yields_at_once(), "yields from no stress on")
      yields(:) = ply%first_yields()
      call check(yields(2), neglected/(0.01_wp/21.73_wp - 1.0_wp/ply%shear(1)), 1.0e-12_wp, &
         & "but for the strain that is neglected")
   end subroutine test_points

   !> Load that turns: yield goes on from the accumulated permanent strain, at once in one step
   subroutine test_points_reversed()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      integer :: steps

      ply = points_ply()
      call begin("load that turns, curve by points")
      do steps = 1, 20, 19
         point = new_fracture_point(ply, widths)
         call point%lead(unit(4, strains(3) - neglected), steps)
         call point%lead(unit(4, strains(3) - neglected - 2.0_wp*stresses(3)/ply%shear(1) &
            & - (strains(5) - strains(3))), steps)
         call check(point%stress(4), -stresses(5), 1.0e-11_wp*stresses(5), "stress of a point")
         call check(point%history(plastic_shear), 2.0_wp*(strains(3) - stresses(3)/ply%shear(1) &
            & - neglected) - (strains(5) - stresses(5)/ply%shear(1) - neglected), 1.0e-14_wp, &
            & "permanent strain, signed")
      end do
   end subroutine test_points_reversed

   !> A first line little steeper than the modulus is elastic; a steeper one is refused
   subroutine test_steep_points()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      type(error_type), allocatable :: error

      call begin("curve by points that leaves the origin with the modulus")
      ply = points_ply()
      ply%curve = new_table_curve([0.0_wp, 0.01_wp, 0.02_wp], [0.0_wp, 1.005_wp, 1.2_wp]*52.9_wp)
      call check_curve(ply%curve, ply%shear(1), ply%shear_strength, error)
      call check(.not. allocated(error), "takes half a hundredth more")
      call check(.not. ply%yields_at_once(), "does not yield at once")
      point = new_fracture_point(ply, widths)
      call point%lead(unit(4, 0.0099_wp), 1)
      call check(point%stress(4), 0.0099_wp*ply%shear(1), 1.0e-11_wp, "elastic")
      call check(point%history(plastic_shear), 0.0_wp, 0.0_wp, "to its first point")
      call point%lead(unit(4, 0.02_wp), 7)
      call check(point%stress(4), 1.2_wp*52.9_wp, 1.0e-9_wp, "and on to the next")
      ply%curve = new_table_curve([0.0_wp, 0.01_wp], [0.0_wp, 1.02_wp*52.9_wp])
      call check_curve(ply%curve, ply%shear(1), ply%shear_strength, error)
      call check_error(error, "more than the modulus", "refuses two hundredths more")
      ply%curve = new_table_curve([0.0_wp, 0.01_wp], [0.0_wp, 52.9_wp])
      call check(minval(ply%first_yields()) > 1.0e20_wp, "a line alone never yields")
   end subroutine test_steep_points

   !> Lanes with curves of different lengths and without any: each as by itself
   subroutine test_mixed_lanes()
      type(fracture_constants_type) :: ply(3)
      type(fracture_point_type) :: point
      type(ply_fracture_type) :: law
      real(wp) :: history(lanes, histories), strain(6), stress(lanes, 6)
      integer :: i, l

      call begin("lanes with different curves")
      ply(:) = [points_ply(), strong_ply(), points_ply()]
      ply(3)%curve = new_table_curve([0.0_wp, 0.02_wp], [0.0_wp, 50.0_wp])
      do l = 1, lanes
         call law%set_lane(l, ply(modulo(l - 1, 3) + 1))
      end do
      history(:, :) = 0.0_wp
      call law%start_history(spread(widths, 1, lanes), spread(widths(1), 1, lanes), history)
      strain(:) = [0.0_wp, 0.0_wp, 0.0_wp, 0.03_wp, -0.02_wp, 0.025_wp]
      stress(:, :) = 0.0_wp
      do i = 1, 4
         call law%update(0.0_wp, spread(strain*i/4.0_wp, 1, lanes), history, stress)
      end do
      do l = 1, min(lanes, 3)
         point = new_fracture_point(ply(l), widths)
         call point%lead(strain, 4)
         call check(stress(l, :), point%stress, 1.0e-11_wp, "stress of a lane")
      end do
   end subroutine test_mixed_lanes

   !> Strain of one component alone
   pure function unit(component, size) result(strain)
      integer, intent(in) :: component
      real(wp), intent(in) :: size
      real(wp) :: strain(6)

      strain(:) = 0.0_wp
      strain(component) = size
   end function unit

   !> Linear hardening: slope and permanent strain of each component in closed form
   subroutine test_hardening()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp) :: first, grown, slope, yields(3)
      integer :: k

      ply = strong_ply()
      yields(:) = ply%first_yields()
      call begin("linear hardening")
      call check(yields(2), 66.9_wp, 1.0e-12_wp, "13 yields as 12 does")
      call check(yields(3)/yields(1), ply%cross_strength()/ply%shear_strength, 1.0e-14_wp, &
         & "23 at stresses in the ratio of the strengths")
      do k = 1, 3
         point = new_fracture_point(ply, widths)
         first = yields(k)/ply%shear(k)
         ! the permanent strain of 12 at stresses in the ratio of the first yields
         slope = hardening*ply%shear(1)*yields(k)/yields(1)
         call point%lead(unit(3 + k, 3.0_wp*first), 11)
         grown = (3.0_wp*first - first)/(1.0_wp + slope/ply%shear(k))
         call check(point%history(plastic_shear + k - 1), grown, 1.0e-14_wp, "permanent strain")
         call check(point%stress(3 + k), yields(k) + slope*grown, 1.0e-10_wp, &
            & "yield stress")
         ! the area under the yield stress over the permanent strain, by the trapezoidal rule of
         ! steps: exact but in the step that meets the first yield
         call check(point%energy_of(by_ply_plasticity), yields(k)*grown + 0.5_wp*slope &
            & *grown**2, 0.2_wp*yields(k)*first, "plastic work")
         call point%lead(unit(3 + k, grown), 5)
         call check(point%stress(3 + k), 0.0_wp, 1.0e-10_wp, "no stress at the permanent strain")
      end do
   end subroutine test_hardening

   !> Strain there and back beyond yield: the permanent strain has the sign of the load, and the
   !> yield stress what both ways have hardened
   subroutine test_reversed()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp) :: back, first, forth, over, yield

      ply = strong_ply()
      call begin("load that turns, linear hardening")
      point = new_fracture_point(ply, widths)
      first = 66.9_wp/ply%shear(1)
      call point%lead(unit(4, 4.0_wp*first), 8)
      forth = 3.0_wp*first/(1.0_wp + hardening)
      yield = 66.9_wp + hardening*ply%shear(1)*forth
      ! elastic by twice the yield stress, then the rest flows back
      call point%lead(unit(4, forth - yield/ply%shear(1)), 6)
      call check(point%history(plastic_shear), forth, 1.0e-14_wp, "elastic to the yield stress")
      call check(point%stress(4), -yield, 1.0e-9_wp, "and to its negative")
      over = 5.0_wp*first
      call point%lead(unit(4, forth - yield/ply%shear(1) - over), 9)
      back = over/(1.0_wp + hardening)
      call check(point%history(plastic_shear), forth - back, 1.0e-14_wp, "permanent strain, signed")
      call check(point%history(plastic_shear) < 0.0_wp, "to the other side")
      call check(point%stress(4), -(yield + hardening*ply%shear(1)*back), 1.0e-9_wp, &
         & "yield stress of both ways")
   end subroutine test_reversed

   !> The same along a power curve: yield goes on from the accumulated permanent strain
   subroutine test_power_reversed()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp) :: accumulated, stress

      ply = power_ply()
      call begin("load that turns, power curve")
      point = new_fracture_point(ply, widths)
      call point%lead(unit(4, 0.03_wp), 9)
      accumulated = point%history(plastic_shear)
      call point%lead(unit(4, -0.03_wp), 40)
      accumulated = accumulated + abs(point%history(plastic_shear) - accumulated)
      stress = ((accumulated + neglected)/coefficient)**(1.0_wp/exponent)
      call check(point%stress(4), -stress, 1.0e-9_wp*stress, "stress of the accumulated strain")
      call check(point%stress(4), ply%shear(1)*(-0.03_wp - point%history(plastic_shear)), &
         & 1.0e-10_wp*stress, "elastic strain beside the permanent one")
   end subroutine test_power_reversed

   !> A cracked matrix shears no further: its permanent strain stays
   subroutine test_frozen()
      type(fracture_point_type) :: point
      real(wp) :: kept

      call begin("a cracked matrix")
      point = new_fracture_point(fracture_ply(), widths)
      call point%lead(unit(4, 0.016_wp), 20)
      kept = point%history(plastic_shear)
      call check(kept > 0.0_wp .and. point%history(matrix_damage) <= 0.0_wp, &
         & "yields before it cracks")
      call point%lead([0.0_wp, 0.006_wp, 0.0_wp, 0.016_wp, 0.0_wp, 0.0_wp], 20)
      call check(point%history(matrix_damage) > 0.0_wp, "cracks")
      kept = point%history(plastic_shear)
      call point%lead([0.0_wp, 0.006_wp, 0.0_wp, 0.06_wp, 0.0_wp, 0.0_wp], 20)
      call check(point%history(plastic_shear), kept, 0.0_wp, "has no more permanent strain")
   end subroutine test_frozen

   !> Pressure through the thickness up to its limit; what it leaves, and the work
   subroutine test_crushing()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp) :: c33, first

      ply = strong_ply()
      ply%crush_stress = 300.0_wp
      call begin("crushing through the thickness")
      point = new_fracture_point(ply, widths)
      call point%move(unit(3, -1.0e-3_wp))
      c33 = -point%stress(3)/1.0e-3_wp
      first = 300.0_wp/c33
      call point%lead(unit(3, -0.9_wp*first), 3)
      call point%lead(unit(3, -first), 1)
      call point%lead(unit(3, -2.0_wp*first), 10)
      call check(point%stress(3), -300.0_wp, 1.0e-9_wp, "the pressure stays")
      call check(point%history(crushed), -first, 1.0e-14_wp, "the strain beyond it is permanent")
      call check(point%energy_of(by_ply_plasticity), 300.0_wp*first, 1.0e-10_wp, "and dissipates")
      call point%lead(unit(3, -first), 5)
      call check(point%stress(3), 0.0_wp, 1.0e-9_wp, "unloads to it")
      call check(point%dissipated(), 300.0_wp*first, 1.0e-10_wp, "without dissipation")
   end subroutine test_crushing

end program test_law_ply_fracture_permanent
