!> Geometry of quads at Gauss points and nodes.
program test_element_quad
   use plydyn_base_precision, only : wp
   use plydyn_element_quad, only : quad_metric, quad_node_area, quad_node_metric, quad_spacing, &
      & tensor_order
   use plydyn_model_mesh, only : mesh_type
   use sample, only : rectangle_mesh
   use testing, only : begin, check, finish
   implicit none

   integer :: side

   do side = 2, 3
      call test_parallelogram()
      call test_distorted()
   end do
   call finish()

contains

   !> A parallelogram has one Jacobian everywhere
   subroutine test_parallelogram()
      real(wp), parameter :: a(2) = [4.0_wp, 1.0_wp], b(2) = [-1.0_wp, 2.0_wp], area = 9.0_wp
      real(wp) :: gauss(5, side**2), node(5, side**2), s, t, xy(2, side**2)
      integer :: i, j, q

      call begin("metric of a parallelogram")
      do j = 1, side
         do i = 1, side
            s = real(i - 1, wp)/real(side - 1, wp)
            t = real(j - 1, wp)/real(side - 1, wp)
            xy(:, i + side*(j - 1)) = s*a + t*b
         end do
      end do
      gauss(:, :) = quad_metric(side, xy)
      node(:, :) = quad_node_metric(side, xy)
      ! xi and eta run over 2 along a and b; derivatives are over twice the reach, 2 at nodes
      do q = 1, side**2
         call check(node(1:4, q), [b(2), -b(1), -a(2), a(1)]/area, 1.0e-14_wp, "at the nodes")
         call check(gauss(1:4, q)*merge(sqrt(0.6_wp), sqrt(1.0_wp/3.0_wp), side == 3), &
            & node(1:4, q), 1.0e-14_wp, "is the same at the Gauss points")
      end do
      call check(sum(gauss(5, :)), area, 1.0e-13_wp, "has the area with Gauss points")
      call check(sum(node(5, :)), area, 1.0e-13_wp, "and with nodes")
      call check(quad_spacing(side, xy), norm2(a)/real(side - 1, wp), 1.0e-14_wp, &
         & "nodes are at most this far apart")
   end subroutine test_parallelogram

   !> Both rules give the area of distorted quads
   subroutine test_distorted()
      type(mesh_type) :: mesh
      real(wp) :: gauss, metric(5, side**2), node, xy(2, side**2)
      integer :: e

      call begin("area of distorted quads")
      mesh = rectangle_mesh(side, 3, 2, 6.0_wp, 4.0_wp, 0.06_wp)
      gauss = 0.0_wp
      node = 0.0_wp
      do e = 1, size(mesh%quad_id)
         xy(:, :) = mesh%position(1:2, mesh%quad_node(tensor_order(side), e))
         metric(:, :) = quad_metric(side, xy)
         gauss = gauss + sum(metric(5, :))
         metric(:, :) = quad_node_metric(side, xy)
         node = node + sum(metric(5, :))
         call check(metric(5, :), quad_node_area(side, xy), 1.0e-14_wp, "node by node")
      end do
      call check(gauss, 24.0_wp, 1.0e-12_wp, "is exact with Gauss points")
      call check(node, 24.0_wp, 1.0e-12_wp, "is exact with nodes")
   end subroutine test_distorted

end program test_element_quad
