!> What one rank does for all: nothing is lost, and nothing else is taken for known.
program test_parallel_comm
   use plydyn_base_precision, only : wp
   use plydyn_parallel_comm, only : comm_type
   use testing, only : begin, check, finish
   implicit none

   type(comm_type) :: comm
   logical :: good
   real(wp) :: largest, values(3)
   integer :: number, place(2)

   call begin("unite")
   values(:) = [-0.0_wp, 0.1_wp, 7.0_wp]
   call comm%merge(3, [.true., .true., .false.], values)
   call check(sign(1.0_wp, values(1)) < 0.0_wp, "the sign of a zero is kept")
   call check(values(2), 0.1_wp, 0.0_wp, "so is the last bit")
   call check(values(3), 0.0_wp, 0.0_wp, "what no rank knows is zero")

   call begin("all_true")
   good = .true.
   call comm%all_true(good)
   call check(good, "all is well")
   good = .false.
   call comm%all_true(good)
   call check(.not. good, "something is not")

   call begin("keep_largest")
   largest = -0.1_wp
   number = 7
   place(:) = [2, 3]
   call comm%keep_largest(largest, number, place)
   call check(largest, -0.1_wp, 0.0_wp, "is its own, to the last bit")
   call check(all([number, place] == [7, 2, 3]), "with what has it, and where")

   call finish()
end program test_parallel_comm
