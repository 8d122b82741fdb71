!> Energies of bricks: what their laws have dissipated, and what hourglass control has.
module plydyn_domain_brick_energies
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_brick_kernel, only : hourglass_energy
   use plydyn_law_law, only : mechanisms
   use plydyn_model_control, only : total_lagrangian
   implicit none
   private

   public :: brick_dissipation, held_energy

contains

   !> Dissipated energies in the order of `mechanism_names`
   pure function brick_dissipation(domain, history) result(energy)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points
      real(wp), intent(in) :: history(:)
      real(wp) :: energy(mechanisms)

      integer :: b, i, last, m, p

      energy(:) = 0.0_wp
      do p = 1, size(domain%bricks)
         associate (bricks => domain%bricks(p))
            if (size(bricks%laws) == 0) cycle
            associate (law => bricks%laws(1)%law)
               do i = 1, mechanisms
                  if (law%energy_at(i) == 0) cycle
                  do b = 1, size(bricks%shape)
                     do m = 1, bricks%points
                        last = bricks%first_history - 1 + lanes*(law%energy_at(i) &
                           & + bricks%histories*(m - 1 + bricks%points*(b - 1)))
                        energy(i) = energy(i) + dot_product( &
                           & bricks%shapes(bricks%shape(b))%volume(:, m), &
                           & history(last - lanes + 1:last))
                     end do
                  end do
               end do
            end associate
         end associate
      end do
   end function brick_dissipation

   !> Energy that hourglass control has stored or taken
   pure real(wp) function held_energy(domain, displacement, history) result(energy)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in) :: displacement(:), history(:)

      integer :: last, p

      energy = 0.0_wp
      do p = 1, size(domain%bricks)
         associate (bricks => domain%bricks(p))
            last = bricks%first_history - 1 &
               & + lanes*bricks%histories*bricks%points*size(bricks%shape)
            energy = energy + hourglass_energy(bricks, &
               & domain%control%kinematics == total_lagrangian, displacement, &
               & history(bricks%first_history:last))
         end associate
      end do
   end function held_energy

end module plydyn_domain_brick_energies
