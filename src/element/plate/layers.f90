!> Layer-wise plates as flat arrays: the quads of a part, and its layers by their order.
module plydyn_element_plate_layers
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_least_volume, only : least_volume_type
   use plydyn_element_material_batch, only : c33, material_batch_type
   use plydyn_fem_expansion, only : expansion_type
   implicit none
   private

   public :: first_degree, history_rows, layer_springs

   !> Layers of one order over all quads of a part, eight side by side
   type, public, extends(material_batch_type) :: layer_batch_type
      !> Blocks of layers above a quad, each of as many layers as there are lanes
      integer :: blocks = 0
      !> First of its points in the column of the first node, and the length of a column
      integer :: first = 0, height = 0
      !> Layer in each lane, counted from the bottom of the part; 0 where there is none
      integer, allocatable :: layer(:, :)
      !> Tables of the expansion
      type(expansion_type) :: expansion
      !> History variables that an intact point has, the first ones; the others are zero there
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
      !> Weights of the Gauss points along a side, (side)
      real(wp), allocatable :: gauss_weight(:)
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

   !> Places of C55, C56 and C66 among the constants of a stiffness
   integer, parameter :: c55 = 11, c56 = 12, c66 = 13

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

   !> Stiffness of a layer through its thickness per area along x, y, z; times `level_table` it acts
   !> on the levels of a column of points.
   !>
   !> Of the strain energy of a layer these are the terms in which only derivatives along z appear:
   !> C33 (dw/dz)**2 and the shear across the plate, G (du/dz)**2 and G (dv/dz)**2, integrated
   !> exactly along z and by the area of the node in the plane. Both shear directions get the larger
   !> of the two stiffnesses, so that x, y and z do not couple and nothing is stiffer than this.
   pure function layer_springs(batch, lane, block) result(spring)
      !> The layers
      type(layer_batch_type), intent(in) :: batch
      !> Which one
      integer, intent(in) :: lane, block
      real(wp) :: spring(3)

      associate (c => batch%stiffness(lane, :, block))
         spring(1:2) = 0.5_wp*(c(c55) + c(c66)) + hypot(0.5_wp*(c(c55) - c(c66)), c(c56))
         spring(3) = c(c33)
      end associate
      ! the constants are times half of the thickness
      spring(:) = spring*batch%two_over_h(lane, block)**2
   end function layer_springs

end module plydyn_element_plate_layers
