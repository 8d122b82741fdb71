!> Contact nodes on bodies of revolution.
program test_contact_bodies_body_nodes
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_body_nodes, only : append_nodes, count_nodes, node_range_type
   use plydyn_contact_bodies_revolved_body, only : cone_body, cylinder_body, revolved_body_type, &
      & sphere_body, tup_body
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: round_off = 1.0e-12_wp, radius = 8.0_wp, spacing = 0.5_wp

   call check_sphere(1)
   call check_sphere(-1)
   call check_tup()
   call check_on_surface(cylinder_body(4.0_wp, 6.0_wp, 1.0_wp), [0.0_wp, 0.0_wp, 1.0_wp])
   call check_on_surface(cylinder_body(4.0_wp, 6.0_wp, 0.0_wp), [0.0_wp, 1.0_wp, 0.0_wp])
   call check_on_surface(cone_body(4.0_wp, 1.0_wp, 0.5_wp, 0.0_wp), [0.6_wp, 0.0_wp, 0.8_wp])
   call finish()

contains

   !> Nodes lie on the half that faces the plate, evenly, and a quarter turn changes nothing
   subroutine check_sphere(side)
      !> 1 when the plate lies below
      integer, intent(in) :: side

      type(revolved_body_type) :: body
      real(wp), allocatable :: node(:, :), outward(:, :), part(:, :)
      real(wp) :: apart, turned(3)
      integer :: i, r

      call begin("append_nodes, sphere")
      body = sphere_body(radius)
      body%axis(3) = real(side, wp)
      call make(body, node_range_type(spacing=spacing, side=side), node, outward)
      call check(node(:, 1), [0.0_wp, 0.0_wp, -side*radius], round_off, "the pole is a node")
      do i = 1, size(node, 2)
         call check(outward(:, i), node(:, i)/radius, round_off, "a normal is radial")
         turned(:) = [-node(2, i), node(1, i), node(3, i)]
         call check(any([(all(abs(node(:, r) - turned) <= 0.0_wp), r=1, size(node, 2))]), &
            & "a quarter turn leads to a node, to the last bit")
         turned(:) = [node(1, i), -node(2, i), node(3, i)]
         call check(any([(norm2(node(:, r) - turned) < round_off, r=1, size(node, 2))]), &
            & "a mirror leads to a node")
      end do
      do i = 2, size(node, 2)
         apart = minval([(norm2(node(:, r) - node(:, i)), r=1, i - 1), &
            & (norm2(node(:, r) - node(:, i)), r=i + 1, size(node, 2))])
         call check(apart < 1.1_wp*spacing .and. apart > 0.7_wp*spacing, "nodes are even")
      end do
      call make(body, node_range_type(spacing=spacing, horizontal=3.0_wp, side=side), part, outward)
      call check(all(norm2(part(:2, :), 1) <= 3.0_wp), "no node lies beyond the reach")
      call check(size(part, 2), count(norm2(node(:2, :), 1) <= 3.0_wp), "all within it are there")
      call make(body, node_range_type(spacing=spacing, height=[-1.0_wp, 2.0_wp], side=side), part, &
         & outward)
      call append_nodes(body, node_range_type(spacing=spacing, height=[2.0_wp, 9.0_wp], &
         & side=side), part, outward)
      call check(size(part, 2), size(node, 2), "heights one after the other give all")
      call check(maxval(abs(part - node)), 0.0_wp, 0.0_wp, "in the same order")
   end subroutine check_sphere

   !> An upright hemisphere on a rod has the nodes of the sphere
   subroutine check_tup()
      type(revolved_body_type) :: sphere, tup
      real(wp), allocatable :: node(:, :), of_sphere(:, :), outward(:, :)

      call begin("append_nodes, tup")
      sphere = sphere_body(radius)
      tup = tup_body(radius, 0.0_wp)
      sphere%axis(3) = 1.0_wp
      tup%axis(3) = 1.0_wp
      call make(sphere, node_range_type(spacing=spacing), of_sphere, outward)
      call make(tup, node_range_type(spacing=spacing, horizontal=20.0_wp), node, outward)
      call check(size(node, 2), size(of_sphere, 2), "as many")
      call check(maxval(abs(node - of_sphere)), 0.0_wp, 0.0_wp, "at the same places")
   end subroutine check_tup

   !> Nodes lie on the surface, where the body says, and cover what faces the plate
   subroutine check_on_surface(shape, axis)
      !> The body, without an axis
      type(revolved_body_type), intent(in) :: shape
      !> Its axis
      real(wp), intent(in) :: axis(3)

      type(revolved_body_type) :: body
      real(wp), allocatable :: node(:, :), outward(:, :)
      real(wp) :: gap, height, normal(3), x, y
      integer :: i, j
      type(node_range_type) :: range

      call begin("append_nodes, on the surface")
      body = shape
      body%axis(:) = axis
      range = node_range_type(spacing=0.25_wp, horizontal=6.0_wp)
      call make(body, range, node, outward)
      call check(size(node, 2), count_nodes(body, range), "as many as counted")
      do i = 1, size(node, 2)
         ! seen from outside, where the normal is unique
         call body%find_gap(-node(:, i) - 1.0e-3_wp*outward(:, i), gap, normal)
         ! at an edge the normal is one of many: what it is off by counts along the way to the point
         call check(gap, 1.0e-3_wp, 1.0e-3_wp*1.0e-6_wp, "a node is on the surface")
         call check(normal, -outward(:, i), 1.0e-6_wp, "with its normal")
         call check(outward(3, i) <= 1.0e-9_wp, "a node faces the plate")
      end do
      ! below every place of the underside, within a spacing
      do j = -7, 7
         do i = -7, 7
            x = 0.3_wp*i
            y = 0.3_wp*j
            height = body%vertical_gap([-x, -y, 0.0_wp], 1)
            if (height > 1.0e3_wp) cycle
            call check(minval(norm2(node - spread([x, y, height], 2, size(node, 2)), 1)) &
               & < 0.25_wp, "the underside has nodes")
         end do
      end do
   end subroutine check_on_surface

   !> All nodes in a range
   subroutine make(body, range, node, outward)
      type(revolved_body_type), intent(in) :: body
      type(node_range_type), intent(in) :: range
      !> Positions and normals
      real(wp), allocatable, intent(out) :: node(:, :), outward(:, :)

      allocate (node(3, 0), outward(3, 0))
      call append_nodes(body, range, node, outward)
   end subroutine make

end program test_contact_bodies_body_nodes
