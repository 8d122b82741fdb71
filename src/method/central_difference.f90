!> The central difference scheme (de Borst et al., 2012), column by column.
module plydyn_method_central_difference
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_columns, only : front
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_implicit_column_inertia, only : couple_column
   use plydyn_method_implicit_pair_inertia, only : add_pair_energy, couple_pairs
   use plydyn_state_state, only : added_sum, kinetic_sum, momentum_sum, power_sum, pull_sum, &
      & speed_sum, state_type, sums_type
   implicit none
   private

   public :: accelerate, accelerate_chunk, advance, count_sums, new_leapfrog_coefficients, step_back

   !> What a step makes of accelerations: v = keep v + middle a, u = u + step v
   type, public :: leapfrog_coefficients_type
      !> Damping over half of the time from middle to middle, and what it leaves of the velocity
      real(wp) :: brake = 0.0_wp, keep = 1.0_wp
      !> Time from the middle of the step before to that of this one, less for damping; the step
      real(wp) :: middle = 0.0_wp, step = 0.0_wp
   end type leapfrog_coefficients_type

   !> Sums of a block, lane by lane: momentum along x, y, z, then these; at last no sum but a bound
   integer, parameter :: kinetic_at = 4, power_at = 5, pull_at = 6, fastest_at = 7, parts = 7
   !> Share by which the last step may exceed the largest, and room for round-off
   real(wp), parameter :: room = 1.0e-5_wp

contains

   !> What a step makes of accelerations, with damping as a share of the velocity at the full step
   pure type(leapfrog_coefficients_type) function new_leapfrog_coefficients(damping, step_before, &
      & step) result(self)
      !> Of the mass, per time
      real(wp), intent(in) :: damping
      !> The step before, and this one
      real(wp), intent(in) :: step_before, step

      real(wp) :: middle_step

      middle_step = 0.5_wp*(step_before + step)
      self%brake = 0.5_wp*damping*middle_step
      self%keep = (1.0_wp - self%brake)/(1.0_wp + self%brake)
      self%middle = middle_step/(1.0_wp + self%brake)
      self%step = step
   end function new_leapfrog_coefficients

   !> Velocity to the middle of the coming step, displacement to its end (the paper's eq. 15). All
   !> threads come here together, and wait for each other
   subroutine advance(domain, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Velocity and displacement
      type(state_type), intent(inout) :: state

      type(leapfrog_coefficients_type) :: stride
      integer :: c

      stride = new_leapfrog_coefficients(domain%control%damping, state%step_before, state%step)
      ! the thread that accelerates a chunk advances it: it still has its accelerations
      !$omp do schedule(static)
      do c = size(domain%chunks%list), 1, -1
         call advance_columns(domain, domain%chunks%list(c)%owned_columns, stride, state)
         call advance_columns(domain, domain%chunks%list(c)%ghost_columns, stride, state)
      end do
      !$omp end do
   end subroutine advance

   !> `advance` for some columns
   pure subroutine advance_columns(domain, columns, stride, state)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: columns(:)
      type(leapfrog_coefficients_type), intent(in) :: stride
      type(state_type), intent(inout) :: state

      integer :: i, k

      do i = 1, size(columns)
         k = front + domain%columns%height*(columns(i) - 1) + 1
         call advance_column(domain%columns%height, stride%keep, stride%middle, stride%step, &
            & state%acceleration(k), state%velocity(k), state%displacement(k))
      end do
   end subroutine advance_columns

   !> `advance` for one column
   pure subroutine advance_column(height, keep, middle, step, a, v, u)
      integer, intent(in) :: height
      !> As in `leapfrog_coefficients_type`
      real(wp), intent(in) :: keep, middle, step
      !> Acceleration, velocity, displacement
      real(wp), intent(in) :: a(height)
      real(wp), intent(inout) :: v(height), u(height)

      integer :: k

      !$omp simd
      do k = 1, height
         v(k) = keep*v(k) + middle*a(k)
         u(k) = u(k) + step*v(k)
      end do
   end subroutine advance_column

   !> Where the points were before they went ahead, to round-off
   pure subroutine step_back(domain, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Velocity and displacement
      type(state_type), intent(inout) :: state

      type(leapfrog_coefficients_type) :: stride

      if (.not. state%is_ahead) return
      stride = new_leapfrog_coefficients(domain%control%damping, state%step, state%step_after)
      associate (u => state%displacement, v => state%velocity)
         u(:) = u - stride%step*v
         v(:) = (v - stride%middle*state%acceleration(:size(v)))/stride%keep
      end associate
      state%is_ahead = .false.
   end subroutine step_back

   !> Forces to accelerations, in place, with the sums that the energies need.
   !> Both points of a tied face get the sum of their forces; their inverse mass is that of both, so
   !> their accelerations are the same to the last bit. All threads come here together.
   subroutine accelerate(domain, step, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The step just made
      real(wp), intent(in) :: step
      !> Forces in, accelerations out, with the sums over the points that each chunk has first: the
      !> same for any number of threads
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
         call accelerate_chunk(domain, c, step, state)
      end do
      !$omp end do nowait
   end subroutine accelerate

   !> `accelerate` for the points that move with a chunk, where no ties reach further than a family.
   !> Points that nobody looks at go on to the end of the next step
   pure subroutine accelerate_chunk(domain, number, step, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Which chunk
      integer, intent(in) :: number
      !> As in `accelerate`
      real(wp), intent(in) :: step
      type(state_type), intent(inout) :: state

      type(sums_type) :: counted_elsewhere, sums

      call accelerate_columns(domain, domain%chunks%list(number)%owned_columns, step, state, sums)
      state%chunk_sums(number) = sums
      call accelerate_columns(domain, domain%chunks%list(number)%ghost_columns, step, state, &
         & counted_elsewhere)
   end subroutine accelerate_chunk

   !> `accelerate` for some columns, each moved on while it is in the cache
   pure subroutine accelerate_columns(domain, columns, step, state, sums)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: columns(:)
      real(wp), intent(in) :: step
      type(state_type), intent(inout) :: state
      type(sums_type), intent(inout) :: sums

      type(leapfrog_coefficients_type) :: stride
      real(wp) :: part(lanes, parts), reach
      integer :: i
      logical :: is_coupled

      stride = new_leapfrog_coefficients(domain%control%damping, step, state%step_after)
      is_coupled = domain%inertia%thickness%active .or. domain%inertia%pairs%active
      reach = (1.0_wp + room)*domain%step
      part(:, :) = 0.0_wp
      do i = 1, size(columns)
         call accelerate_column(domain, columns(i), 0.5_wp*step, reach, state%velocity, &
            & state%acceleration, part)
         if (is_coupled) call couple(domain, columns(i), 0.5_wp*step, reach, state%velocity, &
            & state%acceleration, sums)
         if (state%goes_ahead) call advance_columns(domain, columns(i:i), stride, state)
      end do
      if (.not. is_coupled) sums%fastest = max(sums%fastest, maxval(part(:, fastest_at)))
      sums%momentum(:) = sums%momentum + sum(part(:, :3), 1)
      sums%twice_kinetic = sums%twice_kinetic + sum(part(:, kinetic_at))
      sums%power = sums%power + sum(part(:, power_at))
      sums%pull = sums%pull + sum(part(:, pull_at))
   end subroutine accelerate_columns

   !> `accelerate` for the families of one column, each point by itself
   pure subroutine accelerate_column(domain, n, half_step, reach, velocity, force, part)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: n
      !> As in `speed_of_column`
      real(wp), intent(in) :: half_step, reach
      real(wp), intent(in), contiguous :: velocity(:)
      real(wp), intent(inout), contiguous :: force(:)
      !> Gets what the column adds
      real(wp), intent(inout) :: part(lanes, parts)

      integer :: f, first, mass

      do f = 1, size(domain%columns%families)
         associate (family => domain%columns%families(f))
            first = domain%columns%start(f, n)
            mass = domain%columns%mass_start(f, n)
            if (family%is_tied) then
               call share_forces(lanes*family%blocks, family%order + 1, family%tied_above, &
                  & force(first:))
            end if
            call divide(family%blocks*(family%order + 1), half_step, reach, &
               & domain%inertia%mass(mass:), &
               & domain%inertia%inverse_mass(mass:), velocity(first:), force(first:), part)
         end associate
      end do
   end subroutine accelerate_column

   !> What no component of the velocity of a column will exceed half a step after the next motion
   pure real(wp) function speed_of_column(height, n, reach, velocity, acceleration) result(most)
      integer, intent(in) :: height, n
      !> Largest step, and room for round-off
      real(wp), intent(in) :: reach
      real(wp), intent(in), contiguous :: velocity(:), acceleration(:)

      integer :: k

      most = 0.0_wp
      !$omp simd reduction(max:most)
      do k = front + height*(n - 1) + 1, front + height*n
         most = max(most, abs(velocity(k)) + reach*abs(acceleration(k)))
      end do
   end function speed_of_column

   !> Add the sums of all chunks
   pure subroutine count_sums(chunk_sums, tally)
      !> As from `accelerate`
      type(sums_type), intent(in) :: chunk_sums(:)
      !> Gets the sums over all points of this rank that no other counts
      type(exact_sums_type), intent(inout) :: tally

      integer :: c, i

      do c = 1, size(chunk_sums)
         associate (sums => chunk_sums(c))
            do i = 1, 3
               call tally%add(momentum_sum + i, sums%momentum(i))
            end do
            call tally%add(kinetic_sum, sums%twice_kinetic)
            call tally%add(added_sum, sums%twice_added)
            call tally%add(pull_sum, sums%pull)
            call tally%add(power_sum, sums%power)
         end associate
      end do
      ! a rank may have no chunk
      if (size(chunk_sums) > 0) call tally%add(speed_sum, maxval(chunk_sums%fastest))
   end subroutine count_sums

   !> Inertia that the points of a column share, as the scheme adds it, and how fast they get
   pure subroutine couple(domain, node, half_step, reach, velocity, acceleration, sums)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: node
      real(wp), intent(in) :: half_step, reach
      real(wp), intent(in), contiguous :: velocity(:)
      real(wp), intent(inout), contiguous :: acceleration(:)
      type(sums_type), intent(inout) :: sums

      if (domain%inertia%thickness%active) then
         call couple_column(domain%inertia%thickness, domain%columns, domain%inertia%mass, node, &
            & half_step, &
            & velocity, acceleration, sums)
         call add_pair_energy(domain%inertia%pairs, domain%columns, node, half_step, velocity, &
            & acceleration, sums)
      else
         call couple_pairs(domain%inertia%pairs, domain%columns, node, half_step, velocity, &
            & acceleration, sums)
      end if
      sums%fastest = max(sums%fastest, &
         & speed_of_column(domain%columns%height, node, reach, velocity, acceleration))
   end subroutine couple

   !> Give both points of every tied face between lanes side by side the sum of their forces
   pure subroutine share_forces(width, levels, tied, force)
      integer, intent(in) :: width, levels
      !> 1 where the top of a lane is tied to the bottom of the next, else 0
      real(wp), intent(in) :: tied(width)
      !> Forces of a column, lane by lane, then level by level
      real(wp), intent(inout) :: force(width*levels, 3)

      real(wp) :: above, below
      integer :: c, l, top

      top = width*(levels - 1)
      do c = 1, 3
         !$omp simd private(above, below)
         do l = 1, width
            below = force(top + l, c)
            above = force(l + 1, c)
            ! the last lane, never tied, meets the next level here, and leaves it as it was: first
            force(l + 1, c) = above + tied(l)*below
            force(top + l, c) = below + tied(l)*above
         end do
      end do
   end subroutine share_forces

   !> Force over mass of one family above a node, and its part in the sums
   pure subroutine divide(rows, half_step, reach, mass, inverse_mass, v, a, part)
      integer, intent(in) :: rows
      real(wp), intent(in) :: half_step, reach, mass(lanes, rows), inverse_mass(lanes, rows)
      real(wp), intent(in) :: v(lanes, rows, 3)
      real(wp), intent(inout) :: a(lanes, rows, 3), part(lanes, parts)

      real(wp) :: fastest, kinetic, power, pull, px, py, pz, vx, vy, vz
      integer :: l, r

      !$omp simd private(fastest, kinetic, power, pull, px, py, pz, vx, vy, vz, r)
      do l = 1, lanes
         px = part(l, 1)
         py = part(l, 2)
         pz = part(l, 3)
         kinetic = part(l, kinetic_at)
         power = part(l, power_at)
         pull = part(l, pull_at)
         fastest = part(l, fastest_at)
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
            pull = pull + mass(l, r)*(a(l, r, 1)**2 + a(l, r, 2)**2 + a(l, r, 3)**2)
            fastest = max(fastest, abs(v(l, r, 1)) + reach*abs(a(l, r, 1)), &
               & abs(v(l, r, 2)) + reach*abs(a(l, r, 2)), abs(v(l, r, 3)) + reach*abs(a(l, r, 3)))
            if (r == rows) exit
         end do
         part(l, 1) = px
         part(l, 2) = py
         part(l, 3) = pz
         part(l, kinetic_at) = kinetic
         part(l, power_at) = power
         part(l, pull_at) = pull
         part(l, fastest_at) = fastest
      end do
   end subroutine divide

end module plydyn_method_central_difference
