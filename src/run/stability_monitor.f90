!> Stops a run that has become unstable, and names the worst point.
!>
!> All ranks come to the same verdict, since energies are those of the whole model. Each looks at
!> its own points; of several that are equally bad, the point with the least number is named.
module plydyn_run_stability_monitor
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use plydyn_base_error, only : error_type, exit_run, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_delamination, only : can_fail, delamination, delamination_type
   use plydyn_domain_dissipation, only : dissipated_energies
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_contact_step, only : contacts_type
   use plydyn_method_observer, only : observer_type, requests_type
   use plydyn_model_control, only : all_explicit
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: check_stability, new_stability_monitor

   !> Half-step correction of an unstable motion, as a multiple of the energy that went in. With a
   !> share s of the stable step it is at most s**2/(1 - s**2) times the energy of a mode: 4 times
   !> at 0.9
   real(wp), parameter :: unstable_correction = 100.0_wp
   !> Steps between two looks at the stored energy, which takes a sum over all histories
   integer, parameter :: steps_per_look = 1000
   !> Names of the directions
   character(1), parameter :: axis(3) = ["x", "y", "z"]

   !> Checks every step
   type, public, extends(observer_type) :: stability_monitor_type
   contains
      procedure :: due
      procedure :: notify
   end type stability_monitor_type

   !> The worst point of some
   type :: worst_point_type
      !> Speed, or another measure; negative for no point
      real(wp) :: badness = -1.0_wp
      !> The user's number of the node, and layer and direction there
      integer :: node_id = huge(1), layer = 1, direction = 1
   contains
      procedure :: name => point_name
   end type worst_point_type

contains

   !> A monitor
   pure type(stability_monitor_type) function new_stability_monitor() result(self)

      self%reads_motion = .false.
   end function new_stability_monitor

   !> Every step is checked, and its motion is of interest only when the run fails
   pure logical function due(self, time, cycle, is_last)
      class(stability_monitor_type), intent(in) :: self
      !> As in `observer_type`
      real(wp), intent(in) :: time
      integer, intent(in) :: cycle
      logical, intent(in) :: is_last

      due = .true.
   end function due

   !> Check a step
   subroutine notify(self, domain, contacts, state, requests, error)
      class(stability_monitor_type), intent(inout) :: self
      !> As in `observer_type`
      type(domain_type), intent(in) :: domain
      type(contacts_type), intent(in) :: contacts
      type(state_type), intent(inout) :: state
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      call check_stability(domain, state, error)
   end subroutine notify

   !> Numbers that are not finite, and an energy balance past its limit; all ranks must come here
   subroutine check_stability(domain, state, error)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The state
      type(state_type), intent(in) :: state
      !> Kind, place and time of the instability; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      if (.not. ieee_is_finite(state%energies%total())) then
         call fail(error, exit_run, "the motion is no longer finite"//when(state) &
            & //first_infinite(domain, state))
      else if (abs(state%energies%error()) > domain%control%energy_limit) then
         call fail(error, exit_run, "the energy balance is off by " &
            & //text(100.0_wp*state%energies%error(), 3)//" %, more than the " &
            & //text(100.0_wp*domain%control%energy_limit, 3) &
            & //" % allowed (ENGLIM of *CONTROL_LAYERWISE)"//when(state)//fastest(domain, state))
      else if (state%energies%half_step_correction > unstable_correction*state%energies%reference &
         & .and. state%energies%reference > 0.0_wp) then
         call fail(error, exit_run, "the motion is unstable"//when(state)//fastest(domain, state) &
            & //"; a smaller TSSFAC may help (it is "//text(domain%control%step_factor)//")")
      else if (state%step < domain%control%smallest_share*state%first_step &
         & .and. .not. state%is_finished()) then
         call fail(error, exit_run, "the step of "//text(state%step)//" is below the share of " &
            & //"the first step, "//text(state%first_step)//", at which the run is to stop (" &
            & //"DTMIN of *CONTROL_TERMINATION)"//when(state))
      else if (mod(state%cycle, steps_per_look) == 0 .or. state%is_finished()) then
         call check_stored(domain, state, error)
      end if
   end subroutine check_stability

   !> Stored energy is never negative. Faces that close again within few steps may give back more
   !> than they took, which the balance cannot see: it is work of the internal forces. Nor does the
   !> balance see dissipation
   subroutine check_stored(domain, state, error)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: dissipated, stored
      type(delamination_type), allocatable :: lost(:)

      allocate (lost(0))
      if (can_fail(domain)) lost = delamination(domain, state%history)
      dissipated = sum(dissipated_energies(domain, state%history, lost))
      ! without interfaces and dissipation the work of internal forces is what is stored
      if (.not. can_fail(domain) .and. abs(dissipated) <= 0.0_wp) return
      stored = state%energies%internal - dissipated
      if (.not. ieee_is_finite(stored)) then
         call fail(error, exit_run, "what plies and interfaces have dissipated is no longer " &
            & //"finite"//when(state)//": look for toughnesses and strengths far from those of " &
            & //"any material")
         return
      end if
      if (stored >= -domain%control%energy_limit*state%energies%reference) return
      call fail(error, exit_run, "plies and interfaces have given back more energy than they " &
         & //"took, "//text(-stored)//when(state)//remedy(domain))
   end subroutine check_stored

   !> Remedy against energy from interfaces
   function remedy(domain) result(words)
      type(domain_type), intent(in) :: domain
      character(:), allocatable :: words

      if (.not. can_fail(domain)) then
         words = ": they have dissipated more than the work of their forces, an error of the " &
            & //"program; please report it with the deck"
      else if (domain%control%scheme == all_explicit) then
         words = "; interfaces that close again do so near the stable step: CLOSE 0 of " &
            & //"*INTERFACE_COHESIVE, a smaller TSSFAC (it is "//text(domain%control%step_factor) &
            & //") or IMPL 1 of *CONTROL_LAYERWISE helps"
      else
         words = "; interfaces that close again do so near the stable step: a smaller step " &
            & //"(TSSFAC, at most 0.8 with KINEM 1, or DTMAX of *CONTROL_LAYERWISE) or central " &
            & //"differences (IMPL 0) help, and so may CLOSE 0 of *INTERFACE_COHESIVE"
      end if
   end function remedy

   !> Cycle and time
   function when(state) result(words)
      type(state_type), intent(in) :: state
      character(:), allocatable :: words

      words = " at cycle "//text(state%cycle)//", time "//text(state%time)
   end function when

   !> The first impactor or point that is not finite
   function first_infinite(domain, state) result(words)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      character(:), allocatable :: words

      type(worst_point_type) :: worst
      integer :: i

      do i = 1, size(state%impactors)
         if (all(ieee_is_finite(state%impactors(i)%velocity))) cycle
         words = ": velocity of impactor "//text(domain%contact%impactors(i)%id)
         return
      end do
      worst = worst_point(domain, merge(0.0_wp, 1.0_wp, ieee_is_finite(state%acceleration( &
         & :domain%columns%freedoms))))
      words = ": energies, while no acceleration is"
      if (worst%badness > 0.0_wp) words = ": acceleration along "//worst%name(domain)
   end function first_infinite

   !> The point that moves fastest
   function fastest(domain, state) result(words)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      character(:), allocatable :: words

      type(worst_point_type) :: worst

      worst = worst_point(domain, abs(state%velocity))
      words = ": fastest is the motion along "//worst%name(domain)//", "//text(worst%badness)
   end function fastest

   !> The point of the whole model with the largest number; of several alike that of the node with
   !> the least number of the user, and there the lowest
   type(worst_point_type) function worst_point(domain, badness) result(worst)
      type(domain_type), intent(in) :: domain
      !> Numbers at the places of the arrays of motion
      real(wp), intent(in) :: badness(:)

      real(wp) :: greatest(1), place(2)
      type(worst_point_type) :: here

      here = worst_here(domain, badness)
      greatest(1) = here%badness
      call domain%comm%max(greatest)
      worst%badness = greatest(1)
      ! the least is the greatest below zero
      greatest(1) = -huge(1.0_wp)
      if (here%badness >= worst%badness) greatest(1) = -real(here%node_id, wp)
      call domain%comm%max(greatest)
      worst%node_id = nint(-greatest(1))
      ! ranks that meet at the node have the same motion there
      place(:) = 0.0_wp
      if (here%badness >= worst%badness .and. here%node_id == worst%node_id) then
         place(:) = [here%direction, here%layer]
      end if
      call domain%comm%max(place)
      worst%direction = nint(place(1))
      worst%layer = nint(place(2))
   end function worst_point

   !> The same of the points that this rank has
   pure type(worst_point_type) function worst_here(domain, badness) result(worst)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: badness(:)

      integer :: c, k, n, t

      do n = 1, domain%columns%nodes
         do k = 1, size(domain%columns%layer_slot, 2)
            do t = 1, domain%columns%levels(k)
               do c = 1, 3
                  associate (own => badness(domain%columns%freedom(k, t, c, n)))
                     if (own > worst%badness .or. (own >= worst%badness &
                        & .and. domain%node_id(n) < worst%node_id)) then
                        worst = worst_point_type(own, domain%node_id(n), k, c)
                     end if
                  end associate
               end do
            end do
         end do
      end do
   end function worst_here

   !> Direction and place of a point, in the user's numbers
   function point_name(self, domain) result(words)
      class(worst_point_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      character(:), allocatable :: words

      words = axis(self%direction)//" at node "//text(self%node_id)
      if (all(domain%layers%order == 0)) return
      words = words//", ply "//text(domain%layers%ply(self%layer))//" from the bottom"
   end function point_name

end module plydyn_run_stability_monitor
