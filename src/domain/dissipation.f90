!> Energy that plies have dissipated, from the histories of their points.
module plydyn_domain_dissipation
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_plate, only : layer_batch_type
   implicit none
   private

   public :: dissipated_energy

contains

   !> Sum over all Gauss points of volume times the last history variable of their law
   pure real(wp) function dissipated_energy(domain, history) result(energy)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points
      real(wp), intent(in) :: history(:)

      integer :: b, last, p

      energy = 0.0_wp
      do p = 1, size(domain%plates)
         associate (plate => domain%plates(p))
            do b = 1, size(plate%batches)
               associate (batch => plate%batches(b))
                  last = batch%first_history - 1 + lanes*batch%histories*batch%blocks &
                     & *size(batch%expansion%weight)*size(plate%node)
                  energy = energy + batch_dissipation(batch, plate%metric, &
                     & history(batch%first_history:last))
               end associate
            end do
         end associate
      end do
   end function dissipated_energy

   !> The share of a batch of layers
   pure real(wp) function batch_dissipation(batch, metric, history) result(energy)
      type(layer_batch_type), intent(in) :: batch
      !> Geometry of each quad, area of a Gauss point last
      real(wp), intent(in) :: metric(:, :, :)
      !> History of the batch, thickness before plane
      real(wp), intent(in) :: history(lanes, batch%histories, size(batch%expansion%weight), &
         & size(metric, 2), batch%blocks, size(metric, 3))

      integer :: e, k, m, q

      energy = 0.0_wp
      do k = 1, size(batch%laws)
         associate (block => batch%laws(k)%block, law => batch%laws(k)%law, &
            & weight => batch%expansion%weight)
            if (law%histories == 0) cycle
            do e = 1, size(metric, 3)
               do q = 1, size(metric, 2)
                  do m = 1, size(weight)
                     energy = energy + metric(size(metric, 1), q, e)*weight(m)*sum( &
                        & batch%half(:, block)*history(:, law%histories, m, q, block, e), law%owns)
                  end do
               end do
            end do
         end associate
      end do
   end function batch_dissipation

end module plydyn_domain_dissipation
