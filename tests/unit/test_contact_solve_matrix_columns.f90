!> Gap changes by a unit multiplier: the columns of G M^-1 G^T.
program test_contact_solve_matrix_columns
   use plydyn_base_precision, only : lanes, wp
   use plydyn_contact_solve_constraint, only : constraints_type, correction_type, &
      & new_constraints, new_correction
   use plydyn_contact_solve_matrix, only : coupling_type
   use testing, only : begin, check, finish
   implicit none

   !> Points of the surface, and of a row
   integer, parameter :: points = 20, row_points = 4

   real(wp), parameter :: round_off = 1.0e-13_wp

   !> Guided along z
   real(wp), parameter :: impactor_inverse(3) = [0.0_wp, 0.0_wp, 0.3_wp]

   type(coupling_type) :: coupling
   real(wp) :: inverse_mass(3, points)
   integer :: k

   ! some points are held along x, and one along all
   inverse_mass(:, :) = spread([(1.0_wp + modulo(7*k, 5), k=1, points)], 1, 3)
   inverse_mass(1, ::3) = 0.0_wp
   inverse_mass(:, 5) = 0.0_wp
   call check_rows(1)
   call check_rows(lanes)
   ! more than there is room for at first, and then fewer
   call check_rows(70)
   call check_rows(lanes + 1)
   call finish()

contains

   !> Every column is that of the product of the matrices in full
   subroutine check_rows(count)
      integer, intent(in) :: count

      type(constraints_type) :: rows
      type(correction_type) :: correction
      real(wp) :: full(count, count), gradient(count, 3*points)
      real(wp), allocatable :: column(:)
      integer :: c, i, row

      call begin("find_column")
      call new_constraints(rows, row_points)
      rows%impactor_inverse(:) = impactor_inverse
      gradient(:, :) = 0.0_wp
      do row = 1, count
         call rows%add(row, 0.0_wp)
         ! rows have some points in common
         rows%point(:, row) = [(1 + modulo(3*row + 2*i, points), i=1, row_points)]
         rows%weight(:, row) = [(sin(1.3_wp*row + i), i=1, row_points)]
         rows%normal(:, row) = [0.6_wp*cos(1.0_wp*row), 0.6_wp*sin(1.0_wp*row), 0.8_wp]
         do i = 1, row_points
            do c = 1, 3
               gradient(row, 3*rows%point(i, row) - 3 + c) = rows%weight(i, row)*rows%normal(c, row)
            end do
         end do
      end do
      full(:, :) = matmul(gradient*spread(reshape(inverse_mass, [3*points]), 1, count), &
         & transpose(gradient))
      full(:, :) = full + matmul(transpose(rows%normal(:, :count)) &
         & *spread(impactor_inverse, 1, count), rows%normal(:, :count))
      call new_correction(correction, points)
      call correction%list_points(rows)
      call coupling%set_rows(rows, inverse_mass, correction)
      call check(modulo(coupling%rows, lanes) == 0 .and. coupling%rows >= count, "whole vectors")
      allocate (column(coupling%rows))
      do row = 1, count
         call coupling%find_column(rows, row, column)
         call check(column(:count), full(:, row), round_off, "a column")
         call check(all(abs(column(count + 1:)) <= 0.0_wp), "nothing behind the last row")
      end do
   end subroutine check_rows

end program test_contact_solve_matrix_columns
