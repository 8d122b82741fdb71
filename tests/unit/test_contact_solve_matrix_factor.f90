!> A Cholesky factor that grows and shrinks.
program test_contact_solve_matrix_factor
   use plydyn_base_precision, only : wp
   use plydyn_contact_solve_matrix, only : cholesky_factor_type
   use testing, only : begin, check, finish
   implicit none

   !> More rows than the first allocation has room for
   integer, parameter :: rows = 70

   real(wp), parameter :: round_off = 1.0e-12_wp

   real(wp) :: matrix(rows, rows)
   type(cholesky_factor_type) :: factor
   integer :: kept(rows), count, i, j

   do j = 1, rows
      do i = 1, rows
         matrix(i, j) = 1.0_wp/(1.0_wp + abs(i - j)) + merge(1.0_wp, 0.0_wp, i == j)
      end do
   end do

   call begin("fill with none")
   call factor%fill([integer ::], matrix, 0.0_wp)
   call check(factor%count, 0, "no rows yet")

   call begin("append")
   do i = 1, rows
      call factor%append(matrix(:i - 1, i), matrix(i, i), 0.0_wp)
      kept(i) = i
   end do
   count = rows
   call check_solution("all rows")

   call begin("fill")
   call factor%fill(kept, matrix, 0.0_wp)
   call check(factor%count, rows, "rows at once")
   call check_solution("all rows at once")
   kept(:11) = [7, 70, 3, 41, 12, 13, 14, 69, 2, 1, 30]
   count = 11
   call factor%fill(kept(:count), matrix, 0.0_wp)
   call check_solution("some rows in any order")
   kept(:) = [(i, i=1, rows)]
   count = rows
   call factor%fill(kept, matrix, 0.0_wp)

   call begin("remove")
   do i = 1, 50
      ! first, last and others in turn
      j = 1 + modulo(37*i, count)
      if (modulo(i, 3) == 0) j = 1
      if (modulo(i, 3) == 1) j = count
      call factor%remove(j)
      kept(j:count - 1) = kept(j + 1:count)
      count = count - 1
      call check(factor%count, count, "one row less")
      call check_solution("rows left")
   end do

   call begin("append after remove")
   do i = 1, 3
      call factor%append(matrix(kept(:count), 1), matrix(1, 1) + 1.0_wp, 0.0_wp)
      call factor%remove(count + 1)
   end do
   call check_solution("the same rows")

   call begin("least pivot")
   call factor%append(matrix(kept(:count), kept(1)), matrix(kept(1), kept(1)), 1.0e-12_wp)
   call check(factor%count, count + 1, "a row twice makes no trouble")
   call finish()

contains

   !> The factor solves with the rows it holds
   subroutine check_solution(what)
      !> Which rows
      character(*), intent(in) :: what

      real(wp) :: expected(count), vector(count)
      integer :: k

      expected(:) = [(sin(1.0_wp*k), k=1, count)]
      do k = 1, count
         vector(k) = dot_product(matrix(kept(:count), kept(k)), expected)
      end do
      call factor%solve(vector)
      call check(vector, expected, round_off, what)
   end subroutine check_solution

end program test_contact_solve_matrix_factor
