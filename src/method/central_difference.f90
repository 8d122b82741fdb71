!> The central difference scheme (de Borst et al., 2012), column by column.
module plydyn_method_central_difference
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_columns, only : alignment_offset
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_energy, only : global_reduction_type
   use plydyn_method_implicit_inertia, only : couple_inertia
   use plydyn_method_step_control, only : coefficients_of_step, leapfrog_coefficients_type
   use plydyn_method_workspace, only : chunk_sums_type, workspace_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: add_chunk_sums, apply_chunk_masses, apply_masses, predict, undo_prediction

   !> Sums of a block, lane by lane: momentum along x, y, z, then these; the last is a bound, no sum
   integer, parameter :: kinetic_at = 4, power_at = 5, square_at = 6, speed_at = 7, parts = 7
   !> Share by which the last step may exceed the largest, and round-off
   real(wp), parameter :: round_off = 1.0e-5_wp

contains

   !> Velocity to the middle of the coming step, displacement to its end (the paper's eq. 15). All
   !> threads come here together, and wait for each other
   subroutine predict(domain, work, state)
      type(domain_type), intent(in) :: domain
      !> Nothing remains to be done where the motion was computed with the accelerations
      type(workspace_type), intent(inout) :: work
      !> Velocity and displacement
      type(state_type), intent(inout) :: state

      type(leapfrog_coefficients_type) :: coefficients
      integer :: c

      !$omp master
      call work%team%expect_contact()
      !$omp end master
      !$omp barrier
      if (work%is_predicted) return
      coefficients = coefficients_of_step(domain%control%damping, state)
      ! the thread that updates a chunk moves it: its accelerations are still in the cache
      !$omp do schedule(static)
      do c = size(domain%chunks%list), 1, -1
         call move_columns(domain, domain%chunks%list(c)%owned_columns, coefficients, state)
         call move_columns(domain, domain%chunks%list(c)%ghost_columns, coefficients, state)
      end do
      !$omp end do
   end subroutine predict

   !> Motion of some columns over a step
   pure subroutine move_columns(domain, columns, coefficients, state)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: columns(:)
      type(leapfrog_coefficients_type), intent(in) :: coefficients
      type(state_type), intent(inout) :: state

      integer :: i, k

      do i = 1, size(columns)
         k = alignment_offset + domain%columns%height*(columns(i) - 1) + 1
         call move_column(domain%columns%height, coefficients%decay, coefficients%mean_step, &
            & coefficients%step, state%acceleration(k), state%velocity(k), state%displacement(k))
      end do
   end subroutine move_columns

   !> Motion of one column over a step: the paper's eq. 15
   pure subroutine move_column(height, decay, mean_step, step, a, v, u)
      integer, intent(in) :: height
      !> As in `leapfrog_coefficients_type`
      real(wp), intent(in) :: decay, mean_step, step
      !> Acceleration, velocity, displacement
      real(wp), intent(in) :: a(height)
      real(wp), intent(inout) :: v(height), u(height)

      integer :: k

      !$omp simd
      do k = 1, height
         v(k) = decay*v(k) + mean_step*a(k)
         u(k) = u(k) + step*v(k)
      end do
   end subroutine move_column

   !> Take back a motion that was computed in advance, to round-off: for reports of a run that fails
   pure subroutine undo_prediction(work, state)
      !> Whether there is such a motion
      type(workspace_type), intent(inout) :: work
      !> Velocity and displacement
      type(state_type), intent(inout) :: state

      if (.not. work%predicts_next) return
      associate (u => state%displacement, v => state%velocity, next => work%next)
         u(:) = u - next%step*v
         v(:) = (v - next%mean_step*state%acceleration(:size(v)))/next%decay
      end associate
      work%predicts_next = .false.
   end subroutine undo_prediction

   !> Forces to accelerations, in place, with the sums that the energies need. All threads come here
   !> together.
   !>
   !> Both points of a tied face get the sum of their forces; their inverse mass is that of both, so
   !> that their accelerations are the same to the last bit.
   subroutine apply_masses(domain, work, state)
      type(domain_type), intent(in) :: domain
      !> Gets the sums over the points of each chunk: the same for any number of threads
      type(workspace_type), intent(inout) :: work
      !> Forces in, accelerations out
      type(state_type), intent(inout) :: state

      integer :: c, k

      if (size(domain%inertia%far_ties, 2) > 0) then
         !$omp barrier
         !$omp do schedule(static)
         do k = 1, size(domain%inertia%far_ties, 2)
            associate (force => state%acceleration)
               force(domain%inertia%far_ties(:, k)) = sum(force(domain%inertia%far_ties(:, k)))
            end associate
         end do
         !$omp end do
      end if
      !$omp do schedule(static)
      do c = size(domain%chunks%list), 1, -1
         call apply_chunk_masses(domain, c, work, state)
      end do
      !$omp end do nowait
   end subroutine apply_masses

   !> `apply_masses` for the points that move with a chunk, where no ties join layers of different
   !> order groups; with their motion over the next step, if it is to be computed in advance
   pure subroutine apply_chunk_masses(domain, number, work, state)
      type(domain_type), intent(in) :: domain
      !> Which chunk
      integer, intent(in) :: number
      !> As in `apply_masses`
      type(workspace_type), intent(inout) :: work
      type(state_type), intent(inout) :: state

      type(chunk_sums_type) :: counted_elsewhere, sums

      associate (chunk => domain%chunks%list(number))
         call update_columns(domain, chunk%owned_columns, work, state, sums)
         work%chunk_sums(number) = sums
         call update_columns(domain, chunk%ghost_columns, work, state, counted_elsewhere)
      end associate
   end subroutine apply_chunk_masses

   !> `apply_masses` for some columns, each moved on while it is in the cache
   pure subroutine update_columns(domain, columns, work, state, sums)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: columns(:)
      type(workspace_type), intent(in) :: work
      type(state_type), intent(inout) :: state
      type(chunk_sums_type), intent(inout) :: sums

      real(wp) :: half_step, largest_step, part(lanes, parts)
      integer :: i
      logical :: is_coupled

      half_step = 0.5_wp*work%step
      largest_step = (1.0_wp + round_off)*domain%step
      is_coupled = domain%inertia%thickness%active .or. domain%inertia%pairs%active
      part(:, :) = 0.0_wp
      do i = 1, size(columns)
         call update_column(domain, columns(i), half_step, largest_step, state%velocity, &
            & state%acceleration, part)
         if (is_coupled) then
            call couple_inertia(domain, columns(i), half_step, state%velocity, &
               & state%acceleration, sums%motion_sums_type)
            sums%speed_bound = max(sums%speed_bound, speed_of_column(domain%columns%height, &
               & columns(i), largest_step, state%velocity, state%acceleration))
         end if
         if (work%predicts_next) call move_columns(domain, columns(i:i), work%next, state)
      end do
      if (.not. is_coupled) then
         sums%speed_bound = max(sums%speed_bound, maxval(part(:, speed_at)))
      end if
      sums%momentum(:) = sums%momentum + sum(part(:, :3), 1)
      sums%twice_kinetic = sums%twice_kinetic + sum(part(:, kinetic_at))
      sums%power = sums%power + sum(part(:, power_at))
      sums%acceleration_square = sums%acceleration_square + sum(part(:, square_at))
   end subroutine update_columns

   !> `apply_masses` for the order groups of one column, each point by itself
   pure subroutine update_column(domain, n, half_step, largest_step, velocity, force, part)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: n
      !> As in `speed_of_column`
      real(wp), intent(in) :: half_step, largest_step
      real(wp), intent(in), contiguous :: velocity(:)
      real(wp), intent(inout), contiguous :: force(:)
      !> Gets the terms of the column
      real(wp), intent(inout) :: part(lanes, parts)

      integer :: before, f, first, mass

      before = domain%columns%height*(n - 1)
      do f = 1, size(domain%columns%order_groups)
         associate (order_group => domain%columns%order_groups(f))
            first = order_group%first + before
            mass = order_group%first_mass + before/3
            if (order_group%is_tied) then
               call add_tied_forces(lanes*order_group%blocks, order_group%order + 1, &
                  & order_group%tied_above, &
                  & force(first:))
            end if
            call update_family(order_group%blocks*(order_group%order + 1), half_step, &
               & largest_step, &
               & domain%inertia%mass(mass:), domain%inertia%inverse_mass(mass:), velocity(first:), &
               & force(first:), part)
         end associate
      end do
   end subroutine update_column

   !> Bound on every component of the velocity of a column over the next step
   pure real(wp) function speed_of_column(height, n, largest_step, velocity, acceleration) &
      & result(bound)
      integer, intent(in) :: height, n
      !> Largest step, and round-off
      real(wp), intent(in) :: largest_step
      real(wp), intent(in), contiguous :: velocity(:), acceleration(:)

      integer :: k

      bound = 0.0_wp
      !$omp simd reduction(max:bound)
      do k = alignment_offset + height*(n - 1) + 1, alignment_offset + height*n
         bound = max(bound, abs(velocity(k)) + largest_step*abs(acceleration(k)))
      end do
   end function speed_of_column

   !> Add the sums of all chunks
   pure subroutine add_chunk_sums(chunk_sums, reduction)
      !> As from `apply_masses`
      type(chunk_sums_type), intent(in) :: chunk_sums(:)
      !> Gets the sums over all points that this rank counts
      type(global_reduction_type), intent(inout) :: reduction

      integer :: c

      ! a rank may have no chunk
      reduction%speed_bound = 0.0_wp
      do c = 1, size(chunk_sums)
         call reduction%add_motion(chunk_sums(c))
         reduction%speed_bound = max(reduction%speed_bound, chunk_sums(c)%speed_bound)
      end do
   end subroutine add_chunk_sums

   !> Give both points of every tied face between lanes side by side the sum of their forces
   pure subroutine add_tied_forces(width, levels, tied, force)
      integer, intent(in) :: width, levels
      !> 1 where the top of a lane is tied to the bottom of the next, else 0
      real(wp), intent(in) :: tied(width)
      !> Forces of a column, lane by lane, then level by level
      real(wp), intent(inout) :: force(width*levels, 3)

      real(wp) :: above(lanes), below(lanes)
      integer :: c, k, l, top

      do c = 1, 3
         do k = 0, width - lanes, lanes
            top = width*(levels - 1) + k
            !$omp simd
            do l = 1, lanes
               above(l) = force(k + l + 1, c) + tied(k + l)*force(top + l, c)
               below(l) = force(top + l, c) + tied(k + l)*force(k + l + 1, c)
            end do
            ! the last lane, never tied, meets the next level here, and leaves it as it was: first
            force(k + 2:k + lanes + 1, c) = above
            force(top + 1:top + lanes, c) = below
         end do
      end do
   end subroutine add_tied_forces

   !> Force over mass of one order group above a node, and its part in the sums
   pure subroutine update_family(rows, half_step, largest_step, mass, inverse_mass, v, a, part)
      integer, intent(in) :: rows
      real(wp), intent(in) :: half_step, largest_step, mass(lanes, rows), inverse_mass(lanes, rows)
      real(wp), intent(in) :: v(lanes, rows, 3)
      real(wp), intent(inout) :: a(lanes, rows, 3), part(lanes, parts)

      real(wp) :: speed, kinetic, power, square, px, py, pz, vx, vy, vz
      integer :: l, r

      !$omp simd private(speed, kinetic, power, square, px, py, pz, vx, vy, vz, r)
      do l = 1, lanes
         px = part(l, 1)
         py = part(l, 2)
         pz = part(l, 3)
         kinetic = part(l, kinetic_at)
         power = part(l, power_at)
         square = part(l, square_at)
         speed = part(l, speed_at)
         r = 0
         ! with its end tested last: around a loop that may be empty there are no vectors
         do
            r = r + 1
            a(l, r, 1) = a(l, r, 1)*inverse_mass(l, r)
            a(l, r, 2) = a(l, r, 2)*inverse_mass(l, r)
            a(l, r, 3) = a(l, r, 3)*inverse_mass(l, r)
            vx = v(l, r, 1) + half_step*a(l, r, 1)
            vy = v(l, r, 2) + half_step*a(l, r, 2)
            vz = v(l, r, 3) + half_step*a(l, r, 3)
            px = px + mass(l, r)*vx
            py = py + mass(l, r)*vy
            pz = pz + mass(l, r)*vz
            kinetic = kinetic + mass(l, r)*(vx**2 + vy**2 + vz**2)
            power = power + mass(l, r)*(a(l, r, 1)*v(l, r, 1) + a(l, r, 2)*v(l, r, 2) &
               & + a(l, r, 3)*v(l, r, 3))
            square = square + mass(l, r)*(a(l, r, 1)**2 + a(l, r, 2)**2 + a(l, r, 3)**2)
            speed = max(speed, abs(v(l, r, 1)) + largest_step*abs(a(l, r, 1)), &
               & abs(v(l, r, 2)) + largest_step*abs(a(l, r, 2)), &
               & abs(v(l, r, 3)) + largest_step*abs(a(l, r, 3)))
            if (r == rows) exit
         end do
         part(l, 1) = px
         part(l, 2) = py
         part(l, 3) = pz
         part(l, kinetic_at) = kinetic
         part(l, power_at) = power
         part(l, square_at) = square
         part(l, speed_at) = speed
      end do
   end subroutine update_family

end module plydyn_method_central_difference
