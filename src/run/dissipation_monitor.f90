!> Warns of dissipated energies that have fallen: those of contact, friction and of each mechanism
!> of plies and interfaces can only rise. What has fallen was given to the motion. Damping is left
!> out: its force in a step is that of the velocity without contact, and so may push where contact
!> reverses the velocity.
module plydyn_run_dissipation_monitor
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_io_job, only : job_type
   use plydyn_method_clock, only : every_steps
   use plydyn_method_element_balance, only : mechanism_names, mechanisms
   use plydyn_method_observer, only : observer_type, requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_run_worst_point, only : moment
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: giver_of_energy, new_dissipation_monitor

   !> Energies of the whole model, in their order: contact, friction of contact
   integer, parameter :: at_contact = 1, at_friction = 2, whole = 2
   !> Share of the energy that went in by which one of them may fall without a warning
   real(wp), parameter :: fall_share = 5.0e-3_wp

   !> Looks at the energies of every step, and at those of mechanisms with every line of the history
   !> of energies
   type, public, extends(observer_type) :: dissipation_monitor_type
      private
      !> Where a warning goes
      type(job_type) :: job
      !> Those of the whole model, of mechanisms, and of friction of each impactor and fixture: the
      !> largest so far, and whether there was a warning
      real(wp), allocatable :: largest(:)
      logical, allocatable :: has_warned(:)
   contains
      procedure :: notify
   end type dissipation_monitor_type

contains

   !> A monitor
   function new_dissipation_monitor(job, state) result(self)
      type(job_type), intent(in) :: job
      !> The state that the run begins with
      type(state_type), intent(in) :: state
      type(dissipation_monitor_type) :: self

      integer :: energies

      self%job = job
      self%clocks = [every_steps(1)]
      self%reads_motion = .false.
      energies = whole + mechanisms + size(state%impactors) + size(state%fixtures)
      allocate (self%largest(energies), source=-huge(1.0_wp))
      allocate (self%has_warned(energies), source=.false.)
   end function new_dissipation_monitor

   !> Look at a step
   subroutine notify(self, simulation, requests, error)
      class(dissipation_monitor_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(requests_type), intent(inout) :: requests
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      associate (state => simulation%state)
         call look(self, at_contact, state%energies%contact, simulation)
         call look(self, at_friction, state%energies%friction, simulation)
         if (allocated(requests%balance)) then
            do i = 1, mechanisms
               call look(self, whole + i, requests%balance%dissipated(i), simulation)
            end do
         end if
         associate (impactors => size(state%impactors))
            do i = 1, impactors
               call look(self, whole + mechanisms + i, state%impactors(i)%friction, simulation)
            end do
            do i = 1, size(state%fixtures)
               call look(self, whole + mechanisms + impactors + i, state%fixtures(i)%friction, &
                  & simulation)
            end do
         end associate
      end associate
   end subroutine notify

   !> Warn once where an energy has fallen too far
   subroutine look(self, i, energy, simulation)
      type(dissipation_monitor_type), intent(inout) :: self
      !> Number of the energy, and its value
      integer, intent(in) :: i
      real(wp), intent(in) :: energy
      class(simulation_type), intent(in) :: simulation

      real(wp) :: fall

      self%largest(i) = max(self%largest(i), energy)
      fall = self%largest(i) - energy
      associate (domain => simulation%domain, state => simulation%state, &
         & reference => simulation%state%energies%reference)
         ! what is no longer finite ends the run with words of its own
         if (self%has_warned(i) .or. .not. fall > fall_share*reference) return
         self%has_warned(i) = .true.
         call self%job%note("warning: the energy of "//name_of(i, domain, state)//" has fallen " &
            & //"by "//text(fall, 3)//" "//trim(simulation%model%control%units%energy)//", " &
            & //text(100.0_wp*fall/reference, 2)//" % of the energy that went in, though it can " &
            & //"only rise"//moment(state)//": it was given to the motion; do not trust what " &
            & //"follows before a smaller TSSFAC of *CONTROL_TIMESTEP, or IMPL 0 of " &
            & //"*CONTROL_LAYERWISE, shows the same")
      end associate
   end subroutine look

   !> Name of an energy
   function name_of(i, domain, state) result(name)
      !> Its number
      integer, intent(in) :: i
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      character(:), allocatable :: name

      if (i == at_contact) then
         name = "contact ("//giver_of_energy(domain, state)//" has given the most)"
      else if (i == at_friction) then
         name = "contact friction"
      else if (i <= whole + mechanisms) then
         name = trim(mechanism_names(i - whole))
      else
         name = "contact friction between "//body_name(i - whole - mechanisms, domain) &
            & //" and the plate"
      end if
   end function name_of

   !> The pair of bodies whose contact has lost least, or given most
   function giver_of_energy(domain, state) result(words)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      character(:), allocatable :: words

      integer :: body

      body = minloc([state%impactors%contact, state%fixtures%contact], 1)
      words = "the plate"
      if (body > 0) words = body_name(body, domain)//" with the plate"
   end function giver_of_energy

   !> Kind and the user's number of a body
   function body_name(body, domain) result(name)
      !> Its number: impactors, then fixtures
      integer, intent(in) :: body
      type(domain_type), intent(in) :: domain
      character(:), allocatable :: name

      associate (impactors => domain%contact%impactors, fixtures => domain%contact%fixtures)
         if (body <= size(impactors)) then
            name = "impactor "//text(impactors(body)%id)
         else
            name = "fixture "//text(fixtures(body - size(impactors))%id)
         end if
      end associate
   end function body_name

end module plydyn_run_dissipation_monitor
