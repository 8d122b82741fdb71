!> Damage by the work of both modes, and strength and friction under pressure; the bond of table 6.
program test_law_cohesive_work_growth
   use bond, only : direction, mixed_directions, mixes, table_6
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type, cohesive_type, new_cohesive
   use plydyn_law_cohesive_softening, only : damage_at, fracture_at, normal, share_at, shear
   use testing, only : begin, check, finish
   implicit none

   !> Histories with the energies of both modes
   integer, parameter :: most = 10
   !> Opening and sliding at failure in the pure modes
   real(wp), parameter :: last(2) = [2.0_wp*0.28_wp/62.3_wp, 2.0_wp*0.79_wp/92.3_wp]

   call test_straight_paths()
   call test_changing_modes()
   call test_two_legs()
   call test_stronger_point()
   call test_pressure()
   call test_friction()
   call finish()

contains

   !> The law with damage by work
   function law_by_work(ratio) result(law)
      !> Shear stiffness over that of opening
      real(wp), intent(in) :: ratio
      type(cohesive_type) :: law
      type(cohesive_constants_type) :: constants

      constants = table_6()
      constants%by_work = .true.
      constants%stiffness(shear) = ratio*constants%stiffness(normal)
      law = new_cohesive(constants)
   end function law_by_work

   !> On a straight path the damage is that of the bilinear law, in steps of any size
   subroutine test_straight_paths()
      real(wp), parameter :: steps(6) = [0.9_wp, 1.3_wp, 7.0_wp, 2.0_wp, 40.0_wp, 2.0e3_wp]
      type(cohesive_constants_type) :: constants
      type(cohesive_type) :: by_work, law
      real(wp) :: expected(lanes, 3), history(lanes, most), traction(lanes, 3)
      integer :: s

      call begin("damage by work on a straight path")
      constants = table_6()
      law = new_cohesive(constants)
      constants%by_work = .true.
      by_work = new_cohesive(constants)
      call check(by_work%histories, most, "has the histories of both works")
      expected(:, :) = 0.0_wp
      history(:, :) = 0.0_wp
      do s = 1, size(steps)
         call law%update_points(1, 1, steps(s)*mixed_directions(law), expected, traction)
         call by_work%update_points(1, 1, steps(s)*mixed_directions(law), history, traction)
         call check(history(:, damage_at), expected(:, damage_at), 1.0e-12_wp, "damage")
         call check(history(:, fracture_at), expected(:, fracture_at), 1.0e-12_wp, "energy")
         call check(history(:, share_at), expected(:, share_at), 1.0e-12_wp, "share spent")
      end do
      call check(history(:, most)/history(:, fracture_at), mixes, 1.0e-12_wp, "work of sliding")
   end subroutine test_straight_paths

   !> On paths that turn from sliding to opening and back the work of failure is the toughness of
   !> the ratio of both works, for all stiffnesses
   subroutine test_changing_modes()
      real(wp), parameter :: ratios(3) = [0.3592_wp, 1.0_wp, 3.0_wp]
      real(wp) :: angle, opening(lanes, 3)
      type(cohesive_type) :: law
      integer, parameter :: steps = 40000
      integer :: i, k, l
      real(wp), allocatable :: path(:, :, :)

      allocate (path(lanes, 3, 0:steps))
      do k = 1, size(ratios)
         call begin("damage by work where the mode changes")
         law = law_by_work(ratios(k))
         do i = 0, steps
            do l = 1, lanes
               angle = 0.1_wp*l + 0.5_wp*sin(0.5_wp*l + 4.0_wp*(real(i, wp)/steps)**0.2_wp)
               opening(l, 1:2) = direction*sin(angle)*last(shear)
               opening(l, 3) = abs(cos(angle))*last(normal)
            end do
            path(:, :, i) = 1.5_wp*(real(i, wp)/steps)**2*opening
         end do
         call check_work(law, path)
      end do
   end subroutine test_changing_modes

   !> Opening first and then sliding, or the other way round. A longer first leg of opening leaves
   !> the load above r of the mode to come, and what is stored goes at once
   subroutine test_two_legs()
      integer, parameter :: steps = 40000
      real(wp), parameter :: share(lanes) = [0.02_wp, 0.1_wp, 0.3_wp, 0.2_wp, 0.02_wp, 0.1_wp, &
         & 0.2_wp, 0.3_wp]
      real(wp), allocatable :: path(:, :, :)
      real(wp) :: part
      integer :: i, l

      call begin("damage by work on two legs")
      allocate (path(lanes, 3, 0:2*steps), source=0.0_wp)
      do i = 1, 2*steps
         part = (real(modulo(i - 1, steps) + 1, wp)/steps)**2
         do l = 1, lanes
            associate (first => merge(part, 1.0_wp, i <= steps)*share(l), &
               & second => merge(0.0_wp, 1.5_wp*part, i <= steps))
               path(l, 1:2, i) = direction*last(shear)*merge(second, first, l <= 4)
               path(l, 3, i) = last(normal)*merge(first, second, l <= 4)
            end associate
         end do
      end do
      call check_work(law_by_work(1.0_wp), path)
   end subroutine test_two_legs

   !> Follow a path to failure and compare the work with the toughness of its own mix
   subroutine check_work(law, path)
      type(cohesive_type), intent(in) :: law
      real(wp), intent(in) :: path(:, :, 0:)

      real(wp), dimension(lanes, 3) :: before, traction
      real(wp) :: history(lanes, most), total(lanes), work(lanes, 2)
      integer :: i, l

      history(:, :) = 0.0_wp
      before(:, :) = 0.0_wp
      work(:, :) = 0.0_wp
      do i = 1, ubound(path, 3)
         call law%update_points(1, 1, path(:, :, i), history, traction)
         associate (power => 0.5_wp*(before + traction)*(path(:, :, i) - path(:, :, i - 1)))
            work(:, normal) = work(:, normal) + power(:, 3)
            work(:, shear) = work(:, shear) + power(:, 1) + power(:, 2)
         end associate
         before(:, :) = traction
      end do
      total(:) = work(:, normal) + work(:, shear)
      call check(history(:, damage_at), spread(1.0_wp, 1, lanes), 0.0_wp, "ends in failure")
      ! where the load passes r of the present mode before the end, what is stored goes at once: it
      ! is near to what is left of the toughness, not the same
      call check(total/[(law%toughness_of(work(l, shear)/total(l)), l=1, lanes)], &
         & spread(1.0_wp, 1, lanes), 5.0e-3_wp, "the work is the toughness of its mix")
      call check(history(:, fracture_at)/total, spread(1.0_wp, 1, lanes), 2.0e-3_wp, &
         & "the energy lost is the work")
   end subroutine check_work

   !> A point of other strengths begins and ends where they say, with the same toughness
   subroutine test_stronger_point()
      real(wp), parameter :: factor = 1.25_wp
      type(cohesive_constants_type) :: constants
      type(cohesive_type) :: law, stronger
      real(wp) :: expected(lanes, 3), history(lanes, 3), opening(lanes, 3), traction(lanes, 3)
      real(wp) :: wanted(lanes, 3), weakness(lanes, 1)
      integer :: i

      call begin("a point that is stronger than its law")
      constants = table_6()
      law = new_cohesive(constants)
      constants%strength(:) = factor*constants%strength
      stronger = new_cohesive(constants)
      weakness(:, :) = 1.0_wp/factor**2
      expected(:, :) = 0.0_wp
      history(:, :) = 0.0_wp
      do i = 1, 20
         opening(:, :) = 1.4_wp**i*mixed_directions(law)
         call law%update_points(1, 1, opening, history, traction, weakness)
         call stronger%update_points(1, 1, opening, expected, wanted)
         call check(reshape(history - expected, [3*lanes]), spread(0.0_wp, 1, 3*lanes), &
            & 1.0e-12_wp, "has the history of a law with these strengths")
         call check(reshape(traction - wanted, [3*lanes]), spread(0.0_wp, 1, 3*lanes), 1.0e-9_wp, &
            & "and its tractions")
      end do
   end subroutine test_stronger_point

   !> Shear under pressure: S + eta p at the onset, and G_IIc (S + eta p)**2/S**2 until failure
   subroutine test_pressure()
      real(wp), parameter :: gain = 0.74_wp, pressure = 50.0_wp, raised = 92.3_wp + gain*pressure
      type(cohesive_constants_type) :: constants
      type(cohesive_type) :: law
      real(wp) :: history(lanes, most), opening(lanes, 3), peak, traction(lanes, 3)
      integer :: i, k

      do k = 1, 2
         call begin("shear strength under pressure")
         constants = table_6()
         constants%pressure_gain = gain
         constants%by_work = k == 2
         law = new_cohesive(constants)
         history(:, :) = 0.0_wp
         peak = 0.0_wp
         opening(:, 3) = -pressure/constants%stiffness(normal)
         do i = 1, 4000
            opening(:, 1) = direction(1)*last(shear)*2.5_wp*real(i, wp)/4000.0_wp
            opening(:, 2) = direction(2)*last(shear)*2.5_wp*real(i, wp)/4000.0_wp
            call law%update_points(1, 1, opening, history(:, :law%histories), traction)
            peak = max(peak, norm2(traction(1, :2)))
         end do
         ! the peak lies between two steps
         call check(peak, raised, 0.1_wp, "is S + eta p")
         call check(history(1, damage_at), 1.0_wp, 0.0_wp, "the end is reached")
         call check(history(1, fracture_at), 0.79_wp*(raised/92.3_wp)**2, 1.0e-9_wp, &
            & "the toughness grows with its square")
      end do
   end subroutine test_pressure

   !> Monotone shear under pressure with friction of what has failed: the peaks at which the loss of
   !> the intact share balances the friction of the failed one, delta**2 = mu p last first/S, and
   !> the work G_IIc + mu p I of a failed share that slips at once
   subroutine test_friction()
      real(wp), parameter :: friction(3) = [6.0_wp, 25.0_wp, 60.0_wp], pressure = 100.0_wp
      real(wp), parameter :: peaks(3) = [94.4_wp, 108.4_wp, 138.3_wp]
      real(wp), parameter :: places(3) = [4.56e-4_wp, 9.31e-4_wp, 1.443e-3_wp]
      real(wp), parameter :: works(3) = [0.8876_wp, 1.1966_wp, 1.7658_wp]
      integer, parameter :: steps = 20000
      type(cohesive_constants_type) :: constants
      type(cohesive_type) :: law
      real(wp) :: before, history(lanes, 8), now, opening(lanes, 3), peak, place, traction(lanes, 3)
      real(wp) :: work
      integer :: i, k

      do k = 1, size(friction)
         call begin("friction of what has failed under pressure")
         constants = table_6()
         constants%friction = friction(k)/pressure
         law = new_cohesive(constants)
         history(:, :) = 0.0_wp
         peak = 0.0_wp
         before = 0.0_wp
         work = 0.0_wp
         opening(:, 3) = -pressure/constants%stiffness(normal)
         do i = 1, steps
            opening(:, 1) = direction(1)*last(shear)*real(i, wp)/steps
            opening(:, 2) = direction(2)*last(shear)*real(i, wp)/steps
            call law%update_points(1, 1, opening, history, traction)
            now = norm2(traction(1, :2))
            work = work + 0.5_wp*(before + now)*last(shear)/steps
            before = now
            if (now <= peak) cycle
            peak = now
            place = last(shear)*real(i, wp)/steps
         end do
         call check(peak, peaks(k), 0.05_wp, "largest traction")
         call check(place, places(k), 5.0e-6_wp, "and where")
         ! the failed share sticks until its stretch is mu p/K_s
         call check(work/works(k), 1.0_wp, 5.0e-3_wp, "work")
      end do
   end subroutine test_friction

end program test_law_cohesive_work_growth
