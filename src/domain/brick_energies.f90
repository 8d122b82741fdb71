!> Energies of bricks: what their laws have dissipated, and what hourglass control has.
module plydyn_domain_brick_energies
   use plydyn_base_exact_sum, only : exact_sums_type, new_exact_sums
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_brick_kernel, only : hourglass_energy
   use plydyn_law_law, only : mechanisms
   use plydyn_model_control, only : total_lagrangian
   implicit none
   private

   public :: count_brick_dissipation, held_energy

contains

   !> Add what the laws of bricks have dissipated, batch by batch
   pure subroutine count_brick_dissipation(domain, history, sums)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points
      real(wp), intent(in) :: history(:)
      !> Sums in the order of `mechanism_names`
      type(exact_sums_type), intent(inout) :: sums

      integer :: b, first, i, m, p

      do p = 1, size(domain%bricks)
         associate (bricks => domain%bricks(p))
            if (size(bricks%laws) == 0) cycle
            associate (law => bricks%laws(1)%law)
               do i = 1, mechanisms
                  if (law%energy_at(i) == 0) cycle
                  do b = 1, size(bricks%shape)
                     do m = 1, bricks%points
                        first = bricks%first_history + lanes*bricks%histories &
                           & *(m - 1 + bricks%points*(b - 1))
                        call sums%add(i, dot_product( &
                           & bricks%shapes(bricks%shape(b))%volume(:, m), &
                           & law%spent(i, history(first:first + lanes*bricks%histories - 1))))
                     end do
                  end do
               end do
            end associate
         end associate
      end do
   end subroutine count_brick_dissipation

   !> Energy that hourglass control has stored or taken. All ranks must come here
   real(wp) function held_energy(domain, displacement, history) result(energy)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in) :: displacement(:), history(:)

      type(exact_sums_type) :: sums
      integer :: b, p

      sums = new_exact_sums(1)
      do p = 1, size(domain%bricks)
         associate (bricks => domain%bricks(p))
            if (bricks%points > 1) cycle
            do b = 1, size(bricks%shape)
               call sums%add(1, hourglass_energy(bricks, b, &
                  & domain%control%kinematics == total_lagrangian, displacement, &
                  & history(bricks%first_history:)))
            end do
         end associate
      end do
      call domain%comm%sum(sums%limb)
      energy = sums%value(1)
   end function held_energy

end module plydyn_domain_brick_energies
