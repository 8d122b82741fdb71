!> Sorting.
program test_base_sort
   use plydyn_base_sort, only : sorted_order
   use testing, only : begin, check, finish
   implicit none

   integer :: i

   call begin("sorted_order")
   call check(all(sorted_order([3, 1, 2]) == [2, 3, 1]), "puts keys in rising order")
   call check(all(sorted_order([2, 1, 2, 1, 2]) == [2, 4, 1, 3, 5]), "equal keys keep theirs")
   call check(size(sorted_order([integer ::])), 0, "takes no keys")
   call check(all(sorted_order([(7 - i, i=1, 6)]) == [6, 5, 4, 3, 2, 1]), "turns them round")
   call finish()
end program test_base_sort
