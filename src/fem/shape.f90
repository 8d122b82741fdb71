!> Plane shape functions of quads, N(xi, eta): bilinear with 4 nodes, biquadratic with 9.
!>
!> Nodes in the order of the deck: corners counter-clockwise, mid-sides 12 23 34 41, centre.
module plydyn_fem_shape
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: local_nodes, shape_functions

   !> Number of nodes of a quad
   integer, parameter, public :: bilinear_nodes = 4, biquadratic_nodes = 9

   !> Local coordinates of each node along xi and eta: -1, 0, 1
   integer, parameter :: node_coordinate(2, biquadratic_nodes) = reshape( &
      & [-1, -1, 1, -1, 1, 1, -1, 1, 0, -1, 1, 0, 0, 1, -1, 0, 0, 0], [2, biquadratic_nodes])

contains

   !> Shape functions and their first derivatives at a point of the quad
   pure subroutine shape_functions(nodes, xi, eta, n, dn)
      !> Nodes of the quad, 4 or 9
      integer, intent(in) :: nodes
      !> Local coordinates, each from -1 to 1
      real(wp), intent(in) :: xi, eta
      !> Value of each shape function
      real(wp), intent(out) :: n(nodes)
      !> Derivatives of each with respect to xi and eta
      real(wp), intent(out) :: dn(2, nodes)

      real(wp) :: a(-1:1), da(-1:1), b(-1:1), db(-1:1)
      integer :: i

      call line_functions(nodes, xi, a, da)
      call line_functions(nodes, eta, b, db)
      do i = 1, nodes
         n(i) = a(node_coordinate(1, i))*b(node_coordinate(2, i))
         dn(1, i) = da(node_coordinate(1, i))*b(node_coordinate(2, i))
         dn(2, i) = a(node_coordinate(1, i))*db(node_coordinate(2, i))
      end do
   end subroutine shape_functions

   !> Local coordinates of the nodes, (2, nodes)
   pure function local_nodes(nodes) result(coordinates)
      !> Nodes of the quad, 4 or 9
      integer, intent(in) :: nodes
      real(wp) :: coordinates(2, nodes)

      coordinates(:, :) = real(node_coordinate(:, :nodes), wp)
   end function local_nodes

   !> Lagrange polynomials along a line and their derivatives, for nodes at -1, 0 and 1
   pure subroutine line_functions(nodes, x, value, slope)
      !> Nodes of the quad, 4 or 9
      integer, intent(in) :: nodes
      !> Local coordinate, from -1 to 1
      real(wp), intent(in) :: x
      !> Values; zero for node 0 of a line of two nodes
      real(wp), intent(out) :: value(-1:1)
      !> Derivatives
      real(wp), intent(out) :: slope(-1:1)

      if (nodes == bilinear_nodes) then
         value(:) = [0.5_wp*(1.0_wp - x), 0.0_wp, 0.5_wp*(1.0_wp + x)]
         slope(:) = [-0.5_wp, 0.0_wp, 0.5_wp]
      else
         value(:) = [0.5_wp*x*(x - 1.0_wp), (1.0_wp - x)*(1.0_wp + x), 0.5_wp*x*(x + 1.0_wp)]
         slope(:) = [x - 0.5_wp, -2.0_wp*x, x + 0.5_wp]
      end if
   end subroutine line_functions

end module plydyn_fem_shape
