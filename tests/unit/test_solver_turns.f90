!> Turns of threads: every place once, and the own stretch first.
program test_solver_turns
   use omp_lib, only : omp_get_thread_num, omp_set_num_threads
   use plydyn_solver_turns, only : deal, turns_type
   use testing, only : begin, check, finish
   implicit none

   call check_alone()
   call check_together()
   call finish()

contains

   !> One thread after the other: the stretches are those of a static schedule, and what is left is
   !> taken by whoever asks
   subroutine check_alone()
      type(turns_type) :: turns
      integer :: i

      call begin("take")
      call omp_set_num_threads(3)
      call deal(turns, 4, 11)
      call check(turns%take(1), 7, "the second thread begins behind three places of the first")
      call check(turns%take(2), 10, "the third behind three of the second")
      call check(all([(turns%take(0), i=1, 3)] == [4, 5, 6]), "the first has the first places")
      call check(turns%take(0), 8, "then what the second has left")
      call check(turns%take(2), 11, "the third has one of its own left")
      call check(turns%take(2), 9, "and takes the last of all")
      call check(all([(turns%take(i), i=0, 2)] == 0), "nothing is left")
      call deal(turns, 4, 3)
      call check(turns%take(1), 0, "nothing was there")
   end subroutine check_alone

   !> All threads at once, for several numbers of them
   subroutine check_together()
      integer, parameter :: places = 1000
      type(turns_type) :: turns
      integer :: place, taken(places), threads

      call begin("deal")
      do threads = 1, 5
         call omp_set_num_threads(threads)
         taken(:) = 0
         call deal(turns, 1, places)
         !$omp parallel default(shared) private(place)
         do
            place = turns%take(omp_get_thread_num())
            if (place == 0) exit
            !$omp atomic
            taken(place) = taken(place) + 1
         end do
         !$omp end parallel
         call check(all(taken == 1), "every place is taken once")
      end do
   end subroutine check_together

end program test_solver_turns
