!> Chunks of quads: which quads lie together, and the columns that take their forces.
module plydyn_domain_chunks
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_domain_columns, only : columns_type, front
   use plydyn_domain_domain, only : chunk_type, domain_type, surface_type
   use plydyn_element_brick, only : bricks_type
   use plydyn_model_mesh, only : mesh_type
   implicit none
   private

   public :: border_nodes, divide_quads, give_borders, give_held, give_makers, list_chunks, &
      & quad_centres, set_targets

   !> Most quads of a chunk: large enough that few nodes lie on borders, small enough that chunks
   !> outnumber threads and one stays in the cache
   integer, parameter :: most_quads = 8
   !> Parts of the width that coordinates are rounded to: quads in a row stay in it
   real(wp), parameter :: fineness = 1.0e5_wp

contains

   !> Order quads so that chunks of consecutive ones lie close together: halves along the longer
   !> extent, again and again
   pure subroutine divide_quads(centre, order, last)
      !> Centres of the quads, (2, quads)
      real(wp), intent(in) :: centre(:, :)
      !> The quads in their new order
      integer, allocatable, intent(out) :: order(:)
      !> Place in it of the last quad of each chunk
      integer, allocatable, intent(out) :: last(:)

      logical :: is_last(size(centre, 2))
      integer :: i

      order = [(i, i=1, size(centre, 2))]
      is_last(:) = .false.
      call divide(centre, order, is_last)
      last = pack([(i, i=1, size(order))], is_last)
   end subroutine divide_quads

   !> Divide some quads in two, unless they are one chunk
   pure recursive subroutine divide(centre, order, is_last)
      real(wp), intent(in) :: centre(:, :)
      integer, intent(inout) :: order(:)
      logical, intent(inout) :: is_last(:)

      integer :: axis, chunks, left
      real(wp) :: extent(2), low(2)

      if (size(order) == 0) return
      chunks = (size(order) + most_quads - 1)/most_quads
      if (chunks == 1) then
         is_last(size(is_last)) = .true.
         return
      end if
      low(:) = minval(centre(:, order), 2)
      extent(:) = maxval(centre(:, order), 2) - low
      axis = maxloc(extent, 1)
      order(:) = order(sorted_order(nint(fineness*(centre(axis, order) - low(axis))/extent(axis))))
      left = size(order)*(chunks/2)/chunks
      call divide(centre, order(:left), is_last(:left))
      call divide(centre, order(left + 1:), is_last(left + 1:))
   end subroutine divide

   !> Mean position of the nodes of some quads, (2, quads)
   pure function quad_centres(mesh, quad) result(centre)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The quads, indices into it
      integer, intent(in) :: quad(:)
      real(wp) :: centre(2, size(quad))
      integer :: e

      do e = 1, size(quad)
         associate (node => mesh%quad_node(:, quad(e)))
            centre(:, e) = sum(mesh%position(1:2, node), 2)/real(size(node), wp)
         end associate
      end do
   end function quad_centres

   !> Column of the node of each column: itself, or that of its border where it lies behind
   pure function border_nodes(columns, borders) result(node)
      !> Where the points lie
      type(columns_type), intent(in) :: columns
      !> As in `domain_type`
      integer, intent(in) :: borders(:, :)
      integer, allocatable :: node(:)
      integer :: b, c

      allocate (node((columns%forces - front)/columns%height))
      node(:columns%count) = [(c, c=1, columns%count)]
      do b = 1, size(borders, 2)
         node(borders(2, b):borders(3, b)) = borders(1, b)
      end do
   end function border_nodes

   !> Let all quads and bricks add to the columns of their chunks
   pure subroutine set_targets(domain)
      !> The domain; its chunks have their columns, plates and bricks get their targets
      type(domain_type), intent(inout) :: domain

      integer :: c, k, target(domain%columns%count)
      integer, allocatable :: node(:)

      node = border_nodes(domain%columns, domain%borders)
      do c = 1, size(domain%chunks)
         associate (chunk => domain%chunks(c))
            target(node(chunk%column)) = chunk%column
            if (size(domain%bricks) > 0) then
               call aim_bricks(domain%columns%height, chunk, target, domain%bricks(chunk%plate))
            else
               call aim_quads(chunk, target, domain%plates(chunk%plate)%node, &
                  & domain%plates(chunk%plate)%target)
            end if
         end associate
      end do
      do k = 1, size(domain%interfaces)
         domain%interfaces(k)%target(:, :) = abs(domain%plates(domain%interfaces(k)%plate)%target)
      end do
   end subroutine set_targets

   !> Let every chunk add up the borders at the columns that it moves
   pure subroutine give_borders(domain)
      !> With the columns of all chunks; the chunks get their borders
      type(domain_type), intent(inout) :: domain

      integer :: chunk(size(domain%borders, 2)), c, i

      chunk(:) = chunks_of(domain, domain%borders(1, :))
      do c = 1, size(domain%chunks)
         domain%chunks(c)%borders = pack([(i, i=1, size(chunk))], chunk == c)
      end do
   end subroutine give_borders

   !> Let every chunk know whose forces its points need
   pure subroutine give_makers(domain)
      !> With columns and borders of all chunks; the chunks get their makers
      type(domain_type), intent(inout) :: domain

      integer :: c, i, maker(column_count(domain))
      integer, allocatable :: list(:)

      maker(:) = makers_of(domain)
      do c = 1, size(domain%chunks)
         associate (chunk => domain%chunks(c))
            list = [c, maker([chunk%own, chunk%guests])]
            do i = 1, size(chunk%borders)
               associate (border => domain%borders(:, chunk%borders(i)))
                  list = [list, maker(border(2):border(3))]
               end associate
            end do
            chunk%makers = each_once(list)
         end associate
      end do
   end subroutine give_makers

   !> Let every chunk hold the points of the columns that it moves
   pure subroutine give_held(domain)
      !> With the columns of all chunks, and held points; the chunks get theirs
      type(domain_type), intent(inout) :: domain

      integer :: chunk(size(domain%held)), c, i

      chunk(:) = chunks_of(domain, domain%columns%column_of(domain%held))
      do c = 1, size(domain%chunks)
         domain%chunks(c)%held = runs_of(domain%held, pack([(i, i=1, size(chunk))], chunk == c))
      end do
   end subroutine give_held

   !> Held points that follow each other, in their list as in the arrays of motion: first and last
   !> of each run, (2, runs)
   pure function runs_of(held, points) result(runs)
      !> Places of all held points
      integer, intent(in) :: held(:)
      !> Some of them, in rising order
      integer, intent(in) :: points(:)
      integer, allocatable :: runs(:, :)

      logical :: goes_on(0:size(points))
      integer :: i

      goes_on(:) = .false.
      do i = 1, size(points) - 1
         goes_on(i) = points(i + 1) == points(i) + 1
         if (goes_on(i)) goes_on(i) = held(points(i + 1)) == held(points(i)) + 1
      end do
      i = count(.not. goes_on(1:))
      allocate (runs(2, i))
      runs(1, :) = pack(points, .not. goes_on(:size(points) - 1))
      runs(2, :) = pack(points, .not. goes_on(1:))
   end function runs_of

   !> Chunks at the points of each facet of a face
   pure subroutine list_chunks(domain, surface, last, list)
      !> With columns and borders of all chunks
      type(domain_type), intent(in) :: domain
      !> The face
      type(surface_type), intent(in) :: surface
      !> Last place of each facet in the list, after that of none
      integer, allocatable, intent(out) :: last(:)
      !> The chunks, facet by facet, each once
      integer, allocatable, intent(out) :: list(:)

      integer :: border(domain%columns%count), maker(column_count(domain))
      integer :: b, f, i
      integer, allocatable :: here(:)

      maker(:) = makers_of(domain)
      border(:) = 0
      border(domain%borders(1, :)) = [(b, b=1, size(domain%borders, 2))]
      allocate (last(0:size(surface%facet, 2)), source=0)
      allocate (list(size(surface%facet)))
      do f = 1, size(surface%facet, 2)
         here = [integer ::]
         do i = 1, size(surface%facet, 1)
            associate (place => surface%freedom(1, surface%facet(i, f)))
               if (place == 0) cycle
               b = domain%columns%column_of(place)
               here = [here, maker(b)]
               if (border(b) == 0) cycle
               here = [here, maker(domain%borders(2, border(b)):domain%borders(3, border(b)))]
            end associate
         end do
         here = each_once(pack(here, here > 0))
         last(f) = last(f - 1) + size(here)
         if (last(f) > size(list)) list = [list, list]
         list(last(f - 1) + 1:last(f)) = here
      end do
   end subroutine list_chunks

   !> Columns of a domain, with those behind
   pure integer function column_count(domain) result(columns)
      type(domain_type), intent(in) :: domain

      columns = (domain%columns%forces - front)/domain%columns%height
   end function column_count

   !> Chunk that makes the forces of each column; 0 where another rank does
   pure function makers_of(domain) result(maker)
      type(domain_type), intent(in) :: domain
      integer :: maker(column_count(domain))
      integer :: c

      maker(:) = 0
      do c = 1, size(domain%chunks)
         maker(domain%chunks(c)%column) = c
      end do
   end function makers_of

   !> Numbers in rising order, each once
   pure function each_once(list) result(numbers)
      integer, intent(in) :: list(:)
      integer, allocatable :: numbers(:)

      numbers = list(sorted_order(list))
      if (size(list) > 1) numbers = pack(numbers, [.true., numbers(2:) /= numbers(:size(list) - 1)])
   end function each_once

   !> Chunks that move some columns
   pure function chunks_of(domain, column) result(chunk)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: column(:)
      integer :: chunk(size(column))

      integer :: c, mover(domain%columns%count)

      do c = 1, size(domain%chunks)
         mover(domain%chunks(c)%own) = c
         mover(domain%chunks(c)%guests) = c
      end do
      chunk(:) = mover(column)
   end function chunks_of

   !> Columns that take the forces of a chunk of quads. The first quad at one begins its forces: the
   !> layers of a quad fill the columns of its nodes
   pure subroutine aim_quads(chunk, column, node, target)
      type(chunk_type), intent(in) :: chunk
      !> That of each node
      integer, intent(in) :: column(:)
      !> Nodes of each quad
      integer, intent(in) :: node(:, :)
      integer, intent(inout) :: target(:, :)

      integer :: e, i
      logical :: is_new(size(column))

      is_new(:) = .true.
      do e = chunk%quads(1), chunk%quads(2)
         do i = 1, size(node, 1)
            target(i, e) = merge(-1, 1, is_new(node(i, e)))*column(node(i, e))
            is_new(node(i, e)) = .false.
         end do
      end do
   end subroutine aim_quads

   !> Places that take the forces of a chunk of bricks: the same ones in other columns
   pure subroutine aim_bricks(height, chunk, column, bricks)
      !> Length of a column
      integer, intent(in) :: height
      type(chunk_type), intent(in) :: chunk
      integer, intent(in) :: column(:)
      type(bricks_type), intent(inout) :: bricks

      integer :: b, n

      do b = chunk%quads(1), chunk%quads(2)
         do n = 1, size(bricks%place, 2)
            associate (place => bricks%place(:, n, b) - front - 1)
               bricks%target(:, n, b) = front + 1 + mod(place, height) &
                  & + height*(column(1 + place/height) - 1)
            end associate
         end do
      end do
   end subroutine aim_bricks

end module plydyn_domain_chunks
