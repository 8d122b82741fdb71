!> Points of the plane sorted into square cells, to find those near a place.
module plydyn_domain_cell_grid
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   implicit none
   private

   public :: new_cell_grid

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

   !> Sort points into cells
   pure function new_cell_grid(position, radius) result(self)
      !> Positions, (2, points)
      real(wp), intent(in) :: position(:, :)
      !> Farthest that will be asked for
      real(wp), intent(in) :: radius
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
      !> The place
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

end module plydyn_domain_cell_grid
