!> Field states: displacement, velocity, strain and stress at the points of the grid.
module plydyn_output_fields
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_quad, only : quad_node_area
   use plydyn_element_recover, only : layer_values, new_plane_shares, plane_shares_type, &
      & plane_value, ply_strain_at, ply_stress_at, recovered, scalars_at, strain_at, stress_at, &
      & thickness_interpolation
   use plydyn_fem_expansion, only : lagrange
   use plydyn_law_law, only : scalar_names
   use plydyn_model_control, only : total_lagrangian
   use plydyn_model_model, only : model_type
   use plydyn_output_components, only : field_components, tensor, tensor_share
   use plydyn_output_description, only : describe_file
   use plydyn_output_grid, only : grid_type, new_grid
   use plydyn_output_places, only : places_type
   use plydyn_output_vtkhdf, only : vtkhdf_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> The file of fields
   type, public :: fields_type
      private
      type(vtkhdf_type) :: file
      type(grid_type) :: grid
      !> Names of the fields to write
      character(16), allocatable :: names(:)
      !> Weight of each quad at each of its nodes, for every plate: (nodes, quads)
      type(weight_type), allocatable :: weight(:)
      !> Shares of the Gauss points at the nodes of a quad
      type(plane_shares_type), allocatable :: at_node(:)
   contains
      procedure :: open => open_fields
      procedure :: write => write_state
      procedure :: mark
      procedure :: close => close_fields
   end type fields_type

   !> Shares of the quads in the values at their nodes
   type :: weight_type
      real(wp), allocatable :: share(:, :)
   end type weight_type

contains

   !> Create the file, if there are plates: grid, plies, units
   subroutine open_fields(self, path, deck, version, model, domain, places, error)
      class(fields_type), intent(inout) :: self
      !> Path of the file
      character(*), intent(in) :: path
      !> Path of the deck, version of the program
      character(*), intent(in) :: deck, version
      !> The model
      type(model_type), intent(in) :: model
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Where to go on with files of an earlier run
      type(places_type), intent(in) :: places
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      if (size(domain%plates) == 0) return
      self%grid = new_grid(domain)
      self%names = model%request%fields
      call find_weights(self, domain)
      self%at_node = node_shares(domain%plates(1)%side)
      call self%file%create(path, self%grid%position, self%grid%connectivity, self%grid%offset, &
         & self%grid%kind, error)
      if (allocated(error)) return
      call describe_file(self%file, deck, version, model, error)
      if (allocated(error)) return
      call add_cell_fields(self, model, domain, error)
      if (allocated(error)) return
      do i = 1, size(self%names)
         call self%file%declare_point_data(trim(self%names(i)), &
            & field_components(self%names(i)), error)
         if (allocated(error)) return
      end do
      call self%file%settle(places, error)
   end subroutine open_fields

   !> Put all states on the disk, and note how many there are
   subroutine mark(self, places, error)
      class(fields_type), intent(inout) :: self
      !> Places in all files
      type(places_type), intent(inout) :: places
      !> Why they are not all there
      type(error_type), allocatable, intent(out) :: error

      call self%file%mark(places, error)
   end subroutine mark

   !> What does not change: ply, part, element, angle, fibre
   subroutine add_cell_fields(self, model, domain, error)
      type(fields_type), intent(inout) :: self
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

      real(wp) :: area(domain%columns%nodes)
      integer :: e, p

      allocate (self%weight(size(domain%plates)))
      area(:) = 0.0_wp
      do p = 1, size(domain%plates)
         associate (plate => domain%plates(p), weight => self%weight(p))
            allocate (weight%share(size(plate%node, 1), size(plate%node, 2)))
            do e = 1, size(plate%quad)
               weight%share(:, e) = quad_node_area(plate%side, &
                  & domain%position(1:2, plate%node(:, e)))
               area(plate%node(:, e)) = area(plate%node(:, e)) + weight%share(:, e)
            end do
         end associate
      end do
      do p = 1, size(domain%plates)
         associate (node => domain%plates(p)%node, share => self%weight(p)%share)
            do e = 1, size(node, 2)
               share(:, e) = share(:, e)/area(node(:, e))
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

   !> Write the present state; it is whole in the file when this returns
   subroutine write_state(self, domain, state, error)
      class(fields_type), intent(inout) :: self
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The state
      type(state_type), intent(in) :: state
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: name
      real(wp), allocatable :: values(:, :)
      integer :: i, scalar

      if (.not. self%file%is_open()) return
      call self%file%begin_step(state%time)
      if (any(self%names /= "displacement" .and. self%names /= "velocity")) then
         values = recovered_values(self, domain, state)
      end if
      do i = 1, size(self%names)
         name = trim(self%names(i))
         associate (file => self%file)
            select case (name)
            case ("displacement")
               call file%write_point_data(name, motion_values(self, domain, state%displacement), &
                  & error)
            case ("velocity")
               call file%write_point_data(name, motion_values(self, domain, &
                  & state%velocity + 0.5_wp*state%step_before &
                  & *state%acceleration(:domain%columns%freedoms)), error)
            case ("strain")
               call file%write_point_data(name, tensor(values, strain_at, tensor_share), error)
            case ("stress")
               call file%write_point_data(name, tensor(values, stress_at), error)
            case ("strain_ply")
               call file%write_point_data(name, tensor(values, ply_strain_at, tensor_share), error)
            case ("stress_ply")
               call file%write_point_data(name, tensor(values, ply_stress_at), error)
            case default
               scalar = findloc(scalar_names == name, .true., 1)
               call file%write_point_data(name, values(scalars_at + scalar, :), error)
            end select
         end associate
         if (allocated(error)) return
      end do
      call self%file%end_step(error)
   end subroutine write_state

   !> Displacement or velocity at the points of the grid, (3, points)
   function motion_values(self, domain, motion) result(values)
      type(fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: motion(:)
      real(wp), allocatable :: values(:, :)

      real(wp) :: height
      real(wp), allocatable :: share(:), slope(:)
      integer :: c, i, k, n, t, tau

      allocate (values(3, size(self%grid%position, 2)))
      values(:, :) = 0.0_wp
      do k = 1, size(self%grid%levels)
         associate (expansion => domain%plates(1)%batches(domain%columns%home(1, k))%expansion)
            allocate (share(expansion%order + 1), slope(expansion%order + 1))
            do t = 1, self%grid%levels(k)
               height = -1.0_wp + 2.0_wp*real(t - 1, wp)/real(self%grid%levels(k) - 1, wp)
               call lagrange(expansion%node, height, share, slope)
               do n = 1, domain%columns%nodes
                  i = self%grid%first(k) + (t - 1)*domain%columns%nodes + n
                  do c = 1, 3
                     do tau = 1, size(share)
                        values(c, i) = values(c, i) &
                           & + share(tau)*motion(domain%columns%freedom(k, tau, c, n))
                     end do
                  end do
               end do
            end do
            deallocate (share, slope)
         end associate
      end do
   end function motion_values

   !> Strain and stress at the points of the grid, averaged over the quads that meet there,
   !> (recovered, points)
   function recovered_values(self, domain, state) result(values)
      type(fields_type), intent(in) :: self
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
               i = self%grid%first(k) + (t - 1)*domain%columns%nodes + plate%node(n, e)
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

   !> Close the file
   subroutine close_fields(self, error)
      class(fields_type), intent(inout) :: self
      !> Why it could not be closed
      type(error_type), allocatable, intent(out) :: error

      call self%file%close(error)
   end subroutine close_fields

end module plydyn_output_fields
