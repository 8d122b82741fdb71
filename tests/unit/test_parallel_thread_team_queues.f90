!> Work queues: every chunk once, the own range first, and chunks that wait not too early.
program test_parallel_thread_team_queues
   use omp_lib, only : omp_get_thread_num, omp_set_num_threads
   use plydyn_parallel_thread_team, only : work_queue_type
   use testing, only : begin, check, finish
   implicit none

   call check_alone()
   call check_backward()
   call check_waiting()
   call check_together()
   call finish()

contains

   !> One thread after the other: the ranges are those of a static schedule, and what is left is
   !> taken by any thread
   subroutine check_alone()
      type(work_queue_type) :: none, queue
      logical :: waits(11)
      integer :: i

      call begin("take")
      waits(:) = .false.
      call queue%arrange([(i, i=4, 11)], waits, 3)
      call queue%begin(.false.)
      call check(all([(queue%own(1, i), i=1, 4)] == [7, 8, 9, 0]), "a range has its end")
      call check(queue%take(1, .true.), 7, "the second thread begins behind three of the first")
      call check(queue%take(2, .true.), 10, "the third behind three of the second")
      call check(all([(queue%take(0, .true.), i=1, 3)] == [4, 5, 6]), "the first has the first")
      call check(queue%take(0, .true.), 8, "then what the second has left")
      call check(queue%take(2, .true.), 11, "the third has one of its own left")
      call check(queue%take(2, .true.), 9, "and takes the last of all")
      call check(all([(queue%take(i, .true.), i=0, 2)] == 0), "nothing is left")
      call queue%begin(.false.)
      call check(queue%take(1, .true.), 7, "all begins anew")
      call none%arrange([integer ::], waits, 3)
      call none%begin(.false.)
      call check(none%take(1, .true.), 0, "nothing was there")
   end subroutine check_alone

   !> Backward, every range begins with its end
   subroutine check_backward()
      type(work_queue_type) :: queue
      logical :: waits(7)
      integer :: i

      call begin("backward")
      waits(:) = [.false., .false., .true., .false., .false., .false., .false.]
      call queue%arrange([(i, i=1, 7)], waits, 2)
      call queue%begin(.true.)
      call check(all([(queue%own(0, i), i=1, 5)] == [4, 2, 1, 3, 0]), "the order is turned round")
      call check(all([(queue%take(0, .false.), i=1, 4)] == [4, 2, 1, 7]), &
         & "from the end on, then the end of the others")
      call check(all([(queue%take(1, .true.), i=1, 3)] == [6, 5, 3]), "what waited is still left")
      call check(queue%take(0, .true.), 0, "nothing is left")
   end subroutine check_backward

   !> Chunks that wait are passed over, and then come first in their range
   subroutine check_waiting()
      type(work_queue_type) :: queue
      logical :: waits(6)
      integer :: i

      call begin("arrange")
      waits(:) = [.false., .true., .true., .false., .true., .false.]
      call queue%arrange([(i, i=1, 6)], waits, 2)
      call queue%begin(.false.)
      call check(all([(queue%own(0, i), i=1, 3)] == [2, 3, 1]), "what waits is first in a range")
      call check(all([(queue%take(1, .false.), i=1, 4)] == [4, 6, 1, 0]), "it is passed over")
      call check(all([(queue%take(0, .true.), i=1, 4)] == [2, 3, 5, 0]), "until it need not wait")
      call queue%begin(.false.)
      call check(all([(queue%take(0, .true.), i=1, 3)] == [2, 3, 1]), "then it is first")
   end subroutine check_waiting

   !> All threads at once, for several numbers of them
   subroutine check_together()
      integer, parameter :: chunks = 1000
      type(work_queue_type) :: queue(5)
      logical :: waits(chunks)
      integer :: chunk, i, taken(chunks), threads

      call begin("begin")
      waits(:) = [(mod(i, 7) == 0, i=1, chunks)]
      do threads = 1, 5
         call omp_set_num_threads(threads)
         taken(:) = 0
         call queue(threads)%arrange([(i, i=1, chunks)], waits, threads)
         call queue(threads)%begin(.false.)
         !$omp parallel default(shared) private(chunk)
         do
            chunk = queue(threads)%take(omp_get_thread_num(), .true.)
            if (chunk == 0) exit
            !$omp atomic
            taken(chunk) = taken(chunk) + 1
         end do
         !$omp end parallel
         call check(all(taken == 1), "every chunk is taken once")
      end do
   end subroutine check_together

end program test_parallel_thread_team_queues
