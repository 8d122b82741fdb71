!> Plates as cells for pictures: every layer over every quad is one cell, or more above order 2; and
!> profiles through the thickness of plates at a place of the plane.
module plydyn_element_plate_output
   use plydyn_base_precision, only : wp
   use plydyn_element_group, only : cell_type, recovered, scalars_at
   use plydyn_element_plate_layers, only : plate_type
   use plydyn_element_plate_recover, only : layer_scalars, layer_values
   use plydyn_element_quad, only : plane_table, tensor_order
   use plydyn_element_recover_anywhere, only : new_plane_shares, plane_shares_type, plane_values, &
      & thickness_interpolation
   use plydyn_fem_columns, only : columns_type
   use plydyn_fem_expansion, only : lagrange
   use plydyn_fem_quadrature, only : equal_points
   implicit none
   private

   public :: node_shares, plate_cell, profile_values, values_at_nodes

   !> VTK's cells: 8 nodes, and 27 nodes
   integer, parameter :: linear_cell = 12, quadratic_cell = 29

   !> Place of each of the 27 nodes of a quadratic cell: node of the quad and level, 0 to 2
   integer, parameter :: quad_place(27) = [1, 2, 3, 4, 1, 2, 3, 4, 5, 6, 7, 8, 5, 6, 7, 8, &
      & 1, 2, 3, 4, 8, 6, 5, 7, 9, 9, 9]
   integer, parameter :: level_place(27) = [0, 0, 0, 0, 2, 2, 2, 2, 0, 0, 0, 0, 2, 2, 2, 2, &
      & 1, 1, 1, 1, 1, 1, 1, 1, 0, 2, 1]

   !> A layer of a quad
   type, public :: layer_place_type
      !> Quad of the plate, layer and levels of points in it
      integer :: quad = 0, layer = 0, levels = 0
      !> Order group, block and lane of the layer
      integer :: slot(3) = 0
   end type layer_place_type

contains

   !> Levels of points in a layer: those of one quadratic cell or of two, or of a linear cell for
   !> each order
   elemental integer function layer_levels(order, nodes) result(levels)
      !> Order of the layer, and nodes of its quads
      integer, intent(in) :: order, nodes

      levels = order + 1
      if (nodes == 9) levels = merge(3, 5, order <= 2)
   end function layer_levels

   !> The cell of a layer over a quad
   pure function plate_cell(side, order) result(cell)
      !> Nodes along a side
      integer, intent(in) :: side
      !> Order of each layer
      integer, intent(in) :: order(:)
      type(cell_type) :: cell

      cell%node_order = tensor_order(side)
      cell%levels = layer_levels(order, side**2)
      if (side == 3) then
         cell%kind = quadratic_cell
         cell%span = 2
         cell%corner = reshape([quad_place, level_place], [2, 27], order=[2, 1])
      else
         cell%kind = linear_cell
         cell%span = 1
         cell%corner = reshape([1, 2, 3, 4, 1, 2, 3, 4, 0, 0, 0, 0, 1, 1, 1, 1], [2, 8], &
            & order=[2, 1])
      end if
   end function plate_cell

   !> Shares of the Gauss points at the nodes of a quad, in tensor order
   pure function node_shares(side) result(shares)
      !> Nodes along a side
      integer, intent(in) :: side
      type(plane_shares_type) :: shares

      real(wp) :: line(side), place(2, side, side)

      line(:) = equal_points(side)
      place(1, :, :) = spread(line, 2, side)
      place(2, :, :) = spread(line, 1, side)
      shares = new_plane_shares(side, reshape(place, [2, side*side]))
   end function node_shares

   !> Values of one layer of one quad at its nodes at all levels, (`recovered`, levels, nodes)
   pure function values_at_nodes(plate, at_nodes, place, large, has_tensors, displacement, &
      & history) result(values)
      !> The plate
      type(plate_type), intent(in) :: plate
      !> Shares of the Gauss points at the nodes of a quad
      type(plane_shares_type), intent(in) :: at_nodes
      !> Quad of the plate, layer and its levels
      type(layer_place_type), intent(in) :: place
      !> Large displacement; whether strain or stress is requested
      logical, intent(in) :: large, has_tensors
      !> Displacement of all points, history of all Gauss points
      real(wp), intent(in), contiguous :: displacement(:), history(:)
      real(wp), allocatable :: values(:, :, :)

      real(wp), allocatable :: at_gauss(:, :, :), at_level(:, :), here(:, :)
      real(wp) :: height(place%levels)
      integer :: b, t

      b = place%slot(1)
      associate (block => place%slot(2), lane => place%slot(3))
         if (has_tensors) then
            at_gauss = layer_values(plate, b, block, lane, place%quad, large, displacement, history)
         else
            allocate (at_gauss(recovered, size(plate%node, 1), &
               & plate%batches(b)%expansion%order + 1), source=0.0_wp)
            at_gauss(scalars_at + 1:, :, :) = layer_scalars(plate, b, block, lane, place%quad, &
               & history)
         end if
      end associate
      allocate (values(recovered, place%levels, size(plate%node, 1)))
      height(:) = equal_points(place%levels)
      do t = 1, place%levels
         at_level = level_values(at_gauss, thickness_interpolation(plate%batches(b), &
            & height(t)))
         if (has_tensors) then
            here = plane_values(plate, place%quad, place%layer, at_nodes, at_level)
         else
            here = matmul(at_level, at_nodes%full)
         end if
         call keep_within_cell(at_gauss, here)
         values(:, t, :) = here
      end do
   end function values_at_nodes

   !> Keep scalars within the range of the Gauss points of the cell, which polynomials through them
   !> may leave
   pure subroutine keep_within_cell(at_gauss, values)
      real(wp), intent(in) :: at_gauss(:, :, :)
      !> (recovered, places)
      real(wp), intent(inout) :: values(:, :)
      integer :: i

      do i = scalars_at + 1, recovered
         values(i, :) = min(max(values(i, :), minval(at_gauss(i, :, :))), &
            & maxval(at_gauss(i, :, :)))
      end do
   end subroutine keep_within_cell

   !> Values at the Gauss points of the plane at one height, (recovered, points)
   pure function level_values(at_gauss, share) result(values)
      real(wp), intent(in) :: at_gauss(:, :, :), share(:)
      real(wp) :: values(size(at_gauss, 1), size(at_gauss, 2))
      integer :: m

      values(:, :) = 0.0_wp
      do m = 1, size(share)
         values(:, :) = values + share(m)*at_gauss(:, :, m)
      end do
   end function level_values

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

end module plydyn_element_plate_output
