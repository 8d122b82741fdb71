!> Contact nodes on the impactor: spacing, approach bound, folded facets and kinks.
program test_contact_search_contact_nodes
   use ball, only : ball_body, new_plate, points, radius, set_ball, spacing, squares, touching
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
   call check_approach_bound()
   call check_patch()
   call check_folded()
   call check_kink()
   call finish()

contains

   !> Nodes are as far apart as asked, or half as far as the points of the plate
   subroutine check_spacing()
      type(node_set_type) :: nodes
      type(error_type), allocatable :: error

      call begin("new_nodes")
      call new_nodes(nodes, surface, flat, touching, ball_body(radius), spacing, error)
      call check(.not. allocated(error), "a spacing can be given")
      call check_first_ring(nodes, spacing)
      call new_nodes(nodes, surface, flat, touching, ball_body(radius), 0.0_wp, error)
      call check(.not. allocated(error), "a spacing is made from the mesh")
      call check_first_ring(nodes, 0.25_wp)
      call new_nodes(nodes, surface, flat, [0.0_wp, 0.0_wp, 1.0e4_wp], ball_body(1.0e4_wp), &
         & spacing, error)
      call check(.not. allocated(error), "a sphere much wider than the plate has few nodes over it")
      call new_nodes(nodes, surface, flat, touching, ball_body(radius), 1.0e-3_wp, error)
      call check(allocated(error), "millions of nodes are refused")
      call new_nodes(nodes, surface, flat, [0.0_wp, 0.0_wp, 1.0e9_wp], ball_body(1.0e9_wp), &
         & spacing, error)
      call check(allocated(error), "billions of rings of which few have nodes are not counted")
      call new_nodes(nodes, surface, flat, touching, ball_body(radius), 4.0_wp, error)
      call check(allocated(error), "a few nodes are refused")
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

   !> No gap shrinks by more than the approach bound grows, unless the list is new; unlisted points
   !> are farther than the search distance
   subroutine check_approach_bound()
      type(constraints_type) :: rows
      type(candidate_list_type) :: candidates
      type(node_set_type) :: nodes
      real(wp) :: after, before, centre(3), position(3, points), approach_bound
      integer :: f, rebuilds, step
      logical :: rebuilt

      call begin("update")
      call set_ball(surface, flat, candidates, nodes, rows)
      before = candidates%search_distance
      rebuilds = 0
      do step = 1, 200
         position(:, :) = flat
         position(3, :) = 0.1_wp*sin(0.3_wp*step - flat(1, :))*cos(flat(2, :) + 0.1_wp*step)
         centre(:) = [0.01_wp*step - 1.0_wp, 0.0_wp, radius + 0.3_wp + 0.3_wp*cos(0.05_wp*step)]
         approach_bound = candidates%approach_bound
         call candidates%update(position, centre, rebuilt)
         after = min(nodes%least_gap(surface, position, centre), candidates%search_distance)
         if (rebuilt) then
            rebuilds = rebuilds + 1
         else
            call check(before - after <= candidates%approach_bound - approach_bound + 1.0e-12_wp, &
               & "the bound holds")
         end if
         before = after
         do f = 1, squares**2
            if (any(candidates%facet == f)) cycle
            call check(minval(norm2(position(:, facet(:, f)) - spread(centre, 2, 9), dim=1)) &
               & - radius > candidates%search_distance, &
               & "no unlisted point is within the search distance")
         end do
      end do
      call check(rebuilds > 0 .and. rebuilds < 100, "the list is new now and then")
   end subroutine check_approach_bound

   !> With listed points only, most of the time, the rows are those of all points
   subroutine check_patch()
      type(candidate_list_type) :: lazy, candidates
      type(node_set_type) :: nodes, others
      type(constraints_type) :: all_rows, rows
      real(wp) :: before(3, points), centre(3), given(3, points), position(3, points)
      integer :: full_updates, contact_rows, step
      logical :: rebuilt, rebuilt_lazily

      call begin("approach")
      call set_ball(surface, flat, candidates, nodes, all_rows)
      call set_ball(surface, flat, lazy, others, rows)
      full_updates = 0
      contact_rows = 0
      before(:, :) = flat
      do step = 1, 400
         position(:, :) = flat
         position(3, :) = 0.002_wp*sin(0.01_wp*step - flat(1, :))*cos(flat(2, :))
         centre(:) = [0.003_wp*step - 1.0_wp, 0.0_wp, radius + 0.03_wp*cos(0.02_wp*step)]
         call candidates%update(position, centre, rebuilt)
         call lazy%update_slack(maxval(norm2(position - before, dim=1)), centre)
         given(:, :) = position
         if (lazy%needs_all) then
            full_updates = full_updates + 1
         else
            given(:, :) = -1.0e3_wp
            given(:, lazy%point) = position(:, lazy%point)
         end if
         call lazy%update(given, centre, rebuilt_lazily)
         call check(rebuilt_lazily .eqv. rebuilt, "the list is new in the same step")
         if (rebuilt) call nodes%reset()
         if (rebuilt) call others%reset()
         all_rows%count = 0
         rows%count = 0
         call nodes%make_rows(candidates, position, centre, all_rows)
         call others%make_rows(lazy, given, centre, rows)
         call check(rows%count, all_rows%count, "as many nodes are below the surface")
         call check(all(abs(rows%gap(:rows%count) - all_rows%gap(:rows%count)) <= 0.0_wp), &
            & "as deep")
         contact_rows = contact_rows + rows%count
         before(:, :) = position
      end do
      call check(full_updates < 100, "all points are needed now and then only")
      call check(contact_rows > 0, "there are rows")
   end subroutine check_patch

   !> A node makes a row on a facet that faces it, and none on one that has folded over
   subroutine check_folded()
      real(wp), parameter :: depth = 0.1_wp
      type(constraints_type) :: rows
      type(candidate_list_type) :: candidates
      type(node_set_type) :: nodes
      real(wp) :: centre(3), position(3, points)
      logical :: rebuilt

      call begin("make_rows")
      call set_ball(surface, flat, candidates, nodes, rows)
      centre(:) = [0.1_wp, 0.2_wp, radius - depth]
      call candidates%update(flat, centre, rebuilt)
      call nodes%make_rows(candidates, flat, centre, rows)
      call check(rows%count > 0, "rows on a plate that faces the sphere")
      call check(minval(rows%gap(:rows%count)), -depth, 1.0e-12_wp, "as deep as it was moved")
      position(:, :) = flat
      position(1, :) = -flat(1, :)
      centre(3) = radius + depth
      rows%count = 0
      call nodes%reset()
      call candidates%update(position, centre, rebuilt)
      call nodes%make_rows(candidates, position, centre, rows)
      call check(rows%count, 0, "none on a plate turned over")
   end subroutine check_folded

   !> At a kink the normal is the mean of both sides, and the gap is that to the closest point
   subroutine check_kink()
      real(wp), parameter :: slope = 0.01_wp, aside = 1.0e-5_wp, depth = 1.0e-3_wp
      real(wp), parameter :: along = sqrt(1.0_wp + slope**2)
      type(constraints_type) :: rows
      type(candidate_list_type) :: candidates
      type(node_set_type) :: nodes
      real(wp) :: centre(3), position(3, points)
      logical :: rebuilt

      call begin("make_rows, kink")
      call set_ball(surface, flat, candidates, nodes, rows)
      position(:, :) = flat
      position(3, :) = slope*abs(flat(1, :))
      centre(:) = [aside + depth*slope/along, 0.3_wp, slope*aside - depth/along + radius]
      call candidates%update(position, centre, rebuilt)
      call nodes%make_rows(candidates, position, centre, rows)
      call check(rows%count, 1, "the pole is in the valley")
      call check(rows%normal(:, 1), [0.0_wp, 0.0_wp, 1.0_wp], 1.0e-15_wp, "mean of both sides")
      call check(rows%gap(1), -depth/along, 1.0e-12_wp, "height over the closest point")
   end subroutine check_kink

end program test_contact_search_contact_nodes
