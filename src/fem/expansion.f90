!> Lagrange expansion through the thickness of a numerical layer, F_tau(z) of the paper's eq. 1.
module plydyn_fem_expansion
   use plydyn_base_precision, only : wp
   use plydyn_fem_quadrature, only : equal_points, gauss_points, gauss_weights, legendre, &
      & lobatto_points
   implicit none
   private

   public :: lagrange, level_table, new_expansion, thickness_nodes

   !> Tables of an expansion of one order; the layer spans -1 to 1
   type, public :: expansion_type
      !> Polynomial order; there are order + 1 nodes
      integer :: order = 0
      !> Coordinates of the nodes, from bottom to top
      real(wp), allocatable :: node(:)
      !> Fraction of the layer's mass at each node: row sums of the consistent mass matrix
      real(wp), allocatable :: mass_share(:)
      !> Nodal values to coefficients of orthonormal Legendre modes, (modes, nodes)
      real(wp), allocatable :: to_mode(:, :)
      !> Coefficients of the modes to those of their derivative, (modes, modes)
      real(wp), allocatable :: mode_slope(:, :)
      !> Coordinates and weights of the Gauss points
      real(wp), allocatable :: gauss(:), weight(:)
      !> Nodal values to values at the Gauss points, (points, nodes)
      real(wp), allocatable :: to_gauss(:, :)
      !> Values at the Gauss points to derivatives there, (points, points)
      real(wp), allocatable :: gauss_slope(:, :)
   end type expansion_type

contains

   !> Compute the tables of one order
   pure function new_expansion(order, lobatto) result(self)
      !> Polynomial order, 1 or more
      integer, intent(in) :: order
      !> Nodes at Gauss-Lobatto points instead of equal spacing
      logical, intent(in) :: lobatto
      type(expansion_type) :: self

      real(wp) :: slope(order + 1, order + 1)
      integer :: k, n

      n = order + 1
      self%order = order
      allocate (self%node(n), self%mass_share(n), self%gauss(n), self%weight(n))
      allocate (self%to_gauss(n, n), self%gauss_slope(n, n))
      self%node(:) = thickness_nodes(order, lobatto)
      self%gauss(:) = gauss_points(n)
      self%weight(:) = gauss_weights(n)
      do k = 1, n
         call lagrange(self%node, self%gauss(k), self%to_gauss(k, :), slope(k, :))
         call lagrange(self%gauss, self%gauss(k), slope(1, :), self%gauss_slope(k, :))
      end do
      self%mass_share(:) = 0.5_wp*matmul(self%weight, self%to_gauss)
      call make_modes(self)
   end function new_expansion

   !> Tables of the orthonormal Legendre modes, by exact quadrature
   pure subroutine make_modes(self)
      type(expansion_type), intent(inout) :: self

      real(wp) :: derivative, mode(self%order + 1, self%order + 1)
      real(wp) :: mode_prime(self%order + 1, self%order + 1), scale
      integer :: k, m, n

      n = self%order + 1
      do k = 1, n
         do m = 1, n
            scale = sqrt(real(m, wp) - 0.5_wp)
            call legendre(m - 1, self%gauss(k), mode(k, m), derivative)
            mode(k, m) = scale*mode(k, m)
            mode_prime(k, m) = scale*derivative
         end do
      end do
      mode(:, :) = spread(self%weight, 2, n)*mode
      allocate (self%to_mode(n, n), self%mode_slope(n, n))
      self%to_mode(:, :) = matmul(transpose(mode), self%to_gauss)
      self%mode_slope(:, :) = matmul(transpose(mode), mode_prime)
   end subroutine make_modes

   !> Integrals of the products of the derivatives of the polynomials from -1 to 1
   pure function level_table(expansion) result(table)
      !> The expansion
      type(expansion_type), intent(in) :: expansion
      real(wp) :: table(expansion%order + 1, expansion%order + 1)

      real(wp) :: slope(expansion%order + 1, expansion%order + 1)

      slope(:, :) = matmul(expansion%gauss_slope, expansion%to_gauss)
      table(:, :) = matmul(transpose(slope), spread(expansion%weight, 2, size(slope, 2))*slope)
   end function level_table

   !> Coordinates of the nodes of an expansion, from bottom to top
   pure function thickness_nodes(order, lobatto) result(z)
      !> Polynomial order, 1 or more
      integer, intent(in) :: order
      !> Nodes at Gauss-Lobatto points instead of equal spacing
      logical, intent(in) :: lobatto
      real(wp) :: z(order + 1)

      if (lobatto) then
         z(:) = lobatto_points(order + 1)
      else
         z(:) = equal_points(order + 1)
      end if
   end function thickness_nodes

   !> Lagrange polynomials of some nodes and their derivatives at a coordinate
   pure subroutine lagrange(node, z, value, slope)
      !> Abscissae of the nodes
      real(wp), intent(in) :: node(:)
      !> Coordinate
      real(wp), intent(in) :: z
      !> F(z) and dF/dz of each node
      real(wp), intent(out) :: value(:), slope(:)

      real(wp) :: product
      integer :: i, j, k

      do i = 1, size(node)
         value(i) = 1.0_wp
         slope(i) = 0.0_wp
         do j = 1, size(node)
            if (j == i) cycle
            value(i) = value(i)*(z - node(j))/(node(i) - node(j))
            product = 1.0_wp/(node(i) - node(j))
            do k = 1, size(node)
               if (k /= i .and. k /= j) product = product*(z - node(k))/(node(i) - node(k))
            end do
            slope(i) = slope(i) + product
         end do
      end do
   end subroutine lagrange

end module plydyn_fem_expansion
