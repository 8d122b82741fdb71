!> Accelerations: forces of plies, interfaces and loads over the masses (the paper's eq. 6).
module plydyn_method_accelerations
   use omp_lib, only : omp_get_thread_num
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_thread_team, only : thread_team_type, inner, new_thread_team
   use plydyn_method_forces, only : add_borders, add_loads, await_forces, find_internal_forces, &
      & make_chunk_forces, make_outer_forces, push_messages_on
   use plydyn_method_central_difference, only : accelerate, accelerate_chunk, count_sums
   use plydyn_method_supports, only : hold_points, hold_supports, resist_columns
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: begin_accelerations, can_go_ahead, count_accelerations, find_accelerations

contains

   !> Accelerations before the first step, or after one that was made before
   subroutine begin_accelerations(domain, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Accelerations, and what is counted of them
      type(state_type), intent(inout) :: state

      type(thread_team_type) :: team

      call new_thread_team(domain, team)
      !$omp parallel default(shared)
      call find_accelerations(domain, team, state%step_before, state)
      !$omp end parallel
      call count_accelerations(domain, state)
   end subroutine begin_accelerations

   !> Whether a chunk has all that its points need, once the forces of its own are there
   pure logical function can_go_ahead(domain)
      !> The domain
      type(domain_type), intent(in) :: domain

      can_go_ahead = size(domain%loads) + size(domain%supports%motions) &
         & + size(domain%inertia%far_ties) == 0
   end function can_go_ahead

   !> Accelerations of all points, by all threads together
   subroutine find_accelerations(domain, team, step, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The threads, which have begun
      type(thread_team_type), intent(inout) :: team
      !> The step just made
      real(wp), intent(in) :: step
      !> Accelerations, and the sums over the points of each chunk
      type(state_type), intent(inout) :: state

      associate (u => state%displacement, v => state%velocity, force => state%acceleration)
         if (can_go_ahead(domain)) then
            call make_outer_forces(domain, team, step, u, v, state%history, force)
            call make_and_move(domain, team, step, state)
            call await_forces(domain, team, force)
            call move_rest(domain, team, step, state)
         else
            call find_internal_forces(domain, team, step, u, v, state%history, force)
            call add_loads(domain, state%time, state%load_factor, force)
            call hold_supports(domain, state%time, force, state%support_force)
            call accelerate(domain, step, state)
         end if
      end associate
   end subroutine find_accelerations

   !> Forces of chunks, and after each the motion of those of this thread that now have all theirs,
   !> while these are in the cache
   subroutine make_and_move(domain, team, step, state)
      type(domain_type), intent(in) :: domain
      type(thread_team_type), intent(inout) :: team
      real(wp), intent(in) :: step
      type(state_type), intent(inout) :: state

      integer :: chunk, place
      logical :: is_moved

      place = 1
      associate (u => state%displacement, v => state%velocity, force => state%acceleration)
         do
            chunk = team%take(inner)
            if (chunk == 0) exit
            call make_chunk_forces(domain, team, chunk, step, u, v, state%history, force)
            call push_messages_on(domain, team, force)
            do
               call move_ahead(domain, team, place, step, state, is_moved)
               if (.not. is_moved) exit
               place = place + 1
            end do
         end do
      end associate
      ! whatever else has its forces, while the other threads make theirs
      do while (team%movers%own(omp_get_thread_num(), place) > 0)
         call move_ahead(domain, team, place, step, state, is_moved)
         place = place + 1
      end do
   end subroutine make_and_move

   !> Move a chunk of this thread ahead of the others, if there is one with all its forces
   subroutine move_ahead(domain, team, place, step, state, is_moved)
      type(domain_type), intent(in) :: domain
      type(thread_team_type), intent(inout) :: team
      !> Its place among those of this thread
      integer, intent(in) :: place
      real(wp), intent(in) :: step
      type(state_type), intent(inout) :: state
      !> Whether it is moved
      logical, intent(out) :: is_moved

      integer :: chunk

      is_moved = .false.
      ! contact asks where points are that it may not push in the end
      if (.not. team%has_opened()) return
      chunk = team%movers%own(omp_get_thread_num(), place)
      if (chunk == 0) return
      is_moved = team%has_forces(domain%chunks%list(chunk)%contributors)
      if (.not. is_moved) return
      call move_chunk(domain, chunk, step, state)
      call team%note_moved(chunk)
   end subroutine move_ahead

   !> All other chunks, whoever takes them
   subroutine move_rest(domain, team, step, state)
      type(domain_type), intent(in) :: domain
      type(thread_team_type), intent(inout) :: team
      real(wp), intent(in) :: step
      type(state_type), intent(inout) :: state

      integer :: chunk

      do
         chunk = team%movers%take(omp_get_thread_num(), .true.)
         if (chunk == 0) exit
         if (team%has_moved(chunk)) cycle
         call move_chunk(domain, chunk, step, state)
      end do
   end subroutine move_rest

   !> Accelerations of the points that move with a chunk; when nobody looks at them, also the motion
   !> over the next step
   pure subroutine move_chunk(domain, number, step, state)
      type(domain_type), intent(in) :: domain
      !> Which chunk
      integer, intent(in) :: number
      real(wp), intent(in) :: step
      type(state_type), intent(inout) :: state

      associate (chunk => domain%chunks%list(number), force => state%acceleration)
         call add_borders(domain, chunk%shared_nodes, force)
         call hold_points(domain, chunk%held, force, state%support_force)
      end associate
      call accelerate_chunk(domain, number, step, state)
   end subroutine move_chunk

   !> Count what the accelerations of all chunks give
   subroutine count_accelerations(domain, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Gets sums over all points, and what held points feel
      type(state_type), intent(inout) :: state

      call count_sums(state%chunk_sums, state%tally)
      call resist_columns(domain, state%acceleration, state%support_force)
   end subroutine count_accelerations

end module plydyn_method_accelerations
