!> Strain and stress of a layer anywhere in it, from its Gauss points.
!>
!> In the plane and through the thickness the values at the Gauss points are interpolated, but for
!> the shear across the plate: along its own direction it is projected onto polynomials of one
!> degree less, in the axes of the quad. That removes the oscillation that full integration leaves
!> there between the best points (Barlow, 1976), by the sampling of the MITC elements (Bathe and
!> Dvorkin, 1986).
module plydyn_element_recover_anywhere
   use plydyn_base_precision, only : wp
   use plydyn_element_group, only : ply_strain_at, ply_stress_at, recovered, strain_at, stress_at
   use plydyn_element_plate_gradients, only : gauss_metric
   use plydyn_element_plate_layers, only : layer_batch_type, plate_type
   use plydyn_fem_expansion, only : lagrange
   use plydyn_fem_quadrature, only : gauss_points, gauss_weights, legendre
   use plydyn_law_ply_elastic, only : strain_rotation
   implicit none
   private

   public :: new_plane_shares, plane_values, thickness_interpolation

   !> Shares of the Gauss points of the plane in the values at some places, (points, places)
   type, public :: plane_shares_type
      !> Interpolation; projected along xi; projected along eta
      real(wp), allocatable :: full(:, :), along_xi(:, :), along_eta(:, :)
   end type plane_shares_type

   !> Where the shear across the plate stands in the recovered values, and whether in ply axes
   integer, parameter :: shear_at(4) = [strain_at + 5, stress_at + 5, ply_strain_at + 5, &
      & ply_stress_at + 5]
   logical, parameter :: in_ply_axes(4) = [.false., .false., .true., .true.]

contains

   !> Shares of the Gauss points of the plane at some places of a quad
   pure function new_plane_shares(side, place) result(self)
      !> Nodes along a side
      integer, intent(in) :: side
      !> The places, xi and eta from -1 to 1, (2, places)
      real(wp), intent(in) :: place(:, :)
      type(plane_shares_type) :: self

      integer :: n

      allocate (self%full(side**2, size(place, 2)))
      allocate (self%along_xi, self%along_eta, mold=self%full)
      do n = 1, size(place, 2)
         associate (full_xi => line_projection(side, side - 1, place(1, n)), &
            & full_eta => line_projection(side, side - 1, place(2, n)))
            self%full(:, n) = product_shares(full_xi, full_eta)
            self%along_xi(:, n) = product_shares(line_projection(side, side - 2, place(1, n)), &
               & full_eta)
            self%along_eta(:, n) = product_shares(full_xi, &
               & line_projection(side, side - 2, place(2, n)))
         end associate
      end do
   end function new_plane_shares

   !> Shares of the Gauss points of a line in the polynomial of some degree closest to their values
   pure function line_projection(side, degree, place) result(share)
      integer, intent(in) :: side, degree
      real(wp), intent(in) :: place
      real(wp) :: share(side)

      real(wp) :: gauss(side), here, slope, there, w(side)
      integer :: k, q

      gauss(:) = gauss_points(side)
      w(:) = gauss_weights(side)
      share(:) = 0.0_wp
      do k = 0, degree
         call legendre(k, place, here, slope)
         do q = 1, side
            call legendre(k, gauss(q), there, slope)
            share(q) = share(q) + (real(k, wp) + 0.5_wp)*here*there*w(q)
         end do
      end do
   end function line_projection

   !> Shares of a plane from those of two lines, xi first
   pure function product_shares(a, b) result(share)
      real(wp), intent(in) :: a(:), b(:)
      real(wp) :: share(size(a)*size(b))

      share(:) = reshape(spread(a, 2, size(b))*spread(b, 1, size(a)), [size(share)])
   end function product_shares

   !> Recovered values at some places of the plane
   pure function plane_values(plate, quad, layer, shares, at_gauss) result(values)
      !> The plate
      type(plate_type), intent(in) :: plate
      !> Quad of the plate, and layer
      integer, intent(in) :: quad, layer
      !> The places
      type(plane_shares_type), intent(in) :: shares
      !> Values at the Gauss points of the plane, (recovered, points)
      real(wp), intent(in) :: at_gauss(:, :)
      !> (recovered, places)
      real(wp) :: values(recovered, size(shares%full, 2))

      real(wp) :: back(2, 2, size(shares%full, 2)), forth(2, 2, size(shares%full, 1))
      real(wp) :: rotation(6, 6), turn(2, 2)
      integer :: i

      values(:, :) = matmul(at_gauss, shares%full)
      call find_axes(plate, quad, shares%full, forth, back)
      ! from ply axes to the axes of the plate
      rotation(:, :) = strain_rotation(plate%angle(layer))
      turn(:, :) = transpose(rotation(5:6, 5:6))
      do i = 1, size(shear_at)
         associate (shear => at_gauss(shear_at(i):shear_at(i) + 1, :), first => shear_at(i))
            if (in_ply_axes(i)) then
               values(first:first + 1, :) = matmul(transpose(turn), projected(forth, back, &
                  & shares, matmul(turn, shear)))
            else
               values(first:first + 1, :) = projected(forth, back, shares, shear)
            end if
         end associate
      end do
   end function plane_values

   !> What takes shear across the plate to the axes of the quad at its Gauss points, and back at
   !> some places
   pure subroutine find_axes(plate, quad, share, forth, back)
      type(plate_type), intent(in) :: plate
      integer, intent(in) :: quad
      !> Shares of the points at the places, (points, places)
      real(wp), intent(in) :: share(:, :)
      !> d(x, y)/d(xi, eta) at the points, (xi or eta, x or y, points); its inverse at the places
      real(wp), intent(out) :: forth(:, :, :), back(:, :, :)

      real(wp) :: jacobian(2, 2)
      integer :: n, q

      do q = 1, size(forth, 3)
         forth(:, :, q) = inverse(gauss_metric(plate, quad, q))
      end do
      do n = 1, size(back, 3)
         jacobian(:, :) = 0.0_wp
         do q = 1, size(forth, 3)
            jacobian(:, :) = jacobian + share(q, n)*forth(:, :, q)
         end do
         back(:, :, n) = inverse(jacobian)
      end do
   end subroutine find_axes

   !> Shear at the places from that at the Gauss points, projected along xi and along eta each in
   !> its own direction
   pure function projected(forth, back, shares, at_gauss) result(shear)
      !> As from `find_axes`
      real(wp), intent(in) :: forth(:, :, :), back(:, :, :)
      type(plane_shares_type), intent(in) :: shares
      !> (x or y, points)
      real(wp), intent(in) :: at_gauss(:, :)
      !> (x or y, places)
      real(wp) :: shear(2, size(back, 3))

      real(wp) :: along(size(forth, 3), 2)
      integer :: n, q

      do q = 1, size(along, 1)
         along(q, :) = matmul(forth(:, :, q), at_gauss(:, q))
      end do
      do n = 1, size(shear, 2)
         shear(:, n) = matmul(back(:, :, n), [dot_product(shares%along_xi(:, n), along(:, 1)), &
            & dot_product(shares%along_eta(:, n), along(:, 2))])
      end do
   end function projected

   !> Inverse of a small matrix
   pure function inverse(a) result(b)
      real(wp), intent(in) :: a(2, 2)
      real(wp) :: b(2, 2)

      b(1, 1) = a(2, 2)
      b(2, 1) = -a(2, 1)
      b(1, 2) = -a(1, 2)
      b(2, 2) = a(1, 1)
      b(:, :) = b/(a(1, 1)*a(2, 2) - a(1, 2)*a(2, 1))
   end function inverse

   !> Shares of the Gauss points of the thickness at a height in the layer
   pure function thickness_interpolation(batch, zeta) result(share)
      !> Layers
      type(layer_batch_type), intent(in) :: batch
      !> Height from -1 to 1
      real(wp), intent(in) :: zeta
      real(wp) :: share(batch%expansion%order + 1)

      real(wp) :: slope(size(share))

      call lagrange(batch%expansion%gauss, zeta, share, slope)
   end function thickness_interpolation

end module plydyn_element_recover_anywhere
