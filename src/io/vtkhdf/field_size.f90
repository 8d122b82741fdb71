!> Sizes of the files of fields, before the first state is written.
module plydyn_io_vtkhdf_field_size
   use plydyn_base_precision, only : wp
   use plydyn_domain_delamination, only : present_interfaces
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_output_group, only : cell_type
   use plydyn_model_model, only : model_type
   use plydyn_io_vtkhdf_components, only : field_components
   use plydyn_io_vtkhdf_element_grid, only : cells_of_sheet, field_group
   use plydyn_io_vtkhdf_interface_fields, only : interface_numbers
   use plydyn_io_vtkhdf_output_nodes, only : number_sites
   implicit none
   private

   public :: fields_bytes, interfaces_bytes

   !> Bytes in the file: of a field's value or a cell's number, of a point's position, of a corner
   !> or the offset of a cell, and of its kind
   real(wp), parameter :: value_bytes = 4.0_wp, position_bytes = 24.0_wp, index_bytes = 8.0_wp, &
      & kind_bytes = 1.0_wp
   !> Numbers of a cell that do not change: of a layer, of another element and of an
   !> interface
   real(wp), parameter :: layer_numbers = 8.0_wp, cell_numbers = 6.0_wp, bond_numbers = 6.0_wp

contains

   !> Bytes of the file of fields
   real(wp) function fields_bytes(model, domain) result(bytes)
      !> The model
      type(model_type), intent(in) :: model
      !> The domain; its layers and step are known
      type(domain_type), intent(in) :: domain

      type(cell_type) :: cell
      integer, allocatable :: levels(:), node(:, :), part(:)
      integer :: k

      bytes = 0.0_wp
      if (field_group(domain) == 0) return
      associate (group => domain%groups(field_group(domain))%item)
         cell = group%find_cell()
         levels = [(group%sheet_levels(k), k=1, group%sheets())]
         call group%list_elements(model%mesh, part, node)
      end associate
      bytes = file_bytes(sum(levels)*sites_of(part, node, size(model%mesh%node_id)), &
         & sum(field_components(model%request%fields))*states(model, domain), &
         & real(size(part), wp)*sum(cells_of_sheet(levels, cell%span)), size(cell%corner, 2), &
         & merge(layer_numbers, cell_numbers, all(levels > 1)))
   end function fields_bytes

   !> Bytes of the file of interfaces, 0 if there is none
   real(wp) function interfaces_bytes(model, domain) result(bytes)
      !> The model
      type(model_type), intent(in) :: model
      !> The domain; its layers, interfaces and step are known
      type(domain_type), intent(in) :: domain

      real(wp) :: interfaces

      interfaces = real(size(present_interfaces(domain)), wp)
      bytes = 0.0_wp
      if (interfaces <= 0.0_wp) return
      associate (mesh => model%mesh)
         bytes = file_bytes(interfaces*sites_of(mesh%quad_part, mesh%quad_node, &
            & size(mesh%node_id)), interface_numbers*states(model, domain), &
            & interfaces*size(mesh%quad_id), size(mesh%quad_node, 1), bond_numbers)
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
