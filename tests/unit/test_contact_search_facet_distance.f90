!> How near a facet can come to a point.
program test_contact_search_facet_distance
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_revolved_body, only : revolved_body_type, sphere_body
   use plydyn_contact_search_closest_point, only : distance_bound
   use plydyn_fem_shape, only : bilinear_nodes, biquadratic_nodes, local_nodes, shape_functions
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: round_off = 1.0e-14_wp

   type(revolved_body_type) :: ball

   ball = sphere_body(1.0_wp)
   call check_flat(bilinear_nodes)
   call check_flat(biquadratic_nodes)
   call check_bound(bilinear_nodes)
   call check_bound(biquadratic_nodes)
   call check_bulge()
   call finish()

contains

   !> From above and beside a flat square it is the distance, from its corner too
   subroutine check_flat(nodes)
      !> Points of the facet
      integer, intent(in) :: nodes

      real(wp) :: node(3, nodes)

      call begin("distance_bound, flat")
      node(:2, :) = local_nodes(nodes)
      node(3, :) = 0.0_wp
      call check(distance_bound(node, [0.3_wp, -0.4_wp, 0.7_wp], ball), 0.7_wp, round_off, "above")
      call check(distance_bound(node, [0.3_wp, -0.4_wp, -0.7_wp], ball), 0.7_wp, round_off, "below")
      call check(distance_bound(node, [-4.0_wp, 0.0_wp, 4.0_wp], ball), 5.0_wp, round_off, "beside")
      call check(distance_bound(node, [3.0_wp, 2.0_wp, 2.0_wp], ball), 3.0_wp, round_off, "corner")
      call check(distance_bound(node, [0.9_wp, 0.9_wp, 0.0_wp], ball), 0.0_wp, round_off, "inside")
   end subroutine check_flat

   !> No point of a crooked facet is nearer, and the bound is not idle
   subroutine check_bound(nodes)
      !> Points of the facet
      integer, intent(in) :: nodes

      integer, parameter :: cuts = 20
      real(wp) :: bound, dn(2, nodes), least, n(nodes), node(3, nodes), point(3)
      integer :: i, idle, j, k

      call begin("distance_bound, crooked")
      idle = 0
      do k = 1, 40
         node(:2, :) = local_nodes(nodes)
         node(3, :) = 0.0_wp
         do i = 1, nodes
            node(:, i) = node(:, i) + 0.4_wp*[sin(3.0_wp*i + k), cos(5.0_wp*i + k), &
               & sin(7.0_wp*i - k)]
         end do
         point(:) = 4.0_wp*[sin(0.7_wp*k), cos(1.1_wp*k), sin(1.3_wp*k)]
         bound = distance_bound(node, point, ball)
         least = huge(least)
         do j = -cuts, cuts
            do i = -cuts, cuts
               call shape_functions(nodes, real(i, wp)/cuts, real(j, wp)/cuts, n, dn)
               least = min(least, norm2(matmul(node, n) - point))
            end do
         end do
         call check(bound <= least + round_off, "no point is nearer")
         if (bound < 0.4_wp*least) idle = idle + 1
      end do
      call check(idle <= 4, "hardly ever is it much less")
   end subroutine check_bound

   !> A parabola between its points reaches beyond them, and no further than its control point
   subroutine check_bulge()
      real(wp) :: node(3, biquadratic_nodes)

      call begin("distance_bound, bulge")
      node(:2, :) = local_nodes(biquadratic_nodes)
      node(3, :) = 0.0_wp
      ! the middle of the first side a little beyond it, y = -1.25: its control point is at -1.5
      node(2, 5) = -1.25_wp
      call check(distance_bound(node, [0.0_wp, -3.5_wp, 0.0_wp], ball), 2.0_wp, round_off, &
         & "from outside")
   end subroutine check_bulge

end program test_contact_search_facet_distance
