!> Field states: displacement, velocity, strain and stress at the points of the grid.
module plydyn_io_vtkhdf_plate_fields
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_layer_scalars, only : layer_scalars
   use plydyn_element_quad, only : quad_node_area
   use plydyn_element_recover, only : layer_values, recovered, scalars_at
   use plydyn_element_recover_anywhere, only : new_plane_shares, plane_shares_type, plane_values, &
      & thickness_interpolation
   use plydyn_fem_expansion, only : lagrange
   use plydyn_model_control, only : total_lagrangian
   use plydyn_model_model, only : model_type
   use plydyn_io_vtkhdf_components, only : field_components, tensor_components
   use plydyn_io_vtkhdf_plate_grid, only : grid_type, new_grid
   use plydyn_io_vtkhdf_requested_fields, only : point_fields_type
   use plydyn_io_vtkhdf_vtkhdf, only : piece_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> The file of fields
   type, public, extends(point_fields_type) :: fields_type
      private
      type(grid_type) :: grid
      !> Area of each quad at each of its nodes, (nodes, quads)
      real(wp), allocatable :: area(:, :)
      !> Node of each slot of the grid
      integer, allocatable :: node(:)
      !> Shares of the Gauss points at the nodes of a quad
      type(plane_shares_type) :: at_nodes
      !> Whether strain or stress is asked for; they take longer than the scalars of laws
      logical :: has_tensors = .false.
   contains
      procedure :: create_grid
      procedure :: add_cell_fields
      procedure :: motion_values
      procedure :: recovered_values
   end type fields_type

contains

   !> Create the file, if there are plates
   subroutine create_grid(self, path, model, domain, error)
      class(fields_type), intent(inout) :: self
      character(*), intent(in) :: path
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      type(piece_type) :: piece

      if (size(domain%plates) == 0) return
      self%names = model%request%fields
      self%components = field_components(self%names)
      self%has_tensors = any(self%components == tensor_components)
      call new_grid(model%mesh, domain, self%grid, piece)
      call look_at_nodes(self, domain)
      self%at_nodes = node_shares(domain%plates(1)%side)
      call self%file%create(path, domain%comm, piece, error)
   end subroutine create_grid

   !> Nodes of the slots, and areas of the quads at them
   subroutine look_at_nodes(self, domain)
      type(fields_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain

      integer :: i

      allocate (self%area(size(self%grid%slots%slot, 1), size(self%grid%home, 2)))
      allocate (self%node(self%grid%slots%count))
      do i = 1, size(self%grid%home, 2)
         associate (plate => domain%plates(self%grid%home(1, i)), e => self%grid%home(2, i))
            self%node(self%grid%slots%slot(:, i)) = plate%node(:, e)
            self%area(:, i) = quad_node_area(plate%side, domain%position(1:2, plate%node(:, e)))
         end associate
      end do
   end subroutine look_at_nodes

   !> What does not change: ply, part, element, angle, fibre
   subroutine add_cell_fields(self, model, domain, error)
      class(fields_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp
      real(wp) :: angle(size(self%grid%layer)), fibre(3, size(self%grid%layer))
      integer, dimension(size(self%grid%layer)) :: element, part, ply, ply_id
      integer :: i

      do i = 1, size(angle)
         associate (k => domain%layers%ply(self%grid%layer(i)), &
            & p => model%mesh%quad_part(self%grid%quad(i)))
            ply(i) = k
            part(i) = model%parts(p)%id
            ply_id(i) = model%parts(p)%plies(k)%id
            angle(i) = model%parts(p)%plies(k)%angle
            element(i) = model%mesh%quad_id(self%grid%quad(i))
         end associate
         fibre(:, i) = [cos(angle(i)*degree), sin(angle(i)*degree), 0.0_wp]
      end do
      call self%file%add_cell_data("ply", ply, error)
      if (allocated(error)) return
      call self%file%add_cell_data("ply_id", ply_id, error)
      if (allocated(error)) return
      call self%file%add_cell_data("part", part, error)
      if (allocated(error)) return
      call self%file%add_cell_data("element", element, error)
      if (allocated(error)) return
      call self%file%add_cell_data("angle", angle, error)
      if (allocated(error)) return
      call self%file%add_cell_data("fibre", fibre, error)
   end subroutine add_cell_fields

   !> Shares of the Gauss points at the nodes of a quad, in tensor order
   pure function node_shares(side) result(shares)
      integer, intent(in) :: side
      type(plane_shares_type) :: shares

      integer :: i
      real(wp) :: line(side), place(2, side, side)

      line(:) = [(-1.0_wp + 2.0_wp*real(i - 1, wp)/real(side - 1, wp), i=1, side)]
      place(1, :, :) = spread(line, 2, side)
      place(2, :, :) = spread(line, 1, side)
      shares = new_plane_shares(side, reshape(place, [2, side*side]))
   end function node_shares

   !> Displacement or velocity at the points of this rank, (3, points)
   function motion_values(self, domain, motion) result(values)
      class(fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: motion(:)
      real(wp), allocatable :: values(:, :)

      real(wp) :: at_slot(3, self%grid%slots%levels, self%grid%slots%count), height
      real(wp), allocatable :: share(:), slope(:)
      integer :: c, k, t, tau

      at_slot(:, :, :) = 0.0_wp
      do k = 1, size(self%grid%levels)
         associate (expansion => domain%plates(1)%batches(domain%columns%home(1, k))%expansion)
            allocate (share(expansion%order + 1), slope(expansion%order + 1))
            do t = 1, self%grid%levels(k)
               height = -1.0_wp + 2.0_wp*real(t - 1, wp)/real(self%grid%levels(k) - 1, wp)
               call lagrange(expansion%node, height, share, slope)
               associate (values_at => at_slot(:, self%grid%below(k) + t, :))
                  do c = 1, 3
                     do tau = 1, size(share)
                        values_at(c, :) = values_at(c, :) + share(tau) &
                           & *motion(domain%columns%freedom(k, tau, c, self%node))
                     end do
                  end do
               end associate
            end do
            deallocate (share, slope)
         end associate
      end do
      allocate (values(3, self%grid%slots%own_points()))
      call self%grid%slots%hand_over(at_slot, values)
   end function motion_values

   !> Scalars, and strain and stress if asked for, at the points of this rank: the mean of the quads
   !> of a part that meet there, by area, (recovered, points)
   function recovered_values(self, domain, state) result(values)
      class(fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      real(wp), allocatable :: values(:, :)

      real(wp), allocatable :: sums(:, :, :)
      integer :: i, k

      allocate (values(recovered, self%grid%slots%own_points()))
      do k = 1, size(self%grid%levels)
         allocate (sums(recovered + 1, self%grid%levels(k), self%grid%slots%count))
         sums(:, :, :) = 0.0_wp
         do i = 1, size(self%grid%home, 2)
            call add_quad(self, domain, i, k, state, sums)
         end do
         associate (first => self%grid%slots%delivery%count*self%grid%below(k), &
            & length => self%grid%slots%delivery%count*self%grid%levels(k))
            call self%grid%slots%mean(sums, values(:, first + 1:first + length))
         end associate
         deallocate (sums)
      end do
   end function recovered_values

   !> Add the values of one layer of one quad to its slots, by area, and the areas
   subroutine add_quad(self, domain, i, k, state, sums)
      type(fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      !> The quad of this rank, the layer
      integer, intent(in) :: i, k
      type(state_type), intent(in) :: state
      real(wp), intent(inout) :: sums(:, :, :)

      real(wp), allocatable :: at_gauss(:, :, :), at_level(:, :), here(:, :)
      real(wp) :: height
      integer :: n, t

      associate (plate => domain%plates(self%grid%home(1, i)), e => self%grid%home(2, i), &
         & home => domain%columns%home(:, k))
         if (self%has_tensors) then
            at_gauss = layer_values(plate, home(1), home(2), home(3), e, &
               & domain%control%kinematics == total_lagrangian, state%displacement, state%history)
         else
            allocate (at_gauss(recovered, size(plate%node, 1), &
               & plate%batches(home(1))%expansion%order + 1), source=0.0_wp)
            at_gauss(scalars_at + 1:, :, :) = layer_scalars(plate, home(1), home(2), home(3), e, &
               & state%history)
         end if
         do t = 1, size(sums, 2)
            height = -1.0_wp + 2.0_wp*real(t - 1, wp)/real(size(sums, 2) - 1, wp)
            at_level = level_values(at_gauss, &
               & thickness_interpolation(plate%batches(home(1)), height))
            if (self%has_tensors) then
               here = plane_values(plate, e, k, self%at_nodes, at_level)
            else
               here = matmul(at_level, self%at_nodes%full)
            end if
            call keep_within_cell(at_gauss, here)
            do n = 1, size(here, 2)
               associate (total => sums(:, t, self%grid%slots%slot(n, i)), area => self%area(n, i))
                  total(:recovered) = total(:recovered) + area*here(:, n)
                  total(recovered + 1) = total(recovered + 1) + area
               end associate
            end do
         end do
      end associate
   end subroutine add_quad

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

end module plydyn_io_vtkhdf_plate_fields
