!> Control of a run, and requests for output.
module plydyn_model_control
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> Strain measures, numbered as on the card
   integer, parameter, public :: linear_strain = 0, total_lagrangian = 1

   !> What is taken half at the end of the step, numbered as on the card: nothing, the springs of
   !> interfaces, or those and the stiffness through the thickness
   integer, parameter, public :: all_explicit = 0, implicit_interfaces = 1, implicit_thickness = 2

   !> Names of the user's units, for print only
   type, public :: units_type
      !> Names of length, time, mass, force, stress and energy
      character(8) :: length = "mm", time = "s", mass = "t", force = "N", stress = "MPa", &
         & energy = "mJ"
   contains
      procedure :: area => unit_of_area
      procedure :: impulse => unit_of_impulse
      procedure :: velocity => unit_of_velocity
   end type units_type

   !> Time, step, kinematics, damping, limits
   type, public :: control_type
      !> Last time, and that which the first deck of the run has: a restart may change the other one
      real(wp) :: end_time = 0.0_wp, planned_end = 0.0_wp
      !> Last cycle; 0 for none
      integer :: end_cycle = 0
      !> Check the deck, build the domain and stop
      logical :: check_only = .false.
      !> Share of the stable step that is taken; 0 where the deck leaves it to `step_share`
      real(wp) :: step_factor = 0.0_wp
      !> First step, 0 for the stable one, and largest step, 0 for none
      real(wp) :: first_step = 0.0_wp, largest_step = 0.0_wp
      !> Stable step that elements get by added mass where their own is smaller; 0 for none
      real(wp) :: mass_scaled_step = 0.0_wp
      !> `all_explicit` or what is implicit
      integer :: scheme = all_explicit
      !> Index into `model%curves` of a bound on the step over time; 0 for none
      integer :: step_curve = 0
      !> Where the deck has that curve and the largest step: lines of all lines, files and lines
      integer :: curve_line = 0, step_line = 0
      character(:), allocatable :: curve_place, step_place
      !> Where it has the damping
      integer :: damping_line = 0
      character(:), allocatable :: damping_place
      !> The run stops when the step falls below this share of the first one; 0 for none
      real(wp) :: smallest_share = 0.0_wp
      !> `linear_strain` or `total_lagrangian`
      integer :: kinematics = total_lagrangian
      !> Force per mass and velocity that brakes every point, 1/time
      real(wp) :: damping = 0.0_wp
      !> Dynamic relaxation ends the run where the kinetic energy is below this share of the
      !> largest; 0 for no dynamic relaxation
      real(wp) :: rest_share = 0.0_wp
      !> A warning where the kinetic energy is above this share of the internal one; 0 for none
      real(wp) :: kinetic_limit = 0.0_wp
      !> A quasi-static run ends where the load is below this share of the largest; 0 for not
      real(wp) :: load_share = 0.0_wp
      !> The run ends when no impactor has touched the plate for this time; 0 for not
      real(wp) :: contact_pause = 0.0_wp
      !> The run stops when the energy balance is off by more than this share
      real(wp) :: energy_limit = 0.05_wp
      !> The run stops when the ratio of volumes of an element falls below this
      real(wp) :: volume_limit = -huge(1.0_wp)
      !> Threads; 0 where the deck says nothing
      integer :: threads = 0
      !> Names of units
      type(units_type) :: units
   contains
      procedure :: step_share
   end type control_type

   !> One line of the listing on what a restart changes
   type, public :: change_type
      !> Kind of thing, and what becomes of it
      character(:), allocatable :: kind, words
   end type change_type

   !> What the newest deck of a restart changes
   type, public :: changes_type
      !> Supports or loads; the end; dynamic relaxation; impactors or fixtures; the time step and
      !> the mass that is added for it
      logical :: conditions = .false., end = .false., relaxation = .false., bodies = .false., &
         & step = .false.
   end type changes_type

   !> Stress through the thickness at a place of the plane
   type, public :: profile_type
      !> The user's number
      integer :: id = 0
      !> Place in the plane
      real(wp) :: position(2) = 0.0_wp
      !> Points in each numerical layer, both faces included
      integer :: points = 5
      !> Time between two profiles
      real(wp) :: interval = 0.0_wp
      !> Where the deck asks for it: line of all lines, 0 for none, and file and line
      integer :: line = 0
      character(:), allocatable :: place
   end type profile_type

   !> Requests for output; an interval of 0 means every step
   type, public :: request_type
      !> Time between two field states; 0 for twenty in all
      real(wp) :: field_interval = 0.0_wp
      !> Names of the point fields to write
      character(16), allocatable :: fields(:)
      !> Time between two lines of the histories of energies, impactors, fixtures and nodes
      real(wp) :: energy_interval = 0.0_wp, impactor_interval = 0.0_wp, &
         & fixture_interval = 0.0_wp, node_interval = 0.0_wp
      !> Nodes with a history, indices into `mesh%node_id`
      integer, allocatable :: nodes(:)
      !> Time between two lines of the support forces; negative for none
      real(wp) :: support_interval = -1.0_wp
      !> Time between two lines of the history of delamination; negative for a thousand in all
      real(wp) :: delamination_interval = -1.0_wp
      !> Profiles through the thickness
      type(profile_type), allocatable :: profiles(:)
      !> Steps between two restart files that are kept; 0 for none
      integer :: kept_cycles = 0
      !> Steps between two restart files that replace older ones, 0 for none, and how many there are
      integer :: running_cycles = 0, running_files = 1
   end type request_type

   !> Usual shares of the stable step, by strain measure: with large displacement waves that
   !> strain a ply by some per cent grow from 0.85 on; see section 10 of the theory
   real(wp), parameter :: usual_share(linear_strain:total_lagrangian) = [0.9_wp, 0.8_wp]

contains

   !> Share of the stable step that is taken, of the deck or the usual one
   pure real(wp) function step_share(self) result(share)
      class(control_type), intent(in) :: self

      share = self%step_factor
      if (share <= 0.0_wp) share = usual_share(self%kinematics)
   end function step_share

   !> Name of the unit of areas
   pure function unit_of_area(self) result(name)
      class(units_type), intent(in) :: self
      character(:), allocatable :: name

      name = trim(self%length)//"2"
   end function unit_of_area

   !> Name of the unit of impulses
   pure function unit_of_impulse(self) result(name)
      class(units_type), intent(in) :: self
      character(:), allocatable :: name

      name = trim(self%force)//" "//trim(self%time)
   end function unit_of_impulse

   !> Name of the unit of velocities
   pure function unit_of_velocity(self) result(name)
      class(units_type), intent(in) :: self
      character(:), allocatable :: name

      name = trim(self%length)//"/"//trim(self%time)
   end function unit_of_velocity

end module plydyn_model_control
