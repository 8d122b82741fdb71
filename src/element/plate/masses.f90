!> Lumped masses: the mass of each layer shared among its points.
module plydyn_element_plate_masses
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_columns, only : columns_type
   use plydyn_element_quad, only : quad_node_area, tensor_order
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_masses, surface_density

contains

   !> Mass per area of the layers in a batch, (lanes, blocks)
   pure function surface_density(model, p, layers, layer) result(density)
      !> The model
      type(model_type), intent(in) :: model
      !> Index of the part
      integer, intent(in) :: p
      !> Layers of the part
      type(layers_type), intent(in) :: layers
      !> Layer in each lane, 0 for none
      integer, intent(in) :: layer(:, :)
      real(wp) :: density(size(layer, 1), size(layer, 2))

      integer :: b, k, l

      density(:, :) = 0.0_wp
      do b = 1, size(layer, 2)
         do l = 1, lanes
            k = layer(l, b)
            if (k > 0) density(l, b) = layer_density(model, p, layers, k)
         end do
      end do
   end function surface_density

   !> Mass per area of one layer
   pure real(wp) function layer_density(model, p, layers, k) result(density)
      !> As in `surface_density`
      type(model_type), intent(in) :: model
      integer, intent(in) :: p
      type(layers_type), intent(in) :: layers
      !> The layer
      integer, intent(in) :: k

      associate (ply => model%parts(p)%plies(layers%ply(k)))
         density = model%materials(ply%material)%density*(layers%top(k) - layers%bottom(k))
      end associate
   end function layer_density

   !> Add the masses of a part, or a share of the mass of one layer, to those of the points that a
   !> rank has
   subroutine add_masses(model, p, quads, local_node, columns, mass, layer, share)
      !> The model
      type(model_type), intent(in) :: model
      !> Index of the part
      integer, intent(in) :: p
      !> All quads of the part; this and the rest as in `add_masses` of `element_group_type`
      integer, intent(in) :: quads(:), local_node(:)
      type(columns_type), intent(in) :: columns
      real(wp), intent(inout) :: mass(:)
      integer, intent(in), optional :: layer
      real(wp), intent(in), optional :: share(:)

      real(wp) :: area(size(model%mesh%quad_node, 1)), part
      integer :: e, node(size(area)), side
      type(layers_type) :: layers

      layers = new_layers(model%parts(p))
      side = nint(sqrt(real(size(area), wp)))
      part = 1.0_wp
      do e = 1, size(quads)
         if (present(share)) part = share(quads(e))
         if (part <= 0.0_wp) cycle
         node(:) = model%mesh%quad_node(tensor_order(side), quads(e))
         if (all(local_node(node) == 0)) cycle
         area(:) = part*quad_node_area(side, model%mesh%position(1:2, node))
         call add_quad(model, p, layers, area, local_node(node), columns, mass, layer)
      end do
   end subroutine add_masses

   !> Add the masses of all layers over a quad, or of one
   pure subroutine add_quad(model, p, layers, area, node, columns, mass, layer)
      type(model_type), intent(in) :: model
      integer, intent(in) :: p
      type(layers_type), intent(in) :: layers
      !> Area of each node of the quad
      real(wp), intent(in) :: area(:)
      !> The rank's numbers of the nodes
      integer, intent(in) :: node(:)
      type(columns_type), intent(in) :: columns
      real(wp), intent(inout) :: mass(:)
      integer, intent(in), optional :: layer

      real(wp) :: density
      integer :: i, k, t

      do k = 1, size(layers%order)
         if (present(layer)) then
            if (k /= layer) cycle
         end if
         density = layer_density(model, p, layers, k)
         associate (share => columns%order_groups(columns%layer_slot(1, k))%expansion%mass_share)
            do i = 1, size(node)
               if (node(i) == 0) cycle
               do t = 1, size(share)
                  associate (m => mass(columns%mass_of(k, t, node(i))))
                     m = m + area(i)*share(t)*density
                  end associate
               end do
            end do
         end associate
      end do
   end subroutine add_quad

end module plydyn_element_plate_masses
