!> Lumped masses of a crack zone: each half of each corner of a quad goes to the column that it
!> belongs to in each ply, as its share of the interfaces does.
module plydyn_element_cracked_masses
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_plate_masses, only : surface_density
   use plydyn_element_quad, only : tensor_order
   use plydyn_fem_columns, only : columns_type
   use plydyn_model_crack_zone, only : corner_direction, crack_zone_type, sees_twin
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_wedge_masses

contains

   !> Add the masses of a zone to those of the points that a rank has
   subroutine add_wedge_masses(model, zone, quads, local_node, columns, mass)
      !> The model and one of its zones
      type(model_type), intent(in) :: model
      type(crack_zone_type), intent(in) :: zone
      !> All quads of the zone; as `elements` in `add_masses` of `element_group_type`
      integer, intent(in) :: quads(:), local_node(:)
      type(columns_type), intent(in) :: columns
      real(wp), intent(inout) :: mass(:)

      real(wp), allocatable :: density(:, :)
      real(wp) :: area
      integer :: c, e, h, node(4)
      type(layers_type) :: layers

      layers = new_layers(model%parts(zone%part))
      density = surface_density(model, zone%part, layers, columns%order_groups(1)%layer)
      area = abs(zone%edge(1, 1)*zone%edge(2, 2) - zone%edge(1, 2)*zone%edge(2, 1))
      do e = 1, size(quads)
         node(:) = model%mesh%quad_node(tensor_order(2), quads(e))
         do c = 1, size(node)
            if (local_node(node(c)) == 0) cycle
            do h = 1, 2
               call add_half(corner_direction(zone%edge, c, h), node(c))
            end do
         end do
      end do
   contains
      !> Add one half of a corner
      subroutine add_half(direction, corner)
         real(wp), intent(in) :: direction(2)
         integer, intent(in) :: corner
         integer :: b, l, taker, t

         associate (layer => columns%order_groups(1)%layer)
            do b = 1, size(layer, 2)
               do l = 1, lanes
                  if (layer(l, b) == 0) cycle
                  taker = corner
                  if (sees_twin(zone, layers%ply(layer(l, b)), corner, direction)) then
                     taker = model%mesh%twin(corner)
                  end if
                  do t = 1, 2
                     associate (m => mass(columns%mass_of(layer(l, b), t, local_node(taker))))
                        m = m + 0.5_wp*(0.125_wp*area)*density(l, b)
                     end associate
                  end do
               end do
            end do
         end associate
      end subroutine add_half
   end subroutine add_wedge_masses

end module plydyn_element_cracked_masses
