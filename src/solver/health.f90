!> Guards that stop a run which has gone wrong, and name the culprit.
module plydyn_solver_health
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use plydyn_base_error, only : error_type, exit_run, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_delamination, only : can_fail
   use plydyn_domain_dissipation, only : dissipated_energies
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_control, only : all_explicit
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: check_health

   !> Ripple of an unstable motion, as a multiple of the energy that went in. With a share s of the
   !> stable step at most s**2/(1 - s**2) times the energy of a mode is ripple: 4 times at 0.9
   real(wp), parameter :: unstable_ripple = 100.0_wp
   !> Steps between two looks at what is stored, which takes a sum over all histories
   integer, parameter :: steps_per_look = 1000
   !> Names of the directions
   character(1), parameter :: axis(3) = ["x", "y", "z"]

contains

   !> Numbers that are not finite, and an energy balance past its limit
   subroutine check_health(domain, state, error)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The state
      type(state_type), intent(in) :: state
      !> What is wrong, where and when
      type(error_type), allocatable, intent(out) :: error

      if (.not. ieee_is_finite(state%energies%total())) then
         call fail(error, exit_run, "the motion is no longer finite"//when(state) &
            & //culprit(domain, state))
      else if (abs(state%energies%error()) > domain%control%energy_limit) then
         call fail(error, exit_run, "the energy balance is off by " &
            & //text(100.0_wp*state%energies%error(), 3)//" %, more than the " &
            & //text(100.0_wp*domain%control%energy_limit, 3) &
            & //" % allowed (ENGLIM of *CONTROL_LAYERWISE)"//when(state)//fastest(domain, state))
      else if (state%energies%ripple > unstable_ripple*state%energies%reference &
         & .and. state%energies%reference > 0.0_wp) then
         call fail(error, exit_run, "the motion is unstable"//when(state)//fastest(domain, state) &
            & //"; a smaller TSSFAC may help (it is "//text(domain%control%step_factor)//")")
      else if (state%step < domain%control%smallest_share*state%first_step &
         & .and. .not. state%is_finished()) then
         call fail(error, exit_run, "the step of "//text(state%step)//" is below the share of " &
            & //"the first step, "//text(state%first_step)//", at which the run is to stop (" &
            & //"DTMIN of *CONTROL_TERMINATION)"//when(state))
      else if (mod(state%cycle, steps_per_look) == 0) then
         call check_stored(domain, state, error)
      end if
   end subroutine check_health

   !> Nothing stores less than no energy. Faces that close again in few steps each may give back
   !> more than they took, which the balance cannot see: it is work of the internal forces
   subroutine check_stored(domain, state, error)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: stored

      if (.not. can_fail(domain)) return
      stored = state%energies%internal - sum(dissipated_energies(domain, state%history))
      if (stored >= -domain%control%energy_limit*state%energies%reference) return
      call fail(error, exit_run, "plies and interfaces have given back more energy than they " &
         & //"took, "//text(-stored)//when(state)//"; interfaces that close again do so near " &
         & //"the stable step: "//remedy(domain))
   end subroutine check_stored

   !> What helps against energy out of interfaces
   function remedy(domain) result(words)
      type(domain_type), intent(in) :: domain
      character(:), allocatable :: words

      words = "CLOSE 0 of *INTERFACE_COHESIVE, a smaller TSSFAC (it is " &
         & //text(domain%control%step_factor)//") or IMPL 1 of *CONTROL_LAYERWISE helps"
      if (domain%control%scheme == all_explicit) return
      words = "a smaller step (DTMAX of *CONTROL_LAYERWISE) or central differences (IMPL 0) help" &
         & //", and so may CLOSE 0 of *INTERFACE_COHESIVE"
   end function remedy

   !> Cycle and time
   function when(state) result(words)
      type(state_type), intent(in) :: state
      character(:), allocatable :: words

      words = " at cycle "//text(state%cycle)//", time "//text(state%time)
   end function when

   !> The first impactor or point that is not finite
   function culprit(domain, state) result(words)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      character(:), allocatable :: words

      integer :: c, i, k, n, t

      do i = 1, size(state%impactors)
         if (all(ieee_is_finite(state%impactors(i)%velocity))) cycle
         words = ": velocity of impactor "//text(domain%impactors(i)%id)
         return
      end do
      words = ": energies, while no acceleration is"
      do n = 1, domain%columns%nodes
         do k = 1, size(domain%columns%home, 2)
            do t = 1, domain%columns%levels(k)
               do c = 1, 3
                  if (ieee_is_finite(state%acceleration(domain%columns%freedom(k, t, c, n)))) cycle
                  words = ": acceleration along "//axis(c)//point_name(domain, k, n)
                  return
               end do
            end do
         end do
      end do
   end function culprit

   !> The point that moves fastest
   function fastest(domain, state) result(words)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      character(:), allocatable :: words

      integer :: c, k, n, t, worst(3)
      real(wp) :: speed

      speed = -1.0_wp
      worst(:) = 1
      do n = 1, domain%columns%nodes
         do k = 1, size(domain%columns%home, 2)
            do t = 1, domain%columns%levels(k)
               do c = 1, 3
                  associate (v => state%velocity(domain%columns%freedom(k, t, c, n)))
                     if (abs(v) <= speed) cycle
                     speed = abs(v)
                     worst(:) = [c, k, n]
                  end associate
               end do
            end do
         end do
      end do
      words = ": fastest is the motion along "//axis(worst(1)) &
         & //point_name(domain, worst(2), worst(3))//", "//text(speed)
   end function fastest

   !> Where a point is, in the user's numbers
   function point_name(domain, layer, node) result(words)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: layer, node
      character(:), allocatable :: words

      words = " at node "//text(domain%node_id(node))
      if (size(domain%bricks) > 0) return
      words = words//", ply "//text(domain%layers%ply(layer)) &
         & //" from the bottom"
   end function point_name

end module plydyn_solver_health
