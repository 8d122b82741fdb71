!> Bricks of eight nodes: their geometry, and what holds the shapes that one point does not feel.
!>
!> Nodes: four of one face, counter-clockwise seen from the other, then the four opposite ones, as
!> LS-DYNA and VTK have them. A brick with one point takes the mean of the gradients over its volume
!> (Flanagan and Belytschko, 1981), which passes the patch test on any shape; one with eight takes
!> the mean of the volume strain over its points (B-bar), but for plies that are damaged: they lose
!> their volume strain point by point, and a mean would let one point break for the others.
!>
!> What one point does not feel are four shapes for each direction, eta zeta, zeta xi, xi eta and
!> xi eta zeta. Stiffness against them is that of the strains that they bring about in the brick's
!> own axes, but for the shear of bending and for the normal strain that a brick cannot have with
!> them (stress is 0 there), as in the assumed strain of Belytschko and Bindeman (1993).
module plydyn_element_brick_bricks
   use plydyn_base_matrix, only : cross, invert
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_material_batch, only : material_batch_type
   use plydyn_fem_quadrature, only : gauss_points
   implicit none
   private

   public :: brick_shares, new_brick_shape, parent_slope, same_shape

   !> Nodes, and points of full quadrature
   integer, parameter, public :: corners = 8
   !> Shapes that one point does not feel
   integer, parameter, public :: hourglass_modes = 4
   !> Constants against them: eta 11 13 33, zeta 11 12 22, xi 22 23 33, three shears, one over the
   !> three half lengths, and xi eta zeta 1 2 3
   integer, parameter, public :: mode_stiffnesses = 18

   !> xi, eta, zeta of the nodes
   real(wp), parameter :: xi(corners) = [-1, 1, 1, -1, -1, 1, 1, -1]
   real(wp), parameter :: eta(corners) = [-1, -1, 1, 1, -1, -1, 1, 1]
   real(wp), parameter :: zeta(corners) = [-1, -1, -1, -1, 1, 1, 1, 1]
   !> The shapes at the nodes, (nodes, shapes)
   real(wp), parameter, public :: mode_shape(corners, hourglass_modes) = reshape( &
      & [eta*zeta, zeta*xi, xi*eta, xi*eta*zeta], [corners, hourglass_modes])

   !> Geometry of a batch; all zero in lanes without a brick
   type, public :: brick_shape_type
      !> Gradients of the shape functions at the points, (lanes, 8, 3, points)
      real(wp), allocatable :: gradient(:, :, :, :)
      !> Volume of the points, (lanes, points)
      real(wp), allocatable :: volume(:, :)
      !> Share of the hourglass modes in the positions, (lanes, 3, 4)
      real(wp) :: bent(lanes, 3, hourglass_modes) = 0.0_wp
      !> Unit vectors along the brick's own axes, (lanes, components, axes)
      real(wp) :: axis(lanes, 3, 3) = 0.0_wp
      !> Stiffness against hourglass modes, (lanes, `mode_stiffnesses`)
      real(wp) :: mode_stiffness(lanes, mode_stiffnesses) = 0.0_wp
   end type brick_shape_type

   !> All bricks of a part with fibres in one direction, eight side by side. Where hourglass control
   !> is viscous the last history variable is the energy that it took, per brick
   type, public, extends(material_batch_type) :: bricks_type
      !> Index of the part
      integer :: part = 0
      !> Points of a brick, 1 or 8
      integer :: points = 1
      !> Eight points share the mean of their volume strain and of their pressure
      logical :: shares_volume = .false.
      !> Index of each brick in the mesh
      integer, allocatable :: brick(:)
      !> Places of the nodes' x in the arrays of motion, and in that of forces; y and z lie one and
      !> two times `lanes` behind; (lanes, 8, batches)
      integer, allocatable :: place(:, :, :), target(:, :, :)
      !> Geometries that occur, and that of each batch
      type(brick_shape_type), allocatable :: shapes(:)
      integer, allocatable :: shape(:)
      !> Fibre direction, degrees from the x axis
      real(wp) :: angle = 0.0_wp
      !> Viscous hourglass force per velocity of an hourglass mode over volume**(2/3); 0 for none
      real(wp) :: viscosity = 0.0_wp
   end type bricks_type

   !> Relative difference below which two geometries are the same
   real(wp), parameter :: difference = 1.0e-9_wp

contains

   !> Geometry of a batch
   pure function new_brick_shape(position, count, points, local_stiffness) result(self)
      !> Nodes of each lane, (3, 8, lanes)
      real(wp), intent(in) :: position(:, :, :)
      !> Lanes that have a brick
      integer, intent(in) :: count
      !> Points of a brick, 1 or 8
      integer, intent(in) :: points
      !> Stiffness in the axes of the model times the share of hourglass control; 0 for none
      real(wp), intent(in) :: local_stiffness(6, 6)
      type(brick_shape_type) :: self

      integer :: l

      allocate (self%gradient(lanes, corners, 3, points), self%volume(lanes, points), source=0.0_wp)
      do l = 1, count
         call set_gradients(position(:, :, l), points, self%gradient(l, :, :, :), self%volume(l, :))
         if (points > 1) cycle
         self%bent(l, :, :) = matmul(position(:, :, l), mode_shape)/corners
         call set_mode_stiffness(position(:, :, l), sum(self%volume(l, :)), local_stiffness, &
            & self%axis(l, :, :), self%mode_stiffness(l, :))
      end do
   end function new_brick_shape

   !> Gradients and volumes at the points of one brick, or their mean and sum
   pure subroutine set_gradients(position, points, gradient, volume)
      real(wp), intent(in) :: position(3, corners)
      integer, intent(in) :: points
      real(wp), intent(out) :: gradient(corners, 3, points), volume(points)

      real(wp) :: each(corners, 3, corners), part(corners)
      integer :: m

      do m = 1, corners
         call gradient_at(position, m, each(:, :, m), part(m))
      end do
      if (points > 1) then
         gradient(:, :, :) = each
         volume(:) = part
         return
      end if
      gradient(:, :, :) = 0.0_wp
      volume(1) = sum(part)
      do m = 1, corners
         gradient(:, :, 1) = gradient(:, :, 1) + part(m)/volume(1)*each(:, :, m)
      end do
   end subroutine set_gradients

   !> Gradients at a Gauss point of 2 x 2 x 2, and its volume
   pure subroutine gradient_at(position, point, gradient, volume)
      real(wp), intent(in) :: position(3, corners)
      integer, intent(in) :: point
      real(wp), intent(out) :: gradient(corners, 3), volume

      real(wp) :: inverse(3, 3), slope(corners, 3)

      slope(:, :) = slopes_at(point)
      call invert(matmul(position, slope), inverse, volume)
      gradient(:, :) = matmul(slope, inverse)
   end subroutine gradient_at

   !> Derivatives of the shape functions along xi, eta, zeta
   pure function slopes_at(point) result(slope)
      !> Gauss point, in the order of the nodes; 0 for the centre
      integer, intent(in) :: point
      real(wp) :: slope(corners, 3)

      real(wp) :: gauss(2), abscissa, x, y, z

      gauss(:) = gauss_points(2)
      abscissa = merge(gauss(2), 0.0_wp, point > 0)
      x = abscissa*xi(max(point, 1))
      y = abscissa*eta(max(point, 1))
      z = abscissa*zeta(max(point, 1))
      slope(:, 1) = xi*(1.0_wp + eta*y)*(1.0_wp + zeta*z)/corners
      slope(:, 2) = eta*(1.0_wp + xi*x)*(1.0_wp + zeta*z)/corners
      slope(:, 3) = zeta*(1.0_wp + xi*x)*(1.0_wp + eta*y)/corners
   end function slopes_at

   !> d(xi, eta, zeta)/d(x, y, z) at a point of a lane, or its mean: shape functions give xi, eta
   !> and zeta from those of the nodes
   pure function parent_slope(shape, lane, point) result(slope)
      !> Geometry of the batch
      type(brick_shape_type), intent(in) :: shape
      !> Lane and point
      integer, intent(in) :: lane, point
      !> The first index is that of xi, eta, zeta
      real(wp) :: slope(3, 3)

      associate (gradient => shape%gradient(lane, :, :, point))
         slope(1, :) = matmul(xi, gradient)
         slope(2, :) = matmul(eta, gradient)
         slope(3, :) = matmul(zeta, gradient)
      end associate
   end function parent_slope

   !> The brick's own axes, and its stiffness against hourglass modes there
   pure subroutine set_mode_stiffness(position, volume, stiffness, axis, mode_stiffness)
      real(wp), intent(in) :: position(3, corners), volume, stiffness(6, 6)
      real(wp), intent(out) :: axis(3, 3), mode_stiffness(mode_stiffnesses)

      real(wp) :: c(6, 6), long(3), s(3, 3), unused
      integer :: i

      axis(:, :) = matmul(position, slopes_at(0))
      do i = 1, 3
         long(i) = norm2(axis(:, i))
         axis(:, i) = axis(:, i)/long(i)
      end do
      c(:, :) = turned(stiffness, square(axis))
      mode_stiffness(1:3) = reduced(c, 1, 3, 2)/[long(1)**2, long(1)*long(3), long(3)**2]
      mode_stiffness(4:6) = reduced(c, 1, 2, 3)/[long(1)**2, long(1)*long(2), long(2)**2]
      mode_stiffness(7:9) = reduced(c, 2, 3, 1)/[long(2)**2, long(2)*long(3), long(3)**2]
      mode_stiffness(10:12) = [c(4, 4), c(5, 5), c(6, 6)]
      mode_stiffness(13:15) = 1.0_wp/long
      mode_stiffness(:12) = volume/3.0_wp*mode_stiffness(:12)
      if (maxval(abs(c)) <= 0.0_wp) then
         mode_stiffness(:) = 0.0_wp
         return
      end if
      call invert(c(:3, :3), s, unused)
      mode_stiffness(16:18) = [(volume/(9.0_wp*s(i, i)*long(i)**2), i=1, 3)]
   end subroutine set_mode_stiffness

   !> Axes at right angles that lie close to those of a brick: the third is normal to the first two
   pure function square(axis) result(right)
      real(wp), intent(in) :: axis(3, 3)
      real(wp) :: right(3, 3)

      right(:, 1) = axis(:, 1)
      right(:, 3) = cross(axis(:, 1), axis(:, 2))
      right(:, 3) = right(:, 3)/norm2(right(:, 3))
      right(:, 2) = cross(right(:, 3), right(:, 1))
   end function square

   !> A stiffness in other axes: Voigt order xx yy zz xy xz yz
   pure function turned(stiffness, axis) result(c)
      real(wp), intent(in) :: stiffness(6, 6), axis(3, 3)
      real(wp) :: c(6, 6)

      integer, parameter :: first(6) = [1, 2, 3, 1, 1, 2], second(6) = [1, 2, 3, 2, 3, 3]
      real(wp) :: t(6, 6)
      integer :: i, j

      ! strain in the model's axes from strain in the brick's
      do j = 1, 6
         do i = 1, 6
            t(i, j) = axis(first(i), first(j))*axis(second(i), second(j)) &
               & + axis(first(i), second(j))*axis(second(i), first(j))
         end do
      end do
      t(:3, :) = 0.5_wp*t(:3, :)
      c(:, :) = matmul(transpose(t), matmul(stiffness, t))
   end function turned

   !> Stiffness of two normal strains, 11, 12, 22, where a third stress is zero
   pure function reduced(c, i, j, k) result(q)
      real(wp), intent(in) :: c(6, 6)
      !> The two strains and the stress
      integer, intent(in) :: i, j, k
      real(wp) :: q(3)

      q(:) = [c(i, i), c(i, j), c(j, j)]
      if (c(k, k) > 0.0_wp) then
         q(:) = q - [c(i, k)*c(i, k), c(i, k)*c(j, k), c(j, k)*c(j, k)]/c(k, k)
      end if
   end function reduced

   !> Volume of each node of a brick: the integral of its shape function
   pure function brick_shares(position) result(share)
      !> Nodes, (3, 8)
      real(wp), intent(in) :: position(3, corners)
      real(wp) :: share(corners)

      real(wp) :: gauss(2), gradient(corners, 3), volume
      integer :: m

      gauss(:) = gauss_points(2)
      share(:) = 0.0_wp
      do m = 1, corners
         call gradient_at(position, m, gradient, volume)
         share(:) = share + volume*(1.0_wp + xi*xi(m)*gauss(2))*(1.0_wp + eta*eta(m)*gauss(2)) &
            & *(1.0_wp + zeta*zeta(m)*gauss(2))/corners
      end do
   end function brick_shares

   !> Whether two batches have the same geometry
   pure logical function same_shape(one, other) result(same)
      !> Their geometries
      type(brick_shape_type), intent(in) :: one, other

      same = maxval(abs(one%gradient - other%gradient)) <= difference*maxval(abs(one%gradient)) &
         & .and. maxval(abs(one%volume - other%volume)) <= difference*maxval(one%volume)
      if (same) same = maxval(abs(one%axis - other%axis)) <= difference &
         & .and. maxval(abs(one%bent - other%bent))*maxval(abs(one%gradient)) <= difference &
         & .and. maxval(abs(one%mode_stiffness - other%mode_stiffness)) &
         & <= difference*maxval(abs(one%mode_stiffness))
   end function same_shape

end module plydyn_element_brick_bricks
