!> Threads of a step: who waits for contact, and who need not.
program test_method_thread_team
   use omp_lib, only : omp_set_num_threads
   use plydyn_base_error, only : error_type
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_thread_team, only : thread_team_type, inner, new_thread_team
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   type(domain_type) :: domain
   type(error_type), allocatable :: error

   ! 64 quads, 8 chunks
   call build_domain(rectangle_model(rectangle_mesh(2, 8, 8, 8.0d0, 8.0d0, 0.0d0), [0.0d0], &
      & 0.25d0, [1]), domain, error)
   call check_made()
   call check_gate(.false.)
   call check_gate(.true.)
   call finish()

contains

   !> What a chunk needs is there once all makers have made theirs
   subroutine check_made()
      type(thread_team_type) :: team
      integer :: c

      call begin("has_forces")
      call omp_set_num_threads(1)
      call new_thread_team(domain, team)
      call check(size(domain%chunks%list), 8, "there are chunks enough")
      do c = 2, 8
         call team%note_made(c)
      end do
      call check(team%has_forces([2, 8]), "these are made")
      call check(.not. team%has_forces([1, 2]), "one of these is not")
      call team%note_made(1)
      call check(team%has_forces([1, 2]), "now both are")
      call check(.not. team%has_forces([0, 1]), "those of other ranks never are")
      call team%note_moved(3)
      call check(team%has_moved(3) .and. .not. team%has_moved(4), "a chunk moves by itself")
      call team%begin(.false.)
      call check(.not. team%has_forces([2]), "none is in a new step")
      call check(.not. team%has_moved(3), "and none has moved")
   end subroutine check_made

   !> No chunk that waits is taken before contact is done; others are where not all wait
   subroutine check_gate(all_wait)
      logical, intent(in) :: all_wait

      type(thread_team_type) :: team
      logical :: is_done, early(8), waits(8)
      integer :: chunk, taken(8), threads

      call begin("await_contact")
      waits(:) = [.true., .false., .false., .true., .false., .false., .true., .false.]
      do threads = 1, 4
         call omp_set_num_threads(threads)
         call new_thread_team(domain, team)
         call team%let_wait(domain, waits)
         call team%begin(all_wait)
         is_done = .false.
         early(:) = .false.
         taken(:) = 0
         !$omp parallel default(shared) private(chunk)
         !$omp master
         call team%close()
         !$omp end master
         !$omp barrier
         !$omp master
         !$omp atomic write seq_cst
         is_done = .true.
         call team%open()
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
   end subroutine check_gate

end program test_method_thread_team
