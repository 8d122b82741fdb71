!> The elements of one family as cells for pictures: every sheet of every part with points of its
!> own, so that values jump between layers and between parts, and are continuous within them.
!>
!> Points lie level by level, in each the output nodes. Cells lie sheet by sheet from the bottom up,
!> in each the elements of the deck. A rank writes a band of output nodes and a band of cells,
!> whichever elements it has.
module plydyn_io_vtkhdf_element_grid
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_group, only : cell_type
   use plydyn_model_layers, only : layers_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_io_vtkhdf_output_nodes, only : accumulators_type, new_accumulators, number_nodes
   use plydyn_io_vtkhdf_vtkhdf, only : hyperslab_type, piece_type
   use plydyn_parallel_owner_reduction, only : band_start
   implicit none
   private

   public :: accumulators_of_kind, band_of_rows, cells_of_sheet, field_group, new_grid

   !> What a rank has of points and cells
   type, public :: grid_type
      !> First group of the family, which stands for all; 0 where none has cells
      integer :: group = 0
      !> Levels of points in each sheet, and those below it
      integer, allocatable :: levels(:), below(:)
      !> Part of each element of the family in the mesh
      integer, allocatable :: part(:)
      !> Output nodes of the elements of this rank, nodes in the order of the group
      type(accumulators_type) :: accumulators
      !> Sheet, and element of the mesh, of each cell that it writes
      integer, allocatable :: sheet(:), element(:)
   contains
      procedure :: has_layers
   end type grid_type

contains

   !> Divide every sheet over every element into cells
   subroutine new_grid(mesh, domain, self, piece)
      !> The mesh of the whole model
      type(mesh_type), intent(in) :: mesh
      !> The domain of this rank
      type(domain_type), intent(in) :: domain
      !> What this rank has
      type(grid_type), intent(out) :: self
      !> What it writes
      type(piece_type), intent(out) :: piece

      type(cell_type) :: cell
      integer, allocatable :: element_node(:, :), node(:), output_node(:, :)
      integer :: k

      self%group = field_group(domain)
      if (self%group == 0) return
      associate (group => domain%groups(self%group)%item)
         cell = group%cell
         self%levels = cell%levels
         call mesh%list_elements(group%element_kind, self%part, element_node)
      end associate
      self%below = [(sum(self%levels(:k - 1)), k=1, size(self%levels))]
      call number_nodes(self%part, element_node, size(mesh%node_id), output_node, node)
      self%accumulators = accumulators_of_kind(domain, self%group, output_node, sum(self%levels))
      piece%points = self%accumulators%points()
      call place_points(domain%layers, mesh%position(:, node(piece%points%first + 1: &
         & piece%points%first + piece%points%count)), self, piece)
      call make_cells(domain, cell, output_node, self, piece)
   end subroutine new_grid

   !> First group that has cells, 0 for none
   pure integer function field_group(domain) result(group)
      type(domain_type), intent(in) :: domain

      do group = 1, size(domain%groups)
         if (allocated(domain%groups(group)%item%cell%levels)) return
      end do
      group = 0
   end function field_group

   !> Accumulators of the elements of one kind, nodes in the order of the group
   function accumulators_of_kind(domain, first, output_node, levels) result(self)
      type(domain_type), intent(in) :: domain
      !> First group of the kind
      integer, intent(in) :: first
      !> Output nodes of all elements of the model, and levels of points above an output node
      integer, intent(in) :: output_node(:, :), levels
      type(accumulators_type) :: self

      real(wp), allocatable :: weight(:)
      integer, allocatable :: element(:, :), node(:)
      integer :: i

      element = elements_of_kind(domain, first)
      self = new_accumulators(domain%comm, output_node, [(domain%groups(element(1, i))%item &
         & %element(element(2, i)), i=1, size(element, 2))], levels)
      self%place(:, :) = self%place(domain%groups(first)%item%cell%node_order, :)
      allocate (self%weight(size(self%place, 1), size(self%place, 2)), self%node(self%count))
      do i = 1, size(element, 2)
         call domain%groups(element(1, i))%item%find_nodes(element(2, i), domain%position, node, &
            & weight)
         self%node(self%place(:, i)) = node
         self%weight(:, i) = weight
      end do
      call move_alloc(element, self%element)
   end function accumulators_of_kind

   !> Group and number in it of all elements of one kind, in the order of the mesh, (2, elements)
   pure function elements_of_kind(domain, first) result(place)
      type(domain_type), intent(in) :: domain
      !> First group of the kind: others with cells alike follow
      integer, intent(in) :: first
      integer, allocatable :: place(:, :)

      integer :: e, g
      integer, allocatable :: element(:)

      allocate (element(0), place(2, 0))
      do g = first, size(domain%groups)
         associate (group => domain%groups(g)%item)
            if (.not. allocated(group%cell%levels)) cycle
            if (group%element_kind /= domain%groups(first)%item%element_kind) cycle
            element = [element, group%element]
            place = reshape([place, [([g, e], e=1, size(group%element))]], [2, size(element)])
         end associate
      end do
      place(:, :) = place(:, sorted_order(element))
   end function elements_of_kind

   !> Whether sheets are layers with a thickness
   pure logical function has_layers(self)
      class(grid_type), intent(in) :: self

      has_layers = all(self%levels > 1)
   end function has_layers

   !> Cells of a sheet above an element
   elemental integer function cells_of_sheet(levels, span) result(cells)
      !> Levels of the sheet, and of a cell
      integer, intent(in) :: levels, span

      cells = 1
      if (span > 0) cells = (levels - 1)/span
   end function cells_of_sheet

   !> Rows of a list that a rank writes
   pure type(hyperslab_type) function band_of_rows(domain, rows) result(band)
      !> The domain, with the rank
      type(domain_type), intent(in) :: domain
      !> Rows of the list
      integer, intent(in) :: rows

      associate (comm => domain%comm)
         band%whole = rows
         band%first = band_start(rows, comm%rank, comm%ranks)
         band%count = band_start(rows, comm%rank + 1, comm%ranks) - band%first
      end associate
   end function band_of_rows

   !> Positions of the points that this rank writes
   pure subroutine place_points(layers, position, self, piece)
      type(layers_type), intent(in) :: layers
      !> Positions of its output nodes, (3, output nodes)
      real(wp), intent(in) :: position(:, :)
      type(grid_type), intent(in) :: self
      type(piece_type), intent(inout) :: piece

      integer :: i, k, t
      real(wp) :: part

      allocate (piece%position(3, self%accumulators%own_points()))
      i = 0
      associate (nodes => size(position, 2))
         do k = 1, size(self%levels)
            do t = 1, self%levels(k)
               piece%position(:, i + 1:i + nodes) = position
               if (self%levels(k) > 1) then
                  part = real(t - 1, wp)/real(self%levels(k) - 1, wp)
                  piece%position(3, i + 1:i + nodes) = position(3, :) &
                     & + (1.0_wp - part)*layers%bottom(k) + part*layers%top(k)
               end if
               i = i + nodes
            end do
         end do
      end associate
   end subroutine place_points

   !> The cells that this rank writes
   pure subroutine make_cells(domain, cell, output_node, self, piece)
      type(domain_type), intent(in) :: domain
      type(cell_type), intent(in) :: cell
      !> Output nodes of all elements
      integer, intent(in) :: output_node(:, :)
      type(grid_type), intent(inout) :: self
      type(piece_type), intent(inout) :: piece

      integer :: corners, i, k, n
      integer, allocatable :: level(:), sheet(:)

      corners = size(cell%corner, 2)
      ! sheet of each row of cells, and the levels of all sheets below it
      sheet = [(spread(k, 1, cells_of_sheet(self%levels(k), cell%span)), k=1, size(self%levels))]
      level = [([(self%below(k) + cell%span*(i - 1), &
         & i=1, cells_of_sheet(self%levels(k), cell%span))], k=1, size(self%levels))]
      piece%cells = band_of_rows(domain, size(sheet)*size(output_node, 2))
      piece%kind = cell%kind
      associate (cells => piece%cells)
         allocate (piece%connectivity(corners, cells%count), self%sheet(cells%count), &
            & self%element(cells%count))
         do i = 1, cells%count
            k = (cells%first + i - 1)/size(output_node, 2) + 1
            self%sheet(i) = sheet(k)
            self%element(i) = cells%first + i - size(output_node, 2)*(k - 1)
            do n = 1, corners
               piece%connectivity(n, i) = output_node(cell%corner(1, n), self%element(i)) &
                  & + self%accumulators%nodes*(level(k) + cell%corner(2, n)) - 1
            end do
         end do
      end associate
   end subroutine make_cells

end module plydyn_io_vtkhdf_element_grid
