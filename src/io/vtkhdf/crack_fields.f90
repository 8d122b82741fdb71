!> Field states of crack lines: a line cell for each piece of a line between two doubled nodes, at
!> the middle of its ply.
!>
!> Points lie zone by zone, ply by ply from the bottom up, in each the doubled nodes of the ply.
!> Every rank knows the values of the nodes that it counts, and writes a band of points.
module plydyn_io_vtkhdf_crack_fields
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_cracked_crack_lines, only : crack_lines_type
   use plydyn_io_vtkhdf_element_grid, only : band_of_rows
   use plydyn_io_vtkhdf_field_file, only : field_file_type
   use plydyn_io_vtkhdf_vtkhdf, only : hyperslab_type, piece_type
   use plydyn_law_matrix_crack, only : crack_histories, damage_at, mode_at, onset_at, time_at
   use plydyn_model_crack_zone, only : line_corners
   use plydyn_model_model, only : model_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> Components of the fields: displacement, opening, damage, time of the start, share of shear
   integer, parameter :: components(5) = [3, 3, 1, 1, 1]
   !> Where the damage is among the values of a point, and how many these are
   integer, parameter :: at_damage = 7, crack_numbers = sum(components)
   !> VTK's cells: a line of two points
   integer, parameter :: line_cell = 3

   !> The file of crack states
   type, public, extends(field_file_type) :: crack_fields_type
      private
      !> Ply, and number among all doubled nodes of the model, of each point of the model
      integer, allocatable :: ply(:), number(:)
      !> Zone, ply and ends, as points, of each cell of the model
      integer, allocatable :: cell(:, :)
      !> Points and cells that this rank writes
      type(hyperslab_type) :: points, cells
   contains
      procedure :: add_cell_fields
      procedure :: create_grid
      procedure :: write_fields
   end type crack_fields_type

contains

   !> Create the file, if there are crack lines
   subroutine create_grid(self, path, model, domain, error)
      class(crack_fields_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      character(*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error

      type(piece_type) :: piece
      real(wp), allocatable :: position(:, :)

      if (domain%cracks%whole == 0) return
      self%names = [character(16) :: "displacement", "opening", "damage", "start", "mode"]
      self%components = components
      call find_cells(model, domain, self, position)
      self%points = band_of_rows(domain, size(self%ply))
      self%cells = band_of_rows(domain, size(self%cell, 2))
      piece%points = self%points
      piece%cells = self%cells
      piece%position = position(:, self%points%first + 1:self%points%first + self%points%count)
      piece%kind = line_cell
      piece%connectivity = self%cell(3:4, self%cells%first + 1:self%cells%first &
         & + self%cells%count) - 1
      call self%file%create_grid(path, domain%comm, piece, error)
   end subroutine create_grid

   !> Points and cells of the whole model, ply by ply
   pure subroutine find_cells(model, domain, self, position)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(crack_fields_type), intent(inout) :: self
      !> Of all points
      real(wp), allocatable, intent(out) :: position(:, :)

      integer :: before, layer, p, z

      allocate (self%ply(0), self%number(0), self%cell(4, 0), position(3, 0))
      before = 0
      do z = 1, size(model%crack_zones)
         do p = 1, size(model%crack_zones(z)%plies)
            layer = findloc(domain%layers%ply, p, 1)
            call add_ply(model, [z, p, before], 0.5_wp*(domain%layers%bottom(layer) &
               & + domain%layers%top(layer)), self, position)
         end do
         before = before + size(model%crack_zones(z)%node)
      end do
   end subroutine find_cells

   !> Append the points and cells of one ply of a zone
   pure subroutine add_ply(model, place, height, self, position)
      type(model_type), intent(in) :: model
      !> Zone, ply, and doubled nodes of the zones before
      integer, intent(in) :: place(3)
      !> Middle of the ply over the nodes
      real(wp), intent(in) :: height
      type(crack_fields_type), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: position(:, :)

      integer :: corner(2), e, i, points
      integer, allocatable :: ends(:, :), quads(:), twins(:)

      points = size(self%ply)
      associate (zone => model%crack_zones(place(1)), p => place(2), mesh => model%mesh)
         twins = pack([(i, i=1, size(zone%node))], zone%length(p, :) > 0.0_wp)
         self%ply = [self%ply, spread(p, 1, size(twins))]
         self%number = [self%number, place(3) + twins]
         position = reshape([position, [(mesh%position(:2, zone%node(twins(i))), &
            & mesh%position(3, zone%node(twins(i))) + height, i=1, size(twins))]], &
            & [3, size(self%ply)])
         corner(:) = line_corners(zone, p)
         quads = pack([(e, e=1, size(mesh%quad_part))], mesh%quad_part == zone%part)
         ends = reshape([(point_of(mesh%quad_node(corner(1), quads(e))), &
            & point_of(mesh%quad_node(corner(2), quads(e))), e=1, size(quads))], [2, size(quads)])
         quads = pack([(e, e=1, size(quads))], all(ends > 0, 1))
         self%cell = reshape([self%cell, [(place(:2), ends(:, quads(e)), e=1, size(quads))]], &
            & [4, size(self%cell, 2) + size(quads)])
      end associate
   contains
      !> Point of a node of the mesh, 0 if the ply is whole there
      pure integer function point_of(node)
         integer, intent(in) :: node

         point_of = findloc(twins, model%crack_zones(place(1))%place(node), 1)
         if (point_of > 0) point_of = points + point_of
      end function point_of
   end subroutine add_ply

   !> What does not change: ply from the bottom, its number and angle
   subroutine add_cell_fields(self, model, domain)
      class(crack_fields_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain

      integer :: i, id(self%cells%count)
      real(wp) :: angle(self%cells%count)

      associate (own => self%cell(:2, self%cells%first + 1:self%cells%first + self%cells%count))
         do i = 1, self%cells%count
            associate (ply => model%parts(model%crack_zones(own(1, i))%part)%plies(own(2, i)))
               id(i) = ply%id
               angle(i) = ply%angle
            end associate
         end do
         call self%file%add_cell_data("ply", own(2, :))
      end associate
      call self%file%add_cell_data("ply_id", id)
      call self%file%add_cell_data("angle", angle)
   end subroutine add_cell_fields

   subroutine write_fields(self, domain, state)
      class(crack_fields_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state

      logical, allocatable :: is_known(:, :)
      real(wp), allocatable :: values(:, :)

      allocate (is_known(crack_numbers, size(self%ply)), source=.false.)
      allocate (values(crack_numbers, size(self%ply)), source=0.0_wp)
      call find_values(self, domain, state, is_known, values)
      call domain%comm%merge(size(values), is_known, values)
      call self%write_values(values(:, self%points%first + 1:self%points%first &
         & + self%points%count))
   end subroutine write_fields

   !> Values of the points that this rank counts
   pure subroutine find_values(self, domain, state, is_known, values)
      type(crack_fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      logical, intent(inout) :: is_known(:, :)
      real(wp), intent(inout) :: values(:, :)

      integer :: b, k, l, node, point

      associate (cracks => domain%cracks)
         do point = 1, size(self%ply)
            node = findloc(cracks%number, self%number(point), 1)
            if (node == 0) cycle
            if (.not. cracks%own(node)) cycle
            k = findloc(reshape(cracks%ply, [size(cracks%ply)]), self%ply(point), 1)
            b = (k - 1)/lanes + 1
            l = k - lanes*(b - 1)
            is_known(:, point) = .true.
            values(:at_damage - 1, point) = motion_of(domain, state, &
               & findloc(domain%layers%ply, self%ply(point), 1), cracks%column(:, node))
            values(at_damage:, point) = crack_values(cracks, [node, b, l], &
               & state%history(cracks%first_history:))
         end do
      end associate
   end subroutine find_values

   !> Mean displacement of both copies of both faces of a ply, and the mean opening between them
   pure function motion_of(domain, state, layer, column) result(motion)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      !> Layer of the ply
      integer, intent(in) :: layer
      !> Columns of the node and of its twin
      integer, intent(in) :: column(2)
      real(wp) :: motion(6)

      integer :: c, place(2)
      real(wp) :: both(2)

      do c = 1, 3
         place(:) = domain%columns%freedom(layer, 1, c, column)
         both(:) = state%displacement(place)
         place(:) = domain%columns%freedom(layer, 2, c, column)
         both(:) = 0.5_wp*(both + state%displacement(place))
         motion(c) = 0.5_wp*(both(1) + both(2))
         motion(3 + c) = both(2) - both(1)
      end do
   end function motion_of

   !> Damage, time of the start and share of shear then; zeros of a crack that is tied
   pure function crack_values(cracks, place, history) result(values)
      type(crack_lines_type), intent(in) :: cracks
      !> Node, block and lane
      integer, intent(in) :: place(3)
      !> Of all nodes
      real(wp), intent(in) :: history(lanes, crack_histories, cracks%blocks, *)
      real(wp) :: values(3)

      associate (own => history(place(3), :, place(2), place(1)))
         values(:) = 0.0_wp
         if (own(onset_at) > 0.0_wp) values(:) = own([damage_at, time_at, mode_at])
      end associate
   end function crack_values

end module plydyn_io_vtkhdf_crack_fields
