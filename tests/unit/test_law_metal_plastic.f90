!> The return keeps stress on the yield surface, the rate equations and the balance of energy.
!> References: Krieg's solution for a turning path, and the rate equations integrated here in
!> their own way.
program test_law_metal_plastic
   use metals, only : aluminium, beta, hard, isotropic, load, mixed, modulus, poisson, set_lanes, &
      & shear, slide, steel, step_to, stored_energy, stretch, yield, young
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_elastic, only : ply_stiffness
   use plydyn_law_metal_plastic, only : dissipated, effective_plastic_strain
   use plydyn_law_metal_kinematic, only : plastic_kinematic_type
   use testing, only : begin, check, finish
   implicit none

   type(plastic_kinematic_type) :: law

   call set_lanes(law)
   call test_lanes()
   call test_unloading()
   call test_turn()
   call test_rate_equations()
   call test_surface()
   call test_energy_of_a_loop()
   call finish()

contains

   !> Von Mises value of a stress
   pure real(wp) function mises(stress)
      real(wp), intent(in) :: stress(6)

      mises = sqrt(1.5_wp*sum((stress(:3) - sum(stress(:3))/3.0_wp)**2) + 3.0_wp*sum(stress(4:)**2))
   end function mises

   subroutine test_lanes()
      real(wp) :: history(lanes, dissipated), stress(lanes, 6)
      integer :: l

      call begin("lanes of other laws")
      call check(law%histories, dissipated, "have room for the history")
      call check(count(law%owns), lanes - 2, "are not owned")
      history(:, :) = 0.0_wp
      history(lanes - 1:, :) = -7.0_wp
      stress(:, :) = 3.0_wp
      do l = 1, 3
         call step_to(law, 0.01_wp*l*slide, history, stress)
      end do
      call check(pack(stress(lanes - 1:, :), .true.), spread(3.0_wp, 1, 12), 0.0_wp, &
         & "keep their stress")
      call check(pack(history(lanes - 1:, :), .true.), spread(-7.0_wp, 1, 16), 0.0_wp, &
         & "keep their history")
      call check(all(history(:lanes - 2, effective_plastic_strain) > 0.0_wp), "the others flow")

      call begin("rest")
      call load(law, 0.0_wp*slide, 1, history, stress)
      call check(maxval(abs(history)) + maxval(abs(stress)), 0.0_wp, 0.0_wp, "stays at rest")
   end subroutine test_lanes

   subroutine test_unloading()
      real(wp), parameter :: some(6) = [-3.0e-4_wp, 1.0e-4_wp, 2.0e-4_wp, -5.0e-4_wp, 1.0e-4_wp, &
         & -2.0e-4_wp]
      real(wp), parameter :: far(6) = [0.01_wp, -0.004_wp, 0.0_wp, 0.02_wp, -0.01_wp, 0.015_wp]
      real(wp) :: before(lanes, dissipated), history(lanes, dissipated), modulus(6, 6)
      real(wp) :: older(lanes, 6), stress(lanes, 6)
      integer :: l, m

      call begin("unloading")
      call load(law, far, 10, history, stress)
      before(:, :) = history
      older(:, :) = stress
      call step_to(law, far + some, history, stress)
      do l = 1, mixed
         m = merge(2, 1, l == aluminium)
         modulus(:, :) = ply_stiffness(spread(young(m), 1, 3), spread(poisson, 1, 3), &
            & spread(young(m)/(2.0_wp*(1.0_wp + poisson)), 1, 3))
         call check(stress(l, :) - older(l, :), matmul(modulus, some), 1.0e-9_wp, "is elastic")
         call check(history(l, :), before(l, :), 0.0_wp, "leaves the history alone")
      end do
   end subroutine test_unloading

   !> Krieg's exact solution: a perfectly plastic point, sheared after it was stretched
   subroutine test_turn()
      integer, parameter :: steps(2) = [1000, 2000]
      real(wp) :: angle, error(2), history(lanes, dissipated), limit, sheared, stress(lanes, 6)
      integer :: i, run

      call begin("turn")
      limit = yield(1)/(2.0_wp*shear)
      sheared = 0.004_wp
      angle = 2.0_wp*atan(exp(-2.0_wp*shear*sheared/sqrt(2.0_wp)/(sqrt(2.0_wp/3.0_wp)*yield(1))))
      do run = 1, 2
         call load(law, 3.0_wp*limit*stretch, 1, history, stress)
         do i = 1, steps(run)
            call step_to(law, 3.0_wp*limit*stretch + sheared*i/steps(run)*slide, history, stress)
         end do
         error(run) = stress(steel, 4) - yield(1)/sqrt(3.0_wp)*cos(angle)
         call check(stress(steel, 1) - stress(steel, 2), yield(1)*sin(angle), &
            & 200.0_wp/steps(run), "stretched part")
      end do
      call check(error(1), 0.0_wp, 0.05_wp, "sheared part")
      call check(error(1)/error(2), 2.0_wp, 0.05_wp, "converges with the step")
   end subroutine test_turn

   !> A bent path with all components, all kinds of hardening
   subroutine test_rate_equations()
      real(wp), parameter :: legs(6, 3) = reshape([ &
         & 0.004_wp, -0.001_wp, 0.000_wp, 0.002_wp, 0.000_wp, 0.000_wp, &
         & 0.001_wp, 0.003_wp, -0.002_wp, 0.004_wp, 0.003_wp, -0.002_wp, &
         & 0.000_wp, -0.001_wp, 0.004_wp, -0.001_wp, 0.002_wp, 0.006_wp], [6, 3])
      integer, parameter :: steps(2) = [500, 1000]
      real(wp) :: effective, error(2), expected(6), history(lanes, dissipated), strain(6)
      real(wp) :: stress(lanes, 6)
      integer :: i, l, leg, run

      call begin("bent path")
      do l = isotropic, mixed
         call integrate(legs, beta(l)*hard(l)*modulus, (1.0_wp - beta(l))*hard(l)*modulus, &
            & expected, effective)
         do run = 1, 2
            strain(:) = 0.0_wp
            history(:, :) = 0.0_wp
            do leg = 1, 3
               do i = 1, steps(run)
                  strain(:) = strain + legs(:, leg)/steps(run)
                  call step_to(law, strain, history, stress)
               end do
            end do
            error(run) = norm2(stress(l, :) - expected)
            call check(history(l, effective_plastic_strain), effective, 2.0e-3_wp/steps(run), &
               & "plastic strain of the rate equations")
         end do
         call check(error(1), 0.0_wp, 0.1_wp, "stress of the rate equations")
         call check(error(1)/error(2), 2.0_wp, 0.1_wp, "converges with the step")
      end do
   end subroutine test_rate_equations

   !> Stress at the end of a path by the rate equations of plasticity, in small explicit steps
   subroutine integrate(legs, isotropic, kinematic, stress, effective)
      real(wp), intent(in) :: legs(:, :), isotropic, kinematic
      real(wp), intent(out) :: stress(6), effective

      integer, parameter :: steps = 100000
      real(wp) :: back(6), normal(6), half(6), pushed, rate(6), relative(6), size, trial
      integer :: i, leg, stage

      stress(:) = 0.0_wp
      back(:) = 0.0_wp
      effective = 0.0_wp
      do leg = 1, 3
         ! tensor components
         rate(:) = legs(:, leg)/steps
         rate(4:) = 0.5_wp*rate(4:)
         do i = 1, steps
            ! the direction of flow is taken half way through the step
            half(:) = stress
            trial = 0.0_wp
            do stage = 1, 2
               relative(:) = half - back
               relative(:3) = relative(:3) - sum(relative(:3))/3.0_wp
               size = mises(relative)
               normal(:) = 1.5_wp*relative/max(size, 1.0e-9_wp)
               pushed = 2.0_wp*shear*(sum(normal(:3)*rate(:3)) + 2.0_wp*sum(normal(4:)*rate(4:)))
               trial = max(pushed, 0.0_wp)/(3.0_wp*shear + isotropic + kinematic)
               if (size + 0.5_wp*pushed < yield(1) + isotropic*effective) trial = 0.0_wp
               half(:) = stress + 0.5_wp*elastic(rate - trial*normal)
               half(:) = half - 0.5_wp*2.0_wp/3.0_wp*kinematic*trial*normal
            end do
            stress(:) = stress + elastic(rate - trial*normal)
            back(:) = back + 2.0_wp/3.0_wp*kinematic*trial*normal
            effective = effective + trial
         end do
      end do
   end subroutine integrate

   !> Stress of an elastic strain in tensor components, steel
   pure function elastic(strain) result(stress)
      real(wp), intent(in) :: strain(6)
      real(wp) :: stress(6)

      stress(:) = 2.0_wp*shear*strain
      stress(:3) = stress(:3) + (young(1)/1.2_wp - 2.0_wp/3.0_wp*shear)*sum(strain(:3))
   end function elastic

   !> Next number of a sequence without order, between -1 and 1
   subroutine draw(seed, number)
      integer, intent(inout) :: seed
      real(wp), intent(out) :: number

      seed = mod(16807*mod(seed, 127773) - 2836*(seed/127773) + huge(seed), huge(seed))
      number = 2.0_wp*real(seed, wp)/real(huge(seed), wp) - 1.0_wp
   end subroutine draw

   subroutine test_surface()
      real(wp) :: back(6), history(lanes, dissipated), number, older(lanes, dissipated), radius
      real(wp) :: strain(6), stress(lanes, 6), trace, worst, lost
      integer :: i, k, l, m, seed

      call begin("random walk")
      seed = 4711
      history(:, :) = 0.0_wp
      strain(:) = 0.0_wp
      worst = 0.0_wp
      lost = 0.0_wp
      trace = 0.0_wp
      do i = 1, 2000
         do k = 1, 6
            call draw(seed, number)
            strain(k) = strain(k) + 0.003_wp*number
         end do
         older(:, :) = history
         call step_to(law, strain, history, stress)
         lost = min(lost, minval(history(:mixed, dissipated) - older(:mixed, dissipated)))
         do l = 1, mixed
            m = merge(2, 1, l == aluminium)
            back(:) = 2.0_wp/3.0_wp*(1.0_wp - beta(l))*hard(l)*modulus*history(l, :6)
            back(4:) = 0.5_wp*back(4:)
            radius = yield(m) + beta(l)*hard(l)*modulus*history(l, effective_plastic_strain)
            worst = max(worst, mises(stress(l, :) - back)/radius - 1.0_wp)
            trace = max(trace, abs(sum(history(l, :3))))
         end do
      end do
      call check(minval(history(:mixed, effective_plastic_strain)) > 1.0_wp, "flows all the way")
      call check(worst <= 1.0e-10_wp, "never leaves the yield surface")
      call check(lost >= 0.0_wp, "always dissipates")
      call check(trace, 0.0_wp, 1.0e-13_wp, "keeps the plastic volume")
   end subroutine test_surface

   !> A closed path in strain, round and round
   subroutine test_energy_of_a_loop()
      integer, parameter :: steps(2) = [2000, 4000]
      real(wp) :: angle, energy(lanes), error(mixed, 2), history(lanes, dissipated)
      real(wp) :: last(6), older(lanes, 6), strain(6), stress(lanes, 6), work(lanes)
      integer :: i, run

      call begin("work of a loop")
      do run = 1, 2
         history(:, :) = 0.0_wp
         stress(:, :) = 0.0_wp
         strain(:) = 0.0_wp
         work(:) = 0.0_wp
         do i = 1, steps(run)
            angle = 4.0_wp*acos(-1.0_wp)*i/steps(run)
            last(:) = strain
            strain(:) = 0.01_wp*[sin(angle), 1.0_wp - cos(angle), -sin(angle), &
               & 1.0_wp - cos(2.0_wp*angle), sin(angle), sin(3.0_wp*angle)]
            older(:, :) = stress
            call step_to(law, strain, history, stress)
            work(:) = work + 0.5_wp*matmul(older + stress, strain - last)
         end do
         energy(:) = stored_energy(law, spread(strain, 1, lanes), history)
         error(:, run) = (energy(:mixed) + history(:mixed, dissipated))/work(:mixed) - 1.0_wp
      end do
      call check(error(:, 2), spread(0.0_wp, 1, mixed), 1.0e-3_wp, "is stored and dissipated")
      call check(all(abs(error(:, 2)) < 0.55_wp*abs(error(:, 1))), "the better the finer")
   end subroutine test_energy_of_a_loop

end program test_law_metal_plastic
