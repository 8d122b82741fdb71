!> Largest eigenvalue of each layer of each quad, K x = lambda M x, which bounds that of the mesh:
!> the stable step of central differences is 2/sqrt(lambda).
!>
!> Power iteration finds it from below; a Cholesky factorisation of lambda M - K then proves from
!> above that no eigenvalue is larger, so the step is never a guess. Quads of the same shape and
!> layers of the same constants are solved once. The bound of a quad depends on nothing but the
!> quad: it is the same to the last bit, whichever other quads a rank has.
module plydyn_element_stable_step
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_plate_kernels, only : new_kernels
   use plydyn_element_plate_layers, only : kernels_type, layer_batch_type, layer_springs, plate_type
   use plydyn_element_quad, only : quad_metric, quad_node_area
   use plydyn_fem_expansion, only : level_table
   implicit none
   private

   public :: largest_eigenvalues, certified_bound, power_iteration

   !> LAPACK: Cholesky factorisation
   interface
      subroutine dpotrf(uplo, n, a, lda, info)
         import :: wp
         implicit none
         character(1), intent(in) :: uplo
         integer, intent(in) :: n, lda
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: info
      end subroutine dpotrf
   end interface

   !> Iterations, and the share by which a bound is raised until it is proved
   integer, parameter :: iterations = 40
   real(wp), parameter :: first_margin = 1.002_wp, next_margin = 1.01_wp
   !> Share of the bound below which no smaller one is looked for
   real(wp), parameter :: least_share = 1.0e-6_wp
   !> Shapes that are remembered
   integer, parameter :: remembered = 64
   !> Binary digits of the size of a quad to which its shape is taken
   integer, parameter :: shape_digits = 30

contains

   !> Bound of each layer of a batch over some quads
   subroutine largest_eigenvalues(batch, surface_density, side, corner, outweighed, lambda)
      !> The layers
      type(layer_batch_type), intent(in) :: batch
      !> Mass per area of each layer, (lanes, blocks); 0 in lanes without a layer
      real(wp), intent(in) :: surface_density(:, :)
      !> Nodes along a side of the quads
      integer, intent(in) :: side
      !> Positions of the nodes of each quad in tensor order, (2, side**2, quads)
      real(wp), intent(in) :: corner(:, :, :)
      !> Share of the stiffness through the thickness that added inertia outweighs, 0 for none
      real(wp), intent(in) :: outweighed
      !> Bound of each layer, 1/time squared, (lanes, blocks, quads); 0 in lanes without a layer
      real(wp), intent(out) :: lambda(:, :, :)

      real(wp) :: known_shape(2, side*side, remembered), shape(2, side*side)
      integer :: known, known_quad(remembered), q, s

      known = 0
      quads: do q = 1, size(corner, 3)
         shape(:, :) = shape_of(corner(:, :, q))
         do s = 1, min(known, remembered)
            if (all(abs(shape - known_shape(:, :, s)) <= 0.0_wp)) then
               lambda(:, :, q) = lambda(:, :, known_quad(s))
               cycle quads
            end if
         end do
         call solve_quad(batch, surface_density, side, shape, quad_metric(side, shape), &
            & outweighed, lambda(:, :, q))
         s = 1 + mod(known, remembered)
         known = known + 1
         known_shape(:, :, s) = shape
         known_quad(s) = q
      end do quads
   end subroutine largest_eigenvalues

   !> Nodes of a quad as seen from the first one, rounded: quads that differ by a translation, and
   !> by the round-off of their positions, have the same shape to the last bit
   pure function shape_of(corner) result(shape)
      real(wp), intent(in) :: corner(:, :)
      real(wp) :: shape(2, size(corner, 2))

      real(wp) :: unit

      shape(:, :) = corner - spread(corner(:, 1), 2, size(corner, 2))
      unit = 2.0_wp**(exponent(maxval(abs(shape))) - shape_digits)
      shape(:, :) = unit*anint(shape/unit)
   end function shape_of

   !> Bounds of all layers over one quad
   subroutine solve_quad(batch, surface_density, side, corner, metric, outweighed, lambda)
      type(layer_batch_type), intent(in) :: batch
      real(wp), intent(in) :: surface_density(:, :), corner(:, :), metric(:, :), outweighed
      integer, intent(in) :: side
      real(wp), intent(out) :: lambda(:, :)

      real(wp), allocatable :: k(:, :, :, :), rest(:, :), root(:), scales(:)
      integer :: b, l, twin(2)

      k = dense_stiffness(batch, side, metric)
      root = sqrt(node_mass(batch, side, corner))
      do b = 1, batch%blocks
         do l = 1, lanes
            lambda(l, b) = 0.0_wp
            if (batch%layer(l, b) == 0) cycle
            twin(:) = find_twin(batch, surface_density, l, b)
            if (any(twin /= [l, b])) then
               lambda(l, b) = lambda(twin(1), twin(2))
            else
               scales = root*sqrt(surface_density(l, b))
               if (outweighed > 0.0_wp) then
                  rest = k(:, :, l, b)
                  call relieve(rest, quad_node_area(side, corner), outweighed &
                     & *layer_springs(batch, l, b), level_table(batch%expansion))
                  call scale(rest, scales)
               end if
               call scale(k(:, :, l, b), scales)
               lambda(l, b) = certified_bound(k(:, :, l, b), power_iteration(k(:, :, l, b)))
               if (outweighed > 0.0_wp) lambda(l, b) = least_bound(rest, lambda(l, b))
            end if
         end do
      end do
   end subroutine solve_quad

   !> The first layer with the same constants
   pure function find_twin(batch, surface_density, l, b) result(twin)
      type(layer_batch_type), intent(in) :: batch
      real(wp), intent(in) :: surface_density(:, :)
      integer, intent(in) :: l, b
      integer :: twin(2)

      integer :: i, j

      search: do j = 1, b
         do i = 1, lanes
            if (same_layer(i, j)) exit search
         end do
      end do search
      twin(:) = [i, j]
   contains
      !> Whether lane i of block j has the same constants
      pure logical function same_layer(i, j)
         integer, intent(in) :: i, j

         same_layer = batch%layer(i, j) > 0 &
            & .and. maxval(abs(batch%stiffness(i, :, j) - batch%stiffness(l, :, b))) <= 0.0_wp &
            & .and. abs(batch%two_over_h(i, j) - batch%two_over_h(l, b)) <= 0.0_wp &
            & .and. abs(surface_density(i, j) - surface_density(l, b)) <= 0.0_wp
      end function same_layer
   end function find_twin

   !> Stiffness matrix of every layer, column by column through the kernel itself,
   !> (freedoms, freedoms, lanes, blocks); freedoms run over levels, directions, nodes
   function dense_stiffness(batch, side, metric) result(k)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: side
      real(wp), intent(in) :: metric(:, :)
      real(wp), allocatable :: k(:, :, :, :)

      type(plate_type) :: plate
      type(kernels_type) :: kernels
      real(wp), allocatable :: force(:, :, :), motion(:, :, :)
      integer :: freedoms, i, j

      plate = one_quad(batch, side, metric)
      kernels = new_kernels(side, batch%expansion%order)
      freedoms = (batch%expansion%order + 1)*3*side*side
      allocate (k(freedoms, freedoms, lanes, batch%blocks))
      allocate (force(lanes, batch%blocks, freedoms), motion(lanes, batch%blocks, freedoms))
      do j = 1, freedoms
         motion(:, :, :) = 0.0_wp
         motion(:, :, j) = 1.0_wp
         force(:, :, :) = 0.0_wp
         call kernels%linear(plate, 1, [1, 1], motion, force)
         do i = 1, freedoms
            k(i, j, :, :) = -force(:, :, i)
         end do
      end do
   end function dense_stiffness

   !> A plate of one quad and one batch of layers, whose columns hold nothing else
   pure function one_quad(batch, side, metric) result(plate)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: side
      real(wp), intent(in) :: metric(:, :)
      type(plate_type) :: plate
      integer :: i

      plate%side = side
      plate%node = reshape([(i, i=1, side**2)], [side**2, 1])
      plate%target = plate%node
      plate%metric = reshape(metric, [5, side**2, 1])
      plate%batches = [batch]
      plate%batches(1)%height = 3*lanes*batch%blocks*(batch%expansion%order + 1)
   end function one_quad

   !> Take springs through the thickness, at the nodes, out of a stiffness
   pure subroutine relieve(k, area, spring, table)
      !> Stiffness; freedoms run over levels, directions, nodes
      real(wp), intent(inout) :: k(:, :)
      !> Area of each node; springs per area along x, y, z; what they do between levels
      real(wp), intent(in) :: area(:), spring(3), table(:, :)
      integer :: c, first, n

      do n = 1, size(area)
         do c = 1, 3
            first = size(table, 1)*(c - 1 + 3*(n - 1))
            associate (own => k(first + 1:first + size(table, 1), first + 1:first + size(table, 1)))
               own(:, :) = own - area(n)*spring(c)*table
            end associate
         end do
      end do
   end subroutine relieve

   !> A bound on all eigenvalues of a matrix without sign, from one that is known, by halving the
   !> space between proof and failure
   real(wp) function least_bound(matrix, known) result(bound)
      !> Symmetric
      real(wp), intent(in) :: matrix(:, :)
      !> A bound
      real(wp), intent(in) :: known

      real(wp) :: low, middle

      bound = known
      low = 0.0_wp
      do while (bound > first_margin*low .and. bound > least_share*known)
         middle = merge(0.5_wp*bound, sqrt(low*bound), low <= 0.0_wp)
         if (is_bound(matrix, middle)) then
            bound = middle
         else
            low = middle
         end if
      end do
   end function least_bound

   !> Whether the Cholesky factor of bound - matrix exists
   logical function is_bound(matrix, bound)
      real(wp), intent(in) :: matrix(:, :), bound

      real(wp), allocatable :: factor(:, :)
      integer :: i, info, n

      n = size(matrix, 1)
      factor = -matrix
      do i = 1, n
         factor(i, i) = factor(i, i) + bound
      end do
      call dpotrf("U", n, factor, n, info)
      is_bound = info == 0
   end function is_bound

   !> Mass of each freedom of a layer of unit mass per area
   function node_mass(batch, side, corner) result(mass)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: side
      real(wp), intent(in) :: corner(:, :)
      real(wp), allocatable :: mass(:)

      integer :: c, n

      associate (area => quad_node_area(side, corner))
         mass = [((area(n)*batch%expansion%mass_share, c=1, 3), n=1, side*side)]
      end associate
   end function node_mass

   !> Divide rows and columns by the roots of the masses
   pure subroutine scale(k, root)
      !> Stiffness
      real(wp), intent(inout) :: k(:, :)
      !> Root of the mass of each freedom
      real(wp), intent(in) :: root(:)
      integer :: j

      do j = 1, size(root)
         k(:, j) = k(:, j)/(root*root(j))
      end do
   end subroutine scale

   !> Largest eigenvalue of a symmetric matrix from below
   pure real(wp) function power_iteration(matrix) result(lambda)
      !> Symmetric, positive semi-definite
      real(wp), intent(in) :: matrix(:, :)

      real(wp) :: x(size(matrix, 1)), y(size(matrix, 1))
      integer :: i, pass

      ! a start without symmetry, the same in every run
      x(:) = [(1.0_wp + sin(real(7*i*i, wp)), i=1, size(x))]
      do pass = 1, iterations
         y(:) = matmul(matrix, x)
         x(:) = y/norm2(y)
      end do
      lambda = dot_product(x, matmul(matrix, x))
   end function power_iteration

   !> A bound on all eigenvalues, proved by Cholesky factorisation of bound - matrix
   real(wp) function certified_bound(matrix, estimate) result(bound)
      !> Symmetric, positive semi-definite
      real(wp), intent(in) :: matrix(:, :)
      !> An eigenvalue, the largest if all went well
      real(wp), intent(in) :: estimate

      bound = first_margin*estimate
      do while (.not. is_bound(matrix, bound))
         bound = next_margin*bound
      end do
   end function certified_bound

end module plydyn_element_stable_step
