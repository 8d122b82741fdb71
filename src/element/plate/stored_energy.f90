!> Energy that plates have stored: strains at all Gauss points, and what their laws give back.
!>
!> It is the check on the kernels of the forces. Displacement gradients are sums over the nodes of a
!> quad, as in textbooks. With the kernels it shares the geometry of the quads, the stiffness, the
!> tables of the expansion and the laws, so that an error in these does not show.
module plydyn_element_plate_stored_energy
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_layer_scalars, only : point_history
   use plydyn_element_plate_layers, only : c33, first_degree, layer_batch_type, plate_type
   use plydyn_element_recover, only : gauss_metric
   use plydyn_law_compression_barrier, only : barrier_energy, volume_ratios
   implicit none
   private

   public :: add_plate_energy, elastic_energy, law_energy

contains

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

      real(wp) :: gradient(lanes, 3, 3), strain(lanes, 6), stored(lanes)
      real(wp) :: value(lanes, size(batch%expansion%weight), 3, size(plate%node, 1))
      real(wp) :: above(lanes, size(batch%expansion%weight), 3, 3)
      integer :: m, q

      energy = 0.0_wp
      value(:, :, :, :) = values_at_levels(batch, block, plate%node(:, quad), displacement)
      do q = 1, size(value, 4)
         call differentiate_plane(plate, quad, q, value, above)
         do m = 1, size(value, 2)
            gradient(:, :, :) = gradient_at(batch, block, m, above)
            strain(:, :) = strain_of(gradient, large)
            if (size(batch%laws) > 0) then
               stored(:) = law_energy(batch, block, in_ply_axes(batch%rotation(:, :, block), &
                  & strain), point_history(plate, batch, block, quad, q, m, history))
            else
               stored(:) = elastic_energy(batch%stiffness(:, :, block), strain)
            end if
            if (large) stored(:) = stored + batch%stiffness(:, c33, block) &
               & *barrier_energy(volume_ratios(gradient))
            energy = energy + plate%metric(5, q, quad)*batch%expansion%weight(m)*sum(stored)
         end do
      end do
   end function block_energy

   !> Displacement at the Gauss points of the thickness above the nodes of a quad,
   !> (lanes, points of the thickness, directions, nodes)
   pure function values_at_levels(batch, block, node, displacement) result(value)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block
      !> Nodes of the quad
      integer, intent(in) :: node(:)
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp) :: value(lanes, size(batch%expansion%weight), 3, size(node))

      integer :: c, first, i, m, t

      value(:, :, :, :) = 0.0_wp
      do i = 1, size(node)
         do c = 1, 3
            do t = 1, size(value, 2)
               first = first_degree(batch, block, node(i), t, c)
               do m = 1, size(value, 2)
                  value(:, m, c, i) = value(:, m, c, i) + batch%expansion%to_gauss(m, t) &
                     & *displacement(first:first + lanes - 1)
               end do
            end do
         end do
      end do
   end function values_at_levels

   !> Derivatives along x and y, and values, above a Gauss point of the plane
   pure subroutine differentiate_plane(plate, quad, q, value, above)
      type(plate_type), intent(in) :: plate
      !> Quad, Gauss point of the plane
      integer, intent(in) :: quad, q
      !> From `values_at_levels`
      real(wp), intent(in), contiguous :: value(:, :, :, :)
      !> The last index is 1 and 2 for the derivatives, 3 for the values
      real(wp), intent(out), contiguous :: above(:, :, :, :)

      real(wp) :: metric(2, 2), slope(2, size(value, 4))
      integer :: i

      metric(:, :) = gauss_metric(plate, quad, q)
      slope(:, :) = matmul(metric, plate%slope(:, :, q))
      above(:, :, :, :) = 0.0_wp
      do i = 1, size(value, 4)
         above(:, :, :, 1) = above(:, :, :, 1) + slope(1, i)*value(:, :, :, i)
         above(:, :, :, 2) = above(:, :, :, 2) + slope(2, i)*value(:, :, :, i)
         above(:, :, :, 3) = above(:, :, :, 3) + plate%shape(q, i)*value(:, :, :, i)
      end do
   end subroutine differentiate_plane

   !> Displacement gradient at a Gauss point, (lanes, components, directions)
   pure function gradient_at(batch, block, m, above) result(gradient)
      type(layer_batch_type), intent(in) :: batch
      !> Block of layers, and Gauss point of the thickness
      integer, intent(in) :: block, m
      !> From `differentiate_plane`
      real(wp), intent(in), contiguous :: above(:, :, :, :)
      real(wp) :: gradient(lanes, 3, 3)

      integer :: c, t

      do c = 1, 3
         gradient(:, c, 1) = above(:, m, c, 1)
         gradient(:, c, 2) = above(:, m, c, 2)
         gradient(:, c, 3) = 0.0_wp
         do t = 1, size(above, 2)
            gradient(:, c, 3) = gradient(:, c, 3) + batch%expansion%gauss_slope(m, t) &
               & *above(:, t, c, 3)
         end do
         gradient(:, c, 3) = gradient(:, c, 3)*batch%two_over_h(:, block)
      end do
   end function gradient_at

   !> Strain of a displacement gradient, linear or of Green and Lagrange
   pure function strain_of(gradient, large) result(strain)
      real(wp), intent(in) :: gradient(lanes, 3, 3)
      logical, intent(in) :: large
      real(wp) :: strain(lanes, 6)

      integer :: c

      associate (h => gradient, e => strain)
         e(:, 1) = h(:, 1, 1)
         e(:, 2) = h(:, 2, 2)
         e(:, 3) = h(:, 3, 3)
         e(:, 4) = h(:, 1, 2) + h(:, 2, 1)
         e(:, 5) = h(:, 1, 3) + h(:, 3, 1)
         e(:, 6) = h(:, 2, 3) + h(:, 3, 2)
         if (.not. large) return
         do c = 1, 3
            e(:, :3) = e(:, :3) + 0.5_wp*h(:, c, :)**2
            e(:, 4) = e(:, 4) + h(:, c, 1)*h(:, c, 2)
            e(:, 5) = e(:, 5) + h(:, c, 1)*h(:, c, 3)
            e(:, 6) = e(:, 6) + h(:, c, 2)*h(:, c, 3)
         end do
      end associate
   end function strain_of

   !> Strain along and across the fibres of each layer
   pure function in_ply_axes(rotation, strain) result(ply)
      !> Cosine and sine of the fibre direction
      real(wp), intent(in) :: rotation(lanes, 2)
      real(wp), intent(in) :: strain(lanes, 6)
      real(wp) :: ply(lanes, 6)

      associate (c => rotation(:, 1), s => rotation(:, 2), e => strain)
         ply(:, 1) = c*c*e(:, 1) + s*s*e(:, 2) + c*s*e(:, 4)
         ply(:, 2) = s*s*e(:, 1) + c*c*e(:, 2) - c*s*e(:, 4)
         ply(:, 3) = e(:, 3)
         ply(:, 4) = 2.0_wp*c*s*(e(:, 2) - e(:, 1)) + (c*c - s*s)*e(:, 4)
         ply(:, 5) = c*e(:, 5) + s*e(:, 6)
         ply(:, 6) = c*e(:, 6) - s*e(:, 5)
      end associate
   end function in_ply_axes

   !> Energy per area that the laws of a block store at a point, for a weight of 1
   pure function law_energy(batch, block, strain, history) result(energy)
      !> The layers, and the block of them
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block
      !> In ply axes
      real(wp), intent(in) :: strain(lanes, 6)
      !> History of the point
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

end module plydyn_element_plate_stored_energy
