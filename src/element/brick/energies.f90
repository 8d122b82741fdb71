!> Energies of bricks: what their laws have dissipated, and what hourglass control has.
module plydyn_element_brick_energies
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_brick_bricks, only : bricks_type
   use plydyn_element_brick_kernel, only : hourglass_energy
   use plydyn_law_law, only : mechanisms
   implicit none
   private

   public :: add_brick_dissipation, add_control_energy

contains

   !> Add what the law of bricks has dissipated, batch by batch
   pure subroutine add_brick_dissipation(bricks, history, sums)
      !> The bricks of a part
      type(bricks_type), intent(in) :: bricks
      !> History of all Gauss points
      real(wp), intent(in) :: history(:)
      !> Sums in the order of `mechanism_names`
      type(exact_sums_type), intent(inout) :: sums

      integer :: b, first, i, m

      if (size(bricks%laws) == 0) return
      associate (law => bricks%laws(1)%law)
         do i = 1, mechanisms
            if (law%energy_variable(i) == 0) cycle
            do b = 1, size(bricks%shape)
               do m = 1, bricks%points
                  first = bricks%first_history + lanes*bricks%histories &
                     & *(m - 1 + bricks%points*(b - 1))
                  call sums%add(i, dot_product(bricks%shapes(bricks%shape(b))%volume(:, m), &
                     & law%dissipated_energy(i, history(first:first + lanes*bricks%histories - 1))))
               end do
            end do
         end do
      end associate
   end subroutine add_brick_dissipation

   !> Add the energy that hourglass control has stored or taken
   pure subroutine add_control_energy(bricks, large, displacement, history, sums)
      !> The bricks of a part
      type(bricks_type), intent(in) :: bricks
      !> Large displacement
      logical, intent(in) :: large
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in) :: displacement(:), history(:)
      !> One sum
      type(exact_sums_type), intent(inout) :: sums
      integer :: b

      if (bricks%points > 1) return
      do b = 1, size(bricks%shape)
         call sums%add(1, hourglass_energy(bricks, b, large, displacement, &
            & history(bricks%first_history:)))
      end do
   end subroutine add_control_energy

end module plydyn_element_brick_energies
