!> Ply whose fibres break and whose matrix cracks on planes of fracture, with permanent strain.
!>
!> Elastic strain is what is left of the total by permanent shear, crushing and the slip of cracks.
!> Onset of fibres is by the largest stress along them, that of the matrix by the tractions on the
!> most exposed plane through the fibres. Both then soften in a crack band. Closed cracks bear
!> pressure and rub.
!>
!> The energies that a step dissipates are what its work, by the mean of the stresses before and
!> after, leaves beyond the change of the stored energy, to round-off and for steps of any size;
!> `manual/theory.md` has the derivation.
module plydyn_law_ply_fracture_fracture
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : by_fibre_damage, by_friction, by_matrix_damage, by_ply_plasticity, &
      & law_type, scalars, shows_dissipated, shows_fibre_damage, shows_matrix_damage, &
      & shows_plastic_strain, shows_shear_damage
   use plydyn_law_ply_fracture_constants, only : fracture_batch_type, fracture_constants_type
   use plydyn_law_ply_fracture_crack, only : crack_matrix, crack_strain, crack_type
   use plydyn_law_ply_fracture_fibres, only : damage_fibres, fibres_type, uncracked_stress
   use plydyn_law_ply_fracture_history, only : changed, crushed, fibre_damage, &
      & fibre_energy, fibre_onset, fibre_width, friction_energy, held_opening, histories, &
      & histories_intact, last_contact, last_stress, matrix_damage, matrix_energy, matrix_width, &
      & near_onset, plane_cosine, plane_sine, plastic_energy, plastic_shear, slip, state, &
      & to_compression, untouched
   use plydyn_law_ply_fracture_intact_path, only : update_intact
   use plydyn_law_ply_fracture_permanent, only : add_permanent_strain
   use plydyn_law_ply_fracture_plane, only : plane_traction
   use plydyn_law_ply_history, only : load_lanes, store_lanes
   implicit none
   private

   !> A law with the constants of the lanes
   type, public, extends(law_type) :: ply_fracture_type
      private
      !> Constants of the lanes
      type(fracture_batch_type) :: ply
   contains
      procedure :: update
      procedure :: update_points
      procedure :: set_lane
      procedure :: start_history
      procedure :: output_variables
      procedure :: stored_energy
   end type ply_fracture_type

contains

   !> Give a lane its ply; it is the law's own from then on
   pure subroutine set_lane(self, lane, constants)
      class(ply_fracture_type), intent(inout) :: self
      integer, intent(in) :: lane
      !> Its ply, checked
      class(fracture_constants_type), intent(in) :: constants

      self%owns(lane) = .true.
      call self%ply%set_lane(lane, constants)
      self%histories = histories
      self%intact_histories = histories_intact
      self%energy_variable([by_fibre_damage, by_matrix_damage, by_ply_plasticity, by_friction]) &
         & = [fibre_energy, matrix_energy, plastic_energy, friction_energy]
      self%band_rule(lane) = constants%band_rule
      self%band_width(lane) = constants%band_width
   end subroutine set_lane

   !> History of a point at time zero: all zero but the widths of the crack band
   pure subroutine start_history(self, length, widest, history)
      class(ply_fracture_type), intent(in) :: self
      real(wp), intent(in) :: length(lanes, 2), widest(lanes)
      real(wp), intent(inout) :: history(lanes, *)

      where (self%owns)
         history(:, fibre_width) = length(:, 1)
         history(:, matrix_width) = length(:, 2)
      end where
   end subroutine start_history

   !> Size of the permanent shear strain, damage and energy of a lane, for the fields
   pure function output_variables(self, lane, history) result(values)
      class(ply_fracture_type), intent(in) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: history(lanes, *)
      real(wp) :: values(scalars)

      associate (damage => [max(history(lane, fibre_damage), history(lane, fibre_damage &
         & + to_compression)), history(lane, matrix_damage)])
         values(shows_plastic_strain) = norm2(history(lane, plastic_shear:plastic_shear + 2))
         values(shows_fibre_damage:shows_matrix_damage) = damage
         values(shows_shear_damage) = 1.0_wp - product(1.0_wp - damage)
         values(shows_dissipated) = sum(history(lane, fibre_energy:friction_energy))
      end associate
   end function output_variables

   !> Energy per volume of the intact and of the cracked share of the plane, each with its strain.
   !> The stress of a cracked point is that of its step, in which closed faces have slid
   pure function stored_energy(self, strain, history) result(energy)
      class(ply_fracture_type), intent(in) :: self
      real(wp), intent(in) :: strain(lanes, 6), history(lanes, *)
      real(wp) :: energy(lanes)

      real(wp) :: elastic(lanes, 6), stress(lanes, 6)
      integer :: k

      elastic(:, :) = strain
      elastic(:, 3) = elastic(:, 3) - history(:, crushed)
      elastic(:, 4:) = elastic(:, 4:) - history(:, plastic_shear:plastic_shear + 2)
      stress(:, :) = 0.0_wp
      call self%stress_at(strain, history, stress)
      do k = 1, 6
         stress(:, k) = merge(history(:, last_stress - 1 + k), stress(:, k), &
            & abs(history(:, plane_cosine)) + abs(history(:, plane_sine)) > 0.0_wp)
      end do
      energy(:) = 0.5_wp*(sum(stress*elastic, 2) - history(:, matrix_damage) &
         & *sum(history(:, slip:slip + 2)*history(:, last_contact:last_contact + 2), 2))
   end function stored_energy

   !> Stress and history after a step
   pure subroutine update(self, step, strain, history, stress)
      class(ply_fracture_type), intent(in) :: self
      real(wp), intent(in) :: step, strain(lanes, 6)
      real(wp), intent(inout) :: history(lanes, *), stress(lanes, 6)

      call self%update_points(1, 1, step, strain, history, stress)
   end subroutine update

   !> The same for some points of a layer: first those that nothing has happened to
   pure subroutine update_points(self, points, pitch, step, strain, history, stress)
      class(ply_fracture_type), intent(in) :: self
      integer, intent(in) :: points, pitch
      real(wp), intent(in) :: step, strain(lanes, 6, points)
      real(wp), intent(inout) :: history(lanes, pitch, *), stress(lanes, 6, points)

      real(wp) :: lane_strain(lanes, 6), lane_history(lanes, histories), lane_stress(lanes, 6)
      integer :: m
      logical :: updated(points)

      call update_intact(self%ply, points, pitch, strain, history, stress, updated)
      do m = 1, points
         if (updated(m)) cycle
         call load_lanes(self%ply%own, pitch, histories, strain(:, :, m), history(1, m, 1), &
            & lane_strain, lane_history)
         call update_point(self%ply, lane_strain, lane_history, lane_stress)
         call store_lanes(self%ply%own, pitch, histories, lane_history, lane_stress, &
            & history(1, m, 1), stress(:, :, m))
      end do
   end subroutine update_points

   !> Stress and history of all lanes of a point after a step
   pure subroutine update_point(ply, strain, history, stress)
      type(fracture_batch_type), intent(in) :: ply
      !> Strain, history and stress
      real(wp), intent(in) :: strain(lanes, 6)
      real(wp), intent(inout) :: history(lanes, histories)
      real(wp), intent(out) :: stress(lanes, 6)

      type(crack_type) :: crack
      type(fibres_type) :: fibres
      real(wp) :: elastic(lanes, 6), growth(lanes, 4), opened(lanes, 6)
      logical :: grows

      call add_permanent_strain(ply, strain, history, elastic, growth, grows)
      call damage_fibres(ply, elastic, history, fibres)
      call uncracked_stress(ply, elastic, fibres, stress)
      call crack_matrix(ply, stress, fibres, history, crack)
      if (crack%any) then
         call crack_strain(crack, opened)
         opened(:, :) = elastic - opened
         call uncracked_stress(ply, opened, fibres, stress)
      end if
      call fill_last_stress(ply, stress, history)
      if (grows .or. fibres%changes) call add_energies(ply, fibres, growth, stress, history)
      if (crack%any) call add_crack_energies(crack, history)
      call keep(crack, stress, history)
   end subroutine update_point

   !> Let a point that nothing had happened to, which has kept no stress, have that of now; where
   !> shear yields at once, it had no shear
   pure subroutine fill_last_stress(ply, stress, history)
      type(fracture_batch_type), intent(in) :: ply
      !> Stress after the step
      real(wp), intent(in) :: stress(lanes, 6)
      !> History of the point
      real(wp), intent(inout) :: history(lanes, histories)

      real(wp) :: fresh, kept
      integer :: k, l

      do k = 1, 6
         !$omp simd private(fresh, kept)
         do l = 1, lanes
            fresh = merge(1.0_wp, 0.0_wp, history(l, state) <= untouched)
            kept = merge(1.0_wp - ply%at_once(l), 1.0_wp, k > 3)
            history(l, last_stress - 1 + k) = fresh*kept*stress(l, k) &
               & + (1.0_wp - fresh)*history(l, last_stress - 1 + k)
         end do
      end do
   end subroutine fill_last_stress

   !> Keep crack and stress for the next step
   pure subroutine keep(crack, stress, history)
      !> Crack and stress after the step
      type(crack_type), intent(in) :: crack
      real(wp), intent(in) :: stress(lanes, 6)
      !> History of the point
      real(wp), intent(inout) :: history(lanes, histories)

      real(wp) :: happened
      integer :: k, l

      history(:, last_stress:last_stress + 5) = stress
      if (crack%any) then
         history(:, plane_cosine) = crack%has*crack%cosine
         history(:, plane_sine) = crack%has*crack%sine
         history(:, matrix_damage) = crack%damage
         history(:, held_opening) = crack%has*crack%held
         do k = 1, 3
            history(:, slip - 1 + k) = crack%has*crack%slip(:, k)
            history(:, last_contact - 1 + k) = crack%has*crack%contact(:, k)
         end do
      end if
      !$omp simd private(happened)
      do l = 1, lanes
         happened = history(l, fibre_onset) + history(l, fibre_onset + to_compression) &
            & + abs(history(l, plane_cosine)) &
            & + abs(history(l, plane_sine)) + abs(history(l, crushed)) &
            & + abs(history(l, plastic_shear)) + abs(history(l, plastic_shear + 1)) &
            & + abs(history(l, plastic_shear + 2))
         history(l, state) = merge(changed, near_onset, happened > 0.0_wp)
      end do
   end subroutine keep

   !> Add what fibres and permanent strains dissipate
   pure subroutine add_energies(ply, fibres, growth, stress, h)
      type(fracture_batch_type), intent(in) :: ply
      !> What is left of the fibres
      type(fibres_type), intent(in) :: fibres
      !> Growth of the permanent strains 12, 13, 23 and 33; stress after the step
      real(wp), intent(in) :: growth(lanes, 4), stress(lanes, 6)
      !> History of the point, with the stress before the step
      real(wp), intent(inout) :: h(lanes, histories)

      real(wp) :: before(6), lost, now(6), sheared
      integer :: k, l

      associate (g => ply%shear)
         !$omp simd private(before, k, lost, now, sheared)
         do l = 1, lanes
            do k = 1, 6
               before(k) = h(l, last_stress - 1 + k)
               now(k) = stress(l, k)
            end do
            lost = 0.5_wp*(fibres%before(l) - fibres%after(l))/(fibres%before(l)*fibres%after(l))
            sheared = 0.5_wp*(fibres%sheared_before(l) - fibres%sheared(l)) &
               & /(fibres%sheared_before(l)*fibres%sheared(l))
            h(l, fibre_energy) = h(l, fibre_energy) + lost*ply%compliance(l)*before(1)*now(1) &
               & + sheared*(before(4)*now(4)/g(l, 1) + before(5)*now(5)/g(l, 2))
            h(l, plastic_energy) = h(l, plastic_energy) + 0.5_wp*( &
               & (before(4) + now(4))*growth(l, 1) + (before(5) + now(5))*growth(l, 2) &
               & + (before(6) + now(6))*growth(l, 3) + (before(3) + now(3))*growth(l, 4))
         end do
      end associate
   end subroutine add_energies

   !> Add what the crack dissipates: by friction what slip does of work, of the share that had
   !> cracked before and of what cracks now; by damage the rest
   pure subroutine add_crack_energies(crack, h)
      !> The crack after the step
      type(crack_type), intent(in) :: crack
      !> History of the point, that of the crack as it was before the step
      real(wp), intent(inout) :: h(lanes, histories)

      real(wp) :: after(3), before(3), last(lanes, 3), rubbed, total, was
      integer :: k, l

      call plane_traction(crack%cosine, crack%sine, h(:, last_stress:last_stress + 5), last)
      associate (t => crack%whole, plane => crack%stiffness, contact => crack%contact)
         !$omp simd private(after, before, k, rubbed, total, was)
         do l = 1, lanes
            was = h(l, matrix_damage)
            total = 0.0_wp
            rubbed = (crack%damage(l) - was)*(crack%slip(l, 2)*contact(l, 2) &
               & + crack%slip(l, 3)*contact(l, 3))
            do k = 1, 3
               before(k) = was*h(l, slip - 1 + k)
               after(k) = crack%damage(l)*crack%slip(l, k)
               total = total + (last(l, k) + contact(l, k))*after(k) &
                  & - (t(l, k) + h(l, last_contact - 1 + k))*before(k)
               rubbed = rubbed + 0.5_wp*was*(crack%slip(l, k) - h(l, slip - 1 + k)) &
                  & *(contact(l, k) + h(l, last_contact - 1 + k))
            end do
            ! traction of the plane after the step: that of a whole one less what slip relieves
            total = total + before(1)*(plane%normal(l)*after(1) + plane%both(l)*after(2)) &
               & + before(2)*(plane%both(l)*after(1) + plane%across(l)*after(2)) &
               & + before(3)*plane%along(l)*after(3)
            h(l, friction_energy) = h(l, friction_energy) + rubbed
            h(l, matrix_energy) = h(l, matrix_energy) + 0.5_wp*total - rubbed
         end do
      end associate
   end subroutine add_crack_energies

end module plydyn_law_ply_fracture_fracture
