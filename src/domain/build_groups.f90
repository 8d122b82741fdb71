!> The element groups of a model, family by family, and the columns and chunks that they stand on.
module plydyn_domain_build_groups
   use plydyn_domain_decomposition, only : decomposition_type, divide_bricks, divide_plane
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_brick_bricks, only : bricks_type
   use plydyn_element_brick_group, only : new_brick_group
   use plydyn_element_brick_make, only : new_bricks
   use plydyn_element_cracked_group, only : new_cracked_group
   use plydyn_element_group, only : element_group_type, group_item_type
   use plydyn_element_interface_interfaces, only : interface_type
   use plydyn_element_interface_group, only : new_interface_group
   use plydyn_element_interface_make, only : new_interfaces
   use plydyn_element_plate_group, only : new_plate_group
   use plydyn_fem_columns, only : new_columns, new_solid_columns
   use plydyn_fem_expansion, only : new_expansion
   use plydyn_model_layup, only : faces_tied
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_group, build_groups

contains

   !> All groups of a model, still without elements. Those of a family that sets forces come before
   !> those that add to them
   subroutine build_groups(model, domain, division)
      type(model_type), intent(in) :: model
      !> Has its layers; gets groups and columns
      type(domain_type), intent(inout) :: domain
      !> The chunks of the whole model
      type(decomposition_type), intent(out) :: division

      allocate (domain%groups(0), domain%inertia%ties(0))
      if (size(model%mesh%brick_id) > 0) then
         call add_bricks(model, domain, division)
      else
         call add_plates(model, domain)
         call add_interfaces(model, domain)
         division = divide_plane(model%mesh, size(model%parts))
      end if
   end subroutine build_groups

   !> The layers of all parts, and their columns
   subroutine add_plates(model, domain)
      type(model_type), intent(in) :: model
      type(domain_type), intent(inout) :: domain

      class(element_group_type), allocatable :: group
      integer :: f, k, p, zone

      associate (layers => domain%layers)
         domain%columns = new_columns(size(model%mesh%node_id), layers%order)
         do f = 1, size(domain%columns%order_groups)
            domain%columns%order_groups(f)%expansion = &
               & new_expansion(domain%columns%order_groups(f)%order, &
               & layers%lobatto)
         end do
         domain%inertia%ties = pack([(k, k=1, size(layers%joint))], layers%joint == faces_tied)
         do k = 1, size(domain%inertia%ties)
            call domain%columns%tie(domain%inertia%ties(k))
         end do
      end associate
      do p = 1, size(model%parts)
         zone = model%crack_zone_of(p)
         if (zone > 0) then
            allocate (group, source=new_cracked_group(model, zone, size(domain%groups) + 1, &
               & domain%columns))
         else
            allocate (group, source=new_plate_group(model, p, size(domain%groups) + 1, &
               & domain%columns))
         end if
         call add_group(group, domain)
      end do
   end subroutine add_plates

   !> The interfaces of all parts
   subroutine add_interfaces(model, domain)
      type(model_type), intent(in) :: model
      type(domain_type), intent(inout) :: domain

      class(element_group_type), allocatable :: group
      type(interface_type), allocatable :: batches(:)
      integer :: k, p

      do p = 1, size(model%parts)
         batches = new_interfaces(model, p, domain%columns, domain%layers%joint)
         do k = 1, size(batches)
            allocate (group, source=new_interface_group(model, batches(k)))
            call add_group(group, domain)
         end do
      end do
   end subroutine add_interfaces

   !> The bricks of all parts, and their columns and chunks
   subroutine add_bricks(model, domain, division)
      type(model_type), intent(in) :: model
      type(domain_type), intent(inout) :: domain
      type(decomposition_type), intent(out) :: division

      type(bricks_type), allocatable :: bricks(:)
      class(element_group_type), allocatable :: group
      integer :: k

      domain%columns = new_solid_columns(size(model%mesh%node_id))
      bricks = new_bricks(model)
      do k = 1, size(bricks)
         allocate (group, source=new_brick_group(model, bricks(k), k))
         call add_group(group, domain)
      end do
      division = divide_bricks(model%mesh, bricks)
   end subroutine add_bricks

   !> Put a group at the end of the list
   subroutine add_group(group, domain)
      !> The group; moved
      class(element_group_type), allocatable, intent(inout) :: group
      !> Gets it
      type(domain_type), intent(inout) :: domain

      type(group_item_type), allocatable :: longer(:)
      integer :: g

      allocate (longer(size(domain%groups) + 1))
      do g = 1, size(domain%groups)
         call move_alloc(domain%groups(g)%item, longer(g)%item)
      end do
      call move_alloc(group, longer(size(longer))%item)
      call move_alloc(longer, domain%groups)
   end subroutine add_group

end module plydyn_domain_build_groups
