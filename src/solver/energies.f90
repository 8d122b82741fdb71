!> The energy balance, closed in every step.
!>
!> Inner forces and loads do the work 1/2 (f_n + f_n+1) . (u_n+1 - u_n) over a step, which is what
!> central differences conserve. The kinetic energy is that of the velocity at the full step,
!> v_n = v_n-1/2 + 1/2 dt a_n, which is never negative: its difference to the conserved form,
!> 1/8 dt^2 a M a, shows up as error when the highest modes of the mesh carry energy.
module plydyn_solver_energies
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_solver_forces, only : load_power
   use plydyn_solver_supports, only : support_power
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: begin_work, balance

   !> Sums over all points
   type :: sums_type
      !> m v v, m v a, m a a
      real(wp) :: vv = 0.0_wp, va = 0.0_wp, aa = 0.0_wp
      !> m v and m a along x, y, z
      real(wp) :: v(3) = 0.0_wp, a(3) = 0.0_wp
   end type sums_type

contains

   !> Power at the beginning of a step, with the velocity over it; once supports and contact are in
   subroutine begin_work(domain, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Powers
      type(state_type), intent(inout) :: state

      real(wp) :: loads, supports

      loads = load_power(domain, state%load_factor, state%velocity)
      supports = support_power(domain, state)
      state%internal_power = state%internal_power + loads + supports
      state%external_power = loads + supports
   end subroutine begin_work

   !> Energies at the end of a step, from the accelerations there
   subroutine balance(domain, state)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Energies
      type(state_type), intent(inout) :: state

      type(sums_type) :: sums
      real(wp) :: loads, step, supports
      integer :: i

      sums = new_sums(domain, state)
      step = state%step_before
      loads = load_power(domain, state%load_factor, state%velocity)
      supports = support_power(domain, state)
      associate (e => state%energies)
         e%kinetic = 0.5_wp*(sums%vv + step*sums%va + 0.25_wp*step**2*sums%aa)
         e%internal = e%internal &
            & + 0.5_wp*step*(state%internal_power + loads + supports - sums%va)
         e%external = e%external + 0.5_wp*step*(state%external_power + loads + supports)
         e%damping = e%damping + 2.0_wp*step*domain%control%damping*e%kinetic
         e%momentum(:) = sums%v + 0.5_wp*step*sums%a
         e%impactor = 0.0_wp
         do i = 1, size(state%impactors)
            associate (impactor => domain%impactors(i), v => state%impactors(i)%velocity)
               e%impactor = e%impactor + 0.5_wp*impactor%mass*dot_product(v, v)
               e%momentum(:) = e%momentum + impactor%mass*v
            end associate
         end do
         e%reference = max(e%reference, abs(e%start), abs(e%external), &
            & e%kinetic + e%impactor + abs(e%internal))
      end associate
   end subroutine balance

   !> Sums over all points, node by node
   pure function new_sums(domain, state) result(sums)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      type(sums_type) :: sums
      integer :: f

      do f = 1, size(domain%columns%families)
         associate (family => domain%columns%families(f))
            call add_sums(lanes*family%blocks*(family%order + 1), domain%columns%nodes, &
               & domain%mass(family%first_mass), state%velocity(family%first), &
               & state%acceleration(family%first), sums)
         end associate
      end do
   end function new_sums

   !> Add the sums of one family
   pure subroutine add_sums(width, nodes, mass, v, a, sums)
      integer, intent(in) :: width, nodes
      real(wp), intent(in) :: mass(width, nodes), v(width, 3, nodes), a(width, 3, nodes)
      type(sums_type), intent(inout) :: sums

      real(wp) :: ma, maa, mv, mva, mvv
      integer :: c, i, n

      do n = 1, nodes
         do c = 1, 3
            mv = 0.0_wp
            ma = 0.0_wp
            mvv = 0.0_wp
            mva = 0.0_wp
            maa = 0.0_wp
            !$omp simd reduction(+:mv, ma, mvv, mva, maa)
            do i = 1, width
               mv = mv + mass(i, n)*v(i, c, n)
               ma = ma + mass(i, n)*a(i, c, n)
               mvv = mvv + mass(i, n)*v(i, c, n)*v(i, c, n)
               mva = mva + mass(i, n)*v(i, c, n)*a(i, c, n)
               maa = maa + mass(i, n)*a(i, c, n)*a(i, c, n)
            end do
            sums%v(c) = sums%v(c) + mv
            sums%a(c) = sums%a(c) + ma
            sums%vv = sums%vv + mvv
            sums%va = sums%va + mva
            sums%aa = sums%aa + maa
         end do
      end do
   end subroutine add_sums

end module plydyn_solver_energies
