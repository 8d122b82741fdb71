!> The central difference scheme (de Borst et al., 2012), point by point.
module plydyn_solver_motion
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: accelerate, advance

contains

   !> Velocity to the middle of the coming step, displacement to its end (the paper's eq. 15)
   subroutine advance(domain, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Velocity and displacement; power of all forces with the new velocity
      type(state_type), intent(inout) :: state

      real(wp) :: brake, middle, power
      integer :: f

      middle = 0.5_wp*(state%step_before + state%step)
      brake = 0.5_wp*domain%control%damping*middle
      power = 0.0_wp
      do f = 1, size(domain%columns%families)
         associate (family => domain%columns%families(f))
            call advance_family(lanes*family%blocks*(family%order + 1), domain%columns%nodes, &
               & (1.0_wp - brake)/(1.0_wp + brake), middle/(1.0_wp + brake), state%step, &
               & domain%mass(family%first_mass), state%acceleration(family%first), &
               & state%velocity(family%first), state%displacement(family%first), power)
         end associate
      end do
      state%internal_power = -power
   end subroutine advance

   !> `advance` for the points of one family
   pure subroutine advance_family(width, nodes, keep, middle, step, mass, a, v, u, power)
      integer, intent(in) :: width, nodes
      real(wp), intent(in) :: keep, middle, step, mass(width, nodes), a(width, 3, nodes)
      real(wp), intent(inout) :: v(width, 3, nodes), u(width, 3, nodes), power
      real(wp) :: column
      integer :: c, i, n

      do n = 1, nodes
         column = 0.0_wp
         do c = 1, 3
            !$omp simd reduction(+:column)
            do i = 1, width
               v(i, c, n) = keep*v(i, c, n) + middle*a(i, c, n)
               u(i, c, n) = u(i, c, n) + step*v(i, c, n)
               column = column + mass(i, n)*a(i, c, n)*v(i, c, n)
            end do
         end do
         power = power + column
      end do
   end subroutine advance_family

   !> Forces to accelerations, in place; tied points get one acceleration
   subroutine accelerate(domain, force)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Force in, acceleration out
      real(wp), intent(inout), contiguous :: force(:)

      integer :: f, k

      do k = 1, size(domain%ties, 2)
         call share_force(domain, domain%ties(1, k), domain%ties(2, k), force)
      end do
      do f = 1, size(domain%columns%families)
         associate (family => domain%columns%families(f))
            call divide(lanes*family%blocks*(family%order + 1), domain%columns%nodes, &
               & domain%inverse_mass(family%first_mass), force(family%first:))
         end associate
      end do
   end subroutine accelerate

   !> Give both points of a tied face the sum of their forces; the inverse mass of both is that of
   !> their sum
   pure subroutine share_force(domain, lower, upper, force)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: lower, upper
      real(wp), intent(inout) :: force(:)

      integer :: above, below, c, n, stride(2)

      associate (columns => domain%columns)
         below = columns%freedom(lower, columns%levels(lower), 1, 1)
         above = columns%freedom(upper, 1, 1, 1)
         stride(:) = [columns%freedom(lower, 1, 2, 1) - columns%freedom(lower, 1, 1, 1), &
            & columns%freedom(upper, 1, 2, 1) - columns%freedom(upper, 1, 1, 1)]
         do n = 1, columns%nodes
            do c = 1, 3
               force(below) = force(below) + force(above)
               force(above) = force(below)
               below = below + stride(1)
               above = above + stride(2)
            end do
         end do
      end associate
   end subroutine share_force

   !> Force over mass
   pure subroutine divide(width, nodes, inverse_mass, a)
      integer, intent(in) :: width, nodes
      real(wp), intent(in) :: inverse_mass(width, nodes)
      real(wp), intent(inout) :: a(width, 3, nodes)
      integer :: c, n

      do n = 1, nodes
         do c = 1, 3
            a(:, c, n) = a(:, c, n)*inverse_mass(:, n)
         end do
      end do
   end subroutine divide

end module plydyn_solver_motion
