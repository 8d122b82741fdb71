!> Plates from the model.
module plydyn_element_plate_make
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_columns, only : columns_type, order_group_type
   use plydyn_element_material_batch, only : new_material_batch
   use plydyn_element_plate_layers, only : history_rows, layer_batch_type, plate_type
   use plydyn_element_quad, only : plane_tables, quad_metric, tensor_order
   use plydyn_fem_expansion, only : new_expansion
   use plydyn_fem_quadrature, only : gauss_points, gauss_weights
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_layup, only : part_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: new_plate, set_quads

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
      call plane_tables(gauss_points(plate%side), plate%shape, plate%slope)
      plate%gauss_abscissa = maxval(gauss_points(plate%side))
      plate%gauss_weight = gauss_weights(plate%side)
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

   !> Layers of one order with their constants
   function new_batch(model, part, layers, order_group) result(batch)
      type(model_type), intent(in) :: model
      type(part_type), intent(in) :: part
      type(layers_type), intent(in) :: layers
      type(order_group_type), intent(in) :: order_group
      type(layer_batch_type) :: batch

      real(wp), dimension(lanes, order_group%blocks) :: angle, half
      integer :: b, k, l, material(lanes, order_group%blocks)

      material(:, :) = 0
      do b = 1, order_group%blocks
         do l = 1, lanes
            k = order_group%layer(l, b)
            if (k == 0) cycle
            half(l, b) = 0.5_wp*(layers%top(k) - layers%bottom(k))
            material(l, b) = part%plies(layers%ply(k))%material
            angle(l, b) = part%plies(layers%ply(k))%angle
         end do
      end do
      batch%material_batch_type = new_material_batch(model%materials, material, half, angle)
      batch%blocks = order_group%blocks
      batch%first = order_group%first
      batch%expansion = new_expansion(order_group%order, layers%lobatto)
      batch%layer = order_group%layer
      do k = 1, size(batch%laws)
         associate (law => batch%laws(k)%law)
            batch%intact_histories = max(batch%intact_histories, &
               & min(law%intact_histories, law%histories))
         end associate
      end do
   end function new_batch

end module plydyn_element_plate_make
