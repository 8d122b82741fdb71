!> What bricks show: strain and stress, the mean over the points of a brick; energies that their
!> laws have stored and dissipated, and that hourglass control has.
module plydyn_element_brick_recover
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_brick_bricks, only : bricks_type, corners
   use plydyn_element_brick_kernel, only : find_strains, gather, hourglass_energy
   use plydyn_element_group, only : recovered, scalars_at
   use plydyn_element_material_batch, only : c33, elastic_stress, point_values
   use plydyn_fem_kinematics, only : turn_strain, volume_ratios
   use plydyn_law_compression_barrier, only : barrier_energy
   use plydyn_law_law, only : mechanisms
   implicit none
   private

   public :: add_brick_dissipation, add_brick_energy, brick_values

contains

   !> Add what the law of bricks has dissipated, batch by batch
   pure subroutine add_brick_dissipation(bricks, history, sums)
      !> The bricks of a part
      type(bricks_type), intent(in) :: bricks
      !> History of the part
      real(wp), intent(in) :: history(lanes, bricks%histories, bricks%points, *)
      !> Sums in the order of `mechanism_names`
      type(exact_sums_type), intent(inout) :: sums

      integer :: b, i, m

      if (size(bricks%laws) == 0) return
      associate (law => bricks%laws(1)%law)
         do i = 1, mechanisms
            if (law%energy_variable(i) == 0) cycle
            do b = 1, size(bricks%shape)
               do m = 1, bricks%points
                  call sums%add(i, dot_product(bricks%shapes(bricks%shape(b))%volume(:, m), &
                     & law%dissipated_energy(i, history(:, :, m, b))))
               end do
            end do
         end do
      end associate
   end subroutine add_brick_dissipation

   !> Add the energy that bricks have stored, and that which hourglass control has stored or taken,
   !> batch by batch
   pure subroutine add_brick_energy(bricks, elements, large, displacement, history, sums)
      !> The bricks of a part
      type(bricks_type), intent(in) :: bricks
      !> First and last batch
      integer, intent(in) :: elements(2)
      !> Large displacement
      logical, intent(in) :: large
      !> Displacement of all points, history of the part
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp), intent(in) :: history(lanes, bricks%histories, bricks%points, *)
      !> Three sums
      type(exact_sums_type), intent(inout) :: sums

      real(wp) :: energy, u(lanes, corners, 3)
      real(wp) :: e(lanes, 6, bricks%points), h(lanes, 3, 3, bricks%points)
      integer :: b, m

      do b = elements(1), elements(2)
         call gather(bricks%place(:, :, b), displacement, u)
         associate (shape => bricks%shapes(bricks%shape(b)))
            call find_strains(bricks, shape, large, u, h, e)
            energy = 0.0_wp
            do m = 1, bricks%points
               energy = energy + dot_product(shape%volume(:, m), point_energy(bricks, large, &
                  & h(:, :, :, m), e(:, :, m), history(:, :, m, b)))
            end do
         end associate
         call sums%add(1, energy)
         if (bricks%points > 1) cycle
         energy = hourglass_energy(bricks, b, large, displacement, history)
         call sums%add(2, energy)
         if (bricks%viscosity > 0.0_wp) call sums%add(3, energy)
      end do
   end subroutine add_brick_energy

   !> Energy per volume at a point
   pure function point_energy(bricks, large, gradient, strain, history) result(energy)
      type(bricks_type), intent(in) :: bricks
      logical, intent(in) :: large
      !> Displacement gradient and strain in the axes of the model
      real(wp), intent(in) :: gradient(lanes, 3, 3), strain(lanes, 6)
      !> History of the point
      real(wp), intent(in) :: history(lanes, bricks%histories)
      real(wp) :: energy(lanes)

      real(wp) :: along(lanes, 6), stress(lanes, 6)

      if (size(bricks%laws) == 0) then
         call elastic_stress(bricks%stiffness(:, :, 1), strain, stress)
         energy(:) = 0.5_wp*sum(stress*strain, 2)
      else
         along(:, :) = strain
         call turn_strain(bricks%rotation(:, :, 1), along)
         energy(:) = bricks%laws(1)%law%stored_energy(along, history)
      end if
      if (large) energy(:) = energy + bricks%stiffness(:, c33, 1) &
         & *barrier_energy(volume_ratios(gradient))
   end function point_energy

   !> Values of the bricks of a batch, (lanes, `recovered`); see `point_values`
   pure function brick_values(bricks, batch, large, displacement, history) result(mean)
      !> The bricks of a part
      type(bricks_type), intent(in) :: bricks
      !> The batch
      integer, intent(in) :: batch
      !> Large displacement
      logical, intent(in) :: large
      !> Displacement of all points
      real(wp), intent(in) :: displacement(*)
      !> History of the part
      real(wp), intent(in) :: history(lanes, bricks%histories, bricks%points, *)
      real(wp) :: mean(lanes, recovered)

      real(wp) :: strain(lanes, 6, bricks%points), gradient(lanes, 3, 3, bricks%points)
      real(wp) :: motion(lanes, corners, 3), values(lanes, recovered), whole(lanes)
      integer :: i, l, m

      mean(:, :) = 0.0_wp
      values(:, :) = 0.0_wp
      whole(:) = tiny(1.0_wp)
      call gather(bricks%place(:, :, batch), displacement, motion)
      associate (shape => bricks%shapes(bricks%shape(batch)))
         call find_strains(bricks, shape, large, motion, gradient, strain)
         do m = 1, bricks%points
            values(:, :scalars_at) = point_values(bricks, 1, large, gradient(:, :, :, m), &
               & strain(:, :, m), history(:, :, m, batch))
            if (size(bricks%laws) > 0) then
               do l = 1, lanes
                  values(l, scalars_at + 1:) = bricks%laws(1)%law%output_variables(l, &
                     & history(:, :, m, batch))
               end do
            end if
            do i = 1, recovered
               mean(:, i) = mean(:, i) + shape%volume(:, m)*values(:, i)
            end do
            whole(:) = whole + shape%volume(:, m)
         end do
      end associate
      do i = 1, recovered
         mean(:, i) = mean(:, i)/whole
      end do
   end function brick_values

end module plydyn_element_brick_recover
