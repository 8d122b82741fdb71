!> Element group of interfaces between layers: a batch of one material over the quads of a part.
module plydyn_element_interface_group
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_group, only : element_group_type, losses
   use plydyn_element_interface_interfaces, only : history_size, interface_sums_type, &
      & interface_type, &
      & set_interface_damage => set_damage, set_plane, sum_lanes
   use plydyn_element_interface_kernel, only : add_face_forces
   use plydyn_element_interface_process_zones, only : find_weakness
   use plydyn_element_interface_stored_energy, only : add_interface_energy
   use plydyn_element_quad, only : tensor_order
   use plydyn_fem_columns, only : columns_type
   use plydyn_fem_quadrature, only : quad_points
   use plydyn_law_cohesive_softening, only : damage_at, delaminated_share, share_at
   use plydyn_model_control, only : total_lagrangian
   use plydyn_model_initial, only : initial_damage_type
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: new_interface_group

   !> Work at a point of eight interfaces: nanoseconds as tests/bench measures them
   real(wp), parameter :: interface_work = 15.0_wp

   !> Interfaces of one material over the quads of a part
   type, public, extends(element_group_type) :: interface_group_type
      !> The batch
      type(interface_type) :: batch
      !> Ply below each lane, counted from the bottom: the number of the interface; 0 for none
      integer :: ply(lanes) = 0
   contains
      procedure :: take_elements
      procedure :: set_targets
      procedure :: history_shape
      procedure :: set_history
      procedure :: set_damage
      procedure :: add_forces
      procedure :: has_springs
      procedure :: point_factor
      procedure :: spring_rate, raise_spring_rates
      procedure :: add_joint_stiffness
      procedure :: add_losses
      procedure :: add_stored_energy
      procedure :: mark_areas
      procedure :: mark_interfaces
      procedure :: work
      procedure :: add_memory
      procedure :: element_id
   end type interface_group_type

contains

   !> A group of some interfaces of a part, still without quads
   pure function new_interface_group(model, batch) result(self)
      !> The model
      type(model_type), intent(in) :: model
      !> The interfaces
      type(interface_type), intent(in) :: batch
      type(interface_group_type) :: self

      type(layers_type) :: layers
      integer :: l

      self%set = batch%plate
      self%part = batch%plate
      self%large = model%control%kinematics == total_lagrangian
      self%element_kind = "quad"
      self%layer_kind = "interface"
      self%batch = batch
      layers = new_layers(model%parts(1))
      do l = 1, lanes
         if (batch%lower(l) > 0) self%ply(l) = layers%ply(batch%lower(l))
      end do
   end function new_interface_group

   subroutine take_elements(self, model, elements, local_node, columns)
      class(interface_group_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: elements(:), local_node(:)
      type(columns_type), intent(in) :: columns

      real(wp), allocatable :: position(:, :)
      integer, allocatable :: node(:, :)
      integer :: e, n

      allocate (position(3, maxval([0, local_node])))
      allocate (node(self%batch%side**2, size(elements)))
      do n = 1, size(local_node)
         if (local_node(n) > 0) position(:, local_node(n)) = model%mesh%position(:, n)
      end do
      do e = 1, size(elements)
         node(:, e) = local_node(model%mesh%quad_node(tensor_order(self%batch%side), elements(e)))
      end do
      self%element = elements
      call set_plane(self%batch, elements, node, position)
      if (self%batch%law%histories > 0) call find_weakness(model, self%batch%material, elements, &
         & self%ply, self%batch%weakness)
   end subroutine take_elements

   pure subroutine set_targets(self, elements, height, column)
      class(interface_group_type), intent(inout) :: self
      integer, intent(in) :: elements(2), height, column(:)
      integer :: e

      do e = elements(1), elements(2)
         self%batch%target(:, e) = column(self%batch%node(:, e))
      end do
   end subroutine set_targets

   !> One block of history
   pure function history_shape(self) result(blocks)
      class(interface_group_type), intent(in) :: self
      integer, allocatable :: blocks(:, :)

      blocks = reshape([lanes*self%batch%side**2, self%batch%law%histories], [2, 1])
   end function history_shape

   pure subroutine set_history(self, block, first)
      class(interface_group_type), intent(inout) :: self
      integer, intent(in) :: block, first

      self%batch%first_history = first
   end subroutine set_history

   pure subroutine set_damage(self, mesh, initial, history)
      class(interface_group_type), intent(in) :: self
      type(mesh_type), intent(in) :: mesh
      type(initial_damage_type), intent(in) :: initial
      real(wp), intent(inout), contiguous :: history(:)
      integer :: l

      if (self%part /= initial%part .or. self%batch%law%histories == 0) return
      associate (batch => self%batch)
         do l = 1, lanes
            if (self%ply(l) == 0) cycle
            if (self%ply(l) < initial%interfaces(1) .or. self%ply(l) > initial%interfaces(2)) cycle
            call set_interface_damage(batch, l, chosen_points(mesh, batch, initial), &
               & initial%damage, history(batch%first_history:batch%first_history - 1 &
               & + history_size(batch)))
         end do
      end associate
   end subroutine set_damage

   !> Points of the elements that are meant, within the circle, (points, quads)
   pure function chosen_points(mesh, batch, initial) result(chosen)
      type(mesh_type), intent(in) :: mesh
      type(interface_type), intent(in) :: batch
      type(initial_damage_type), intent(in) :: initial
      logical :: chosen(size(batch%node, 1), size(batch%node, 2))

      logical :: named(max(maxval(batch%quad), maxval(initial%quads)))
      integer :: e

      named(:) = .false.
      named(initial%quads) = .true.
      chosen(:, :) = .false.
      do e = 1, size(batch%quad)
         if (.not. named(batch%quad(e))) cycle
         associate (nodes => mesh%quad_node(:, batch%quad(e)))
            chosen(:, e) = initial%encloses(quad_points(mesh%position(:2, nodes), batch%nodal))
         end associate
      end do
   end function chosen_points

   pure subroutine add_forces(self, elements, step, displacement, velocity, history, force)
      class(interface_group_type), intent(in) :: self
      integer, intent(in) :: elements(2)
      real(wp), intent(in) :: step
      real(wp), intent(in), contiguous :: displacement(:), velocity(:)
      real(wp), intent(inout), contiguous :: history(:), force(:)

      call add_face_forces(self%batch, elements, self%large, displacement, &
         & history(self%batch%first_history:), force)
   end subroutine add_forces

   pure logical function has_springs(self)
      class(interface_group_type), intent(in) :: self

      has_springs = .true.
   end function has_springs

   !> Points at the nodes have their areas
   real(wp) function point_factor(self, mesh) result(factor)
      class(interface_group_type), intent(in) :: self
      type(mesh_type), intent(in) :: mesh

      factor = merge(1.0_wp, 0.0_wp, self%batch%nodal)
   end function point_factor

   !> Stiffness over the mass per area of both faces, whichever part has the lightest layers
   real(wp) function spring_rate(self, model, columns, factor) result(rate)
      class(interface_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      type(columns_type), intent(in) :: columns
      real(wp), intent(in) :: factor

      type(layers_type) :: layers
      real(wp) :: inverse
      integer :: l, p

      rate = 0.0_wp
      do p = 1, size(model%parts)
         layers = new_layers(model%parts(p))
         do l = 1, lanes
            associate (lower => self%batch%lower(l), upper => self%batch%upper(l))
               if (lower == 0) cycle
               inverse = 1.0_wp/face_density(model, columns, p, layers, lower) &
                  & + 1.0_wp/face_density(model, columns, p, layers, upper)
               rate = max(rate, maxval(self%batch%law%stiffness)*factor*inverse)
            end associate
         end do
      end do
   end function spring_rate

   subroutine raise_spring_rates(self, model, columns, factor, rate)
      class(interface_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      type(columns_type), intent(in) :: columns
      real(wp), intent(in) :: factor
      real(wp), intent(inout) :: rate(:)

      type(layers_type) :: layers
      real(wp) :: inverse
      integer :: l

      layers = new_layers(model%parts(self%part))
      do l = 1, lanes
         associate (lower => self%batch%lower(l), upper => self%batch%upper(l))
            if (lower == 0) cycle
            inverse = 1.0_wp/face_density(model, columns, self%part, layers, lower) &
               & + 1.0_wp/face_density(model, columns, self%part, layers, upper)
            rate([lower, upper]) = max(rate([lower, upper]), &
               & maxval(self%batch%law%stiffness)*factor*inverse)
         end associate
      end do
   end subroutine raise_spring_rates

   !> Mass per area that a layer has on one of its faces
   pure real(wp) function face_density(model, columns, p, layers, layer) result(density)
      type(model_type), intent(in) :: model
      type(columns_type), intent(in) :: columns
      integer, intent(in) :: p, layer
      type(layers_type), intent(in) :: layers

      associate (material => model%materials(model%parts(p)%plies(layers%ply(layer))%material), &
         & expansion => columns%order_groups(columns%layer_slot(1, layer))%expansion)
         density = material%density*(layers%top(layer) - layers%bottom(layer)) &
            & *expansion%mass_share(1)
      end associate
   end function face_density

   !> With large displacement springs turn: then the stiffer one stands for all directions
   pure subroutine add_joint_stiffness(self, stiffness)
      class(interface_group_type), intent(in) :: self
      real(wp), intent(inout) :: stiffness(:, :)
      integer :: l

      associate (both => self%batch%law%stiffness)
         do l = 1, lanes
            if (self%batch%lower(l) == 0) cycle
            stiffness(:, self%batch%lower(l)) = [both(2), both(2), both(1)]
            if (self%large) stiffness(:, self%batch%lower(l)) = maxval(both)
         end do
      end associate
   end subroutine add_joint_stiffness

   pure subroutine add_stored_energy(self, elements, displacement, history, sums)
      class(interface_group_type), intent(in) :: self
      integer, intent(in) :: elements(2)
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      type(exact_sums_type), intent(inout) :: sums

      call add_interface_energy(self%batch, elements, self%large, displacement, &
         & history(self%batch%first_history:), sums)
   end subroutine add_stored_energy

   pure subroutine add_losses(self, history, sums)
      class(interface_group_type), intent(in) :: self
      real(wp), intent(in), contiguous :: history(:)
      type(exact_sums_type), intent(inout) :: sums

      if (self%batch%law%histories == 0) return
      call add_batch_losses(self, history(self%batch%first_history:), sums)
   end subroutine add_losses

   !> Add the losses of a batch of interfaces, quad by quad
   pure subroutine add_batch_losses(self, history, sums)
      type(interface_group_type), intent(in) :: self
      real(wp), intent(in) :: history(lanes, size(self%batch%node, 1), size(self%batch%node, 2), &
         & self%batch%law%histories)
      type(exact_sums_type), intent(inout) :: sums

      type(interface_sums_type) :: part
      integer :: e, l

      do e = 1, size(self%batch%node, 2)
         part = sum_lanes(self%batch, e, history)
         do l = 1, lanes
            if (self%ply(l) == 0) cycle
            associate (last => losses*self%ply(l))
               call sums%add(last - 5, part%begun(l))
               call sums%add(last - 4, part%delaminated(l))
               call sums%add(last - 3, part%failed(l))
               call sums%add(last - 2, part%fracture(l))
               call sums%add(last - 1, part%closing(l))
               call sums%add(last, part%friction(l))
            end associate
         end do
      end do
   end subroutine add_batch_losses

   pure subroutine mark_areas(self, history, areas)
      class(interface_group_type), intent(in) :: self
      real(wp), intent(in), contiguous :: history(:)
      real(wp), allocatable, intent(inout) :: areas(:, :, :)

      if (self%batch%law%histories == 0) return
      if (.not. allocated(areas)) then
         allocate (areas(2, size(self%batch%node, 1), size(self%batch%node, 2)), source=0.0_wp)
      end if
      call mark_points(self%batch, history(self%batch%first_history:), areas)
   end subroutine mark_areas

   !> Mark the areas of the points of a batch that are delaminated, and of those that have failed
   pure subroutine mark_points(batch, history, areas)
      type(interface_type), intent(in) :: batch
      real(wp), intent(in) :: history(lanes, size(batch%node, 1), size(batch%node, 2), &
         & batch%law%histories)
      real(wp), intent(inout) :: areas(:, :, :)

      logical :: reached(2)
      integer :: e, q

      do e = 1, size(batch%node, 2)
         do q = 1, size(batch%node, 1)
            reached(1) = any(history(:, q, e, share_at) >= delaminated_share .and. batch%lower > 0)
            reached(2) = any(history(:, q, e, damage_at) >= 1.0_wp .and. batch%lower > 0)
            where (reached) areas(:, q, e) = max(areas(:, q, e), batch%metric(5, q, e))
         end do
      end do
   end subroutine mark_points

   pure subroutine mark_interfaces(self, present, failing)
      class(interface_group_type), intent(in) :: self
      logical, intent(inout) :: present(:), failing(:)

      present(pack(self%ply, self%ply > 0)) = .true.
      if (self%batch%law%histories > 0) failing(pack(self%ply, self%ply > 0)) = .true.
   end subroutine mark_interfaces

   !> Work of the interfaces over a quad
   pure real(wp) function work(self)
      class(interface_group_type), intent(in) :: self

      work = interface_work*self%batch%side**2
   end function work

   pure subroutine add_memory(self, reals, integers)
      class(interface_group_type), intent(in) :: self
      real(wp), intent(inout) :: reals, integers

      reals = reals + size(self%batch%metric)
      if (allocated(self%batch%weakness)) reals = reals + size(self%batch%weakness)
      integers = integers + size(self%batch%node) + size(self%batch%target)
   end subroutine add_memory

   pure integer function element_id(self, mesh, element) result(id)
      class(interface_group_type), intent(in) :: self
      type(mesh_type), intent(in) :: mesh
      integer, intent(in) :: element

      id = mesh%quad_id(element)
   end function element_id

end module plydyn_element_interface_group
