!> Strain, stress and scalars of the laws at the corners of the quads of a crack zone, and profiles
!> through its thickness at a place of the plane.
module plydyn_element_cracked_output
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_cracked_cells, only : cells_type, corners, wedges
   use plydyn_element_cracked_wedges, only : faces, find_gradients, wedge_points
   use plydyn_element_group, only : recovered, scalars_at
   use plydyn_element_material_batch, only : point_values
   use plydyn_element_plate_layers, only : plate_type
   use plydyn_element_plate_output, only : layer_place_type
   use plydyn_element_plate_recover, only : layer_scalars, point_history
   use plydyn_element_quad, only : plane_table
   use plydyn_fem_columns, only : columns_type
   use plydyn_fem_kinematics, only : find_strain
   implicit none
   private

   public :: corner_displacements, profile_of_corners, wedge_values

contains

   !> Values of one layer of one quad at its corners on both faces, the mean of the wedges that meet
   !> there, (recovered, faces, corners)
   pure function wedge_values(plate, cells, quad, slot, large, has_tensors, displacement, history) &
      & result(values)
      !> The plate and its division
      type(plate_type), intent(in) :: plate
      type(cells_type), intent(in) :: cells
      !> Quad of the plate; order group, block and lane of the layer
      integer, intent(in) :: quad, slot(3)
      !> Large displacement; whether strain or stress is requested
      logical, intent(in) :: large, has_tensors
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      real(wp) :: values(recovered, faces, corners)

      real(wp) :: at_gauss(recovered, wedges, faces), gradient(lanes, 3, 3, wedge_points)
      real(wp) :: all_lanes(lanes, scalars_at), strain(lanes, 6)
      integer :: c, m, w

      associate (block => slot(2), lane => slot(3))
         at_gauss(:, :, :) = 0.0_wp
         at_gauss(scalars_at + 1:, :, :) = layer_scalars(plate, 1, block, lane, quad, history)
         if (has_tensors) then
            call find_gradients(plate, cells, block, quad, displacement, gradient)
            do w = 1, wedges
               do m = 1, faces
                  associate (h => gradient(:, :, :, m + faces*(w - 1)))
                     call find_strain(h, large, strain)
                     all_lanes(:, :) = point_values(plate%batches(1), block, large, h, strain, &
                        & point_history(plate, plate%batches(1), block, quad, w, m, history))
                  end associate
                  at_gauss(:scalars_at, w, m) = all_lanes(lane, :)
               end do
            end do
         end if
         do c = 1, corners
            values(:, :, c) = corner_mean(c, cells%first(lane, block, cells%parity(quad)) &
               & > 0.0_wp, at_gauss)
         end do
      end associate
   end function wedge_values

   !> Mean of the wedges that have a corner
   pure function corner_mean(corner, first, at_gauss) result(values)
      integer, intent(in) :: corner
      !> Whether the diagonal from the first corner divides the quad
      logical, intent(in) :: first
      real(wp), intent(in) :: at_gauss(:, :, :)
      real(wp) :: values(size(at_gauss, 1), faces)

      logical :: is_shared

      is_shared = (corner == 1 .or. corner == corners) .eqv. first
      if (is_shared) then
         values(:, :) = 0.5_wp*sum(at_gauss, 2)
      else
         values(:, :) = at_gauss(:, merge(1, wedges, corner <= 2), :)
      end if
   end function corner_mean

   !> Displacement of the corners of a layer of a quad on both faces, the mean of the wedges of the
   !> quad, of which some may be beyond a crack, (3, faces, corners)
   pure function corner_displacements(node, cells, place, columns, displacement) result(u)
      !> Nodes of the quad
      integer, intent(in) :: node(corners)
      !> Division of the plate; quad, layer and slot
      type(cells_type), intent(in) :: cells
      type(layer_place_type), intent(in) :: place
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp) :: u(3, faces, corners)

      real(wp) :: share
      integer :: c, d, t

      do c = 1, corners
         share = sum(cells%sees(place%slot(3), c, :, place%slot(2), place%quad))/real(wedges, wp)
         do t = 1, faces
            do d = 1, 3
               u(d, t, c) = (1.0_wp - share)*displacement(columns%freedom(place%layer, t, d, &
                  & node(c))) + share*displacement(columns%freedom(place%layer, t, d, &
                  & cells%twin(c, place%quad)))
            end do
         end do
      end do
   end function corner_displacements

   !> Values at heights over a place of a quad from those of its corners, linear along the edges and
   !> from face to face, (3 + `recovered`, heights)
   pure function profile_of_corners(local, height, displacement, recovery) result(values)
      !> Local coordinates of the place; heights in the layer, from -1 to 1
      real(wp), intent(in) :: local(2), height(:)
      !> Displacement, (3, faces, corners), and what else is recovered
      real(wp), intent(in) :: displacement(:, :, :), recovery(:, :, :)
      real(wp) :: values(3 + recovered, size(height))

      real(wp) :: at(3 + recovered, faces), share(corners), slope(2, corners)
      integer :: c, i

      call plane_table(2, local(1), local(2), share, slope)
      at(:, :) = 0.0_wp
      do c = 1, corners
         at(:3, :) = at(:3, :) + share(c)*displacement(:, :, c)
         at(4:, :) = at(4:, :) + share(c)*recovery(:, :, c)
      end do
      do i = 1, size(height)
         values(:, i) = 0.5_wp*((1.0_wp - height(i))*at(:, 1) + (1.0_wp + height(i))*at(:, faces))
      end do
   end function profile_of_corners

end module plydyn_element_cracked_output
