!> The cohesive law of HTS40/9772, table 6 of the paper, in mm, N, MPa.
program test_law_cohesive_bilinear
   use bond, only : direction, mixed_directions, table_6
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type, cohesive_type, new_cohesive, &
      & new_springs, penalty_floor
   use plydyn_law_cohesive_softening, only : closing_at, damage_at, fracture_at, friction_at, &
      & normal, power_law, shear, slip_at, stretch_at
   use testing, only : begin, check, finish
   implicit none

   !> Most history variables of a point
   integer, parameter :: most = 8

   call test_springs()
   call test_pure_modes()
   call test_toughness()
   call test_onset()
   call test_unloading()
   call test_mode_change()
   call test_closing()
   call test_falling_penalty()
   call test_friction()
   call test_initial_damage()
   call test_growth()
   call finish()

contains

   !> The same opening in all lanes: a size of sliding and one of opening
   pure function opened(sliding, opening) result(all_lanes)
      real(wp), intent(in) :: sliding, opening
      real(wp) :: all_lanes(lanes, 3)

      all_lanes(:, 1) = sliding*direction(1)
      all_lanes(:, 2) = sliding*direction(2)
      all_lanes(:, 3) = opening
   end function opened

   !> Springs resist in all directions and never fail
   subroutine test_springs()
      type(cohesive_type) :: law
      real(wp) :: history(lanes, 0), traction(lanes, 3)

      call begin("springs")
      law = new_springs([1000.0_wp, 400.0_wp])
      call check(law%histories, 0, "have no history")
      call law%update_points(1, 1, opened(5.0_wp, -7.0_wp), history, traction)
      call check(traction(lanes, :), [1200.0_wp, -1600.0_wp, -7000.0_wp], 1.0e-10_wp, &
         & "resist in proportion")
   end subroutine test_springs

   !> Onset, final opening and energy of opening and of sliding alone
   subroutine test_pure_modes()
      type(cohesive_type) :: law
      real(wp), parameter :: first(2) = [4.5365e-5_wp, 1.8711e-4_wp]
      real(wp), parameter :: last(2) = [8.9888e-3_wp, 1.7118e-2_wp]
      real(wp), parameter :: strength(2) = [62.3_wp, 92.3_wp], toughness(2) = [0.28_wp, 0.79_wp]
      real(wp) :: history(lanes, 3), one(2), traction(lanes, 3), middle
      integer :: mode

      law = new_cohesive(table_6())
      do mode = normal, shear
         call begin(merge("opening", "sliding", mode == normal))
         one(:) = 0.0_wp
         one(mode) = 1.0_wp
         history(:, :) = 0.0_wp
         call law%update_points(1, 1, opened(one(2)*first(2), one(1)*first(1)), history, traction)
         call check(norm2(traction(3, :)), strength(mode), 1.0e-3_wp, "reaches the strength")
         call check(history(3, damage_at), 0.0_wp, 1.0e-4_wp, "is intact until then")
         middle = 0.5_wp*(first(mode) + last(mode))
         call law%update_points(1, 1, opened(one(2)*middle, one(1)*middle), history, traction)
         call check(norm2(traction(3, :)), 0.5_wp*strength(mode), 1.0e-3_wp, &
            & "has half the strength half-way")
         call law%update_points(1, 1, opened(one(2)*last(mode), one(1)*last(mode)), history, &
            & traction)
         call check(norm2(traction(3, :)), 0.0_wp, 1.0e-3_wp*strength(mode), &
            & "ends at the final one")
         call law%update_points(1, 1, opened(one(2)*1.001_wp*last(mode), &
            & one(1)*1.001_wp*last(mode)), history, traction)
         call check(history(3, damage_at), 1.0_wp, 0.0_wp, "is then failed")
         call check(norm2(traction(3, :)), 0.0_wp, 0.0_wp, "and carries nothing")
         call check(history(3, fracture_at), toughness(mode), 1.0e-12_wp, "took its toughness")
      end do
   end subroutine test_pure_modes

   !> Toughness between the modes
   subroutine test_toughness()
      type(cohesive_constants_type) :: constants
      type(cohesive_type) :: law
      real(wp), parameter :: exponents(3) = [1.45_wp, 1.634_wp, 2.284_wp]
      real(wp), parameter :: expected(3, 3) = reshape([348.3_wp, 466.7_wp, 616.1_wp, 332.9_wp, &
         & 444.3_wp, 598.7_wp, 301.5_wp, 384.7_wp, 544.4_wp], [3, 3])
      real(wp) :: mix
      integer :: i, k

      call begin("Benzeggagh-Kenane toughness")
      constants = table_6()
      do i = 1, 3
         constants%exponent = exponents(i)
         law = new_cohesive(constants)
         call check(1.0e3_wp*[(law%toughness_of(0.25_wp*real(k, wp)), k=1, 3)], expected(:, i), &
            & 0.05_wp, "at a quarter, a half and three quarters of shear")
      end do

      call begin("power-law toughness")
      constants%criterion = power_law
      constants%exponent = 1.0_wp
      law = new_cohesive(constants)
      call check(law%toughness_of(0.4_wp), 1.0_wp/(0.6_wp/0.28_wp + 0.4_wp/0.79_wp), 1.0e-14_wp, &
         & "is linear with exponent 1")
      constants%exponent = 2.0_wp
      law = new_cohesive(constants)
      mix = 0.3_wp
      call check(((1.0_wp - mix)*law%toughness_of(mix)/0.28_wp)**2 &
         & + (mix*law%toughness_of(mix)/0.79_wp)**2, 1.0_wp, 1.0e-13_wp, &
         & "satisfies its criterion with exponent 2")
      call check(law%toughness_of(0.0_wp), 0.28_wp, 1.0e-14_wp, "is that of opening without shear")
      call check(law%toughness_of(1.0_wp), 0.79_wp, 1.0e-14_wp, "is that of sliding in pure shear")

      call begin("consistent stiffness")
      constants = table_6()
      constants%consistent = .true.
      law = new_cohesive(constants)
      call check(law%stiffness(shear), 1068.4e3_wp, 50.0_wp, "is 1068.4 GPa/mm for table 6")
   end subroutine test_toughness

   !> Damage begins where the squares of the tractions over the strengths add to 1
   subroutine test_onset()
      type(cohesive_type) :: law
      real(wp) :: history(lanes, 3), opening(lanes, 3), traction(lanes, 3)
      integer :: l

      call begin("onset")
      law = new_cohesive(table_6())
      opening(:, :) = mixed_directions(law)
      call check([(norm2(opening(l, :)), l=3, 7, 2)], [5.7906e-5_wp, 8.1805e-5_wp, 1.2286e-4_wp], &
         & 5.0e-9_wp, "lies at the openings of the theory")
      history(:, :) = 0.0_wp
      call law%update_points(1, 1, (1.0_wp - 1.0e-9_wp)*opening, history, traction)
      call check(maxval(history), 0.0_wp, 0.0_wp, "is not reached below it")
      call check((traction(:, 3)/62.3_wp)**2 + (norm2(traction(:, 1:2), 2)/92.3_wp)**2, &
         & spread(1.0_wp, 1, lanes), 1.0e-8_wp, "is the quadratic criterion")
      call law%update_points(1, 1, (1.0_wp + 1.0e-9_wp)*opening, history, traction)
      call check(minval(history(:, damage_at)) > 0.0_wp, "is passed above it")
   end subroutine test_onset

   !> Unloading runs to the origin, and reloading the same way back
   subroutine test_unloading()
      type(cohesive_type) :: law
      real(wp) :: after(lanes, 3), before(lanes, 3), history(lanes, 3), kept(lanes, 3)

      call begin("unloading")
      law = new_cohesive(table_6())
      history(:, :) = 0.0_wp
      call law%update_points(1, 1, 20.0_wp*mixed_directions(law), history, before)
      kept(:, :) = history
      call law%update_points(1, 1, 5.0_wp*mixed_directions(law), history, after)
      call check(reshape(after, [3*lanes]), 0.25_wp*reshape(before, [3*lanes]), 1.0e-12_wp, &
         & "is a straight line to the origin")
      call law%update_points(1, 1, 0.0_wp*mixed_directions(law), history, after)
      call check(maxval(abs(after)), 0.0_wp, 0.0_wp, "ends without traction")
      call law%update_points(1, 1, -20.0_wp*mixed_directions(law), history, after)
      call check(after(lanes, :), -before(lanes, :), 1.0e-12_wp, "slides back the same")
      call law%update_points(1, 1, 20.0_wp*mixed_directions(law), history, after)
      call check(reshape(after, [3*lanes]), reshape(before, [3*lanes]), 1.0e-12_wp, &
         & "and reloading comes to where it left")
      call check(reshape(history, [3*lanes]), reshape(kept, [3*lanes]), 1.0e-14_wp, &
         & "no damage and no energy is added")
   end subroutine test_unloading

   !> Damage stays when the mode changes, also where the new mode alone would make less
   subroutine test_mode_change()
      type(cohesive_type) :: law
      real(wp) :: damage, history(lanes, 3), traction(lanes, 3)
      integer :: i

      call begin("change of mode")
      law = new_cohesive(table_6())
      history(:, :) = 0.0_wp
      call law%update_points(1, 1, opened(0.0_wp, 2.0e-3_wp), history, traction)
      damage = history(1, damage_at)
      do i = 20, 0, -1
         call law%update_points(1, 1, opened(1.0e-4_wp*real(20 - i, wp), 1.0e-4_wp*real(i, wp)), &
            & history, traction)
         call check(history(1, damage_at) >= damage, "never heals")
         damage = history(1, damage_at)
      end do
      call check(norm2(traction(1, :)), (1.0_wp - damage)*493.3e3_wp*2.0e-3_wp, 1.0e-9_wp, &
         & "the new mode is as weak")
   end subroutine test_mode_change

   !> Closed faces resist with the whole stiffness, and closing damages nothing
   subroutine test_closing()
      type(cohesive_type) :: law
      real(wp) :: history(lanes, 3), traction(lanes, 3)

      call begin("closed faces")
      law = new_cohesive(table_6())
      history(:, :) = 0.0_wp
      call law%update_points(1, 1, opened(0.0_wp, -0.01_wp), history, traction)
      call check(maxval(history), 0.0_wp, 0.0_wp, "are never damaged by pressure")
      call check(traction(1, 3), -13733.0_wp, 1.0e-9_wp, "resist with the stiffness")
      call law%update_points(1, 1, opened(5.0e-3_wp, -0.01_wp), history, traction)
      call check(history(1, damage_at) > 0.9_wp, "are damaged by sliding")
      call check(traction(1, 3), -13733.0_wp, 1.0e-9_wp, "and resist closing all the same")
      call law%update_points(1, 1, opened(0.02_wp, -0.01_wp), history, traction)
      call check(history(1, fracture_at), 0.79_wp, 1.0e-12_wp, "take the toughness of shear")
      call check(traction(1, :), [0.0_wp, 0.0_wp, -13733.0_wp], 1.0e-9_wp, &
         & "and, failed, still resist closing")
   end subroutine test_closing

   !> A falling penalty keeps its floor, and what it lets go is counted
   subroutine test_falling_penalty()
      type(cohesive_constants_type) :: constants
      type(cohesive_type) :: law
      real(wp), parameter :: depth = 1.0e-4_wp
      real(wp) :: history(lanes, 4), traction(lanes, 3)

      call begin("falling penalty")
      constants = table_6()
      constants%falling_penalty = .true.
      law = new_cohesive(constants)
      history(:, :) = 0.0_wp
      call law%update_points(1, 1, opened(0.0_wp, -depth), history, traction)
      call check(traction(1, 3), -137.33_wp, 1.0e-9_wp, "is whole where nothing is damaged")
      call law%update_points(1, 1, opened(4.0e-4_wp, -depth), history, traction)
      call check(traction(1, 3), -137.33_wp*(1.0_wp - history(1, damage_at)), 1.0e-9_wp, &
         & "falls with the damage")
      call check(history(1, closing_at), 0.5_wp*depth*137.33_wp*history(1, damage_at), 1.0e-14_wp, &
         & "lets go of elastic energy")
      call law%update_points(1, 1, opened(0.02_wp, -depth), history, traction)
      call check(traction(1, 3), -137.33_wp*penalty_floor, 1.0e-9_wp, "keeps its floor")
      call check(history(1, closing_at), 0.5_wp*depth*137.33_wp*(1.0_wp - penalty_floor), &
         & 1.0e-14_wp, "and lets go no more than that leaves")
      call check(history(1, fracture_at), 0.79_wp, 1.0e-12_wp, "changes nothing in the toughness")
   end subroutine test_falling_penalty

   !> Coulomb's law on a failed face
   subroutine test_friction()
      type(cohesive_constants_type) :: constants
      type(cohesive_type) :: law
      real(wp), parameter :: coefficient = 0.4_wp, depth = 1.0e-4_wp, pressure = 137.33_wp
      !> Sliding that sticks
      real(wp), parameter :: stuck = coefficient*pressure/493.3e3_wp
      real(wp) :: energy, history(lanes, most), traction(lanes, 3)
      integer :: i

      call begin("friction")
      constants = table_6()
      constants%friction = coefficient
      law = new_cohesive(constants)
      call check(law%histories, most, "has the whole history")
      history(:, :) = 0.0_wp
      call law%update_points(1, 1, opened(0.0_wp, 0.01_wp), history, traction)
      call check(maxval(abs(traction)), 0.0_wp, 0.0_wp, "the face has failed")
      call law%update_points(1, 1, opened(0.0_wp, -depth), history, traction)
      call law%update_points(1, 1, opened(0.5_wp*stuck, -depth), history, traction)
      call check(traction(1, 1:2), 0.5_wp*coefficient*pressure*direction, 1.0e-9_wp, &
         & "sticks at first")
      call check(history(1, friction_at), 0.0_wp, 1.0e-16_wp, "takes no energy by that")
      do i = 1, 100
         call law%update_points(1, 1, opened(stuck + 1.0e-5_wp*real(i, wp), -depth), history, &
            & traction)
      end do
      call check(traction(1, 1:2), coefficient*pressure*direction, 1.0e-9_wp, &
         & "is the coefficient times the pressure")
      call check(history(1, slip_at:slip_at + 1), 1.0e-3_wp*direction, 1.0e-12_wp, &
         & "slips by what does not stick")
      energy = coefficient*pressure*1.0e-3_wp
      call check(history(1, friction_at), energy, 0.01_wp*energy, "takes traction times slip")
      call check(history(1, fracture_at), 0.28_wp, 1.0e-12_wp, "adds nothing to the fracture")

      ! back again
      call law%update_points(1, 1, opened(1.0e-3_wp - stuck, -depth), history, traction)
      call check(traction(1, 1:2), -coefficient*pressure*direction, 1.0e-9_wp, &
         & "turns round with the sliding")
      call law%update_points(1, 1, opened(0.0_wp, 1.0e-5_wp), history, traction)
      call check(maxval(abs(traction)), 0.0_wp, 0.0_wp, "ends when the face opens")
      call check(history(1, stretch_at), 0.0_wp, 0.0_wp, "and forgets what it held")
      call law%update_points(1, 1, opened(0.0_wp, -depth), history, traction)
      call check(maxval(abs(traction(:, 1:2))), 0.0_wp, 0.0_wp, "begins anew when it closes")
   end subroutine test_friction

   !> Initial damage weakens, and what is left of the toughness is taken later
   subroutine test_initial_damage()
      type(cohesive_type) :: law
      real(wp), parameter :: damage = 0.9_wp
      real(wp) :: history(lanes, 3), r, traction(lanes, 3)

      call begin("initial damage")
      law = new_cohesive(table_6())
      history(:, :) = 0.0_wp
      history(:, damage_at) = damage
      call law%update_points(1, 1, opened(0.0_wp, 4.0e-5_wp), history, traction)
      call check(traction(1, 3), (1.0_wp - damage)*4.0e-5_wp*1373.3e3_wp, 1.0e-9_wp, &
         & "weakens from the start")
      call law%update_points(1, 1, opened(0.0_wp, 0.1_wp), history, traction)
      r = 2.0_wp*0.28_wp*1373.3e3_wp/62.3_wp**2
      call check(history(1, fracture_at), 0.28_wp*(1.0_wp - damage/(r - damage*(r - 1.0_wp))), &
         & 1.0e-12_wp, "leaves the rest of the toughness")
      history(:, :) = 0.0_wp
      history(:, damage_at) = 1.0_wp
      call law%update_points(1, 1, opened(0.1_wp, 0.1_wp), history, traction)
      call check(maxval(abs(traction)), 0.0_wp, 0.0_wp, "of 1 is a delamination")
      call check(history(1, fracture_at), 0.0_wp, 0.0_wp, "which takes no energy")
   end subroutine test_initial_damage

   !> No growth is overlooked where the load falls, rises again and changes its mode: damage is the
   !> largest that a straight path to any of the openings so far would have left
   subroutine test_growth()
      integer, parameter :: paths = 200, steps = 30
      !> Opening and sliding at which all fails, more or less
      real(wp), parameter :: reach(2) = [0.01_wp, 0.02_wp]
      type(cohesive_constants_type) :: constants
      type(cohesive_type) :: law
      real(wp) :: draw(3), expected, history(lanes, most), off, size(2), traction(lanes, 3)
      integer :: i, k

      call begin("growth")
      off = 0.0_wp
      do i = 1, paths
         constants = table_6()
         if (mod(i, 2) == 0) constants%criterion = power_law
         call random_number(draw)
         constants%exponent = 0.5_wp + 2.0_wp*draw(1)
         law = new_cohesive(constants)
         history(:, :) = 0.0_wp
         expected = 0.0_wp
         do k = 1, steps
            call random_number(draw)
            size(:) = reach*draw(1:2)*draw(3)*k/steps
            call law%update_points(1, 1, opened(size(2), size(1)), history(:, :law%histories), &
               & traction)
            expected = max(expected, straight_damage(law, size))
            off = max(off, maxval(abs(history(:, damage_at) - expected)))
         end do
      end do
      call check(off, 0.0_wp, 1.0e-12_wp, "of the straight path that leads furthest")
   end subroutine test_growth

   !> Damage at the end of a straight path from an intact point
   pure real(wp) function straight_damage(law, size) result(damage)
      type(cohesive_type), intent(in) :: law
      !> Opening and sliding
      real(wp), intent(in) :: size(2)

      real(wp) :: energy(2), f, mix, r

      energy(:) = law%stiffness*size**2
      mix = energy(2)/sum(energy)
      f = sqrt(dot_product(law%onset, energy))
      r = 2.0_wp*law%toughness_of(mix)*f**2/sum(energy)
      damage = min(max(r*(f - 1.0_wp)/(f*(r - 1.0_wp)), 0.0_wp), 1.0_wp)
   end function straight_damage

end program test_law_cohesive_bilinear
