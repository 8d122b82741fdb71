!> Crack bands of the damaged plies of a plate.
module plydyn_element_plate_crack_bands
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_crack_bands, only : add_band_points, crack_band_type
   use plydyn_element_plate_layers, only : layer_batch_type, plate_type
   use plydyn_element_plate_initial_history, only : band_lengths
   use plydyn_model_layers, only : layers_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_batch_bands

contains

   !> Add the bands of a batch of layers of a part
   subroutine add_batch_bands(model, layers, group, plate, batch, bands)
      !> The model
      type(model_type), intent(in) :: model
      !> Layers of the laminate
      type(layers_type), intent(in) :: layers
      !> Part of the model, and element group of the plate
      integer, intent(in) :: group(2)
      !> The plate and its batch
      type(plate_type), intent(in) :: plate
      type(layer_batch_type), intent(in) :: batch
      !> Bands of each material
      type(crack_band_type), intent(inout) :: bands(:)

      real(wp) :: length(lanes, 2)
      integer :: e, k, q

      do k = 1, size(batch%laws)
         associate (law => batch%laws(k)%law, block => batch%laws(k)%block)
            if (all(law%band_rule == 0)) cycle
            do e = 1, size(plate%quad)
               do q = 1, size(plate%metric, 2)
                  length(:, :) = band_lengths(plate, batch%rotation(:, :, block), law, q, e)
                  call add_lanes(plate%quad(e), law%band_rule, batch%layer(:, block))
               end do
            end do
         end associate
      end do
   contains
      !> Add the points above each other in the layer of each lane
      subroutine add_lanes(quad, rule, layer)
         integer, intent(in) :: quad, rule(lanes), layer(lanes)

         integer :: l, ply

         do l = 1, lanes
            if (rule(l) == 0 .or. layer(l) == 0) cycle
            ply = layers%ply(layer(l))
            associate (material => model%parts(group(1))%plies(ply)%material)
               call add_band_points(model%materials(material), [quad, ply, group(2)], &
                  & length(l, :), batch%expansion%order + 1, bands(material))
            end associate
         end do
      end subroutine add_lanes
   end subroutine add_batch_bands

end module plydyn_element_plate_crack_bands
