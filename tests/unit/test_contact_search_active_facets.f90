!> Active facets: every contact row lies on one of them, and they are a small part of the face.
program test_contact_search_active_facets
   use ball, only : new_plate, points, radius, set_ball, squares
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : constraints_type
   use plydyn_contact_search_active_facets, only : active_facets_type, new_active_facets
   use plydyn_contact_search_candidate_list, only : candidate_list_type
   use plydyn_contact_search_contact_nodes, only : node_set_type
   use plydyn_contact_search_surface, only : surface_type
   use testing, only : begin, check, finish
   implicit none

   real(wp) :: flat(3, points)
   integer :: facet(9, squares**2)
   type(surface_type) :: surface

   call new_plate(flat, facet, surface)
   call check_rolling()
   call check_jump()
   call check_taken()
   call finish()

contains

   !> A sphere that rolls and bounces over waves loads only facets that were active before the step
   subroutine check_rolling()
      type(active_facets_type) :: active_facets
      type(candidate_list_type) :: candidates
      type(node_set_type) :: nodes
      type(constraints_type) :: rows
      logical :: is_active(squares**2), rebuilt
      real(wp) :: centre(3), position(3, points)
      integer :: contact_rows, found, row, step, steps_with_list

      call begin("update")
      call set_ball(surface, flat, candidates, nodes, rows)
      call new_active_facets(active_facets, squares**2)
      contact_rows = 0
      steps_with_list = 0
      found = 0
      do step = 1, 2000
         position(:, :) = flat
         position(3, :) = 0.002_wp*sin(0.01_wp*step - flat(1, :))*cos(flat(2, :))
         centre(:) = [0.001_wp*step - 1.0_wp, 0.0_wp, radius + 0.03_wp*cos(0.004_wp*step)]
         is_active(:) = active_facets%is_all
         is_active(active_facets%facet(:active_facets%count)) = .true.
         call candidates%update_slack(0.001_wp, centre)
         call candidates%update(position, centre, rebuilt)
         if (rebuilt) call nodes%reset()
         is_active(:) = is_active .or. rebuilt
         active_facets%is_all = active_facets%is_all .or. rebuilt
         rows%count = 0
         call nodes%make_rows(candidates, position, centre, rows)
         do row = 1, rows%count
            call check(is_active(nodes%facet(rows%source(row))), "rows lie on active facets")
         end do
         row = rows%count
         call active_facets%update(candidates, nodes, rows)
         call check(rows%count, row, "no row is removed")
         contact_rows = contact_rows + rows%count
         if (active_facets%is_all) cycle
         steps_with_list = steps_with_list + 1
         found = found + active_facets%count
      end do
      call check(contact_rows > 0, "there are rows")
      call check(steps_with_list > 1900, "the facets are known in nearly all steps")
      call check(found < steps_with_list*squares**2/2, "and few")
   end subroutine check_rolling

   !> A node that jumps to another facet makes a row one step later
   subroutine check_jump()
      type(active_facets_type) :: active_facets
      type(candidate_list_type) :: candidates
      type(node_set_type) :: nodes
      type(constraints_type) :: rows
      logical :: rebuilt
      real(wp) :: centre(3)
      integer :: step

      call begin("update, jump")
      call set_ball(surface, flat, candidates, nodes, rows)
      call new_active_facets(active_facets, squares**2)
      do step = 0, 3
         centre(:) = [0.0_wp, 0.0_wp, radius - 1.0e-4_wp*step]
         call candidates%update_slack(0.0_wp, centre)
         call candidates%update(flat, centre, rebuilt)
         if (rebuilt) call nodes%reset()
         rows%count = 0
         call nodes%make_rows(candidates, flat, centre, rows)
         call active_facets%update(candidates, nodes, rows)
      end do
      call check(rows%count, 1, "the pole makes a row")
      call check(.not. any(active_facets%facet(:active_facets%count) == 1), &
         & "the first facet is not active")
      nodes%facet(rows%source(1)) = 1
      call active_facets%update(candidates, nodes, rows)
      call check(rows%count, 0, "its row on an inactive facet is removed")
      call check(any(active_facets%facet(:active_facets%count) == 1), &
         & "the facet is active in the next step")
      call check(any(active_facets%facet(:active_facets%count) == 2 + squares), &
         & "and its neighbours")
      call rows%add(1, 0.0_wp)
      call active_facets%update(candidates, nodes, rows)
      call check(rows%count, 1, "the row is kept")
   end subroutine check_jump

   !> Contact with the exact sphere sets its active facets itself
   subroutine check_taken()
      type(active_facets_type) :: active_facets

      call begin("set")
      call new_active_facets(active_facets, squares**2)
      call check(active_facets%is_all, "all are active at first")
      call active_facets%set([7, 5])
      call check(.not. active_facets%is_all, "then only some")
      call check(all(active_facets%facet(:active_facets%count) == [7, 5]), "those that were set")
   end subroutine check_taken

end program test_contact_search_active_facets
