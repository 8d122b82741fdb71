!> Energy that the plies of a crack zone have stored.
module plydyn_element_cracked_stored_energy
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_cracked_cells, only : cells_type, wedges
   use plydyn_element_cracked_wedges, only : faces, find_gradients, wedge_points
   use plydyn_element_layer_scalars, only : point_history
   use plydyn_element_plate_energies, only : point_energy
   use plydyn_element_plate_layers, only : plate_type
   implicit none
   private

   public :: add_wedge_energy

contains

   !> Add the stored energy of all layers over some quads, quad by quad
   pure subroutine add_wedge_energy(plate, cells, elements, large, displacement, history, sums)
      !> The plate and its division
      type(plate_type), intent(in) :: plate
      type(cells_type), intent(in) :: cells
      !> First and last quad; large displacement
      integer, intent(in) :: elements(2)
      logical, intent(in) :: large
      !> Motion and history of all points
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      !> Sums, the first of which gets the energies
      type(exact_sums_type), intent(inout) :: sums

      real(wp) :: energy, gradient(lanes, 3, 3, wedge_points)
      integer :: b, e, m, w

      associate (batch => plate%batches(1))
         do e = elements(1), elements(2)
            energy = 0.0_wp
            do b = 1, batch%blocks
               call find_gradients(plate, cells, b, e, displacement, gradient)
               do w = 1, wedges
                  do m = 1, faces
                     energy = energy + plate%metric(5, w, e)*batch%expansion%weight(m) &
                        & *sum(point_energy(batch, b, large, &
                        & gradient(:, :, :, m + faces*(w - 1)), point_history(plate, batch, b, e, &
                        & w, m, history)), mask=batch%layer(:, b) > 0)
                  end do
               end do
            end do
            call sums%add(1, energy)
         end do
      end associate
   end subroutine add_wedge_energy

end module plydyn_element_cracked_stored_energy
