!> Field states of the interfaces between plies: a surface for each, with points of its own.
module plydyn_output_interface_fields
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_delamination, only : interface_ply
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_quad, only : quad_node_area
   use plydyn_model_model, only : model_type
   use plydyn_output_field_file, only : field_file_type
   use plydyn_output_interface_values, only : at_damage, at_dissipated, at_mixity, damage_values, &
      & interface_values
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> VTK's cells: quads of 4 and of 9 nodes
   integer, parameter :: linear_cell = 9, quadratic_cell = 28
   !> Places of VTK's nodes of a quad in tensor order
   integer, parameter :: of_q4(4) = [1, 2, 4, 3], of_q9(9) = [1, 3, 9, 7, 2, 6, 8, 4, 5]
   !> The file of interface states
   type, public, extends(field_file_type) :: interface_fields_type
      private
      !> Where the points of an interface begin, less one, by the ply below it; -1 for none
      integer, allocatable :: first(:)
      !> Layer below each interface, in the same order as the points
      integer, allocatable :: layer(:)
      !> Batch, lane and quad of each cell
      integer, allocatable :: home(:, :)
      !> Sum of the areas that meet at a point
      real(wp), allocatable :: area(:)
   contains
      procedure :: create_grid
      procedure :: add_cell_fields
      procedure :: write => write_state
   end type interface_fields_type

contains

   !> Create the file, if there are interfaces
   subroutine create_grid(self, path, model, domain, error)
      class(interface_fields_type), intent(inout) :: self
      character(*), intent(in) :: path
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      if (size(domain%interfaces) == 0) return
      self%names = [character(16) :: "displacement", "opening", "damage", "mode_mixity", &
         & "dissipated"]
      self%components = [3, 3, 1, 1, 1]
      call arrange(self, domain)
      call create_surfaces(self, path, domain, error)
   end subroutine create_grid

   !> Find the cells, and where the points of each interface begin
   subroutine arrange(self, domain)
      type(interface_fields_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain

      integer :: b, e, i, k, l

      allocate (self%first(maxval(domain%layers%ply)), self%layer(0))
      self%first(:) = -1
      allocate (self%home(3, sum([(count(domain%interfaces(b)%lower > 0) &
         & *size(domain%interfaces(b)%quad), b=1, size(domain%interfaces))])))
      i = 0
      do k = 1, size(self%first)
         do b = 1, size(domain%interfaces)
            associate (batch => domain%interfaces(b))
               do l = 1, lanes
                  if (batch%lower(l) == 0) cycle
                  if (interface_ply(domain, batch, l) /= k) cycle
                  if (self%first(k) < 0) then
                     self%first(k) = domain%columns%nodes*size(self%layer)
                     self%layer = [self%layer, batch%lower(l)]
                  end if
                  do e = 1, size(batch%quad)
                     i = i + 1
                     self%home(:, i) = [b, l, e]
                  end do
               end do
            end associate
         end do
      end do
   end subroutine arrange

   !> Points and cells
   subroutine create_surfaces(self, path, domain, error)
      type(interface_fields_type), intent(inout) :: self
      character(*), intent(in) :: path
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: position(3, domain%columns%nodes*size(self%layer))
      integer, dimension(size(self%home, 2)*domain%plates(1)%side**2) :: connectivity
      integer :: i, k, nodes, order(domain%plates(1)%side**2)

      nodes = domain%columns%nodes
      do k = 1, size(self%layer)
         position(:, (k - 1)*nodes + 1:k*nodes) = domain%position
         position(3, (k - 1)*nodes + 1:k*nodes) = domain%position(3, :) &
            & + domain%layers%top(self%layer(k))
      end do
      if (size(order) == size(of_q4)) then
         order(:) = of_q4
      else
         order(:) = of_q9
      end if
      allocate (self%area(size(position, 2)))
      self%area(:) = 0.0_wp
      do i = 1, size(self%home, 2)
         associate (point => cell_points(self, domain, i))
            self%area(point) = self%area(point) + cell_areas(self, domain, i)
            connectivity((i - 1)*size(order) + 1:i*size(order)) = point(order) - 1
         end associate
      end do
      call self%file%create(path, position, connectivity, &
         & [(i*size(order), i=0, size(self%home, 2))], spread(merge(linear_cell, quadratic_cell, &
         & size(order) == size(of_q4)), 1, size(self%home, 2)), error)
   end subroutine create_surfaces

   !> Points of a cell in tensor order, from 1
   pure function cell_points(self, domain, cell) result(point)
      type(interface_fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: cell
      integer :: point(domain%plates(1)%side**2)

      associate (home => self%home(:, cell), batch => domain%interfaces(self%home(1, cell)))
         point(:) = self%first(interface_ply(domain, batch, home(2))) + batch%node(:, home(3))
      end associate
   end function cell_points

   !> Areas of a quad at its nodes
   pure function cell_areas(self, domain, cell) result(area)
      type(interface_fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: cell
      real(wp) :: area(domain%plates(1)%side**2)

      associate (batch => domain%interfaces(self%home(1, cell)))
         area(:) = quad_node_area(batch%side, &
            & domain%position(1:2, batch%node(:, self%home(3, cell))))
      end associate
   end function cell_areas

   !> What does not change: interface, plies, angles, element
   subroutine add_cell_fields(self, model, domain, error)
      class(interface_fields_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      real(wp), dimension(size(self%home, 2)) :: above, below
      integer, dimension(size(self%home, 2)) :: element, number, ply_above, ply_below
      integer :: i, quad

      do i = 1, size(element)
         associate (batch => domain%interfaces(self%home(1, i)))
            quad = batch%quad(self%home(3, i))
            number(i) = interface_ply(domain, batch, self%home(2, i))
            element(i) = model%mesh%quad_id(quad)
            associate (plies => model%parts(model%mesh%quad_part(quad))%plies)
               ply_below(i) = plies(number(i))%id
               ply_above(i) = plies(number(i) + 1)%id
               below(i) = plies(number(i))%angle
               above(i) = plies(number(i) + 1)%angle
            end associate
         end associate
      end do
      call self%file%add_cell_data("interface", number, error)
      if (.not. allocated(error)) call self%file%add_cell_data("ply_below", ply_below, error)
      if (.not. allocated(error)) call self%file%add_cell_data("ply_above", ply_above, error)
      if (.not. allocated(error)) call self%file%add_cell_data("angle_below", below, error)
      if (.not. allocated(error)) call self%file%add_cell_data("angle_above", above, error)
      if (.not. allocated(error)) call self%file%add_cell_data("element", element, error)
   end subroutine add_cell_fields

   !> Write the present state; it is whole in the file when this returns
   subroutine write_state(self, domain, state, error)
      class(interface_fields_type), intent(inout) :: self
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The state
      type(state_type), intent(in) :: state
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: mean(:, :), opening(:, :), values(:, :)

      if (.not. self%file%is_open()) return
      call face_motion(self, domain, state, mean, opening)
      values = point_values(self, domain, state)
      call self%file%begin_step(state%time)
      call self%file%write_point_data("displacement", mean, error)
      if (allocated(error)) return
      call self%file%write_point_data("opening", opening, error)
      if (allocated(error)) return
      call self%file%write_point_data("damage", values(at_damage, :), error)
      if (allocated(error)) return
      call self%file%write_point_data("mode_mixity", values(at_mixity, :), error)
      if (allocated(error)) return
      call self%file%write_point_data("dissipated", values(at_dissipated, :), error)
      if (allocated(error)) return
      call self%file%end_step(error)
   end subroutine write_state

   !> Mean and difference of the motion of both faces, (3, points)
   subroutine face_motion(self, domain, state, mean, opening)
      type(interface_fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      real(wp), allocatable, intent(out) :: mean(:, :), opening(:, :)

      integer :: c, i, k, n
      real(wp) :: above, below

      allocate (mean(3, size(self%area)), opening(3, size(self%area)))
      i = 0
      do k = 1, size(self%layer)
         associate (layer => self%layer(k), columns => domain%columns)
            do n = 1, columns%nodes
               i = i + 1
               do c = 1, 3
                  below = state%displacement(columns%freedom(layer, columns%levels(layer), c, n))
                  above = state%displacement(columns%freedom(layer + 1, 1, c, n))
                  mean(c, i) = 0.5_wp*(above + below)
                  opening(c, i) = above - below
               end do
            end do
         end associate
      end do
   end subroutine face_motion

   !> Damage, mix of modes and energy at the points: of the nearest point of each quad, averaged
   !> over the quads that meet there, (values, points)
   function point_values(self, domain, state) result(values)
      type(interface_fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      real(wp) :: values(damage_values, size(self%area))

      real(wp) :: here(damage_values, domain%plates(1)%side**2)
      integer :: i, q

      values(:, :) = 0.0_wp
      do i = 1, size(self%home, 2)
         here(:, :) = interface_values(domain, state, self%home(:, i))
         associate (point => cell_points(self, domain, i), share => cell_areas(self, domain, i))
            do q = 1, size(point)
               values(:, point(q)) = values(:, point(q)) &
                  & + share(q)/self%area(point(q))*here(:, q)
            end do
         end associate
      end do
      ! round-off of the shares
      values(:, :) = max(values, 0.0_wp)
      values(at_damage, :) = min(values(at_damage, :), 1.0_wp)
      values(at_mixity, :) = min(values(at_mixity, :), 1.0_wp)
   end function point_values

end module plydyn_output_interface_fields
