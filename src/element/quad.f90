!> Geometry of quads in the plane, their nodes numbered along x first, then y (tensor order).
module plydyn_element_quad
   use plydyn_base_precision, only : wp
   use plydyn_fem_quadrature, only : equal_points, gauss_points, gauss_weights
   use plydyn_fem_shape, only : shape_functions
   implicit none
   private

   public :: quad_metric, quad_node_area, quad_node_metric, quad_spacing, plane_table, &
      & plane_tables, tensor_order

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

   !> The same at all points of the lines along xi and eta through some places of a side
   pure subroutine plane_tables(place, shape, slope)
      !> The places, as many as nodes along a side
      real(wp), intent(in) :: place(:)
      !> Shape functions, (points, nodes)
      real(wp), allocatable, intent(out) :: shape(:, :)
      !> Derivatives, (2, nodes, points)
      real(wp), allocatable, intent(out) :: slope(:, :, :)

      integer :: i, j, q

      associate (side => size(place))
         allocate (shape(side**2, side**2), slope(2, side**2, side**2))
         do j = 1, side
            do i = 1, side
               q = i + side*(j - 1)
               call plane_table(side, place(i), place(j), shape(q, :), slope(:, :, q))
            end do
         end do
      end associate
   end subroutine plane_tables

   !> What a kernel needs of a quad: at each Gauss point d(xi)/dx, d(xi)/dy, d(eta)/dx, d(eta)/dy
   !> over the distance of the outer points, and the area; not positive if the quad is folded there
   pure function quad_metric(side, xy) result(metric)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Positions of the nodes, (2, side**2)
      real(wp), intent(in) :: xy(2, side*side)
      real(wp) :: metric(5, side*side)

      metric(:, :) = metric_at(side, gauss_points(side), gauss_weights(side), xy)
   end function quad_metric

   !> The same at the nodes
   pure function quad_node_metric(side, xy) result(metric)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Positions of the nodes, (2, side**2)
      real(wp), intent(in) :: xy(2, side*side)
      real(wp) :: metric(5, side*side)

      metric(:, :) = metric_at(side, equal_points(side), node_weights(side), xy)
   end function quad_node_metric

   !> Geometry at the points of a rule
   pure function metric_at(side, place, weight, xy) result(metric)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Points of a line and their weights
      real(wp), intent(in) :: place(side), weight(side)
      !> Positions of the nodes, (2, side**2)
      real(wp), intent(in) :: xy(2, side*side)
      real(wp) :: metric(5, side*side)

      real(wp) :: area, jacobian(2, 2)
      integer :: i, j, k

      do j = 1, side
         do i = 1, side
            k = i + side*(j - 1)
            jacobian(:, :) = jacobian_at(side, place(i), place(j), xy)
            area = jacobian(1, 1)*jacobian(2, 2) - jacobian(1, 2)*jacobian(2, 1)
            metric(1:4, k) = [jacobian(2, 2), -jacobian(1, 2), -jacobian(2, 1), jacobian(1, 1)]
            metric(1:4, k) = metric(1:4, k)/(area*2.0_wp*place(side))
            metric(5, k) = area*weight(i)*weight(j)
         end do
      end do
   end function metric_at

   !> Area that belongs to each node, by quadrature at the nodes (trapezia or Simpson): the sum is
   !> the exact area, and no node of a convex quad gets a negative one, as with row sums it might
   pure function quad_node_area(side, xy) result(area)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Positions of the nodes, (2, side**2)
      real(wp), intent(in) :: xy(2, side*side)
      real(wp) :: area(side*side)

      real(wp) :: jacobian(2, 2), place(side), weight(side)
      integer :: i, j, k

      place(:) = equal_points(side)
      weight(:) = node_weights(side)
      do j = 1, side
         do i = 1, side
            k = i + side*(j - 1)
            jacobian(:, :) = jacobian_at(side, place(i), place(j), xy)
            area(k) = (jacobian(1, 1)*jacobian(2, 2) - jacobian(1, 2)*jacobian(2, 1)) &
               & *weight(i)*weight(j)
         end do
      end do
   end function quad_node_area

   !> Largest distance between neighbouring nodes on the lines of a quad
   pure real(wp) function quad_spacing(side, xy) result(spacing)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Positions of the nodes, (2, side**2)
      real(wp), intent(in) :: xy(2, side, side)
      integer :: i, j

      spacing = 0.0_wp
      do j = 1, side
         do i = 2, side
            spacing = max(spacing, norm2(xy(:, i, j) - xy(:, i - 1, j)), &
               & norm2(xy(:, j, i) - xy(:, j, i - 1)))
         end do
      end do
   end function quad_spacing

   !> Derivatives of the position along xi and eta, (2, 2)
   pure function jacobian_at(side, xi, eta, xy) result(jacobian)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Place in the square from -1 to 1
      real(wp), intent(in) :: xi, eta
      !> Positions of the nodes, (2, side**2)
      real(wp), intent(in) :: xy(2, side*side)
      real(wp) :: jacobian(2, 2)

      real(wp) :: slope(2, side*side), value(side*side)

      call plane_table(side, xi, eta, value, slope)
      jacobian(:, :) = matmul(xy, transpose(slope))
   end function jacobian_at

   !> Weights of the nodes of a line, trapezia or Simpson; their sum is 2
   pure function node_weights(side) result(weight)
      !> Nodes along a side
      integer, intent(in) :: side
      real(wp) :: weight(side)

      weight(:) = 1.0_wp
      if (side == 3) weight(:) = [1.0_wp, 4.0_wp, 1.0_wp]/3.0_wp
   end function node_weights

end module plydyn_element_quad
