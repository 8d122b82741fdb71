!> Sizes of the files of fields, before the first state is written.
module plydyn_io_vtkhdf_field_size
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_delamination, only : interface_ply
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_model, only : model_type
   use plydyn_io_vtkhdf_components, only : field_components
   use plydyn_io_vtkhdf_plate_grid, only : cell_corners, cell_levels, layer_levels
   use plydyn_io_vtkhdf_interface_fields, only : interface_numbers
   use plydyn_io_vtkhdf_output_nodes, only : number_sites
   implicit none
   private

   public :: fields_bytes, interfaces_bytes

   !> Bytes in the file: of a field's value or a cell's number, of a point's position, of a corner
   !> or the offset of a cell, and of its kind
   real(wp), parameter :: value_bytes = 4.0_wp, position_bytes = 24.0_wp, index_bytes = 8.0_wp, &
      & kind_bytes = 1.0_wp
   !> Numbers of a cell that do not change: of a layer, of a brick and of an interface
   real(wp), parameter :: layer_numbers = 8.0_wp, brick_numbers = 6.0_wp, bond_numbers = 6.0_wp

contains

   !> Bytes of the file of fields
   real(wp) function fields_bytes(model, domain) result(bytes)
      !> The model
      type(model_type), intent(in) :: model
      !> The domain; its layers and step are known
      type(domain_type), intent(in) :: domain

      integer, allocatable :: levels(:)
      integer :: corners, values

      values = sum(field_components(model%request%fields))
      associate (mesh => model%mesh)
         if (size(domain%bricks) > 0) then
            bytes = file_bytes(sites_of(mesh%brick_part, mesh%brick_node, size(mesh%node_id)), &
               & values*states(model, domain), real(size(mesh%brick_id), wp), &
               & size(mesh%brick_node, 1), brick_numbers)
            return
         end if
         corners = size(mesh%quad_node, 1)
         levels = layer_levels(domain%layers%order, corners)
         bytes = file_bytes(sum(levels)*sites_of(mesh%quad_part, mesh%quad_node, &
            & size(mesh%node_id)), values*states(model, domain), &
            & real(size(mesh%quad_id), wp)*sum((levels - 1)/cell_levels(corners)), &
            & cell_corners(corners), layer_numbers)
      end associate
   end function fields_bytes

   !> Bytes of the file of interfaces, 0 if there is none
   real(wp) function interfaces_bytes(model, domain) result(bytes)
      !> The model
      type(model_type), intent(in) :: model
      !> The domain; its layers, interfaces and step are known
      type(domain_type), intent(in) :: domain

      logical :: is_there(maxval([0, domain%layers%ply]))
      real(wp) :: cells
      integer :: b, l

      bytes = 0.0_wp
      if (size(domain%interfaces) == 0) return
      is_there(:) = .false.
      cells = 0.0_wp
      associate (mesh => model%mesh)
         do b = 1, size(domain%interfaces)
            associate (batch => domain%interfaces(b))
               do l = 1, lanes
                  if (batch%lower(l) == 0) cycle
                  is_there(interface_ply(domain, batch, l)) = .true.
                  cells = cells + count(mesh%quad_part == batch%plate)
               end do
            end associate
         end do
         bytes = file_bytes(count(is_there)*sites_of(mesh%quad_part, mesh%quad_node, &
            & size(mesh%node_id)), interface_numbers*states(model, domain), cells, &
            & size(mesh%quad_node, 1), bond_numbers)
      end associate
   end function interfaces_bytes

   !> States of a run: at time zero, at the first step after each interval, and the last
   pure real(wp) function states(model, domain)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain

      !> Round-off of a number of steps or intervals
      real(wp), parameter :: slack = 1.0e-6_wp
      real(wp) :: before

      ! steps before the last
      before = aint(domain%control%end_time/domain%step - slack)
      if (domain%control%end_cycle > 0) before = min(before, domain%control%end_cycle - 1.0_wp)
      states = 2.0_wp + min(before, aint(before*domain%step/model%request%field_interval + slack))
   end function states

   !> Points of the plane, or of bricks: each part has its own
   real(wp) function sites_of(part, element_node, nodes) result(sites)
      !> As in `number_sites`
      integer, intent(in) :: part(:), element_node(:, :), nodes

      integer, allocatable :: node(:), site(:, :)

      call number_sites(part, element_node, nodes, site, node)
      sites = real(size(node), wp)
   end function sites_of

   !> Bytes of a file
   pure real(wp) function file_bytes(points, values, cells, corners, numbers) result(bytes)
      !> Points, and values of all states at each
      real(wp), intent(in) :: points, values
      !> Cells, the corners and the numbers of each
      real(wp), intent(in) :: cells, numbers
      integer, intent(in) :: corners

      bytes = points*(position_bytes + value_bytes*values) &
         & + cells*(index_bytes*(corners + 1) + kind_bytes + value_bytes*numbers)
   end function file_bytes

end module plydyn_io_vtkhdf_field_size
