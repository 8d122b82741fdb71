!> Linear hardening against closed forms: the numbers of the theory (steel and aluminium), tension
!> along the tangent modulus, reversed shear; and the rise with the rate.
program test_law_metal_kinematic
   use metals, only : beta, farthest_from_yield, hard, isotropic, linear_metal, load, mixed, &
      & modulus, poisson, set_lanes, shear, slide, step_to, stored_energy, stretch, tangent, &
      & yield, young
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_metal_plastic, only : dissipated, effective_plastic_strain, plastic_strain
   use plydyn_law_metal_kinematic, only : kinematic_constants_type, plastic_kinematic_type
   use testing, only : begin, check, finish
   implicit none

   type(plastic_kinematic_type) :: law

   call set_lanes(law)
   call test_uniaxial_strain()
   call test_tension()
   call test_shear()
   call test_reversal()
   call test_exact_energy()
   call test_search()
   call test_steady_rate()
   call test_any_rate()
   call finish()

contains

   subroutine test_uniaxial_strain()
      real(wp), parameter :: at_limit(2) = [367.5_wp, 192.5_wp], axial(2) = [1890.0_wp, 656.667_wp]
      real(wp), parameter :: lateral(2) = [1680.0_wp, 546.667_wp], bulk(2) = young/1.2_wp
      real(wp), parameter :: flowed(2) = [5.8e-3_wp, 5.304762e-3_wp]
      real(wp) :: first(2), history(lanes, dissipated), stress(lanes, 6)
      integer :: m

      call begin("uniaxial strain")
      do m = 1, 2
         call load(law, yield(m)/(young(m)/1.3_wp)*stretch, 1, history, stress)
         call check(stress(m, 1), at_limit(m), 1.0e-9_wp, "yields at the Hugoniot elastic limit")
         call check(history(m, effective_plastic_strain), 0.0_wp, 1.0e-15_wp, "elastic up to there")
      end do
      call load(law, 0.005_wp*stretch, 1, history, stress)
      first(:) = stress(:2, 1)
      call load(law, 0.01_wp*stretch, 1, history, stress)
      call check((stress(:2, 1) - first)/0.005_wp, bulk, 1.0e-6_wp, "stiff as the bulk beyond")
      call check(stress(:2, 1), axial, 5.0e-4_wp, "axial stress")
      call check(stress(:2, 2), lateral, 5.0e-4_wp, "lateral stress")
      call check(stress(:2, 3), stress(:2, 2), 1.0e-9_wp, "the same on both sides")
      call check(history(:2, effective_plastic_strain), flowed, 5.0e-10_wp, "plastic strain")
      call check(history(:2, plastic_strain), flowed, 5.0e-10_wp, "its axial component")
      call load(law, 0.01_wp*stretch, 1000, history, stress)
      call check(stress(:2, 1), axial, 5.0e-4_wp, "whatever the steps")
   end subroutine test_uniaxial_strain

   subroutine test_tension()
      real(wp) :: flow, history(lanes, dissipated), pulled, strain(6), stress(lanes, 6)
      integer :: l

      call begin("tension")
      pulled = 300.0_wp
      flow = (pulled - yield(1))/modulus
      strain(:) = 0.0_wp
      strain(1) = pulled/young(1) + flow
      strain(2:3) = -poisson*pulled/young(1) - 0.5_wp*flow
      call load(law, strain, 7, history, stress)
      do l = isotropic, mixed
         if (hard(l) <= 0.0_wp) cycle
         call check(stress(l, :), pulled*stretch, 1.0e-9_wp, "hardens with the tangent modulus")
         call check(history(l, effective_plastic_strain), flow, 1.0e-14_wp, "plastic strain")
      end do
      call check((pulled - yield(1))/(strain(1) - yield(1)/young(1)), tangent, 1.0e-9_wp, &
         & "is that of the card")
   end subroutine test_tension

   subroutine test_shear()
      real(wp) :: history(lanes, dissipated), stress(lanes, 6)
      integer :: l

      call begin("shear")
      call load(law, 0.02_wp*slide, 1, history, stress)
      call check(stress(:2, 4), [121.244_wp, 63.509_wp], 5.0e-4_wp, "yields at yield/sqrt(3)")
      call check(history(:2, effective_plastic_strain), [1.068034e-2_wp, 1.018510e-2_wp], &
         & 5.0e-9_wp, "plastic strain")
      call check(history(:2, dissipated), [2.24287_wp, 1.12036_wp], 5.0e-6_wp, "dissipation")
      do l = isotropic, mixed
         if (hard(l) <= 0.0_wp) cycle
         call check(stress(l, 4), 127.38451_wp, 5.0e-6_wp, "hardening")
      end do
   end subroutine test_shear

   !> Shear to and fro: stress, plastic strain and dissipation in closed form
   subroutine test_reversal()
      real(wp), parameter :: there = 0.02_wp, back = -0.015_wp
      real(wp) :: again, flowed, history(lanes, dissipated), moved, radius, returned(6)
      real(wp) :: share, stress(lanes, 6), total
      integer :: i, l, steps, way

      call begin("reversal")
      do way = 1, 2
         steps = merge(1, 250, way == 1)
         call load(law, there*slide, 1, history, stress)
         do i = 1, steps
            call step_to(law, (there + (back - there)*i/steps)*slide, history, stress)
         end do
         do l = isotropic, mixed
            share = hard(l)*modulus/3.0_wp
            flowed = (shear*there - yield(1)/sqrt(3.0_wp))/(shear + share)
            radius = yield(1)/sqrt(3.0_wp) + beta(l)*share*flowed
            moved = (1.0_wp - beta(l))*share*flowed
            again = (moved - radius + shear*(flowed - back))/(shear + share)
            total = (flowed + again)/sqrt(3.0_wp)
            call check(stress(l, 4), moved - radius - share*again, 1.0e-9_wp, "stress")
            call check(history(l, plastic_strain + 3), flowed - again, 1.0e-14_wp, "plastic shear")
            call check(history(l, effective_plastic_strain), total, 1.0e-14_wp, "plastic strain")
            call check(history(l, dissipated), &
               & total*(yield(1) + 0.5_wp*beta(l)*hard(l)*modulus*total), 1.0e-11_wp, "dissipation")
         end do
      end do

      call begin("Bauschinger")
      do l = isotropic, mixed
         share = hard(l)*modulus/3.0_wp
         flowed = (shear*there - yield(1)/sqrt(3.0_wp))/(shear + share)
         radius = yield(1)/sqrt(3.0_wp) + beta(l)*share*flowed
         returned(:) = (there - 2.0_wp*radius/shear)*slide
         call load(law, there*slide, 1, history, stress)
         total = history(l, effective_plastic_strain)
         call step_to(law, (1.0_wp + 1.0e-9_wp)*returned, history, stress)
         call check(history(l, effective_plastic_strain), total, 0.0_wp, "still elastic")
         call step_to(law, (1.0_wp - 1.0e-6_wp)*returned, history, stress)
         call check(history(l, effective_plastic_strain) > total, "yields two radii below")
      end do
   end subroutine test_reversal

   !> To and fro in shear with stops where it yields: every step is straight, and the balance exact
   subroutine test_exact_energy()
      real(wp), parameter :: there = 0.02_wp
      real(wp) :: energy(lanes), flowed, history(lanes, dissipated), known(lanes), older(lanes, 6)
      real(wp) :: radius, share, stops(5), stress(lanes, 6), work(lanes)
      integer :: i, l

      call begin("work of a straight cycle")
      do l = isotropic, mixed
         share = hard(l)*modulus/3.0_wp
         flowed = (shear*there - yield(1)/sqrt(3.0_wp))/(shear + share)
         radius = yield(1)/sqrt(3.0_wp) + beta(l)*share*flowed
         stops(:) = [0.0_wp, yield(1)/sqrt(3.0_wp)/shear, there, there - 2.0_wp*radius/shear, &
            & -0.03_wp]
         history(:, :) = 0.0_wp
         stress(:, :) = 0.0_wp
         work(:) = 0.0_wp
         do i = 2, 5
            older(:, :) = stress
            call step_to(law, stops(i)*slide, history, stress)
            work(:) = work + 0.5_wp*(older(:, 4) + stress(:, 4))*(stops(i) - stops(i - 1))
         end do
         energy(:) = stored_energy(law, spread(stops(5)*slide, 1, lanes), history)
         call check(energy(l) + history(l, dissipated), work(l), 1.0e-12_wp, &
            & "is stored and dissipated, to the last digit")
         known(:) = law%stored_energy(spread(stops(5)*slide, 1, lanes), history)
         call check(known(l), energy(l), 1.0e-12_wp*work(l), "the law knows what is stored")
      end do
   end subroutine test_exact_energy

   !> The search for any yield stress, where there is a closed form
   subroutine test_search()
      real(wp) :: before(lanes), closed(lanes), effective(lanes), found(lanes), mean(lanes, 2)
      real(wp), parameter :: over(4) = [0.5_wp, 1.000001_wp, 1.5_wp, 300.0_wp]
      integer :: i

      call begin("search")
      before(:) = 0.3_wp
      do i = 1, 4
         effective(:) = (yield(1) + 0.3_wp*modulus)*over(i)
         call law%flow(0.0_wp, effective, before, closed, mean(:, 1))
         call law%search(0.0_wp, effective, before, found, mean(:, 2))
         call check(found, closed, 1.0e-14_wp*over(i), "finds the increment of the closed form")
         call check(found*mean(:, 2), closed*mean(:, 1), 1.0e-11_wp*over(i), "and its work")
      end do
   end subroutine test_search

   !> Perfect plasticity sheared at a constant rate: all strain is plastic in the end
   subroutine test_steady_rate()
      real(wp), parameter :: rate = 1000.0_wp, step = 1.0e-7_wp, reference = 40.0_wp
      real(wp), parameter :: power = 5.0_wp
      real(wp) :: energy(lanes), history(lanes, dissipated), last(lanes), strain(lanes, 6)
      real(wp) :: stress(lanes, 6), work(lanes)
      type(kinematic_constants_type) :: metal
      type(plastic_kinematic_type) :: fast
      integer :: i

      call begin("rate")
      metal = linear_metal(young(1), poisson, yield(1), 0.0_wp, 1.0_wp)
      call metal%set_lane(2, fast)
      metal%rate = reference
      metal%power = power
      call metal%set_lane(1, fast)
      history(:, :) = 0.0_wp
      strain(:, :) = 0.0_wp
      stress(:, :) = 0.0_wp
      work(:) = 0.0_wp
      do i = 1, 1000
         strain(:, 4) = rate*step*i
         last(:) = stress(:, 4)
         call fast%update(step, strain, history, stress)
         work(:) = work + 0.5_wp*(last + stress(:, 4))*rate*step
      end do
      energy(:) = stored_energy(fast, strain, history)
      call check((energy(:2) + history(:2, dissipated))/work(:2), [1.0_wp, 1.0_wp], 1.0e-4_wp, &
         & "work is stored and dissipated")
      call check(stress(1, 4)*sqrt(3.0_wp), &
         & yield(1)*(1.0_wp + (rate/sqrt(3.0_wp)/reference)**(1.0_wp/power)), 1.0e-8_wp, &
         & "raises the yield stress as Cowper and Symonds say")
      call check(stress(2, 4)*sqrt(3.0_wp), yield(1), 1.0e-10_wp, "not in lanes without it")
      do i = 1, 3
         call fast%update(0.0_wp, strain, history, stress)
      end do
      call check(stress(1, 4)*sqrt(3.0_wp), yield(1), 1.0e-10_wp, "does not matter without time")
   end subroutine test_steady_rate

   !> Powers, rates, steps and loads over many decades
   subroutine test_any_rate()
      type(kinematic_constants_type) :: metal
      type(plastic_kinematic_type) :: fast
      integer :: i, l

      call begin("any rate")
      metal = linear_metal(young(1), poisson, yield(1), tangent, 0.5_wp)
      do i = -3, 9, 3
         do l = 1, lanes
            metal%rate = 10.0_wp**i
            metal%power = 1.0_wp + 2.0_wp*(l - 1)
            call metal%set_lane(l, fast)
         end do
         call check(farthest_from_yield(fast, 3.0_wp*shear + 0.5_wp*modulus), 0.0_wp, 1.0e-10_wp, &
            & "leaves stress on the yield surface")
      end do
   end subroutine test_any_rate

end program test_law_metal_kinematic
