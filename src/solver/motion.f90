!> The central difference scheme (de Borst et al., 2012), column by column.
module plydyn_solver_motion
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_solver_pair_inertia, only : couple_pairs
   use plydyn_state_state, only : state_type, sums_type
   implicit none
   private

   public :: accelerate, advance

contains

   !> Velocity to the middle of the coming step, displacement to its end (the paper's eq. 15). The
   !> power of all forces with the new velocity, and the work of damping, follow from the sums at
   !> the full step before, whatever inertia is behind the accelerations
   subroutine advance(domain, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Velocity and displacement; power of all forces with the new velocity; work of damping
      type(state_type), intent(inout) :: state

      real(wp) :: brake, keep, middle, middle_step
      integer :: f

      middle_step = 0.5_wp*(state%step_before + state%step)
      brake = 0.5_wp*domain%control%damping*middle_step
      keep = (1.0_wp - brake)/(1.0_wp + brake)
      middle = middle_step/(1.0_wp + brake)
      do f = 1, size(domain%columns%families)
         associate (family => domain%columns%families(f))
            call advance_family(3*lanes*family%blocks*(family%order + 1)*domain%columns%nodes, &
               & keep, middle, state%step, state%acceleration(family%first), &
               & state%velocity(family%first), state%displacement(family%first))
         end associate
      end do
      associate (sums => state%sums, before => state%step_before)
         state%internal_power = -keep*sums%power - middle*sums%pull
         ! the velocity before is the one at the full step less 1/2 dt a
         state%energies%damping = state%energies%damping + 0.5_wp*brake*((1.0_wp + keep)**2 &
            & *(sums%twice_kinetic + sums%twice_added &
            & - before*(sums%power + 0.25_wp*before*sums%pull)) &
            & + middle*(2.0_wp*(1.0_wp + keep)*sums%power + middle*sums%pull))
      end associate
   end subroutine advance

   !> `advance` for the points of one family
   pure subroutine advance_family(places, keep, middle, step, a, v, u)
      integer, intent(in) :: places
      real(wp), intent(in) :: keep, middle, step, a(places)
      real(wp), intent(inout) :: v(places), u(places)
      integer :: i

      do i = 1, places
         v(i) = keep*v(i) + middle*a(i)
         u(i) = u(i) + step*v(i)
      end do
   end subroutine advance_family

   !> Forces to accelerations, in place, with the sums that the energies need.
   !> Both points of a tied face get the sum of their forces; their inverse mass is that of both, so
   !> their accelerations are the same to the last bit.
   subroutine accelerate(domain, step, velocity, force, sums)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The step just made
      real(wp), intent(in) :: step
      !> Velocity of all points, half a step before
      real(wp), intent(in), contiguous :: velocity(:)
      !> Force in, acceleration out
      real(wp), intent(inout), contiguous :: force(:)
      !> Sums over all points
      type(sums_type), intent(out) :: sums

      integer :: f, k, n

      do k = 1, size(domain%far_ties, 2)
         force(domain%far_ties(:, k)) = sum(force(domain%far_ties(:, k)))
      end do
      do f = 1, size(domain%columns%families)
         associate (family => domain%columns%families(f))
            if (any(family%tied_above > 0.0_wp)) then
               call share_forces(lanes*family%blocks, family%order + 1, domain%columns%nodes, &
                  & family%tied_above, force(family%first:))
            end if
            call divide(family%blocks*(family%order + 1), domain%columns%nodes, 0.5_wp*step, &
               & domain%mass(family%first_mass), domain%inverse_mass(family%first_mass), &
               & velocity(family%first:), force(family%first:), sums)
         end associate
      end do
      if (domain%pairs%active) then
         do n = 1, domain%columns%nodes
            call couple_pairs(domain%pairs, domain%columns, n, 0.5_wp*step, velocity, force, sums)
         end do
      end if
   end subroutine accelerate

   !> Give both points of every tied face between lanes side by side the sum of their forces
   pure subroutine share_forces(width, levels, nodes, tied, force)
      integer, intent(in) :: width, levels, nodes
      real(wp), intent(in) :: tied(width)
      real(wp), intent(inout) :: force(width, levels, 3, nodes)

      real(wp), dimension(width) :: above, below, tied_below
      integer :: c, n

      tied_below(1) = 0.0_wp
      tied_below(2:) = tied(:width - 1)
      above(width) = 0.0_wp
      below(1) = 0.0_wp
      do n = 1, nodes
         do c = 1, 3
            above(:width - 1) = force(2:, 1, c, n)
            below(2:) = force(:width - 1, levels, c, n)
            force(:, levels, c, n) = force(:, levels, c, n) + tied*above
            force(:, 1, c, n) = force(:, 1, c, n) + tied_below*below
         end do
      end do
   end subroutine share_forces

   !> Force over mass, and the sums of one family, node by node
   pure subroutine divide(rows, nodes, half_step, mass, inverse_mass, v, a, sums)
      integer, intent(in) :: rows, nodes
      real(wp), intent(in) :: half_step, mass(lanes, rows, nodes), inverse_mass(lanes, rows, nodes)
      real(wp), intent(in) :: v(lanes, rows, 3, nodes)
      real(wp), intent(inout) :: a(lanes, rows, 3, nodes)
      type(sums_type), intent(inout) :: sums

      real(wp), dimension(lanes) :: pull, kinetic, momentum, power
      real(wp) :: now
      integer :: c, l, n, r

      do n = 1, nodes
         pull(:) = 0.0_wp
         kinetic(:) = 0.0_wp
         power(:) = 0.0_wp
         do c = 1, 3
            momentum(:) = 0.0_wp
            do r = 1, rows
               !$omp simd private(now)
               do l = 1, lanes
                  a(l, r, c, n) = a(l, r, c, n)*inverse_mass(l, r, n)
                  now = v(l, r, c, n) + half_step*a(l, r, c, n)
                  momentum(l) = momentum(l) + mass(l, r, n)*now
                  kinetic(l) = kinetic(l) + mass(l, r, n)*now*now
                  power(l) = power(l) + mass(l, r, n)*a(l, r, c, n)*v(l, r, c, n)
                  pull(l) = pull(l) + mass(l, r, n)*a(l, r, c, n)**2
               end do
            end do
            sums%momentum(c) = sums%momentum(c) + sum(momentum)
         end do
         sums%twice_kinetic = sums%twice_kinetic + sum(kinetic)
         sums%power = sums%power + sum(power)
         sums%pull = sums%pull + sum(pull)
      end do
   end subroutine divide

end module plydyn_solver_motion
