!> Loads as forces on the points that a rank has.
module plydyn_domain_loads
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_fem_columns, only : columns_type
   use plydyn_domain_domain, only : domain_type, load_type
   use plydyn_domain_local_to_global, only : local_to_global_type
   use plydyn_domain_supports, only : face_point, points_of
   use plydyn_element_quad, only : plane_table, quad_metric, tensor_order
   use plydyn_fem_quadrature, only : gauss_points, gauss_weights
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : all_planes, body_load_type, line_load_type, point_load_type, &
      & pressure_type, segment_load_type, top_face
   implicit none
   private

   public :: build_loads

   !> Corners and mid-side of each side of a quad, in the order of the deck
   integer, parameter :: side_nodes(3, 4) = reshape([1, 5, 2, 2, 6, 3, 3, 7, 4, 4, 8, 1], [3, 4])

contains

   !> Forces on points
   subroutine build_loads(model, numbering, domain)
      type(model_type), intent(in) :: model
      type(local_to_global_type), intent(in) :: numbering
      !> Has its masses; gets loads
      type(domain_type), intent(inout) :: domain
      integer :: i, k

      allocate (domain%loads(size(model%point_loads) + size(model%line_loads) &
         & + size(model%pressures) + size(model%segment_loads) + size(model%body_loads)))
      k = 0
      associate (loads => domain%loads)
         do i = 1, size(model%point_loads)
            k = k + 1
            loads(k) = new_point_load(model%point_loads(i), numbering, domain)
         end do
         do i = 1, size(model%line_loads)
            k = k + 1
            associate (load => model%line_loads(i))
               loads(k) = new_face_load(load%face, load%direction, load%curve, &
                  & line_force(load, model%mesh), numbering, domain)
            end associate
         end do
         do i = 1, size(model%pressures)
            k = k + 1
            associate (load => model%pressures(i))
               loads(k) = new_face_load(load%face, 3, load%curve, &
                  & pressure_force(load, model%mesh), numbering, domain)
            end associate
         end do
         do i = 1, size(model%segment_loads)
            k = k + 1
            loads(k) = new_segment_load(model%segment_loads(i), model%mesh, numbering, &
               & domain%columns)
         end do
         do i = 1, size(model%body_loads)
            k = k + 1
            loads(k) = new_body_load(model%body_loads(i), domain)
         end do
         do k = 1, size(loads)
            call order_load(loads(k), domain%columns)
         end do
      end associate
   end subroutine build_loads

   !> Forces at nodes: on a face, or shared by the column in proportion to its masses
   pure function new_point_load(load, numbering, domain) result(self)
      !> As the deck says
      type(point_load_type), intent(in) :: load
      type(local_to_global_type), intent(in) :: numbering
      !> Has layers, columns and masses
      type(domain_type), intent(in) :: domain
      type(load_type) :: self

      real(wp), allocatable :: mass(:)
      integer, allocatable :: nodes(:), points(:, :)
      integer :: i, point(2)

      self%curve = load%curve
      nodes = numbering%only(load%nodes)
      if (load%face /= all_planes) then
         point(:) = face_point(domain%layers, load%face)
         self%freedom = domain%columns%freedom(point(1), point(2), load%direction, nodes)
         self%force = spread(load%scale, 1, size(nodes))
         return
      end if
      points = points_of(domain%layers, all_planes, 0.0_wp)
      allocate (self%freedom(0), self%force(0))
      do i = 1, size(nodes)
         mass = domain%inertia%mass(domain%columns%mass_of(points(1, :), points(2, :), nodes(i)))
         self%freedom = [self%freedom, domain%columns%freedom(points(1, :), points(2, :), &
            & load%direction, nodes(i))]
         self%force = [self%force, load%scale*mass/sum(mass)]
      end do
   end function new_point_load

   !> Forces at the nodes of a face
   pure function new_face_load(face, direction, curve, force, numbering, domain) result(self)
      !> `bottom_face` or `top_face`; 1 to 3 for x to z; index of the curve over time
      integer, intent(in) :: face, direction, curve
      !> Force at each node of the whole model
      real(wp), intent(in) :: force(:)
      type(local_to_global_type), intent(in) :: numbering
      !> Has layers, columns and masses
      type(domain_type), intent(in) :: domain
      type(load_type) :: self

      integer :: i, point(2)
      integer, allocatable :: loaded(:)

      point(:) = face_point(domain%layers, face)
      loaded = pack([(i, i=1, size(force))], abs(force) > 0.0_wp)
      loaded = pack(loaded, numbering%node(loaded) > 0)
      self%curve = curve
      self%freedom = domain%columns%freedom(point(1), point(2), direction, numbering%node(loaded))
      self%force = force(loaded)
   end function new_face_load

   !> Force at each node from every quad side that lies in a line, each once
   pure function line_force(load, mesh) result(force)
      !> As the deck says
      type(line_load_type), intent(in) :: load
      !> Nodes and quads
      type(mesh_type), intent(in) :: mesh
      real(wp) :: force(size(mesh%node_id))

      logical :: in_line(size(mesh%node_id))
      integer, allocatable :: done(:, :), line(:)
      integer :: e, nodes, s

      nodes = merge(3, 2, size(mesh%quad_node, 1) == 9)
      in_line(:) = .false.
      in_line(load%nodes) = .true.
      force(:) = 0.0_wp
      allocate (done(2, 0))
      do e = 1, size(mesh%quad_id)
         do s = 1, 4
            line = mesh%quad_node(pack(side_nodes(:, s), [.true., nodes == 3, .true.]), e)
            if (.not. all(in_line(line))) cycle
            if (any(done(1, :) == line(nodes) .and. done(2, :) == line(1))) cycle
            done = reshape([done, line(1), line(nodes)], [2, size(done, 2) + 1])
            force(line) = force(line) + line_shares(mesh%position(:, line))
         end do
      end do
      force(:) = load%scale*force
   end function line_force

   !> Integral of each shape function over a line of 2 or 3 nodes
   pure function line_shares(position) result(share)
      real(wp), intent(in) :: position(:, :)
      real(wp) :: share(size(position, 2))

      real(wp) :: gauss(3), slope(2, 9), tangent(3), value(9), w(3)
      integer :: k, n

      n = size(position, 2)
      gauss(:) = gauss_points(3)
      w(:) = gauss_weights(3)
      share(:) = 0.0_wp
      do k = 1, 3
         ! the side eta = -1 of a quad: its shape functions are those of the line
         call plane_table(n, gauss(k), -1.0_wp, value(:n*n), slope(:, :n*n))
         tangent(:) = matmul(position, slope(1, :n))
         share(:) = share + w(k)*norm2(tangent)*value(:n)
      end do
   end function line_shares

   !> Consistent force along z at each node from a pressure on a face
   pure function pressure_force(load, mesh) result(force)
      !> As the deck says
      type(pressure_type), intent(in) :: load
      !> Nodes and quads
      type(mesh_type), intent(in) :: mesh
      real(wp) :: force(size(mesh%node_id))

      integer :: e, side

      side = nint(sqrt(real(size(mesh%quad_node, 1), wp)))
      force(:) = 0.0_wp
      do e = 1, size(load%quads)
         associate (node => mesh%quad_node(tensor_order(side), load%quads(e)))
            force(node) = force(node) + area_shares(side, mesh%position(1:2, node))
         end associate
      end do
      force(:) = merge(-load%scale, load%scale, load%face == top_face)*force
   end function pressure_force

   !> Pressure on a face of a brick as consistent forces at its nodes
   pure function new_segment_load(load, mesh, numbering, columns) result(self)
      !> As the deck says
      type(segment_load_type), intent(in) :: load
      !> The nodes
      type(mesh_type), intent(in) :: mesh
      type(local_to_global_type), intent(in) :: numbering
      type(columns_type), intent(in) :: columns
      type(load_type) :: self

      real(wp) :: force(4, 3), gauss(2), slope(2, 4), tangent(3, 2), value(4)
      integer :: c, i, j, node(4)

      node(:) = load%node(tensor_order(2))
      gauss(:) = gauss_points(2)
      force(:, :) = 0.0_wp
      do j = 1, 2
         do i = 1, 2
            call plane_table(2, gauss(i), gauss(j), value, slope)
            tangent(:, :) = matmul(mesh%position(:, node), transpose(slope))
            do c = 1, 3
               associate (a => 1 + mod(c, 3), b => 1 + mod(c + 1, 3))
                  force(:, c) = force(:, c) - load%scale*value &
                     & *(tangent(a, 1)*tangent(b, 2) - tangent(b, 1)*tangent(a, 2))
               end associate
            end do
         end do
      end do
      self%curve = load%curve
      allocate (self%freedom(0), self%force(0))
      do c = 1, 3
         self%freedom = [self%freedom, columns%freedom(1, 1, c, numbering%only(node))]
         self%force = [self%force, pack(force(:, c), numbering%node(node) > 0)]
      end do
   end function new_segment_load

   !> Integral of each shape function over a quad
   pure function area_shares(side, xy) result(share)
      integer, intent(in) :: side
      real(wp), intent(in) :: xy(:, :)
      real(wp) :: share(side*side)

      real(wp) :: gauss(side), metric(5, side*side), slope(2, side*side), value(side*side)
      integer :: i, j

      gauss(:) = gauss_points(side)
      metric(:, :) = quad_metric(side, xy)
      share(:) = 0.0_wp
      do j = 1, side
         do i = 1, side
            call plane_table(side, gauss(i), gauss(j), value, slope)
            share(:) = share + metric(5, i + side*(j - 1))*value
         end do
      end do
   end function area_shares

   !> Inertia forces of an accelerated frame on all points
   pure function new_body_load(load, domain) result(self)
      !> As the deck says
      type(body_load_type), intent(in) :: load
      !> Has layers, columns and masses
      type(domain_type), intent(in) :: domain
      type(load_type) :: self

      integer, allocatable :: nodes(:), points(:, :)
      integer :: i, k

      self%curve = load%curve
      nodes = [(i, i=1, domain%columns%nodes)]
      points = points_of(domain%layers, all_planes, 0.0_wp)
      self%freedom = [(domain%columns%freedom(points(1, k), points(2, k), load%direction, nodes), &
         & k=1, size(points, 2))]
      self%force = -load%scale*domain%inertia%mass([(domain%columns%mass_of(points(1, k), &
         & points(2, k), nodes), k=1, size(points, 2))])
   end function new_body_load

   !> Put the forces of a load in the order of the columns
   pure subroutine order_load(load, columns)
      !> The load; gets the last force of each column
      type(load_type), intent(inout) :: load
      type(columns_type), intent(in) :: columns

      integer, allocatable :: column(:), order(:)
      integer :: i

      column = columns%column_of(load%freedom)
      order = sorted_order(column)
      load%freedom(:) = load%freedom(order)
      load%force(:) = load%force(order)
      column(:) = column(order)
      load%last = pack([(i, i=1, size(column))], [column(2:) /= column(:size(column) - 1), &
         & spread(.true., 1, min(1, size(column)))])
   end subroutine order_load

end module plydyn_domain_loads
