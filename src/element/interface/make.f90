!> Interfaces between layers as batches.
module plydyn_element_interface_make
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_columns, only : columns_type
   use plydyn_element_interface_process_zones, only : new_process_zone, process_zone_type
   use plydyn_element_interface_interfaces, only : face_type, interface_type
   use plydyn_law_cohesive_bilinear, only : cohesive_type, new_cohesive, new_springs
   use plydyn_law_cohesive_constants, only : cohesive_constants_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: new_interfaces

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
         batch%upper(lane) = k + 1
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

end module plydyn_element_interface_make
