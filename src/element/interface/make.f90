!> Interfaces between layers as batches.
module plydyn_element_interface_make
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_columns, only : columns_type
   use plydyn_element_interface_process_zones, only : new_process_zone, process_zone_type
   use plydyn_element_interface_interfaces, only : face_type, interface_type
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type, cohesive_type, new_cohesive, &
      & new_springs
   use plydyn_element_quad, only : tensor_order
   use plydyn_model_crack_zone, only : corner_direction, crack_zone_type, sees_twin
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: new_interfaces, part_points

   !> Corners of a quad, and halves of each
   integer, parameter :: corners = 4, halves = 2

contains

   !> All interfaces of a part, still without quads. Those between layers side by side in a block
   !> stay in the lanes of their lower layers; those between layers of different order groups fill
   !> batches of their own
   pure function new_interfaces(model, p, columns, joint) result(batches)
      !> The model, index of the part, and where the points lie
      type(model_type), intent(in) :: model
      integer, intent(in) :: p
      type(columns_type), intent(in) :: columns
      !> Index of the interface material between each layer and the next; 0 or less for none
      integer, intent(in) :: joint(:)
      type(interface_type), allocatable :: batches(:)

      logical :: here(size(joint))
      integer :: b, f, k, m

      allocate (batches(0))
      do m = 1, size(model%interface_materials)
         do f = 1, size(columns%order_groups)
            do b = 1, columns%order_groups(f)%blocks
               here(:) = [(joint(k) == m .and. all(columns%layer_slot(1:2, k) == [f, b]) &
                  & .and. columns%layer_slot(1, k + 1) == f, k=1, size(joint))]
               call add_batch(model, p, columns, here, m, batches)
            end do
         end do
         here(:) = [(joint(k) == m .and. columns%layer_slot(1, k) /= columns%layer_slot(1, k + 1), &
            & k=1, size(joint))]
         do while (any(here))
            call add_batch(model, p, columns, here, m, batches)
         end do
      end do
   end function new_interfaces

   !> A batch of some interfaces of one material
   pure subroutine add_batch(model, p, columns, here, material, batches)
      type(model_type), intent(in) :: model
      integer, intent(in) :: p
      type(columns_type), intent(in) :: columns
      !> Which interfaces; those that found a lane are taken out
      logical, intent(inout) :: here(:)
      !> Index of the interface material
      integer, intent(in) :: material
      type(interface_type), allocatable, intent(inout) :: batches(:)

      type(interface_type) :: batch
      integer :: k, lane

      if (.not. any(here)) return
      k = maxloc(merge(1, 0, here), 1)
      batch%law = interface_law(model, material)
      batch%adjacent = columns%layer_slot(1, k) == columns%layer_slot(1, k + 1)
      batch%plate = p
      batch%material = material
      batch%side = nint(sqrt(real(size(model%mesh%quad_node, 1), wp)))
      batch%nodal = model%interface_materials(material)%nodal
      lane = 0
      do k = 1, size(here)
         if (.not. here(k)) cycle
         lane = lane + 1
         if (batch%adjacent) lane = columns%layer_slot(3, k)
         if (lane > lanes) exit
         here(k) = .false.
         batch%lower(lane) = k
         batch%present(lane) = 1.0_wp
         call place_face(columns, k, columns%levels(k), lane, batch%adjacent, batch%below)
         call place_face(columns, k + 1, 1, lane, batch%adjacent, batch%above)
      end do
      batches = [batches, batch]
   end subroutine add_batch

   !> Where a face of a layer lies
   pure subroutine place_face(columns, layer, level, lane, adjacent, face)
      type(columns_type), intent(in) :: columns
      !> Layer and thickness node in it, both from the bottom up
      integer, intent(in) :: layer, level
      !> Lane of the interface
      integer, intent(in) :: lane
      !> Whether all lanes follow from this one
      logical, intent(in) :: adjacent
      type(face_type), intent(inout) :: face

      integer :: l

      do l = merge(1, lane, adjacent), merge(lanes, lane, adjacent)
         face%first(l) = columns%freedom(layer, level, 1, 1) + (l - lane)
         face%stride(l) = columns%freedom(layer, level, 2, 1) - columns%freedom(layer, level, 1, 1)
         face%step(l) = columns%freedom(layer, level, 1, 2) - columns%freedom(layer, level, 1, 1)
      end do
   end subroutine place_face

   !> The law of an interface material
   pure function interface_law(model, material) result(law)
      !> The model
      type(model_type), intent(in) :: model
      !> Index of the interface material
      integer, intent(in) :: material
      type(cohesive_type) :: law

      type(cohesive_constants_type) :: constants
      type(process_zone_type) :: zone

      constants = model%interface_materials(material)%constants
      if (.not. model%interface_materials(material)%fails) then
         law = new_springs(constants%stiffness)
         return
      end if
      zone = new_process_zone(model, material)
      constants%strength(:) = zone%strength
      law = new_cohesive(constants)
   end function interface_law

   !> Give each corner of the quads in a crack zone two points of half its area, one for each of its
   !> halves beside an edge, each at the columns that the plies have there: both faces at a node may
   !> be parted, each by the cracks of its own ply
   pure subroutine part_points(mesh, zone, ply, local_node, self)
      !> The mesh and a crack zone
      type(mesh_type), intent(in) :: mesh
      type(crack_zone_type), intent(in) :: zone
      !> Ply below each lane, 0 where there is no interface; the rank's number of each node
      integer, intent(in) :: ply(lanes), local_node(:)
      !> Has its quads
      type(interface_type), intent(inout) :: self

      real(wp), allocatable :: metric(:, :, :), weakness(:, :, :)
      integer :: c, e, f, h, l, node(corners), q
      integer, allocatable :: nodes(:, :)

      allocate (nodes(halves*corners, size(self%quad)), metric(5, halves*corners, size(self%quad)))
      do h = 1, halves
         associate (first => corners*(h - 1) + 1, last => corners*h)
            nodes(first:last, :) = self%node
            metric(:, first:last, :) = self%metric
         end associate
      end do
      metric(5, :, :) = metric(5, :, :)/real(halves, wp)
      call move_alloc(metric, self%metric)
      call move_alloc(nodes, self%node)
      self%target = self%node
      self%twin = self%node
      if (allocated(self%weakness)) then
         weakness = reshape([((self%weakness(:, :, e), h=1, halves), e=1, size(self%quad))], &
            & [lanes, halves*corners, size(self%quad)])
         call move_alloc(weakness, self%weakness)
      end if
      allocate (self%sees(lanes, halves*corners, 2, size(self%quad)), source=0.0_wp)
      do e = 1, size(self%quad)
         node(:) = mesh%quad_node(tensor_order(2), self%quad(e))
         do h = 1, halves
            do c = 1, corners
               if (mesh%twin(node(c)) == 0) cycle
               q = c + corners*(h - 1)
               self%twin(q, e) = local_node(mesh%twin(node(c)))
               do f = 1, 2
                  do l = 1, lanes
                     if (ply(l) == 0) cycle
                     if (sees_twin(zone, ply(l) + f - 1, node(c), corner_direction(zone%edge, c, &
                        & h))) self%sees(l, q, f, e) = 1.0_wp
                  end do
               end do
            end do
         end do
      end do
      self%twin_target = self%twin
   end subroutine part_points

end module plydyn_element_interface_make
