!> Element group of layer-wise plates: all layers of a part over its quads.
module plydyn_element_plate_group
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_crack_bands, only : crack_band_type
   use plydyn_element_group, only : element_group_type
   use plydyn_element_least_volume, only : least_volume_type
   use plydyn_element_output_group, only : cell_type
   use plydyn_element_plate_corner_volume, only : find_corner_volumes
   use plydyn_element_plate_kernels, only : add_layer_forces, find_least_volume
   use plydyn_element_plate_crack_bands, only : add_batch_bands
   use plydyn_element_plate_dissipation, only : add_plate_dissipation
   use plydyn_element_plate_initial_history, only : start_histories
   use plydyn_element_plate_layers, only : history_rows, plate_type
   use plydyn_element_plate_make, only : new_plate, set_quads
   use plydyn_element_plate_masses, only : add_plate_masses => add_masses, add_mass_of_layer
   use plydyn_element_plate_output, only : layer_levels, layer_motion, layer_place_type, &
      & node_shares, plate_cell, values_at_nodes
   use plydyn_element_plate_profile, only : find_local, profile_values
   use plydyn_element_plate_stable_rate, only : largest_quad_factor, layer_rates, plane_rate, &
      & rates_and_masses
   use plydyn_element_plate_stored_energy, only : add_plate_energy
   use plydyn_element_quad, only : quad_node_area
   use plydyn_element_recovered, only : recovered
   use plydyn_element_recover_anywhere, only : plane_shares_type
   use plydyn_element_thickness, only : springs_of_layer => layer_springs
   use plydyn_fem_columns, only : columns_type
   use plydyn_model_control, only : total_lagrangian
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: new_plate_group

   !> Nanoseconds of a Gauss point of eight plies in tests/bench: linear, large displacement, law
   real(wp), parameter :: linear_work = 20.0_wp, large_work = 30.0_wp, law_work = 40.0_wp

   !> The layers of a part over its quads
   type, public, extends(element_group_type) :: plate_group_type
      !> Quads and layers
      type(plate_type) :: plate
      !> Heights and plies of the layers
      type(layers_type) :: layers
      !> Order group, block and lane of each layer, (3, layers)
      integer, allocatable :: slot(:, :)
      !> Shares of the Gauss points at the nodes of a quad
      type(plane_shares_type) :: at_nodes
      !> Index of the group, which crack bands name
      integer :: number = 0
   contains
      procedure :: take_elements, set_targets, add_masses, add_layer_mass
      procedure :: history_shape, set_history, start_history
      procedure :: add_forces, find_volume
      procedure :: find_rates, find_layer_rates, rate_without_thickness, point_factor, layer_springs
      procedure :: add_dissipation, add_stored_energy, add_crack_bands, fibre_angle, work
      procedure :: add_memory, element_id, sheets, sheet_levels, find_cell, list_elements
      procedure :: element_nodes, node_weights, sheet_motion, output_values, find_place, profile
   end type plate_group_type

contains

   !> The layers of a part, still without quads
   function new_plate_group(model, part, number, columns) result(self)
      !> The model
      type(model_type), intent(in) :: model
      !> Index of the part, which is the element set, and of the group
      integer, intent(in) :: part, number
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      type(plate_group_type) :: self

      self%set = part
      self%part = part
      self%number = number
      self%large = model%control%kinematics == total_lagrangian
      self%element_kind = "quad"
      self%layer_kind = "ply"
      self%sets_forces = .true.
      self%plate = new_plate(model, part, columns)
      self%layers = new_layers(model%parts(part))
      self%slot = columns%layer_slot
      self%at_nodes = node_shares(self%plate%side)
   end function new_plate_group

   subroutine take_elements(self, model, elements, local_node, columns)
      class(plate_group_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: elements(:), local_node(:)
      type(columns_type), intent(in) :: columns

      self%element = elements
      call set_quads(model, self%part, elements, local_node, self%plate)
   end subroutine take_elements

   !> The first quad at a column sets its forces: the layers of a quad fill the columns of its nodes
   pure subroutine set_targets(self, elements, height, column)
      class(plate_group_type), intent(inout) :: self
      integer, intent(in) :: elements(2), height, column(:)

      integer :: e, i
      logical :: is_new(size(column))

      is_new(:) = .true.
      associate (node => self%plate%node)
         do e = elements(1), elements(2)
            do i = 1, size(node, 1)
               self%plate%target(i, e) = merge(-1, 1, is_new(node(i, e)))*column(node(i, e))
               is_new(node(i, e)) = .false.
            end do
         end do
      end associate
   end subroutine set_targets

   subroutine add_masses(self, model, elements, local_node, columns, mass)
      class(plate_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: elements(:), local_node(:)
      type(columns_type), intent(in) :: columns
      real(wp), intent(inout) :: mass(:)

      call add_plate_masses(model, self%part, self%plate, elements, local_node, columns, mass)
   end subroutine add_masses

   subroutine add_layer_mass(self, model, layer, share, elements, local_node, columns, mass)
      class(plate_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: layer, elements(:), local_node(:)
      real(wp), intent(in) :: share(:)
      type(columns_type), intent(in) :: columns
      real(wp), intent(inout) :: mass(:)

      call add_mass_of_layer(model, self%part, layer, share, elements, local_node, columns, mass)
   end subroutine add_layer_mass

   !> One block of history for each batch of layers
   pure function history_shape(self) result(blocks)
      class(plate_group_type), intent(in) :: self
      integer, allocatable :: blocks(:, :)
      integer :: b

      associate (batches => self%plate%batches)
         allocate (blocks(2, size(batches)))
         do b = 1, size(batches)
            blocks(:, b) = [lanes*history_rows(batches(b), self%plate%side), batches(b)%histories]
         end do
      end associate
   end function history_shape

   pure subroutine set_history(self, block, first)
      class(plate_group_type), intent(inout) :: self
      integer, intent(in) :: block, first

      self%plate%batches(block)%first_history = first
   end subroutine set_history

   pure subroutine start_history(self, history)
      class(plate_group_type), intent(in) :: self
      real(wp), intent(inout), contiguous :: history(:)

      call start_histories(self%plate, history)
   end subroutine start_history

   pure subroutine add_forces(self, elements, step, displacement, velocity, history, force)
      class(plate_group_type), intent(in) :: self
      integer, intent(in) :: elements(2)
      real(wp), intent(in) :: step
      real(wp), intent(in), contiguous :: displacement(:), velocity(:)
      real(wp), intent(inout), contiguous :: history(:), force(:)
      integer :: b

      do b = 1, size(self%plate%batches)
         call add_layer_forces(self%plate, b, elements, self%large, step, displacement, history, &
            & force)
      end do
   end subroutine add_forces

   pure subroutine find_volume(self, displacement, least, mesh)
      class(plate_group_type), intent(in) :: self
      real(wp), intent(in), contiguous :: displacement(:)
      type(least_volume_type), intent(inout) :: least
      type(mesh_type), intent(in), optional :: mesh

      type(least_volume_type) :: own

      if (present(mesh)) then
         call find_corner_volumes(self%plate, mesh, displacement, own)
      else
         call find_least_volume(self%plate, displacement, own)
      end if
      if (own%element < huge(1)) call least%take(own%ratio, own%element, self%layers%ply(own%layer))
   end subroutine find_volume

   subroutine find_rates(self, model, implicit, rate, layer)
      class(plate_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      real(wp), intent(in) :: implicit
      real(wp), allocatable, intent(out) :: rate(:)
      integer, allocatable, intent(out) :: layer(:)

      call layer_rates(model, self%part, self%plate, implicit, rate, layer)
   end subroutine find_rates

   subroutine find_layer_rates(self, model, implicit, rate, mass)
      class(plate_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      real(wp), intent(in) :: implicit
      real(wp), allocatable, intent(out) :: rate(:, :), mass(:, :)

      call rates_and_masses(model, self%part, self%plate, implicit, rate, mass)
   end subroutine find_layer_rates

   real(wp) function rate_without_thickness(self, model, element, implicit) result(rate)
      class(plate_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: element
      real(wp), intent(in) :: implicit

      rate = plane_rate(model, self%part, self%plate, element, implicit)
   end function rate_without_thickness

   !> The largest of all quads
   real(wp) function point_factor(self, mesh) result(factor)
      class(plate_group_type), intent(in) :: self
      type(mesh_type), intent(in) :: mesh

      factor = largest_quad_factor(self%plate, mesh)
   end function point_factor

   pure function layer_springs(self, slot) result(spring)
      class(plate_group_type), intent(in) :: self
      integer, intent(in) :: slot(3)
      real(wp) :: spring(3)

      spring(:) = springs_of_layer(self%plate%batches(slot(1)), slot(3), slot(2))
   end function layer_springs

   pure subroutine add_dissipation(self, history, sums)
      class(plate_group_type), intent(in) :: self
      real(wp), intent(in), contiguous :: history(:)
      type(exact_sums_type), intent(inout) :: sums

      call add_plate_dissipation(self%plate, history, sums)
   end subroutine add_dissipation

   pure subroutine add_stored_energy(self, elements, displacement, history, sums)
      class(plate_group_type), intent(in) :: self
      integer, intent(in) :: elements(2)
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      type(exact_sums_type), intent(inout) :: sums

      call add_plate_energy(self%plate, elements, self%large, displacement, history, sums)
   end subroutine add_stored_energy

   subroutine add_crack_bands(self, model, bands)
      class(plate_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      type(crack_band_type), intent(inout) :: bands(:)
      integer :: b

      do b = 1, size(self%plate%batches)
         call add_batch_bands(model, self%layers, [self%part, self%number], self%plate, &
            & self%plate%batches(b), bands)
      end do
   end subroutine add_crack_bands

   !> Work of a quad in all its plies
   pure real(wp) function work(self)
      class(plate_group_type), intent(in) :: self

      real(wp) :: point
      integer :: b

      work = 0.0_wp
      do b = 1, size(self%plate%batches)
         associate (batch => self%plate%batches(b))
            point = merge(large_work, linear_work, self%large)
            if (size(batch%laws) > 0) point = law_work
            work = work + point*batch%blocks*(batch%expansion%order + 1)*self%plate%side**2
         end associate
      end do
   end function work

   pure subroutine add_memory(self, reals, integers)
      class(plate_group_type), intent(in) :: self
      real(wp), intent(inout) :: reals, integers

      reals = reals + size(self%plate%metric)
      integers = integers + size(self%plate%node) + size(self%plate%target) + size(self%plate%quad)
   end subroutine add_memory

   pure integer function element_id(self, mesh, element) result(id)
      class(plate_group_type), intent(in) :: self
      type(mesh_type), intent(in) :: mesh
      integer, intent(in) :: element

      id = mesh%quad_id(element)
   end function element_id

   pure integer function sheets(self)
      class(plate_group_type), intent(in) :: self

      sheets = size(self%layers%order)
   end function sheets

   pure integer function sheet_levels(self, sheet) result(levels)
      class(plate_group_type), intent(in) :: self
      integer, intent(in) :: sheet

      levels = layer_levels(self%layers%order(sheet), self%plate%side**2)
   end function sheet_levels

   pure function find_cell(self) result(cell)
      class(plate_group_type), intent(in) :: self
      type(cell_type) :: cell

      cell = plate_cell(self%plate%side)
   end function find_cell

   pure subroutine list_elements(self, mesh, part, node)
      class(plate_group_type), intent(in) :: self
      type(mesh_type), intent(in) :: mesh
      integer, allocatable, intent(out) :: part(:), node(:, :)

      part = mesh%quad_part
      node = mesh%quad_node
   end subroutine list_elements

   pure function element_nodes(self, element) result(node)
      class(plate_group_type), intent(in) :: self
      integer, intent(in) :: element
      integer, allocatable :: node(:)

      node = self%plate%node(:, element)
   end function element_nodes

   !> The area of each node
   pure function node_weights(self, element, position) result(weight)
      class(plate_group_type), intent(in) :: self
      integer, intent(in) :: element
      real(wp), intent(in) :: position(:, :)
      real(wp) :: weight(size(position, 2))

      weight(:) = quad_node_area(self%plate%side, position(1:2, :))
   end function node_weights

   pure function sheet_motion(self, columns, sheet, node, motion) result(values)
      class(plate_group_type), intent(in) :: self
      type(columns_type), intent(in) :: columns
      integer, intent(in) :: sheet, node(:)
      real(wp), intent(in), contiguous :: motion(:)
      real(wp), allocatable :: values(:, :, :)

      values = layer_motion(columns, sheet, self%sheet_levels(sheet), node, motion)
   end function sheet_motion

   pure function output_values(self, place, has_tensors, displacement, history) result(values)
      class(plate_group_type), intent(in) :: self
      integer, intent(in) :: place(2)
      logical, intent(in) :: has_tensors
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      real(wp), allocatable :: values(:, :, :)

      values = values_at_nodes(self%plate, self%at_nodes, layer_place_type(place(1), place(2), &
         & self%sheet_levels(place(2)), self%slot(:, place(2))), self%large, has_tensors, &
         & displacement, history)
   end function output_values

   pure subroutine find_place(self, corner, position, local, found)
      class(plate_group_type), intent(in) :: self
      real(wp), intent(in) :: corner(:, :), position(2)
      real(wp), intent(out) :: local(2)
      logical, intent(out) :: found

      call find_local(self%plate%side, corner, position, local, found)
   end subroutine find_place

   pure function profile(self, columns, place, local, height, displacement, history) result(values)
      class(plate_group_type), intent(in) :: self
      type(columns_type), intent(in) :: columns
      integer, intent(in) :: place(2)
      real(wp), intent(in) :: local(2), height(:)
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      real(wp) :: values(3 + recovered, size(height))

      values(:, :) = profile_values(self%plate, layer_place_type(place(1), place(2), &
         & columns%levels(place(2)), self%slot(:, place(2))), self%large, columns, local, height, &
         & displacement, history)
   end function profile

   pure real(wp) function fibre_angle(self, model, element, ply) result(angle)
      class(plate_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: element, ply

      angle = model%parts(model%mesh%quad_part(element))%plies(ply)%angle
   end function fibre_angle

end module plydyn_element_plate_group
