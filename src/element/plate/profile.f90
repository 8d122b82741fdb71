!> Profiles through the thickness of plates at a place of the plane.
module plydyn_element_plate_profile
   use plydyn_base_precision, only : wp
   use plydyn_element_plate_layers, only : plate_type
   use plydyn_element_plate_output, only : layer_place_type
   use plydyn_element_quad, only : plane_table
   use plydyn_element_recover, only : layer_values
   use plydyn_element_recovered, only : recovered
   use plydyn_element_recover_anywhere, only : new_plane_shares, plane_shares_type, plane_values, &
      & thickness_interpolation
   use plydyn_fem_columns, only : columns_type
   use plydyn_fem_expansion, only : lagrange
   implicit none
   private

   public :: profile_values

contains

   !> Displacement, strain, stress and scalars of a layer at a place of a quad,
   !> (3 + `recovered`, heights)
   pure function profile_values(plate, place, large, columns, local, height, displacement, &
      & history) result(values)
      !> The plate; quad, layer and levels of points in it
      type(plate_type), intent(in) :: plate
      type(layer_place_type), intent(in) :: place
      !> Large displacement
      logical, intent(in) :: large
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      !> Local coordinates of the place; heights in the layer, from -1 to 1
      real(wp), intent(in) :: local(2), height(:)
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      real(wp) :: values(3 + recovered, size(height))

      real(wp), allocatable :: at_gauss(:, :), at_level(:, :)
      type(plane_shares_type) :: shares
      integer :: i

      shares = new_plane_shares(plate%side, reshape(local, [2, 1]))
      associate (slot => place%slot, batch => plate%batches(place%slot(1)))
         at_gauss = reshape(layer_values(plate, slot(1), slot(2), slot(3), place%quad, large, &
            & displacement, history), [recovered*plate%side**2, place%levels])
         do i = 1, size(height)
            at_level = reshape(matmul(at_gauss, thickness_interpolation(batch, height(i))), &
               & [recovered, plate%side**2])
            values(:3, i) = displacement_at(plate, place, columns, local, height(i), displacement)
            values(4:, i:i) = plane_values(plate, place%quad, place%layer, shares, at_level)
         end do
      end associate
   end function profile_values

   !> Displacement at a place of a quad and a height of a layer
   pure function displacement_at(plate, place, columns, local, height, displacement) result(u)
      type(plate_type), intent(in) :: plate
      type(layer_place_type), intent(in) :: place
      type(columns_type), intent(in) :: columns
      !> Local coordinates of the place; height in the layer, from -1 to 1
      real(wp), intent(in) :: local(2), height
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp) :: u(3)

      real(wp) :: plane(plate%side**2), plane_slope(2, plate%side**2)
      real(wp) :: share(place%levels), slope(place%levels)
      integer :: c, t

      call plane_table(plate%side, local(1), local(2), plane, plane_slope)
      call lagrange(plate%batches(place%slot(1))%expansion%node, height, share, slope)
      u(:) = 0.0_wp
      do c = 1, 3
         do t = 1, size(share)
            u(c) = u(c) + share(t)*dot_product(plane, displacement(columns%freedom(place%layer, t, &
               & c, plate%node(:, place%quad))))
         end do
      end do
   end function displacement_at

end module plydyn_element_plate_profile
