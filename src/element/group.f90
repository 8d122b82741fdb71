!> Element groups: elements of one family over one element set, and what they give to the solver.
!>
!> An element set is a list of elements that chunks divide: the quads of a part, or batches of
!> bricks of a part. Several groups may lie over one set, such as the layers of a part and the
!> interfaces between them. A family extends the abstract type; what it does not override is empty.
module plydyn_element_group
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : wp
   use plydyn_element_crack_bands, only : crack_band_type
   use plydyn_element_least_volume, only : least_volume_type
   use plydyn_element_output_group, only : output_group_type
   use plydyn_fem_columns, only : columns_type
   use plydyn_model_initial, only : initial_damage_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   !> Elements of one family over one element set
   type, public, abstract, extends(output_group_type) :: element_group_type
      !> The element set, and the part of the model
      integer :: set = 0, part = 0
      !> Large displacement (total Lagrangian) instead of linear strain
      logical :: large = .false.
      !> Whether the first element at a column sets its forces; otherwise they are cleared before
      logical :: sets_forces = .false.
      !> What an element is called in messages, and the piece of it that a rate belongs to
      character(:), allocatable :: element_kind, layer_kind
      !> Index in the mesh of each element that this rank has
      integer, allocatable :: element(:)
   contains
      ! building
      procedure(take_elements), deferred :: take_elements
      procedure(set_targets), deferred :: set_targets
      procedure :: add_masses
      procedure :: history_shape
      procedure :: set_history
      procedure :: start_history
      procedure :: set_damage
      ! the time loop
      procedure(add_forces), deferred :: add_forces
      procedure :: find_volume
      ! stable step
      procedure :: find_rates
      procedure :: find_layer_rates
      procedure :: add_layer_mass
      procedure :: raise_spring_rates
      procedure :: rate_without_thickness
      procedure :: has_springs
      procedure :: point_factor
      procedure :: spring_rate
      procedure :: add_joint_stiffness
      procedure :: layer_springs
      ! energies and losses
      procedure :: add_dissipation
      procedure :: add_stored_energy
      procedure :: add_losses
      procedure :: mark_areas
      procedure :: mark_interfaces
      ! crack bands, effort and names
      procedure :: add_crack_bands
      procedure :: work
      procedure :: add_memory
      procedure(element_id), deferred :: element_id
   end type element_group_type

   !> One group of a list
   type, public :: group_item_type
      class(element_group_type), allocatable :: item
   end type group_item_type

   !> Numbers of what an interface has lost: areas where damage has begun, where half of the
   !> toughness is spent, and where damage is complete; energies lost in fracture, by a falling
   !> penalty, and in friction
   integer, parameter, public :: losses = 6

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

      !> The user's number of an element
      pure integer function element_id(self, mesh, element) result(id)
         import :: element_group_type, mesh_type
         implicit none
         class(element_group_type), intent(in) :: self
         !> The mesh
         type(mesh_type), intent(in) :: mesh
         !> Index in the mesh
         integer, intent(in) :: element
      end function element_id
   end interface

contains

   !> Add the masses of all elements of the set to those of the points that the rank has
   subroutine add_masses(self, model, elements, local_node, columns, mass)
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
   end subroutine add_masses

   !> Blocks of history: places of a variable of one element, and number of variables, (2, blocks)
   pure function history_shape(self) result(blocks)
      class(element_group_type), intent(in) :: self
      integer, allocatable :: blocks(:, :)

      allocate (blocks(2, 0))
   end function history_shape

   !> Note where a block of history begins
   pure subroutine set_history(self, block, first)
      class(element_group_type), intent(inout) :: self
      !> Number of the block, and its first place in the history
      integer, intent(in) :: block, first
   end subroutine set_history

   !> Set the history of all points at time zero
   pure subroutine start_history(self, history)
      class(element_group_type), intent(in) :: self
      !> History of all Gauss points, zero in
      real(wp), intent(inout), contiguous :: history(:)
   end subroutine start_history

   !> Begin with damage that the deck asks for
   pure subroutine set_damage(self, mesh, initial, history)
      class(element_group_type), intent(in) :: self
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> What the deck asks for
      type(initial_damage_type), intent(in) :: initial
      !> History of all Gauss points
      real(wp), intent(inout), contiguous :: history(:)
   end subroutine set_damage

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

   !> Largest eigenvalue of each element of the rank, and the user's number of the layer that has
   !> it; nothing where the group has no mass of its own
   subroutine find_rates(self, model, implicit, rate, layer)
      class(element_group_type), intent(in) :: self
      !> The model
      type(model_type), intent(in) :: model
      !> Share of the stiffness through the thickness that is implicit
      real(wp), intent(in) :: implicit
      !> Eigenvalues, 1/time squared
      real(wp), allocatable, intent(out) :: rate(:)
      !> The layers
      integer, allocatable, intent(out) :: layer(:)

      allocate (rate(0), layer(0))
   end subroutine find_rates

   !> Largest eigenvalue and mass of each layer of each element of the rank; no layers where the
   !> group has no mass of its own
   subroutine find_layer_rates(self, model, implicit, rate, mass)
      class(element_group_type), intent(in) :: self
      !> The model
      type(model_type), intent(in) :: model
      !> As in `find_rates`
      real(wp), intent(in) :: implicit
      !> Eigenvalues, 1/time squared, and masses, (layers, elements)
      real(wp), allocatable, intent(out) :: rate(:, :), mass(:, :)

      allocate (rate(0, 0), mass(0, 0))
   end subroutine find_layer_rates

   !> Add a share of the mass of one layer of each element to the masses of its points
   subroutine add_layer_mass(self, model, layer, share, elements, local_node, columns, mass)
      class(element_group_type), intent(in) :: self
      !> The model
      type(model_type), intent(in) :: model
      !> The layer, as in `find_layer_rates`
      integer, intent(in) :: layer
      !> Share for each element of the mesh, 0 for those of other groups
      real(wp), intent(in) :: share(:)
      !> As in `add_masses`
      integer, intent(in) :: elements(:), local_node(:)
      type(columns_type), intent(in) :: columns
      real(wp), intent(inout) :: mass(:)
   end subroutine add_layer_mass

   !> Raise the eigenvalues of springs at the faces of the layers of the group's part
   subroutine raise_spring_rates(self, model, columns, factor, rate)
      class(element_group_type), intent(in) :: self
      !> As in `spring_rate`
      type(model_type), intent(in) :: model
      type(columns_type), intent(in) :: columns
      real(wp), intent(in) :: factor
      !> Largest eigenvalue of the springs at either face so far, by layer
      real(wp), intent(inout) :: rate(:)
   end subroutine raise_spring_rates

   !> Largest eigenvalue that an element would have if its thickness were implicit; 0 where that
   !> does not apply
   real(wp) function rate_without_thickness(self, model, element, implicit) result(rate)
      class(element_group_type), intent(in) :: self
      !> The model
      type(model_type), intent(in) :: model
      !> Index in the mesh, of any rank
      integer, intent(in) :: element
      !> As in `find_rates`
      real(wp), intent(in) :: implicit

      rate = 0.0_wp
   end function rate_without_thickness

   !> Whether the group has springs between points
   pure logical function has_springs(self)
      class(element_group_type), intent(in) :: self

      has_springs = .false.
   end function has_springs

   !> Largest eigenvalue of the areas of the points of springs over the elements against those of
   !> their nodes; 0 where there are none
   real(wp) function point_factor(self, mesh) result(factor)
      class(element_group_type), intent(in) :: self
      !> The mesh
      type(mesh_type), intent(in) :: mesh

      factor = 0.0_wp
   end function point_factor

   !> Largest eigenvalue of springs between points
   real(wp) function spring_rate(self, model, columns, factor) result(rate)
      class(element_group_type), intent(in) :: self
      !> The model
      type(model_type), intent(in) :: model
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      !> Largest `point_factor` of the model
      real(wp), intent(in) :: factor

      rate = 0.0_wp
   end function spring_rate

   !> Set the stiffness of the springs between each layer and the next along x, y, z
   pure subroutine add_joint_stiffness(self, stiffness)
      class(element_group_type), intent(in) :: self
      !> Stiffness per area, (3, layers - 1)
      real(wp), intent(inout) :: stiffness(:, :)
   end subroutine add_joint_stiffness

   !> Stiffness of a layer through its thickness per area, along x, y, z
   pure function layer_springs(self, slot) result(spring)
      class(element_group_type), intent(in) :: self
      !> Order group, block and lane of the layer
      integer, intent(in) :: slot(3)
      real(wp) :: spring(3)

      spring(:) = 0.0_wp
   end function layer_springs

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

   !> Add areas and energies that interfaces have lost, as `losses` for each ply below one
   pure subroutine add_losses(self, history, sums)
      class(element_group_type), intent(in) :: self
      !> History of all Gauss points
      real(wp), intent(in), contiguous :: history(:)
      !> Sums
      type(exact_sums_type), intent(inout) :: sums
   end subroutine add_losses

   !> Mark the areas of points at which an interface is delaminated, and at which it has failed
   pure subroutine mark_areas(self, history, areas)
      class(element_group_type), intent(in) :: self
      !> History of all Gauss points
      real(wp), intent(in), contiguous :: history(:)
      !> Both areas of the points, the largest of several interfaces, else 0; allocated by the
      !> first group of a set that can fail, (2, points, elements)
      real(wp), allocatable, intent(inout) :: areas(:, :, :)
   end subroutine mark_areas

   !> Mark the plies above which there is an interface, and those where it can fail
   pure subroutine mark_interfaces(self, present, failing)
      class(element_group_type), intent(in) :: self
      !> Marks, by ply from the bottom up
      logical, intent(inout) :: present(:), failing(:)
   end subroutine mark_interfaces

   !> Add the crack bands of all points of the rank
   subroutine add_crack_bands(self, model, bands)
      class(element_group_type), intent(in) :: self
      !> The model
      type(model_type), intent(in) :: model
      !> Bands of each material
      type(crack_band_type), intent(inout) :: bands(:)
   end subroutine add_crack_bands

   !> Work of an element in a step, nanoseconds
   pure real(wp) function work(self)
      class(element_group_type), intent(in) :: self

      work = 0.0_wp
   end function work

   !> Add the numbers that the group keeps
   pure subroutine add_memory(self, reals, integers)
      class(element_group_type), intent(in) :: self
      !> Counts of reals and integers
      real(wp), intent(inout) :: reals, integers
   end subroutine add_memory

end module plydyn_element_group
