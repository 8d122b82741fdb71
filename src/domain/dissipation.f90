!> Energy that has been dissipated, mechanism by mechanism, from the histories of all points.
module plydyn_domain_dissipation
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_brick_energies, only : brick_dissipation
   use plydyn_domain_delamination, only : interface_losses
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_plate, only : layer_batch_type
   use plydyn_law_law, only : by_delamination, by_friction, mechanisms
   implicit none
   private

   public :: dissipated_energies

contains

   !> Sums over all points of plies and of interfaces of what each mechanism has dissipated there
   pure function dissipated_energies(domain, history) result(energy)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points
      real(wp), intent(in) :: history(:)
      !> In the order of `mechanism_names`
      real(wp) :: energy(mechanisms)

      integer :: b, last, p

      energy(:) = 0.0_wp
      energy(by_delamination:by_friction) = interface_losses(domain, history)
      if (size(domain%bricks) > 0) energy(:) = energy + brick_dissipation(domain, history)
      do p = 1, size(domain%plates)
         associate (plate => domain%plates(p))
            do b = 1, size(plate%batches)
               associate (batch => plate%batches(b))
                  last = batch%first_history - 1 + lanes*batch%histories*batch%blocks &
                     & *size(batch%expansion%weight)*size(plate%node)
                  energy(:) = energy + batch_dissipation(batch, plate%metric, &
                     & history(batch%first_history:last))
               end associate
            end do
         end associate
      end do
   end function dissipated_energies

   !> The share of a batch of layers
   pure function batch_dissipation(batch, metric, history) result(energy)
      type(layer_batch_type), intent(in) :: batch
      !> Geometry of each quad, area of a Gauss point last
      real(wp), intent(in) :: metric(:, :, :)
      !> History of the batch, thickness before plane
      real(wp), intent(in) :: history(lanes, batch%histories, size(batch%expansion%weight), &
         & size(metric, 2), batch%blocks, size(metric, 3))
      real(wp) :: energy(mechanisms)

      integer :: e, i, k, m, q

      energy(:) = 0.0_wp
      do k = 1, size(batch%laws)
         associate (block => batch%laws(k)%block, law => batch%laws(k)%law, &
            & weight => batch%expansion%weight)
            do i = 1, mechanisms
               if (law%energy_at(i) == 0) cycle
               do e = 1, size(metric, 3)
                  do q = 1, size(metric, 2)
                     do m = 1, size(weight)
                        energy(i) = energy(i) + metric(size(metric, 1), q, e)*weight(m) &
                           & *sum(batch%half(:, block) &
                           & *history(:, law%energy_at(i), m, q, block, e), law%owns)
                     end do
                  end do
               end do
            end do
         end associate
      end do
   end function batch_dissipation

end module plydyn_domain_dissipation
