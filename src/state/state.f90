!> The state of a run: all that a restart file holds, and nothing else.
module plydyn_state_state
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> Energies at the present time
   type, public :: energies_type
      !> Motion of the plate and of the impactors
      real(wp) :: kinetic = 0.0_wp, impactor = 0.0_wp
      !> Motion of the inertia that locally implicit operators add to the plate
      real(wp) :: added = 0.0_wp
      !> Kinetic energy at the full step less the conserved form of central differences,
      !> 1/8 dt^2 a M a: small in a smooth motion, unbounded in an unstable one
      real(wp) :: half_step_correction = 0.0_wp
      !> Work of the internal forces: stored in the plies and interfaces
      real(wp) :: internal = 0.0_wp
      !> Work of changes of the step on the conserved form: 1/8 a M a times the difference of the
      !> squares of the steps, and what damping and contact do in such a step
      real(wp) :: step_change = 0.0_wp
      !> Taken by damping, and lost where contact nodes meet
      real(wp) :: damping = 0.0_wp, contact = 0.0_wp
      !> Work of loads, supports, fixtures that move, and gravity
      real(wp) :: external = 0.0_wp
      !> Kinetic energy at time zero
      real(wp) :: start = 0.0_wp
      !> Largest energy that went in so far: the error is given as a share of it
      real(wp) :: reference = 0.0_wp
      !> Momentum of plate and impactors
      real(wp) :: momentum(3) = 0.0_wp
      !> Taken by friction on impactors and fixtures
      real(wp) :: friction = 0.0_wp
   contains
      procedure :: total
      procedure :: error => balance_error
      procedure :: raise_reference
      procedure :: kinetic_share
   end type energies_type

   !> A rigid body that the plate meets
   type, public :: body_state_type
      !> The user's number
      integer :: id = 0
      !> Force of the plate on it over the last step, and its impulse so far
      real(wp) :: force(3) = 0.0_wp, impulse(3) = 0.0_wp
      !> Work of friction between it and the plate so far
      real(wp) :: friction = 0.0_wp
      !> Energy lost where it meets the plate, without friction
      real(wp) :: contact = 0.0_wp
      !> Contact points that carry a force
      integer :: contacts = 0
   end type body_state_type

   !> A rigid impactor: its motion is integrated
   type, public, extends(body_state_type) :: impactor_state_type
      !> Position of the centre, its displacement and its velocity
      real(wp) :: centre(3) = 0.0_wp, displacement(3) = 0.0_wp, velocity(3) = 0.0_wp
      !> Angular velocity; zero where it does not turn
      real(wp) :: spin(3) = 0.0_wp
      !> Work of its prescribed motion so far, and the deepest penetration left
      real(wp) :: work = 0.0_wp, penetration = 0.0_wp
      !> Time at the end of the last step in which it touched the plate; negative without any
      real(wp) :: last_contact = -1.0_wp
   end type impactor_state_type

   !> A fixture: its curves say where it is at any time, so that its motion is no state
   type, public, extends(body_state_type) :: fixture_state_type
      !> Height of its face without its own motion
      real(wp) :: height = 0.0_wp
      !> Area of the points in contact
      real(wp) :: area = 0.0_wp
      !> Path of the points in contact along it so far, their mean by normal force
      real(wp) :: slip = 0.0_wp
   end type fixture_state_type

   !> Sums over all points at a full step, where the velocity is v + 1/2 dt a
   type, public :: motion_sums_type
      !> Momentum along x, y, z
      real(wp) :: momentum(3) = 0.0_wp
      !> Twice the kinetic energy; mass times the square of the acceleration, a M a
      real(wp) :: twice_kinetic = 0.0_wp, acceleration_square = 0.0_wp
      !> Twice the kinetic energy of the inertia that locally implicit operators add
      real(wp) :: twice_added = 0.0_wp
      !> Power of the forces with the velocity of the half step before
      real(wp) :: power = 0.0_wp
   end type motion_sums_type

   !> Memory of a contact from step to step, in an order of the contact's own
   type, public :: contact_memory_type
      !> Candidate facets, and the facet under each contact node
      integer, allocatable :: places(:)
      !> Bounds on the approach, last positions, multipliers, coordinates in facets
      real(wp), allocatable :: numbers(:)
   end type contact_memory_type

   !> Time and number of steps at which a run ends; a number of 0 is no limit
   type, public :: run_end_type
      real(wp) :: time = 0.0_wp
      integer :: cycle = 0
      !> Time since when the supports and loads have been those of now
      real(wp) :: begin = 0.0_wp
      !> Largest power of the loads since then, and time and work at the last look at it
      real(wp) :: largest_power = 0.0_wp, look_time = 0.0_wp, look_work = 0.0_wp
   contains
      procedure :: has_just_begun
   end type run_end_type

   !> Dynamic relaxation
   type, public :: relaxation_state_type
      !> Damping force per mass and velocity, and what takes its place from a step on, 1/time
      real(wp) :: damping = 0.0_wp, next_damping = 0.0_wp
      !> Number of that step
      integer :: change_cycle = 0
      !> Largest kinetic energy so far
      real(wp) :: largest_kinetic = 0.0_wp
      !> Time for which the damping has been about critical for the motion
      real(wp) :: damped_time = 0.0_wp
      !> Integrals over time since the last change: v M v and v K v
      real(wp) :: twice_kinetic = 0.0_wp, stiffness_square = 0.0_wp
      !> Change of the internal forces over the last step times the velocity over it; every step
      !> finds it anew
      real(wp) :: stiffening = 0.0_wp
   contains
      procedure :: damping_at
   end type relaxation_state_type

   !> Linear constraints, a number for each
   type, public :: constraint_state_type
      !> Multiplier: the force along the sum of displacements
      real(wp), allocatable :: force(:)
      !> Rate of the sum over the last step
      real(wp), allocatable :: rate(:)
      !> The sum
      real(wp), allocatable :: displacement(:)
   end type constraint_state_type

   !> Supports, prescribed motions, linear constraints and loads
   type, public :: support_state_type
      !> Planes of symmetry of the model of the first deck, see `plydyn_model_symmetry`
      integer :: planes(2) = 0
      !> Force that each held or prescribed point would feel free, in the order of
      !> `domain%supports%held`, then of `domain%supports%motions`
      real(wp), allocatable :: force(:)
      !> Velocity of the prescribed points over the last step, in the order of the supports' motions
      real(wp), allocatable :: velocity(:)
      !> Value of each load's curve at this time
      real(wp), allocatable :: load_factor(:)
      !> Linear constraints
      type(constraint_state_type) :: constraints
   end type support_state_type

   !> The state of a run
   type, public :: state_type
      !> Time and number of steps made
      real(wp) :: time = 0.0_wp
      integer :: cycle = 0
      !> The end of the run
      type(run_end_type) :: end
      !> Least ratio of volumes of all elements where the step last followed it
      real(wp) :: least_volume = 1.0_wp
      !> The step under way, the step before it, and the first step of the run
      real(wp) :: step = 0.0_wp, step_before = 0.0_wp, first_step = 0.0_wp
      !> Displacement at this time, velocity half a step before, acceleration at this time,
      !> all points; see `columns_type`. While forces are summed, the accelerations are forces, with
      !> the columns of shared nodes behind
      real(wp), allocatable :: displacement(:), velocity(:), acceleration(:)
      !> History of all Gauss points; see `layer_batch_type` and `interface_type`
      real(wp), allocatable :: history(:)
      !> Supports and loads
      type(support_state_type) :: supports
      !> Dynamic relaxation
      type(relaxation_state_type) :: relaxation
      !> Sums over all points at this time
      type(motion_sums_type) :: sums
      !> Energies
      type(energies_type) :: energies
      !> Impactors
      type(impactor_state_type), allocatable :: impactors(:)
      !> Fixtures
      type(fixture_state_type), allocatable :: fixtures(:)
      !> Memory of the contacts at the last checkpoint; `contacts%save` brings it up to date
      type(contact_memory_type), allocatable :: contacts(:)
   contains
      procedure :: is_finished
      procedure :: ends_after
      procedure :: advance_clock
   end type state_type

contains

   !> Whether so little of the time with the present loads has passed that energies cannot be
   !> compared, nor a run ended: nothing is stored when motion begins
   pure logical function has_just_begun(self, time)
      class(run_end_type), intent(in) :: self
      !> Time now
      real(wp), intent(in) :: time

      real(wp), parameter :: start_share = 0.1_wp

      has_just_begun = time < self%begin + start_share*(self%time - self%begin)
   end function has_just_begun

   !> Whether the end has come
   pure logical function is_finished(self)
      class(state_type), intent(in) :: self

      is_finished = is_end(self, self%time, self%cycle)
   end function is_finished

   !> Whether the end comes with the step under way
   pure logical function ends_after(self)
      class(state_type), intent(in) :: self

      ends_after = is_end(self, self%time + self%step, self%cycle + 1)
   end function ends_after

   !> The step under way is made
   pure subroutine advance_clock(self)
      class(state_type), intent(inout) :: self

      self%time = self%time + self%step
      self%cycle = self%cycle + 1
      self%step_before = self%step
   end subroutine advance_clock

   !> Whether the end is at some time and number of steps
   pure logical function is_end(self, time, cycle)
      class(state_type), intent(in) :: self
      real(wp), intent(in) :: time
      integer, intent(in) :: cycle

      is_end = time >= self%end%time*(1.0_wp - epsilon(1.0_wp)) &
         & .or. (self%end%cycle > 0 .and. cycle >= self%end%cycle)
   end function is_end

   !> Damping of dynamic relaxation in a step
   pure real(wp) function damping_at(self, cycle)
      class(relaxation_state_type), intent(in) :: self
      !> Number of the step
      integer, intent(in) :: cycle

      damping_at = merge(self%next_damping, self%damping, cycle >= self%change_cycle)
   end function damping_at

   !> Energy stored, dissipated and lost, in the form that central differences conserve
   pure real(wp) function total(self)
      class(energies_type), intent(in) :: self

      total = self%kinetic + self%added - self%half_step_correction &
         & + self%step_change + self%internal + self%impactor &
         &  + self%damping + self%contact + self%friction
   end function total

   !> Error of the energy balance, as a share of the energy that went in
   pure real(wp) function balance_error(self)
      class(energies_type), intent(in) :: self

      balance_error = 0.0_wp
      if (self%reference > 0.0_wp) then
         balance_error = (self%total() - self%start - self%external)/self%reference
      end if
   end function balance_error

   !> Kinetic energy of the plate as a share of the internal one
   pure real(wp) function kinetic_share(self)
      class(energies_type), intent(in) :: self

      kinetic_share = self%kinetic/max(abs(self%internal), tiny(1.0_wp))
   end function kinetic_share

   !> The reference of the error is the largest energy that went in so far
   pure subroutine raise_reference(self)
      class(energies_type), intent(inout) :: self

      self%reference = max(self%reference, self%start + abs(self%external))
   end subroutine raise_reference

end module plydyn_state_state
