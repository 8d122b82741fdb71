!> A cracked matrix: toughness whatever the width of the band and the mode, cracks that are closed,
!> debris.
program test_law_ply_fracture_crack
   use fracture_point, only : fracture_ply, fracture_point_type, new_fracture_point
   use plydyn_base_precision, only : wp
   use plydyn_law_law, only : by_friction, by_matrix_damage
   use plydyn_law_ply_elastic, only : ply_stiffness
   use plydyn_law_ply_fracture_constants, only : fracture_constants_type
   use plydyn_law_ply_shear_curve, only : shear_curve_type
   use plydyn_law_ply_fracture_history, only : held_opening, matrix_damage, slip
   use testing, only : begin, check, finish
   implicit none

   !> Steps to the end of softening. Damage lags behind by less than a step, which is less than
   !> that share of the toughness
   integer, parameter :: steps = 4000
   real(wp), parameter :: step_error = 2.0_wp/steps
   !> What is left of a stiffness
   real(wp), parameter :: residual = 1.0e-6_wp

   call test_toughness()
   call test_mixed_mode()
   call test_wide_band()
   call test_compression()
   call test_closed_crack()
   call test_debris()
   call test_lines()
   call finish()

contains

   !> IM7/8552 without permanent shear
   pure function elastic_ply() result(ply)
      type(fracture_constants_type) :: ply

      ply = fracture_ply()
      ply%curve = shear_curve_type()
      ply%residual = residual
   end function elastic_ply

   !> Opened and sheared, in bands of three widths: the toughness over the width
   subroutine test_toughness()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp), parameter :: width(3) = [0.02_wp, 0.05_wp, 0.1_wp]
      integer, parameter :: component(4) = [2, 3, 4, 5]
      real(wp) :: expected, last, modulus, strength
      integer :: i, k

      ply = elastic_ply()
      call begin("toughness in bands of any width")
      do k = 1, size(component)
         do i = 1, size(width)
            strength = merge(62.3_wp, 92.3_wp, component(k) < 4)
            modulus = merge(9.08e3_wp, 5.29e3_wp, component(k) < 4)
            expected = merge(0.277_wp, 0.788_wp, component(k) < 4)/width(i)
            last = 1.1_wp*2.0_wp*expected/strength
            point = new_fracture_point(ply, [1.0_wp, width(i)])
            call point%pull(component(k), 0.98_wp*strength/modulus, 1)
            call point%pull(component(k), last, steps/4)
            call check(point%energy_of(by_matrix_damage), expected, &
               & 4.0_wp*step_error*expected, "the toughness over the width")
            call check(point%work, point%dissipated() + point%stored(), 1.0e-10_wp*expected, &
               & "work is stored or dissipated")
         end do
      end do
   end subroutine test_toughness

   !> Benzeggagh and Kenane between the modes, along rays of traction on the plane 1-3
   subroutine test_mixed_mode()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp), parameter :: width = 0.05_wp
      real(wp) :: c(6, 6), expected, share, strain(6), toughness
      integer :: i

      ply = elastic_ply()
      c(:, :) = ply_stiffness(ply%young, ply%poisson, ply%shear)
      call begin("mixed modes")
      do i = 1, 3
         strain(:) = [0.0_wp, 1.0_wp, 0.0_wp, real(i, wp), 0.0_wp, 0.0_wp]
         share = c(4, 4)*strain(4)**2/(c(4, 4)*strain(4)**2 + c(2, 2)*strain(2)**2)
         toughness = 0.277_wp + (0.788_wp - 0.277_wp)*share**1.634_wp
         expected = toughness/width
         point = new_fracture_point(ply, [1.0_wp, width])
         call point%lead(0.004_wp*strain, 1)
         call point%lead(0.4_wp*strain, steps)
         call check(point%angle(), 0.0_wp, 1.0e-4_wp, "the plane 1-3")
         call check(point%energy_of(by_matrix_damage), expected, step_error*expected, &
            & "their toughness")
      end do
   end subroutine test_mixed_mode

   !> A band too wide starts early and keeps the toughness
   subroutine test_wide_band()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp) :: c(6, 6), longest(5), most, onset, width
      integer :: i

      ply = elastic_ply()
      c(:, :) = ply_stiffness(ply%young, ply%poisson, ply%shear)
      longest(:) = ply%longest_lengths()
      width = 4.0_wp*longest(3)
      call begin("a wide band")
      call check(count(ply%snaps_back([0.1_wp, width])) >= 1, "is counted")
      point = new_fracture_point(ply, [1.0_wp, width])
      most = 0.0_wp
      do i = 1, 4000
         call point%move([0.0_wp, 1.0e-6_wp*i, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
         most = max(most, point%stress(2))
      end do
      ! the traction at which what is stored is the toughness over 1.05 C22/E2
      onset = sqrt(2.0_wp*0.277_wp*ply%young(2)/(1.05_wp*width))
      call check(most, onset, 1.0e-6_wp*c(2, 2), "onset at the reduced strength")
      call check(point%energy_of(by_matrix_damage), 0.277_wp/width, 3.0_wp*residual &
         & *0.277_wp/width, "the toughness all the same")
   end subroutine test_wide_band

   !> A matrix whose cracks are lines is elastic in tension and pressure far beyond its strengths,
   !> and its shear stays on its curve
   subroutine test_lines()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp), parameter :: large = 0.1_wp, hardening = 0.05_wp
      real(wp) :: c(6, 6), expected, ratio
      integer :: i, k

      call begin("cracks that are lines")
      ply = fracture_ply()
      c(:, :) = ply_stiffness(ply%young, ply%poisson, ply%shear)
      call check(ply%may_crack(), "can be left to lines")
      call check(maxval(abs(ply%crack_strengths() - [62.3_wp, 92.3_wp, 62.3_wp])), 0.0_wp, &
         & 1.0e-12_wp, "with the strengths of the ply")
      call ply%leave_cracks()
      do i = -1, 1, 2
         point = new_fracture_point(ply, [1.0_wp, 1.0_wp])
         call point%lead([0.0_wp, i*large, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 10)
         call check(point%stress(2), i*large*c(2, 2), 1.0e-12_wp*c(2, 2), "elastic across")
      end do
      do k = 4, 6
         point = new_fracture_point(ply, [1.0_wp, 1.0_wp])
         call point%lead(large*[(merge(1.0_wp, 0.0_wp, i == k), i=1, 6)], 10)
         ! stress over permanent strain 23 is that of 12 in the ratio of the strengths
         ratio = merge(ply%cross_strength()/ply%shear_strength, 1.0_wp, k == 6)
         expected = ratio*(66.9_wp + hardening*c(4, 4)*large)/(1.0_wp + ratio*hardening*c(4, 4) &
            & /c(k, k))
         call check(point%stress(k), expected, 1.0e-10_wp*expected, "shear on its curve")
         call check(point%energy_of(by_matrix_damage), 0.0_wp, 1.0e-12_wp, "without damage")
      end do
   end subroutine test_lines

   !> Sheared by compression across: the toughness of shear, beside what friction takes
   subroutine test_compression()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp), parameter :: width = 0.02_wp
      real(wp) :: before

      ply = elastic_ply()
      call begin("compression across the fibres")
      point = new_fracture_point(ply, [1.0_wp, width])
      call point%pull(2, -0.0219_wp, 10)
      call point%pull(2, -0.6_wp, steps/2)
      call check(point%history(matrix_damage), 1.0_wp - residual, 1.0e-14_wp, "cracks through")
      call check(point%energy_of(by_friction) > 0.0_wp, "rubs")
      call check(point%work, point%dissipated() + point%stored(), 1.0e-9_wp*point%work, &
         & "work is stored or dissipated")
      ! from there on the damage is complete, and only friction goes on
      before = point%energy_of(by_matrix_damage)
      call point%pull(2, -0.7_wp, 50)
      call check(point%energy_of(by_matrix_damage), before, 1.0e-9_wp*before, "friction alone")
   end subroutine test_compression

   !> A crack torn open bears pressure as an intact ply does, and rubs by Coulomb
   subroutine test_closed_crack()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp), parameter :: pressed = -2.0e-3_wp
      real(wp) :: c(6, 6), cycle_work, pressure, sheared

      ply = elastic_ply()
      c(:, :) = ply_stiffness(ply%young, ply%poisson, ply%shear)
      call begin("a closed crack")
      point = new_fracture_point(ply, [1.0_wp, 0.1_wp])
      call point%lead([0.0_wp, 0.005_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 20)
      call point%lead([0.0_wp, 0.2_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 50)
      call check(point%history(matrix_damage), 1.0_wp - residual, 1.0e-14_wp, "is torn")
      call point%lead([0.0_wp, pressed, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 20)
      pressure = -c(2, 2)*pressed
      call check(point%stress(2), -pressure, 1.0e-10_wp*pressure, "bears pressure")
      sheared = 2.0_wp*0.3_wp*pressure/ply%shear(1)
      call point%lead([0.0_wp, pressed, 0.0_wp, sheared, 0.0_wp, 0.0_wp], 20)
      call check(point%stress(4), (1.0_wp - residual)*0.3_wp*pressure + residual*ply%shear(1) &
         & *sheared, 1.0e-10_wp*pressure, "slides at the friction of its pressure")
      call point%lead([0.0_wp, pressed, 0.0_wp, -sheared, 0.0_wp, 0.0_wp], 40)
      cycle_work = point%energy_of(by_friction)
      call point%lead([0.0_wp, pressed, 0.0_wp, sheared, 0.0_wp, 0.0_wp], 40)
      ! of the way 2*sheared there, 2*friction/G12 sticks and as much slides
      cycle_work = point%energy_of(by_friction) - cycle_work
      call check(cycle_work, (1.0_wp - residual)*0.3_wp*pressure*sheared, 1.0e-3_wp*cycle_work, &
         & "friction dissipates traction times slip")
      call point%lead([0.0_wp, 0.1_wp, 0.0_wp, sheared, 0.0_wp, 0.0_wp], 40)
      call check(point%stress(4), residual*ply%shear(1)*sheared, 1.0e-10_wp*pressure, &
         & "opened again, it bears nothing")
   end subroutine test_closed_crack

   !> Debris holds a share of the largest opening, up to its limit, and bears pressure there
   subroutine test_debris()
      type(fracture_constants_type) :: ply
      type(fracture_point_type) :: point
      real(wp) :: c(6, 6), held

      ply = elastic_ply()
      ply%debris_share = 0.2_wp
      ply%debris_limit = 0.01_wp
      c(:, :) = ply_stiffness(ply%young, ply%poisson, ply%shear)
      call begin("debris")
      point = new_fracture_point(ply, [1.0_wp, 0.1_wp])
      call point%lead([0.0_wp, 0.005_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 20)
      call point%lead([0.0_wp, 0.03_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 50)
      call check(point%history(held_opening), 0.2_wp*point%history(slip), 1.0e-15_wp, "a share")
      call point%lead([0.0_wp, 0.2_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 50)
      held = point%history(held_opening)
      call check(held, 0.01_wp, 1.0e-15_wp, "not beyond the limit")
      call point%lead([0.0_wp, held - 1.0e-3_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 20)
      call check(point%stress(2), c(2, 2)*((1.0_wp - residual)*(-1.0e-3_wp) &
         & + residual*(held - 1.0e-3_wp)), 1.0e-9_wp, "closes on it with the whole stiffness")
      call check(point%work, point%dissipated() + point%stored(), 1.0e-11_wp, &
         & "work is stored or dissipated")
   end subroutine test_debris

end program test_law_ply_fracture_crack
