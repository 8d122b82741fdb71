!> Geometry of quads in the plane, their nodes numbered along x first, then y (tensor order).
module plydyn_element_quad
   use plydyn_base_precision, only : wp
   use plydyn_fem_quadrature, only : gauss_points, gauss_weights
   use plydyn_fem_shape, only : shape_functions
   implicit none
   private

   public :: quad_metric, quad_node_area, plane_table, tensor_order

   !> Places of the deck's quad nodes (corners, mid-sides, centre) in tensor order
   integer, parameter :: tensor_of_q4(4) = [1, 2, 4, 3]
   integer, parameter :: tensor_of_q9(9) = [1, 5, 2, 8, 9, 6, 4, 7, 3]

contains

   !> Places of the deck's quad nodes in tensor order
   pure function tensor_order(side) result(order)
      !> Nodes along a side, 2 or 3
      integer, intent(in) :: side
      integer :: order(side*side)

      if (side == 2) then
         order(:) = tensor_of_q4
      else
         order(:) = tensor_of_q9
      end if
   end function tensor_order

   !> Shape functions of the nodes and their derivatives along xi and eta at one place
   pure subroutine plane_table(side, xi, eta, value, slope)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Place in the square from -1 to 1
      real(wp), intent(in) :: xi, eta
      !> Shape functions, (side**2)
      real(wp), intent(out) :: value(side*side)
      !> Derivatives, (2, side**2)
      real(wp), intent(out) :: slope(2, side*side)

      real(wp) :: n(side*side), dn(2, side*side)
      integer :: order(side*side)

      order(:) = tensor_order(side)
      call shape_functions(side*side, xi, eta, n, dn)
      value(:) = n(order)
      slope(:, :) = dn(:, order)
   end subroutine plane_table

   !> What a plate kernel needs of a quad: at each Gauss point d(xi)/dx, d(xi)/dy, d(eta)/dx,
   !> d(eta)/dy over the distance of the outer points, and the area; not positive if the quad is
   !> folded there
   pure function quad_metric(side, xy) result(metric)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Positions of the nodes, (2, side**2)
      real(wp), intent(in) :: xy(2, side*side)
      real(wp) :: metric(5, side*side)

      real(wp) :: area, gauss(side), jacobian(2, 2), slope(2, side*side), value(side*side), w(side)
      integer :: i, j, k

      gauss(:) = gauss_points(side)
      w(:) = gauss_weights(side)
      do j = 1, side
         do i = 1, side
            k = i + side*(j - 1)
            call plane_table(side, gauss(i), gauss(j), value, slope)
            jacobian(:, :) = matmul(xy, transpose(slope))
            area = jacobian(1, 1)*jacobian(2, 2) - jacobian(1, 2)*jacobian(2, 1)
            metric(1:4, k) = [jacobian(2, 2), -jacobian(1, 2), -jacobian(2, 1), jacobian(1, 1)]
            metric(1:4, k) = metric(1:4, k)/(area*2.0_wp*gauss(side))
            metric(5, k) = area*w(i)*w(j)
         end do
      end do
   end function quad_metric

   !> Area that belongs to each node, by quadrature at the nodes (trapezia or Simpson): the sum is
   !> the exact area, and no node of a convex quad gets a negative one, as with row sums it might
   pure function quad_node_area(side, xy) result(area)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Positions of the nodes, (2, side**2)
      real(wp), intent(in) :: xy(2, side*side)
      real(wp) :: area(side*side)

      real(wp) :: jacobian(2, 2), place(side), slope(2, side*side), value(side*side), w(side)
      integer :: i, j, k

      place(:) = [(-1.0_wp + 2.0_wp*real(i - 1, wp)/real(side - 1, wp), i=1, side)]
      w(:) = 1.0_wp
      if (side == 3) w(:) = [1.0_wp, 4.0_wp, 1.0_wp]/3.0_wp
      do j = 1, side
         do i = 1, side
            k = i + side*(j - 1)
            call plane_table(side, place(i), place(j), value, slope)
            jacobian(:, :) = matmul(xy, transpose(slope))
            area(k) = (jacobian(1, 1)*jacobian(2, 2) - jacobian(1, 2)*jacobian(2, 1))*w(i)*w(j)
         end do
      end do
   end function quad_node_area

end module plydyn_element_quad
