!> Layer-wise plates: the layers of a part over its quads, and the one way to their kernels.
module plydyn_element_plate
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_plate_q4_le1, only : large_q4_le1 => add_large_forces, &
      & law_q4_le1 => add_law_forces, linear_q4_le1 => add_linear_forces
   use plydyn_element_plate_q4_le2, only : large_q4_le2 => add_large_forces, &
      & law_q4_le2 => add_law_forces, linear_q4_le2 => add_linear_forces
   use plydyn_element_plate_q4_le3, only : large_q4_le3 => add_large_forces, &
      & law_q4_le3 => add_law_forces, linear_q4_le3 => add_linear_forces
   use plydyn_element_plate_q4_le4, only : large_q4_le4 => add_large_forces, &
      & law_q4_le4 => add_law_forces, linear_q4_le4 => add_linear_forces
   use plydyn_element_plate_q9_le1, only : large_q9_le1 => add_large_forces, &
      & law_q9_le1 => add_law_forces, linear_q9_le1 => add_linear_forces
   use plydyn_element_plate_q9_le2, only : large_q9_le2 => add_large_forces, &
      & law_q9_le2 => add_law_forces, linear_q9_le2 => add_linear_forces
   use plydyn_element_plate_q9_le3, only : large_q9_le3 => add_large_forces, &
      & law_q9_le3 => add_law_forces, linear_q9_le3 => add_linear_forces
   use plydyn_element_plate_q9_le4, only : large_q9_le4 => add_large_forces, &
      & law_q9_le4 => add_law_forces, linear_q9_le4 => add_linear_forces
   use plydyn_fem_expansion, only : expansion_type
   use plydyn_law_law, only : block_law_type
   implicit none
   private

   public :: add_elastic_forces, add_layer_forces, batch_stiffness, history_pitch, history_rows

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
      real(wp), allocatable :: half(:, :), slant(:, :)
      !> Cosine and sine of the fibre direction, (lanes, 2, blocks)
      real(wp), allocatable :: turn(:, :, :)
      !> Laws of the layers; none where all are elastic
      type(block_law_type), allocatable :: laws(:)
      !> History variables of a Gauss point, and where those of this batch begin in the state
      integer :: histories = 0, first_history = 0
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
      real(wp) :: reach = 0.0_wp
      !> Shape functions at the Gauss points, (points, nodes), and their derivatives along xi and
      !> eta, (2, nodes, points)
      real(wp), allocatable :: shape(:, :), slope(:, :, :)
      !> Fibre direction of each layer, degrees from the x axis
      real(wp), allocatable :: angle(:)
      !> Layers by their order
      type(layer_batch_type), allocatable :: batches(:)
   end type plate_type

   !> The constants of a monoclinic stiffness that kernels use, by row and column
   integer, parameter :: row(13) = [1, 1, 1, 1, 2, 2, 2, 3, 3, 4, 5, 5, 6]
   integer, parameter :: column(13) = [1, 2, 3, 4, 2, 3, 4, 3, 4, 4, 5, 6, 6]

contains

   !> The constants of a stiffness in the order that kernels use
   pure function batch_stiffness(stiffness) result(constants)
      !> Stiffness in the axes of the plate; a plane of symmetry across z
      real(wp), intent(in) :: stiffness(6, 6)
      real(wp) :: constants(13)
      integer :: i

      constants(:) = [(stiffness(row(i), column(i)), i=1, 13)]
   end function batch_stiffness

   !> Subtract the internal forces of some quads of a batch of layers
   pure subroutine add_layer_forces(plate, b, quads, large, step, displacement, history, force)
      !> The part
      type(plate_type), intent(in) :: plate
      !> Batch of the part
      integer, intent(in) :: b
      !> First and last quad
      integer, intent(in) :: quads(2)
      !> Large displacement (total Lagrangian) instead of linear strain
      logical, intent(in) :: large
      !> Time step
      real(wp), intent(in) :: step
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> History of all Gauss points; those of a batch are
      !> (lanes, levels, points of the plane, blocks, quads, histories)
      real(wp), intent(inout), contiguous :: history(:)
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)

      integer :: first_history

      associate (batch => plate%batches(b), node => plate%node(:, quads(1):quads(2)), &
         & target => plate%target(:, quads(1):quads(2)), &
         & metric => plate%metric(:, :, quads(1):quads(2)), &
         & u => displacement(plate%batches(b)%first:), f => force(plate%batches(b)%first:))
         if (size(batch%laws) > 0) then
            first_history = batch%first_history &
               & + lanes*history_rows(batch, plate%side)*(quads(1) - 1)
            call add_law(batch, plate%side, size(node, 2), node, target, metric, &
               & history_pitch(plate, batch), large, step, u, history(first_history:), f)
         else if (large) then
            call add_large(batch, plate%side, size(node, 2), node, target, metric, u, f)
         else
            call add_linear(batch, plate%side, size(node, 2), node, target, batch%height/lanes, &
               & metric, u, f)
         end if
      end associate
   end subroutine add_layer_forces

   !> Rows of a variable of the history in a quad: its Gauss points, those of a block together
   pure integer function history_rows(batch, side) result(rows)
      !> The layers
      type(layer_batch_type), intent(in) :: batch
      !> Nodes along a side
      integer, intent(in) :: side

      rows = (batch%expansion%order + 1)*side**2*batch%blocks
   end function history_rows

   !> Rows of the history from one variable of a Gauss point to the next: all points of all quads
   pure integer function history_pitch(plate, batch) result(pitch)
      !> The part
      type(plate_type), intent(in) :: plate
      !> One of its batches
      type(layer_batch_type), intent(in) :: batch

      pitch = history_rows(batch, plate%side)*size(plate%node, 2)
   end function history_pitch

   !> Subtract the internal forces of elastic layers alone over one quad, with linear strain
   pure subroutine add_elastic_forces(batch, side, metric, u, f)
      !> The layers
      type(layer_batch_type), intent(in) :: batch
      !> Nodes along a side
      integer, intent(in) :: side
      !> Geometry of the quad
      real(wp), intent(in) :: metric(5, side*side)
      !> Displacement of its points, (lanes, blocks, levels, 3, nodes)
      real(wp), intent(in) :: u(*)
      !> Force on them
      real(wp), intent(inout) :: f(*)

      integer :: i, node(side*side)

      node(:) = [(i, i=1, side*side)]
      call add_linear(batch, side, 1, node, node, 3*batch%blocks*(batch%expansion%order + 1), &
         & metric, u, f)
   end subroutine add_elastic_forces

   !> To the kernel of linear strain for this side and order
   pure subroutine add_linear(batch, side, quads, node, target, rows, metric, u, f)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: side, quads, node(side*side, quads), target(side*side, quads), rows
      real(wp), intent(in) :: metric(5, side*side, quads), u(*)
      real(wp), intent(inout) :: f(*)

      associate (q => quads, n => node, t => target, r => rows, b => batch%blocks, m => metric, &
         & c => batch%stiffness, h => batch%slant, to => batch%expansion%to_mode, &
         & d => batch%expansion%mode_slope)
         select case (10*side + batch%expansion%order)
         case (21); call linear_q4_le1(q, n, t, r, b, m, c, h, to, d, u, f)
         case (22); call linear_q4_le2(q, n, t, r, b, m, c, h, to, d, u, f)
         case (23); call linear_q4_le3(q, n, t, r, b, m, c, h, to, d, u, f)
         case (24); call linear_q4_le4(q, n, t, r, b, m, c, h, to, d, u, f)
         case (31); call linear_q9_le1(q, n, t, r, b, m, c, h, to, d, u, f)
         case (32); call linear_q9_le2(q, n, t, r, b, m, c, h, to, d, u, f)
         case (33); call linear_q9_le3(q, n, t, r, b, m, c, h, to, d, u, f)
         case default; call linear_q9_le4(q, n, t, r, b, m, c, h, to, d, u, f)
         end select
      end associate
   end subroutine add_linear

   !> To the kernel of large displacement for this side and order
   pure subroutine add_large(batch, side, quads, node, target, metric, u, f)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: side, quads, node(side*side, quads), target(side*side, quads)
      real(wp), intent(in) :: metric(5, side*side, quads), u(*)
      real(wp), intent(inout) :: f(*)

      associate (q => quads, n => node, t => target, r => batch%height/lanes, &
         & b => batch%blocks, m => metric, c => batch%stiffness, h => batch%slant, &
         & w => batch%expansion%weight, to => batch%expansion%to_gauss, &
         & d => batch%expansion%gauss_slope)
         select case (10*side + batch%expansion%order)
         case (21); call large_q4_le1(q, n, t, r, b, m, c, h, w, to, d, u, f)
         case (22); call large_q4_le2(q, n, t, r, b, m, c, h, w, to, d, u, f)
         case (23); call large_q4_le3(q, n, t, r, b, m, c, h, w, to, d, u, f)
         case (24); call large_q4_le4(q, n, t, r, b, m, c, h, w, to, d, u, f)
         case (31); call large_q9_le1(q, n, t, r, b, m, c, h, w, to, d, u, f)
         case (32); call large_q9_le2(q, n, t, r, b, m, c, h, w, to, d, u, f)
         case (33); call large_q9_le3(q, n, t, r, b, m, c, h, w, to, d, u, f)
         case default; call large_q9_le4(q, n, t, r, b, m, c, h, w, to, d, u, f)
         end select
      end associate
   end subroutine add_large

   !> To the kernel of material laws for this side and order
   pure subroutine add_law(batch, side, quads, node, target, metric, pitch, large, step, u, z, f)
      type(layer_batch_type), intent(in) :: batch
      integer, intent(in) :: side, quads, node(side*side, quads), target(side*side, quads)
      !> Rows of the history from one variable to the next
      integer, intent(in) :: pitch
      logical, intent(in) :: large
      real(wp), intent(in) :: metric(5, side*side, quads), step, u(*)
      !> History and force
      real(wp), intent(inout) :: z(*), f(*)

      associate (e => quads, g => node, p => target, r => batch%height/lanes, &
         & b => batch%blocks, l => batch%laws, n => pitch, t => batch%turn, &
         & h => batch%half, s => batch%slant, w => batch%expansion%weight, &
         & to => batch%expansion%to_gauss, d => batch%expansion%gauss_slope, m => metric, &
         & k => step, y => large)
         select case (10*side + batch%expansion%order)
         case (21)
            call law_q4_le1(e, g, p, r, b, m, l, n, t, h, s, w, to, d, y, k, u, z, f)
         case (22)
            call law_q4_le2(e, g, p, r, b, m, l, n, t, h, s, w, to, d, y, k, u, z, f)
         case (23)
            call law_q4_le3(e, g, p, r, b, m, l, n, t, h, s, w, to, d, y, k, u, z, f)
         case (24)
            call law_q4_le4(e, g, p, r, b, m, l, n, t, h, s, w, to, d, y, k, u, z, f)
         case (31)
            call law_q9_le1(e, g, p, r, b, m, l, n, t, h, s, w, to, d, y, k, u, z, f)
         case (32)
            call law_q9_le2(e, g, p, r, b, m, l, n, t, h, s, w, to, d, y, k, u, z, f)
         case (33)
            call law_q9_le3(e, g, p, r, b, m, l, n, t, h, s, w, to, d, y, k, u, z, f)
         case default
            call law_q9_le4(e, g, p, r, b, m, l, n, t, h, s, w, to, d, y, k, u, z, f)
         end select
      end associate
   end subroutine add_law

end module plydyn_element_plate
