!> Layer-wise plates as flat arrays: the quads of a part, and its layers by their order.
module plydyn_element_plate_layers
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_least_volume, only : least_volume_type
   use plydyn_fem_expansion, only : expansion_type
   use plydyn_law_law, only : block_law_type
   implicit none
   private

   public :: batch_stiffness, elastic_stress, first_degree, history_rows

   !> Layers of one order over all quads of a part, eight side by side
   type, public :: layer_batch_type
      !> Blocks of layers above a quad, each of as many layers as there are lanes
      integer :: blocks = 0
      !> First of its points in the column of the first node, and the length of a column
      integer :: first = 0, height = 0
      !> Layer in each lane, counted from the bottom of the part; 0 where there is none
      integer, allocatable :: layer(:, :)
      !> Tables of the expansion
      type(expansion_type) :: expansion
      !> Stiffness in the axes of the plate times half the thickness, (lanes, 13, blocks):
      !> C11 C12 C13 C14 C22 C23 C24 C33 C34 C44 C55 C56 C66; zero in lanes without a layer
      real(wp), allocatable :: stiffness(:, :, :)
      !> Half the thickness, and 2 over the thickness, (lanes, blocks)
      real(wp), allocatable :: half_thickness(:, :), two_over_h(:, :)
      !> Cosine and sine of the fibre direction, (lanes, 2, blocks)
      real(wp), allocatable :: rotation(:, :, :)
      !> Laws of the layers; none where all are elastic
      type(block_law_type), allocatable :: laws(:)
      !> History variables of a Gauss point, and where those of this batch begin in the state
      integer :: histories = 0, first_history = 0
      !> Those that an intact point has, the first ones; the others are zero there
      integer :: intact_histories = 0
      !> Rows of the history from one variable of a Gauss point to the next: all points of all quads
      integer :: pitch = 0
   end type layer_batch_type

   !> A part: its quads and its layers
   type, public :: plate_type
      !> Nodes along a side of a quad
      integer :: side = 0
      !> Index of each quad in the mesh
      integer, allocatable :: quad(:)
      !> Nodes of each quad in tensor order, (side**2, quads)
      integer, allocatable :: node(:, :)
      !> Columns that take the forces of each quad: those of its nodes, or others behind them; less
      !> than 0 where no quad before has added to one
      integer, allocatable :: target(:, :)
      !> Geometry of each quad at its Gauss points, (5, side**2, quads); see `quad_metric`
      real(wp), allocatable :: metric(:, :, :)
      !> Distance of the outer Gauss points from the middle of the quad
      real(wp) :: gauss_abscissa = 0.0_wp
      !> Shape functions at the Gauss points, (points, nodes), and their derivatives along xi and
      !> eta, (2, nodes, points)
      real(wp), allocatable :: shape(:, :), slope(:, :, :)
      !> Fibre direction of each layer, degrees from the x axis
      real(wp), allocatable :: angle(:)
      !> Layers by their order
      type(layer_batch_type), allocatable :: batches(:)
   end type plate_type

   !> The kernels of one side and order. They stand beside the plate: gfortran 12 misplaces
   !> procedure pointers in a type that their own arguments have
   type, public :: kernels_type
      !> Forces with linear strain, with large displacement, and by laws of plies
      procedure(forces), pointer, nopass :: linear => null(), large => null()
      procedure(law_forces), pointer, nopass :: law => null()
      !> Least ratio of volumes
      procedure(least_volume), pointer, nopass :: least_volume => null()
   end type kernels_type

   !> Place of C33 among the constants of a stiffness
   integer, parameter, public :: c33 = 8
   !> The constants of a monoclinic stiffness that kernels use, by row and column
   integer, parameter :: row(13) = [1, 1, 1, 1, 2, 2, 2, 3, 3, 4, 5, 5, 6]
   integer, parameter :: column(13) = [1, 2, 3, 4, 2, 3, 4, 3, 4, 4, 5, 6, 6]

   abstract interface
      !> Subtract the forces of elastic layers over some quads
      pure subroutine forces(plate, number, quads, displacement, force)
         import :: lanes, plate_type, wp
         implicit none
         !> The part
         type(plate_type), intent(in) :: plate
         !> Batch of the part; first and last quad
         integer, intent(in) :: number, quads(2)
         !> Displacement of the points of the batch
         real(wp), intent(in) :: displacement(lanes, plate%batches(number)%height/lanes, *)
         !> Force on them
         real(wp), intent(inout) :: force(lanes, plate%batches(number)%height/lanes, *)
      end subroutine forces

      !> Subtract the forces of layers with laws over some quads
      pure subroutine law_forces(plate, number, quads, large, step, displacement, history, force)
         import :: lanes, plate_type, wp
         implicit none
         !> As in `forces`
         type(plate_type), intent(in) :: plate
         integer, intent(in) :: number, quads(2)
         !> Time step, and whether displacements are large (total Lagrangian)
         real(wp), intent(in) :: step
         logical, intent(in) :: large
         !> History of the batch, one variable of all Gauss points after the other
         real(wp), intent(inout) :: history(lanes, plate%batches(number)%pitch, *)
         real(wp), intent(in) :: displacement(lanes, plate%batches(number)%height/lanes, *)
         real(wp), intent(inout) :: force(lanes, plate%batches(number)%height/lanes, *)
      end subroutine law_forces

      !> Find the least ratio of volumes over some quads
      pure subroutine least_volume(plate, number, quads, displacement, least)
         import :: lanes, least_volume_type, plate_type, wp
         implicit none
         !> As in `forces`
         type(plate_type), intent(in) :: plate
         integer, intent(in) :: number, quads(2)
         real(wp), intent(in) :: displacement(lanes, plate%batches(number)%height/lanes, *)
         !> Least ratio so far
         type(least_volume_type), intent(inout) :: least
      end subroutine least_volume
   end interface

contains

   !> The constants of a stiffness in the order that kernels use
   pure function batch_stiffness(stiffness) result(constants)
      !> Stiffness in the axes of the plate; a plane of symmetry across z
      real(wp), intent(in) :: stiffness(6, 6)
      real(wp) :: constants(13)
      integer :: i

      constants(:) = [(stiffness(row(i), column(i)), i=1, 13)]
   end function batch_stiffness

   !> Degree of freedom of the first layer of a block; those of its other lanes follow
   elemental integer function first_degree(batch, block, node, level, direction) result(first)
      !> The layers
      type(layer_batch_type), intent(in) :: batch
      !> Block of layers, node of the plate, level from the bottom of the layer, direction
      integer, intent(in) :: block, node, level, direction

      associate (levels => batch%expansion%order + 1)
         first = batch%height*(node - 1) + batch%first + lanes*(block - 1 &
            & + batch%blocks*(level - 1 + levels*(direction - 1)))
      end associate
   end function first_degree

   !> Rows of a variable of the history in a quad: its Gauss points, those of a block together
   elemental integer function history_rows(batch, side) result(rows)
      !> The layers
      type(layer_batch_type), intent(in) :: batch
      !> Nodes along a side
      integer, intent(in) :: side

      rows = (batch%expansion%order + 1)*side**2*batch%blocks
   end function history_rows

   !> Stress of elastic layers times half of their thickness
   pure subroutine elastic_stress(k, e, s)
      !> Stiffness times half the thickness, of a block of `layer_batch_type`
      real(wp), intent(in) :: k(lanes, 13)
      !> Strain in the axes of the plate
      real(wp), intent(in) :: e(lanes, 6)
      !> Stress there times half the thickness
      real(wp), intent(out) :: s(lanes, 6)

      integer :: l

      !$omp simd
      do l = 1, lanes
         s(l, 1) = k(l, 1)*e(l, 1) + k(l, 2)*e(l, 2) + k(l, 3)*e(l, 3) + k(l, 4)*e(l, 4)
         s(l, 2) = k(l, 2)*e(l, 1) + k(l, 5)*e(l, 2) + k(l, 6)*e(l, 3) + k(l, 7)*e(l, 4)
         s(l, 3) = k(l, 3)*e(l, 1) + k(l, 6)*e(l, 2) + k(l, 8)*e(l, 3) + k(l, 9)*e(l, 4)
         s(l, 4) = k(l, 4)*e(l, 1) + k(l, 7)*e(l, 2) + k(l, 9)*e(l, 3) + k(l, 10)*e(l, 4)
         s(l, 5) = k(l, 11)*e(l, 5) + k(l, 12)*e(l, 6)
         s(l, 6) = k(l, 12)*e(l, 5) + k(l, 13)*e(l, 6)
      end do
   end subroutine elastic_stress

end module plydyn_element_plate_layers
