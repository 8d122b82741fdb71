!> Energy that the laws of layers have dissipated, mechanism by mechanism.
module plydyn_element_plate_dissipation
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_plate_layers, only : layer_batch_type, plate_type
   use plydyn_law_law, only : mechanisms
   implicit none
   private

   public :: add_plate_dissipation

contains

   !> Add the energies of all layers
   pure subroutine add_plate_dissipation(plate, history, sums)
      !> The plate
      type(plate_type), intent(in) :: plate
      !> History of all Gauss points
      real(wp), intent(in), contiguous :: history(:)
      !> Sums in the order of `mechanism_names`
      type(exact_sums_type), intent(inout) :: sums

      integer :: b

      do b = 1, size(plate%batches)
         call add_batch_dissipation(plate%batches(b), plate%metric, &
            & history(plate%batches(b)%first_history:), sums)
      end do
   end subroutine add_plate_dissipation

   !> Add the energies of a batch of layers, quad by quad
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

end module plydyn_element_plate_dissipation
