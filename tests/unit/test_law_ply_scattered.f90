!> A point of a ply whose strengths scatter is a point of a ply with other strengths.
program test_law_ply_scattered
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_constants, only : onset_hashin, ply_constants_type
   use plydyn_law_ply_crack_band, only : mode_names
   use plydyn_law_ply_damage, only : ply_damage_type
   use plydyn_law_ply_history, only : fibre_finish, fibre_onset, histories_average, &
      & histories_closing, histories_most, histories_open, matrix_finish, matrix_onset
   use plydyn_law_ply_shear_curve, only : new_exponential_curve, new_power_curve, new_table_curve, &
      & shape_exponential, shape_line, shape_power, shape_table
   use plydyn_law_scatter, only : strength_scatter_type
   use ply_point, only : new_point, paper_ply, point_type
   use testing, only : begin, check, finish
   implicit none

   !> Factors of the strengths of fibres and of matrix
   real(wp), parameter :: factor(2) = [0.83_wp, 1.21_wp]
   !> Crack bands narrow enough for every mode, and too wide for each
   real(wp), parameter :: narrow(2) = [1.0_wp, 0.1_wp], wide(2) = [8.0_wp, 3.0_wp]
   !> Table of the shear curve
   real(wp), parameter :: strain_of(3) = [0.0_wp, 0.01_wp, 0.05_wp], &
      & stress_of(3) = [0.0_wp, 60.0_wp, 95.0_wp]

   call test_strengths()
   call test_paths()
   call test_layout()
   call test_far_from_onset()
   call finish()

contains

   !> The paper's ply with a shape of the shear curve, whose strengths scatter
   pure function scattered_ply(shape) result(ply)
      !> Shape of the curve
      integer, intent(in) :: shape
      type(ply_constants_type) :: ply

      ply = stronger_ply(shape, [1.0_wp, 1.0_wp])
      ply%scatter = strength_scatter_type(1, [20.0_wp, 10.0_wp], 1.0_wp)
   end function scattered_ply

   !> The same ply without scatter, with larger strengths and a larger curve
   pure function stronger_ply(shape, times) result(ply)
      integer, intent(in) :: shape
      !> Factors of the strengths
      real(wp), intent(in) :: times(2)
      type(ply_constants_type) :: ply

      real(wp), parameter :: coefficient = 4.06e-9_wp, exponent = 5.4_wp

      ply = paper_ply()
      ply%residual = 1.0e-9_wp
      ply%fibre_strength(:) = times(1)*ply%fibre_strength
      ply%matrix_strength(:) = times(2)*ply%matrix_strength
      ply%shear_strength = times(2)*ply%shear_strength
      ply%cross_strength = times(2)*ply%cross_strength
      select case (shape)
      case (shape_exponential)
         ply%curve = new_exponential_curve(ply%shear(1), ply%shear_strength, 0.05_wp*times(2))
      case (shape_table)
         ply%curve = new_table_curve(times(2)*strain_of, times(2)*stress_of)
      case (shape_power)
         ply%curve = new_power_curve(coefficient*times(2)**(1.0_wp - exponent), exponent)
      case default
         continue
      end select
   end function stronger_ply

   !> Each mode alone: damage begins at the factor times the strength, and the energy stays
   subroutine test_strengths()
      integer, parameter :: steps = 4000
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: finish_strain, onset, peak, sense, strength, toughness
      integer :: direction, i, k, mode, side

      do mode = 1, 4
         call begin(trim(mode_names(mode))//" with a factor")
         ply = scattered_ply(shape_line)
         direction = (mode + 1)/2
         side = mode - 2*(direction - 1)
         sense = merge(1.0_wp, -1.0_wp, side == 1)
         strength = factor(direction)*merge(ply%fibre_strength(side), ply%matrix_strength(side), &
            & direction == 1)
         toughness = merge(ply%fibre_toughness(side), ply%matrix_toughness(side), direction == 1)
         onset = strength/ply%young(direction)
         finish_strain = 2.0_wp*toughness/(strength*narrow(direction))
         point = new_point(ply, narrow, factor)
         peak = 0.0_wp
         do i = 1, steps
            call point%pull(direction, sense*1.01_wp*finish_strain*real(i, wp)/real(steps, wp), &
               & 0.0_wp)
            peak = max(peak, abs(point%stress(direction)))
         end do
         k = merge(fibre_onset, matrix_onset, direction == 1)
         call check(abs(point%history(k:k + fibre_finish - fibre_onset)), [onset, finish_strain], &
            & 1.0e-9_wp, "begins at the factor times the strength")
         ! the step of the path passes the top within a part of a strain of 1.01 of the end
         call check(peak/strength, 1.0_wp, 1.01_wp*finish_strain/(real(steps, wp)*onset), &
            & "carries no more than that")
         call check(point%dissipated()*narrow(direction)/toughness, 1.0_wp, 1.0e-6_wp, &
            & "dissipates the toughness")
         call check(point%work, point%dissipated(), 1.0e-6_wp*point%work, "which is the work")
      end do
   end subroutine test_strengths

   !> Random paths: every shear curve, criterion and width of the band, with cracks that close
   subroutine test_paths()
      integer, parameter :: shapes(4) = [shape_line, shape_exponential, shape_table, shape_power]
      type(ply_constants_type) :: ply, stronger
      integer :: choice, k

      do k = 1, size(shapes)
         do choice = 0, 7
            ply = scattered_ply(shapes(k))
            stronger = stronger_ply(shapes(k), factor)
            ply%closes = btest(choice, 0)
            ply%intact_onset = btest(choice, 1)
            if (btest(choice, 2)) ply%onset = onset_hashin
            if (.not. ply%closes) ply%plateau = 0.1_wp
            stronger%closes = ply%closes
            stronger%intact_onset = ply%intact_onset
            stronger%onset = ply%onset
            stronger%plateau = ply%plateau
            call begin("factors on a random path")
            call follow(ply, stronger, narrow, 8*k + choice)
            call begin("factors where the band is too wide")
            call follow(ply, stronger, wide, 8*k + choice)
         end do
      end do
   end subroutine test_paths

   !> Strain both points alike; they must not differ
   subroutine follow(ply, stronger, length, path)
      type(ply_constants_type), intent(in) :: ply, stronger
      !> Widths of the crack band, and number of the path
      real(wp), intent(in) :: length(2)
      integer, intent(in) :: path

      integer, parameter :: steps = 3000, waves = 4
      real(wp), parameter :: size_of(6) = [0.02_wp, 0.01_wp, 0.01_wp, 0.03_wp, 0.02_wp, 0.02_wp]
      real(wp), parameter :: pi = acos(-1.0_wp)
      type(point_type) :: other, point
      real(wp) :: most, share, strain(6), worst
      integer :: i, k

      point = new_point(ply, length, factor)
      other = new_point(stronger, length)
      worst = 0.0_wp
      most = 0.0_wp
      do i = 1, steps
         share = real(i, wp)/real(steps, wp)
         do k = 1, 6
            ! waves of rates that no two paths share
            strain(k) = size_of(k)*share*sin(pi*waves*share*(1.0_wp + 0.13_wp*k + 0.071_wp*path))
         end do
         call point%move(strain)
         call other%move(strain)
         worst = max(worst, maxval(abs(point%stress - other%stress)))
         most = max(most, maxval(abs(other%stress)))
      end do
      call check(worst/most, 0.0_wp, 1.0e-10_wp, "has the stress of a ply with such strengths")
      call check(point%dissipated()/other%dissipated(), 1.0_wp, 1.0e-10_wp, "dissipates as much")
      call check(point%plastic(), other%plastic(), 1.0e-10_wp*other%dissipated(), &
         & "with the same plastic work")
      call check(point%stored_by_law(), other%stored_by_law(), 1.0e-10_wp*other%dissipated(), &
         & "and stores as much")
   end subroutine follow

   !> Lanes with and without scatter share a law; histories grow by two variables
   subroutine test_layout()
      type(ply_damage_type) :: law
      real(wp) :: history(lanes, histories_most), strain(lanes, 6), stress(lanes, 6)
      type(point_type) :: plain

      call begin("history with factors")
      call law%set_lane(1, paper_ply())
      call check(law%histories, histories_open, "is as long as ever without scatter")
      call law%set_lane(2, scattered_ply(shape_exponential))
      call check(law%histories, histories_open + 2, "has two more variables with it")
      history(:, :) = 7.0_wp
      stress(:, :) = 5.0_wp
      call law%start_history(spread(narrow, 1, lanes), spread(1.0_wp, 1, lanes), history)
      call law%set_factors(spread([1.0_wp, 1.0_wp], 1, lanes), history)
      strain(:, :) = spread([0.02_wp, 0.01_wp, 0.0_wp, 0.04_wp, 0.0_wp, 0.0_wp], 1, lanes)
      call law%update(0.0_wp, strain, history, stress)
      plain = new_point(paper_ply(), narrow)
      call plain%move(strain(1, :))
      call check(stress(1, :), plain%stress, 0.0_wp, "a lane without scatter has the same bits")
      call check(all(abs(history(3:, :) - 7.0_wp) <= 0.0_wp) &
         & .and. all(abs(stress(3:, :) - 5.0_wp) <= 0.0_wp), "others are left alone")
      call law%set_average(2, [1.0_wp, 1.0_wp])
      call check(law%histories, histories_average + 2, "follows the averages")
      call check(histories_most >= histories_closing + 2, "has room where cracks close")
   end subroutine test_layout

   !> The elastic path must not miss the onset of the weakest of several points
   subroutine test_far_from_onset()
      integer, parameter :: points = 3
      type(ply_damage_type) :: law
      type(ply_constants_type) :: ply
      real(wp) :: history(lanes, points, histories_most), strain(lanes, 6, points), &
         & stress(lanes, 6, points), own(2)
      integer :: l, m

      call begin("one weak point of a line")
      ply = scattered_ply(shape_line)
      do l = 1, lanes
         call law%set_lane(l, ply)
      end do
      history(:, :, :) = 0.0_wp
      do m = 1, points
         own(:) = [1.0_wp, merge(0.5_wp, 1.0_wp, m == 2)]
         call law%start_history(spread(narrow, 1, lanes), spread(1.0_wp, 1, lanes), &
            & history(:, m, :))
         call law%set_factors(spread(own, 1, lanes), history(:, m, :))
      end do
      strain(:, :, :) = 0.0_wp
      strain(:, 2, :) = 0.6_wp*ply%matrix_strength(1)/ply%young(2)
      call law%update_points(points, points, 0.0_wp, strain, history, stress)
      call check(all(history(:, 2, matrix_finish) > 0.0_wp), "begins where its strength is passed")
      call check(all(history(:, [1, 3], matrix_finish) <= 0.0_wp), "and nowhere else")
   end subroutine test_far_from_onset

end program test_law_ply_scattered
