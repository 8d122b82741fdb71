!> Field states of the interfaces between plies: a surface for each, with points of its own.
!>
!> Points lie surface by surface from the bottom up, in each the nodes of all quads, part by part:
!> where two parts meet, each has its own. So do cells, in each the quads of the deck that have the
!> interface.
module plydyn_io_vtkhdf_interface_fields
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_delamination, only : present_interfaces
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_interface_group, only : interface_group_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   use plydyn_io_vtkhdf_field_file, only : field_file_type
   use plydyn_io_vtkhdf_element_grid, only : accumulators_of_kind, band_of_rows, field_group
   use plydyn_io_vtkhdf_output_nodes, only : accumulators_type, number_nodes
   use plydyn_io_vtkhdf_vtkhdf, only : piece_type
   use plydyn_state_state, only : state_type
   use plydyn_element_interface_interfaces, only : interface_type
   use plydyn_element_interface_axes, only : find_axes, rotate_in
   use plydyn_element_quad, only : quad_node_metric
   use plydyn_law_cohesive_softening, only : closing_at, damage_at, fracture_at, friction_at, &
      & normal, share_at, shear
   use plydyn_model_control, only : total_lagrangian
   implicit none
   private

   !> The values, in this order: damage, share of shear in the elastic energy of the opening of this
   !> time, energy lost per area, share of the toughness that is spent
   integer, parameter :: at_damage = 1, at_mixity = 2, at_dissipated = 3, at_share = 4
   !> How many they are
   integer, parameter :: damage_values = 4

   !> Components of the fields: displacement, opening, damage, mix of modes, energy, its share of
   !> the toughness; and all of them
   integer, parameter :: components(6) = [3, 3, 1, 1, 1, 1]
   integer, parameter, public :: interface_numbers = sum(components)
   !> VTK's cells: quads of 4 and of 9 nodes
   integer, parameter :: linear_cell = 9, quadratic_cell = 28

   !> The file of interface states
   type, public, extends(field_file_type) :: interface_fields_type
      private
      !> Layer below each interface, and its ply, from the bottom up
      integer, allocatable :: layer(:), ply(:)
      !> Group and lane of each interface over each element set, 0 for none, (2, interfaces, sets)
      integer, allocatable :: batch(:, :, :)
      !> Output nodes of the quads of this rank, nodes in tensor order
      type(accumulators_type) :: accumulators
      !> Interface, and quad of the mesh, of each cell that this rank writes
      integer, allocatable :: cell(:), quad(:)
   contains
      procedure :: create_grid
      procedure :: write_fields
      procedure :: add_cell_fields
   end type interface_fields_type

contains

   !> Create the file, if there are interfaces
   subroutine create_grid(self, path, model, domain, error)
      class(interface_fields_type), intent(inout) :: self
      character(*), intent(in) :: path
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: node(:), output_node(:, :)
      type(piece_type) :: piece

      if (size(present_interfaces(domain)) == 0) return
      self%names = [character(16) :: "displacement", "opening", "damage", "mode_mixity", &
         & "dissipated", "energy_share"]
      self%components = components
      call arrange(self, domain)
      associate (mesh => model%mesh)
         call number_nodes(mesh%quad_part, mesh%quad_node, size(mesh%node_id), output_node, node)
         self%accumulators = accumulators_of_kind(domain, field_group(domain), output_node, &
            & size(self%layer))
         piece%points = self%accumulators%points()
         call place_points(domain, mesh%position(:, node(piece%points%first + 1: &
            & piece%points%first + piece%points%count)), self, piece)
         call make_cells(domain, mesh, output_node, self, piece)
      end associate
      call self%file%create_grid(path, domain%comm, piece, error)
   end subroutine create_grid

   !> Find the interfaces, from the bottom up
   subroutine arrange(self, domain)
      type(interface_fields_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain

      integer :: g, k, l, number(maxval(domain%layers%ply))

      self%ply = present_interfaces(domain)
      number(self%ply) = [(k, k=1, size(self%ply))]
      allocate (self%layer(size(self%ply)))
      allocate (self%batch(2, size(self%ply), maxval([(domain%groups(g)%item%set, &
         & g=1, size(domain%groups))])))
      self%batch(:, :, :) = 0
      do g = 1, size(domain%groups)
         select type (group => domain%groups(g)%item)
         type is (interface_group_type)
            do l = 1, lanes
               if (group%ply(l) == 0) cycle
               self%layer(number(group%ply(l))) = group%batch%lower(l)
               self%batch(:, number(group%ply(l)), group%set) = [g, l]
            end do
         end select
      end do
   end subroutine arrange

   !> Positions of the points that this rank writes
   pure subroutine place_points(domain, position, self, piece)
      type(domain_type), intent(in) :: domain
      !> Positions of its output nodes, (3, output nodes)
      real(wp), intent(in) :: position(:, :)
      type(interface_fields_type), intent(in) :: self
      type(piece_type), intent(inout) :: piece

      integer :: k, nodes

      nodes = size(position, 2)
      allocate (piece%position(3, nodes*size(self%layer)))
      do k = 1, size(self%layer)
         piece%position(:, (k - 1)*nodes + 1:k*nodes) = position
         piece%position(3, (k - 1)*nodes + 1:k*nodes) = position(3, :) &
            & + domain%layers%top(self%layer(k))
      end do
   end subroutine place_points

   !> The cells that this rank writes
   pure subroutine make_cells(domain, mesh, output_node, self, piece)
      type(domain_type), intent(in) :: domain
      type(mesh_type), intent(in) :: mesh
      !> Output nodes of all quads
      integer, intent(in) :: output_node(:, :)
      type(interface_fields_type), intent(inout) :: self
      type(piece_type), intent(inout) :: piece

      integer, allocatable :: own(:)
      integer :: before, corners, first, i, k, last

      corners = size(output_node, 1)
      piece%cells = band_of_rows(domain, sum([(count(self%batch(1, k, mesh%quad_part) > 0), &
         & k=1, size(self%layer))]))
      allocate (self%cell(0), self%quad(0))
      before = 0
      do k = 1, size(self%layer)
         own = pack([(i, i=1, size(output_node, 2))], self%batch(1, k, mesh%quad_part) > 0)
         first = max(1, piece%cells%first - before + 1)
         last = min(size(own), piece%cells%first + piece%cells%count - before)
         self%cell = [self%cell, (k, i=first, last)]
         self%quad = [self%quad, own(first:last)]
         before = before + size(own)
      end do
      piece%kind = merge(linear_cell, quadratic_cell, corners == 4)
      allocate (piece%connectivity(corners, piece%cells%count))
      do i = 1, piece%cells%count
         piece%connectivity(:, i) = output_node(:, self%quad(i)) - 1 &
            & + self%accumulators%nodes*(self%cell(i) - 1)
      end do
   end subroutine make_cells

   !> What does not change: interface, plies, angles, element
   subroutine add_cell_fields(self, model, domain)
      class(interface_fields_type), intent(inout) :: self
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain

      real(wp), dimension(size(self%cell)) :: above, below
      integer, dimension(size(self%cell)) :: number, ply_above, ply_below
      integer :: i

      number(:) = self%ply(self%cell)
      do i = 1, size(number)
         associate (plies => model%parts(model%mesh%quad_part(self%quad(i)))%plies)
            ply_below(i) = plies(number(i))%id
            ply_above(i) = plies(number(i) + 1)%id
            below(i) = plies(number(i))%angle
            above(i) = plies(number(i) + 1)%angle
         end associate
      end do
      call self%file%add_cell_data("interface", number)
      call self%file%add_cell_data("ply_below", ply_below)
      call self%file%add_cell_data("ply_above", ply_above)
      call self%file%add_cell_data("angle_below", below)
      call self%file%add_cell_data("angle_above", above)
      call self%file%add_cell_data("element", model%mesh%quad_id(self%quad))
   end subroutine add_cell_fields

   subroutine write_fields(self, domain, state)
      class(interface_fields_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state

      real(wp), allocatable :: values(:, :)

      allocate (values(interface_numbers, self%accumulators%own_points()))
      values(:6, :) = face_motion(self, domain, state)
      values(7:, :) = point_values(self, domain, state)
      call self%write_values(values)
   end subroutine write_fields

   !> Mean and difference of the motion of both faces at the points of this rank, (6, points)
   function face_motion(self, domain, state) result(motion)
      type(interface_fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      real(wp), allocatable :: motion(:, :)

      real(wp) :: at_node(6, size(self%layer), self%accumulators%count)
      integer :: c, k

      associate (node => self%accumulators%node, columns => domain%columns, &
         & u => state%displacement)
         do k = 1, size(self%layer)
            do c = 1, 3
               associate (below => u(columns%freedom(self%layer(k), &
                  & columns%levels(self%layer(k)), c, node)), &
                  & above => u(columns%freedom(self%layer(k) + 1, 1, c, node)))
                  at_node(c, k, :) = 0.5_wp*(above + below)
                  at_node(c + 3, k, :) = above - below
               end associate
            end do
         end do
      end associate
      allocate (motion(6, self%accumulators%own_points()))
      call self%accumulators%take(at_node, motion)
   end function face_motion

   !> Damage, mix of modes and energies at the points of this rank: of the nearest point of each
   !> quad, averaged by area over the quads of its part that meet there, (values, points)
   function point_values(self, domain, state) result(values)
      type(interface_fields_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      real(wp), allocatable :: values(:, :)

      real(wp) :: sums(damage_values + 1, size(self%layer), self%accumulators%count)
      integer :: i, k

      sums(:, :, :) = 0.0_wp
      do i = 1, size(self%accumulators%element, 2)
         associate (e => self%accumulators%element(2, i), &
            & batch => self%batch(:, :, domain%groups(self%accumulators%element(1, i))%item%set))
            do k = 1, size(self%layer)
               if (batch(1, k) > 0) call self%accumulators%add(i, k, &
                  & interface_values(domain, state, [batch(:, k), e]), sums)
            end do
         end associate
      end do
      allocate (values(damage_values, self%accumulators%own_points()))
      call self%accumulators%mean(sums, values)
      ! round-off of the shares
      values(:, :) = max(values, 0.0_wp)
      values(at_damage, :) = min(values(at_damage, :), 1.0_wp)
      values(at_mixity, :) = min(values(at_mixity, :), 1.0_wp)
      values(at_share, :) = min(values(at_share, :), 1.0_wp)
   end function point_values

   !> Values at the points of a quad in tensor order, the mix of modes at the nodes,
   !> (values, side**2)
   function interface_values(domain, state, place) result(values)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      !> Group, lane and quad
      integer, intent(in) :: place(3)
      real(wp), allocatable :: values(:, :)

      select type (group => domain%groups(place(1))%item)
      type is (interface_group_type)
         allocate (values(damage_values, group%batch%side**2), source=0.0_wp)
         call find_mixity(domain, group%batch, place, state%displacement, values(at_mixity, :))
         if (group%batch%law%histories == 0) return
         call find_losses(group%batch, place, state%history(group%batch%first_history:), values)
      end select
   end function interface_values

   !> Damage and energy from the history
   subroutine find_losses(batch, place, history, values)
      type(interface_type), intent(in) :: batch
      integer, intent(in) :: place(3)
      !> History of the batch
      real(wp), intent(in) :: history(lanes, size(batch%node, 1), size(batch%node, 2), &
         & batch%law%histories)
      real(wp), intent(inout) :: values(:, :)

      real(wp) :: h(size(values, 2), batch%law%histories)
      integer :: first

      ! in crack zones the mean of both points at a node
      h(:, :) = 0.0_wp
      do first = 1, size(history, 2), size(h, 1)
         h(:, :) = h + history(place(2), first:first + size(h, 1) - 1, place(3), :)
      end do
      h(:, :) = h*real(size(h, 1), wp)/real(size(history, 2), wp)
      values(at_damage, :) = h(:, damage_at)
      values(at_dissipated, :) = h(:, fracture_at)
      values(at_share, :) = h(:, share_at)
      if (size(h, 2) < closing_at) return
      values(at_dissipated, :) = values(at_dissipated, :) + h(:, closing_at)
      if (size(h, 2) < friction_at) return
      values(at_dissipated, :) = values(at_dissipated, :) + h(:, friction_at)
   end subroutine find_losses

   !> Share of shear at the nodes; 0 where the faces do not move apart
   subroutine find_mixity(domain, batch, place, displacement, mixity)
      type(domain_type), intent(in) :: domain
      type(interface_type), intent(in) :: batch
      integer, intent(in) :: place(3)
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> Share at each node, (side**2)
      real(wp), intent(out) :: mixity(:)

      real(wp), dimension(lanes, 3, size(mixity)) :: jump, stretch, middle
      real(wp) :: above, axes(lanes, 3, 3, size(mixity)), below, opening, sliding
      integer :: c, q

      associate (columns => domain%columns, lower => batch%lower(place(2)), &
         & node => batch%node(:size(mixity), place(3)), stiffness => batch%law%stiffness)
         do q = 1, size(node)
            do c = 1, 3
               below = displacement(columns%freedom(lower, columns%levels(lower), c, node(q)))
               above = displacement(columns%freedom(lower + 1, 1, c, node(q)))
               jump(:, c, q) = above - below
               middle(:, c, q) = above + below
            end do
         end do
         if (domain%control%kinematics == total_lagrangian) then
            call find_axes(batch%side, quad_node_metric(batch%side, &
               & domain%position(1:2, node)), middle, axes, stretch)
            call rotate_in(size(node), axes, jump)
         end if
         do q = 1, size(node)
            opening = stiffness(normal)*max(jump(1, 3, q), 0.0_wp)**2
            sliding = stiffness(shear)*sum(jump(1, 1:2, q)**2)
            mixity(q) = sliding/max(opening + sliding, tiny(1.0_wp))
         end do
      end associate
   end subroutine find_mixity

end module plydyn_io_vtkhdf_interface_fields
