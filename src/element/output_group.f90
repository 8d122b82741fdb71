!> What a group of elements gives to field output: cells, nodes, motion and recovered values.
!>
!> Points of the output lie in sheets above the nodes of a part: one for each numerical layer of a
!> plate, one with a single level for elements whose nodes are points. A family without cells keeps
!> all defaults.
module plydyn_element_output_group
   use plydyn_base_precision, only : wp
   use plydyn_element_recovered, only : recovered
   use plydyn_fem_columns, only : columns_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   !> Elements as cells
   type, public, abstract :: output_group_type
   contains
      procedure :: sheets
      procedure :: sheet_levels
      procedure :: find_cell
      procedure :: list_elements
      procedure :: element_nodes
      procedure :: node_weights
      procedure :: sheet_motion
      procedure :: output_values
      procedure :: find_place
      procedure :: profile
      procedure :: fibre_angle
   end type output_group_type

   !> A cell of a family
   type, public :: cell_type
      !> VTK's kind of cell
      integer :: kind = 0
      !> Node in the order of the deck, and level above the lowest of the cell, of each corner in
      !> VTK's order, (2, corners)
      integer, allocatable :: corner(:, :)
      !> Levels from the bottom of a cell to its top; 0 where a sheet has one level
      integer :: span = 0
      !> The group's order of the nodes, as places in that of the deck
      integer, allocatable :: node_order(:)
   end type cell_type

contains

   !> Sheets of points; 0 where the family has no cells
   pure integer function sheets(self)
      class(output_group_type), intent(in) :: self

      sheets = 0
   end function sheets

   !> Levels of points in a sheet
   pure integer function sheet_levels(self, sheet) result(levels)
      class(output_group_type), intent(in) :: self
      !> The sheet, from the bottom up
      integer, intent(in) :: sheet

      levels = 1
   end function sheet_levels

   !> The family's cell
   pure function find_cell(self) result(cell)
      class(output_group_type), intent(in) :: self
      type(cell_type) :: cell
   end function find_cell

   !> All elements of the family in the mesh: part, and nodes in the order of the deck
   pure subroutine list_elements(self, mesh, part, node)
      class(output_group_type), intent(in) :: self
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Part of each element
      integer, allocatable, intent(out) :: part(:)
      !> Nodes, (nodes of an element, elements)
      integer, allocatable, intent(out) :: node(:, :)

      allocate (part(0), node(0, 0))
   end subroutine list_elements

   !> The rank's numbers of the nodes of an element, in the group's order
   pure function element_nodes(self, element) result(node)
      class(output_group_type), intent(in) :: self
      !> Number among those of the group
      integer, intent(in) :: element
      integer, allocatable :: node(:)

      allocate (node(0))
   end function element_nodes

   !> Weights of the values of an element at its nodes in the mean over elements
   pure function node_weights(self, element, position) result(weight)
      class(output_group_type), intent(in) :: self
      !> Number among those of the group
      integer, intent(in) :: element
      !> Positions of its nodes, (3, nodes)
      real(wp), intent(in) :: position(:, :)
      real(wp) :: weight(size(position, 2))

      weight(:) = 1.0_wp
   end function node_weights

   !> Displacement or velocity at some nodes at all levels of a sheet, (3, levels, nodes)
   pure function sheet_motion(self, columns, sheet, node, motion) result(values)
      class(output_group_type), intent(in) :: self
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      !> The sheet, and the rank's numbers of the nodes
      integer, intent(in) :: sheet, node(:)
      !> Displacement or velocity of all points
      real(wp), intent(in), contiguous :: motion(:)
      real(wp), allocatable :: values(:, :, :)
      integer :: c

      allocate (values(3, 1, size(node)))
      do c = 1, 3
         values(c, 1, :) = motion(columns%freedom(1, 1, c, node))
      end do
   end function sheet_motion

   !> Strain, stress and scalars of an element at its nodes at all levels of a sheet,
   !> (`recovered`, levels, nodes)
   pure function output_values(self, place, has_tensors, displacement, history) result(values)
      class(output_group_type), intent(in) :: self
      !> Number of the element among those of the group, and sheet
      integer, intent(in) :: place(2)
      !> Whether strain or stress is requested, which take longer than scalars
      logical, intent(in) :: has_tensors
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      real(wp), allocatable :: values(:, :, :)

      allocate (values(recovered, 1, 0))
   end function output_values

   !> Local coordinates of a place of the plane in an element that contains it; families without
   !> profiles find none
   pure subroutine find_place(self, corner, position, local, found)
      class(output_group_type), intent(in) :: self
      !> Positions of the nodes in the group's order, (2, nodes), and the place
      real(wp), intent(in) :: corner(:, :), position(2)
      !> Local coordinates
      real(wp), intent(out) :: local(2)
      !> Whether the place is in the element
      logical, intent(out) :: found

      local(:) = 0.0_wp
      found = .false.
   end subroutine find_place

   !> Displacement, strain, stress and scalars at heights of a sheet over a place of an element,
   !> (3 + `recovered`, heights)
   pure function profile(self, columns, place, local, height, displacement, history) result(values)
      class(output_group_type), intent(in) :: self
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      !> Number of the element among those of the group, and sheet
      integer, intent(in) :: place(2)
      !> Local coordinates of the place; heights in the sheet, from -1 to 1
      real(wp), intent(in) :: local(2), height(:)
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      real(wp) :: values(3 + recovered, size(height))

      values(:, :) = 0.0_wp
   end function profile

   !> Fibre direction of an element in a sheet, degrees from the x axis
   pure real(wp) function fibre_angle(self, model, element, ply) result(angle)
      class(output_group_type), intent(in) :: self
      !> The model
      type(model_type), intent(in) :: model
      !> Index in the mesh, and ply from the bottom
      integer, intent(in) :: element, ply

      angle = 0.0_wp
   end function fibre_angle

end module plydyn_element_output_group
