!> All that changes during a run; exactly what a restart must hold.
module plydyn_state_state
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: sums_of

   !> Sums of `state_type%tally`: momentum along x, y, z is behind the first; then those of
   !> `sums_type`
   integer, parameter, public :: momentum_sum = 0, kinetic_sum = 4, added_sum = 5, pull_sum = 6, &
      & power_sum = 7
   !> Power of loads and supports at the beginning of the step and at its end; work of prescribed
   !> motions; work of contact on the plate, and what contact changes of the power at the beginning
   integer, parameter, public :: power_before_sum = 8, power_after_sum = 9, support_sum = 10, &
      & contact_sum = 11, contact_power_sum = 12
   !> Whether there is something to write of the whole state, of sums and of impactors, and whether
   !> a rank is asked for something: more than zero
   integer, parameter, public :: output_sum = 13, rows_sum = 14, impactors_sum = 15, &
      & attention_sum = 16
   !> Over the ranks, of a bound on the speed of the points of each in the coming step: a bound on
   !> that of all
   integer, parameter, public :: speed_sum = 17
   !> Whether somebody will look at the points at the end of the next step: more than zero
   integer, parameter, public :: halt_sum = 18
   !> How many sums there are
   integer, parameter, public :: tally_sums = 18

   !> Energies at the present time
   type, public :: energies_type
      !> Motion of the plate and of the impactors
      real(wp) :: kinetic = 0.0_wp, impactor = 0.0_wp
      !> Motion of the inertia that locally implicit operators add to the plate
      real(wp) :: added = 0.0_wp
      !> What central differences add to the kinetic energy of the highest modes, 1/8 dt^2 a M a:
      !> small in a smooth motion, without bound in an unstable one
      real(wp) :: ripple = 0.0_wp
      !> Work of the internal forces: stored in the plies and interfaces
      real(wp) :: internal = 0.0_wp
      !> What changes of the step have taken from the conserved form, 1/8 a M a times the difference
      !> of the squares of the steps
      real(wp) :: shift = 0.0_wp
      !> Taken by damping, and lost where contact nodes meet
      real(wp) :: damping = 0.0_wp, contact = 0.0_wp
      !> Work of loads, supports and gravity
      real(wp) :: external = 0.0_wp
      !> Kinetic energy at time zero
      real(wp) :: start = 0.0_wp
      !> Most energy that went in so far: what the error is a share of
      real(wp) :: reference = 0.0_wp
      !> Momentum of plate and impactors
      real(wp) :: momentum(3) = 0.0_wp
   contains
      procedure :: total
      procedure :: error => balance_error
   end type energies_type

   !> A rigid impactor
   type, public :: impactor_state_type
      !> Position of the centre, its displacement and its velocity
      real(wp) :: centre(3) = 0.0_wp, displacement(3) = 0.0_wp, velocity(3) = 0.0_wp
      !> Force of the plate on it over the last step
      real(wp) :: force(3) = 0.0_wp
      !> Contact points that carry a force, and the deepest penetration left
      integer :: contacts = 0
      real(wp) :: penetration = 0.0_wp
   end type impactor_state_type

   !> Sums over all points at a full step, where the velocity is v + 1/2 dt a
   type, public :: sums_type
      !> Momentum along x, y, z
      real(wp) :: momentum(3) = 0.0_wp
      !> Twice the kinetic energy; mass times the square of the acceleration
      real(wp) :: twice_kinetic = 0.0_wp, pull = 0.0_wp
      !> Twice the kinetic energy of the inertia that locally implicit operators add
      real(wp) :: twice_added = 0.0_wp
      !> Power of the forces with the velocity of the half step before
      real(wp) :: power = 0.0_wp
      !> No sum: bound on every component of the velocity over the step to come
      real(wp) :: fastest = 0.0_wp
   end type sums_type

   !> What a contact remembers from step to step; only contact knows the order
   type, public :: contact_memory_type
      !> Facets near the sphere, and the facet under each contact node
      integer, allocatable :: places(:)
      !> Travel, positions seen, pushes, places in facets
      real(wp), allocatable :: numbers(:)
   end type contact_memory_type

   !> The state of a run
   type, public :: state_type
      !> Time and number of steps made
      real(wp) :: time = 0.0_wp
      integer :: cycle = 0
      !> Time and number of steps at which the run ends; no such number when 0
      real(wp) :: end_time = 0.0_wp
      integer :: end_cycle = 0
      !> The step to come, and the one just made
      real(wp) :: step = 0.0_wp, step_before = 0.0_wp
      !> The step after the one to come
      real(wp) :: step_after = 0.0_wp
      !> Whether displacement and velocity are those at the end of the step to come already, before
      !> contact, as nobody looks at them here; whether they are to be so after it
      logical :: is_ahead = .false., goes_ahead = .false.
      !> The first step of the run
      real(wp) :: first_step = 0.0_wp
      !> Displacement at this time, velocity half a step before, acceleration at this time,
      !> all points; see `columns_type`. While forces are summed, the accelerations are forces, with
      !> the columns of the borders behind
      real(wp), allocatable :: displacement(:), velocity(:), acceleration(:)
      !> History of all Gauss points; see `layer_batch_type` and `interface_type`
      real(wp), allocatable :: history(:)
      !> Impactors
      type(impactor_state_type), allocatable :: impactors(:)
      !> Memory of the contacts when the state was last kept: `contacts%remember` brings it up to
      !> date
      type(contact_memory_type), allocatable :: contacts(:)
      !> Value of each load's curve at this time
      real(wp), allocatable :: load_factor(:)
      !> Force that each held or prescribed point would feel free, in the order of
      !> `domain%supports%held`, then of `domain%supports%motions`
      real(wp), allocatable :: support_force(:)
      !> Velocity of the prescribed points over the last step, in the order of the supports' motions
      real(wp), allocatable :: support_velocity(:)
      !> Sums over all points, at this time, and those over the points of each chunk
      type(sums_type) :: sums
      type(sums_type), allocatable :: chunk_sums(:)
      !> What this rank has counted in this step; zero between two steps
      type(exact_sums_type) :: tally
      !> Whether there is something to write after this step, and whether any rank was asked for
      !> something
      logical :: output_due = .false., rows_due = .false., impactors_due = .false.
      logical :: attention = .false.
      !> Whether somebody will look at the points at the end of the step to come
      logical :: halts = .true.
      !> Bound on every component of the velocity of all points over the step to come; not less, but
      !> perhaps more on more ranks
      real(wp) :: fastest = huge(1.0_wp)
      !> Power of all forces at the beginning of the step under way, with the velocity over it
      real(wp) :: internal_power = 0.0_wp
      !> Energies
      type(energies_type) :: energies
   contains
      procedure :: is_finished
      procedure :: ends_after
   end type state_type

contains

   !> Sums over all points
   pure function sums_of(tally) result(sums)
      !> What all ranks have counted
      type(exact_sums_type), intent(in) :: tally
      type(sums_type) :: sums
      integer :: c

      sums%momentum(:) = [(tally%value(momentum_sum + c), c=1, 3)]
      sums%twice_kinetic = tally%value(kinetic_sum)
      sums%twice_added = tally%value(added_sum)
      sums%pull = tally%value(pull_sum)
      sums%power = tally%value(power_sum)
   end function sums_of

   !> Whether the end has come
   pure logical function is_finished(self)
      class(state_type), intent(in) :: self

      is_finished = is_end(self, self%time, self%cycle)
   end function is_finished

   !> Whether the end comes with the step that begins now
   pure logical function ends_after(self, step)
      class(state_type), intent(in) :: self
      !> The step
      real(wp), intent(in) :: step

      ends_after = is_end(self, self%time + step, self%cycle + 1)
   end function ends_after

   !> Whether the end is at some time and number of steps
   pure logical function is_end(self, time, cycle)
      class(state_type), intent(in) :: self
      real(wp), intent(in) :: time
      integer, intent(in) :: cycle

      is_end = time >= self%end_time*(1.0_wp - epsilon(1.0_wp)) &
         & .or. (self%end_cycle > 0 .and. cycle >= self%end_cycle)
   end function is_end

   !> What the system holds and has lost, in the form that central differences conserve
   pure real(wp) function total(self)
      class(energies_type), intent(in) :: self

      total = self%kinetic + self%added - self%ripple + self%shift + self%internal &
         & + self%impactor + self%damping + self%contact
   end function total

   !> Energy that appeared from nowhere, as a share of what went in
   pure real(wp) function balance_error(self)
      class(energies_type), intent(in) :: self

      balance_error = 0.0_wp
      if (self%reference > 0.0_wp) then
         balance_error = (self%total() - self%start - self%external)/self%reference
      end if
   end function balance_error

end module plydyn_state_state
