!> Plates from the model.
module plydyn_element_plate_make
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_columns, only : columns_type, order_group_type
   use plydyn_element_laws, only : new_laws
   use plydyn_element_plate_layers, only : batch_stiffness, history_rows, layer_batch_type, &
      & plate_type
   use plydyn_element_quad, only : plane_table, quad_metric, tensor_order
   use plydyn_fem_expansion, only : new_expansion
   use plydyn_fem_quadrature, only : gauss_points
   use plydyn_law_ply_elastic, only : turned_stiffness
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_layup, only : part_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: gauss_tables, new_plate, set_quads

contains

   !> The layers of one part, still without quads
   function new_plate(model, p, columns) result(plate)
      !> The model
      type(model_type), intent(in) :: model
      !> Index of the part
      integer, intent(in) :: p
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      type(plate_type) :: plate

      type(layers_type) :: layers
      integer :: f

      plate%side = nint(sqrt(real(size(model%mesh%quad_node, 1), wp)))
      call gauss_tables(plate%side, plate%shape, plate%slope)
      plate%gauss_abscissa = maxval(gauss_points(plate%side))
      layers = new_layers(model%parts(p))
      plate%angle = model%parts(p)%plies(layers%ply)%angle
      allocate (plate%batches(size(columns%order_groups)))
      do f = 1, size(columns%order_groups)
         plate%batches(f) = new_batch(model, model%parts(p), layers, columns%order_groups(f))
         plate%batches(f)%height = columns%height
      end do
   end function new_plate

   !> Give a plate its quads
   pure subroutine set_quads(model, quads, local_node, plate)
      !> The model
      type(model_type), intent(in) :: model
      !> The quads, indices into the mesh
      integer, intent(in) :: quads(:)
      !> The rank's number of each node of the mesh, 0 where it does not have it
      integer, intent(in) :: local_node(:)
      !> The plate; its targets are the nodes
      type(plate_type), intent(inout) :: plate

      integer :: e, node(plate%side**2)

      plate%quad = quads
      allocate (plate%node(size(node), size(quads)), plate%metric(5, size(node), size(quads)))
      do e = 1, size(quads)
         node(:) = model%mesh%quad_node(tensor_order(plate%side), quads(e))
         plate%node(:, e) = local_node(node)
         plate%metric(:, :, e) = quad_metric(plate%side, model%mesh%position(1:2, node))
      end do
      plate%target = plate%node
      plate%batches%pitch = history_rows(plate%batches, plate%side)*size(quads)
   end subroutine set_quads

   !> Shape functions and their derivatives along xi and eta at the Gauss points of a quad
   pure subroutine gauss_tables(side, shape, slope)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Shape functions, (points, nodes)
      real(wp), allocatable, intent(out) :: shape(:, :)
      !> Derivatives, (2, nodes, points)
      real(wp), allocatable, intent(out) :: slope(:, :, :)

      real(wp) :: gauss(side)
      integer :: i, j, q

      gauss(:) = gauss_points(side)
      allocate (shape(side**2, side**2), slope(2, side**2, side**2))
      do j = 1, side
         do i = 1, side
            q = i + side*(j - 1)
            call plane_table(side, gauss(i), gauss(j), shape(q, :), slope(:, :, q))
         end do
      end do
   end subroutine gauss_tables

   !> Layers of one order with their constants
   function new_batch(model, part, layers, order_group) result(batch)
      type(model_type), intent(in) :: model
      type(part_type), intent(in) :: part
      type(layers_type), intent(in) :: layers
      type(order_group_type), intent(in) :: order_group
      type(layer_batch_type) :: batch

      real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp
      real(wp) :: half
      integer :: b, k, l, material(lanes, order_group%blocks)

      batch%blocks = order_group%blocks
      batch%first = order_group%first
      batch%expansion = new_expansion(order_group%order, layers%lobatto)
      batch%layer = order_group%layer
      allocate (batch%stiffness(lanes, 13, order_group%blocks), &
         & batch%rotation(lanes, 2, order_group%blocks), source=0.0_wp)
      allocate (batch%half_thickness(lanes, order_group%blocks), &
         & batch%two_over_h(lanes, order_group%blocks), source=0.0_wp)
      material(:, :) = 0
      do b = 1, order_group%blocks
         do l = 1, lanes
            k = order_group%layer(l, b)
            if (k == 0) cycle
            half = 0.5_wp*(layers%top(k) - layers%bottom(k))
            batch%half_thickness(l, b) = half
            batch%two_over_h(l, b) = 1.0_wp/half
            associate (ply => part%plies(layers%ply(k)))
               material(l, b) = ply%material
               batch%rotation(l, :, b) = [cos(ply%angle*degree), sin(ply%angle*degree)]
               batch%stiffness(l, :, b) = half*batch_stiffness(turned_stiffness( &
                  & model%materials(ply%material)%law, ply%angle))
            end associate
         end do
      end do
      batch%laws = new_laws(model%materials, material)
      do k = 1, size(batch%laws)
         associate (law => batch%laws(k)%law)
            batch%histories = max(batch%histories, law%histories)
            batch%intact_histories = max(batch%intact_histories, &
               & min(law%intact_histories, law%histories))
         end associate
      end do
   end function new_batch

end module plydyn_element_plate_make
