!> Profiles through the thickness of a crack zone at a place of the plane.
module plydyn_element_cracked_profile
   use plydyn_base_precision, only : wp
   use plydyn_element_cracked_cells, only : cells_type, corners, wedges
   use plydyn_element_cracked_wedges, only : faces
   use plydyn_element_plate_output, only : layer_place_type
   use plydyn_element_quad, only : plane_table
   use plydyn_element_recovered, only : recovered
   use plydyn_fem_columns, only : columns_type
   implicit none
   private

   public :: corner_displacements, profile_of_corners

contains

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

end module plydyn_element_cracked_profile
