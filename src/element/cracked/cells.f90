!> Quads of a crack zone as two wedges in each ply, and which of two columns each of their corners
!> belongs to.
!>
!> The fibres of a ply lie along an edge or a diagonal of the quads. A ply with fibres along a
!> diagonal is divided along them, any other ply along either diagonal by turns. So no crack passes
!> through a wedge: seen from a wedge, a doubled corner is either its node or the twin of that.
!> Corners are in tensor order. The first wedge of a quad has its corners 1 and 2, the second one 3
!> and 4, and with each goes the end of the other edge at which the diagonal does not end.
module plydyn_element_cracked_cells
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_plate_layers, only : plate_type
   use plydyn_element_quad, only : tensor_order
   use plydyn_model_crack_zone, only : by_turns, crack_zone_type, first_diagonal, sees_twin
   use plydyn_model_mesh, only : mesh_type
   implicit none
   private

   public :: new_cells, set_cells, wedge_metric

   !> Corners and wedges of a quad
   integer, parameter, public :: corners = 4, wedges = 2

   !> What the wedges of a plate need beside the plate
   type, public :: cells_type
      !> Twin of each corner, the corner itself where it has none, (4, quads); columns that take
      !> the forces on them
      integer, allocatable :: twin(:, :), twin_target(:, :)
      !> Whether any corner of a quad has a twin
      logical, allocatable :: is_doubled(:)
      !> 1 where a wedge has the twin of a corner, else 0, (lanes, corners, wedges, blocks, quads)
      real(wp), allocatable :: sees(:, :, :, :, :)
      !> 1 where the diagonal from the first corner divides the quad, else 0, (lanes, blocks,
      !> parities); parity of each quad
      real(wp), allocatable :: first(:, :, :)
      integer, allocatable :: parity(:)
   end type cells_type

contains

   !> Divide the quads of a plate
   pure function new_cells(zone, ply, plate) result(self)
      !> The zone
      type(crack_zone_type), intent(in) :: zone
      !> Ply of each layer
      integer, intent(in) :: ply(:)
      !> Its plate, of one batch
      type(plate_type), intent(in) :: plate
      type(cells_type) :: self

      integer :: b, l

      associate (layer => plate%batches(1)%layer)
         allocate (self%first(lanes, size(layer, 2), 2), source=0.0_wp)
         do b = 1, size(layer, 2)
            do l = 1, lanes
               if (layer(l, b) == 0) cycle
               associate (diagonal => zone%plies(ply(layer(l, b)))%diagonal)
                  if (diagonal == first_diagonal) self%first(l, b, :) = 1.0_wp
                  if (diagonal == by_turns) self%first(l, b, 1) = 1.0_wp
               end associate
            end do
         end do
      end associate
   end function new_cells

   !> Derivatives of the shares of both edges along x and y, and area, of each wedge of some quads,
   !> (5, wedges, quads)
   pure function wedge_metric(zone, quads) result(metric)
      !> The zone
      type(crack_zone_type), intent(in) :: zone
      !> How many quads
      integer, intent(in) :: quads
      real(wp) :: metric(5, wedges, quads)

      real(wp) :: area

      associate (edge => zone%edge)
         area = edge(1, 1)*edge(2, 2) - edge(1, 2)*edge(2, 1)
         metric(:, :, :) = spread(spread([edge(2, 2)/area, -edge(1, 2)/area, -edge(2, 1)/area, &
            & edge(1, 1)/area, 0.5_wp*area], 2, wedges), 3, quads)
      end associate
   end function wedge_metric

   !> Find the twins of the corners of all quads
   pure subroutine set_cells(mesh, zone, ply, local_node, plate, self)
      type(mesh_type), intent(in) :: mesh
      type(crack_zone_type), intent(in) :: zone
      !> Ply of each layer; the rank's number of each node of the mesh
      integer, intent(in) :: ply(:), local_node(:)
      !> Has its quads
      type(plate_type), intent(in) :: plate
      !> Divided; gets twins
      type(cells_type), intent(inout) :: self

      real(wp) :: direction(2)
      integer :: b, c, e, l, node(corners), w

      associate (layer => plate%batches(1)%layer, quads => size(plate%quad))
         self%twin = plate%node
         allocate (self%is_doubled(quads), self%parity(quads))
         allocate (self%sees(lanes, corners, wedges, size(layer, 2), quads), source=0.0_wp)
         do e = 1, quads
            node(:) = mesh%quad_node(tensor_order(2), plate%quad(e))
            self%parity(e) = 1 + modulo(row_of(zone, mesh%position(:2, node(1))), 2)
            do c = 1, corners
               if (mesh%twin(node(c)) > 0) self%twin(c, e) = local_node(mesh%twin(node(c)))
               do w = 1, wedges
                  do b = 1, size(layer, 2)
                     do l = 1, lanes
                        if (layer(l, b) == 0) cycle
                        direction(:) = towards(zone%edge, c, w, self%first(l, b, self%parity(e)))
                        if (.not. sees_twin(zone, ply(layer(l, b)), node(c), direction)) cycle
                        self%sees(l, c, w, b, e) = 1.0_wp
                     end do
                  end do
               end do
            end do
            self%is_doubled(e) = any(self%sees(:, :, :, :, e) > 0.0_wp)
         end do
      end associate
      self%twin_target = self%twin
   end subroutine set_cells

   !> Number of the row of quads along the first edge that begins at a place
   pure integer function row_of(zone, position) result(row)
      type(crack_zone_type), intent(in) :: zone
      real(wp), intent(in) :: position(2)

      real(wp) :: away(2)

      away(:) = position - zone%origin
      associate (a => zone%edge(:, 1), b => zone%edge(:, 2))
         row = nint((a(1)*away(2) - a(2)*away(1))/(a(1)*b(2) - a(2)*b(1)))
      end associate
   end function row_of

   !> From a corner to the middle of a wedge
   pure function towards(edge, corner, wedge, first) result(direction)
      real(wp), intent(in) :: edge(2, 2)
      integer, intent(in) :: corner, wedge
      !> 1 where the diagonal from the first corner divides the quad
      real(wp), intent(in) :: first
      real(wp) :: direction(2)

      ! shares of the edges
      real(wp) :: middle(2)

      middle(1) = merge(2.0_wp, 1.0_wp, (first > 0.0_wp) .eqv. wedge == 1)/3.0_wp
      middle(2) = merge(1.0_wp, 2.0_wp, wedge == 1)/3.0_wp
      direction(:) = matmul(edge, middle - real([merge(0, 1, mod(corner, 2) == 1), &
         & merge(0, 1, corner <= 2)], wp))
   end function towards

end module plydyn_element_cracked_cells
