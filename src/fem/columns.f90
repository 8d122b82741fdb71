!> Where the points lie in the arrays of motion.
!>
!> Above every node of the plane stands a column of points. Every numerical layer owns all of its
!> points, also those on its faces: two layers that are tied meet in two points with one motion.
!> So tied faces, open faces and interfaces share one layout. An order group has layers of one
!> order; its part of a column is stored as (lanes, blocks, levels, 3), the layers side by side, the
!> order groups one after the other.
!>
!> Bricks have no plane and no layers: each of their nodes is one point, and a column holds as
!> many of them as there are lanes, side by side: (lanes, 3).
!>
!> Nodes where chunks of quads meet get forces from several: see `plydyn_domain_decomposition`.
!> The first chunk adds to the node's own column, the others to columns of their own behind all.
module plydyn_fem_columns
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_expansion, only : expansion_type
   implicit none
   private

   public :: new_columns, new_solid_columns

   !> Places in front of all columns. The C library puts large arrays 16 bytes behind a line of the
   !> cache (64 bytes): so columns begin on a line, and vectors never lie across two
   integer, parameter, public :: alignment_offset = 6

   !> Layers of one order
   type, public :: order_group_type
      !> Order of the expansion
      integer :: order = 0
      !> Tables of the expansion; none for bricks
      type(expansion_type) :: expansion
      !> Blocks of as many layers as there are lanes
      integer :: blocks = 0
      !> Its first point in the column of the first node, its first mass there
      integer :: first = 0, first_mass = 0
      !> Layer in each lane, 0 where there is none, (lanes, blocks)
      integer, allocatable :: layer(:, :)
      !> 1 where the top of a lane is tied to the bottom of the next lane, else 0, (lanes*blocks)
      real(wp), allocatable :: tied_above(:)
      !> Whether any is
      logical :: is_tied = .false.
   end type order_group_type

   !> All columns; every node has the same
   type, public :: columns_type
      !> Nodes of the plane, or of all bricks
      integer :: nodes = 0
      !> Nodes in a column, 1 above a plane
      integer :: nodes_per_column = 1
      !> Columns
      integer :: count = 0
      !> Length of a column in the arrays of motion; a third of it in those of masses
      integer :: height = 0
      !> Length of the arrays of motion and of masses
      integer :: freedoms = 0, masses = 0
      !> Length of the array of forces: that of motion and the columns behind
      integer :: forces = 0
      !> Layers by their order
      type(order_group_type), allocatable :: order_groups(:)
      !> Family, block and lane of each layer, (3, layers)
      integer, allocatable :: layer_slot(:, :)
   contains
      procedure :: take
      procedure :: tie
      procedure :: start
      procedure :: mass_start
      procedure :: freedom
      procedure :: column_of
      procedure :: mass_of
      procedure :: levels
   end type columns_type

contains

   !> Arrange the layers of a stack
   pure function new_columns(nodes, order) result(self)
      !> Nodes of the plane
      integer, intent(in) :: nodes
      !> Order of each layer, from the bottom up
      integer, intent(in) :: order(:)
      type(columns_type) :: self

      integer :: f, i, k, p

      self%height = 0
      allocate (self%layer_slot(3, size(order)))
      allocate (self%order_groups(count([(any(order == p), p=1, maxval(order))])))
      f = 0
      do p = 1, maxval(order)
         if (.not. any(order == p)) cycle
         f = f + 1
         associate (order_group => self%order_groups(f))
            order_group%order = p
            order_group%blocks = (count(order == p) + lanes - 1)/lanes
            order_group%first = alignment_offset + self%height + 1
            order_group%first_mass = alignment_offset + self%height/3 + 1
            allocate (order_group%layer(lanes, order_group%blocks), source=0)
            order_group%tied_above = spread(0.0_wp, 1, lanes*order_group%blocks)
            i = 0
            do k = 1, size(order)
               if (order(k) /= p) cycle
               self%layer_slot(:, k) = [f, 1 + i/lanes, 1 + mod(i, lanes)]
               order_group%layer(1 + mod(i, lanes), 1 + i/lanes) = k
               i = i + 1
            end do
            self%height = self%height + 3*lanes*order_group%blocks*(p + 1)
         end associate
      end do
      call self%take(nodes, nodes, nodes)
   end function new_columns

   !> Arrange the nodes of bricks
   pure function new_solid_columns(nodes) result(self)
      !> How many there are
      integer, intent(in) :: nodes
      type(columns_type) :: self

      integer :: count

      count = (nodes + lanes - 1)/lanes
      self%nodes_per_column = lanes
      self%height = 3*lanes
      self%layer_slot = reshape([1, 1, 1], [3, 1])
      allocate (self%order_groups(1))
      self%order_groups(1)%blocks = 1
      self%order_groups(1)%first = alignment_offset + 1
      self%order_groups(1)%first_mass = alignment_offset + 1
      self%order_groups(1)%layer = reshape([1, spread(0, 1, lanes - 1)], [lanes, 1])
      self%order_groups(1)%tied_above = spread(0.0_wp, 1, lanes)
      call self%take(nodes, count, count)
   end function new_solid_columns

   !> Have other columns of the same height
   pure subroutine take(self, nodes, count, all)
      class(columns_type), intent(inout) :: self
      !> Nodes, their columns, and these with those behind
      integer, intent(in) :: nodes, count, all

      self%nodes = nodes
      self%count = count
      self%freedoms = alignment_offset + self%height*count
      self%masses = alignment_offset + self%height/3*count
      self%forces = alignment_offset + self%height*all
   end subroutine take

   !> Tie the top of a layer to the bottom of the next, if both are of one order group, and so in
   !> lanes side by side
   pure subroutine tie(self, layer)
      class(columns_type), intent(inout) :: self
      !> The lower layer, from the bottom up
      integer, intent(in) :: layer

      if (self%layer_slot(1, layer) /= self%layer_slot(1, layer + 1)) return
      self%order_groups(self%layer_slot(1, layer))%is_tied = .true.
      self%order_groups(self%layer_slot(1, layer))%tied_above(self%layer_slot(3, layer) &
         & + lanes*(self%layer_slot(2, layer) - 1)) = 1.0_wp
   end subroutine tie

   !> Where the part of a column begins that belongs to an order group; from there on it is
   !> (lanes, blocks, levels, 3)
   elemental integer function start(self, order_group, column)
      class(columns_type), intent(in) :: self
      !> Index of the order group
      integer, intent(in) :: order_group
      !> The column, that of the node of the same number above a plane
      integer, intent(in) :: column

      associate (f => self%order_groups(order_group))
         start = f%first + self%height*(column - 1)
      end associate
   end function start

   !> The same in the arrays of masses, (lanes, blocks, levels)
   elemental integer function mass_start(self, order_group, node)
      class(columns_type), intent(in) :: self
      !> Index of the order group, and node of the plane
      integer, intent(in) :: order_group, node

      mass_start = self%order_groups(order_group)%first_mass + self%height/3*(node - 1)
   end function mass_start

   !> Place of a point's displacement in the arrays of motion
   elemental integer function freedom(self, layer, level, direction, node)
      class(columns_type), intent(in) :: self
      !> Layer and thickness node in it, both from the bottom up
      integer, intent(in) :: layer, level
      !> 1, 2, 3 for x, y, z
      integer, intent(in) :: direction
      !> Node of the plane
      integer, intent(in) :: node

      associate (f => self%order_groups(self%layer_slot(1, layer)))
         freedom = self%height*((node - 1)/self%nodes_per_column) + f%first &
            & + (self%layer_slot(3, layer) - 1) + mod(node - 1, self%nodes_per_column) &
            & + lanes*((self%layer_slot(2, layer) - 1) &
            & + f%blocks*((level - 1) + (f%order + 1)*(direction - 1)))
      end associate
   end function freedom

   !> Column in which a place in the arrays of motion lies
   elemental integer function column_of(self, freedom) result(column)
      class(columns_type), intent(in) :: self
      !> The place
      integer, intent(in) :: freedom

      column = (freedom - alignment_offset - 1)/self%height + 1
   end function column_of

   !> Place of a point's mass in the array of masses
   elemental integer function mass_of(self, layer, level, node)
      class(columns_type), intent(in) :: self
      !> Layer and thickness node in it, both from the bottom up
      integer, intent(in) :: layer, level
      !> Node of the plane
      integer, intent(in) :: node

      associate (f => self%order_groups(self%layer_slot(1, layer)))
         mass_of = self%height/3*((node - 1)/self%nodes_per_column) + f%first_mass &
            & + (self%layer_slot(3, layer) - 1) + mod(node - 1, self%nodes_per_column) &
            & + lanes*((self%layer_slot(2, layer) - 1) + f%blocks*(level - 1))
      end associate
   end function mass_of

   !> Thickness nodes of a layer
   elemental integer function levels(self, layer)
      class(columns_type), intent(in) :: self
      !> Layer from the bottom up
      integer, intent(in) :: layer

      levels = self%order_groups(self%layer_slot(1, layer))%order + 1
   end function levels

end module plydyn_fem_columns
