!> Element group of bricks: those of a part with fibres in one direction. Its elements are batches
!> of as many bricks as there are lanes.
module plydyn_element_brick_group
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_brick_bricks, only : brick_shares, bricks_type, corners
   use plydyn_element_brick_crack_bands, only : add_brick_bands, start_brick_history
   use plydyn_element_brick_kernel, only : add_brick_forces, brick_volume_ratios
   use plydyn_element_brick_make, only : add_brick_masses, brick_density, find_shapes, &
      & set_batches
   use plydyn_element_brick_stable_rate, only : part_rates
   use plydyn_element_brick_recover, only : add_brick_dissipation, add_brick_energy, brick_values
   use plydyn_element_crack_bands, only : crack_band_type
   use plydyn_element_group, only : element_group_type, recovered
   use plydyn_element_least_volume, only : least_volume_type
   use plydyn_fem_columns, only : alignment_offset, columns_type
   use plydyn_model_control, only : total_lagrangian
   use plydyn_model_mesh, only : a_brick, mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: new_brick_group

   !> VTK's cell of eight nodes
   integer, parameter :: hexahedron = 12

   !> Bricks of a part with fibres in one direction
   type, public, extends(element_group_type) :: brick_group_type
      !> The bricks
      type(bricks_type) :: bricks
      !> The rank's number of each node of the bricks it has, (8, bricks)
      integer, allocatable :: node(:, :)
   contains
      procedure :: take_elements, set_targets, add_masses, set_history, find_rates, add_crack_bands
      procedure :: start_history, add_forces, find_volume, add_dissipation, add_stored_energy
      procedure :: find_nodes, output_values
   end type brick_group_type

contains

   !> A group of some bricks, still without geometry and places
   function new_brick_group(model, bricks, number) result(self)
      !> The model
      type(model_type), intent(in) :: model
      !> The bricks
      type(bricks_type), intent(in) :: bricks
      !> Index of the group, which is the element set
      integer, intent(in) :: number
      type(brick_group_type) :: self

      integer :: i

      self%set = number
      self%part = bricks%part
      self%large = model%control%kinematics == total_lagrangian
      self%element_kind = a_brick
      self%layer_kind = "part"
      self%bricks = bricks
      ! only the shares of the groups of one model count
      self%work = real(lanes, wp)
      ! one block, a batch after the other
      self%history_shape = reshape([lanes*bricks%histories*bricks%points, 1, 1], [3, 1])
      ! nodes are points
      self%cell%kind = hexahedron
      self%cell%levels = [1]
      self%cell%node_order = [(i, i=1, corners)]
      self%cell%corner = reshape([(i, 0, i=1, corners)], [2, corners])
   end function new_brick_group

   subroutine take_elements(self, model, elements, local_node, columns)
      class(brick_group_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: elements(:), local_node(:)
      type(columns_type), intent(in) :: columns
      integer :: e

      call set_batches(model%mesh, elements, local_node, columns, self%bricks)
      call find_shapes(model, elements, self%bricks)
      self%element = self%bricks%brick
      allocate (self%node(corners, size(self%element)))
      do e = 1, size(self%element)
         self%node(:, e) = local_node(model%mesh%brick_node(:, self%element(e)))
      end do
      self%memory(:) = [0, size(self%bricks%place) + size(self%bricks%target)]
   end subroutine take_elements

   !> Forces have the places of displacements, in the columns of the chunk
   pure subroutine set_targets(self, elements, height, column)
      class(brick_group_type), intent(inout) :: self
      integer, intent(in) :: elements(2), height, column(:)

      integer :: b, n

      do b = elements(1), elements(2)
         do n = 1, size(self%bricks%place, 2)
            associate (place => self%bricks%place(:, n, b) - alignment_offset - 1)
               self%bricks%target(:, n, b) = alignment_offset + 1 + mod(place, height) &
                  & + height*(column(1 + place/height) - 1)
            end associate
         end do
      end do
   end subroutine set_targets

   !> All bricks of the model in this group, before the rank takes its own; later those of the mesh
   !> that have a share
   subroutine add_masses(self, model, elements, local_node, columns, mass, layer, share)
      class(brick_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: elements(:), local_node(:)
      type(columns_type), intent(in) :: columns
      real(wp), intent(inout) :: mass(:)
      real(wp), intent(in), optional :: share(:)
      integer, intent(in), optional :: layer
      integer :: e

      if (present(share)) then
         call add_brick_masses(model, pack([(e, e=1, size(share))], share > 0.0_wp), local_node, &
            & columns, mass, share)
      else
         call add_brick_masses(model, self%bricks%brick, local_node, columns, mass)
      end if
   end subroutine add_masses

   pure subroutine set_history(self, first)
      class(brick_group_type), intent(inout) :: self
      integer, intent(in) :: first(:)

      self%bricks%first_history = first(1)
   end subroutine set_history

   pure subroutine start_history(self, model, history)
      class(brick_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      real(wp), intent(inout), contiguous :: history(:)

      call start_brick_history(self%bricks, history(self%bricks%first_history:))
   end subroutine start_history

   pure subroutine add_forces(self, elements, step, displacement, velocity, history, force)
      class(brick_group_type), intent(in) :: self
      integer, intent(in) :: elements(2)
      real(wp), intent(in) :: step
      real(wp), intent(in), contiguous :: displacement(:), velocity(:)
      real(wp), intent(inout), contiguous :: history(:), force(:)

      call add_brick_forces(self%bricks, elements, self%large, step, displacement, velocity, &
         & history(self%bricks%first_history:), force)
   end subroutine add_forces

   !> At the points of the bricks in any case
   pure subroutine find_volume(self, displacement, least, mesh)
      class(brick_group_type), intent(in) :: self
      real(wp), intent(in), contiguous :: displacement(:)
      type(least_volume_type), intent(inout) :: least
      type(mesh_type), intent(in), optional :: mesh

      real(wp) :: ratio(lanes)
      integer :: b, l

      do b = 1, size(self%bricks%shape)
         ratio(:) = brick_volume_ratios(self%bricks, b, displacement)
         do l = 1, min(lanes, size(self%element) - lanes*(b - 1))
            call least%take(ratio(l), self%element(lanes*(b - 1) + l), 0)
         end do
      end do
   end subroutine find_volume

   !> A brick is one layer
   subroutine find_rates(self, model, elements, implicit, rate, mass, layer)
      class(brick_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: elements(:)
      real(wp), intent(in) :: implicit
      real(wp), allocatable, intent(out) :: rate(:, :), mass(:, :)
      integer, allocatable, intent(out) :: layer(:)

      integer :: e

      rate = reshape(part_rates(model, self%bricks), [1, size(elements)])
      mass = reshape([(brick_density(model, self%part)*sum(brick_shares(model%mesh%position(:, &
         & model%mesh%brick_node(:, elements(e))))), e=1, size(elements))], shape(rate))
      layer = [model%parts(self%part)%id]
   end subroutine find_rates

   pure subroutine add_dissipation(self, history, sums)
      class(brick_group_type), intent(in) :: self
      real(wp), intent(in), contiguous :: history(:)
      type(exact_sums_type), intent(inout) :: sums

      call add_brick_dissipation(self%bricks, history(self%bricks%first_history:), sums)
   end subroutine add_dissipation

   pure subroutine add_stored_energy(self, elements, displacement, history, sums)
      class(brick_group_type), intent(in) :: self
      integer, intent(in) :: elements(2)
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      type(exact_sums_type), intent(inout) :: sums

      call add_brick_energy(self%bricks, elements, self%large, displacement, &
         & history(self%bricks%first_history:), sums)
   end subroutine add_stored_energy

   subroutine add_crack_bands(self, model, bands)
      class(brick_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      type(crack_band_type), intent(inout) :: bands(:)

      call add_brick_bands(model, self%bricks, self%set, bands)
   end subroutine add_crack_bands

   !> The weight is the volume of the brick
   pure subroutine find_nodes(self, element, position, node, weight)
      class(brick_group_type), intent(in) :: self
      integer, intent(in) :: element
      real(wp), intent(in) :: position(:, :)
      integer, allocatable, intent(out) :: node(:)
      real(wp), allocatable, intent(out) :: weight(:)

      node = self%node(:, element)
      associate (batch => (element - 1)/lanes + 1, lane => mod(element - 1, lanes) + 1)
         weight = spread(sum(self%bricks%shapes(self%bricks%shape(batch))%volume(lane, :)), 1, &
            & corners)
      end associate
   end subroutine find_nodes

   !> The mean over the points of the brick at all its nodes
   pure function output_values(self, place, has_tensors, displacement, history) result(values)
      class(brick_group_type), intent(in) :: self
      integer, intent(in) :: place(2)
      logical, intent(in) :: has_tensors
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      real(wp), allocatable :: values(:, :, :)

      real(wp) :: batch(lanes, recovered)

      batch(:, :) = brick_values(self%bricks, (place(1) - 1)/lanes + 1, self%large, displacement, &
         & history(self%bricks%first_history:))
      values = spread(spread(batch(mod(place(1) - 1, lanes) + 1, :), 2, 1), 3, corners)
   end function output_values

end module plydyn_element_brick_group
