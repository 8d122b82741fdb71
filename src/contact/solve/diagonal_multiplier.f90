!> Multipliers of rows with one point each: points of the plate against the exact impactor.
!>
!> For a given displacement c of the impactor the rows are independent: p = max(0, -(g + n.c)/a)
!> with the compliance a = n.M^-1 n of the point. The balance of momentum of the impactor with the
!> inverse mass w, c/w = sum of p n, is the minimum of a convex, piecewise quadratic function of
!> three unknowns. Newton's method with step halving finds it in a few passes over the rows.
module plydyn_contact_solve_diagonal_multiplier
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : add_force, constraints_type, correction_type
   implicit none
   private

   public :: is_diagonal, solve_diagonal

   !> Smallest inverse mass of a free point over that of the impactor
   real(wp), parameter :: least_mobility = 1.0e-6_wp

   !> Most steps of Newton's method
   integer, parameter :: max_steps = 100

   !> Largest step at convergence over the largest penetration
   real(wp), parameter :: last_step = 1.0e-14_wp

   !> Relative increase of the objective that may be round-off
   real(wp), parameter :: round_off = 1.0e-12_wp

contains

   !> Whether the point of every row is free to move along the normal
   pure logical function is_diagonal(rows, inverse_mass)
      type(constraints_type), intent(in) :: rows
      !> Inverse mass of the surface points along x, y, z, (3, points), zero where held
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)

      integer :: row

      is_diagonal = .false.
      do row = 1, rows%count
         if (compliance(rows, row, inverse_mass) &
            & <= least_mobility*maxval(rows%impactor_inverse)) return
      end do
      is_diagonal = .true.
   end function is_diagonal

   !> Find multipliers and displacement corrections
   pure subroutine solve_diagonal(rows, inverse_mass, correction)
      !> The constraints; the multipliers out
      type(constraints_type), intent(inout) :: rows
      !> As in `is_diagonal`
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      !> Zero in
      type(correction_type), intent(inout) :: correction

      integer :: iteration, row
      real(wp) :: hessian(3, 3), last, descent(3), step(3), trial(3), objective

      trial(:) = 0.0_wp
      last = 0.5_wp*huge(1.0_wp)
      step(:) = huge(1.0_wp)
      do iteration = 1, max_steps
         call evaluate(rows, inverse_mass, trial, objective, descent, hessian)
         if (maxval(abs(step)) <= last_step*maxval(-rows%gap(:rows%count))) exit
         if (objective > (1.0_wp + round_off)*last) then
            ! the objective increased: halve the step
            step(:) = 0.5_wp*step
            trial(:) = trial - step
         else
            last = objective
            step(:) = solve_definite(hessian, descent)
            trial(:) = trial + step
         end if
      end do
      do row = 1, rows%count
         call add_force(rows, row, rows%multiplier(row)*rows%normal(:, row), inverse_mass, &
            & correction)
      end do
   end subroutine solve_diagonal

   !> Multipliers at a trial displacement of the impactor; objective with its derivatives
   pure subroutine evaluate(rows, inverse_mass, trial, objective, descent, hessian)
      !> The constraints; the multipliers out
      type(constraints_type), intent(inout) :: rows
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      !> Displacement of the impactor, zero where held, length
      real(wp), intent(in) :: trial(3)
      !> Function with its minimum at the balance of momentum
      real(wp), intent(out) :: objective
      !> Its negative gradient, zero where held
      real(wp), intent(out) :: descent(3)
      real(wp), intent(out) :: hessian(3, 3)

      integer :: i, row
      real(wp) :: gap, own_compliance

      objective = 0.0_wp
      descent(:) = 0.0_wp
      hessian(:, :) = 0.0_wp
      do row = 1, rows%count
         own_compliance = compliance(rows, row, inverse_mass)
         gap = rows%gap(row) + dot_product(rows%normal(:, row), trial)
         rows%multiplier(row) = max(0.0_wp, -gap/own_compliance)
         if (rows%multiplier(row) <= 0.0_wp) cycle
         objective = objective + 0.5_wp*own_compliance*rows%multiplier(row)**2
         descent(:) = descent + rows%multiplier(row)*rows%normal(:, row)
         do i = 1, 3
            hessian(:, i) = hessian(:, i) + rows%normal(:, row)*rows%normal(i, row)/own_compliance
         end do
      end do
      do i = 1, 3
         associate (inverse => rows%impactor_inverse(i))
            if (inverse > 0.0_wp) then
               objective = objective + 0.5_wp*trial(i)**2/inverse
               descent(i) = descent(i) - trial(i)/inverse
               hessian(i, i) = hessian(i, i) + 1.0_wp/inverse
            else
               descent(i) = 0.0_wp
               hessian(i, :) = 0.0_wp
               hessian(:, i) = 0.0_wp
               hessian(i, i) = 1.0_wp
            end if
         end associate
      end do
   end subroutine evaluate

   !> Gap change by a unit multiplier at the point of a row, one over mass
   pure real(wp) function compliance(rows, row, inverse_mass)
      type(constraints_type), intent(in) :: rows
      integer, intent(in) :: row
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)

      compliance = sum(inverse_mass(:, rows%point(1, row))*rows%normal(:, row)**2)
   end function compliance

   !> Solve a symmetric positive definite system
   pure function solve_definite(matrix, right) result(solution)
      real(wp), intent(in) :: matrix(3, 3), right(3)
      real(wp) :: solution(3)

      real(wp) :: a(3, 3)
      integer :: i, j

      a(:, :) = matrix
      solution(:) = right
      do j = 1, 2
         do i = j + 1, 3
            solution(i) = solution(i) - a(i, j)/a(j, j)*solution(j)
            a(i, j + 1:) = a(i, j + 1:) - a(i, j)/a(j, j)*a(j, j + 1:)
         end do
      end do
      solution(3) = solution(3)/a(3, 3)
      solution(2) = (solution(2) - a(2, 3)*solution(3))/a(2, 2)
      solution(1) = (solution(1) - a(1, 2)*solution(2) - a(1, 3)*solution(3))/a(1, 1)
   end function solve_definite

end module plydyn_contact_solve_diagonal_multiplier
