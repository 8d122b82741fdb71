!> Accelerations: forces of plies, interfaces and loads over the masses (the paper's eq. 6).
module plydyn_method_accelerations
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_cracked_crack_lines, only : hold_crack
   use plydyn_method_central_difference, only : add_chunk_sums, apply_chunk_masses, apply_masses
   use plydyn_method_constraints, only : constrain_forces
   use plydyn_method_contact_step, only : contacts_type
   use plydyn_method_energy, only : global_reduction_type
   use plydyn_method_forces, only : add_external_power, add_group_forces, add_loads, &
      & add_shared_forces, await_forces, find_internal_forces, make_outer_forces, prefetch_update, &
      & progress_messages
   use plydyn_method_step_control, only : coefficients_after, looks_at_volumes
   use plydyn_method_supports, only : add_held_inertia, fix_points, hold_supports
   use plydyn_method_workspace, only : new_workspace, workspace_type
   use plydyn_parallel_thread_team, only : inner
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: add_motion_sums, begin_accelerations, prepare_step, update_accelerations

contains

   !> Accelerations at the time of a state, by threads of their own
   subroutine begin_accelerations(domain, state, reduction)
      type(domain_type), intent(in) :: domain
      !> Accelerations
      type(state_type), intent(inout) :: state
      !> Sums over all points
      type(global_reduction_type), intent(out) :: reduction

      type(workspace_type) :: work

      call new_workspace(domain, state, work)
      !$omp parallel default(shared)
      call update_accelerations(domain, work, state)
      !$omp end parallel
      call add_motion_sums(domain, work, state, reduction)
      call reduction%sum(domain%comm)
   end subroutine begin_accelerations

   !> Prepare the threads for a step, and choose whether the motion of the step after it is computed
   !> in advance: only if the motion at the end of this step is not read
   subroutine prepare_step(domain, contacts, state, motion_is_read, work)
      type(domain_type), intent(in) :: domain
      !> Contacts, with the chunks that they may change
      type(contacts_type), intent(in) :: contacts
      !> Has the step
      type(state_type), intent(in) :: state
      !> Whether an observer reads the motion at the end of the step
      logical, intent(in) :: motion_is_read
      type(workspace_type), intent(inout) :: work

      work%time = state%time + state%step
      work%step = state%step
      work%next = coefficients_after(domain, state)
      work%is_predicted = work%predicts_next
      work%predicts_next = can_predict(domain) .and. .not. motion_is_read &
         & .and. .not. (state%ends_after() .or. looks_at_volumes(state%cycle + 1))
      call work%team%set_waiting(contacts%reached)
      call work%team%begin_step(contacts%reaches_all)
   end subroutine prepare_step

   !> Whether the accelerations of a chunk follow from forces of chunks alone, so that its motion
   !> over the next step may be computed with them
   pure logical function can_predict(domain)
      type(domain_type), intent(in) :: domain

      can_predict = size(domain%loads) + size(domain%supports%motions) &
         & + size(domain%constraints%list) + size(domain%inertia%far_ties) &
         & + domain%cracks%whole == 0
   end function can_predict

   !> Accelerations of all points at the end of a step. All threads come here together
   subroutine update_accelerations(domain, work, state)
      type(domain_type), intent(in) :: domain
      !> The threads; gets the sums over the points of each chunk
      type(workspace_type), intent(inout) :: work
      !> Accelerations, histories and forces of supports
      type(state_type), intent(inout) :: state

      associate (u => state%displacement, v => state%velocity, force => state%acceleration)
         if (can_predict(domain)) then
            call make_outer_forces(domain, work%team, work%step, u, v, state%history, force)
            call update_while_forces_come(domain, work, state)
            call await_forces(domain, work%team, force)
            call update_remaining(domain, work, state)
         else
            call find_internal_forces(domain, work%team, work%step, u, v, state%history, force)
            call add_loads(domain, work%time, state%supports%load_factor, force)
            call hold_supports(domain, work%time, force, state%supports%force)
            call constrain_forces(domain, force, state%supports%constraints, work%constraints)
            if (domain%cracks%whole > 0) then
               call hold_cracks(domain, work%time, u, state%history, force)
            end if
            call apply_masses(domain, work, state)
         end if
      end associate
   end subroutine update_accelerations

   !> Ties and tractions of all cracks, by the threads that move their columns: no node asks for
   !> another
   subroutine hold_cracks(domain, time, displacement, history, force)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: time
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp), intent(inout), contiguous :: history(:), force(:)

      integer :: c, first, i

      !$omp do schedule(static)
      do c = size(domain%chunks%list), 1, -1
         do i = 1, size(domain%chunks%list(c)%cracks)
            associate (node => domain%chunks%list(c)%cracks(i))
               first = domain%cracks%first_history + domain%cracks%history_length()*(node - 1)
               call hold_crack(domain%cracks, node, time, domain%inertia%mass, displacement, &
                  & history(first:), force)
            end associate
         end do
      end do
      !$omp end do nowait
   end subroutine hold_cracks

   !> Forces of chunks; after each of them, the accelerations of chunks of this thread that now have
   !> all their forces, while these are in the cache
   subroutine update_while_forces_come(domain, work, state)
      type(domain_type), intent(in) :: domain
      type(workspace_type), intent(inout) :: work
      type(state_type), intent(inout) :: state

      integer :: chunk, next
      logical :: is_updated

      next = 1
      associate (u => state%displacement, v => state%velocity, force => state%acceleration)
         do
            chunk = work%team%take(inner)
            if (chunk == 0) exit
            call add_group_forces(domain, domain%chunks%list(chunk), work%step, u, v, &
               & state%history, force)
            call work%team%note_forces(chunk)
            call progress_messages(domain, work%team, force)
            do
               call try_update(domain, work, next, state, is_updated)
               if (.not. is_updated) exit
               next = next + 1
            end do
         end do
      end associate
      ! other chunks that have their forces, while the other threads compute the last ones
      do while (work%team%own_chunk(next) > 0)
         call try_update(domain, work, next, state, is_updated)
         next = next + 1
      end do
   end subroutine update_while_forces_come

   !> Update a chunk of this thread, if there is one with all its forces
   subroutine try_update(domain, work, number, state, is_updated)
      type(domain_type), intent(in) :: domain
      type(workspace_type), intent(inout) :: work
      !> Which of the chunks of this thread
      integer, intent(in) :: number
      type(state_type), intent(inout) :: state
      !> Whether it is updated
      logical, intent(out) :: is_updated

      integer :: chunk

      is_updated = .false.
      ! contact reads positions of points that it does not move
      if (.not. work%team%contact_is_done()) return
      chunk = work%team%own_chunk(number)
      if (chunk == 0) return
      is_updated = work%team%has_forces(domain%chunks%list(chunk)%contributors)
      if (.not. is_updated) return
      call update_chunk(domain, chunk, work, state)
      call work%team%note_update(chunk)
   end subroutine try_update

   !> Update all other chunks, by any thread
   subroutine update_remaining(domain, work, state)
      type(domain_type), intent(in) :: domain
      type(workspace_type), intent(inout) :: work
      type(state_type), intent(inout) :: state

      integer :: chunk

      do
         chunk = work%team%take_update()
         if (chunk == 0) exit
         if (work%team%has_update(chunk)) cycle
         call update_chunk(domain, chunk, work, state)
      end do
   end subroutine update_remaining

   !> Accelerations of the points that move with a chunk
   pure subroutine update_chunk(domain, number, work, state)
      type(domain_type), intent(in) :: domain
      !> Which chunk
      integer, intent(in) :: number
      type(workspace_type), intent(inout) :: work
      type(state_type), intent(inout) :: state

      call prefetch_update(domain, domain%chunks%list(number), state)
      associate (chunk => domain%chunks%list(number), force => state%acceleration)
         call add_shared_forces(domain, chunk%shared_nodes, force)
         call fix_points(domain, chunk%held, force, state%supports%force)
      end associate
      call apply_chunk_masses(domain, number, work, state)
   end subroutine update_chunk

   !> Add the sums over the points of this rank, and complete the forces of the supports
   pure subroutine add_motion_sums(domain, work, state, reduction)
      type(domain_type), intent(in) :: domain
      !> Has the sums over the points of each chunk
      type(workspace_type), intent(in) :: work
      !> Gets the forces of the supports
      type(state_type), intent(inout) :: state
      !> Sums over all points
      type(global_reduction_type), intent(inout) :: reduction

      call add_chunk_sums(work%chunk_sums, reduction)
      call add_held_inertia(domain, state%acceleration, state%supports%force)
      call add_external_power(domain, state, reduction%external_power_after)
   end subroutine add_motion_sums

end module plydyn_method_accelerations
