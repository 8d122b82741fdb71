!> Element group of interfaces between layers: a batch of one material over the quads of a part.
module plydyn_element_interface_group
   use plydyn_base_exact_sum, only : exact_sums_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_group, only : element_group_type, losses, spring_type
   use plydyn_element_interface_interfaces, only : interface_type, set_damage, set_plane, sum_lanes
   use plydyn_element_interface_kernel, only : add_face_forces, add_interface_energy
   use plydyn_element_interface_make, only : part_points
   use plydyn_element_interface_process_zones, only : find_weakness
   use plydyn_fem_columns, only : columns_type
   use plydyn_fem_quadrature, only : quad_points
   use plydyn_law_cohesive_bilinear, only : cohesive_type
   use plydyn_law_cohesive_softening, only : damage_at, delaminated_share, normal, share_at, shear
   use plydyn_model_control, only : total_lagrangian
   use plydyn_model_layup, only : initial_damage_type
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_mesh, only : a_quad, mesh_type
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
      !> Index of the crack zone, 0 for none
      integer :: zone = 0
   contains
      procedure :: take_elements, set_targets, set_history, start_history
      procedure :: add_forces, add_stored_energy, add_losses
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
      integer :: l, points

      self%set = batch%plate
      self%part = batch%plate
      self%large = model%control%kinematics == total_lagrangian
      self%element_kind = a_quad
      self%layer_kind = "interface"
      self%batch = batch
      self%zone = model%crack_zone_of(batch%plate)
      ! what cracks part, meets at nodes, in two points at each
      if (self%zone > 0) self%batch%nodal = .true.
      points = batch%side**2*merge(2, 1, self%zone > 0)
      self%work = interface_work*points
      self%history_shape = reshape([lanes*points, batch%law%histories, 0], [3, 1])
      layers = new_layers(model%parts(1))
      allocate (self%springs(0))
      do l = 1, lanes
         if (batch%lower(l) == 0) cycle
         self%ply(l) = layers%ply(batch%lower(l))
         self%springs = [self%springs, spring_type(batch%lower(l), stiffness_along(batch%law, &
            & self%large), batch%law%histories > 0)]
      end do
   end function new_interface_group

   !> Stiffness along x, y, z; with large displacement springs turn: then the stiffer one stands for
   !> all directions
   pure function stiffness_along(law, large) result(stiffness)
      type(cohesive_type), intent(in) :: law
      !> Large displacement
      logical, intent(in) :: large
      real(wp) :: stiffness(3)

      stiffness(:) = law%stiffness([shear, shear, normal])
      if (large) stiffness(:) = maxval(law%stiffness)
   end function stiffness_along

   subroutine take_elements(self, model, elements, local_node, columns)
      class(interface_group_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      integer, intent(in) :: elements(:), local_node(:)
      type(columns_type), intent(in) :: columns

      self%element = elements
      call set_plane(self%batch, model%mesh, elements, local_node)
      if (self%batch%law%histories > 0) call find_weakness(model, self%batch%material, elements, &
         & self%ply, self%batch%weakness)
      if (self%zone > 0) call part_points(model%mesh, model%crack_zones(self%zone), self%ply, &
         & local_node, self%batch)
      self%memory(:) = [size(self%batch%metric), size(self%batch%node) + size(self%batch%target)]
      if (allocated(self%batch%weakness)) then
         self%memory(1) = self%memory(1) + size(self%batch%weakness)
      end if
   end subroutine take_elements

   pure subroutine set_targets(self, elements, height, column)
      class(interface_group_type), intent(inout) :: self
      integer, intent(in) :: elements(2), height, column(:)
      integer :: e

      do e = elements(1), elements(2)
         self%batch%target(:, e) = column(self%batch%node(:, e))
         if (self%zone > 0) self%batch%twin_target(:, e) = column(self%batch%twin(:, e))
      end do
   end subroutine set_targets

   pure subroutine set_history(self, first)
      class(interface_group_type), intent(inout) :: self
      integer, intent(in) :: first(:)

      self%batch%first_history = first(1)
   end subroutine set_history

   pure subroutine start_history(self, model, history)
      class(interface_group_type), intent(in) :: self
      type(model_type), intent(in) :: model
      real(wp), intent(inout), contiguous :: history(:)
      integer :: i

      if (self%batch%law%histories == 0) return
      do i = 1, size(model%initial_damages)
         if (model%initial_damages(i)%part /= self%part) cycle
         call begin_damaged(self, model%mesh, model%initial_damages(i), history)
      end do
   end subroutine start_history

   !> Begin with damage that the deck asks for
   pure subroutine begin_damaged(self, mesh, initial, history)
      type(interface_group_type), intent(in) :: self
      type(mesh_type), intent(in) :: mesh
      type(initial_damage_type), intent(in) :: initial
      real(wp), intent(inout), contiguous :: history(:)
      integer :: l

      associate (batch => self%batch)
         do l = 1, lanes
            if (self%ply(l) == 0) cycle
            if (self%ply(l) < initial%interfaces(1) .or. self%ply(l) > initial%interfaces(2)) cycle
            call set_damage(batch, l, chosen_points(mesh, batch, initial), initial%damage, &
               & history(batch%first_history:))
         end do
      end associate
   end subroutine begin_damaged

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

   pure subroutine add_stored_energy(self, elements, displacement, history, sums)
      class(interface_group_type), intent(in) :: self
      integer, intent(in) :: elements(2)
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      type(exact_sums_type), intent(inout) :: sums

      call add_interface_energy(self%batch, elements, self%large, displacement, &
         & history(self%batch%first_history:), sums)
   end subroutine add_stored_energy

   pure subroutine add_losses(self, history, sums, areas)
      class(interface_group_type), intent(in) :: self
      real(wp), intent(in), contiguous :: history(:)
      type(exact_sums_type), intent(inout), optional :: sums
      real(wp), allocatable, intent(inout), optional :: areas(:, :, :)

      if (self%batch%law%histories == 0) return
      associate (own => history(self%batch%first_history:))
         if (present(sums)) call add_batch_losses(self, own, sums)
         if (.not. present(areas)) return
         if (.not. allocated(areas)) then
            allocate (areas(2, size(self%batch%node, 1), size(self%batch%node, 2)), source=0.0_wp)
         end if
         call mark_points(self%batch, own, areas)
      end associate
   end subroutine add_losses

   !> Add the losses of a batch of interfaces, quad by quad
   pure subroutine add_batch_losses(self, history, sums)
      type(interface_group_type), intent(in) :: self
      real(wp), intent(in) :: history(lanes, size(self%batch%node, 1), size(self%batch%node, 2), &
         & self%batch%law%histories)
      type(exact_sums_type), intent(inout) :: sums

      real(wp) :: part(lanes, losses)
      integer :: e, i, l

      do e = 1, size(self%batch%node, 2)
         part(:, :) = sum_lanes(self%batch, e, history)
         do l = 1, lanes
            if (self%ply(l) == 0) cycle
            do i = 1, losses
               call sums%add(losses*(self%ply(l) - 1) + i, part(l, i))
            end do
         end do
      end do
   end subroutine add_batch_losses

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

end module plydyn_element_interface_group
