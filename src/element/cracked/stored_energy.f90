!> Energy that the plies of a crack zone have stored.
module plydyn_element_cracked_stored_energy
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_cracked_cells, only : cells_type
   use plydyn_element_cracked_wedges, only : faces, find_gradients, wedge_points
   use plydyn_element_layer_scalars, only : point_history
   use plydyn_element_plate_layers, only : plate_type
   use plydyn_element_plate_stored_energy, only : point_energy
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
      integer :: b, e, p

      do e = elements(1), elements(2)
         energy = 0.0_wp
         do b = 1, plate%batches(1)%blocks
            call find_gradients(plate, cells, b, e, displacement, gradient)
            do p = 1, wedge_points
               energy = energy + wedge_energy(plate, b, e, p, large, gradient(:, :, :, p), history)
            end do
         end do
         call sums%add(1, energy)
      end do
   end subroutine add_wedge_energy

   !> Stored energy of a point in all lanes of a block
   pure real(wp) function wedge_energy(plate, block, quad, p, large, gradient, history) &
      & result(energy)
      type(plate_type), intent(in) :: plate
      !> Block of layers, quad and point
      integer, intent(in) :: block, quad, p
      logical, intent(in) :: large
      real(wp), intent(in) :: gradient(lanes, 3, 3)
      real(wp), intent(in), contiguous :: history(:)

      integer :: m, w

      w = 1 + (p - 1)/faces
      m = 1 + mod(p - 1, faces)
      associate (batch => plate%batches(1))
         energy = plate%metric(5, w, quad)*batch%expansion%weight(m) &
            & *sum(point_energy(batch, block, large, gradient, point_history(plate, batch, block, &
            & quad, w, m, history)), mask=batch%layer(:, block) > 0)
      end associate
   end function wedge_energy

end module plydyn_element_cracked_stored_energy
