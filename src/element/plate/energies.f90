!> Energies of plates: what their laws have dissipated, and what they have stored.
!>
!> The stored energy is the check on the kernels of the forces. Displacement gradients are sums over
!> the nodes of a quad, as in textbooks. With the kernels it shares the geometry of the quads, the
!> stiffness, the tables of the expansion and the laws, so that an error in these does not show.
module plydyn_element_plate_energies
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_material_batch, only : c33
   use plydyn_element_plate_gradients, only : find_gradients
   use plydyn_element_plate_layers, only : layer_batch_type, plate_type
   use plydyn_element_plate_recover, only : point_history
   use plydyn_fem_kinematics, only : find_strain, turn_strain, volume_ratios
   use plydyn_law_compression_barrier, only : barrier_energy
   use plydyn_law_law, only : mechanisms
   implicit none
   private

   public :: add_batch_dissipation, add_plate_energy, point_energy

contains

   !> Add what the laws of a batch of layers have dissipated, mechanism by mechanism, quad by quad
   pure subroutine add_batch_dissipation(batch, metric, history, sums)
      !> The batch
      type(layer_batch_type), intent(in) :: batch
      !> Geometry of each quad, area of a Gauss point last
      real(wp), intent(in) :: metric(:, :, :)
      !> History of the batch, thickness before plane
      real(wp), intent(in) :: history(lanes, size(batch%expansion%weight), size(metric, 2), &
         & batch%blocks, size(metric, 3), batch%histories)
      !> Sums in the order of `mechanism_names`
      type(exact_sums_type), intent(inout) :: sums

      real(wp) :: energy(mechanisms), h(lanes, batch%histories)
      integer :: e, i, k, m, q

      do k = 1, size(batch%laws)
         associate (block => batch%laws(k)%block, law => batch%laws(k)%law, &
            & weight => batch%expansion%weight)
            do e = 1, size(metric, 3)
               energy(:) = 0.0_wp
               do q = 1, size(metric, 2)
                  do m = 1, size(weight)
                     h(:, :) = history(:, m, q, block, e, :)
                     do i = 1, mechanisms
                        if (law%energy_variable(i) == 0) cycle
                        energy(i) = energy(i) + metric(size(metric, 1), q, e)*weight(m) &
                           & *sum(batch%half_thickness(:, block)*law%dissipated_energy(i, h), &
                           & law%owns)
                     end do
                  end do
               end do
               do i = 1, mechanisms
                  if (law%energy_variable(i) /= 0) call sums%add(i, energy(i))
               end do
            end do
         end associate
      end do
   end subroutine add_batch_dissipation

   !> Add the stored energy of all layers over some quads, quad by quad
   pure subroutine add_plate_energy(plate, elements, large, displacement, history, sums)
      !> The plate
      type(plate_type), intent(in) :: plate
      !> First and last quad
      integer, intent(in) :: elements(2)
      !> Large displacement
      logical, intent(in) :: large
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      !> Sums, the first of which gets the energies
      type(exact_sums_type), intent(inout) :: sums

      real(wp) :: energy
      integer :: b, block, e

      do e = elements(1), elements(2)
         energy = 0.0_wp
         do b = 1, size(plate%batches)
            do block = 1, plate%batches(b)%blocks
               energy = energy + block_energy(plate, plate%batches(b), block, e, large, &
                  & displacement, history)
            end do
         end do
         call sums%add(1, energy)
      end do
   end subroutine add_plate_energy

   !> Stored energy of a block of layers over a quad
   pure function block_energy(plate, batch, block, quad, large, displacement, history) &
      & result(energy)
      type(plate_type), intent(in) :: plate
      type(layer_batch_type), intent(in) :: batch
      !> Block of layers, quad of the plate
      integer, intent(in) :: block, quad
      logical, intent(in) :: large
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      real(wp) :: energy

      real(wp) :: gradient(lanes, 3, 3, size(batch%expansion%weight), size(plate%node, 1))
      integer :: m, q

      energy = 0.0_wp
      call find_gradients(plate, batch, block, quad, displacement, gradient)
      do q = 1, size(gradient, 5)
         do m = 1, size(gradient, 4)
            energy = energy + plate%metric(5, q, quad)*batch%expansion%weight(m) &
               & *sum(point_energy(batch, block, large, gradient(:, :, :, m, q), &
               & point_history(plate, batch, block, quad, q, m, history)))
         end do
      end do
   end function block_energy

   !> Energy per area that a block of layers stores at a point, for a weight of 1
   pure function point_energy(batch, block, large, gradient, history) result(energy)
      !> The layers, and the block of them
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block
      !> Large displacement
      logical, intent(in) :: large
      !> Displacement gradient; history of the point
      real(wp), intent(in) :: gradient(lanes, 3, 3), history(:, :)
      real(wp) :: energy(lanes)

      real(wp) :: strain(lanes, 6)

      call find_strain(gradient, large, strain)
      if (size(batch%laws) > 0) then
         call turn_strain(batch%rotation(:, :, block), strain)
         energy(:) = law_energy(batch, block, strain, history)
      else
         energy(:) = elastic_energy(batch%stiffness(:, :, block), strain)
      end if
      if (large) energy(:) = energy + batch%stiffness(:, c33, block) &
         & *barrier_energy(volume_ratios(gradient))
   end function point_energy

   !> The same by the laws of the layers
   pure function law_energy(batch, block, strain, history) result(energy)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block
      !> In ply axes
      real(wp), intent(in) :: strain(lanes, 6)
      real(wp), intent(in) :: history(:, :)
      real(wp) :: energy(lanes)

      integer :: k

      energy(:) = 0.0_wp
      do k = 1, size(batch%laws)
         if (batch%laws(k)%block /= block) cycle
         energy(:) = merge(batch%half_thickness(:, block)*batch%laws(k)%law%stored_energy(strain, &
            & history), energy, batch%laws(k)%law%owns)
      end do
   end function law_energy

   !> The same of elastic layers
   pure function elastic_energy(k, e) result(energy)
      !> Stiffness times half the thickness, as in `layer_batch_type`
      real(wp), intent(in) :: k(lanes, 13)
      !> Strain
      real(wp), intent(in) :: e(lanes, 6)
      real(wp) :: energy(lanes)

      energy(:) = 0.5_wp*(k(:, 1)*e(:, 1)**2 + k(:, 5)*e(:, 2)**2 + k(:, 8)*e(:, 3)**2 &
         & + k(:, 10)*e(:, 4)**2 + k(:, 11)*e(:, 5)**2 + k(:, 13)*e(:, 6)**2) &
         & + e(:, 1)*(k(:, 2)*e(:, 2) + k(:, 3)*e(:, 3) + k(:, 4)*e(:, 4)) &
         & + e(:, 2)*(k(:, 6)*e(:, 3) + k(:, 7)*e(:, 4)) + k(:, 9)*e(:, 3)*e(:, 4) &
         & + k(:, 12)*e(:, 5)*e(:, 6)
   end function elastic_energy

end module plydyn_element_plate_energies
