!> Strain and stress of a layer at its Gauss points.
module plydyn_element_recover
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_layer_scalars, only : layer_scalars, point_history
   use plydyn_element_plate_layers, only : first_degree, layer_batch_type, plate_type
   use plydyn_element_recovered, only : ply_strain_at, ply_stress_at, recovered, scalars_at, &
      & strain_at, stress_at
   use plydyn_law_ply_elastic, only : strain_rotation
   use plydyn_law_compression_barrier, only : barrier_stress, volume_ratio
   implicit none
   private

   public :: gauss_metric, layer_values, point_values

contains

   !> Strain, stress and the scalars of the law of one layer of one quad at its Gauss points.
   !> With large displacement the strain is Green-Lagrange; stress is Cauchy in the axes of the
   !> plate and second Piola-Kirchhoff in those of the ply, which turn with the material.
   pure function layer_values(plate, b, block, lane, quad, large, displacement, history) &
      & result(values)
      !> The plate
      type(plate_type), intent(in) :: plate
      !> Batch of layers, block and lane in it
      integer, intent(in) :: b, block, lane
      !> Quad of the plate
      integer, intent(in) :: quad
      !> Large displacement
      logical, intent(in) :: large
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      !> (recovered, points of the plane, points of the thickness)
      real(wp) :: values(recovered, size(plate%node, 1), plate%batches(b)%expansion%order + 1)

      real(wp) :: h(3, 3, size(plate%node, 1), plate%batches(b)%expansion%order + 1)
      integer :: m, q

      h(:, :, :, :) = gradients(plate, plate%batches(b), block, lane, quad, displacement)
      values(scalars_at + 1:, :, :) = layer_scalars(plate, b, block, lane, quad, history)
      do m = 1, size(h, 4)
         do q = 1, size(h, 3)
            values(:scalars_at, q, m) = point_values(plate, [b, block, lane], [quad, q, m], large, &
               & h(:, :, q, m), history)
         end do
      end do
   end function layer_values

   !> Strain and stress of one layer at one Gauss point, from the displacement gradient there
   pure function point_values(plate, slot, place, large, h, history) result(values)
      !> The plate
      type(plate_type), intent(in) :: plate
      !> Batch, block and lane of the layer; quad, point of the plane and of the thickness
      integer, intent(in) :: slot(3), place(3)
      !> As in `layer_values`
      logical, intent(in) :: large
      !> Displacement gradient
      real(wp), intent(in) :: h(3, 3)
      real(wp), intent(in), contiguous :: history(:)
      real(wp) :: values(scalars_at)

      real(wp) :: angle, rotation(6, 6), stiffness(6, 6), strain(6), stress(6)

      associate (batch => plate%batches(slot(1)), block => slot(2), lane => slot(3))
         angle = plate%angle(batch%layer(lane, block))
         rotation(:, :) = strain_rotation(angle)
         stiffness(:, :) = full_stiffness(batch, block, lane)
         strain(:) = strain_of(h, large)
         values(strain_at + 1:stress_at) = strain
         values(ply_strain_at + 1:ply_stress_at) = matmul(rotation, strain)
         if (size(batch%laws) > 0) then
            stress(:) = matmul(transpose(rotation), law_stress(batch, block, lane, &
               & matmul(rotation, strain), point_history(plate, batch, block, place(1), place(2), &
               & place(3), history)))
         else
            stress(:) = matmul(stiffness, strain)
         end if
         ! stress turns back with the transposed rotation of strain, and forth by the opposite angle
         values(ply_stress_at + 1:scalars_at) = matmul(transpose(strain_rotation(-angle)), stress)
         if (large) stress(:) = cauchy(stiffness(3, 3), h, stress)
         values(stress_at + 1:ply_strain_at) = stress
      end associate
   end function point_values

   !> Stress of a law in ply axes
   pure function law_stress(batch, block, lane, strain, history) result(stress)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block, lane
      real(wp), intent(in) :: strain(6), history(:, :)
      real(wp) :: stress(6)

      real(wp) :: all_strain(lanes, 6), all_stress(lanes, 6)
      integer :: k

      all_strain(:, :) = spread(strain, 1, lanes)
      all_stress(:, :) = 0.0_wp
      do k = 1, size(batch%laws)
         if (batch%laws(k)%block /= block) cycle
         call batch%laws(k)%law%stress_at(all_strain, history, all_stress)
      end do
      stress(:) = all_stress(lane, :)
   end function law_stress

   !> Displacement gradients at the Gauss points, (3, 3, plane, thickness)
   pure function gradients(plate, batch, block, lane, quad, displacement) result(h)
      type(plate_type), intent(in) :: plate
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block, lane, quad
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp) :: h(3, 3, size(plate%node, 1), batch%expansion%order + 1)

      real(wp) :: local(2, 2), point(size(plate%node, 1), size(h, 4))
      real(wp) :: rise(size(point, 1), size(point, 2))
      integer :: c, m, q

      do c = 1, 3
         point(:, :) = matmul(column_values(batch, block, lane, c, plate%node(:, quad), &
            & displacement), transpose(batch%expansion%to_gauss))
         rise(:, :) = matmul(point, transpose(batch%expansion%gauss_slope)) &
            & *batch%two_over_h(lane, block)
         do q = 1, size(point, 1)
            local(:, :) = gauss_metric(plate, quad, q)
            do m = 1, size(h, 4)
               h(c, 1:2, q, m) = matmul(local, matmul(plate%slope(:, :, q), point(:, m)))
               h(c, 3, q, m) = dot_product(plate%shape(q, :), rise(:, m))
            end do
         end do
      end do
   end function gradients

   !> d(xi, eta)/d(x, y) at a Gauss point, (x or y, xi or eta)
   pure function gauss_metric(plate, quad, q) result(metric)
      !> The plate
      type(plate_type), intent(in) :: plate
      !> Quad of the plate, and Gauss point of the plane
      integer, intent(in) :: quad, q
      real(wp) :: metric(2, 2)

      metric(:, 1) = 2.0_wp*plate%gauss_abscissa*plate%metric(1:2, q, quad)
      metric(:, 2) = 2.0_wp*plate%gauss_abscissa*plate%metric(3:4, q, quad)
   end function gauss_metric

   !> One direction of the displacement of a layer at the nodes of a quad, (nodes, levels)
   pure function column_values(batch, block, lane, direction, node, displacement) result(u)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block, lane, direction, node(:)
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp) :: u(size(node), batch%expansion%order + 1)

      integer :: t

      do t = 1, size(u, 2)
         u(:, t) = displacement(first_degree(batch, block, node, t, direction) + lane - 1)
      end do
   end function column_values

   !> Stiffness matrix of one lane
   pure function full_stiffness(batch, block, lane) result(c)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block, lane
      real(wp) :: c(6, 6)

      associate (k => batch%stiffness(lane, :, block))
         c(:, :) = 0.0_wp
         c(1, 1:4) = k(1:4)
         c(2, 1:4) = [k(2), k(5:7)]
         c(3, 1:4) = [k(3), k(6), k(8:9)]
         c(4, 1:4) = [k(4), k(7), k(9:10)]
         c(5, 5:6) = k(11:12)
         c(6, 5:6) = k(12:13)
      end associate
      c(:, :) = c*batch%two_over_h(lane, block)
   end function full_stiffness

   !> Strain of a displacement gradient
   pure function strain_of(h, large) result(strain)
      real(wp), intent(in) :: h(3, 3)
      logical, intent(in) :: large
      real(wp) :: strain(6)

      real(wp) :: e(3, 3)

      e(:, :) = h + transpose(h)
      if (large) e(:, :) = e + matmul(transpose(h), h)
      strain(:) = [0.5_wp*e(1, 1), 0.5_wp*e(2, 2), 0.5_wp*e(3, 3), e(1, 2), e(1, 3), e(2, 3)]
   end function strain_of

   !> Cauchy stress, F S F^T / det F, with that of the barrier against compression
   pure function cauchy(modulus, h, second) result(stress)
      real(wp), intent(in) :: modulus, h(3, 3), second(6)
      real(wp) :: stress(6)

      real(wp) :: f(3, 3), s(3, 3), ratio
      integer :: i

      f(:, :) = h
      do i = 1, 3
         f(i, i) = f(i, i) + 1.0_wp
      end do
      ratio = volume_ratio(h)
      s(:, :) = reshape(second([1, 4, 5, 4, 2, 6, 5, 6, 3]), [3, 3])
      s(:, :) = matmul(f, matmul(s, transpose(f)))/ratio
      stress(:) = [s(1, 1), s(2, 2), s(3, 3), s(1, 2), s(1, 3), s(2, 3)]
      stress(:3) = stress(:3) + barrier_stress(modulus, ratio)
   end function cauchy

end module plydyn_element_recover
