!> Element groups: elements of one family over one element set, and what they give to the solver.
!>
!> An element set is a list of elements that chunks divide: the quads of a part, or batches of
!> bricks of a part. Several groups may lie over one set, such as the layers of a part and the
!> interfaces between them. A family extends the abstract type: what is known when the group is
!> built is a component, what depends on the state is a procedure. A procedure that a family does
!> not override does nothing.
module plydyn_element_group
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : wp
   use plydyn_element_crack_bands, only : crack_band_type
   use plydyn_element_least_volume, only : least_volume_type
   use plydyn_fem_columns, only : columns_type
   use plydyn_law_law, only : scalars
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   !> A cell of a family in field output. Points of the output lie in sheets above the nodes of a
   !> part: one for each numerical layer of a plate, one of a single level where nodes are points
   type, public :: cell_type
      !> VTK's kind of cell
      integer :: kind = 0
      !> Node in the order of the deck, and level above the lowest of the cell, of each corner in
      !> VTK's order, (2, corners)
      integer, allocatable :: corner(:, :)
      !> Levels from the bottom of a cell to its top; 0 where a sheet has one level
      integer :: span = 0
      !> The group's order of the nodes, as places in that of the deck
      integer, allocatable :: node_order(:)
      !> Levels of points in each sheet, from the bottom up; not allocated in families without cells
      integer, allocatable :: levels(:)
   end type cell_type

   !> Springs between a layer and the next
   type, public :: spring_type
      !> The layer below
      integer :: layer = 0
      !> Stiffness per area along x, y, z
      real(wp) :: stiffness(3) = 0.0_wp
      !> Whether they can fail
      logical :: fails = .false.
   end type spring_type

   !> Elements of one family over one element set
   type, public, abstract :: element_group_type
      !> The element set, and the part of the model
      integer :: set = 0, part = 0
      !> Large displacement (total Lagrangian) instead of linear strain
      logical :: large = .false.
      !> Whether the first element at a column sets its forces; otherwise they are cleared before
      logical :: sets_forces = .false.
      !> What an element is called in messages and in the mesh, and the piece of it that a rate
      !> belongs to
      character(:), allocatable :: element_kind, layer_kind
      !> Index in the mesh of each element that this rank has
      integer, allocatable :: element(:)
      !> Work of an element in a step, nanoseconds
      real(wp) :: work = 0.0_wp
      !> Reals and integers that the group keeps for its elements
      real(wp) :: memory(2) = 0.0_wp
      !> Blocks of history: places of a variable of one element, number of variables, and how many
      !> of them, the first ones, intact points have, (3, blocks); the others are zero there
      integer, allocatable :: history_shape(:, :)
      !> First and last place of those of intact points in the history of all, (2, blocks)
      integer, allocatable :: intact_history(:, :)
      !> Stiffness of each layer through its thickness per area along x, y, z, (3, layers)
      real(wp), allocatable :: layer_spring(:, :)
      !> Springs between layers; none where not allocated
      type(spring_type), allocatable :: springs(:)
      !> Cells in field output
      type(cell_type) :: cell
   contains
      ! building
      procedure(take_elements), deferred :: take_elements
      procedure(set_targets), deferred :: set_targets
      procedure :: add_masses
      procedure :: set_history
      procedure :: find_rates
      procedure :: add_crack_bands
      ! the time loop
      procedure :: start_history
      procedure(add_forces), deferred :: add_forces
      procedure :: find_volume
      procedure :: add_dissipation
      procedure :: add_stored_energy
      procedure :: add_losses
      ! outputs
      procedure :: find_nodes
      procedure :: output_values
   end type element_group_type

   !> One group of a list
   type, public :: group_item_type
      class(element_group_type), allocatable :: item
   end type group_item_type

   !> What an interface has lost: areas where damage has begun, where half of the toughness is
   !> spent, and where damage is complete; energies lost in fracture, by a falling penalty, and in
   !> friction
   integer, parameter, public :: begun_area = 1, delaminated_area = 2, failed_area = 3, &
      & fracture_loss = 4, closing_loss = 5, friction_loss = 6
   integer, parameter, public :: losses = 6

   !> Where each kind of recovered values begins, less one: strain and stress in the axes of the
   !> plate, then of the ply, each xx, yy, zz, xy, xz, yz with engineering shear; the scalars that
   !> laws show
   integer, parameter, public :: strain_at = 0, stress_at = 6, ply_strain_at = 12, &
      & ply_stress_at = 18, scalars_at = 24
   !> How many there are
   integer, parameter, public :: recovered = scalars_at + scalars

   abstract interface
      !> Take the elements of the rank, with their geometry and the places of their points
      subroutine take_elements(self, model, elements, local_node, columns)
         import :: columns_type, element_group_type, model_type
         implicit none
         class(element_group_type), intent(inout) :: self
         !> The model
         type(model_type), intent(in) :: model
         !> Elements of the set that the rank has
         integer, intent(in) :: elements(:)
         !> The rank's number of each node of the mesh, 0 where it does not have it
         integer, intent(in) :: local_node(:)
         !> Where the points lie
         type(columns_type), intent(in) :: columns
      end subroutine take_elements

      !> Let the elements of a chunk add to the columns of the chunk
      pure subroutine set_targets(self, elements, height, column)
         import :: element_group_type
         implicit none
         class(element_group_type), intent(inout) :: self
         !> First and last element
         integer, intent(in) :: elements(2)
         !> Length of a column
         integer, intent(in) :: height
         !> Column of the chunk for each column of nodes
         integer, intent(in) :: column(:)
      end subroutine set_targets

      !> Subtract the internal forces of the elements of a chunk
      pure subroutine add_forces(self, elements, step, displacement, velocity, history, force)
         import :: element_group_type, wp
         implicit none
         class(element_group_type), intent(in) :: self
         !> First and last element
         integer, intent(in) :: elements(2)
         !> Time step
         real(wp), intent(in) :: step
         !> Displacement of all points, and their velocity half a step before
         real(wp), intent(in), contiguous :: displacement(:), velocity(:)
         !> History of all Gauss points
         real(wp), intent(inout), contiguous :: history(:)
         !> Force on all points
         real(wp), intent(inout), contiguous :: force(:)
      end subroutine add_forces
   end interface

contains

   !> Add the masses of the elements to those of the points that the rank has: of all elements of
   !> the set, or a share of the mass of one layer
   subroutine add_masses(self, model, elements, local_node, columns, mass, layer, share)
      class(element_group_type), intent(in) :: self
      !> The model
      type(model_type), intent(in) :: model
      !> All elements of the set, those of other ranks too: they add to shared nodes
      integer, intent(in) :: elements(:)
      !> The rank's number of each node of the mesh, 0 where it does not have it
      integer, intent(in) :: local_node(:)
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      !> Mass of each point
      real(wp), intent(inout) :: mass(:)
      !> A layer, as in `find_rates`, and its share for each element of the mesh, 0 for those of
      !> other groups
      integer, intent(in), optional :: layer
      real(wp), intent(in), optional :: share(:)
   end subroutine add_masses

   !> Note where each block of history begins
   pure subroutine set_history(self, first)
      class(element_group_type), intent(inout) :: self
      !> First place in the history of all Gauss points
      integer, intent(in) :: first(:)
   end subroutine set_history

   !> Set the history of all points at time zero, with the damage that the deck asks for
   pure subroutine start_history(self, model, history)
      class(element_group_type), intent(in) :: self
      !> The model
      type(model_type), intent(in) :: model
      !> History of all Gauss points, zero in
      real(wp), intent(inout), contiguous :: history(:)
   end subroutine start_history

   !> Largest eigenvalue and mass of each layer of some elements; none where the group has no mass
   !> of its own
   subroutine find_rates(self, model, elements, implicit, rate, mass, layer)
      class(element_group_type), intent(in) :: self
      !> The model
      type(model_type), intent(in) :: model
      !> Those of the rank; where layers have a thickness any of the mesh
      integer, intent(in) :: elements(:)
      !> Share of the stiffness through the thickness that is implicit
      real(wp), intent(in) :: implicit
      !> Eigenvalues, 1/time squared, (layers, elements)
      real(wp), allocatable, intent(out) :: rate(:, :)
      !> Masses, (layers, elements); (0, 0) in a family that takes no added mass
      real(wp), allocatable, intent(out) :: mass(:, :)
      !> The user's number of each layer
      integer, allocatable, intent(out) :: layer(:)

      allocate (rate(0, 0), mass(0, 0), layer(0))
   end subroutine find_rates

   !> Add the crack bands of all points of the rank
   subroutine add_crack_bands(self, model, bands)
      class(element_group_type), intent(in) :: self
      !> The model
      type(model_type), intent(in) :: model
      !> Bands of each material
      type(crack_band_type), intent(inout) :: bands(:)
   end subroutine add_crack_bands

   !> Find the least ratio of volumes, det F; nothing where the group has no volume
   pure subroutine find_volume(self, displacement, least, mesh)
      class(element_group_type), intent(in) :: self
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> Least ratio of volumes so far
      type(least_volume_type), intent(inout) :: least
      !> The mesh, to look at the corners of elements, and not at their Gauss points
      type(mesh_type), intent(in), optional :: mesh
   end subroutine find_volume

   !> Add the energy that each mechanism has dissipated
   pure subroutine add_dissipation(self, history, sums)
      class(element_group_type), intent(in) :: self
      !> History of all Gauss points
      real(wp), intent(in), contiguous :: history(:)
      !> Sums in the order of `mechanism_names`
      type(exact_sums_type), intent(inout) :: sums
   end subroutine add_dissipation

   !> Add the energy that unloading of the elements of a chunk gives back, from strains and
   !> stresses, that which hourglass control has stored or taken, and that which it has taken by
   !> viscous forces alone
   pure subroutine add_stored_energy(self, elements, displacement, history, sums)
      class(element_group_type), intent(in) :: self
      !> First and last element
      integer, intent(in) :: elements(2)
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      !> Three sums, in this order
      type(exact_sums_type), intent(inout) :: sums
   end subroutine add_stored_energy

   !> Add areas and energies that interfaces have lost, or mark where they are delaminated and where
   !> they have failed
   pure subroutine add_losses(self, history, sums, areas)
      class(element_group_type), intent(in) :: self
      !> History of all Gauss points
      real(wp), intent(in), contiguous :: history(:)
      !> Sums, `losses` for each ply below an interface
      type(exact_sums_type), intent(inout), optional :: sums
      !> Both areas of the points, the largest of several interfaces, else 0; allocated by the
      !> first group of a set that can fail, (2, points, elements)
      real(wp), allocatable, intent(inout), optional :: areas(:, :, :)
   end subroutine add_losses

   !> The rank's numbers of the nodes of an element in the group's order, and weights of its values
   !> at them in the mean over elements
   pure subroutine find_nodes(self, element, position, node, weight)
      class(element_group_type), intent(in) :: self
      !> Number among those of the group
      integer, intent(in) :: element
      !> Positions of the rank's nodes, (3, nodes)
      real(wp), intent(in) :: position(:, :)
      !> The nodes
      integer, allocatable, intent(out) :: node(:)
      !> The weights
      real(wp), allocatable, intent(out) :: weight(:)

      allocate (node(0), weight(0))
   end subroutine find_nodes

   !> Strain, stress and scalars of an element at its nodes at all levels of a sheet,
   !> (`recovered`, levels, nodes)
   pure function output_values(self, place, has_tensors, displacement, history) result(values)
      class(element_group_type), intent(in) :: self
      !> Number of the element among those of the group, and sheet
      integer, intent(in) :: place(2)
      !> Whether strain or stress is requested, which take longer than scalars
      logical, intent(in) :: has_tensors
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      real(wp), allocatable :: values(:, :, :)

      allocate (values(recovered, 1, 0))
   end function output_values

end module plydyn_element_group
