!> The ground of contact: no node presses beside it, and it is a small part of the face.
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

   !> A sphere that rolls and bounces over waves presses where it was said before the step
   subroutine check_rolling()
      type(active_facets_type) :: ground
      type(candidate_list_type) :: near
      type(node_set_type) :: nodes
      type(constraints_type) :: rows
      logical :: is_ground(squares**2), rebuilt
      real(wp) :: centre(3), position(3, points)
      integer :: found, presses, row, step, steps_with_ground

      call begin("follow")
      call set_ball(surface, flat, near, nodes, rows)
      call new_active_facets(ground, squares**2)
      presses = 0
      steps_with_ground = 0
      found = 0
      do step = 1, 2000
         position(:, :) = flat
         position(3, :) = 0.002_wp*sin(0.01_wp*step - flat(1, :))*cos(flat(2, :))
         centre(:) = [0.001_wp*step - 1.0_wp, 0.0_wp, radius + 0.03_wp*cos(0.004_wp*step)]
         is_ground(:) = ground%is_all
         is_ground(ground%facet(:ground%count)) = .true.
         call near%approach(0.001_wp, centre)
         call near%update(surface, position, centre, rebuilt)
         if (rebuilt) call nodes%forget()
         is_ground(:) = is_ground .or. rebuilt
         ground%is_all = ground%is_all .or. rebuilt
         rows%count = 0
         call nodes%collect(near%patch, near, position, centre, rows)
         do row = 1, rows%count
            call check(is_ground(nodes%facet(rows%source(row))), "nodes press on the ground")
         end do
         row = rows%count
         call ground%follow(surface, near%travel, nodes, rows)
         call check(rows%count, row, "no row is left out")
         presses = presses + rows%count
         if (ground%is_all) cycle
         steps_with_ground = steps_with_ground + 1
         found = found + ground%count
      end do
      call check(presses > 0, "nodes press")
      call check(steps_with_ground > 1900, "the ground is known in nearly all steps")
      call check(found < steps_with_ground*squares**2/2, "and small")
   end subroutine check_rolling

   !> A node that jumps presses one step later
   subroutine check_jump()
      type(active_facets_type) :: ground
      type(candidate_list_type) :: near
      type(node_set_type) :: nodes
      type(constraints_type) :: rows
      logical :: rebuilt
      real(wp) :: centre(3)
      integer :: step

      call begin("drop")
      call set_ball(surface, flat, near, nodes, rows)
      call new_active_facets(ground, squares**2)
      do step = 0, 3
         centre(:) = [0.0_wp, 0.0_wp, radius - 1.0e-4_wp*step]
         call near%approach(0.0_wp, centre)
         call near%update(surface, flat, centre, rebuilt)
         if (rebuilt) call nodes%forget()
         rows%count = 0
         call nodes%collect(near%patch, near, flat, centre, rows)
         call ground%follow(surface, near%travel, nodes, rows)
      end do
      call check(rows%count, 1, "the pole presses")
      call check(.not. any(ground%facet(:ground%count) == 1), "far from the first facet")
      nodes%facet(rows%source(1)) = 1
      call ground%follow(surface, near%travel, nodes, rows)
      call check(rows%count, 0, "a node that is there all of a sudden does not press")
      call check(any(ground%facet(:ground%count) == 1), "but in the next step it may")
      call check(any(ground%facet(:ground%count) == 2 + squares), "and around there")
      call rows%add(1, 0.0_wp)
      call ground%follow(surface, near%travel, nodes, rows)
      call check(rows%count, 1, "and does")
   end subroutine check_jump

   !> Other contacts say themselves what their ground is
   subroutine check_taken()
      type(active_facets_type) :: ground

      call begin("take")
      call new_active_facets(ground, squares**2)
      call check(ground%is_all, "nothing is known at first")
      call ground%take([7, 5])
      call check(.not. ground%is_all, "then it is")
      call check(all(ground%facet(:ground%count) == [7, 5]), "what was given")
   end subroutine check_taken

end program test_contact_search_active_facets
