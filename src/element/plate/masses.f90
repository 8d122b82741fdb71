!> Lumped masses: the mass of each layer shared among its points.
module plydyn_element_plate_masses
   use plydyn_base_precision, only : lanes, wp
   use plydyn_fem_columns, only : columns_type
   use plydyn_element_plate_layers, only : plate_type
   use plydyn_element_quad, only : quad_node_area, tensor_order
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_mass_of_layer, add_masses, surface_density

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

   !> Add the masses of a part to those of the points that a rank has
   subroutine add_masses(model, p, plate, quads, local_node, columns, mass)
      !> The model
      type(model_type), intent(in) :: model
      !> Index of the part
      integer, intent(in) :: p
      !> Its layers
      type(plate_type), intent(in) :: plate
      !> All quads of the part; as `elements` in `add_masses` of `element_group_type`
      integer, intent(in) :: quads(:), local_node(:)
      type(columns_type), intent(in) :: columns
      real(wp), intent(inout) :: mass(:)

      real(wp) :: area(plate%side**2)
      real(wp), allocatable :: density(:, :)
      integer :: e, f, first, here(plate%side**2), i, node(plate%side**2)

      do f = 1, size(plate%batches)
         density = surface_density(model, p, new_layers(model%parts(p)), &
            & columns%order_groups(f)%layer)
         do e = 1, size(quads)
            node(:) = model%mesh%quad_node(tensor_order(plate%side), quads(e))
            here(:) = local_node(node)
            if (all(here == 0)) cycle
            area(:) = quad_node_area(plate%side, model%mesh%position(1:2, node))
            do i = 1, size(area)
               if (here(i) == 0) cycle
               first = columns%mass_start(f, here(i))
               call add_column(plate%batches(f)%expansion%mass_share, density, area(i), &
                  & mass(first:))
            end do
         end do
      end do
   end subroutine add_masses

   !> Add a share of the mass of one layer of a part's quads to the points that a rank has
   subroutine add_mass_of_layer(model, p, layer, share, quads, local_node, columns, mass)
      !> The model
      type(model_type), intent(in) :: model
      !> Index of the part, and the layer, from the bottom up
      integer, intent(in) :: p, layer
      !> Share for each quad of the mesh
      real(wp), intent(in) :: share(:)
      !> As in `add_masses`
      integer, intent(in) :: quads(:), local_node(:)
      type(columns_type), intent(in) :: columns
      real(wp), intent(inout) :: mass(:)

      real(wp) :: area(size(model%mesh%quad_node, 1)), density
      integer :: e, i, node(size(model%mesh%quad_node, 1)), side, t

      side = nint(sqrt(real(size(node), wp)))
      density = layer_density(model, p, new_layers(model%parts(p)), layer)
      associate (expansion => columns%order_groups(columns%layer_slot(1, layer))%expansion)
         do e = 1, size(quads)
            if (share(quads(e)) <= 0.0_wp) cycle
            node(:) = model%mesh%quad_node(tensor_order(side), quads(e))
            if (all(local_node(node) == 0)) cycle
            area(:) = quad_node_area(side, model%mesh%position(1:2, node))
            do i = 1, size(node)
               if (local_node(node(i)) == 0) cycle
               do t = 1, size(expansion%mass_share)
                  associate (m => mass(columns%mass_of(layer, t, local_node(node(i)))))
                     m = m + share(quads(e))*area(i)*expansion%mass_share(t)*density
                  end associate
               end do
            end do
         end do
      end associate
   end subroutine add_mass_of_layer

   !> Share the mass above a piece of the plane among the points of a column
   pure subroutine add_column(share, density, area, mass)
      !> Share of each point of the thickness
      real(wp), intent(in) :: share(:)
      !> Mass per area of the layers
      real(wp), intent(in) :: density(:, :)
      !> Area of the piece
      real(wp), intent(in) :: area
      !> Masses of the column
      real(wp), intent(inout) :: mass(size(density), *)

      integer :: t

      do t = 1, size(share)
         mass(:, t) = mass(:, t) + area*share(t)*reshape(density, [size(density)])
      end do
   end subroutine add_column

end module plydyn_element_plate_masses
