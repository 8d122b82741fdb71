!> The domain: the model as flat arrays, immutable once built.
module plydyn_domain_domain
   use plydyn_base_precision, only : wp
   use plydyn_domain_column_inertia, only : column_inertia_type
   use plydyn_fem_columns, only : columns_type, alignment_offset
   use plydyn_domain_pair_inertia, only : inertia_links_type, pair_inertia_type
   use plydyn_element_average, only : average_type
   use plydyn_element_cracked_crack_lines, only : crack_lines_type
   use plydyn_element_crack_bands, only : crack_band_type
   use plydyn_element_group, only : group_item_type
   use plydyn_model_control, only : control_type
   use plydyn_model_curve, only : curve_type
   use plydyn_model_body, only : contact_type, fixture_type, impactor_type
   use plydyn_model_layers, only : layers_type
   use plydyn_model_support, only : initial_velocity_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_parallel_halo, only : halo_type
   implicit none
   private

   !> Forces on points that vary together over time
   type, public :: load_type
      !> Places in the arrays of motion, column by column
      integer, allocatable :: freedom(:)
      !> Force at a curve value of 1
      real(wp), allocatable :: force(:)
      !> Index into `curves`
      integer :: curve = 0
      !> Last place of each column that has any
      integer, allocatable :: last(:)
   end type load_type

   !> What a curve leads, and how, as in `motion_type`
   type, public :: led_type
      integer :: quantity = 0, curve = 0
      real(wp) :: scale = 1.0_wp
   end type led_type

   !> Points whose motion is prescribed together
   type, public, extends(led_type) :: prescribed_type
      !> Places in the arrays of motion, and of the masses
      integer, allocatable :: freedom(:), mass(:)
      !> What number each has among those that all ranks have, and how many these are
      integer, allocatable :: number(:)
      integer :: all = 0
      !> As in `motion_type`
      real(wp) :: birth = 0.0_wp, death = huge(1.0_wp)
   end type prescribed_type

   !> A linear constraint: what leads it, nothing where it has no curve, and how it resists
   type, public, extends(led_type) :: constraint_type
      !> Squares of the coefficients over the masses: acceleration of the sum by a multiplier of 1
      real(wp) :: inverse_mass = 0.0_wp
   end type constraint_type

   !> Linear constraints between displacements. A term is a coefficient times the mean displacement
   !> of some points by their masses
   type, public :: constraints_type
      !> The constraints
      type(constraint_type), allocatable :: list(:)
      !> Terms of all of them, one constraint after the other: which constraint, coefficient, and
      !> inverse of the mass of its points
      integer, allocatable :: constraint(:)
      real(wp), allocatable :: coefficient(:), inverse_mass(:)
      !> Terms that each rank counts, from rank 0 on, and those of all ranks, rank by rank
      integer, allocatable :: counts(:), of_ranks(:)
      !> Points that this rank has: place in the arrays of motion, term, and share of its mass
      integer, allocatable :: freedom(:), term(:)
      real(wp), allocatable :: share(:)
   end type constraints_type

   !> The points of a face of the plate that an impactor may touch
   type, public :: face_type
      !> Places in the arrays of motion, 0 where another rank has them, (3, points)
      integer, allocatable :: freedom(:, :)
      !> Points that this rank has, and whether it counts each point of the face
      integer, allocatable :: here(:)
      logical, allocatable :: own(:)
      !> Points that each rank counts, and those of all ranks, one rank after the other
      integer, allocatable :: counts(:), of_ranks(:)
      !> Position at time zero, (3, points)
      real(wp), allocatable :: position(:, :)
      !> Inverse mass, zero in directions that are held, (3, points)
      real(wp), allocatable :: inverse_mass(:, :)
      !> What moves them, an index into `motions`, 0 for nothing, (3, points)
      integer, allocatable :: motion(:, :)
      !> Node below each point
      integer, allocatable :: node(:)
      !> Motions of the rows of the column for that of the point; see `followers`. Only where
      !> columns share their inertia
      real(wp), allocatable :: follow(:, :, :)
      !> Area of each point; only for fixtures
      real(wp), allocatable :: area(:)
      !> Points of each facet in the order of the deck, (4 or 9, facets)
      integer, allocatable :: facet(:, :)
   end type face_type

   !> An element and the eigenvalue that its stable step comes from
   type, public :: critical_element_type
      !> Element group, and index in the mesh
      integer :: group = 0, element = 0
      !> The user's number of its weakest ply, or of the part of a brick
      integer :: layer = 0
      !> Largest eigenvalue, 1/time squared: the step is 2/sqrt(rate)
      real(wp) :: rate = 0.0_wp
   end type critical_element_type

   !> Where the time step comes from
   type, public :: step_limit_type
      !> Stable step of central differences, and that without added mass
      real(wp) :: step = huge(1.0_wp), unscaled_step = huge(1.0_wp)
      !> The user's number of the element with the largest eigenvalue, the first of `slowest`
      integer :: element_id = 0
      !> Largest eigenvalue of the elements, with added mass, and that of the interfaces, without,
      !> 1/time squared
      real(wp) :: element_rate = 0.0_wp, interface_rate = 0.0_wp
      !> Bound of the element with the former, if its thickness were implicit; 0 where that does not
      !> apply
      real(wp) :: plane_rate = 0.0_wp
      !> What is left of the latter where interfaces are implicit; all of it where not
      real(wp) :: interface_rest = 0.0_wp
      !> The elements of the whole model that have the smallest steps, the smallest first
      type(critical_element_type), allocatable :: slowest(:)
      !> Period of the slowest bending, for dynamic relaxation; 0 without it
      real(wp) :: bending_period = 0.0_wp
   end type step_limit_type

   !> Elements of one set that a thread computes at a time; see `plydyn_domain_decomposition`
   type, public :: chunk_type
      !> The element set, and the groups that lie over it
      integer :: set = 0
      integer, allocatable :: groups(:)
      !> First and last element of that set
      integer :: elements(2) = 0
      !> Columns that take its forces and those of no other chunk
      integer, allocatable :: column(:)
      !> Columns of the nodes that these stand for
      integer, allocatable :: node(:)
      !> Those of them that are the nodes' own: they are counted with this chunk
      integer, allocatable :: owned_columns(:)
      !> Columns of nodes that are counted by another rank, and move with this chunk here
      integer, allocatable :: ghost_columns(:)
      !> Shared nodes at any of these columns, as indices, and runs of its held points: first and
      !> last of each, (2, runs)
      integer, allocatable :: shared_nodes(:), held(:, :)
      !> Doubled nodes that move with this chunk, numbers in `cracks`
      integer, allocatable :: cracks(:)
      !> Chunks whose forces its points need, itself too; 0 for those of other ranks
      integer, allocatable :: contributors(:)
   end type chunk_type

   !> The chunks of a rank, and what they share with each other and with other ranks
   type, public :: chunks_type
      !> Chunks of all elements
      type(chunk_type), allocatable :: list(:)
      !> The order in which they are best computed, and how many come first because other ranks need
      !> their forces
      integer, allocatable :: order(:)
      integer :: outer = 0
      !> Nodes of several chunks: column of the node, and first and last of its columns behind,
      !> (3, nodes)
      integer, allocatable :: shared_nodes(:, :)
      !> Whether this rank counts each of its columns; a rank that it meets counts the others
      logical, allocatable :: counted(:)
      !> Forces that are exchanged with other ranks in a step
      type(halo_type) :: halo
   end type chunks_type

   !> Mass that mass scaling adds to a part
   type, public :: added_mass_type
      !> The user's number of the part
      integer :: part = 0
      !> Mass without added mass, and what is added
      real(wp) :: own = 0.0_wp, added = 0.0_wp
      !> Elements, each layer over a quad by itself, and those of them that get mass
      integer :: elements = 0, raised = 0
      !> Largest ratio of the masses of an element with and without
      real(wp) :: largest = 1.0_wp
   end type added_mass_type

   !> Masses, and inertia that locally implicit operators add between points
   type, public :: inertia_type
      !> Mass of each point, and the inverse of the mass that moves with it (both points of a tied
      !> face move as one); zero where there is no point
      real(wp), allocatable :: mass(:), inverse_mass(:)
      !> Mass of the whole model, with added mass
      real(wp) :: total_mass = 0.0_wp
      !> Mass that is added to each part; of no length where none is
      type(added_mass_type), allocatable :: added(:)
      !> Lower layers of the faces that move as one
      integer, allocatable :: ties(:)
      !> Those of them whose layers are of different order groups: points below and above,
      !> (2, 3*nodes*faces)
      integer, allocatable :: far_ties(:, :)
      !> Inertia across interfaces; not active where their springs are explicit
      type(pair_inertia_type) :: pairs
      !> Inertia through the thickness and across interfaces; not active where that is explicit
      type(column_inertia_type) :: thickness
      !> Added inertia between prescribed points
      type(inertia_links_type) :: moved_links
      !> Added inertia between held points, as places in `held`, and free ones
      type(inertia_links_type) :: held_links
   end type inertia_type

   !> Points that are held or moved
   type, public :: supports_type
      !> Places in the arrays of motion that do not move, and which of the model's supports counts
      !> the force of each
      integer, allocatable :: held(:), support(:)
      !> Prescribed motions
      type(prescribed_type), allocatable :: motions(:)
      !> Velocities at time zero
      type(initial_velocity_type), allocatable :: initial_velocities(:)
   end type supports_type

   !> A fixture and the points that it may touch
   type, public, extends(fixture_type) :: placed_fixture_type
      !> Index into `fixture_faces`
      integer :: surface = 0
      !> Height of its face at time zero without a prescribed motion, length
      real(wp) :: height = 0.0_wp
      !> Points of the face that this rank has under the fixture at time zero
      integer, allocatable :: below(:)
      !> Area of all points under it, those of other ranks too
      real(wp) :: area = 0.0_wp
   end type placed_fixture_type

   !> Impactors, fixtures and the faces that they may touch
   type, public :: contact_bodies_type
      !> Rigid impactors
      type(impactor_type), allocatable :: impactors(:)
      !> Contacts, as the deck says
      type(contact_type), allocatable :: contacts(:)
      !> The face that each contact is on
      type(face_type), allocatable :: surfaces(:)
      !> Fixtures, and the faces of the plate that they meet
      type(placed_fixture_type), allocatable :: fixtures(:)
      type(face_type), allocatable :: fixture_faces(:)
   end type contact_bodies_type

   !> Averages over neighbours that drive the damage of plies
   type, public :: averaging_type
      !> The averages
      type(average_type), allocatable :: averages(:)
      !> Halo exchange of the strains of other ranks' points that go into them
      type(halo_type) :: strain_halo
      !> Length of the received strains behind the histories
      integer :: halo_strains = 0
      !> Fewest and most points in the ellipses of each material, (2, materials); 0 for none
      integer, allocatable :: neighbours(:, :)
   end type averaging_type

   !> Everything the loop reads
   type, public :: domain_type
      !> The ranks of the run
      type(comm_type) :: comm
      !> How to run
      type(control_type) :: control
      !> Curves over time
      type(curve_type), allocatable :: curves(:)
      !> The user's node numbers
      integer, allocatable :: node_id(:)
      !> Positions of the nodes of the plane, (3, nodes)
      real(wp), allocatable :: position(:, :)
      !> Layers, the same above every node
      type(layers_type) :: layers
      !> Where the points lie
      type(columns_type) :: columns
      !> Element groups, those that set forces before those that add to them
      type(group_item_type), allocatable :: groups(:)
      !> Length of the history variables of all Gauss points together
      integer :: histories = alignment_offset
      !> Averages over neighbours
      type(averaging_type) :: averaging
      !> Lines along which the matrix of plies cracks
      type(crack_lines_type) :: cracks
      !> Crack bands of each material of the whole model
      type(crack_band_type), allocatable :: crack_bands(:)
      !> Chunks of all elements
      type(chunks_type) :: chunks
      !> Masses and added inertia
      type(inertia_type) :: inertia
      !> Supports and prescribed motions
      type(supports_type) :: supports
      !> Linear constraints
      type(constraints_type) :: constraints
      !> Forces
      type(load_type), allocatable :: loads(:)
      !> Impactors and contacts
      type(contact_bodies_type) :: contact
      !> Where the time step comes from
      type(step_limit_type) :: limit
      !> Largest step that will be taken
      real(wp) :: step = 0.0_wp
   contains
      procedure :: counts
      procedure :: intact_histories
   end type domain_type

contains

   !> Whether this rank counts a place in the arrays of motion
   elemental logical function counts(self, freedom)
      class(domain_type), intent(in) :: self
      !> The place
      integer, intent(in) :: freedom

      counts = self%chunks%counted(self%columns%column_of(freedom))
   end function counts

   !> First and last place of the histories that intact points have, and of what is behind those of
   !> elements, (2, blocks); the others are zero until damage begins
   pure function intact_histories(self) result(places)
      class(domain_type), intent(in) :: self
      integer, allocatable :: places(:, :)

      integer :: g

      places = reshape([self%cracks%first_history, self%histories &
         & + self%averaging%halo_strains], [2, 1])
      do g = 1, size(self%groups)
         if (.not. allocated(self%groups(g)%item%intact_history)) cycle
         places = reshape([places, self%groups(g)%item%intact_history], &
            & [2, size(places, 2) + size(self%groups(g)%item%intact_history, 2)])
      end do
   end function intact_histories

end module plydyn_domain_domain
