!> Rows from parts: the order of their keys decides the sum, and bands hold all rows once.
program test_parallel_owner_reduction
   use plydyn_base_precision, only : wp
   use plydyn_parallel_comm, only : comm_type
   use plydyn_parallel_owner_reduction, only : band_of, band_start, owner_reduction_type, &
      & new_owner_reduction
   use testing, only : begin, check, finish
   implicit none

   call bands()
   call sums()
   call finish()

contains

   !> Every row lies in one band
   subroutine bands()
      integer, parameter :: rows = 10
      integer :: i, r, ranks

      call begin("band_start")
      do ranks = 1, 13
         call check(band_start(rows, 0, ranks) == 0, "the first band begins with the first row")
         call check(band_start(rows, ranks, ranks) == rows, "the last ends with the last")
         do r = 1, ranks
            call check(band_start(rows, r, ranks) - band_start(rows, r - 1, ranks) &
               & <= (rows + ranks - 1)/ranks, "no band is longer than its share, rounded up")
            call check(all(band_of([(i, i=band_start(rows, r - 1, ranks) + 1, &
               & band_start(rows, r, ranks))], rows, ranks) == r - 1), "its rows are in it")
         end do
      end do
      call check(band_start(2000000000, 3, 4) == 1500000000, "many rows")
      call check(band_of(1500000001, 2000000000, 4) == 3, "and the first of a band of many")
   end subroutine bands

   !> 1 + 2**-53 - 1 is 0 and 1 - 1 + 2**-53 is not: the order shows
   subroutine sums()
      real(wp), parameter :: small = 0.5_wp**53
      integer, parameter :: row(5) = [2, 1, 2, 3, 2], key(5) = [3, 5, 1, 5, 2]
      type(owner_reduction_type) :: reduction
      real(wp) :: rows(2, 3), values(2, 5)

      call begin("add_up")
      reduction = new_owner_reduction(comm_type(), 3, row, key)
      call check(reduction%first == 0 .and. reduction%count == 3, "one rank has all rows")
      values(1, :) = [small, 7.0_wp, 1.0_wp, 9.0_wp, -1.0_wp]
      values(2, :) = [-1.0_wp, 1.0_wp, 1.0_wp, 2.0_wp, small]
      call reduction%sum(values, rows)
      call check(rows(1, :), [7.0_wp, small, 9.0_wp], 0.0_wp, "in the order of the keys")
      call check(rows(2, :), [1.0_wp, 0.0_wp, 2.0_wp], 0.0_wp, "whatever the values are")
      call begin("take_one")
      values(1, :) = [4.0_wp, 7.0_wp, 4.0_wp, 9.0_wp, 4.0_wp]
      values(2, :) = -values(1, :)
      call reduction%take_one(values, rows)
      call check(rows(1, :), [7.0_wp, 4.0_wp, 9.0_wp], 0.0_wp, "each row once")
      call check(rows(2, :), [-7.0_wp, -4.0_wp, -9.0_wp], 0.0_wp, "all of its numbers")
   end subroutine sums

end program test_parallel_owner_reduction
