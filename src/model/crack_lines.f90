!> Lines of doubled nodes in a crack zone, and the twins of these nodes in the mesh.
!>
!> A node is doubled in a ply if a crack line of the ply passes through it, all quads at it belong
!> to the zone, and some lie on either side of the line. At a corner of the plate that a line cuts
!> along the diagonal of its only quad it is not: the face of the plate would have one copy alone.
!> One twin stands for all plies that need it: its column of points is as high as any other, and
!> empty where a ply has no line.
module plydyn_model_crack_lines
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_model_crack_zone, only : by_turns, corner_direction, crack_zone_type, &
      & cracking_ply_type, first_diagonal, line_corners, second_diagonal, sees_twin
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_layup, only : ply_type
   implicit none
   private

   public :: double_nodes, find_lattice, find_lines

   !> Share of an edge by which quads may differ, and sine of the angle by which fibres may lie off
   !> a line
   real(wp), parameter :: tolerance = 2.0e-3_wp
   !> Corners of a quad in tensor order, as places in that of the deck
   integer, parameter :: tensor_corner(4) = [1, 2, 4, 3]

contains

   !> Find the edges of the quads of a zone and turn all quads alike, so that each begins at the
   !> same corner
   pure subroutine find_lattice(mesh, zone, problem)
      !> The mesh; the order of the nodes of the zone's quads may change
      type(mesh_type), intent(inout) :: mesh
      !> Gets edges and origin
      type(crack_zone_type), intent(inout) :: zone
      !> What is wrong, empty if nothing is
      character(:), allocatable, intent(out) :: problem

      integer :: e, first, i, turn
      integer, allocatable :: quads(:)

      problem = ""
      quads = pack([(e, e=1, size(mesh%quad_part))], mesh%quad_part == zone%part)
      if (size(mesh%quad_node, 1) /= 4) then
         problem = "quads have nine nodes: cracks need quads of four"
         return
      end if
      if (size(quads) == 0) return
      first = quads(1)
      ! the corner from which an edge goes farthest along x
      associate (x => mesh%position(1, mesh%quad_node(:, first)))
         turn = maxloc(cshift(x, 1) - x, 1) - 1
      end associate
      mesh%quad_node(:, first) = cshift(mesh%quad_node(:, first), turn)
      zone%edge(:, :) = edges_of(mesh, first)
      do i = 1, size(quads)
         call turn_quad(zone%edge, quads(i), mesh, turn)
         if (turn >= 0) cycle
         problem = "element "//text(mesh%quad_id(quads(i)))//" is no parallelogram equal to " &
            & //"element "//text(mesh%quad_id(first))
         return
      end do
      zone%origin(:) = middle_node(mesh, quads)
   end subroutine find_lattice

   !> First and second edge of a quad, from its first corner
   pure function edges_of(mesh, quad) result(edge)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in) :: quad
      real(wp) :: edge(2, 2)

      associate (x => mesh%position(:2, mesh%quad_node(:, quad)))
         edge(:, 1) = x(:, 2) - x(:, 1)
         edge(:, 2) = x(:, 4) - x(:, 1)
      end associate
   end function edges_of

   !> Let a quad begin at the corner that gives it some edges
   pure subroutine turn_quad(edge, quad, mesh, turn)
      real(wp), intent(in) :: edge(2, 2)
      integer, intent(in) :: quad
      type(mesh_type), intent(inout) :: mesh
      !> By how many corners; -1 if the quad has other edges
      integer, intent(out) :: turn

      real(wp) :: away
      integer :: node(4)

      node(:) = mesh%quad_node(:, quad)
      do turn = 0, 3
         mesh%quad_node(:, quad) = cshift(node, turn)
         away = maxval(abs(edges_of(mesh, quad) - edge))
         associate (x => mesh%position(:2, mesh%quad_node(:, quad)))
            away = max(away, maxval(abs(x(:, 3) - x(:, 2) - edge(:, 2))))
         end associate
         if (away <= tolerance*maxval(abs(edge))) return
      end do
      turn = -1
   end subroutine turn_quad

   !> The node nearest to the middle of some quads, the first of equal ones
   pure function middle_node(mesh, quads) result(origin)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in) :: quads(:)
      real(wp) :: origin(2)

      real(wp) :: away(size(quads)), low(2), high(2)
      integer :: e

      associate (x => mesh%position(:2, pack(mesh%quad_node(:, quads), .true.)))
         low(:) = minval(x, 2)
         high(:) = maxval(x, 2)
      end associate
      do e = 1, size(quads)
         away(e) = norm2(mesh%position(:2, mesh%quad_node(1, quads(e))) - 0.5_wp*(low + high))
      end do
      ! equal distances differ by their round-off
      e = findloc(away <= minval(away) + tolerance*norm2(high - low), .true., 1)
      origin(:) = mesh%position(:2, mesh%quad_node(1, quads(e)))
   end function middle_node

   !> Find where the lines of each ply lie
   pure subroutine find_lines(plies, zone, problem)
      !> The plies of the zone
      type(ply_type), intent(in) :: plies(:)
      !> Has its edges; gets its plies
      type(crack_zone_type), intent(inout) :: zone
      !> What is wrong, empty if nothing is
      character(:), allocatable, intent(out) :: problem

      integer :: p

      problem = ""
      allocate (zone%plies(size(plies)))
      do p = 1, size(plies)
         call find_ply_lines(plies(p)%angle, zone, zone%plies(p))
         if (zone%plies(p)%pitch > 0.0_wp) cycle
         problem = "the fibres of ply "//text(plies(p)%id)//" at "//text(plies(p)%angle) &
            & //" degrees lie along no edge and no diagonal of the quads"
         return
      end do
   end subroutine find_lines

   !> Find the lines of one ply
   pure subroutine find_ply_lines(angle, zone, ply)
      !> Fibre direction, degrees from the x axis
      real(wp), intent(in) :: angle
      type(crack_zone_type), intent(in) :: zone
      !> Gets directions, pitch and diagonal; no pitch where there is no line along the fibres
      type(cracking_ply_type), intent(inout) :: ply

      real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp

      ply%along(:) = [cos(angle*degree), sin(angle*degree)]
      ply%across(:) = [-ply%along(2), ply%along(1)]
      associate (a => zone%edge(:, 1), b => zone%edge(:, 2))
         if (is_along(a)) then
            ply%pitch = abs(dot_product(b, ply%across))
         else if (is_along(b)) then
            ply%pitch = abs(dot_product(a, ply%across))
         else if (is_along(a + b)) then
            ply%pitch = abs(dot_product(a, ply%across))
            ply%diagonal = first_diagonal
         else if (is_along(b - a)) then
            ply%pitch = abs(dot_product(a, ply%across))
            ply%diagonal = second_diagonal
         end if
      end associate
      if (ply%pitch > 0.0_wp) ply%every = max(1, nint(zone%spacing/ply%pitch))
   contains
      !> Whether the fibres lie along a vector
      pure logical function is_along(vector)
         real(wp), intent(in) :: vector(2)

         is_along = abs(dot_product(vector, ply%across)) <= tolerance*norm2(vector)
      end function is_along
   end subroutine find_ply_lines

   !> Double the nodes on the lines of a zone: their twins follow all other nodes of the mesh
   pure subroutine double_nodes(mesh, zone)
      !> The mesh
      type(mesh_type), intent(inout) :: mesh
      !> Has the lines of its plies; gets its doubled nodes
      type(crack_zone_type), intent(inout) :: zone

      real(wp), allocatable :: length(:, :)
      integer :: before, i

      call find_lengths(mesh, zone, length)
      before = size(mesh%node_id)
      zone%node = pack([(i, i=1, before)], any(length > 0.0_wp, 1))
      zone%twin = [(before + i, i=1, size(zone%node))]
      zone%length = length(:, zone%node)
      allocate (zone%place(before + size(zone%node)), source=0)
      zone%place(zone%node) = [(i, i=1, size(zone%node))]
      zone%place(zone%twin) = zone%place(zone%node)
      call find_ends(mesh, zone)
      if (.not. allocated(mesh%twin)) allocate (mesh%twin(before), source=0)
      mesh%twin(zone%node) = zone%twin
      mesh%twin = [mesh%twin, spread(0, 1, size(zone%node))]
      mesh%node_id = [mesh%node_id, mesh%node_id(zone%node)]
      mesh%position = reshape([mesh%position, mesh%position(:, zone%node)], [3, size(mesh%node_id)])
      call find_faces(mesh, zone)
   end subroutine double_nodes

   !> Find the ends of lines: nodes from which not both ways lead to another node of the line
   pure subroutine find_ends(mesh, zone)
      type(mesh_type), intent(in) :: mesh
      !> Has its doubled nodes and the length at each
      type(crack_zone_type), intent(inout) :: zone

      logical :: goes_on(size(zone%plies), size(zone%node), 2)
      integer :: at(2), corner(2), e, p

      goes_on(:, :, :) = .false.
      do p = 1, size(zone%plies)
         corner(:) = line_corners(zone, p)
         do e = 1, size(mesh%quad_part)
            if (mesh%quad_part(e) /= zone%part) cycle
            at(:) = zone%place(mesh%quad_node(corner, e))
            if (any(at == 0)) cycle
            if (any(zone%length(p, at) <= 0.0_wp)) cycle
            goes_on(p, at(1), 1) = .true.
            goes_on(p, at(2), 2) = .true.
         end do
      end do
      zone%is_end = zone%length > 0.0_wp .and. .not. all(goes_on, 3)
   end subroutine find_ends

   !> Length of crack at each node of the mesh in each ply, (plies, nodes)
   pure subroutine find_lengths(mesh, zone, length)
      type(mesh_type), intent(in) :: mesh
      type(crack_zone_type), intent(in) :: zone
      real(wp), allocatable, intent(out) :: length(:, :)

      integer :: corners(size(mesh%node_id)), c, e, h, n, others(size(mesh%node_id)), p, side(2)
      logical, dimension(size(zone%plies), size(mesh%node_id)) :: has_whole
      logical :: sides(2, size(zone%plies), size(mesh%node_id))
      real(wp) :: area

      corners(:) = 0
      others(:) = 0
      sides(:, :, :) = .false.
      has_whole(:, :) = .false.
      do e = 1, size(mesh%quad_part)
         associate (node => mesh%quad_node(tensor_corner, e))
            if (mesh%quad_part(e) /= zone%part) then
               others(node) = others(node) + 1
               cycle
            end if
            corners(node) = corners(node) + 1
            do c = 1, 4
               do p = 1, size(zone%plies)
                  side(:) = [(merge(2, 1, dot_product(zone%plies(p)%across, &
                     & corner_direction(zone%edge, c, h)) > 0.0_wp), h=1, 2)]
                  sides(side, p, node(c)) = .true.
                  if (side(1) == side(2)) has_whole(p, node(c)) = .true.
               end do
            end do
         end associate
      end do
      allocate (length(size(zone%plies), size(corners)), source=0.0_wp)
      area = abs(zone%edge(1, 1)*zone%edge(2, 2) - zone%edge(2, 1)*zone%edge(1, 2))
      do n = 1, size(corners)
         if (corners(n) == 0 .or. others(n) > 0) cycle
         do p = 1, size(zone%plies)
            if (.not. (all(sides(:, p, n)) .and. has_whole(p, n))) cycle
            if (.not. is_on_line(zone, p, mesh%position(:2, n))) cycle
            ! between neighbouring nodes of a line lies the area of a quad over the pitch
            length(p, n) = 0.25_wp*corners(n)*(area/zone%plies(p)%pitch)
         end do
      end do
   end subroutine find_lengths

   !> Whether a crack line of a ply passes through a place
   pure logical function is_on_line(zone, p, position)
      type(crack_zone_type), intent(in) :: zone
      integer, intent(in) :: p
      real(wp), intent(in) :: position(2)

      associate (ply => zone%plies(p))
         is_on_line = mod(nint(dot_product(position - zone%origin, ply%across)/ply%pitch), &
            & ply%every) == 0
      end associate
   end function is_on_line

   !> Nodes of all quads as their bottom and top faces have them: a crack of an outer ply along the
   !> edges of a quad parts its corners from those of the next one. Where a quad lies on both sides
   !> of a crack, along its diagonal, its corners there are those of the nodes, or of twins that no
   !> other quad has, as at a free edge: a body that touches the face must push both
   pure subroutine find_faces(mesh, zone)
      type(mesh_type), intent(inout) :: mesh
      type(crack_zone_type), intent(in) :: zone

      ! whether some quad lies wholly beyond the crack at a node, and so has the twin
      logical :: has_beyond(size(mesh%node_id))
      integer :: c, e, f, pass, ply, seen

      if (.not. allocated(mesh%face_node)) then
         mesh%face_node = reshape([mesh%quad_node, mesh%quad_node], [shape(mesh%quad_node), 2])
      end if
      do f = 1, 2
         ply = merge(1, size(zone%plies), f == 1)
         has_beyond(:) = .false.
         do pass = 1, 2
            do e = 1, size(mesh%quad_part)
               if (mesh%quad_part(e) /= zone%part) cycle
               do c = 1, 4
                  associate (node => mesh%quad_node(tensor_corner(c), e))
                     seen = halves_beyond(zone, ply, node, c)
                     if (seen == 2) has_beyond(node) = .true.
                     if (seen == 1 .and. (pass == 1 .or. has_beyond(node))) cycle
                     if (seen > 0) mesh%face_node(tensor_corner(c), e, f) = mesh%twin(node)
                  end associate
               end do
            end do
         end do
      end do
   end subroutine find_faces

   !> How many halves of a corner of a quad lie beyond the crack of a ply at its node
   pure integer function halves_beyond(zone, ply, node, corner) result(halves)
      type(crack_zone_type), intent(in) :: zone
      !> Ply from the bottom, node of the mesh, corner in tensor order
      integer, intent(in) :: ply, node, corner

      integer :: h

      halves = count([(sees_twin(zone, ply, node, corner_direction(zone%edge, corner, h)), h=1, 2)])
   end function halves_beyond

end module plydyn_model_crack_lines
