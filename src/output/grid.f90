!> The plate as cells for pictures: every layer of every part with points of its own, so that values
!> jump between layers and between parts, and are continuous within them.
module plydyn_output_grid
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   implicit none
   private

   public :: new_grid

   !> VTK's cells: 8 nodes, and 27 nodes
   integer, parameter :: linear_cell = 12, quadratic_cell = 29

   !> Place of each of the 27 nodes of a quadratic cell: node of the quad and level, 1 to 3
   integer, parameter :: quad_place(27) = [1, 2, 3, 4, 1, 2, 3, 4, 5, 6, 7, 8, 5, 6, 7, 8, &
      & 1, 2, 3, 4, 8, 6, 5, 7, 9, 9, 9]
   integer, parameter :: level_place(27) = [1, 1, 1, 1, 3, 3, 3, 3, 1, 1, 1, 1, 3, 3, 3, 3, &
      & 2, 2, 2, 2, 2, 2, 2, 2, 1, 3, 2]

   !> Places of a plate in the plane of its nodes
   type :: sites_type
      !> Site of each node of each quad in tensor order, (nodes, quads)
      integer, allocatable :: site(:, :)
   end type sites_type

   !> Points and cells; the points of a layer lie level by level, in each the sites of the plane:
   !> the nodes of one part after the other
   type, public :: grid_type
      !> Node of each site
      integer, allocatable :: node(:)
      !> Sites of each plate
      type(sites_type), allocatable :: plates(:)
      !> Levels of points in each layer, and the points before it
      integer, allocatable :: levels(:), first(:)
      !> Position of each point, (3, points)
      real(wp), allocatable :: position(:, :)
      !> Points of the cells from 0, one cell after the other; where each begins and the last ends
      integer, allocatable :: connectivity(:), offset(:)
      !> VTK's type of each cell
      integer, allocatable :: kind(:)
      !> Layer, plate and quad of the plate of each cell
      integer, allocatable :: layer(:), plate(:), quad(:)
   end type grid_type

contains

   !> Divide every layer over every quad into cells: one, or two if its order is above 2
   function new_grid(domain) result(self)
      !> The domain
      type(domain_type), intent(in) :: domain
      type(grid_type) :: self

      integer :: k

      call find_sites(domain, self)
      associate (order => domain%layers%order, sites => size(self%node))
         if (domain%plates(1)%side == 3) then
            self%levels = merge(3, 5, order <= 2)
         else
            self%levels = order + 1
         end if
         self%first = [(sites*sum(self%levels(:k - 1)), k=1, size(order))]
         allocate (self%position(3, sites*sum(self%levels)))
      end associate
      call place_points(domain, self)
      call make_cells(domain, self)
   end function new_grid

   !> Number the nodes of each part, in their order
   subroutine find_sites(domain, self)
      type(domain_type), intent(in) :: domain
      type(grid_type), intent(inout) :: self

      integer :: e, number(domain%columns%nodes), p
      integer, allocatable :: own(:)

      allocate (self%node(0), self%plates(size(domain%plates)))
      do p = 1, size(domain%plates)
         associate (node => domain%plates(p)%node, plate => self%plates(p))
            number(:) = 0
            do e = 1, size(node, 2)
               number(node(:, e)) = 1
            end do
            own = pack([(e, e=1, size(number))], number > 0)
            number(own) = size(self%node) + [(e, e=1, size(own))]
            self%node = [self%node, own]
            allocate (plate%site(size(node, 1), size(node, 2)))
            do e = 1, size(node, 2)
               plate%site(:, e) = number(node(:, e))
            end do
         end associate
      end do
   end subroutine find_sites

   !> Positions of the points
   subroutine place_points(domain, self)
      type(domain_type), intent(in) :: domain
      type(grid_type), intent(inout) :: self
      integer :: i, k, t
      real(wp) :: part

      i = 0
      associate (layers => domain%layers, sites => size(self%node))
         do k = 1, size(self%levels)
            do t = 1, self%levels(k)
               part = real(t - 1, wp)/real(self%levels(k) - 1, wp)
               self%position(:, i + 1:i + sites) = domain%position(:, self%node)
               self%position(3, i + 1:i + sites) = domain%position(3, self%node) &
                  & + (1.0_wp - part)*layers%bottom(k) + part*layers%top(k)
               i = i + sites
            end do
         end do
      end associate
   end subroutine place_points

   !> Cells of all layers over all quads
   subroutine make_cells(domain, self)
      type(domain_type), intent(in) :: domain
      type(grid_type), intent(inout) :: self

      integer :: cell, corners, e, k, p, piece, pieces, span, total

      span = merge(2, 1, domain%plates(1)%side == 3)
      corners = merge(27, 8, span == 2)
      total = sum((self%levels - 1)/span)*sum([(size(domain%plates(p)%quad), &
         & p=1, size(domain%plates))])
      allocate (self%connectivity(corners*total), self%kind(total), self%layer(total), &
         & self%plate(total), self%quad(total))
      self%kind(:) = merge(quadratic_cell, linear_cell, span == 2)
      self%offset = [(corners*k, k=0, total)]
      cell = 0
      do p = 1, size(domain%plates)
         do k = 1, size(self%levels)
            pieces = (self%levels(k) - 1)/span
            do e = 1, size(domain%plates(p)%quad)
               do piece = 1, pieces
                  self%connectivity(cell*corners + 1:(cell + 1)*corners) = self%first(k) &
                     & + cell_points(self%plates(p)%site(:, e), size(self%node), span*(piece - 1))
                  cell = cell + 1
                  self%layer(cell) = k
                  self%plate(cell) = p
                  self%quad(cell) = e
               end do
            end do
         end do
      end do
   end subroutine make_cells

   !> Points of one cell in VTK's order, within the layer
   pure function cell_points(site, sites, level) result(point)
      !> Sites of the quad in tensor order
      integer, intent(in) :: site(:)
      !> Sites of the plane, levels below the cell
      integer, intent(in) :: sites, level
      integer, allocatable :: point(:)

      integer, parameter :: of_q4(4) = [1, 2, 4, 3], of_q9(9) = [1, 3, 9, 7, 2, 6, 8, 4, 5]

      if (size(site) == 4) then
         point = [site(of_q4) + sites*level, site(of_q4) + sites*(level + 1)] - 1
      else
         point = site(of_q9(quad_place)) + sites*(level + level_place - 1) - 1
      end if
   end function cell_points

end module plydyn_output_grid
