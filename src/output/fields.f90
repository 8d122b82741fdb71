!> Field states: displacement, velocity, strain and stress at the points of the grid.
module plydyn_output_fields
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_quad, only : quad_node_area
   use plydyn_element_recover, only : layer_values, new_plane_shares, plane_shares_type, &
      & plane_value, recovered, scalars_at, thickness_interpolation
   use plydyn_fem_expansion, only : lagrange
   use plydyn_model_control, only : total_lagrangian
   use plydyn_model_model, only : model_type
   use plydyn_output_components, only : field_components
   use plydyn_output_grid, only : grid_type, new_grid
   use plydyn_output_point_fields, only : point_fields_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> The file of fields
   type, public, extends(point_fields_type) :: fields_type
      private
      type(grid_type) :: grid
      !> Weight of each quad at each of its nodes, for every plate: (nodes, quads)
      type(weight_type), allocatable :: weight(:)
      !> Shares of the Gauss points at the nodes of a quad
      type(plane_shares_type), allocatable :: at_node(:)
   contains
      procedure :: create_grid
      procedure :: add_cell_fields
      procedure :: motion_values
      procedure :: recovered_values
   end type fields_type

   !> Shares of the quads in the values at their nodes
   type :: weight_type
      real(wp), allocatable :: share(:, :)
   end type weight_type

contains

   !> Create the file, if there are plates
   subroutine create_grid(self, path, model, domain, error)
      class(fields_type), intent(inout) :: self
      character(*), intent(in) :: path
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      if (size(domain%plates) == 0) return
      self%names = model%request%fields
      self%components = field_components(self%names)
      self%grid = new_grid(domain)
      call find_weights(self, domain)
      self%at_node = node_shares(domain%plates(1)%side)
      call self%file%create(path, self%grid%position, self%grid%connectivity, self%grid%offset, &
         & self%grid%kind, error)
   end subroutine create_grid

   !> What does not change: ply, part, element, angle, fibre
   subroutine add_cell_fields(self, model, domain, error)
      class(fields_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp
      real(wp) :: angle(size(self%grid%kind)), fibre(3, size(self%grid%kind))
      integer, dimension(size(self%grid%kind)) :: element, part, ply, ply_id
      integer :: i

      do i = 1, size(angle)
         associate (k => domain%layers%ply(self%grid%layer(i)), p => self%grid%plate(i))
            ply(i) = k
            part(i) = model%parts(p)%id
            ply_id(i) = model%parts(p)%plies(k)%id
            angle(i) = model%parts(p)%plies(k)%angle
            element(i) = model%mesh%quad_id(domain%plates(p)%quad(self%grid%quad(i)))
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

   !> Share of each quad at its nodes, by area
   subroutine find_weights(self, domain)
      type(fields_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain

      real(wp) :: area(size(self%grid%node))
      integer :: e, p

      allocate (self%weight(size(domain%plates)))
      area(:) = 0.0_wp
      do p = 1, size(domain%plates)
         associate (plate => domain%plates(p), weight => self%weight(p), &
            & site => self%grid%plates(p)%site)
            allocate (weight%share(size(site, 1), size(site, 2)))
            do e = 1, size(site, 2)
               weight%share(:, e) = quad_node_area(plate%side, &
                  & domain%position(1:2, plate%node(:, e)))
               area(site(:, e)) = area(site(:, e)) + weight%share(:, e)
            end do
            do e = 1, size(site, 2)
               weight%share(:, e) = weight%share(:, e)/area(site(:, e))
            end do
         end associate
      end do
   end subroutine find_weights

   !> Shares of the Gauss points at the nodes of a quad, in tensor order
   pure function node_shares(side) result(shares)
      integer, intent(in) :: side
      type(plane_shares_type) :: shares(side*side)

      integer :: i, j
      real(wp) :: span

      span = 2.0_wp/real(side - 1, wp)
      do j = 1, side
         do i = 1, side
            shares(i + side*(j - 1)) = new_plane_shares(side, -1.0_wp + span*real(i - 1, wp), &
               & -1.0_wp + span*real(j - 1, wp))
         end do
      end do
   end function node_shares

   !> Displacement or velocity at the points of the grid, (3, points)
   function motion_values(self, domain, motion) result(values)
      class(fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: motion(:)
      real(wp), allocatable :: values(:, :)

      real(wp) :: height
      real(wp), allocatable :: share(:), slope(:)
      integer :: c, first, k, sites, t, tau

      sites = size(self%grid%node)
      allocate (values(3, size(self%grid%position, 2)))
      values(:, :) = 0.0_wp
      do k = 1, size(self%grid%levels)
         associate (expansion => domain%plates(1)%batches(domain%columns%home(1, k))%expansion)
            allocate (share(expansion%order + 1), slope(expansion%order + 1))
            do t = 1, self%grid%levels(k)
               height = -1.0_wp + 2.0_wp*real(t - 1, wp)/real(self%grid%levels(k) - 1, wp)
               call lagrange(expansion%node, height, share, slope)
               first = self%grid%first(k) + (t - 1)*sites
               do c = 1, 3
                  do tau = 1, size(share)
                     values(c, first + 1:first + sites) = values(c, first + 1:first + sites) &
                        & + share(tau)*motion(domain%columns%freedom(k, tau, c, self%grid%node))
                  end do
               end do
            end do
            deallocate (share, slope)
         end associate
      end do
   end function motion_values

   !> Strain and stress at the points of the grid: the mean of the quads of a part that meet there,
   !> (recovered, points)
   function recovered_values(self, domain, state) result(values)
      class(fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      real(wp), allocatable :: values(:, :)

      integer :: e, k, p

      allocate (values(recovered, size(self%grid%position, 2)))
      values(:, :) = 0.0_wp
      do p = 1, size(domain%plates)
         do k = 1, size(self%grid%levels)
            do e = 1, size(domain%plates(p)%quad)
               call add_quad(self, domain, p, k, e, state, values)
            end do
         end do
      end do
   end function recovered_values

   !> Add the values of one layer of one quad to its points
   subroutine add_quad(self, domain, p, k, e, state, values)
      type(fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: p, k, e
      type(state_type), intent(in) :: state
      real(wp), intent(inout) :: values(:, :)

      real(wp), allocatable :: at_gauss(:, :, :), at_level(:, :)
      real(wp) :: height
      integer :: i, n, t

      associate (plate => domain%plates(p), home => domain%columns%home(:, k), &
         & levels => self%grid%levels(k))
         at_gauss = layer_values(plate, home(1), home(2), home(3), e, &
            & domain%control%kinematics == total_lagrangian, state%displacement, state%history)
         do t = 1, levels
            height = -1.0_wp + 2.0_wp*real(t - 1, wp)/real(levels - 1, wp)
            at_level = level_values(at_gauss, &
               & thickness_interpolation(plate%batches(home(1)), height))
            do n = 1, size(plate%node, 1)
               i = self%grid%first(k) + (t - 1)*size(self%grid%node) &
                  & + self%grid%plates(p)%site(n, e)
               values(:, i) = values(:, i) + self%weight(p)%share(n, e) &
                  & *within_cell(plane_value(plate, e, k, self%at_node(n), at_level), at_gauss)
            end do
         end do
      end associate
   end subroutine add_quad

   !> Values whose scalars do not leave the range of the Gauss points of the cell, as polynomials
   !> through them may
   pure function within_cell(values, at_gauss) result(kept)
      real(wp), intent(in) :: values(:), at_gauss(:, :, :)
      real(wp) :: kept(size(values))
      integer :: i

      kept(:) = values
      do i = scalars_at + 1, recovered
         kept(i) = min(max(values(i), minval(at_gauss(i, :, :))), maxval(at_gauss(i, :, :)))
      end do
   end function within_cell

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

end module plydyn_output_fields
