!> Growth of damage from its onset: stress falls linearly with strain, that of fibres on two lines,
!> to zero or to a plateau. The strains between which a mode softens are frozen in the step of its
!> onset. What a step of growth dissipates.
module plydyn_law_ply_damage_growth
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_batch_constants, only : ply_batch_constants_type
   use plydyn_law_ply_fibre_lines, only : fibre_lines_type, first_line_end, strain_on_tail, &
      & stress_on_tail
   use plydyn_law_ply_history, only : band_width, began_in_compression, begun_shear, &
      & begun_threshold, fibre_energy, fibre_finish, fibre_onset, fibre_threshold, matrix_energy, &
      & matrix_finish, matrix_onset, matrix_threshold, shear_peak, spared_work
   use plydyn_law_ply_secant, only : secant_type
   implicit none
   private

   public :: add_energies, begin_damage, can_grow, find_growth_strains, grow

   !> Least ratio of the strain at which damage begins or goes on to that at the end of the step.
   !> Below it the point was beyond that strain before the step, by a criterion that has changed.
   !> The end of compression changes the toughness of shear, closes a crack, or has its own strains
   real(wp), parameter, public :: min_path_ratio = 0.9_wp

   !> Ratio of damage increment to relative strain increment above which softening is treated as a
   !> sudden drop
   real(wp), parameter :: sudden = 100.0_wp

   !> Change of a point in a step
   type, public :: ply_step_type
      !> Plastic work per volume of an intact ply
      real(wp) :: work(lanes)
      !> Stresses along and across the fibres whose signs count; only where cracks close
      real(wp) :: sense(lanes, 2)
      !> Integrity before and after: R1 and R2 for normal stress, R1 and R2 for shear
      real(wp) :: before(lanes, 4), after(lanes, 4)
      !> Excess over onset of the modes that have not begun: 0 or more where one begins
      real(wp) :: excess(lanes, 2)
      !> Mean of the driving forces over their values at the end, for fibres and for matrix
      real(wp) :: share(lanes, 2)
      !> Whether the permanent shear strain or any damage grows
      logical :: grows
   end type ply_step_type

   !> History of a mode: damage; strain at onset, 0 before, see `began_in_compression`; strain at
   !> which the last falling line meets zero
   integer, parameter :: of_damage = 1, of_onset = 2, of_finish = 3

   !> Keeps divisors off zero where nothing has begun
   real(wp), parameter :: small = 1.0e-30_wp
   !> A strain that nothing reaches
   real(wp), parameter :: out_of_reach = 1.0e30_wp

contains

   !> Freeze the strains of the modes that begin in this step
   pure subroutine begin_damage(ply, strain, shear, stress, history, now, begins)
      type(ply_batch_constants_type), intent(in) :: ply
      !> Strains 11, 22, 33; sizes of shear stress and elastic shear strain; effective normal
      !> stresses
      real(wp), intent(in) :: strain(lanes, 3), shear(lanes, 2), stress(lanes, 3)
      !> History of the point
      real(wp), intent(inout) :: history(lanes, *)
      !> Change of the point; gets the excess over onset
      type(ply_step_type), intent(inout) :: now
      !> A mode begins in some lane
      logical, intent(out) :: begins

      real(wp) :: most
      integer :: lane

      call ply%onset%find_onset(stress, strain, shear, band_width(history(:, fibre_threshold)), &
         & band_width(history(:, matrix_threshold)), now%excess)
      most = -1.0_wp
      associate (excess => now%excess)
         !$omp simd reduction(max:most)
         do lane = 1, lanes
            excess(lane, 1) = merge(-1.0_wp, excess(lane, 1), history(lane, fibre_finish) > 0.0_wp)
            excess(lane, 2) = merge(-1.0_wp, excess(lane, 2), history(lane, matrix_finish) > 0.0_wp)
            most = max(most, excess(lane, 1), excess(lane, 2))
         end do
      end associate
      begins = most >= 0.0_wp
      if (.not. begins) return
      ! once in the life of a mode at a point
      do lane = 1, lanes
         if (any(now%excess(lane, :) >= 0.0_wp)) call begin_modes(ply, lane, now%excess, stress, &
            & strain, shear, history)
      end do
   end subroutine begin_damage

   !> Begin the modes of a lane that have no excess below 0
   pure subroutine begin_modes(ply, lane, excess, stress, strain, shear, history)
      type(ply_batch_constants_type), intent(in) :: ply
      integer, intent(in) :: lane
      !> Excess over onset; trial stresses and strains, of which the first two count; shear
      real(wp), intent(in) :: excess(lanes, 2), stress(lanes, 3), strain(lanes, 3), shear(lanes, 2)
      real(wp), intent(inout) :: history(lanes, *)

      real(wp) :: in_plane(2), length

      history(lane, shear_peak) = begun_shear(history(lane, shear_peak))
      if (excess(lane, 1) >= 0.0_wp) then
         length = band_width(history(lane, fibre_threshold))
         call ply%onset%begin_fibre(lane, stress(lane, 1), strain(lane, 1), length, &
            & history(lane, fibre_onset), history(lane, fibre_finish))
         history(lane, fibre_threshold) = begun_threshold(length)
      end if
      if (excess(lane, 2) >= 0.0_wp) then
         length = band_width(history(lane, matrix_threshold))
         in_plane(:) = shear(lane, :)
         call ply%onset%begin_matrix(lane, stress(lane, 2), strain(lane, 2), in_plane, length, &
            & history(lane, matrix_onset), history(lane, matrix_finish))
         history(lane, matrix_threshold) = begun_threshold(length)
      end if
   end subroutine begin_modes

   !> Whether damage that has begun grows in any lane: `grow` changes nothing elsewhere
   pure logical function can_grow(strain, limit)
      !> Equivalent strain of each mode, and that beyond which its damage grows
      real(wp), intent(in) :: strain(lanes, 2), limit(lanes, 2)

      real(wp) :: most
      integer :: l

      most = 0.0_wp
      !$omp simd reduction(max:most)
      do l = 1, lanes
         most = max(most, strain(l, 1) - limit(l, 1), strain(l, 2) - limit(l, 2))
      end do
      can_grow = most > 0.0_wp
   end function can_grow

   !> Strains beyond which damage that has begun grows: those which belong to the damage; out of
   !> reach before onset and for full damage
   pure subroutine find_growth_strains(plateau, lines, mode, limit)
      !> As in `grow`
      real(wp), intent(in) :: plateau(lanes, 2)
      type(fibre_lines_type), intent(in) :: lines
      !> History of each mode
      real(wp), intent(in) :: mode(lanes, of_finish, 2)
      !> Equivalent strain of each mode
      real(wp), intent(out) :: limit(lanes, 2)

      real(wp) :: damage, fall, finish(lanes, 2), floor, last, onset, part, rise, tail(lanes, 2)
      integer :: k, l

      call find_lines(lines, mode, finish, tail)
      do k = 1, 2
         !$omp simd private(damage, fall, floor, last, onset, part, rise)
         do l = 1, lanes
            damage = mode(l, of_damage, k)
            onset = abs(mode(l, of_onset, k))
            last = finish(l, k)
            fall = last - onset
            floor = merge(plateau(l, k), 0.0_wp, began_in_compression(mode(l, of_onset, k)))
            call find_reached(damage, onset, last, floor, part, rise)
            limit(l, k) = merge(rise/part, out_of_reach, min(fall, 1.0_wp - damage) > 0.0_wp)
         end do
      end do
      if (.not. lines%any) return
      !$omp simd
      do l = 1, lanes
         limit(l, 1) = max(limit(l, 1), strain_on_tail(abs(mode(l, of_onset, 1)), &
            & mode(l, of_finish, 1), tail(l, 1), mode(l, of_damage, 1)))
      end do
   end subroutine find_growth_strains

   !> Damage of the modes after a step; it never heals. The stress over the strength is
   !> (finish - strain)/(finish - onset), the second line or the plateau, whichever is most
   pure subroutine grow(plateau, lines, strain, mode, share)
      !> Share of the strength on the plateau, by mode, when onset was in compression
      real(wp), intent(in) :: plateau(lanes, 2)
      !> Lines of fibres
      type(fibre_lines_type), intent(in) :: lines
      !> Equivalent strain of each mode
      real(wp), intent(in) :: strain(lanes, 2)
      !> History of each mode
      real(wp), intent(inout) :: mode(lanes, of_finish, 2)
      !> Strain at which the old damage was reached over that of the new one, 1 before onset: what
      !> makes the end value of the driving force its mean when all strains grow in proportion
      real(wp), intent(out) :: share(lanes, 2)

      real(wp) :: damage, fall, finish(lanes, 2), floor, last, left, least(lanes, 2), now, onset
      real(wp) :: part, reached(lanes, 2), rise, tail(lanes, 2)
      integer :: k, l

      call find_lines(lines, mode, finish, tail)
      call find_tail(lines, strain, mode, tail, least, reached)
      do k = 1, 2
         !$omp simd private(damage, fall, floor, last, left, now, onset, part, rise)
         do l = 1, lanes
            damage = mode(l, of_damage, k)
            onset = abs(mode(l, of_onset, k))
            last = finish(l, k)
            floor = merge(plateau(l, k), 0.0_wp, began_in_compression(mode(l, of_onset, k)))
            fall = last - onset
            call find_reached(damage, onset, last, floor, part, rise)
            share(l, k) = merge(rise/max(strain(l, k)*part, rise, small), 1.0_wp, fall > 0.0_wp)
            share(l, k) = max(share(l, k), reached(l, k)/max(strain(l, k), reached(l, k), small))

            now = max(strain(l, k), onset, small)
            left = max(last - now, max(floor, least(l, k))*fall)
            damage = max(damage, 1.0_wp - onset*left/max(now*fall, small))
            mode(l, of_damage, k) = merge(min(damage, 1.0_wp), mode(l, of_damage, k), &
               & fall > 0.0_wp)
         end do
      end do
   end subroutine grow

   !> Strains at which the first line of each mode would meet zero, and shares of the strength in
   !> the second
   pure subroutine find_lines(lines, mode, finish, tail)
      type(fibre_lines_type), intent(in) :: lines
      !> History of each mode
      real(wp), intent(in) :: mode(lanes, of_finish, 2)
      real(wp), intent(out) :: finish(lanes, 2), tail(lanes, 2)

      real(wp) :: reach
      integer :: l

      finish(:, :) = mode(:, of_finish, :)
      tail(:, :) = 0.0_wp
      if (.not. lines%any) return
      !$omp simd private(reach)
      do l = 1, lanes
         tail(l, 1) = merge(lines%tail(l, 2), lines%tail(l, 1), &
            & began_in_compression(mode(l, of_onset, 1)))
         reach = merge(lines%reach(l, 2), lines%reach(l, 1), &
            & began_in_compression(mode(l, of_onset, 1)))
         finish(l, 1) = first_line_end(abs(mode(l, of_onset, 1)), finish(l, 1), tail(l, 1), reach)
      end do
   end subroutine find_lines

   !> Share of the strength that the second line leaves at a strain, and the strain on it that
   !> belongs to the damage; 0 without one
   pure subroutine find_tail(lines, strain, mode, tail, least, reached)
      type(fibre_lines_type), intent(in) :: lines
      !> Equivalent strain and history of each mode
      real(wp), intent(in) :: strain(lanes, 2), mode(lanes, of_finish, 2)
      !> Share of the strength in the second line
      real(wp), intent(in) :: tail(lanes, 2)
      real(wp), intent(out) :: least(lanes, 2), reached(lanes, 2)

      real(wp) :: onset
      integer :: l

      least(:, :) = 0.0_wp
      reached(:, :) = 0.0_wp
      if (.not. lines%any) return
      !$omp simd private(onset)
      do l = 1, lanes
         onset = abs(mode(l, of_onset, 1))
         least(l, 1) = stress_on_tail(onset, mode(l, of_finish, 1), tail(l, 1), strain(l, 1))
         reached(l, 1) = strain_on_tail(onset, mode(l, of_finish, 1), tail(l, 1), &
            & mode(l, of_damage, 1))
      end do
   end subroutine find_tail

   !> The strain that belongs to a damage, rise/part, on the line or on the plateau
   pure subroutine find_reached(damage, onset, last, floor, part, rise)
      !> Damage; size of the strain at onset, and strain at which the falling line meets zero
      real(wp), intent(in) :: damage, onset, last
      !> Share of the strength on the plateau
      real(wp), intent(in) :: floor
      !> Denominator and numerator
      real(wp), intent(out) :: part, rise

      real(wp) :: intact, left

      left = max(last - damage*(last - onset), small)
      intact = max(1.0_wp - damage, small)
      rise = onset*max(last*intact, floor*left)
      part = left*intact
   end subroutine find_reached

   !> Add the energy that the loss of stiffness releases at the strain of the step, and the plastic
   !> work that it spares. A sudden drop releases half the change of the compliance times the stress
   !> before and the stress after. Where the stress follows a line, as Poisson's effect lets it in
   !> uniaxial stress, both are the stress after
   pure subroutine add_energies(secant, e, elastic, now, s, h)
      !> Stiffness of the lanes
      type(secant_type), intent(in) :: secant
      !> Strain, size of the elastic shear strain
      real(wp), intent(in) :: e(lanes, 6), elastic(lanes)
      !> Integrity before and after the step
      type(ply_step_type), intent(in) :: now
      !> Effective normal stresses 11 and 22 after the step
      real(wp), intent(in) :: s(lanes, 2)
      !> History, of which the energies grow
      real(wp), intent(inout) :: h(lanes, *)

      real(wp) :: along, across, first(lanes, 3), loss(4), mean(2), plane
      integer :: l

      call secant%damaged_stress(e, now%before, first)
      associate (compliance => secant%compliance, g => secant%shear, &
         & degraded => secant%g_degraded, before => now%before, after => now%after, &
         & share => now%share)
         !$omp simd private(across, along, loss, mean, plane)
         do l = 1, lanes
            loss(:) = before(l, :) - after(l, :)
            mean(:) = 0.5_wp*(before(l, 3:4) + after(l, 3:4))
            plane = g(l, 1)*elastic(l)**2
            along = merge(first(l, 1), s(l, 1), loss(1) > sudden*(1.0_wp - share(l, 1)))
            across = merge(first(l, 2), s(l, 2), loss(2) > sudden*(1.0_wp - share(l, 2)))
            h(l, fibre_energy) = h(l, fibre_energy) + 0.5_wp*share(l, 1)*( &
               & loss(1)*compliance(l, 1)*along*s(l, 1) &
               & + loss(3)*(mean(2)*plane + degraded(l, 1)*e(l, 5)**2))
            h(l, matrix_energy) = h(l, matrix_energy) + 0.5_wp*share(l, 2)*( &
               & loss(2)*compliance(l, 2)*across*s(l, 2) &
               & + loss(4)*(mean(1)*plane + degraded(l, 2)*e(l, 6)**2))
            h(l, spared_work) = h(l, spared_work) &
               & + now%work(l)*(1.0_wp - after(l, 3)*after(l, 4))
         end do
      end associate
   end subroutine add_energies

end module plydyn_law_ply_damage_growth
