!> Multipliers when every row has a point of its own: points of the plate against the exact sphere.
!>
!> Then A is diagonal but for the impactor's motion c, and given c every push follows alone:
!> p = max(0, -(g + n.c)/a) with a = n.M^-1 n of the point. What is left is the balance of the
!> impactor, c/w = sum of p n: the minimum of a convex function of three unknowns, quadratic in
!> pieces. Newton's method finds it in a few passes over the rows, however many there are.
module plydyn_contact_solve_diagonal_multiplier
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_constraint, only : add_motion, constraints_type
   implicit none
   private

   public :: is_separate, solve_separate

   !> Smallest inverse mass of a point, as a share of the impactor's, that leaves it free to move
   real(wp), parameter :: least_mobility = 1.0e-6_wp

   !> Steps of Newton's method before giving up
   integer, parameter :: most_steps = 100

   !> Step that is the last, as a share of the largest penetration
   real(wp), parameter :: last_step = 1.0e-14_wp

   !> Growth of a sum that may be round-off
   real(wp), parameter :: round_off = 1.0e-12_wp

contains

   !> Whether every row has a point of its own that can move along the normal
   pure logical function is_separate(rows, inverse_mass, impactor_inverse)
      !> The constraints
      type(constraints_type), intent(in) :: rows
      !> Of the surface points along x, y, z, (3, points), zero where held
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      !> Of the impactor along x, y, z, zero where held
      real(wp), intent(in) :: impactor_inverse(3)

      integer :: row

      is_separate = .false.
      if (size(rows%point, 1) > 1) return
      do row = 1, rows%count
         if (own_share(rows, row, inverse_mass) <= least_mobility*maxval(impactor_inverse)) return
      end do
      is_separate = .true.
   end function is_separate

   !> Find the pushes and the motion that they make
   pure subroutine solve_separate(rows, inverse_mass, impactor_inverse, motion, impactor_motion)
      !> The constraints; the pushes out
      type(constraints_type), intent(inout) :: rows
      !> Of the surface points along x, y, z, (3, points), zero where held
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      !> Of the impactor along x, y, z, zero where held
      real(wp), intent(in) :: impactor_inverse(3)
      !> Of the surface points, (3, points), length; zero in
      real(wp), contiguous, intent(inout) :: motion(:, :)
      !> Of the impactor, length
      real(wp), intent(out) :: impactor_motion(3)

      integer :: iteration, row
      real(wp) :: curve(3, 3), last, slope(3), step(3), trial(3), value

      trial(:) = 0.0_wp
      last = 0.5_wp*huge(1.0_wp)
      step(:) = huge(1.0_wp)
      do iteration = 1, most_steps
         call balance(rows, inverse_mass, impactor_inverse, trial, value, slope, curve)
         if (maxval(abs(step)) <= last_step*maxval(-rows%gap(:rows%count))) exit
         if (value > (1.0_wp + round_off)*last) then
            ! too far: go half of the way back
            step(:) = 0.5_wp*step
            trial(:) = trial - step
         else
            last = value
            step(:) = solve_definite(curve, slope)
            trial(:) = trial + step
         end if
      end do
      impactor_motion(:) = 0.0_wp
      do row = 1, rows%count
         call add_motion(rows, row, rows%push(row), inverse_mass, impactor_inverse, motion, &
            & impactor_motion)
      end do
   end subroutine solve_separate

   !> Pushes at a trial motion of the impactor, and how far that is from balance
   pure subroutine balance(rows, inverse_mass, impactor_inverse, trial, value, slope, curve)
      !> The constraints; the pushes out
      type(constraints_type), intent(inout) :: rows
      !> Of the surface points
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)
      !> Of the impactor
      real(wp), intent(in) :: impactor_inverse(3)
      !> Motion of the impactor, zero where held, length
      real(wp), intent(in) :: trial(3)
      !> Function that is least in balance
      real(wp), intent(out) :: value
      !> Its slope downhill, zero where held
      real(wp), intent(out) :: slope(3)
      !> Its second derivatives
      real(wp), intent(out) :: curve(3, 3)

      integer :: i, row
      real(wp) :: gap, share

      value = 0.0_wp
      slope(:) = 0.0_wp
      curve(:, :) = 0.0_wp
      do row = 1, rows%count
         share = own_share(rows, row, inverse_mass)
         gap = rows%gap(row) + dot_product(rows%normal(:, row), trial)
         rows%push(row) = max(0.0_wp, -gap/share)
         if (rows%push(row) <= 0.0_wp) cycle
         value = value + 0.5_wp*share*rows%push(row)**2
         slope(:) = slope + rows%push(row)*rows%normal(:, row)
         do i = 1, 3
            curve(:, i) = curve(:, i) + rows%normal(:, row)*rows%normal(i, row)/share
         end do
      end do
      do i = 1, 3
         if (impactor_inverse(i) > 0.0_wp) then
            value = value + 0.5_wp*trial(i)**2/impactor_inverse(i)
            slope(i) = slope(i) - trial(i)/impactor_inverse(i)
            curve(i, i) = curve(i, i) + 1.0_wp/impactor_inverse(i)
         else
            slope(i) = 0.0_wp
            curve(i, :) = 0.0_wp
            curve(:, i) = 0.0_wp
            curve(i, i) = 1.0_wp
         end if
      end do
   end subroutine balance

   !> What a unit push opens at the point of a row, length per mass and length
   pure real(wp) function own_share(rows, row, inverse_mass)
      !> The constraints
      type(constraints_type), intent(in) :: rows
      !> Which row
      integer, intent(in) :: row
      !> Of the surface points
      real(wp), contiguous, intent(in) :: inverse_mass(:, :)

      own_share = sum(inverse_mass(:, rows%point(1, row))*rows%normal(:, row)**2)
   end function own_share

   !> Solve a symmetric positive definite system
   pure function solve_definite(matrix, right) result(solution)
      !> The matrix
      real(wp), intent(in) :: matrix(3, 3)
      !> Right-hand side
      real(wp), intent(in) :: right(3)
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
