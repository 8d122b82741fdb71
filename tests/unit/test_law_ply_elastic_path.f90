!> Steps without new damage: stress of the intact ply, little history; all else is left alone.
program test_law_ply_elastic_path
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_elastic, only : ply_stiffness
   use plydyn_law_ply_constants, only : onset_hashin, ply_constants_type
   use plydyn_law_ply_damage_growth, only : find_growth_strains
   use plydyn_law_ply_history, only : begun_shear, fibre_damage, fibre_threshold, histories_open, &
      & largest_band, matrix_damage, matrix_finish, matrix_threshold, matrix_onset, shear_peak, &
      & spared_work
   use plydyn_law_ply_batch_constants, only : ply_batch_constants_type
   use plydyn_law_ply_no_growth_path, only : update_undamaged
   use ply_point, only : paper_ply
   use testing, only : begin, check, finish
   implicit none

   !> A strain without shear in the plane, far below all strengths
   real(wp), parameter :: small(6) = [1.0e-3_wp, -2.0e-3_wp, 5.0e-4_wp, 0.0_wp, 1.0e-3_wp, &
      & -2.0e-3_wp]
   !> A lane that another law owns
   integer, parameter :: foreign = 3
   type(ply_batch_constants_type) :: lane
   !> Points above each other
   integer, parameter :: points = 2
   real(wp) :: history(lanes, points, histories_open), stress(lanes, 6, points)
   logical :: stays(points)

   call test_intact()
   call test_curve()
   call test_loud()
   call test_near_onset()
   call finish()

contains

   !> Hooke's law in own lanes, nothing else changes
   subroutine test_intact()
      real(wp) :: c(6, 6)
      type(ply_constants_type) :: ply

      call begin("intact")
      ply = paper_ply()
      c(:, :) = ply_stiffness(ply%young, ply%poisson, ply%shear)
      call rest(.false.)
      call move(small)
      call check(all(stays), "is quiet")
      call check(stress(1, :, points), matmul(c, small), 1.0e-9_wp, "stress of Hooke's law")
      call check(stress(foreign, :, points), spread(7.0_wp, 1, 6), 0.0_wp, &
         & "not in lanes of other laws")
      call check(changed(), 0.0_wp, 0.0_wp, "no history")
   end subroutine test_intact

   !> Shear that grows leaves its history
   subroutine test_curve()
      real(wp), parameter :: sheared(6) = [0.0_wp, 0.0_wp, 0.0_wp, -0.01_wp, 0.0_wp, 0.0_wp]
      real(wp) :: tau
      type(ply_constants_type) :: ply

      call begin("curve")
      ply = paper_ply(curved=.true.)
      call rest(.true.)
      call move(sheared)
      tau = -stress(1, 4, points)
      associate (asymptote => ply%curve%asymptote)
         call check(tau, asymptote*(1.0_wp - exp(-0.01_wp*ply%shear(1)/asymptote)), &
            & 1.0e-13_wp*tau, "follows the curve")
      end associate
      call check(all(stays), "is quiet")
      call check(history(1, points, shear_peak), 0.01_wp, 0.0_wp, "largest strain")
      call check(history(1, points, spared_work), 0.0_wp, 0.0_wp, "no damage spares work")
      call check(history(foreign, points, shear_peak), 0.0_wp, 0.0_wp, "not in lanes of other laws")
      call move(0.5_wp*sheared)
      call check(history(1, points, shear_peak), 0.01_wp, 0.0_wp, "unloading changes nothing")
   end subroutine test_curve

   !> Damage that begins or grows is left to others
   subroutine test_loud()
      real(wp), parameter :: large(6) = [0.02_wp, 0.0_wp, 0.0_wp, 0.02_wp, 0.0_wp, 0.0_wp]
      real(wp), parameter :: across(6) = [0.0_wp, 0.006_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
      real(wp) :: limit(lanes, 2)

      call begin("not quiet")
      call rest(.true.)
      call move(large)
      call check(.not. any(stays), "beyond the strength of fibres")
      call check(changed(), 0.0_wp, 0.0_wp, "history untouched")
      ! damage that has begun at a strain of 0.004, ends at 0.02 and has grown up to 0.0053
      history(5, points, [matrix_damage, matrix_onset, matrix_finish]) = &
         & [0.3_wp, 0.004_wp, 0.02_wp]
      call find_growth_strains(lane%plateau, lane%lines, &
         & history(:, points, fibre_damage:matrix_finish), limit)
      history(5, points, matrix_threshold) = -limit(5, 2)**2
      history(5, points, shear_peak) = begun_shear(0.0_wp)
      call move(small)
      call check(all(stays), "a lane of a point is damaged and its damage stays")
      call move(across)
      call check(stays(1) .and. .not. stays(points), "a lane of a point is damaged and more so")
      call check(history(5, points, matrix_damage), 0.3_wp, 0.0_wp, "its damage untouched")
      call rest(.true.)
      history(foreign, :, [shear_peak, matrix_threshold]) = -1.0_wp
      call move(small)
      call check(all(stays), "what other laws remember does not count")
   end subroutine test_loud

   !> The short look at points far from onset overlooks none: what stays is what has not begun
   subroutine test_near_onset()
      !> Strains of the order of those at onset
      real(wp), parameter :: reach(6) = [0.01_wp, 0.008_wp, 0.005_wp, 0.01_wp, 0.01_wp, 0.01_wp]
      integer, parameter :: tries = 3000
      real(wp) :: excess(lanes, 2), normal(lanes, 3), shear(lanes, 2), strain(6), wide(lanes, 2)
      integer :: i, loud, wrong

      call begin("near onset")
      loud = 0
      wrong = 0
      do i = 1, tries
         call rest(.false., hashin=mod(i, 2) == 0)
         call random_number(strain)
         strain(:) = reach*(2.0_wp*strain - 1.0_wp)
         ! bands from narrow to too wide
         history(:, :, [largest_band, fibre_threshold, matrix_threshold]) = 2.0_wp**mod(i, 8) &
            & *history(:, :, [largest_band, fibre_threshold, matrix_threshold])
         wide(:, :) = history(:, 1, fibre_threshold:matrix_threshold)
         call lane%secant%intact_stress(spread(strain(1:3), 1, lanes), normal)
         shear(:, 2) = abs(strain(4))
         shear(:, 1) = lane%secant%shear(:, 1)*shear(:, 2)
         call lane%onset%find_onset(normal, spread(strain(1:2), 1, lanes), shear, wide(:, 1), &
            & wide(:, 2), excess)
         call move(strain)
         if (any(excess >= 0.0_wp)) loud = loud + 1
         if (any(stays .neqv. all(excess < 0.0_wp))) wrong = wrong + 1
      end do
      call check(wrong == 0, "all see it that the conditions see")
      call check(loud > tries/4 .and. loud < tries - tries/4, "on both sides of onset")
   end subroutine test_near_onset

   !> A step, the same at all points
   subroutine move(strain)
      real(wp), intent(in) :: strain(6)

      stress(:, :, :) = 7.0_wp
      call update_undamaged(lane, points, points, spread(spread(strain, 1, lanes), 3, points), &
         & history, stress, stays)
   end subroutine move

   !> All lanes but one have the ply of the paper
   subroutine rest(curved, hashin)
      logical, intent(in) :: curved
      logical, intent(in), optional :: hashin

      type(ply_constants_type) :: ply
      integer :: l

      ply = paper_ply()
      if (curved) ply = paper_ply(curved=.true.)
      if (present(hashin)) then
         if (hashin) then
            ply%onset = onset_hashin
            ply%cross_strength = 40.0_wp
         end if
      end if
      lane = ply_batch_constants_type()
      do l = 1, lanes
         if (l /= foreign) call lane%set_lane(l, ply)
      end do
      history(:, :, :) = 0.0_wp
      history(:, :, largest_band) = 1.0_wp
      history(:, :, fibre_threshold) = 1.0_wp
      history(:, :, matrix_threshold) = 0.1_wp
      history(foreign, :, :) = 0.0_wp
   end subroutine rest

   !> The largest history since `rest` but that of the widths and the gates
   pure real(wp) function changed()
      changed = max(maxval(abs(history(:, :, shear_peak))), &
         & maxval(abs(history(:, :, matrix_threshold + 1:))))
   end function changed

end program test_law_ply_elastic_path
