!> The quick way through a step without growth gives what the whole law gives, and takes no other
!> step.
program test_law_ply_no_growth_path
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_damage_growth, only : find_growth_strains
   use plydyn_law_ply_constants, only : onset_hashin, ply_constants_type
   use plydyn_law_ply_damage, only : ply_damage_type
   use plydyn_law_ply_history, only : begun_shear, fibre_damage, fibre_finish, fibre_threshold, &
      & fibre_onset, growth_limit, histories_most, largest_band, limit_to_compression, &
      & matrix_damage, matrix_finish, matrix_threshold, matrix_onset, shear_peak, shear_set, &
      & to_compression
   use plydyn_law_ply_batch_constants, only : ply_batch_constants_type
   use plydyn_law_ply_fibre_lines, only : fibre_lines_type
   use plydyn_law_ply_no_growth_path, only : update_undamaged
   use plydyn_law_ply_shear_curve, only : new_power_curve, shape_exponential, &
      & shape_power
   use ply_point, only : paper_ply
   use testing, only : begin, check, finish
   implicit none

   !> Random states of each ply; points above each other
   integer, parameter :: tries = 1000, points = 3
   !> A lane that another law owns
   integer, parameter :: foreign = 3
   !> Strains of the order of those at onset
   real(wp), parameter :: reach(6) = [0.012_wp, 0.006_wp, 0.004_wp, 0.012_wp, 0.01_wp, 0.01_wp]
   !> Round-off of stresses of hundreds to thousands
   real(wp), parameter :: close = 1.0e-9_wp
   !> History that no step without growth changes
   integer, parameter :: modes(6) = [fibre_damage, fibre_onset, fibre_finish, matrix_damage, &
      & matrix_onset, matrix_finish]
   !> The same of compression, where cracks close
   integer, parameter :: closed_modes(6) = modes + to_compression

   call test_plies()
   call test_foreign()
   call finish()

contains

   !> Plies with all that the whole law looks at
   subroutine test_plies()
      type(ply_constants_type) :: ply

      ply = paper_ply()
      call compare(ply, "straight")
      ply = paper_ply(curved=.true.)
      call compare(ply, "curved")
      ply%residual = 0.01_wp
      ply%weakens_across = .false.
      call compare(ply, "residual and only in the plane")
      ply%plateau = 0.3_wp
      call compare(ply, "plateau")
      ply%plateau = 0.0_wp
      ply%onset = onset_hashin
      call compare(ply, "after Hashin")
      ply = paper_ply()
      ply%curve = new_power_curve(4.06e-9_wp, 5.4_wp)
      call compare(ply, "with a strain that stays and is kept")
      ply = paper_ply(curved=.true.)
      ply%line_strength(:) = [0.75_wp, 0.2_wp]
      ply%line_toughness(:) = [0.375_wp, 0.5_wp]
      call compare(ply, "fibres on two lines")
      ply%closes = .true.
      call compare(ply, "cracks that close, fibres on two lines")
      ply = paper_ply()
      ply%closes = .true.
      ply%plateau = 0.3_wp
      call compare(ply, "cracks that close, plateau")
   end subroutine test_plies

   !> Random states of one ply by both ways
   subroutine compare(ply, name)
      type(ply_constants_type), intent(in) :: ply
      character(*), intent(in) :: name

      real(wp) :: before(lanes, points, histories_most), history(lanes, points, histories_most)
      real(wp) :: off, strain(lanes, 6, points), stress(lanes, 6, points), whole(lanes, 6)
      integer :: i, m, elastic, wrong
      logical :: grows, stays(points), touched
      type(ply_damage_type) :: law
      type(ply_batch_constants_type) :: lane

      call begin(name)
      call make(ply, lane, law)
      elastic = 0
      wrong = 0
      off = 0.0_wp
      do i = 1, tries
         call choose(ply, strain, before)
         history(:, :, :) = before
         call update_undamaged(lane, points, points, strain, history, stress, stays)
         do m = 1, points
            touched = any(abs(history(:, m, :) - before(:, m, :)) > 0.0_wp)
            if (touched .and. .not. stays(m)) wrong = wrong + 1
            call law%update_point(strain(:, :, m), before(:, m, :law%histories), whole)
            grows = any(abs(before(:, m, [modes, closed_modes]) &
               & - history(:, m, [modes, closed_modes])) > 0.0_wp)
            if (grows .eqv. stays(m)) wrong = wrong + 1
            if (.not. stays(m)) cycle
            elastic = elastic + 1
            off = max(off, maxval(abs(stress(:, :, m) - whole)), &
               & maxval(abs(history(:, m, :) - before(:, m, :))))
         end do
      end do
      call check(wrong == 0, "leaves to the whole law where damage begins or grows, untouched")
      call check(off, 0.0_wp, close, "the same stress and history elsewhere")
      call check(elastic > tries*points/5 .and. elastic < tries*points*4/5, "both ways")
   end subroutine compare

   !> Lanes of other laws keep stress and history, and do not count
   subroutine test_foreign()
      real(wp) :: before(lanes, points, histories_most), history(lanes, points, histories_most)
      real(wp) :: strain(lanes, 6, points), stress(lanes, 6, points)
      integer :: l
      logical :: stays(points)
      type(ply_constants_type) :: ply
      type(ply_batch_constants_type) :: lane

      call begin("foreign")
      ply = paper_ply(curved=.true.)
      do l = 1, lanes
         if (l /= foreign) call lane%set_lane(l, ply)
      end do
      call choose(ply, strain, before)
      before(:, :, modes) = 0.0_wp
      before(1, :, matrix_damage:matrix_finish) = spread([1.0_wp, 0.004_wp, 0.02_wp], 1, points)
      before(1, :, [shear_peak, matrix_threshold]) = -1.0_wp
      before(foreign, :, :) = 1.0_wp
      strain(:, :, :) = 0.1_wp*strain
      strain(foreign, :, :) = 0.1_wp
      history(:, :, :) = before
      stress(:, :, :) = 7.0_wp
      call update_undamaged(lane, points, points, strain, history, stress, stays)
      call check(all(stays), "what they do does not count")
      call check(stress(foreign, :, points), spread(7.0_wp, 1, 6), 0.0_wp, "their stress")
      call check(history(foreign, points, :), before(foreign, points, :), 0.0_wp, "their history")
      call check(abs(stress(1, 2, points)) < 1.0e-3_wp, "no stress across what has failed")
   end subroutine test_foreign

   !> Both ways for a ply in all lanes
   subroutine make(ply, lane, law)
      type(ply_constants_type), intent(in) :: ply
      type(ply_batch_constants_type), intent(out) :: lane
      type(ply_damage_type), intent(out) :: law

      integer :: l

      do l = 1, lanes
         call lane%set_lane(l, ply)
         call law%set_lane(l, ply)
      end do
   end subroutine make

   !> Strains, and histories as paths to them could have left them: where damage has begun, its
   !> strains, and a damage between none and all
   subroutine choose(ply, strain, history)
      type(ply_constants_type), intent(in) :: ply
      real(wp), intent(out) :: strain(lanes, 6, points), history(lanes, points, histories_most)

      real(wp) :: draw(6), limit(lanes, 2)
      type(fibre_lines_type) :: lines
      integer :: d, k, l, m, sense

      do l = 1, lanes
         call lines%set_lane(l, ply%line_strength, ply%line_toughness)
      end do

      history(:, :, :) = 0.0_wp
      do m = 1, points
         do l = 1, lanes
            call random_number(draw)
            strain(l, :, m) = 0.7_wp*reach*(2.0_wp*draw - 1.0_wp)
            history(l, m, [largest_band, fibre_threshold, matrix_threshold]) &
               & = [1.0_wp, 1.0_wp, 0.1_wp]
            call random_number(draw)
            select case (ply%curve%shape)
            case (shape_exponential)
               call bend_exponential(ply, 0.012_wp*draw(1), history(l, m, shear_peak), &
                  & history(l, m, shear_set))
            case (shape_power)
               call bend_power(ply, draw(1), history(l, m, shear_peak), history(l, m, shear_set))
            case default
               history(l, m, [shear_peak, shear_set]) = 0.0_wp
            end select
            do k = 1, 2
               call random_number(draw)
               if (draw(1) > 0.3_wp) cycle
               d = merge(fibre_damage, matrix_damage, k == 1)
               if (ply%closes .and. draw(3) < 0.5_wp) d = d + to_compression
               history(l, m, d + 1) = sign((0.3_wp + 0.4_wp*draw(2))*reach(k), draw(3) - 0.5_wp)
               history(l, m, d + 2) = abs(history(l, m, d + 1))*(1.1_wp + 3.0_wp*draw(4))
               history(l, m, d) = min(0.6_wp + 0.5_wp*draw(5), 1.0_wp)
            end do
         end do
         do sense = 0, merge(1, 0, ply%closes)
            call find_growth_strains(spread([ply%plateau, 0.0_wp], 1, lanes), lines, &
               & history(:, m, modes + sense*to_compression), limit)
            do k = 1, 2
               d = merge(fibre_finish, matrix_finish, k == 1) + sense*to_compression
               associate (threshold => history(:, m, fibre_threshold - 1 + k), &
                  & kept => history(:, m, growth_limit - 1 + k + sense*limit_to_compression))
                  where (history(:, m, d) > 0.0_wp)
                     kept = limit(:, k)
                     threshold = merge(-abs(threshold), -limit(:, k)**2, ply%closes)
                  end where
                  if (.not. ply%closes) kept(:) = 0.0_wp
               end associate
            end do
         end do
         where (any(history(:, m, fibre_threshold:matrix_threshold) < 0.0_wp, 2)) &
            & history(:, m, shear_peak) = begun_shear(history(:, m, shear_peak))
      end do
   end subroutine choose

   !> Largest shear strain, and what stays of it, on an exponential
   pure subroutine bend_exponential(ply, strain, peak, stays)
      type(ply_constants_type), intent(in) :: ply
      real(wp), intent(in) :: strain
      real(wp), intent(out) :: peak, stays

      associate (reach => ply%curve%asymptote/ply%shear(1))
         peak = strain
         stays = peak - reach*(1.0_wp - exp(-peak/reach))
      end associate
   end subroutine bend_exponential

   !> Largest shear strain, and what stays of it, at a share of the strength on a power curve
   pure subroutine bend_power(ply, share, peak, stays)
      type(ply_constants_type), intent(in) :: ply
      real(wp), intent(in) :: share
      real(wp), intent(out) :: peak, stays

      associate (curve => ply%curve, stress => share*ply%shear_strength)
         stays = curve%coefficient*stress**curve%exponent/ply%shear(1)
         peak = stress/ply%shear(1) + stays
      end associate
   end subroutine bend_power

end program test_law_ply_no_growth_path
