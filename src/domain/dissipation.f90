!> Energy that has been dissipated, mechanism by mechanism, from the histories of all points.
module plydyn_domain_dissipation
   use plydyn_base_exact_sum, only : exact_sums_type, new_exact_sums
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_brick_energies, only : count_brick_dissipation
   use plydyn_domain_delamination, only : delamination_type, interface_losses
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_plate_layers, only : layer_batch_type
   use plydyn_law_law, only : by_delamination, by_friction, mechanisms
   implicit none
   private

   public :: dissipated_energies

contains

   !> Sums over all points of plies, bricks and interfaces of what each mechanism has dissipated.
   !> All ranks must come here, and get those of the whole model
   function dissipated_energies(domain, history, lost) result(energy)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points
      real(wp), intent(in) :: history(:)
      !> What the interfaces of the whole model have lost; none where none can fail
      type(delamination_type), intent(in) :: lost(:)
      !> In the order of `mechanism_names`
      real(wp) :: energy(mechanisms)

      type(exact_sums_type) :: sums
      integer :: b, i, p

      sums = new_exact_sums(mechanisms)
      call count_brick_dissipation(domain, history, sums)
      do p = 1, size(domain%plates)
         associate (plate => domain%plates(p))
            do b = 1, size(plate%batches)
               call count_batch(plate%batches(b), plate%metric, &
                  & history(plate%batches(b)%first_history:), sums)
            end do
         end associate
      end do
      call domain%comm%sum(sums%limb)
      energy(:) = [(sums%value(i), i=1, mechanisms)]
      energy(by_delamination:by_friction) = energy(by_delamination:by_friction) &
         & + interface_losses(lost)
   end function dissipated_energies

   !> The share of a batch of layers, quad by quad
   pure subroutine count_batch(batch, metric, history, sums)
      type(layer_batch_type), intent(in) :: batch
      !> Geometry of each quad, area of a Gauss point last
      real(wp), intent(in) :: metric(:, :, :)
      !> History of the batch, thickness before plane
      real(wp), intent(in) :: history(lanes, size(batch%expansion%weight), size(metric, 2), &
         & batch%blocks, size(metric, 3), batch%histories)
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
                        if (law%energy_at(i) == 0) cycle
                        energy(i) = energy(i) + metric(size(metric, 1), q, e)*weight(m) &
                           & *sum(batch%half_thickness(:, block)*law%spent(i, h), law%owns)
                     end do
                  end do
               end do
               do i = 1, mechanisms
                  if (law%energy_at(i) /= 0) call sums%add(i, energy(i))
               end do
            end do
         end associate
      end do
   end subroutine count_batch

end module plydyn_domain_dissipation
