!> Multipliers are never negative.
program test_contact_solve_multiplier
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : add_force, constraints_type, correction_type, &
      & gap_change, new_constraints, new_correction
   use plydyn_contact_solve_matrix, only : cholesky_factor_type
   use plydyn_contact_solve_multiplier, only : active_set_type
   use plydyn_contact_solve_diagonal_multiplier, only : is_diagonal, solve_diagonal
   use plydyn_fem_shape, only : biquadratic_nodes, local_nodes, shape_functions
   use testing, only : begin, check, finish
   implicit none

   !> Masses of the points of a facet: corners, mid-sides and centre as 1 to 4 to 16
   real(wp), parameter :: inverse(9) = &
      & [36.0_wp, 36.0_wp, 36.0_wp, 36.0_wp, 9.0_wp, 9.0_wp, 9.0_wp, 9.0_wp, 2.25_wp]

   !> Impactor of 50 facets' mass
   real(wp), parameter :: impactor_inverse(3) = 0.02_wp

   call check_against_all_subsets()
   call check_flat_punch()
   call check_round_punch()
   call check_held()
   call check_separate()
   call finish()

contains

   !> Of all sets of rows that may press, the one found is the one that solves the problem
   subroutine check_against_all_subsets()
      integer, parameter :: count = 6, problems = 40
      type(constraints_type) :: rows
      real(wp) :: expected(count), motion(3, 9), impactor(3), place(2)
      integer :: k, problem, row

      call begin("solve_unilateral, all subsets")
      do problem = 1, problems
         call new_constraints(rows, biquadratic_nodes)
         do row = 1, count
            k = count*problem + row
            place(:) = [sin(12.9898_wp*k), sin(78.233_wp*k)]
            call add_facet_row(rows, place, [0.3_wp*sin(3.7_wp*k), 0.3_wp*cos(5.1_wp*k), 1.0_wp], &
               & -0.01_wp*(1.0_wp + sin(7.3_wp*k)))
         end do
         expected(:) = subset_solution(rows)
         call solve(rows, motion, impactor)
         call check(rows%multiplier(:count), expected, 1.0e-9_wp*maxval(expected), "multipliers")
      end do
   end subroutine check_against_all_subsets

   !> A flat punch with 400 nodes on nine points moves all as one body, as nine nodes do
   subroutine check_flat_punch()
      integer, parameter :: along = 20
      real(wp), parameter :: depth = 1.0e-3_wp
      type(constraints_type) :: many, nine
      real(wp) :: motion(3, 9), impactor(3), motion_nine(3, 9), impactor_nine(3), node(2, 9)
      real(wp) :: mass
      integer :: i, j

      call begin("solve_unilateral, redundant flat punch")
      call new_constraints(many, biquadratic_nodes)
      call new_constraints(nine, biquadratic_nodes)
      do j = 0, along - 1
         do i = 0, along - 1
            call add_facet_row(many, [2.0_wp*i, 2.0_wp*j]/(along - 1) - 1.0_wp, &
               & [0.0_wp, 0.0_wp, 1.0_wp], -depth)
         end do
      end do
      node(:, :) = local_nodes(biquadratic_nodes)
      do i = 1, 9
         call add_facet_row(nine, node(:, i), [0.0_wp, 0.0_wp, 1.0_wp], -depth)
      end do
      call solve(many, motion, impactor)
      call solve(nine, motion_nine, impactor_nine)
      ! both bodies move in inverse proportion to their masses
      mass = sum(1.0_wp/inverse)
      call check_complementarity(many, motion, impactor)
      call check(impactor(3), depth*mass/(mass + 1.0_wp/impactor_inverse(3)), 1.0e-9_wp*depth, &
         & "the impactor rises")
      call check(motion_nine(3, :), spread(impactor_nine(3) - depth, 1, 9), 1.0e-9_wp*depth, &
         & "the facet sinks as a whole under nine nodes")
      call check(motion(3, :), motion_nine(3, :), 1.0e-9_wp*depth, "400 nodes do as nine")
   end subroutine check_flat_punch

   !> A round punch with 400 nodes: complementary, and the nodes that press do it alone
   subroutine check_round_punch()
      integer, parameter :: along = 20
      type(constraints_type) :: many, few
      real(wp) :: motion(3, 9), impactor(3), motion_few(3, 9), impactor_few(3), place(2)
      integer :: i, j, row

      call begin("solve_unilateral, redundant round punch")
      call new_constraints(many, biquadratic_nodes)
      call new_constraints(few, biquadratic_nodes)
      do j = 0, along - 1
         do i = 0, along - 1
            place(:) = [2.0_wp*i, 2.0_wp*j]/(along - 1) - 1.0_wp
            call add_facet_row(many, place, [-0.1_wp*place, 1.0_wp], &
               & 0.01_wp*(dot_product(place, place) - 2.1_wp))
         end do
      end do
      call solve(many, motion, impactor)
      call check_complementarity(many, motion, impactor)
      do row = 1, many%count
         if (many%multiplier(row) <= 0.0_wp) cycle
         call few%add(row, 0.0_wp)
         few%point(:, few%count) = many%point(:, row)
         few%weight(:, few%count) = many%weight(:, row)
         few%normal(:, few%count) = many%normal(:, row)
         few%gap(few%count) = many%gap(row)
      end do
      call check(few%count <= 30, "no more rows press than there are unknowns")
      call solve(few, motion_few, impactor_few)
      call check(maxval(abs(motion_few - motion)), 0.0_wp, 1.0e-9_wp*maxval(abs(motion)), &
         & "the same motion of the points")
      call check(impactor_few, impactor, 1.0e-9_wp*maxval(abs(impactor)), "and of the impactor")
   end subroutine check_round_punch

   !> Against held points the impactor alone gives way; what cannot be opened is left
   subroutine check_held()
      type(constraints_type) :: rows
      type(active_set_type) :: active_set
      type(correction_type) :: found

      call begin("solve_unilateral, held")
      call new_constraints(rows, biquadratic_nodes)
      rows%impactor_inverse(:) = [0.0_wp, 0.0_wp, 0.5_wp]
      call new_correction(found, 9)
      call add_facet_row(rows, [0.2_wp, 0.1_wp], [0.0_wp, 0.0_wp, 1.0_wp], -0.01_wp)
      call add_facet_row(rows, [0.9_wp, 0.1_wp], [1.0_wp, 0.0_wp, 0.0_wp], -0.02_wp)
      call found%list_points(rows)
      call active_set%solve_unilateral(rows, spread(spread(0.0_wp, 1, 3), 2, 9), found)
      call check(found%impactor, [0.0_wp, 0.0_wp, 0.01_wp], 1.0e-12_wp, "a guided impactor rises")
      call check(maxval(abs(found%displacement)), 0.0_wp, 0.0_wp, "held points stay")
      call check(rows%multiplier(:2), [0.02_wp, 0.0_wp], 1.0e-12_wp, "only along the guide")
   end subroutine check_held

   !> Points against the exact sphere: the method for separate rows agrees with the active set
   subroutine check_separate()
      integer, parameter :: count = 40
      type(constraints_type) :: rows, same
      type(active_set_type) :: active_set
      type(correction_type) :: found, found_same
      real(wp) :: inverse_mass(3, count), free(3)
      integer :: row, guided

      call begin("solve_separate")
      do row = 1, count
         inverse_mass(:, row) = [1.0_wp, 1.5_wp, 2.0_wp]*(2.0_wp + sin(1.0_wp*row))
      end do
      do guided = 0, 1
         free(:) = [1 - guided, 1 - guided, 1]*0.7_wp
         call new_constraints(rows, 1)
         call new_constraints(same, 1)
         rows%impactor_inverse(:) = free
         same%impactor_inverse(:) = free
         call new_correction(found, count)
         call new_correction(found_same, count)
         do row = 1, count
            call add_point_row(rows, row)
            call add_point_row(same, row)
         end do
         call check(is_diagonal(rows, inverse_mass), "every row has its point")
         call solve_diagonal(rows, inverse_mass, found)
         call found_same%list_points(same)
         call active_set%solve_unilateral(same, inverse_mass, found_same)
         call check(count_pressing(rows) < count, "some points come free")
         call check(found%impactor, found_same%impactor, 1.0e-9_wp*maxval(abs(found%impactor)), &
            & "the impactor")
         call check(maxval(abs(found%displacement - found_same%displacement)), 0.0_wp, &
            & 1.0e-9_wp*maxval(abs(found%displacement)), "the points")
         call check(rows%multiplier(:count), same%multiplier(:count), &
            & 1.0e-9_wp*maxval(rows%multiplier), &
            & "multipliers")
      end do
      inverse_mass(:, 3) = 0.0_wp
      call check(.not. is_diagonal(rows, inverse_mass), "a held point is another matter")
   end subroutine check_separate

   !> Number of rows that press
   integer function count_pressing(rows)
      !> The constraints
      type(constraints_type), intent(in) :: rows

      count_pressing = count(rows%multiplier(:rows%count) > 0.0_wp)
   end function count_pressing

   !> A point in a sphere, row by row around it
   subroutine add_point_row(rows, row)
      !> The constraints
      type(constraints_type), intent(inout) :: rows
      !> Which row, and which point
      integer, intent(in) :: row

      call rows%add(row, 0.0_wp)
      rows%point(1, row) = row
      rows%weight(1, row) = 1.0_wp
      rows%normal(:, row) = [0.5_wp*sin(2.0_wp*row), 0.4_wp*cos(1.3_wp*row), 1.0_wp]
      rows%normal(:, row) = rows%normal(:, row)/norm2(rows%normal(:, row))
      rows%gap(row) = -1.0e-3_wp*(1.0_wp + sin(0.7_wp*row))
   end subroutine add_point_row

   !> A contact node over the facet
   subroutine add_facet_row(rows, place, direction, gap)
      !> The constraints
      type(constraints_type), intent(inout) :: rows
      !> Place in the facet
      real(wp), intent(in) :: place(2)
      !> Along the normal, any length
      real(wp), intent(in) :: direction(3)
      !> Gap
      real(wp), intent(in) :: gap

      real(wp) :: slope(2, 9)
      integer :: i, row

      call rows%add(rows%count + 1, 0.0_wp)
      row = rows%count
      rows%point(:, row) = [(i, i=1, 9)]
      call shape_functions(9, place(1), place(2), rows%weight(:, row), slope)
      rows%normal(:, row) = direction/norm2(direction)
      rows%gap(row) = gap
   end subroutine add_facet_row

   !> Solve with a fresh active set
   subroutine solve(rows, motion, impactor)
      !> The constraints
      type(constraints_type), intent(inout) :: rows
      !> Of the points and of the impactor
      real(wp), intent(out) :: motion(3, 9), impactor(3)

      type(active_set_type) :: active_set
      type(correction_type) :: found

      rows%impactor_inverse(:) = impactor_inverse
      call new_correction(found, 9)
      call found%list_points(rows)
      call active_set%solve_unilateral(rows, spread(inverse, 1, 3), found)
      motion(:, :) = found%displacement
      impactor(:) = found%impactor
   end subroutine solve

   !> Nothing pulls, nothing penetrates, and what presses is closed
   subroutine check_complementarity(rows, motion, impactor)
      !> The constraints with their solution
      type(constraints_type), intent(in) :: rows
      !> Of the points and of the impactor
      real(wp), intent(in) :: motion(3, 9), impactor(3)

      type(correction_type) :: found
      real(wp) :: gap(rows%count), small
      integer :: row

      call new_correction(found, 9)
      found%impactor(:) = impactor
      found%displacement(:, :) = motion
      gap(:) = [(rows%gap(row) + gap_change(rows, row, found), row=1, rows%count)]
      small = 1.0e-9_wp*maxval(-rows%gap(:rows%count))
      call check(minval(rows%multiplier(:rows%count)) >= 0.0_wp, "nothing pulls")
      call check(minval(gap) >= -small, "nothing penetrates")
      call check(maxval(gap, mask=rows%multiplier(:rows%count) > 0.0_wp), 0.0_wp, small, &
         & "what presses is closed")
   end subroutine check_complementarity

   !> Pushes of the one subset that neither pulls nor leaves a penetration
   function subset_solution(rows) result(multiplier)
      !> The constraints
      type(constraints_type), intent(in) :: rows
      real(wp) :: multiplier(rows%count)

      type(constraints_type) :: same
      type(correction_type) :: found
      real(wp) :: matrix(rows%count, rows%count), part(rows%count)
      integer :: i, j, n, set, member(rows%count)
      type(cholesky_factor_type) :: factor

      same = rows
      same%impactor_inverse(:) = impactor_inverse
      do j = 1, rows%count
         call new_correction(found, 9)
         call add_force(same, j, rows%normal(:, j), spread(inverse, 1, 3), found)
         matrix(:, j) = [(gap_change(rows, i, found), i=1, rows%count)]
      end do
      do set = 0, 2**rows%count - 1
         n = 0
         factor%count = 0
         do i = 1, rows%count
            if (.not. btest(set, i - 1)) cycle
            call factor%append(matrix(member(:n), i), matrix(i, i), 0.0_wp)
            n = n + 1
            member(n) = i
         end do
         part(:n) = -rows%gap(member(:n))
         call factor%solve(part(:n))
         multiplier(:) = 0.0_wp
         multiplier(member(:n)) = part(:n)
         if (all(multiplier >= 0.0_wp) .and. &
            & all(rows%gap(:rows%count) + matmul(matrix, multiplier) >= -1.0e-12_wp)) return
      end do
   end function subset_solution

end program test_contact_solve_multiplier
