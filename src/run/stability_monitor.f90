!> Stop a run whose motion is no longer finite, before anything of it is written, or that has become
!> unstable, or whose elements have not stored or dissipated the work of their forces. All ranks
!> come to the same verdict, since energies are those of the whole model.
module plydyn_run_stability_monitor
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use plydyn_base_error, only : error_type, exit_run, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_delamination, only : can_fail
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_clock, only : every_steps
   use plydyn_method_element_balance, only : balance_of, element_balance_type
   use plydyn_method_observer, only : observer_type, requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_model_control, only : all_explicit
   use plydyn_model_model, only : model_type
   use plydyn_run_dissipation_monitor, only : giver_of_energy
   use plydyn_run_worst_point, only : moment, name_of, worst_point, worst_point_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: check_balance, check_finite, check_stability, new_balance_monitor, &
      & new_stability_monitor

   !> Half-step correction of an unstable motion, as a multiple of the energy that went in. With a
   !> share s of the stable step it is at most s**2/(1 - s**2) times the energy of a mode: 4 times
   !> at 0.9
   real(wp), parameter :: unstable_correction = 100.0_wp
   !> Most steps between two looks at the stored energy, which takes a sum over all Gauss points
   integer, parameter :: steps_per_look = 1000

   !> Looks at every step: the first monitor, before others are notified, whether the motion is
   !> finite; the last one whether it is stable
   type, public, extends(observer_type) :: stability_monitor_type
      private
      !> Whether it is the first one
      logical :: is_first = .true.
   contains
      procedure :: notify
   end type stability_monitor_type

   !> Looks at the stored energy with every line of the history of energies, and now and then
   type, public, extends(observer_type) :: balance_monitor_type
   contains
      procedure :: notify => notify_balance
   end type balance_monitor_type

contains

   !> A monitor; the motion is of interest only when the run fails
   pure type(stability_monitor_type) function new_stability_monitor(is_first) result(self)
      !> Whether others are notified of a step after it
      logical, intent(in) :: is_first

      self%is_first = is_first
      self%clocks = [every_steps(1)]
      self%reads_motion = .false.
   end function new_stability_monitor

   !> Stop a motion that is not finite, or not stable
   subroutine notify(self, simulation, requests, error)
      class(stability_monitor_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      if (self%is_first) then
         call check_finite(simulation%domain, simulation%model, simulation%state, error)
      else
         call check_stability(simulation%domain, simulation%model, simulation%state, error)
      end if
   end subroutine notify

   !> A monitor of the stored energy
   pure type(balance_monitor_type) function new_balance_monitor() result(self)

      self%clocks = [every_steps(steps_per_look)]
   end function new_balance_monitor

   !> Stop elements that make or lose energy
   subroutine notify_balance(self, simulation, requests, error)
      class(balance_monitor_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      associate (domain => simulation%domain, state => simulation%state)
         if (allocated(requests%balance)) then
            call check_balance(domain, state, requests%balance, error)
         else if (self%is_due(state)) then
            call check_balance(domain, state, balance_of(domain, state), error)
         end if
      end associate
   end subroutine notify_balance

   !> Energies that are not finite, and the point that is the cause. All ranks must come here
   subroutine check_finite(domain, model, state, error)
      type(domain_type), intent(in) :: domain
      type(model_type), intent(in) :: model
      type(state_type), intent(in) :: state
      !> Place and time; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      associate (e => state%energies)
         if (ieee_is_finite(e%total()) .and. ieee_is_finite(e%error())) return
      end associate
      call fail(error, exit_run, "the motion is no longer finite"//moment(state) &
         & //cause(domain, model, state)//"; the files of results end before this step")
   end subroutine check_finite

   !> The first impactor or point that is not finite, or the largest acceleration: its square may
   !> be too large for a number
   function cause(domain, model, state) result(words)
      type(domain_type), intent(in) :: domain
      type(model_type), intent(in) :: model
      type(state_type), intent(in) :: state
      character(:), allocatable :: words

      type(worst_point_type) :: worst
      integer :: i

      do i = 1, size(state%impactors)
         if (all(ieee_is_finite(state%impactors(i)%velocity))) cycle
         words = ": velocity of impactor "//text(domain%contact%impactors(i)%id)
         return
      end do
      words = ""
      ! the motion may be that of the coming step already, which follows from the accelerations
      call look_at("acceleration", state%acceleration(:domain%columns%freedoms))
      call look_at("velocity", state%velocity)
      call look_at("displacement", state%displacement)
      if (len(words) > 0) return
      worst = worst_point(domain, abs(state%acceleration(:domain%columns%freedoms)))
      words = ": the largest acceleration is along "//name_of(worst, domain, model)//", " &
         & //text(worst%badness)

   contains

      !> Name the first point of a motion that is not finite, if none was named before
      subroutine look_at(what, motion)
         character(*), intent(in) :: what
         real(wp), intent(in) :: motion(:)

         if (len(words) > 0) return
         worst = worst_point(domain, merge(0.0_wp, 1.0_wp, ieee_is_finite(motion)))
         if (worst%badness > 0.0_wp) words = ": "//what//" along "//name_of(worst, domain, model)
      end subroutine look_at

   end function cause

   !> An unstable motion, and an energy balance past its limit; all ranks must come here
   subroutine check_stability(domain, model, state, error)
      type(domain_type), intent(in) :: domain
      type(model_type), intent(in) :: model
      type(state_type), intent(in) :: state
      !> Kind, place and time of the instability; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      if (abs(state%energies%error()) > domain%control%energy_limit) then
         call fail(error, exit_run, "the energy balance is off by " &
            & //text(100.0_wp*state%energies%error(), 3)//" %, more than the " &
            & //text(100.0_wp*domain%control%energy_limit, 3) &
            & //" % allowed (ENGLIM of *CONTROL_LAYERWISE)"//moment(state) &
            & //fastest(domain, model, state))
      else if (size(state%fixtures) > 0 .and. state%energies%contact &
         & < -domain%control%energy_limit*state%energies%reference) then
         call fail(error, exit_run, "contact has given "//text(-state%energies%contact) &
            & //" of energy, more than the share allowed (ENGLIM of *CONTROL_LAYERWISE)" &
            & //moment(state)//", most of it that of "//giver_of_energy(domain, state) &
            & //sharp_edge(domain))
      else if (state%energies%half_step_correction > unstable_correction*state%energies%reference &
         & .and. state%energies%reference > 0.0_wp) then
         call fail(error, exit_run, "the motion is unstable"//moment(state) &
            & //fastest(domain, model, state)//"; a smaller TSSFAC may help (it is " &
            & //text(domain%control%step_share())//")")
      else if (state%step < domain%control%smallest_share*state%first_step &
         & .and. .not. state%is_finished()) then
         call fail(error, exit_run, "the step of "//text(state%step)//" is below the share of " &
            & //"the first step, "//text(state%first_step)//", at which the run is to stop (" &
            & //"DTMIN of *CONTROL_TERMINATION)"//moment(state))
      end if
   end subroutine check_stability

   !> A cause of energy from contact with fixtures; empty where none of them has a sharp edge
   function sharp_edge(domain) result(words)
      type(domain_type), intent(in) :: domain
      character(:), allocatable :: words

      integer :: i

      words = ""
      do i = 1, size(domain%contact%fixtures)
         associate (fixture => domain%contact%fixtures(i))
            if (fixture%is_clamp .or. fixture%body%edge > 0.0_wp) cycle
            if (size(fixture%body%outlines) == 0) cycle
            words = ": a point that slides off a sharp edge and back is lifted in one step; an " &
               & //"edge radius of fixture "//text(fixture%id)//" helps (EDGE)"
         end associate
         return
      end do
   end function sharp_edge

   !> The point that moves fastest
   function fastest(domain, model, state) result(words)
      type(domain_type), intent(in) :: domain
      type(model_type), intent(in) :: model
      type(state_type), intent(in) :: state
      character(:), allocatable :: words

      type(worst_point_type) :: worst

      worst = worst_point(domain, abs(state%velocity))
      words = ": fastest is the motion along "//name_of(worst, domain, model)//", " &
         & //text(worst%badness)
   end function fastest

   !> The work of the internal forces is what elements have stored and dissipated. Faces that close
   !> again within few steps may give back more than they took; forces that do not belong to the
   !> stored energy, and steps that are too long for a law, leave the one or the other
   subroutine check_balance(domain, state, balance, error)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      !> Energies of the elements at the time of the state
      type(element_balance_type), intent(in) :: balance
      !> Kind, amount and time; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: amounts

      if (.not. ieee_is_finite(balance%error())) then
         call fail(error, exit_run, "what plies and interfaces have stored or dissipated is no " &
            & //"longer finite"//moment(state)//": look for toughnesses and strengths far from " &
            & //"those of any material")
         return
      end if
      if (abs(balance%error())*balance%reference <= domain%control%energy_limit*balance%reference &
         & + balance%viscous) return
      amounts = moment(state)//": by their strains and stresses they have stored " &
         & //text(balance%stored)//", the work of their forces less what they have dissipated is " &
         & //text(balance%internal - balance%hourglass - sum(balance%dissipated)) &
         & //" (ENGLIM of *CONTROL_LAYERWISE)"
      if (balance%error() < 0.0_wp) then
         call fail(error, exit_run, "plies and interfaces have given back more energy than they " &
            & //"took"//amounts//remedy(domain))
      else
         call fail(error, exit_run, "plies and interfaces have lost energy"//amounts &
            & //smaller_step(domain))
      end if
   end subroutine check_balance

   !> Remedy against energy from interfaces
   function remedy(domain) result(words)
      type(domain_type), intent(in) :: domain
      character(:), allocatable :: words

      if (.not. can_fail(domain)) then
         words = smaller_step(domain)
      else if (domain%control%scheme == all_explicit) then
         words = "; interfaces that close again do so near the stable step: CLOSE 0 of " &
            & //"*INTERFACE_COHESIVE, a smaller TSSFAC (it is "//text(domain%control%step_share()) &
            & //") or IMPL 1 of *CONTROL_LAYERWISE helps"
      else
         words = "; interfaces that close again do so near the stable step: a smaller step " &
            & //"(TSSFAC, it is "//text(domain%control%step_share())//", or DTMAX of " &
            & //"*CONTROL_LAYERWISE) or central differences (IMPL 0) help, and so may CLOSE 0 of " &
            & //"*INTERFACE_COHESIVE"
      end if
   end function remedy

   !> Remedy where no cause is known
   function smaller_step(domain) result(words)
      type(domain_type), intent(in) :: domain
      character(:), allocatable :: words

      words = "; a smaller TSSFAC (it is "//text(domain%control%step_share())//") shows whether " &
         & //"the step is too long for the materials; if not, it is an error of the program: " &
         & //"please report it with the deck"
   end function smaller_step

end module plydyn_run_stability_monitor
