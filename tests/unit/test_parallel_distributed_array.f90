!> What bands one rank alone has; `tests/parallel` brings pieces to those of several.
program test_parallel_distributed_array
   use plydyn_parallel_comm, only : comm_type
   use plydyn_parallel_distributed_array, only : new_distributed_array, distributed_array_type
   use testing, only : begin, check, finish
   implicit none

   type(distributed_array_type) :: pieces

   call begin("new_distributed_array")
   pieces = new_distributed_array(comm_type(), 10, reshape([1, 1, 10], [3, 1]))
   call check(pieces%whole == 10 .and. pieces%first == 0 .and. pieces%count == 10, &
      & "one rank has the whole array")
   pieces = new_distributed_array(comm_type(), 0, reshape([integer ::], [3, 0]))
   call check(pieces%whole == 0 .and. pieces%count == 0, "also of no length")
   call finish()
end program test_parallel_distributed_array
