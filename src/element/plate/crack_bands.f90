!> Widths of the crack bands of plies, and the histories of their Gauss points at time zero.
module plydyn_element_plate_crack_bands
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_crack_bands, only : add_band_points, crack_band_type
   use plydyn_element_plate_layers, only : layer_batch_type, plate_type
   use plydyn_law_law, only : law_type
   use plydyn_law_ply_crack_band, only : band_length, share_average, share_bilinear, &
      & share_biquadratic
   use plydyn_model_layers, only : layers_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_batch_bands, rule_lengths, start_batch

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

   !> Let the laws of a batch of layers start their histories
   pure subroutine start_batch(plate, batch, history)
      !> The plate and its batch
      type(plate_type), intent(in) :: plate
      type(layer_batch_type), intent(in) :: batch
      !> History of the batch, thickness before plane; zero in
      real(wp), intent(inout) :: history(lanes, size(batch%expansion%weight), &
         & size(plate%metric, 2), batch%blocks, size(plate%node, 2), batch%histories)

      real(wp) :: length(lanes, 2, size(plate%metric, 2)), widest(lanes)
      integer :: e, k, m, q

      do k = 1, size(batch%laws)
         associate (block => batch%laws(k)%block, law => batch%laws(k)%law)
            do e = 1, size(plate%node, 2)
               do q = 1, size(plate%metric, 2)
                  length(:, :, q) = band_lengths(plate, batch%rotation(:, :, block), law, q, e)
               end do
               widest(:) = maxval(maxval(length, 3), 2)
               do q = 1, size(plate%metric, 2)
                  do m = 1, size(batch%expansion%weight)
                     call law%start_history(length(:, :, q), widest, &
                        & history(:, m, q, block, e, :batch%intact_histories))
                  end do
               end do
            end do
         end associate
      end do
   end subroutine start_batch

   !> Widths of the crack band at a Gauss point of the plane for fibres and for matrix, (lanes, 2);
   !> 0 in lanes that do not soften
   pure function band_lengths(plate, fibre_axis, law, q, quad) result(length)
      !> The plate
      type(plate_type), intent(in) :: plate
      !> Cosine and sine of the fibre direction of each lane
      real(wp), intent(in) :: fibre_axis(lanes, 2)
      !> The law of the lanes
      class(law_type), intent(in) :: law
      !> Gauss point of the plane, and quad
      integer, intent(in) :: q, quad
      real(wp) :: length(lanes, 2)

      integer :: l

      length(:, :) = 0.0_wp
      do l = 1, lanes
         if (law%band_rule(l) == 0) cycle
         length(l, :) = rule_lengths(plate, fibre_axis(l, :), law%band_rule(l), q, quad)
         ! quads far wider than the ellipse average nothing
         length(l, :) = max(length(l, :), share_average*law%radius(l, :))
         if (law%band_width(l) > 0.0_wp) length(l, :) = law%band_width(l)
      end do
   end function band_lengths

   !> Widths of bands at a Gauss point of the plane across the fibres and along them by a rule, such
   !> as the lengths of the point's own cell
   pure function rule_lengths(plate, fibre_axis, rule, q, quad) result(length)
      !> The plate
      type(plate_type), intent(in) :: plate
      !> Cosine and sine of the fibre direction
      real(wp), intent(in) :: fibre_axis(2)
      !> As in `band_length`; Gauss point of the plane, and quad
      integer, intent(in) :: rule, q, quad
      real(wp) :: length(2)

      real(wp) :: area, jacobian(2, 2), share, weight(2)

      weight(:) = plate%gauss_weight([1 + mod(q - 1, plate%side), 1 + (q - 1)/plate%side])
      share = merge(share_biquadratic, share_bilinear, plate%side == 3)
      area = sum(plate%metric(5, :, quad))
      jacobian(:, :) = point_jacobian(plate%gauss_abscissa, plate%metric(:4, q, quad))
      length(1) = band_length(rule, jacobian, fibre_axis, weight, share, area)
      length(2) = band_length(rule, jacobian, [-fibre_axis(2), fibre_axis(1)], weight, share, area)
   end function rule_lengths

   !> d(x, y)/d(xi, eta) from d(xi)/dx, d(xi)/dy, d(eta)/dx, d(eta)/dy over twice `gauss_abscissa`
   pure function point_jacobian(gauss_abscissa, metric) result(jacobian)
      real(wp), intent(in) :: gauss_abscissa, metric(4)
      !> dx/dxi, dy/dxi in the first column
      real(wp) :: jacobian(2, 2)

      real(wp) :: inverse(4)

      inverse(:) = 2.0_wp*gauss_abscissa*metric
      jacobian(:, :) = reshape([inverse(4), -inverse(3), -inverse(2), inverse(1)], [2, 2]) &
         & /(inverse(1)*inverse(4) - inverse(2)*inverse(3))
   end function point_jacobian

end module plydyn_element_plate_crack_bands
