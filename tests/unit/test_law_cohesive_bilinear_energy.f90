!> What the cohesive law of HTS40/9772, table 6 of the paper, takes on its way; in mm, N, MPa.
program test_law_cohesive_bilinear_energy
   use bond, only : mixed_directions, mixes, table_6
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type, cohesive_type, new_cohesive
   use plydyn_law_cohesive_softening, only : closing_at, damage_at, fracture_at, friction_at, &
      & normal, share_at, shear, stretch_at
   use testing, only : begin, check, finish
   implicit none

   call test_straight_paths()
   call test_work_of_straight_paths()
   call test_balance()
   call test_two_legs()
   call finish()

contains

   !> A straight path takes the toughness at its mix, whatever the steps and the stiffnesses
   subroutine test_straight_paths()
      type(cohesive_constants_type) :: constants
      type(cohesive_type) :: law
      real(wp), parameter :: ratios(4) = [0.08_wp, 0.3592_wp, 1.0_wp, 6.0_wp]
      real(wp), parameter :: steps(6) = [0.9_wp, 1.3_wp, 7.0_wp, 2.0_wp, 40.0_wp, 2.0e3_wp]
      real(wp) :: history(lanes, 3), toughness(lanes), traction(lanes, 3)
      integer :: criterion, i, l, s

      call begin("straight path")
      do criterion = 1, 2
         do i = 1, size(ratios)
            constants = table_6()
            constants%criterion = criterion
            constants%stiffness(shear) = ratios(i)*constants%stiffness(normal)
            law = new_cohesive(constants)
            history(:, :) = 0.0_wp
            toughness(:) = [(law%toughness_of(mixes(l)), l=1, lanes)]
            do s = 1, size(steps)
               call law%update_points(1, 1, steps(s)*mixed_directions(law), history, traction)
               call check(history(:, share_at), history(:, fracture_at)/toughness, 1.0e-12_wp, &
                  & "the share spent is the energy over the toughness")
            end do
            call check(history(:, damage_at), spread(1.0_wp, 1, lanes), 0.0_wp, "ends in failure")
            call check(history(:, share_at), spread(1.0_wp, 1, lanes), 0.0_wp, "spends all of it")
            call check(history(:, fracture_at)/toughness, spread(1.0_wp, 1, lanes), 1.0e-12_wp, &
               & "takes the toughness of its mix of modes")
         end do
      end do
   end subroutine test_straight_paths

   !> The work of the tractions on straight paths, mode by mode
   subroutine test_work_of_straight_paths()
      type(cohesive_type) :: law
      integer, parameter :: steps = 20000
      real(wp) :: before(lanes, 3), history(lanes, 3), opening(lanes, 3), total(lanes)
      real(wp) :: traction(lanes, 3), work(lanes, 3)
      integer :: i, l

      call begin("work of a straight path")
      law = new_cohesive(table_6())
      history(:, :) = 0.0_wp
      work(:, :) = 0.0_wp
      before(:, :) = 0.0_wp
      opening(:, :) = 0.0_wp
      do i = 0, 2*steps
         ! fine steps to load 2, then to load 400
         associate (next => merge(2.0_wp*real(i, wp)/real(steps, wp), &
            & 2.0_wp + 398.0_wp*real(i - steps, wp)/real(steps, wp), i <= steps) &
            & *mixed_directions(law))
            call law%update_points(1, 1, next, history, traction)
            work(:, :) = work + 0.5_wp*(before + traction)*(next - opening)
            opening(:, :) = next
         end associate
         before(:, :) = traction
      end do
      total(:) = sum(work, 2)
      call check(total, [(law%toughness_of(mixes(l)), l=1, lanes)], 1.0e-6_wp, &
         & "is the toughness at its mix")
      call check(sum(work(:, 1:2), 2)/total, mixes, 1.0e-9_wp, "is shared as the mix says")
   end subroutine test_work_of_straight_paths

   !> The work of a wild path is what is stored and what is lost, and no loss is ever undone
   subroutine test_balance()
      type(cohesive_constants_type) :: constants
      type(cohesive_type) :: law
      integer, parameter :: steps = 100000
      real(wp) :: before(lanes, 3), history(lanes, 8), last(lanes, 8), next(lanes, 3)
      real(wp) :: opening(lanes, 3), phase(lanes), traction(lanes, 3), work(lanes), t
      integer :: i, l
      logical :: monotone

      call begin("balance of energy")
      constants = table_6()
      constants%falling_penalty = .true.
      constants%friction = 0.5_wp
      law = new_cohesive(constants)
      history(:, :) = 0.0_wp
      work(:) = 0.0_wp
      opening(:, :) = 0.0_wp
      before(:, :) = 0.0_wp
      monotone = .true.
      phase(:) = [(real(l, wp), l=1, lanes)]
      do i = 1, steps
         t = real(i, wp)/real(steps, wp)
         next(:, 1) = 6.0e-3_wp*t**2*sin(40.0_wp*t + phase)
         next(:, 2) = 6.0e-3_wp*t*sin(29.0_wp*t)*phase/8.0_wp
         next(:, 3) = 4.0e-4_wp*t*(sin(61.0_wp*t) - 0.5_wp)
         last(:, :) = history
         call law%update_points(1, 1, next, history, traction)
         monotone = monotone .and. all(history(:, :friction_at) >= last(:, :friction_at))
         work(:) = work + 0.5_wp*sum((before + traction)*(next - opening), 2)
         before(:, :) = traction
         opening(:, :) = next
      end do
      call check(monotone, "no energy comes back, no damage heals")
      call check(minval(history(:, damage_at)) > 0.9_wp .and. &
         & minval(history(:, closing_at:friction_at)) > 1.0e-4_wp, "all losses take part")
      call check((stored(law, opening, history) &
         & + history(:, fracture_at) &
         & + sum(history(:, closing_at:friction_at), 2))/work, spread(1.0_wp, 1, lanes), &
         & 1.0e-5_wp, "work is what is stored and lost")
      call check(law%stored_energy(opening, history)/work, stored(law, opening, history)/work, &
         & 1.0e-12_wp, "the law knows what is stored")
   end subroutine test_balance

   !> Elastic energy per area
   pure function stored(law, opening, history) result(energy)
      type(cohesive_type), intent(in) :: law
      real(wp), intent(in) :: opening(lanes, 3), history(lanes, 8)
      real(wp) :: energy(lanes)

      associate (d => history(:, damage_at))
         energy(:) = 0.5_wp*law%stiffness(normal)*((1.0_wp - d)*max(opening(:, 3), 0.0_wp)**2 &
            & + max(1.0_wp - d, law%floor)*min(opening(:, 3), 0.0_wp)**2) &
            & + 0.5_wp*law%stiffness(shear)*(1.0_wp - d)*sum(opening(:, 1:2)**2, 2) &
            & + 0.5_wp*law%friction_stiffness*d*history(:, stretch_at)**2
      end associate
   end function stored

   !> Opening first and then sliding, and the other way round: energies of both modes in J/m2
   subroutine test_two_legs()
      type(cohesive_constants_type) :: constants
      real(wp), parameter :: of_opening(6) = [9.7_wp, 52.0_wp, 142.1_wp, 235.0_wp, 251.4_wp, &
         & 196.5_wp]
      real(wp), parameter :: of_sliding(6) = [737.0_wp, 566.3_wp, 334.2_wp, 132.1_wp, 143.0_wp, &
         & 398.6_wp]
      real(wp), parameter :: consistent_opening(6) = [9.7_wp, 52.0_wp, 142.1_wp, 235.0_wp, &
         & 228.6_wp, 157.7_wp]
      real(wp), parameter :: consistent_sliding(6) = [763.3_wp, 653.2_wp, 431.9_wp, 187.4_wp, &
         & 146.9_wp, 400.9_wp]
      real(wp) :: fracture(lanes), work(lanes, 2)

      call begin("path of two legs")
      constants = table_6()
      call walk_two_legs(constants, work, fracture)
      call check(1.0e3_wp*work(:6, normal), of_opening, 0.055_wp, "work of opening, table 6")
      call check(1.0e3_wp*work(:6, shear), of_sliding, 0.055_wp, "work of sliding, table 6")
      call check(work(:6, normal)/0.28_wp + work(:6, shear)/0.79_wp, &
         & [0.968_wp, 0.903_wp, 0.931_wp, 1.006_wp, 1.079_wp, 1.206_wp], 5.5e-4_wp, &
         & "shares of the toughnesses, table 6")
      call check(fracture, sum(work, 2), 1.0e-4_wp, "the energy lost is the work")

      constants%consistent = .true.
      call walk_two_legs(constants, work, fracture)
      call check(1.0e3_wp*work(:6, normal), consistent_opening, 0.055_wp, &
         & "work of opening, consistent stiffness")
      call check(1.0e3_wp*work(:6, shear), consistent_sliding, 0.055_wp, &
         & "work of sliding, consistent stiffness")
      call check(work(:6, normal)/0.28_wp + work(:6, shear)/0.79_wp, &
         & [1.001_wp, 1.013_wp, 1.054_wp, 1.076_wp, 1.002_wp, 1.071_wp], 5.5e-4_wp, &
         & "shares of the toughnesses, consistent stiffness")
   end subroutine test_two_legs

   !> To a share of one mode's final opening, then the other mode to failure: lanes 1 to 4 open
   !> first, the others slide first
   subroutine walk_two_legs(constants, work, fracture)
      type(cohesive_constants_type), intent(in) :: constants
      real(wp), intent(out) :: work(lanes, 2), fracture(lanes)

      integer, parameter :: steps = 40000
      real(wp), parameter :: share(lanes) = [0.02_wp, 0.1_wp, 0.3_wp, 0.6_wp, 0.1_wp, 0.3_wp, &
         & 0.1_wp, 0.3_wp]
      real(wp), parameter :: fine = 4.0e-4_wp, far = 4.0e-2_wp
      type(cohesive_type) :: law
      real(wp) :: before(lanes, 3), first(lanes), history(lanes, 3), opening(lanes, 3)
      real(wp) :: next(lanes, 3), part, second(lanes), traction(lanes, 3), turn(lanes)
      integer :: i, l

      law = new_cohesive(constants)
      history(:, :) = 0.0_wp
      work(:, :) = 0.0_wp
      before(:, :) = 0.0_wp
      opening(:, :) = 0.0_wp
      turn(:) = [(merge(2.0_wp*0.28_wp/62.3_wp, 2.0_wp*0.79_wp/92.3_wp, l <= 4), l=1, lanes)]*share
      next(:, 2) = 0.0_wp
      do i = 1, 4*steps
         part = real(mod(i - 1, steps) + 1, wp)/real(steps, wp)
         select case ((i - 1)/steps)
         case (0)
            first(:) = part*min(fine, turn)
            second(:) = 0.0_wp
         case (1)
            first(:) = min(fine, turn) + part*(turn - min(fine, turn))
         case (2)
            second(:) = part*fine
         case default
            second(:) = fine + part*(far - fine)
         end select
         next(:4, 3) = first(:4)
         next(:4, 1) = second(:4)
         next(5:, 1) = first(5:)
         next(5:, 3) = second(5:)
         call law%update_points(1, 1, next, history, traction)
         work(:, normal) = work(:, normal) + 0.5_wp*(before(:, 3) + traction(:, 3)) &
            & *(next(:, 3) - opening(:, 3))
         work(:, shear) = work(:, shear) + 0.5_wp*(before(:, 1) + traction(:, 1)) &
            & *(next(:, 1) - opening(:, 1))
         before(:, :) = traction
         opening(:, :) = next
      end do
      fracture(:) = history(:, fracture_at)
   end subroutine walk_two_legs

end program test_law_cohesive_bilinear_energy
