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

   !> Place before that of the first lane of a block at a face of a column
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

      real(wp) :: high, low
      integer :: d, l, t

      do d = 1, 3
         if (wedge == 1) then
            do t = 1, faces
               !$omp simd
               do l = 1, lanes
                  slope(l, d, 1, t) = value(l, d, t, 2) - value(l, d, t, 1)
                  slope(l, d, 2, t) = merge(value(l, d, t, 4) - value(l, d, t, 2), &
                     & value(l, d, t, 3) - value(l, d, t, 1), first(l) > 0.0_wp)
               end do
            end do
            !$omp simd private(high, low)
            do l = 1, lanes
               low = merge(value(l, d, 1, 4), value(l, d, 1, 3), first(l) > 0.0_wp)
               high = merge(value(l, d, 2, 4), value(l, d, 2, 3), first(l) > 0.0_wp)
               rise(l, d) = third*((value(l, d, 2, 1) - value(l, d, 1, 1)) &
                  & + (value(l, d, 2, 2) - value(l, d, 1, 2)) + (high - low))
            end do
         else
            do t = 1, faces
               !$omp simd
               do l = 1, lanes
                  slope(l, d, 1, t) = value(l, d, t, 4) - value(l, d, t, 3)
                  slope(l, d, 2, t) = merge(value(l, d, t, 3) - value(l, d, t, 1), &
                     & value(l, d, t, 4) - value(l, d, t, 2), first(l) > 0.0_wp)
               end do
            end do
            !$omp simd private(high, low)
            do l = 1, lanes
               low = merge(value(l, d, 1, 1), value(l, d, 1, 2), first(l) > 0.0_wp)
               high = merge(value(l, d, 2, 1), value(l, d, 2, 2), first(l) > 0.0_wp)
               rise(l, d) = third*((value(l, d, 2, 3) - value(l, d, 1, 3)) &
                  & + (value(l, d, 2, 4) - value(l, d, 1, 4)) + (high - low))
            end do
         end if
      end do
   end subroutine differentiate

   !> Transposed of `differentiate`
   pure subroutine integrate(wedge, first, slope, rise, value)
      integer, intent(in) :: wedge
      real(wp), intent(in) :: first(lanes), slope(lanes, 3, 2, faces), rise(lanes, 3)
      real(wp), intent(out) :: value(lanes, 3, faces, corners)

      real(wp) :: along, here, mean, other, up
      integer :: d, l, t

      do t = 1, faces
         do d = 1, 3
            !$omp simd private(along, here, mean, other, up)
            do l = 1, lanes
               along = slope(l, d, 1, t)
               up = slope(l, d, 2, t)
               mean = merge(third, -third, t == 2)*rise(l, d)
               here = first(l)
               other = 1.0_wp - here
               if (wedge == 1) then
                  value(l, d, t, 1) = mean - along - other*up
                  value(l, d, t, 2) = mean + along - here*up
                  value(l, d, t, 3) = other*(mean + up)
                  value(l, d, t, 4) = here*(mean + up)
               else
                  value(l, d, t, 1) = here*(mean - up)
                  value(l, d, t, 2) = other*(mean - up)
                  value(l, d, t, 3) = mean - along + here*up
                  value(l, d, t, 4) = mean + along + other*up
               end if
            end do
         end do
      end do
   end subroutine integrate

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
