!> Threads of a step: progress of chunks, and chunks that wait for contact.
program test_parallel_thread_team
   use omp_lib, only : omp_get_thread_num, omp_get_wtime, omp_set_num_threads
   use plydyn_base_precision, only : wp
   use plydyn_parallel_thread_team, only : thread_team_type, inner, new_thread_team
   use testing, only : begin, check, finish
   implicit none

   !> All chunks, none of which another rank needs
   integer, parameter :: order(8) = [1, 2, 3, 4, 5, 6, 7, 8]

   call check_progress()
   call check_waiting(.false.)
   call check_waiting(.true.)
   call check_beside()
   call finish()

contains

   !> The forces on a chunk are there once all chunks that add to them have theirs
   subroutine check_progress()
      type(thread_team_type) :: team
      integer :: c

      call begin("has_forces")
      call omp_set_num_threads(1)
      call new_thread_team(order, 0, team)
      do c = 2, 8
         call team%note_forces(c)
      end do
      call check(team%has_forces([2, 8]), "these are computed")
      call check(.not. team%has_forces([1, 2]), "one of these is not")
      call team%note_forces(1)
      call check(team%has_forces([1, 2]), "now both are")
      call check(.not. team%has_forces([0, 1]), "those of other ranks never count")
      call team%note_update(3)
      call check(team%has_update(3) .and. .not. team%has_update(4), "a chunk is updated by itself")
      call team%begin_step(.false.)
      call check(.not. team%has_forces([2]), "none is in a new step")
      call check(.not. team%has_update(3), "and none is updated")
   end subroutine check_progress

   !> No chunk that waits is taken before contact is done; others are where not all wait
   subroutine check_waiting(all_wait)
      logical, intent(in) :: all_wait

      type(thread_team_type) :: team
      logical :: is_done, early(8), waits(8)
      integer :: chunk, taken(8), threads

      call begin("wait_for_contact")
      waits(:) = [.true., .false., .false., .true., .false., .false., .true., .false.]
      do threads = 1, 4
         call omp_set_num_threads(threads)
         call new_thread_team(order, 0, team)
         call team%set_waiting(waits)
         call team%begin_step(all_wait)
         is_done = .false.
         early(:) = .false.
         taken(:) = 0
         !$omp parallel default(shared) private(chunk)
         !$omp master
         call team%expect_contact()
         !$omp end master
         !$omp barrier
         !$omp master
         !$omp atomic write seq_cst
         is_done = .true.
         call team%signal_contact()
         !$omp end master
         do
            chunk = team%take(inner)
            if (chunk == 0) exit
            !$omp atomic read seq_cst
            early(chunk) = is_done
            early(chunk) = .not. early(chunk)
            !$omp atomic
            taken(chunk) = taken(chunk) + 1
         end do
         !$omp end parallel
         call check(all(taken == 1), "every chunk is taken once")
         call check(.not. any(early .and. waits), "none that waits too early")
         call check(.not. (all_wait .and. any(early)), "none at all where all wait")
      end do
   end subroutine check_waiting

   !> Chunks that do not wait are taken while contact is under way
   subroutine check_beside()
      !> Longest wait for them, s
      real(wp), parameter :: patience = 20.0_wp
      type(thread_team_type) :: team
      logical :: waits(8)
      real(wp) :: begun
      integer :: beside, chunk, seen, taken

      call begin("take")
      waits(:) = [.true., .false., .false., .true., .false., .false., .true., .false.]
      call omp_set_num_threads(2)
      call new_thread_team(order, 0, team)
      call team%set_waiting(waits)
      call team%begin_step(.false.)
      beside = 0
      taken = 0
      !$omp parallel default(shared) private(begun, chunk, seen)
      !$omp master
      call team%expect_contact()
      !$omp end master
      !$omp barrier
      if (omp_get_thread_num() == 0) then
         begun = omp_get_wtime()
         do while (omp_get_wtime() < begun + patience)
            !$omp atomic read seq_cst
            seen = taken
            if (seen == count(.not. waits)) exit
         end do
         beside = seen
         call team%signal_contact()
      end if
      do
         chunk = team%take(inner)
         if (chunk == 0) exit
         !$omp atomic
         taken = taken + 1
      end do
      !$omp end parallel
      call check(beside, count(.not. waits), "gives the chunks that do not wait")
      call check(taken, size(waits), "and the others after contact")
   end subroutine check_beside

end program test_parallel_thread_team
