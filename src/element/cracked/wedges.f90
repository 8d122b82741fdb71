!> Wedges between the two faces of a layer: displacement gradients at their points, and the forces
!> of stresses there. The second step is the transposed of the first.
!>
!> A wedge has constant slopes in the plane at every height; its points are the Gauss points of the
!> thickness. Points are numbered wedge by wedge, in each from the bottom up.
module plydyn_element_cracked_wedges
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_cracked_cells, only : cells_type, corners, wedges
   use plydyn_element_plate_layers, only : layer_batch_type, plate_type
   implicit none
   private

   public :: add_point_forces, find_gradients

   !> Faces of a layer, and points of a quad
   integer, parameter, public :: faces = 2, wedge_points = 4
   !> Corners that a wedge has in any case, in the order of both edges
   integer, parameter :: own(2, wedges) = reshape([1, 2, 3, 4], [2, wedges])
   !> Share of a corner in the mean of a wedge
   real(wp), parameter :: third = 1.0_wp/3.0_wp

contains

   !> Displacement gradients at the points of a block of layers over a quad
   pure subroutine find_gradients(plate, cells, block, quad, displacement, gradient)
      !> The plate and its division
      type(plate_type), intent(in) :: plate
      type(cells_type), intent(in) :: cells
      !> Block of layers, and quad
      integer, intent(in) :: block, quad
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> Component and direction in the axes of the plate
      real(wp), intent(out) :: gradient(lanes, 3, 3, wedge_points)

      real(wp) :: first(lanes), value(lanes, 3, faces, corners, wedges)
      real(wp) :: slope(lanes, 3, 2, faces), rise(lanes, 3)
      integer :: w

      call gather(plate%batches(1), cells, block, quad, plate%node(:, quad), displacement, value)
      first(:) = cells%first(:, block, cells%parity(quad))
      do w = 1, wedges
         call differentiate(w, first, value(:, :, :, :, w), slope, rise)
         call put_gradients(plate%batches(1), block, plate%metric(:, w, quad), slope, rise, &
            & gradient(:, :, :, faces*(w - 1) + 1:faces*w))
      end do
   end subroutine find_gradients

   !> Subtract the forces of first Piola-Kirchhoff stresses times volume at the points
   pure subroutine add_point_forces(plate, cells, block, quad, stress, force)
      !> As in `find_gradients`
      type(plate_type), intent(in) :: plate
      type(cells_type), intent(in) :: cells
      integer, intent(in) :: block, quad
      !> Component and direction
      real(wp), intent(in) :: stress(lanes, 3, 3, wedge_points)
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)

      real(wp) :: first(lanes), value(lanes, 3, faces, corners, wedges)
      real(wp) :: slope(lanes, 3, 2, faces), rise(lanes, 3)
      integer :: w

      first(:) = cells%first(:, block, cells%parity(quad))
      do w = 1, wedges
         call take_fluxes(plate%batches(1), block, plate%metric(:, w, quad), &
            & stress(:, :, :, faces*(w - 1) + 1:faces*w), slope, rise)
         call integrate(w, first, slope, rise, value(:, :, :, :, w))
      end do
      call scatter(plate%batches(1), cells, block, quad, plate%target(:, quad), value, force)
   end subroutine add_point_forces

   !> Displacements of the corners as each wedge has them
   pure subroutine gather(batch, cells, block, quad, node, displacement, value)
      type(layer_batch_type), intent(in) :: batch
      type(cells_type), intent(in) :: cells
      integer, intent(in) :: block, quad, node(corners)
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp), intent(out) :: value(lanes, 3, faces, corners, wedges)

      real(wp) :: other, own
      integer :: c, d, l, own_at, t, twin_at

      do c = 1, corners
         do t = 1, faces
            do d = 1, 3
               own_at = place(batch, block, node(c), t, d)
               if (cells%is_doubled(quad)) then
                  twin_at = place(batch, block, cells%twin(c, quad), t, d)
                  !$omp simd private(other, own)
                  do l = 1, lanes
                     own = displacement(own_at + l)
                     other = displacement(twin_at + l)
                     value(l, d, t, c, 1) = merge(other, own, &
                        & cells%sees(l, c, 1, block, quad) > 0.0_wp)
                     value(l, d, t, c, 2) = merge(other, own, &
                        & cells%sees(l, c, 2, block, quad) > 0.0_wp)
                  end do
               else
                  !$omp simd
                  do l = 1, lanes
                     value(l, d, t, c, 1) = displacement(own_at + l)
                     value(l, d, t, c, 2) = displacement(own_at + l)
                  end do
               end if
            end do
         end do
      end do
   end subroutine gather

   !> Transposed of `gather`, subtracted
   pure subroutine scatter(batch, cells, block, quad, target, value, force)
      type(layer_batch_type), intent(in) :: batch
      type(cells_type), intent(in) :: cells
      integer, intent(in) :: block, quad, target(corners)
      real(wp), intent(in) :: value(lanes, 3, faces, corners, wedges)
      real(wp), intent(inout), contiguous :: force(:)

      real(wp) :: on_twin(lanes), one, two
      integer :: c, d, l, own_at, t, twin_at

      do c = 1, corners
         do t = 1, faces
            do d = 1, 3
               own_at = place(batch, block, target(c), t, d)
               if (cells%is_doubled(quad)) then
                  twin_at = place(batch, block, cells%twin_target(c, quad), t, d)
                  !$omp simd private(one, two)
                  do l = 1, lanes
                     one = cells%sees(l, c, 1, block, quad)*value(l, d, t, c, 1)
                     two = cells%sees(l, c, 2, block, quad)*value(l, d, t, c, 2)
                     on_twin(l) = one + two
                     force(own_at + l) = force(own_at + l) - ((value(l, d, t, c, 1) - one) &
                        & + (value(l, d, t, c, 2) - two))
                  end do
                  !$omp simd
                  do l = 1, lanes
                     force(twin_at + l) = force(twin_at + l) - on_twin(l)
                  end do
               else
                  !$omp simd
                  do l = 1, lanes
                     force(own_at + l) = force(own_at + l) &
                        & - (value(l, d, t, c, 1) + value(l, d, t, c, 2))
                  end do
               end if
            end do
         end do
      end do
   end subroutine scatter

   !> Place before that of the first lane of a block at a face of a column: `first_degree` inlined
   elemental integer function place(batch, block, column, face, direction)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block, column, face, direction

      place = batch%first - 1 + batch%height*(column - 1) + lanes*(block - 1 &
         & + batch%blocks*(face - 1 + faces*(direction - 1)))
   end function place

   !> Differences along both edges on each face, and from the bottom to the top, of a wedge
   pure subroutine differentiate(wedge, first, value, slope, rise)
      integer, intent(in) :: wedge
      !> 1 where the diagonal from the first corner divides the quad
      real(wp), intent(in) :: first(lanes)
      real(wp), intent(in) :: value(lanes, 3, faces, corners)
      real(wp), intent(out) :: slope(lanes, 3, 2, faces), rise(lanes, 3)

      real(wp) :: on_far_a, on_far_b, sign
      integer :: d, l, t

      sign = merge(1.0_wp, -1.0_wp, wedge == 1)
      associate (a => own(1, wedge), b => own(2, wedge), far_a => own(1, wedges + 1 - wedge), &
         & far_b => own(2, wedges + 1 - wedge), on_b => across_b(wedge, first))
         do d = 1, 3
            do t = 1, faces
               !$omp simd private(on_far_a, on_far_b)
               do l = 1, lanes
                  slope(l, d, 1, t) = value(l, d, t, b) - value(l, d, t, a)
                  ! both are read in all lanes: loads behind a condition are not made into vectors
                  on_far_a = value(l, d, t, far_a) - value(l, d, t, a)
                  on_far_b = value(l, d, t, far_b) - value(l, d, t, b)
                  slope(l, d, 2, t) = sign*merge(on_far_b, on_far_a, on_b(l) > 0.0_wp)
               end do
            end do
            !$omp simd private(on_far_a, on_far_b)
            do l = 1, lanes
               on_far_a = value(l, d, 2, far_a) - value(l, d, 1, far_a)
               on_far_b = value(l, d, 2, far_b) - value(l, d, 1, far_b)
               rise(l, d) = third*((value(l, d, 2, a) - value(l, d, 1, a)) &
                  & + (value(l, d, 2, b) - value(l, d, 1, b)) &
                  & + merge(on_far_b, on_far_a, on_b(l) > 0.0_wp))
            end do
         end do
      end associate
   end subroutine differentiate

   !> Transposed of `differentiate`
   pure subroutine integrate(wedge, first, slope, rise, value)
      integer, intent(in) :: wedge
      real(wp), intent(in) :: first(lanes), slope(lanes, 3, 2, faces), rise(lanes, 3)
      real(wp), intent(out) :: value(lanes, 3, faces, corners)

      real(wp) :: along, mean(lanes), on_a, up
      integer :: d, l, t

      associate (a => own(1, wedge), b => own(2, wedge), far_a => own(1, wedges + 1 - wedge), &
         & far_b => own(2, wedges + 1 - wedge), on_b => across_b(wedge, first))
         do t = 1, faces
            do d = 1, 3
               mean(:) = merge(third, -third, t == 2)*rise(:, d)
               !$omp simd private(along, on_a, up)
               do l = 1, lanes
                  along = slope(l, d, 1, t)
                  up = merge(slope(l, d, 2, t), -slope(l, d, 2, t), wedge == 1)
                  on_a = 1.0_wp - on_b(l)
                  value(l, d, t, a) = mean(l) - along - on_a*up
                  value(l, d, t, b) = mean(l) + along - on_b(l)*up
                  value(l, d, t, far_a) = on_a*(mean(l) + up)
                  value(l, d, t, far_b) = on_b(l)*(mean(l) + up)
               end do
            end do
         end do
      end associate
   end subroutine integrate

   !> 1 where the third corner of a wedge is across from the second of its own, 0 where it is across
   !> from the first
   pure function across_b(wedge, first) result(share)
      integer, intent(in) :: wedge
      !> As in `differentiate`
      real(wp), intent(in) :: first(lanes)
      real(wp) :: share(lanes)

      share(:) = merge(first, 1.0_wp - first, wedge == 1)
   end function across_b

   !> Differences to gradients at both heights of a wedge
   pure subroutine put_gradients(batch, block, metric, slope, rise, gradient)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block
      real(wp), intent(in) :: metric(5), slope(lanes, 3, 2, faces), rise(lanes, 3)
      real(wp), intent(out) :: gradient(lanes, 3, 3, faces)

      real(wp) :: along, up
      integer :: d, l, m

      do m = 1, faces
         associate (share => batch%expansion%to_gauss(m, :))
            do d = 1, 3
               !$omp simd private(along, up)
               do l = 1, lanes
                  along = share(1)*slope(l, d, 1, 1) + share(2)*slope(l, d, 1, 2)
                  up = share(1)*slope(l, d, 2, 1) + share(2)*slope(l, d, 2, 2)
                  gradient(l, d, 1, m) = along*metric(1) + up*metric(3)
                  gradient(l, d, 2, m) = along*metric(2) + up*metric(4)
                  gradient(l, d, 3, m) = 0.5_wp*batch%two_over_h(l, block)*rise(l, d)
               end do
            end do
         end associate
      end do
   end subroutine put_gradients

   !> Transposed of `put_gradients`
   pure subroutine take_fluxes(batch, block, metric, stress, slope, rise)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: block
      real(wp), intent(in) :: metric(5), stress(lanes, 3, 3, faces)
      real(wp), intent(out) :: slope(lanes, 3, 2, faces), rise(lanes, 3)

      real(wp), dimension(lanes, faces) :: along, up
      integer :: d, l, m

      associate (share => batch%expansion%to_gauss)
         do d = 1, 3
            do m = 1, faces
               !$omp simd
               do l = 1, lanes
                  along(l, m) = metric(1)*stress(l, d, 1, m) + metric(2)*stress(l, d, 2, m)
                  up(l, m) = metric(3)*stress(l, d, 1, m) + metric(4)*stress(l, d, 2, m)
               end do
            end do
            do m = 1, faces
               !$omp simd
               do l = 1, lanes
                  slope(l, d, 1, m) = share(1, m)*along(l, 1) + share(2, m)*along(l, 2)
                  slope(l, d, 2, m) = share(1, m)*up(l, 1) + share(2, m)*up(l, 2)
               end do
            end do
            !$omp simd
            do l = 1, lanes
               rise(l, d) = 0.5_wp*batch%two_over_h(l, block)*(stress(l, d, 3, 1) &
                  & + stress(l, d, 3, 2))
            end do
         end do
      end associate
   end subroutine take_fluxes

end module plydyn_element_cracked_wedges
