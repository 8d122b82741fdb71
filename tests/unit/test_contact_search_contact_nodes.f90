!> Contact nodes on the impactor: their spacing, and how long they may sleep.
program test_contact_search_contact_nodes
   use ball, only : new_plate, points, radius, set_ball, spacing, squares, touching
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : constraints_type
   use plydyn_contact_search_candidate_list, only : candidate_list_type
   use plydyn_contact_search_contact_nodes, only : new_nodes, node_set_type
   use plydyn_contact_search_surface, only : surface_type
   use testing, only : begin, check, finish
   implicit none

   real(wp) :: flat(3, points)
   integer :: facet(9, squares**2)
   type(surface_type) :: surface

   call new_plate(flat, facet, surface)
   call check_spacing()
   call check_travel()
   call check_patch()
   call check_folded()
   call check_fold()
   call finish()

contains

   !> Nodes are as far apart as asked, or half as far as the points of the plate
   subroutine check_spacing()
      type(node_set_type) :: nodes
      type(error_type), allocatable :: error

      call begin("new_nodes")
      call new_nodes(nodes, surface, flat, touching, radius, spacing, error)
      call check(.not. allocated(error), "a spacing can be given")
      call check_first_ring(nodes, spacing)
      call new_nodes(nodes, surface, flat, touching, radius, 0.0_wp, error)
      call check(.not. allocated(error), "a spacing is made from the mesh")
      call check_first_ring(nodes, 0.25_wp)
      call new_nodes(nodes, surface, flat, [0.0_wp, 0.0_wp, 1.0e4_wp], 1.0e4_wp, spacing, error)
      call check(.not. allocated(error), "a sphere much wider than the plate has few nodes over it")
      call new_nodes(nodes, surface, flat, touching, radius, 1.0e-3_wp, error)
      call check(allocated(error), "millions of nodes are refused")
   end subroutine check_spacing

   !> The first ring is a spacing from the pole, or a little less
   subroutine check_first_ring(nodes, spacing)
      !> The nodes
      type(node_set_type), intent(in) :: nodes
      !> Distance asked for
      real(wp), intent(in) :: spacing

      real(wp) :: apart

      apart = norm2(nodes%position(:, 2) - nodes%position(:, 1))
      call check(apart <= spacing .and. apart > 0.9_wp*spacing, "distance from the pole")
   end subroutine check_first_ring

   !> No gap within reach shrinks by more than the travel grows, unless the list is new; outside is
   !> beyond reach
   subroutine check_travel()
      type(constraints_type) :: rows
      type(candidate_list_type) :: near
      type(node_set_type) :: nodes
      real(wp) :: after, before, centre(3), position(3, points), travel
      integer :: f, rebuilds, step
      logical :: rebuilt

      call begin("update")
      call set_ball(surface, flat, near, nodes, rows)
      before = near%reach
      rebuilds = 0
      do step = 1, 200
         position(:, :) = flat
         position(3, :) = 0.1_wp*sin(0.3_wp*step - flat(1, :))*cos(flat(2, :) + 0.1_wp*step)
         centre(:) = [0.01_wp*step - 1.0_wp, 0.0_wp, radius + 0.3_wp + 0.3_wp*cos(0.05_wp*step)]
         travel = near%travel
         call near%update(surface, position, centre, rebuilt)
         after = min(nodes%least_gap(surface, position, centre), near%reach)
         if (rebuilt) then
            rebuilds = rebuilds + 1
         else
            call check(before - after <= near%travel - travel + 1.0e-12_wp, "travel bounds the gap")
         end if
         before = after
         do f = 1, squares**2
            if (any(near%facet == f)) cycle
            call check(minval(norm2(position(:, facet(:, f)) - spread(centre, 2, 9), dim=1)) &
               & - radius > near%reach, "no point outside the list is within reach")
         end do
      end do
      call check(rebuilds > 0 .and. rebuilds < 100, "the list is new now and then")
   end subroutine check_travel

   !> With listed points only, most of the time, the rows are those of all points; outside of the
   !> patch a foot is beside it
   subroutine check_patch()
      type(candidate_list_type) :: lazy, near
      type(node_set_type) :: nodes, others
      type(constraints_type) :: all_rows, rows
      real(wp) :: before(3, points), centre(3), given(3, points), position(3, points)
      integer :: looks, presses, step
      logical :: rebuilt, rebuilt_lazily

      call begin("approach")
      call set_ball(surface, flat, near, nodes, all_rows)
      call set_ball(surface, flat, lazy, others, rows)
      looks = 0
      presses = 0
      before(:, :) = flat
      do step = 1, 400
         position(:, :) = flat
         position(3, :) = 0.002_wp*sin(0.01_wp*step - flat(1, :))*cos(flat(2, :))
         centre(:) = [0.003_wp*step - 1.0_wp, 0.0_wp, radius + 0.03_wp*cos(0.02_wp*step)]
         call near%update(surface, position, centre, rebuilt)
         call lazy%approach(maxval(norm2(position - before, dim=1)), centre)
         given(:, :) = position
         if (lazy%needs_all) then
            looks = looks + 1
         else
            given(:, :) = -1.0e3_wp
            given(:, lazy%point) = position(:, lazy%point)
         end if
         call lazy%update(surface, given, centre, rebuilt_lazily)
         call check(rebuilt_lazily .eqv. rebuilt, "the list is new in the same step")
         if (rebuilt) call nodes%forget()
         if (rebuilt) call others%forget()
         all_rows%count = 0
         rows%count = 0
         call nodes%collect(near%patch, near, position, centre, all_rows)
         call others%collect(lazy%patch, lazy, given, centre, rows)
         call check(rows%count, all_rows%count, "as many nodes are below the surface")
         call check(all(abs(rows%gap(:rows%count) - all_rows%gap(:rows%count)) <= 0.0_wp), &
            & "as deep")
         presses = presses + rows%count
         before(:, :) = position
      end do
      call check(looks < 100, "all points are needed now and then only")
      call check(presses > 0, "nodes press")
   end subroutine check_patch

   !> A node presses a facet that faces it, and none that has folded over
   subroutine check_folded()
      real(wp), parameter :: depth = 0.1_wp
      type(constraints_type) :: rows
      type(candidate_list_type) :: near
      type(node_set_type) :: nodes
      real(wp) :: centre(3), position(3, points)
      logical :: rebuilt

      call begin("collect")
      call set_ball(surface, flat, near, nodes, rows)
      centre(:) = [0.1_wp, 0.2_wp, radius - depth]
      call near%update(surface, flat, centre, rebuilt)
      call nodes%collect(surface, near, flat, centre, rows)
      call check(rows%count > 0, "a plate that faces the sphere is pressed")
      call check(minval(rows%gap(:rows%count)), -depth, 1.0e-12_wp, "as deep as it was moved")
      position(:, :) = flat
      position(1, :) = -flat(1, :)
      centre(3) = radius + depth
      rows%count = 0
      call nodes%forget()
      call near%update(surface, position, centre, rebuilt)
      call nodes%collect(surface, near, position, centre, rows)
      call check(rows%count, 0, "a plate turned over is not")
   end subroutine check_folded

   !> Close to a fold the normal is that of the sphere, and the gap still ends at the closest point
   subroutine check_fold()
      real(wp), parameter :: slope = 0.01_wp, beside = 1.0e-5_wp, depth = 1.0e-3_wp
      real(wp), parameter :: along = sqrt(1.0_wp + slope**2)
      type(constraints_type) :: rows
      type(candidate_list_type) :: near
      type(node_set_type) :: nodes
      real(wp) :: centre(3), position(3, points)
      logical :: rebuilt

      call begin("collect, fold")
      call set_ball(surface, flat, near, nodes, rows)
      position(:, :) = flat
      position(3, :) = slope*abs(flat(1, :))
      centre(:) = [beside + depth*slope/along, 0.3_wp, slope*beside - depth/along + radius]
      call near%update(surface, position, centre, rebuilt)
      call nodes%collect(surface, near, position, centre, rows)
      call check(rows%count, 1, "the pole is in the valley")
      call check(rows%normal(:, 1), [0.0_wp, 0.0_wp, 1.0_wp], 1.0e-15_wp, "normal of the sphere")
      call check(rows%gap(1), -depth/along, 1.0e-12_wp, "height over the closest point")
   end subroutine check_fold

end program test_contact_search_contact_nodes
