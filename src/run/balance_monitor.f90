!> Stop a run whose elements have not stored or dissipated the work of their forces. All ranks come
!> to the same verdict, since energies are those of the whole model.
module plydyn_run_balance_monitor
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
   use plydyn_run_worst_point, only : moment
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: check_balance, new_balance_monitor

   !> Most steps between two looks at the stored energy, which takes a sum over all Gauss points
   integer, parameter :: steps_per_look = 1000

   !> Looks at the stored energy with every line of the history of energies, and now and then
   type, public, extends(observer_type) :: balance_monitor_type
   contains
      procedure :: notify
   end type balance_monitor_type

contains

   !> A monitor
   pure type(balance_monitor_type) function new_balance_monitor() result(self)

      self%clocks = [every_steps(steps_per_look)]
   end function new_balance_monitor

   !> Stop elements that make or lose energy
   subroutine notify(self, simulation, requests, error)
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
   end subroutine notify

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

end module plydyn_run_balance_monitor
