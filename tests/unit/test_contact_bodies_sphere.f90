!> Contact nodes on a sphere, and its exact gap.
program test_contact_bodies_sphere
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_sphere, only : sphere_gap, sphere_nodes
   use testing, only : begin, check, finish
   implicit none

   real(wp), parameter :: round_off = 1.0e-13_wp

   call check_nodes(1)
   call check_nodes(-1)
   call check_gap()
   call finish()

contains

   !> Nodes lie on the half that faces the plate, evenly, and a quarter turn changes nothing
   subroutine check_nodes(side)
      !> 1 when the plate lies below
      integer, intent(in) :: side

      real(wp), parameter :: radius = 8.0_wp, spacing = 0.5_wp
      real(wp), allocatable :: node(:, :), part(:, :)
      real(wp) :: apart, turned(3)
      integer :: i, r

      call begin("sphere_nodes")
      call sphere_nodes(radius, spacing, radius, side, node)
      call check(node(:, 1), [0.0_wp, 0.0_wp, -side*radius], round_off, "the pole is a node")
      do i = 1, size(node, 2)
         call check(norm2(node(:, i)), radius, round_off, "a node is on the sphere")
         call check(side*node(3, i) <= round_off, "a node faces the plate")
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
      call sphere_nodes(radius, spacing, 3.0_wp, side, part)
      call check(all(norm2(part(:2, :), 1) <= 3.0_wp), "no node lies beyond the reach")
      call check(size(part, 2), count(norm2(node(:2, :), 1) <= 3.0_wp), "all within it are there")
   end subroutine check_nodes

   !> Distance from the sphere, with its sign, and the side on which it is measured
   subroutine check_gap()
      real(wp), parameter :: centre(3) = [1.0_wp, 2.0_wp, 13.0_wp], radius = 10.0_wp
      real(wp) :: gap, normal(3)

      call begin("sphere_gap")
      call sphere_gap([1.0_wp, 2.0_wp, 2.5_wp], centre, radius, 1, gap, normal)
      call check(gap, 0.5_wp, round_off, "below the pole")
      call check(normal, [0.0_wp, 0.0_wp, 1.0_wp], round_off, "from the plate to the impactor")
      call sphere_gap(centre - [4.0_wp, 0.0_wp, 3.0_wp], centre, radius, 1, gap, normal)
      call check(gap, -5.0_wp, round_off, "inside")
      call check(normal, [0.8_wp, 0.0_wp, 0.6_wp], round_off, "radial")
      call sphere_gap(centre - [0.0_wp, 0.0_wp, 3.0_wp], centre, radius, -1, gap, normal)
      call check(gap, -13.0_wp, round_off, "a plate that should be above is penetrated")
      call sphere_gap(centre + [30.0_wp, 0.0_wp, 40.0_wp], centre, radius, 1, gap, normal)
      call check(gap, 40.0_wp, round_off, "far aside, behind")
   end subroutine check_gap

end program test_contact_bodies_sphere
