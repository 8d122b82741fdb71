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
   use plydyn_law_compression_barrier, only : barrier_energy, barrier_ratio, volume_ratio
   implicit none
   private

   public :: add_plate_energy

contains

   !> Add the stored energy of all layers, quad by quad
   pure subroutine add_plate_energy(plate, large, displacement, history, sums)
      !> The plate
      type(plate_type), intent(in) :: plate
      !> Large displacement
      logical, intent(in) :: large
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in) :: displacement(:), history(:)
      !> Sums, the first of which gets the energies
      type(exact_sums_type), intent(inout) :: sums

      real(wp) :: energy
      integer :: b, block, e

      do e = 1, size(plate%node, 2)
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
      real(wp), intent(in) :: displacement(:), history(:)
      real(wp) :: energy

      real(wp) :: gradient(lanes, 3, 3), strain(lanes, 6), stored(lanes)
      real(wp) :: value(lanes, size(plate%node, 1), size(batch%expansion%weight), 3)
      integer :: m, q

      energy = 0.0_wp
      value(:, :, :, :) = values_at_levels(batch, block, plate%node(:, quad), displacement)
      do q = 1, size(value, 2)
         do m = 1, size(value, 3)
            gradient(:, :, :) = displacement_gradient(plate, batch, block, quad, q, m, value)
            strain(:, :) = strain_of(gradient, large)
            if (size(batch%laws) > 0) then
               stored(:) = law_energy(batch, block, in_ply_axes(batch%rotation(:, :, block), &
                  & strain), point_history(plate, batch, block, quad, q, m, history))
            else
               stored(:) = elastic_energy(batch%stiffness(:, :, block), strain)
            end if
            if (large) call add_barrier_energy(batch%stiffness(:, c33, block), gradient, stored)
            energy = energy + plate%metric(5, q, quad)*batch%expansion%weight(m)*sum(stored)
         end do
      end do
   end function block_energy

   !> Displacement at the Gauss points of the thickness above the nodes of a quad,
   !> (lanes, nodes, points of the thickness, directions)
   pure function values_at_levels(batch, block, node, displacement) result(value)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block
      !> Nodes of the quad
      integer, intent(in) :: node(:)
      real(wp), intent(in) :: displacement(:)
      real(wp) :: value(lanes, size(node), size(batch%expansion%weight), 3)

      integer :: c, first, i, m, t

      value(:, :, :, :) = 0.0_wp
      do c = 1, 3
         do t = 1, size(value, 3)
            do i = 1, size(node)
               first = first_degree(batch, block, node(i), t, c)
               do m = 1, size(value, 3)
                  value(:, i, m, c) = value(:, i, m, c) + batch%expansion%to_gauss(m, t) &
                     & *displacement(first:first + lanes - 1)
               end do
            end do
         end do
      end do
   end function values_at_levels

   !> Displacement gradient at a Gauss point, (lanes, components, directions)
   pure function displacement_gradient(plate, batch, block, quad, q, m, value) result(gradient)
      type(plate_type), intent(in) :: plate
      type(layer_batch_type), intent(in) :: batch
      !> Block of layers, quad, Gauss point of the plane and of the thickness
      integer, intent(in) :: block, quad, q, m
      !> From `values_at_levels`
      real(wp), intent(in) :: value(:, :, :, :)
      real(wp) :: gradient(lanes, 3, 3)

      real(wp) :: rise(lanes), slope(2, size(value, 2))
      integer :: c, i, t

      slope(:, :) = matmul(gauss_metric(plate, quad, q), plate%slope(:, :, q))
      gradient(:, :, :) = 0.0_wp
      do c = 1, 3
         do i = 1, size(value, 2)
            gradient(:, c, 1) = gradient(:, c, 1) + slope(1, i)*value(:, i, m, c)
            gradient(:, c, 2) = gradient(:, c, 2) + slope(2, i)*value(:, i, m, c)
            rise(:) = 0.0_wp
            do t = 1, size(value, 3)
               rise(:) = rise + batch%expansion%gauss_slope(m, t)*value(:, i, t, c)
            end do
            gradient(:, c, 3) = gradient(:, c, 3) + plate%shape(q, i)*rise
         end do
         gradient(:, c, 3) = gradient(:, c, 3)*batch%two_over_h(:, block)
      end do
   end function displacement_gradient

   !> Strain of a displacement gradient, linear or of Green and Lagrange
   pure function strain_of(gradient, large) result(strain)
      real(wp), intent(in) :: gradient(lanes, 3, 3)
      logical, intent(in) :: large
      real(wp) :: strain(lanes, 6)

      integer, parameter :: first(6) = [1, 2, 3, 1, 1, 2], second(6) = [1, 2, 3, 2, 3, 3]
      integer :: k

      do k = 1, 6
         strain(:, k) = gradient(:, first(k), second(k)) + gradient(:, second(k), first(k))
         if (large) strain(:, k) = strain(:, k) &
            & + sum(gradient(:, :, first(k))*gradient(:, :, second(k)), 2)
      end do
      strain(:, :3) = 0.5_wp*strain(:, :3)
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
         where (batch%laws(k)%law%owns) energy = batch%half_thickness(:, block) &
            & *batch%laws(k)%law%stored_energy(strain, history)
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

   !> Add the energy of the barrier against compression
   pure subroutine add_barrier_energy(modulus, gradient, energy)
      !> Stiffness C33 times half the thickness
      real(wp), intent(in) :: modulus(lanes)
      real(wp), intent(in) :: gradient(lanes, 3, 3)
      real(wp), intent(inout) :: energy(lanes)

      real(wp) :: ratio
      integer :: l

      do l = 1, lanes
         ratio = volume_ratio(gradient(l, :, :))
         if (ratio < barrier_ratio) energy(l) = energy(l) + modulus(l)*barrier_energy(ratio)
      end do
   end subroutine add_barrier_energy

end module plydyn_element_plate_stored_energy
