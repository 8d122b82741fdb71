!> Plane shape functions.
program test_fem_shape
   use monomial, only : slope
   use plydyn_base_precision, only : wp
   use plydyn_fem_shape, only : bilinear_nodes, biquadratic_nodes, local_nodes, shape_functions
   use testing, only : begin, check, finish
   implicit none

   !> A few units in the last place of sums of nine terms of order one
   real(wp), parameter :: round_off = 1.0e-14_wp

   call check_quad(bilinear_nodes)
   call check_quad(biquadratic_nodes)
   call check_order()
   call finish()

contains

   !> What holds for both quads
   subroutine check_quad(nodes)
      !> Nodes of the quad
      integer, intent(in) :: nodes

      call begin("shape functions")
      call check_nodal_values(nodes)
      call check_reproduction(nodes)
   end subroutine check_quad

   !> One at the own node, zero at the others
   subroutine check_nodal_values(nodes)
      !> Nodes of the quad
      integer, intent(in) :: nodes

      real(wp) :: n(nodes), dn(2, nodes), place(2, nodes), expected(nodes)
      integer :: i

      place(:, :) = local_nodes(nodes)
      do i = 1, nodes
         call shape_functions(nodes, place(1, i), place(2, i), n, dn)
         expected(:) = 0.0_wp
         expected(i) = 1.0_wp
         call check(maxval(abs(n - expected)), 0.0_wp, round_off, "unity at the own node only")
      end do
   end subroutine check_nodal_values

   !> The quad's polynomials and their derivatives are reproduced at any point
   subroutine check_reproduction(nodes)
      !> Nodes of the quad
      integer, intent(in) :: nodes

      real(wp), parameter :: xi = 0.3_wp, eta = -0.7_wp
      real(wp) :: n(nodes), dn(2, nodes), place(2, nodes), value(nodes)
      integer :: a, b, degree

      degree = merge(1, 2, nodes == bilinear_nodes)
      place(:, :) = local_nodes(nodes)
      call shape_functions(nodes, xi, eta, n, dn)
      do b = 0, degree
         do a = 0, degree
            value(:) = place(1, :)**a*place(2, :)**b
            call check(dot_product(n, value), xi**a*eta**b, round_off, "value")
            call check(dot_product(dn(1, :), value), slope(xi, a)*eta**b, round_off, "along xi")
            call check(dot_product(dn(2, :), value), xi**a*slope(eta, b), round_off, "along eta")
         end do
      end do
   end subroutine check_reproduction

   !> The node order of the deck: corners counter-clockwise, mid-sides 12 23 34 41, centre
   subroutine check_order()
      real(wp) :: place(2, biquadratic_nodes), middle(2)
      integer :: side

      call begin("local nodes")
      place(:, :) = local_nodes(biquadratic_nodes)
      do side = 1, 4
         middle(:) = 0.5_wp*(place(:, side) + place(:, modulo(side, 4) + 1))
         call check(maxval(abs(place(:, 4 + side) - middle)), 0.0_wp, round_off, "mid-side")
      end do
      call check(maxval(abs(place(:, 9))), 0.0_wp, round_off, "centre")
      call check(maxval(abs(place(:, :4) - local_nodes(bilinear_nodes))), 0.0_wp, round_off, &
         & "the same corners")
   end subroutine check_order

end program test_fem_shape
