!> The central difference scheme (de Borst et al., 2012), column by column.
module plydyn_solver_motion
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_columns, only : front
   use plydyn_domain_domain, only : chunk_type, domain_type
   use plydyn_solver_column_inertia, only : couple_column
   use plydyn_solver_pair_inertia, only : add_pair_energy, couple_pairs
   use plydyn_state_state, only : added_sum, kinetic_sum, momentum_sum, power_sum, pull_sum, &
      & speed_sum, state_type, sums_type
   implicit none
   private

   public :: accelerate, accelerate_chunk, advance, count_sums

   !> Sums of a block, lane by lane: momentum along x, y, z, then these; at last no sum but a bound
   integer, parameter :: kinetic_at = 4, power_at = 5, pull_at = 6, fastest_at = 7, parts = 7
   !> Share by which the last step may exceed the largest, and room for round-off
   real(wp), parameter :: room = 1.0e-5_wp

contains

   !> Velocity to the middle of the coming step, displacement to its end (the paper's eq. 15). The
   !> power of all forces with the new velocity, and the work of damping, follow from the sums at
   !> the full step before, whatever inertia is behind the accelerations. All threads come here
   !> together, and wait for each other
   subroutine advance(domain, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Velocity and displacement; power of all forces with the new velocity; work of damping
      type(state_type), intent(inout) :: state

      real(wp) :: brake, keep, middle, middle_step
      integer :: c

      middle_step = 0.5_wp*(state%step_before + state%step)
      brake = 0.5_wp*domain%control%damping*middle_step
      keep = (1.0_wp - brake)/(1.0_wp + brake)
      middle = middle_step/(1.0_wp + brake)
      !$omp master
      associate (sums => state%sums, before => state%step_before)
         state%internal_power = -keep*sums%power - middle*sums%pull
         ! the velocity before is the one at the full step less 1/2 dt a
         state%energies%damping = state%energies%damping + 0.5_wp*brake*((1.0_wp + keep)**2 &
            & *(sums%twice_kinetic + sums%twice_added &
            & - before*(sums%power + 0.25_wp*before*sums%pull)) &
            & + middle*(2.0_wp*(1.0_wp + keep)*sums%power + middle*sums%pull))
      end associate
      !$omp end master
      ! the thread that accelerates a chunk advances it: it still has its accelerations
      !$omp do schedule(static)
      do c = 1, size(domain%chunks)
         associate (height => domain%columns%height, chunk => domain%chunks(c), &
            & a => state%acceleration(front + 1:), v => state%velocity(front + 1:), &
            & u => state%displacement(front + 1:))
            call advance_columns(height, chunk%own, keep, middle, state%step, a, v, u)
            call advance_columns(height, chunk%guests, keep, middle, state%step, a, v, u)
         end associate
      end do
      !$omp end do
   end subroutine advance

   !> `advance` for some columns
   pure subroutine advance_columns(height, columns, keep, middle, step, a, v, u)
      integer, intent(in) :: height, columns(:)
      !> Share of the velocity that is kept, the step between the middles, and the step
      real(wp), intent(in) :: keep, middle, step
      !> Acceleration, velocity, displacement
      real(wp), intent(in) :: a(height, *)
      real(wp), intent(inout) :: v(height, *), u(height, *)

      integer :: i, k, n

      do i = 1, size(columns)
         n = columns(i)
         !$omp simd
         do k = 1, height
            v(k, n) = keep*v(k, n) + middle*a(k, n)
            u(k, n) = u(k, n) + step*v(k, n)
         end do
      end do
   end subroutine advance_columns

   !> Forces to accelerations, in place, with the sums that the energies need.
   !> Both points of a tied face get the sum of their forces; their inverse mass is that of both, so
   !> their accelerations are the same to the last bit. All threads come here together.
   subroutine accelerate(domain, step, velocity, force, chunk_sums)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The step just made
      real(wp), intent(in) :: step
      !> Velocity of all points, half a step before
      real(wp), intent(in), contiguous :: velocity(:)
      !> Force in, acceleration out
      real(wp), intent(inout), contiguous :: force(:)
      !> Sums over the points that each chunk has first, the same for any number of threads
      type(sums_type), intent(inout) :: chunk_sums(:)

      integer :: c, k

      if (size(domain%far_ties, 2) > 0) then
         !$omp barrier
         !$omp do schedule(static)
         do k = 1, size(domain%far_ties, 2)
            force(domain%far_ties(:, k)) = sum(force(domain%far_ties(:, k)))
         end do
         !$omp end do
      end if
      !$omp do schedule(static)
      do c = 1, size(domain%chunks)
         call accelerate_chunk(domain, domain%chunks(c), step, velocity, force, chunk_sums(c))
      end do
      !$omp end do nowait
   end subroutine accelerate

   !> `accelerate` for the points that move with a chunk, where no ties reach further than a family
   pure subroutine accelerate_chunk(domain, chunk, step, velocity, force, sums)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The chunk
      type(chunk_type), intent(in) :: chunk
      !> As in `accelerate`
      real(wp), intent(in) :: step
      real(wp), intent(in), contiguous :: velocity(:)
      real(wp), intent(inout), contiguous :: force(:)
      !> Sums over the points that it has first
      type(sums_type), intent(out) :: sums

      type(sums_type) :: counted_elsewhere

      call accelerate_columns(domain, chunk%own, 0.5_wp*step, velocity, force, sums)
      call accelerate_columns(domain, chunk%guests, 0.5_wp*step, velocity, force, &
         & counted_elsewhere)
   end subroutine accelerate_chunk

   !> `accelerate` for some columns
   pure subroutine accelerate_columns(domain, columns, half_step, velocity, force, sums)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: columns(:)
      real(wp), intent(in) :: half_step
      real(wp), intent(in), contiguous :: velocity(:)
      real(wp), intent(inout), contiguous :: force(:)
      type(sums_type), intent(inout) :: sums

      real(wp) :: part(lanes, parts), reach
      integer :: f, first, i, mass, n
      logical :: is_coupled

      is_coupled = domain%thickness%active .or. domain%pairs%active
      reach = (1.0_wp + room)*domain%step
      part(:, :) = 0.0_wp
      do i = 1, size(columns)
         n = columns(i)
         do f = 1, size(domain%columns%families)
            associate (family => domain%columns%families(f))
               first = domain%columns%start(f, n)
               mass = domain%columns%mass_start(f, n)
               if (family%is_tied) then
                  call share_forces(lanes*family%blocks, family%order + 1, family%tied_above, &
                     & force(first:))
               end if
               call divide(family%blocks*(family%order + 1), half_step, reach, &
                  & domain%mass(mass:), domain%inverse_mass(mass:), velocity(first:), &
                  & force(first:), part)
            end associate
         end do
         if (is_coupled) call couple(domain, n, half_step, reach, velocity, force, sums)
      end do
      if (.not. is_coupled) sums%fastest = max(sums%fastest, maxval(part(:, fastest_at)))
      sums%momentum(:) = sums%momentum + sum(part(:, :3), 1)
      sums%twice_kinetic = sums%twice_kinetic + sum(part(:, kinetic_at))
      sums%power = sums%power + sum(part(:, power_at))
      sums%pull = sums%pull + sum(part(:, pull_at))
   end subroutine accelerate_columns

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

      if (domain%thickness%active) then
         call couple_column(domain%thickness, domain%columns, domain%mass, node, half_step, &
            & velocity, acceleration, sums)
         call add_pair_energy(domain%pairs, domain%columns, node, half_step, velocity, &
            & acceleration, sums)
      else
         call couple_pairs(domain%pairs, domain%columns, node, half_step, velocity, &
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

end module plydyn_solver_motion
