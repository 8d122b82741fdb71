!> The plate as cells for pictures: every layer of every part with points of its own, so that values
!> jump between layers and between parts, and are continuous within them.
!>
!> Points lie level by level, in each the sites of the plane. Cells lie layer by layer from the
!> bottom up, in each the quads of the deck. A rank writes a band of sites and a band of cells,
!> whichever quads it has.
module plydyn_io_vtkhdf_plate_grid
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_quad, only : tensor_order
   use plydyn_model_mesh, only : mesh_type
   use plydyn_io_vtkhdf_output_nodes, only : new_accumulators, number_sites, accumulators_type
   use plydyn_io_vtkhdf_vtkhdf, only : piece_type, hyperslab_type
   use plydyn_parallel_owner_reduction, only : band_start
   implicit none
   private

   public :: band_of_rows, cell_corners, cell_levels, layer_levels, new_grid, plate_quads

   !> VTK's cells: 8 nodes, and 27 nodes
   integer, parameter :: linear_cell = 12, quadratic_cell = 29

   !> Place of each of the 27 nodes of a quadratic cell: node of the quad and level, 1 to 3
   integer, parameter :: quad_place(27) = [1, 2, 3, 4, 1, 2, 3, 4, 5, 6, 7, 8, 5, 6, 7, 8, &
      & 1, 2, 3, 4, 8, 6, 5, 7, 9, 9, 9]
   integer, parameter :: level_place(27) = [1, 1, 1, 1, 3, 3, 3, 3, 1, 1, 1, 1, 3, 3, 3, 3, &
      & 2, 2, 2, 2, 2, 2, 2, 2, 1, 3, 2]

   !> What a rank has of points and cells
   type, public :: grid_type
      !> Levels of points in each layer, and those below it
      integer, allocatable :: levels(:), below(:)
      !> Sites of its quads, nodes in tensor order
      type(accumulators_type) :: slots
      !> Plate and quad of the plate of each of its quads, (2, quads), as the slots have them
      integer, allocatable :: home(:, :)
      !> Layer, and quad of the mesh, of each cell that it writes
      integer, allocatable :: layer(:), quad(:)
   end type grid_type

contains

   !> Divide every layer over every quad into cells: one, or two if its order is above 2
   subroutine new_grid(mesh, domain, self, piece)
      !> The mesh of the whole model
      type(mesh_type), intent(in) :: mesh
      !> The domain of this rank
      type(domain_type), intent(in) :: domain
      !> What this rank has
      type(grid_type), intent(out) :: self
      !> What it writes
      type(piece_type), intent(out) :: piece

      integer, allocatable :: node(:), site(:, :)
      integer :: k

      self%levels = layer_levels(domain%layers%order, size(mesh%quad_node, 1))
      self%below = [(sum(self%levels(:k - 1)), k=1, size(self%levels))]
      call number_sites(mesh%quad_part, mesh%quad_node, size(mesh%node_id), site, node)
      self%home = plate_quads(domain)
      self%slots = new_accumulators(domain%comm, site, [(domain%plates(self%home(1, k))%quad( &
         & self%home(2, k)), k=1, size(self%home, 2))], sum(self%levels))
      self%slots%slot(:, :) = self%slots%slot(tensor_order(domain%plates(1)%side), :)
      piece%points = self%slots%points()
      call place_points(domain, mesh%position(:, node(piece%points%first + 1:piece%points%first &
         & + piece%points%count)), self, piece)
      call make_cells(domain, site, self, piece)
   end subroutine new_grid

   !> Levels of points in a layer: those of one quadratic cell or of two, or of a linear cell for
   !> each order
   elemental integer function layer_levels(order, nodes) result(levels)
      !> Order of the layer, and nodes of its quads
      integer, intent(in) :: order, nodes

      levels = order + 1
      if (nodes == 9) levels = merge(3, 5, order <= 2)
   end function layer_levels

   !> Levels from the bottom of a cell to its top
   pure integer function cell_levels(nodes) result(levels)
      !> Nodes of its quad
      integer, intent(in) :: nodes

      levels = merge(2, 1, nodes == 9)
   end function cell_levels

   !> Points of a cell
   pure integer function cell_corners(nodes) result(corners)
      !> Nodes of its quad
      integer, intent(in) :: nodes

      corners = merge(27, 8, nodes == 9)
   end function cell_corners

   !> Plate and quad of all quads of a domain, in the order of the mesh, (2, quads)
   pure function plate_quads(domain) result(home)
      !> The domain
      type(domain_type), intent(in) :: domain
      integer, allocatable :: home(:, :)

      integer :: e, p
      integer, allocatable :: quad(:)

      home = reshape([(([p, e], e=1, size(domain%plates(p)%quad)), p=1, size(domain%plates))], &
         & [2, sum([(size(domain%plates(p)%quad), p=1, size(domain%plates))])])
      quad = [(domain%plates(p)%quad, p=1, size(domain%plates))]
      home(:, :) = home(:, sorted_order(quad))
   end function plate_quads

   !> Rows of a list that a rank writes
   pure type(hyperslab_type) function band_of_rows(domain, rows) result(band)
      !> The domain, which knows the rank
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
   pure subroutine place_points(domain, position, self, piece)
      type(domain_type), intent(in) :: domain
      !> Positions of the nodes of its sites, (3, sites)
      real(wp), intent(in) :: position(:, :)
      type(grid_type), intent(in) :: self
      type(piece_type), intent(inout) :: piece

      integer :: i, k, t
      real(wp) :: part

      allocate (piece%position(3, self%slots%own_points()))
      i = 0
      associate (layers => domain%layers, sites => size(position, 2))
         do k = 1, size(self%levels)
            do t = 1, self%levels(k)
               part = real(t - 1, wp)/real(self%levels(k) - 1, wp)
               piece%position(:, i + 1:i + sites) = position
               piece%position(3, i + 1:i + sites) = position(3, :) &
                  & + (1.0_wp - part)*layers%bottom(k) + part*layers%top(k)
               i = i + sites
            end do
         end do
      end associate
   end subroutine place_points

   !> The cells that this rank writes
   pure subroutine make_cells(domain, site, self, piece)
      type(domain_type), intent(in) :: domain
      !> Sites of all quads
      integer, intent(in) :: site(:, :)
      type(grid_type), intent(inout) :: self
      type(piece_type), intent(inout) :: piece

      integer :: corners, i, k, span
      integer, allocatable :: layer(:), level(:)

      span = cell_levels(size(site, 1))
      corners = cell_corners(size(site, 1))
      ! layer of each sheet of cells, and the levels of all layers below it
      layer = [(spread(k, 1, (self%levels(k) - 1)/span), k=1, size(self%levels))]
      level = [([(self%below(k) + i, i=0, self%levels(k) - 2, span)], k=1, size(self%levels))]
      piece%cells = band_of_rows(domain, size(layer)*size(site, 2))
      associate (cells => piece%cells)
         piece%before = corners*cells%first
         piece%all_ends = corners*cells%whole
         piece%offset = [(corners*i, i=cells%first, cells%first + cells%count &
            & - merge(0, 1, cells%first + cells%count == cells%whole))]
         piece%kind = spread(merge(quadratic_cell, linear_cell, span == 2), 1, cells%count)
         allocate (piece%connectivity(corners*cells%count), self%layer(cells%count), &
            & self%quad(cells%count))
         do i = 1, cells%count
            k = (cells%first + i - 1)/size(site, 2) + 1
            self%layer(i) = layer(k)
            self%quad(i) = cells%first + i - size(site, 2)*(k - 1)
            piece%connectivity(corners*(i - 1) + 1:corners*i) = &
               & cell_points(site(:, self%quad(i)), self%slots%sites, level(k))
         end do
      end associate
   end subroutine make_cells

   !> Points of one cell in VTK's order
   pure function cell_points(site, sites, level) result(point)
      !> Sites of the quad in the deck's order
      integer, intent(in) :: site(:)
      !> Sites of the plane, levels below the cell
      integer, intent(in) :: sites, level
      integer, allocatable :: point(:)

      if (size(site) == 4) then
         point = [site + sites*level, site + sites*(level + 1)] - 1
      else
         point = site(quad_place) + sites*(level + level_place - 1) - 1
      end if
   end function cell_points

end module plydyn_io_vtkhdf_plate_grid
