!> Element group of layer-wise plates: all layers of a part over its quads.
module plydyn_element_plate_group
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_crack_bands, only : crack_band_type
   use plydyn_element_group, only : element_group_type, group_item_type, recovered
   use plydyn_element_least_volume, only : least_volume_type
   use plydyn_element_plate_corner_volume, only : find_corner_volumes
   use plydyn_element_plate_kernels, only : new_kernels
   use plydyn_element_plate_crack_bands, only : add_batch_bands, start_batch
   use plydyn_element_plate_energies, only : add_batch_dissipation, add_plate_energy
   use plydyn_element_plate_layers, only : history_rows, kernels_type, layer_springs, plate_type
   use plydyn_element_plate_make, only : new_plate, set_quads
   use plydyn_element_plate_masses, only : add_plate_masses => add_masses
   use plydyn_element_plate_output, only : layer_place_type, node_shares, plate_cell, &
      & profile_values, values_at_nodes
   use plydyn_element_plate_stable_rate, only : layer_rates
   use plydyn_element_quad, only : quad_node_area
   use plydyn_element_recover_anywhere, only : plane_shares_type
   use plydyn_fem_columns, only : columns_type
   use plydyn_model_control, only : total_lagrangian
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_mesh, only : a_quad, mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: new_plate_group, plates_of

   !> Nanoseconds of a Gauss point of eight plies in tests/bench: linear, large displacement, law
   real(wp), parameter :: linear_work = 20.0_wp, large_work = 30.0_wp, law_work = 40.0_wp

   !> The layers of a part over its quads
   type, public, extends(element_group_type) :: plate_group_type
      !> Quads and layers
      type(plate_type) :: plate
      !> Kernels of each batch of layers
      type(kernels_type), allocatable :: kernels(:)
      !> Heights and plies of the layers
      type(layers_type) :: layers
      !> Order group, block and lane of each layer, (3, layers)
      integer, allocatable :: slot(:, :)
      !> Shares of the Gauss points at the nodes of a quad
      type(plane_shares_type) :: at_nodes
      !> Index of the group, which crack bands name
      integer :: number = 0
   contains
      procedure :: take_elements, set_targets, add_masses, set_history, find_rates, add_crack_bands
      procedure :: start_history, add_forces, find_volume, add_dissipation, add_stored_energy
      procedure :: find_nodes, output_values
      procedure :: profile
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

      integer :: k

      self%set = part
      self%part = part
      self%number = number
      self%large = model%control%kinematics == total_lagrangian
      self%element_kind = a_quad
      self%layer_kind = "ply"
      self%sets_forces = .true.
      self%plate = new_plate(model, part, columns)
      self%kernels = [(new_kernels(self%plate%side, self%plate%batches(k)%expansion%order), &
         & k=1, size(self%plate%batches))]
      self%layers = new_layers(model%parts(part))
      self%slot = columns%layer_slot
      self%at_nodes = node_shares(self%plate%side)
      self%work = quad_work(self%plate, self%large)
      self%history_shape = reshape([(lanes*history_rows(self%plate%batches(k), self%plate%side), &
         & self%plate%batches(k)%histories, self%plate%batches(k)%intact_histories, &
         & k=1, size(self%plate%batches))], [3, size(self%plate%batches)])
      allocate (self%layer_spring(3, size(self%layers%order)))
      do k = 1, size(self%layers%order)
         associate (slot => self%slot(:, k))
            self%layer_spring(:, k) = layer_springs(self%plate%batches(slot(1)), slot(3), slot(2))
         end associate
      end do
      self%cell = plate_cell(self%plate%side, self%layers%order)
   end function new_plate_group

   !> Work of a quad in all its plies, nanoseconds
   pure real(wp) function quad_work(plate, large) result(work)
      type(plate_type), intent(in) :: plate
      !> Large displacement
      logical, intent(in) :: large

      real(wp) :: point
      integer :: b

      work = 0.0_wp
      do b = 1, size(plate%batches)
         associate (batch => plate%batches(b))
            point = merge(large_work, linear_work, large)
            if (size(batch%laws) > 0) point = law_work
            work = work + point*batch%blocks*(batch%expansion%order + 1)*plate%side**2
         end associate
      end do
   end function quad_work

   subroutine take_elements(self, model, elements, local_node, columns)
      class(plate_group_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: elements(:), local_node(:)
      type(columns_type), intent(in) :: columns

      self%element = elements
      call set_quads(model, elements, local_node, self%plate)
      self%memory(:) = [size(self%plate%metric), size(self%plate%node) + size(self%plate%target) &
         & + size(self%plate%quad)]
   end subroutine take_elements

   !> The first quad at a column sets its forces: the layers of a quad fill the columns of its nodes
   pure subroutine set_targets(self, elements, height, column)
      class(plate_group_type), intent(inout) :: self
      integer, intent(in) :: elements(2), height, column(:)

      integer :: e, i
      logical :: is_new

      associate (node => self%plate%node)
         do e = elements(1), elements(2)
            do i = 1, size(node, 1)
               is_new = all(node(:, elements(1):e - 1) /= node(i, e))
               self%plate%target(i, e) = merge(-1, 1, is_new)*column(node(i, e))
            end do
         end do
      end associate
   end subroutine set_targets

   subroutine add_masses(self, model, elements, local_node, columns, mass, layer, share)
      class(plate_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: elements(:), local_node(:)
      type(columns_type), intent(in) :: columns
      real(wp), intent(inout) :: mass(:)
      integer, intent(in), optional :: layer
      real(wp), intent(in), optional :: share(:)

      call add_plate_masses(model, self%part, elements, local_node, columns, mass, layer, share)
   end subroutine add_masses

   pure subroutine start_history(self, model, history)
      class(plate_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      real(wp), intent(inout), contiguous :: history(:)
      integer :: b

      do b = 1, size(self%plate%batches)
         associate (batch => self%plate%batches(b))
            call start_batch(self%plate, batch, history(batch%first_history:))
         end associate
      end do
   end subroutine start_history

   pure subroutine add_forces(self, elements, step, displacement, velocity, history, force)
      class(plate_group_type), intent(in) :: self
      integer, intent(in) :: elements(2)
      real(wp), intent(in) :: step
      real(wp), intent(in), contiguous :: displacement(:), velocity(:)
      real(wp), intent(inout), contiguous :: history(:), force(:)
      integer :: b

      do b = 1, size(self%plate%batches)
         associate (batch => self%plate%batches(b), kernels => self%kernels(b), &
            & u => displacement(self%plate%batches(b)%first:), &
            & f => force(self%plate%batches(b)%first:))
            if (size(batch%laws) > 0) then
               call kernels%law(self%plate, b, elements, self%large, step, u, &
                  & history(batch%first_history:), f)
            else if (self%large) then
               call kernels%large(self%plate, b, elements, u, f)
            else
               call kernels%linear(self%plate, b, elements, u, f)
            end if
         end associate
      end do
   end subroutine add_forces

   pure subroutine find_volume(self, displacement, least, mesh)
      class(plate_group_type), intent(in) :: self
      real(wp), intent(in), contiguous :: displacement(:)
      type(least_volume_type), intent(inout) :: least
      type(mesh_type), intent(in), optional :: mesh

      type(least_volume_type) :: own
      integer :: b

      do b = 1, size(self%kernels)
         if (present(mesh)) then
            call find_corner_volumes(self%plate, self%plate%batches(b), mesh, displacement, own)
         else
            call self%kernels(b)%least_volume(self%plate, b, [1, size(self%element)], &
               & displacement(self%plate%batches(b)%first:), own)
         end if
      end do
      if (own%element < huge(1)) call least%take(own%ratio, own%element, self%layers%ply(own%layer))
   end subroutine find_volume

   subroutine find_rates(self, model, elements, implicit, rate, mass, layer)
      class(plate_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: elements(:)
      real(wp), intent(in) :: implicit
      real(wp), allocatable, intent(out) :: rate(:, :), mass(:, :)
      integer, allocatable, intent(out) :: layer(:)

      call layer_rates(model, self%part, self%plate, elements, implicit, rate, mass)
      layer = model%parts(self%part)%plies(self%layers%ply)%id
   end subroutine find_rates

   !> One block of history for each batch of layers
   pure subroutine set_history(self, first)
      class(plate_group_type), intent(inout) :: self
      integer, intent(in) :: first(:)

      self%plate%batches%first_history = first
   end subroutine set_history

   pure subroutine add_dissipation(self, history, sums)
      class(plate_group_type), intent(in) :: self
      real(wp), intent(in), contiguous :: history(:)
      type(exact_sums_type), intent(inout) :: sums
      integer :: b

      do b = 1, size(self%plate%batches)
         associate (batch => self%plate%batches(b))
            call add_batch_dissipation(batch, self%plate%metric, history(batch%first_history:), &
               & sums)
         end associate
      end do
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

   !> The weights are the areas of the nodes
   pure subroutine find_nodes(self, element, position, node, weight)
      class(plate_group_type), intent(in) :: self
      integer, intent(in) :: element
      real(wp), intent(in) :: position(:, :)
      integer, allocatable, intent(out) :: node(:)
      real(wp), allocatable, intent(out) :: weight(:)

      node = self%plate%node(:, element)
      weight = quad_node_area(self%plate%side, position(1:2, node))
   end subroutine find_nodes

   pure function output_values(self, place, has_tensors, displacement, history) result(values)
      class(plate_group_type), intent(in) :: self
      integer, intent(in) :: place(2)
      logical, intent(in) :: has_tensors
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      real(wp), allocatable :: values(:, :, :)

      values = values_at_nodes(self%plate, self%at_nodes, layer_place_type(place(1), place(2), &
         & self%cell%levels(place(2)), self%slot(:, place(2))), self%large, has_tensors, &
         & displacement, history)
   end function output_values

   !> Displacement, strain, stress and scalars at heights of a layer over a place of a quad,
   !> (3 + `recovered`, heights)
   pure function profile(self, columns, place, local, height, displacement, history) result(values)
      class(plate_group_type), intent(in) :: self
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      !> Number of the quad among those of the group, and layer
      integer, intent(in) :: place(2)
      !> Local coordinates of the place; heights in the layer, from -1 to 1
      real(wp), intent(in) :: local(2), height(:)
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      real(wp) :: values(3 + recovered, size(height))

      values(:, :) = profile_values(self%plate, layer_place_type(place(1), place(2), &
         & columns%levels(place(2)), self%slot(:, place(2))), self%large, columns, local, height, &
         & displacement, history)
   end function profile

   !> The plates among some groups, by their element sets: for building, since it copies them
   pure function plates_of(groups) result(plates)
      !> The groups
      type(group_item_type), intent(in) :: groups(:)
      type(plate_type), allocatable :: plates(:)
      integer :: g, n

      n = 0
      do g = 1, size(groups)
         select type (group => groups(g)%item)
         type is (plate_group_type)
            n = max(n, group%set)
         end select
      end do
      allocate (plates(n))
      do g = 1, size(groups)
         select type (group => groups(g)%item)
         type is (plate_group_type)
            plates(group%set) = group%plate
         end select
      end do
   end function plates_of

end module plydyn_element_plate_group
