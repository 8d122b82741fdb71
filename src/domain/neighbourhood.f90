!> Gauss points of the plane around those of a rank: its own, and those of other ranks that may be
!> averaged with them; and points sorted into square cells, to find those near a place.
module plydyn_domain_neighbourhood
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_domain_decomposition, only : decomposition_type
   use plydyn_element_plate_layers, only : plate_type
   use plydyn_element_quad, only : quad_metric, tensor_order
   use plydyn_model_mesh, only : mesh_type
   implicit none
   private

   public :: new_cell_grid, new_neighbourhood

   !> Quads of a part, in the order of the whole model, and their points, quad by quad
   type, public :: neighbourhood_type
      !> Points of a quad
      integer :: plane = 0
      !> Rank that has each quad; its place in the plate of this rank, 0 where another rank has it
      integer, allocatable :: rank(:), place(:)
      !> Positions of the points, (2, points); their areas
      real(wp), allocatable :: position(:, :), area(:)
   contains
      procedure :: own_point
      procedure :: rank_of
   end type neighbourhood_type

   !> Points by their cells
   type, public :: cell_grid_type
      private
      !> Corner of the first cell, and side of all
      real(wp) :: corner(2) = 0.0_wp, side = 1.0_wp
      !> Cells along x and y
      integer :: cells(2) = 0
      !> Place in `point` of the first point of each cell; one more at the end
      integer, allocatable :: first(:)
      !> Points, cell after cell
      integer, allocatable :: point(:)
   contains
      procedure :: points_near
   end type cell_grid_type

contains

   !> The quads of a rank, and all others that have a point within the radius of theirs
   pure function new_neighbourhood(mesh, division, rank_of_chunk, rank, part, plate, radius) &
      & result(self)
      type(mesh_type), intent(in) :: mesh
      !> All quads
      type(decomposition_type), intent(in) :: division
      !> Rank of each chunk, and this rank; the part
      integer, intent(in) :: rank_of_chunk(:), rank, part
      !> Its plate: tables of quads
      type(plate_type), intent(in) :: plate
      !> How far points are averaged
      real(wp), intent(in) :: radius
      type(neighbourhood_type) :: self

      real(wp) :: metric(5, plate%side**2)
      integer :: c, e, i, own, ranks(size(division%parts(part)%element))
      integer, allocatable :: kept(:)

      self%plane = plate%side**2
      do c = 1, size(division%chunks)
         associate (chunk => division%chunks(c))
            if (chunk%set == part) ranks(chunk%elements(1):chunk%elements(2)) = rank_of_chunk(c)
         end associate
      end do
      associate (element => division%parts(part)%element)
         kept = near_quads(mesh, plate, element, ranks == rank, radius)
         self%rank = ranks(kept)
         self%place = spread(0, 1, size(kept))
         allocate (self%position(2, self%plane*size(kept)), self%area(self%plane*size(kept)))
         own = 0
         do i = 1, size(kept)
            if (self%rank(i) == rank) then
               own = own + 1
               self%place(i) = own
            end if
            e = self%plane*(i - 1)
            self%position(:, e + 1:e + self%plane) = quad_points(mesh, plate, element(kept(i)))
            metric(:, :) = quad_metric(plate%side, &
               & mesh%position(1:2, mesh%quad_node(tensor_order(plate%side), element(kept(i)))))
            self%area(e + 1:e + self%plane) = metric(5, :)
         end do
      end associate
   end function new_neighbourhood

   !> Number of a point in the plate of this rank, 0 where another rank has it
   elemental integer function own_point(self, point) result(own)
      class(neighbourhood_type), intent(in) :: self
      !> The point here
      integer, intent(in) :: point

      associate (place => self%place(1 + (point - 1)/self%plane))
         own = 0
         if (place > 0) own = self%plane*(place - 1) + 1 + mod(point - 1, self%plane)
      end associate
   end function own_point

   !> Rank that has a point
   elemental integer function rank_of(self, point) result(rank)
      class(neighbourhood_type), intent(in) :: self
      !> The point here
      integer, intent(in) :: point

      rank = self%rank(1 + (point - 1)/self%plane)
   end function rank_of

   !> Places in a list of own quads, and of those with a point in the box around the points of the
   !> own ones that reaches so much farther
   pure function near_quads(mesh, plate, element, is_own, radius) result(places)
      type(mesh_type), intent(in) :: mesh
      type(plate_type), intent(in) :: plate
      !> Quads of the mesh
      integer, intent(in) :: element(:)
      logical, intent(in) :: is_own(:)
      real(wp), intent(in) :: radius
      integer, allocatable :: places(:)

      real(wp) :: high(2), low(2), points(2, plate%side**2)
      logical :: is_near(size(element))
      integer :: e

      low(:) = huge(radius)
      high(:) = -huge(radius)
      do e = 1, size(element)
         if (.not. is_own(e)) cycle
         points(:, :) = quad_points(mesh, plate, element(e))
         low(:) = min(low, minval(points, 2) - radius)
         high(:) = max(high, maxval(points, 2) + radius)
      end do
      is_near(:) = is_own
      do e = 1, size(element)
         if (is_own(e) .or. .not. any(is_own)) cycle
         points(:, :) = quad_points(mesh, plate, element(e))
         is_near(e) = any(all(points >= spread(low, 2, size(points, 2)) &
            & .and. points <= spread(high, 2, size(points, 2)), 1))
      end do
      places = pack([(e, e=1, size(element))], is_near)
   end function near_quads

   !> Gauss points of a quad, (2, points)
   pure function quad_points(mesh, plate, quad) result(points)
      type(mesh_type), intent(in) :: mesh
      type(plate_type), intent(in) :: plate
      integer, intent(in) :: quad
      real(wp) :: points(2, plate%side**2)

      points(:, :) = matmul(mesh%position(1:2, mesh%quad_node(tensor_order(plate%side), quad)), &
         & transpose(plate%shape))
   end function quad_points

   !> Sort points into cells
   pure function new_cell_grid(position, radius) result(self)
      !> Positions, (2, points); farthest that will be asked for
      real(wp), intent(in) :: position(:, :), radius
      type(cell_grid_type) :: self

      real(wp) :: extent(2)
      integer :: cell(size(position, 2)), i

      self%corner(:) = minval(position, 2)
      extent(:) = maxval(position, 2) - self%corner
      ! no more cells than points
      self%side = max(radius, sqrt(product(extent)/real(size(position, 2), wp)), tiny(radius))
      self%cells(:) = int(extent/self%side) + 1
      do i = 1, size(cell)
         cell(i) = number(self, cell_of(self, position(:, i)))
      end do
      self%point = sorted_order(cell)
      allocate (self%first(product(self%cells) + 1), source=0)
      self%first(1) = 1
      do i = 1, size(cell)
         self%first(cell(i) + 1) = self%first(cell(i) + 1) + 1
      end do
      do i = 2, size(self%first)
         self%first(i) = self%first(i) + self%first(i - 1)
      end do
   end function new_cell_grid

   !> Points in the cells around a place, in rising order: all within the radius, and others
   pure function points_near(self, place) result(points)
      class(cell_grid_type), intent(in) :: self
      real(wp), intent(in) :: place(2)
      integer, allocatable :: points(:)

      integer :: cell(2), i, j, last(2), start(2)

      cell(:) = cell_of(self, place)
      start(:) = max(cell - 1, 0)
      last(:) = min(cell + 1, self%cells - 1)
      allocate (points(0))
      do j = start(2), last(2)
         i = self%first(number(self, [start(1), j]))
         points = [points, self%point(i:self%first(number(self, [last(1), j]) + 1) - 1)]
      end do
      points(:) = points(sorted_order(points))
   end function points_near

   !> Cell of a place, counted from 0 along x and y
   pure function cell_of(self, place) result(cell)
      type(cell_grid_type), intent(in) :: self
      real(wp), intent(in) :: place(2)
      integer :: cell(2)

      cell(:) = min(max(int((place - self%corner)/self%side), 0), self%cells - 1)
   end function cell_of

   !> Number of a cell
   pure integer function number(self, cell)
      type(cell_grid_type), intent(in) :: self
      integer, intent(in) :: cell(2)

      number = 1 + cell(1) + self%cells(1)*cell(2)
   end function number

end module plydyn_domain_neighbourhood
