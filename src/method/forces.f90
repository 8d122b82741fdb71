!> Forces on the points: F_ext - F_int of the paper's eq. 6.
module plydyn_method_forces
   use plydyn_base_exact_sum, only : exact_sum_type
   use plydyn_base_memory, only : prefetch
   use plydyn_base_precision, only : wp
   use plydyn_fem_columns, only : alignment_offset
   use plydyn_domain_domain, only : chunk_type, domain_type
   use plydyn_element_average, only : average_points
   use plydyn_method_constraints, only : add_constraint_power
   use plydyn_method_supports, only : add_support_power
   use plydyn_parallel_thread_team, only : thread_team_type, inner, outer
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: add_external_power, add_group_forces, add_loads, add_shared_forces, await_forces, &
      & find_internal_forces, make_outer_forces, prefetch_update, progress_messages

contains

   !> Internal forces of plies and interfaces, or of bricks, on all points. All threads come here
   !> together
   subroutine find_internal_forces(domain, team, step, displacement, velocity, history, force)
      type(domain_type), intent(in) :: domain
      !> The threads, which have begun
      type(thread_team_type), intent(inout) :: team
      !> The step just made
      real(wp), intent(in) :: step
      !> Displacement of all points, and their velocity half a step before
      real(wp), intent(in), contiguous :: displacement(:), velocity(:)
      !> History of all Gauss points
      real(wp), intent(inout), contiguous :: history(:)
      !> Force on all points, those of shared nodes behind
      real(wp), intent(inout), contiguous, asynchronous :: force(:)

      integer :: c, chunk

      call make_outer_forces(domain, team, step, displacement, velocity, history, force)
      do
         chunk = team%take(inner)
         if (chunk == 0) exit
         call add_group_forces(domain, domain%chunks%list(chunk), step, displacement, velocity, &
            & history, force)
         call team%note_forces(chunk)
         call progress_messages(domain, team, force)
      end do
      call await_forces(domain, team, force)
      !$omp do schedule(static)
      do c = size(domain%chunks%list), 1, -1
         call add_shared_forces(domain, domain%chunks%list(c)%shared_nodes, force)
      end do
      !$omp end do nowait
   end subroutine find_internal_forces

   !> Internal forces of the chunks that other ranks need, which are then sent to them. All
   !> threads come here together
   subroutine make_outer_forces(domain, team, step, displacement, velocity, history, force)
      !> As in `find_internal_forces`
      type(domain_type), intent(in) :: domain
      type(thread_team_type), intent(inout) :: team
      real(wp), intent(in) :: step
      real(wp), intent(in), contiguous :: displacement(:), velocity(:)
      real(wp), intent(inout), contiguous :: history(:)
      real(wp), intent(inout), contiguous, asynchronous :: force(:)

      integer :: c, chunk

      if (size(domain%averaging%averages) > 0) then
         if (domain%comm%ranks > 1) then
            !$omp master
            call exchange_strains(domain, team, history)
            !$omp end master
            !$omp barrier
         end if
         !$omp do schedule(dynamic)
         do c = 1, size(domain%chunks%list)
            call find_chunk_averages(domain, domain%chunks%list(c), history)
         end do
         !$omp end do
      end if
      if (domain%chunks%outer == 0) return
      do
         chunk = team%take(outer)
         if (chunk == 0) exit
         call add_group_forces(domain, domain%chunks%list(chunk), step, displacement, velocity, &
            & history, force)
         call team%note_forces(chunk)
      end do
      !$omp barrier
      !$omp master
      call domain%chunks%halo%start(force, team%messages)
      !$omp end master
   end subroutine make_outer_forces

   !> Wait until the forces of all chunks are there, and those of other ranks. All threads come here
   !> together
   subroutine await_forces(domain, team, force)
      type(domain_type), intent(in) :: domain
      type(thread_team_type), intent(inout) :: team
      !> Force on all points, those of shared nodes behind
      real(wp), intent(inout), contiguous, asynchronous :: force(:)

      !$omp barrier
      if (domain%chunks%outer == 0) return
      !$omp master
      call domain%chunks%halo%finish(force, team%messages)
      !$omp end master
      !$omp barrier
   end subroutine await_forces

   !> Exchange the strains that are averaged on another rank than that of their points
   subroutine exchange_strains(domain, team, history)
      type(domain_type), intent(in) :: domain
      type(thread_team_type), intent(inout) :: team
      real(wp), intent(inout), contiguous, asynchronous :: history(:)

      call domain%averaging%strain_halo%start(history, team%strain_messages)
      call domain%averaging%strain_halo%finish(history, team%strain_messages)
   end subroutine exchange_strains

   !> Let MPI progress the forces on their way to other ranks
   subroutine progress_messages(domain, team, force)
      !> As in `find_internal_forces`
      type(domain_type), intent(in) :: domain
      type(thread_team_type), intent(inout) :: team
      real(wp), intent(inout), contiguous, asynchronous :: force(:)

      if (domain%chunks%outer == 0) return
      !$omp master
      call domain%chunks%halo%progress(force, team%messages)
      !$omp end master
   end subroutine progress_messages

   !> Average the strains of the step before over the points of one chunk and their neighbours
   pure subroutine find_chunk_averages(domain, chunk, history)
      type(domain_type), intent(in) :: domain
      type(chunk_type), intent(in) :: chunk
      real(wp), intent(inout), contiguous :: history(:)

      integer :: a

      do a = 1, size(domain%averaging%averages)
         if (domain%averaging%averages(a)%plate /= chunk%set) cycle
         call average_points(domain%averaging%averages(a), chunk%elements, &
            & history(domain%averaging%averages(a)%first_history:))
      end do
   end subroutine find_chunk_averages

   !> Subtract the internal forces of all groups over a chunk
   pure subroutine add_group_forces(domain, chunk, step, displacement, velocity, history, force)
      !> As in `find_internal_forces`
      type(domain_type), intent(in) :: domain
      type(chunk_type), intent(in) :: chunk
      real(wp), intent(in) :: step
      real(wp), intent(in), contiguous :: displacement(:), velocity(:)
      real(wp), intent(inout), contiguous :: history(:), force(:)

      integer :: g

      call prefetch_displacement(domain, chunk, displacement)
      if (.not. domain%groups(chunk%groups(1))%item%sets_forces) then
         call clear_columns(domain%columns%height, chunk%column, force(alignment_offset + 1:))
      end if
      do g = 1, size(chunk%groups)
         call domain%groups(chunk%groups(g))%item%add_forces(chunk%elements, step, displacement, &
            & velocity, history, force)
      end do
   end subroutine add_group_forces

   !> Set some columns to zero
   pure subroutine clear_columns(height, column, force)
      integer, intent(in) :: height, column(:)
      real(wp), intent(inout) :: force(height, *)
      integer :: i

      do i = 1, size(column)
         force(:, column(i)) = 0.0_wp
      end do
   end subroutine clear_columns

   !> Add the columns that chunks have of nodes they share to those of the nodes
   pure subroutine add_shared_forces(domain, nodes, force)
      type(domain_type), intent(in) :: domain
      !> Which of its shared nodes
      integer, intent(in) :: nodes(:)
      !> Force on all points, those of shared nodes behind
      real(wp), intent(inout), contiguous :: force(:)

      integer :: i

      do i = 1, size(nodes)
         call add_columns(domain%columns%height, domain%chunks%shared_nodes(:, nodes(i)), &
            & force(alignment_offset + 1:))
      end do
   end subroutine add_shared_forces

   !> Add columns behind to that of their node
   pure subroutine add_columns(height, columns, force)
      integer, intent(in) :: height
      !> Node, first and last column
      integer, intent(in) :: columns(3)
      real(wp), intent(inout) :: force(height, *)
      integer :: i

      do i = columns(2), columns(3)
         force(:, columns(1)) = force(:, columns(1)) + force(:, i)
      end do
   end subroutine add_columns

   !> Add the loads at some time. All threads come here together
   subroutine add_loads(domain, time, factor, force)
      type(domain_type), intent(in) :: domain
      !> Time
      real(wp), intent(in) :: time
      !> Value of each load's curve then
      real(wp), intent(inout), contiguous :: factor(:)
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)

      integer :: i, k

      if (size(domain%loads) == 0) return
      !$omp barrier
      !$omp single
      do k = 1, size(domain%loads)
         associate (load => domain%loads(k))
            factor(k) = domain%curves(load%curve)%at(time)
            do i = 1, size(load%freedom)
               force(load%freedom(i)) = force(load%freedom(i)) + factor(k)*load%force(i)
            end do
         end associate
      end do
      !$omp end single
   end subroutine add_loads

   !> Add the power of loads, supports and constraints to a sum
   pure subroutine add_external_power(domain, state, sum)
      type(domain_type), intent(in) :: domain
      !> Velocity, loads, forces of supports and constraints
      type(state_type), intent(in) :: state
      type(exact_sum_type), intent(inout) :: sum

      call add_load_power(domain, state%supports%load_factor, state%velocity, sum)
      call add_support_power(domain, state%supports%force, state%velocity, sum)
      if (size(domain%constraints%list) > 0) then
         call add_constraint_power(domain, state%supports%constraints, sum)
      end if
   end subroutine add_external_power

   !> Add the power of the loads to a sum
   pure subroutine add_load_power(domain, factor, velocity, sum)
      type(domain_type), intent(in) :: domain
      !> Value of each load's curve
      real(wp), intent(in) :: factor(:)
      !> Velocity of all points
      real(wp), intent(in) :: velocity(:)
      type(exact_sum_type), intent(inout) :: sum

      real(wp) :: power
      integer :: c, first, i, k

      do k = 1, size(domain%loads)
         associate (load => domain%loads(k))
            first = 1
            do c = 1, size(load%last)
               power = 0.0_wp
               do i = first, load%last(c)
                  power = power + load%force(i)*velocity(load%freedom(i))
               end do
               first = load%last(c) + 1
               if (domain%counts(load%freedom(load%last(c)))) call sum%add(factor(k)*power)
            end do
         end associate
      end do
   end subroutine add_load_power

   !> Ask at once for what the forces of a chunk need: its columns lie in many places, and a step of
   !> a model that is larger than the caches would wait for one of them after the other
   pure subroutine prefetch_displacement(domain, chunk, displacement)
      type(domain_type), intent(in) :: domain
      type(chunk_type), intent(in) :: chunk
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)

      integer :: i

      do i = 1, size(chunk%node)
         call prefetch_column(domain, chunk%node(i), displacement)
      end do
   end subroutine prefetch_displacement

   !> Ask at once for what the accelerations and the motion of a chunk need
   pure subroutine prefetch_update(domain, chunk, state)
      type(domain_type), intent(in) :: domain
      type(chunk_type), intent(in) :: chunk
      !> Has the motion
      type(state_type), intent(in) :: state

      integer :: first, i, last

      associate (column => chunk%owned_columns)
         do i = 1, size(column)
            call prefetch_column(domain, column(i), state%acceleration)
            call prefetch_column(domain, column(i), state%velocity)
            call prefetch_column(domain, column(i), state%displacement)
            last = domain%columns%height/3*column(i)
            first = last - domain%columns%height/3 + 1
            call prefetch(domain%inertia%mass(first:last))
            call prefetch(domain%inertia%inverse_mass(first:last))
         end do
      end associate
   end subroutine prefetch_update

   !> Ask for a column of an array of motion
   pure subroutine prefetch_column(domain, column, motion)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: column
      real(wp), intent(in), contiguous :: motion(:)

      associate (last => alignment_offset + domain%columns%height*column)
         call prefetch(motion(last - domain%columns%height + 1:last))
      end associate
   end subroutine prefetch_column

end module plydyn_method_forces
