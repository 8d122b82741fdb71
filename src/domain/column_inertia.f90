!> Inertia through the thickness: what lets the thickness of plies be stepped over (column-implicit
!> plates).
!>
!> Half of the forces of stretch and shear through the thickness taken at the end of the step adds
!> beta dt**2 K to the inertia of a column of points, with the K of `layer_springs` and of the
!> interfaces. Columns do not couple, nor do directions. What is kept is the response of a
!> column: its accelerations for those that its points would have alone. It does not depend on the
!> area of the node, so columns of the same layers share it; those held in part have their own.
module plydyn_domain_column_inertia
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_columns, only : columns_type
   implicit none
   private

   public :: number_rows

   !> Freedoms that a response takes at a time
   integer, parameter, public :: together = 2

   !> Inertia between the levels of the layers of an order group
   type :: stretch_type
      !> Pairs of levels, (2, pairs)
      integer, allocatable :: level(:, :)
      !> Inertia per area of the relative motion of both, along x, y, z,
      !> (lanes*blocks, pairs, 3, classes of nodes)
      real(wp), allocatable :: inertia(:, :, :, :)
   end type stretch_type

   !> Columns and their responses
   type, public :: column_inertia_type
      !> Whether there is such inertia
      logical :: active = .false.
      !> Area and class of each node
      real(wp), allocatable :: area(:)
      integer, allocatable :: class(:)
      !> Points of a column as rows, those of the order groups one after the other, empty lanes too:
      !> rows before those of each order group, and of each order group
      integer, allocatable :: before(:), rows(:)
      !> Row of each freedom, the lower of two where faces are tied; its order group; freedom of
      !> each row, 0 for none
      integer, allocatable :: row(:), order_group(:), freedom(:)
      !> Which response belongs to each direction at each node, (3, nodes)
      integer, allocatable :: kind(:, :)
      !> Accelerations of the rows for those of the freedoms alone, and zeros behind the freedoms up
      !> to a multiple of `together`, (lanes, freedoms, rows/lanes, kinds)
      real(wp), allocatable :: response(:, :, :, :)
      !> Inertia inside the layers, by their order groups
      type(stretch_type), allocatable :: stretches(:)
   contains
      procedure :: followers
      procedure :: own_response
      procedure :: row_of
      procedure :: place
      procedure :: mass_place
   end type column_inertia_type

contains

   !> Number the points of a column
   pure subroutine number_rows(self, columns, ties)
      !> Gets its rows and freedoms
      class(column_inertia_type), intent(inout) :: self
      type(columns_type), intent(in) :: columns
      !> Lower layers of the faces that move as one
      integer, intent(in) :: ties(:)

      integer :: f, k, r, t

      self%rows = lanes*columns%order_groups%blocks*(columns%order_groups%order + 1)
      self%before = [(sum(self%rows(:f - 1)), f=1, size(self%rows))]
      allocate (self%row(0), self%order_group(0), self%freedom(sum(self%rows)), source=0)
      do k = 1, size(columns%layer_slot, 2)
         do t = 1, columns%levels(k)
            r = self%row_of(columns, k, t)
            ! the lower point of a tied face was the last one
            if (t > 1 .or. .not. any(ties == k - 1)) then
               self%row = [self%row, r]
               self%order_group = [self%order_group, columns%layer_slot(1, k)]
            end if
            self%freedom(r) = size(self%row)
         end do
      end do
   end subroutine number_rows

   !> Row of a point
   elemental integer function row_of(self, columns, layer, level) result(row)
      class(column_inertia_type), intent(in) :: self
      type(columns_type), intent(in) :: columns
      !> Layer and thickness node in it, both from the bottom up
      integer, intent(in) :: layer, level

      integer :: f

      f = columns%layer_slot(1, layer)
      row = self%before(f) + columns%freedom(layer, level, 1, 1) - columns%start(f, 1) + 1
   end function row_of

   !> Place of a row in the arrays of motion
   elemental integer function place(self, columns, row, direction, node)
      class(column_inertia_type), intent(in) :: self
      type(columns_type), intent(in) :: columns
      !> The row; 1, 2, 3 for x, y, z; node of the plane
      integer, intent(in) :: row, direction, node

      integer :: f

      f = count(self%before < row)
      place = columns%start(f, node) + row - self%before(f) - 1 &
         & + (direction - 1)*self%rows(f)
   end function place

   !> Place of a row in the arrays of masses
   elemental integer function mass_place(self, columns, row, node)
      class(column_inertia_type), intent(in) :: self
      type(columns_type), intent(in) :: columns
      !> The row; node of the plane
      integer, intent(in) :: row, node

      integer :: f

      f = count(self%before < row)
      mass_place = columns%mass_start(f, node) - 1 + row - self%before(f)
   end function mass_place

   !> What follows one row when something makes it jump: responses of all other rows to it over its
   !> own, (lanes, rows/lanes, kinds); zero where supports hold it
   pure function followers(self, freedom) result(share)
      class(column_inertia_type), intent(in) :: self
      !> Freedom of the row
      integer, intent(in) :: freedom
      real(wp) :: share(lanes, size(self%response, 3), size(self%response, 4))

      real(wp) :: own
      integer :: k

      do k = 1, size(share, 3)
         own = self%own_response(freedom, k)
         share(:, :, k) = 0.0_wp
         if (own <= 0.0_wp) cycle
         share(:, :, k) = self%response(:, freedom, :, k)/own
         ! the row itself moves already
         associate (row => self%row(freedom) - 1)
            share(1 + mod(row, lanes), 1 + row/lanes, k) = 0.0_wp
         end associate
      end do
   end function followers

   !> Response of a freedom to itself
   pure real(wp) function own_response(self, freedom, kind)
      class(column_inertia_type), intent(in) :: self
      !> The freedom, and the kind of response
      integer, intent(in) :: freedom, kind

      associate (row => self%row(freedom) - 1)
         own_response = self%response(1 + mod(row, lanes), freedom, 1 + row/lanes, kind)
      end associate
   end function own_response

end module plydyn_domain_column_inertia
