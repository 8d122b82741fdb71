!> Damage of fibres and matrix of a ply, after nonlinear shear in the plane.
!>
!> The model of the paper is CODAM2 at the level of the ply (eqs 4 and 7 to 11). Onset is by stress.
!> Softening dissipates the toughness over the width of the crack band. Unloading goes to the origin
!> or to the permanent shear strain. The dissipated energy is that of the stiffness lost at the
!> strain of the step, and the plastic work of shear.
module plydyn_law_ply_damage
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_closing_path, only : find_acting
   use plydyn_law_ply_damage_growth, only : add_energies, begin_damage, can_grow, &
      & find_growth_strains, grow, min_path_ratio, ply_step_type
   use plydyn_law_law, only : by_fibre_damage, by_ply_plasticity, law_type, scalars, &
      & shows_dissipated, shows_fibre_damage, shows_matrix_damage, shows_shear_damage
   use plydyn_law_ply_constants, only : ply_constants_type
   use plydyn_law_ply_history, only : driving_strains, fibre_damage, fibre_energy, fibre_finish, &
      & fibre_threshold, find_integrity, growth_limit, growth_threshold, has_begun, &
      & histories_closing, histories_intact, histories_most, histories_open, largest_band, &
      & largest_shear, load_lanes, matrix_damage, matrix_energy, matrix_finish, matrix_threshold, &
      & shear_peak, shear_set, spared_work, store_lanes, swap_closed, to_compression
   use plydyn_law_ply_batch_constants, only : ply_batch_constants_type
   use plydyn_law_ply_no_growth_path, only : update_undamaged
   use plydyn_law_ply_shear_path, only : advance_shear
   implicit none
   private

   !> Strains that damage of fibres and of matrix feels, of 11, 22, 33 and the elastic shear 12
   logical, parameter, public :: driving_members(driving_strains, 2) = reshape([.true., .false., &
      & .false., .false., .false., .true., .false., .true.], [driving_strains, 2])

   !> A law with the constants of the lanes
   type, public, extends(law_type) :: ply_damage_type
      private
      !> Constants of the lanes
      type(ply_batch_constants_type) :: ply
   contains
      procedure :: update
      procedure :: update_points
      procedure :: update_point
      procedure :: set_lane
      procedure :: start_history
      procedure :: output_variables
      procedure :: dissipated_energy
   end type ply_damage_type

contains

   !> Give a lane its ply; it is the law's own from then on
   pure subroutine set_lane(self, lane, constants)
      class(ply_damage_type), intent(inout) :: self
      integer, intent(in) :: lane
      !> Its ply, checked
      class(ply_constants_type), intent(in) :: constants

      self%owns(lane) = .true.
      call self%ply%set_lane(lane, constants)
      self%histories = merge(histories_closing, histories_open, self%ply%any_closes)
      self%energy_variable(by_fibre_damage:by_ply_plasticity) = [fibre_energy, matrix_energy, &
         & spared_work]
      self%intact_histories = histories_intact
      self%permanent_shear = shear_set
      self%band_rule(lane) = constants%band_rule
      self%band_width(lane) = constants%band_width
   end subroutine set_lane

   !> History of a point at time zero: all zero but the widths of the crack band
   pure subroutine start_history(self, length, widest, history)
      class(ply_damage_type), intent(in) :: self
      real(wp), intent(in) :: length(lanes, 2), widest(lanes)
      real(wp), intent(inout) :: history(lanes, *)

      where (self%owns)
         history(:, largest_band) = widest
         history(:, fibre_threshold) = length(:, 1)
         history(:, matrix_threshold) = length(:, 2)
      end where
   end subroutine start_history

   !> Damage and energy of a lane that its fields show; where cracks close, the larger damage
   pure function output_variables(self, lane, history) result(values)
      class(ply_damage_type), intent(in) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: history(lanes, *)
      real(wp) :: values(scalars)

      real(wp) :: damage(2), plastic(lanes)

      damage(:) = history(lane, [fibre_damage, matrix_damage])
      if (self%ply%any_closes) damage(:) = max(damage, &
         & history(lane, [fibre_damage, matrix_damage] + to_compression))
      damage(:) = min(damage, 1.0_wp - self%ply%residual(lane))
      plastic(:) = self%dissipated_energy(by_ply_plasticity, history)
      values(:) = 0.0_wp
      values(shows_fibre_damage:shows_matrix_damage) = damage
      values(shows_shear_damage) = 1.0_wp - product(1.0_wp - damage)
      values(shows_dissipated) = sum(history(lane, [fibre_energy, matrix_energy])) + plastic(lane)
   end function output_variables

   !> Energies that a point has dissipated: plastic work is that of an intact ply, which
   !> follows from the largest shear strain, less what damage has spared
   pure function dissipated_energy(self, mechanism, history) result(energy)
      class(ply_damage_type), intent(in) :: self
      integer, intent(in) :: mechanism
      real(wp), intent(in) :: history(lanes, *)
      real(wp) :: energy(lanes)

      energy(:) = history(:, self%energy_variable(mechanism))
      if (mechanism /= by_ply_plasticity) return
      associate (own => self%ply%own, peak => largest_shear(history(:, shear_peak)))
         energy(:) = self%ply%curve%plastic_work(own*peak, own*history(:, shear_set)) - energy
      end associate
   end function dissipated_energy

   !> Stress and history after a step
   pure subroutine update(self, step, strain, history, stress)
      class(ply_damage_type), intent(in) :: self
      real(wp), intent(in) :: step, strain(lanes, 6)
      real(wp), intent(inout) :: history(lanes, *), stress(lanes, 6)

      call self%update_points(1, 1, step, strain, history, stress)
   end subroutine update

   !> The same for some points of a layer: at once where no damage begins or grows, else one by one
   pure subroutine update_points(self, points, pitch, step, strain, history, stress)
      class(ply_damage_type), intent(in) :: self
      integer, intent(in) :: points, pitch
      real(wp), intent(in) :: step, strain(lanes, 6, points)
      real(wp), intent(inout) :: history(lanes, pitch, *), stress(lanes, 6, points)

      real(wp) :: lane_strain(lanes, 6), lane_history(lanes, histories_most), lane_stress(lanes, 6)
      integer :: m
      logical :: updated(points)

      if (self%driving > 0) then
         updated(:) = .false.
      else
         call update_undamaged(self%ply, points, pitch, strain, history, stress, updated)
      end if
      do m = 1, points
         if (updated(m)) cycle
         call load_lanes(self%ply%own, pitch, self%histories, strain(:, :, m), history(1, m, 1), &
            & lane_strain, lane_history)
         call self%update_point(lane_strain, lane_history, lane_stress)
         call store_lanes(self%ply%own, pitch, self%histories, lane_history, lane_stress, &
            & history(1, m, 1), stress(:, :, m))
      end do
   end subroutine update_points

   !> Stress and history of all lanes after a step, by the whole law
   pure subroutine update_point(self, strain, history, stress)
      class(ply_damage_type), intent(in) :: self
      !> Strain, history and stress
      real(wp), intent(in) :: strain(lanes, 6)
      real(wp), intent(inout) :: history(lanes, self%histories)
      real(wp), intent(out) :: stress(lanes, 6)

      type(ply_step_type) :: now
      real(wp) :: drive(lanes, driving_strains), drive_shear(lanes, 2), own(lanes, driving_strains)
      real(wp) :: shear(lanes, 2), share(lanes, 2)

      call advance_shear(self%ply, strain(:, 4), history, shear, now%work, now%grows)
      if (self%driving > 0) then
         own(:, :3) = strain(:, :3)
         own(:, 4) = sign(shear(:, 2), strain(:, 4))
         call self%exchange_strains(driving_members, own, history, drive, share)
         drive_shear(:, 2) = abs(drive(:, 4))
         drive_shear(:, 1) = self%ply%secant%shear(:, 1)*drive_shear(:, 2)
         call update_damage(self, drive(:, :3), drive_shear, history, now, stress(:, 1:3))
         call self%ply%secant%damaged_stress(strain, now%after, stress)
         now%share(:, :) = share
      else
         call update_damage(self, strain(:, 1:3), shear, history, now, stress(:, 1:3))
      end if
      if (now%grows) call add_energies(self%ply%secant, strain, shear(:, 2), now, stress(:, 1:2), &
         & history)
      call self%ply%secant%degrade_stress(strain, shear(:, 1), now%after(:, 1:2), &
         & now%after(:, 3:4), stress)
      if (self%ply%any_closes) call swap_closed(self%ply%closes, now%sense, history)
   end subroutine update_point

   !> Damage after a step, and the effective normal stresses of the strains that drive it
   pure subroutine update_damage(self, strain, shear, history, now, stress)
      class(ply_damage_type), intent(in) :: self
      !> Strains 11, 22, 33; sizes of the shear stress 12 before damage and of the elastic shear
      !> strain
      real(wp), intent(in) :: strain(lanes, 3), shear(lanes, 2)
      real(wp), intent(inout) :: history(lanes, self%histories)
      type(ply_step_type), intent(inout) :: now
      real(wp), intent(out) :: stress(lanes, 3)

      real(wp) :: share(lanes, 2)
      logical :: begins

      if (self%ply%any_closes) then
         ! the damage that is active with the signs of the normal stresses comes first
         call find_acting(self%ply, 1, strain, shear(:, 1), history, now%sense, now%before)
         call swap_closed(self%ply%closes, now%sense, history)
      end if
      call find_integrity(self%ply%residual, self%ply%any_closes, history, now%sense, now%before)
      now%after(:, :) = now%before
      call soften(self, strain, shear(:, 2), history, now, now%share, stress)
      call begin_damage(self%ply, strain, shear, stress, history, now, begins)
      if (begins) then
         call soften(self, strain, shear(:, 2), history, now, share, stress)
         ! beyond that the step has not led here, and all of it falls at the strain of now
         share(:, :) = merge(share, 1.0_wp, share >= min_path_ratio)
         now%share(:, :) = merge(share, now%share, now%excess >= 0.0_wp)
      end if
      if (begins .or. now%grows) call set_thresholds(self%ply, self%histories, history)
   end subroutine update_damage

   !> Set the growth thresholds, or where cracks close the limits, of modes that have begun
   pure subroutine set_thresholds(ply, histories, h)
      type(ply_batch_constants_type), intent(in) :: ply
      !> Histories of a point
      integer, intent(in) :: histories
      !> History, the active damage first
      real(wp), intent(inout) :: h(lanes, histories)

      real(wp) :: limit(lanes, 2)
      integer :: finish, k, threshold

      call find_growth_strains(ply%plateau, ply%lines, h(:, fibre_damage:matrix_finish), limit)
      do k = 1, 2
         threshold = merge(fibre_threshold, matrix_threshold, k == 1)
         h(:, threshold) = merge(growth_threshold(limit(:, k)), h(:, threshold), &
            & has_begun(h(:, threshold)) .and. ply%closes <= 0.0_wp)
         if (.not. ply%any_closes) cycle
         finish = merge(fibre_finish, matrix_finish, k == 1)
         h(:, growth_limit - 1 + k) = merge(limit(:, k), 0.0_wp, h(:, finish) > 0.0_wp)
      end do
   end subroutine set_thresholds

   !> Grow the damage that has begun, and find the effective normal stresses
   pure subroutine soften(self, strain, elastic, history, now, share, stress)
      class(ply_damage_type), intent(in) :: self
      !> Strains 11, 22, 33, size of the elastic shear strain
      real(wp), intent(in) :: strain(lanes, 3), elastic(lanes)
      real(wp), intent(inout) :: history(lanes, self%histories)
      type(ply_step_type), intent(inout) :: now
      !> Mean of the driving forces over their values at the end
      real(wp), intent(out) :: share(lanes, 2)
      real(wp), intent(out) :: stress(lanes, 3)

      real(wp) :: limit(lanes, 2), size(lanes, 2)
      integer :: l

      !$omp simd
      do l = 1, lanes
         size(l, 1) = abs(strain(l, 1))
         size(l, 2) = sqrt(strain(l, 2)**2 + elastic(l)**2)
      end do
      associate (ply => self%ply, modes => history(:, fibre_damage:matrix_finish))
         call find_growth_strains(ply%plateau, ply%lines, modes, limit)
         if (can_grow(size, limit)) then
            now%grows = .true.
            call grow(ply%plateau, ply%lines, size, modes, share)
            ! where cracks close, another damage may meet the strain of the step at once
            if (ply%any_closes) share(:, :) = merge(1.0_wp, share, share < min_path_ratio &
               & .and. spread(ply%closes > 0.0_wp, 2, 2))
            call find_integrity(ply%residual, ply%any_closes, history, now%sense, now%after)
         else
            share(:, :) = 1.0_wp
         end if
      end associate
      call self%ply%secant%damaged_stress(strain, now%after, stress)
   end subroutine soften

end module plydyn_law_ply_damage
