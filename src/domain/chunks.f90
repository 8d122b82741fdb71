!> Chunks of quads: which quads lie together, and the columns that take their forces.
module plydyn_domain_chunks
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : each_once, sorted_order
   use plydyn_fem_columns, only : alignment_offset
   use plydyn_domain_domain, only : domain_type, face_type
   use plydyn_model_mesh, only : mesh_type
   implicit none
   private

   public :: assign_held_points, assign_nodes, divide_quads, find_contributors, list_chunks, &
      & nodes_of_columns, quad_centres, set_targets

   !> Most quads of a chunk: large enough that few nodes are shared, small enough that chunks
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
      !> The quads in their new order; place in it of the last quad of each chunk
      integer, allocatable, intent(out) :: order(:), last(:)

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

   !> Column of the node of each column: itself, or the node's own where it lies behind
   pure function nodes_of_columns(domain) result(node)
      !> With the shared nodes of all chunks
      type(domain_type), intent(in) :: domain
      integer :: node(column_count(domain))

      integer :: b, c

      node(:domain%columns%count) = [(c, c=1, domain%columns%count)]
      associate (shared => domain%chunks%shared_nodes)
         do b = 1, size(shared, 2)
            node(shared(2, b):shared(3, b)) = shared(1, b)
         end do
      end associate
   end function nodes_of_columns

   !> Let all elements add to the columns of their chunks
   pure subroutine set_targets(domain)
      !> The domain; its chunks have their columns and get their groups, which get their targets
      type(domain_type), intent(inout) :: domain

      integer :: c, g, node(column_count(domain)), target(domain%columns%count)

      node(:) = nodes_of_columns(domain)
      do c = 1, size(domain%chunks%list)
         associate (chunk => domain%chunks%list(c))
            chunk%node = node(chunk%column)
            target(chunk%node) = chunk%column
            chunk%groups = pack([(g, g=1, size(domain%groups))], &
               & [(domain%groups(g)%item%set == chunk%set, g=1, size(domain%groups))])
            do g = 1, size(chunk%groups)
               call domain%groups(chunk%groups(g))%item%set_targets(chunk%elements, &
                  & domain%columns%height, target)
            end do
         end associate
      end do
   end subroutine set_targets

   !> Assign each shared node to the chunk that moves its column, and each doubled node, which moves
   !> with its twin
   pure subroutine assign_nodes(domain)
      !> With the columns of all chunks, and doubled nodes; the chunks get theirs
      type(domain_type), intent(inout) :: domain

      integer, dimension(0:size(domain%chunks%list)) :: last_doubled, last_shared
      integer, allocatable :: doubled(:), shared(:)
      integer :: c

      call sort_by_chunk(chunks_of(domain, domain%chunks%shared_nodes(1, :)), shared, last_shared)
      call sort_by_chunk(chunks_of(domain, domain%cracks%column(1, :)), doubled, last_doubled)
      do c = 1, size(domain%chunks%list)
         domain%chunks%list(c)%shared_nodes = shared(last_shared(c - 1) + 1:last_shared(c))
         domain%chunks%list(c)%cracks = doubled(last_doubled(c - 1) + 1:last_doubled(c))
      end do
   end subroutine assign_nodes

   !> Find the chunks whose forces the points of each chunk need
   pure subroutine find_contributors(domain)
      !> With columns and shared nodes of all chunks; the chunks get their contributors
      type(domain_type), intent(inout) :: domain

      integer :: c, i, force_chunk(column_count(domain))
      integer, allocatable :: list(:)

      force_chunk(:) = chunk_of_columns(domain)
      do c = 1, size(domain%chunks%list)
         associate (chunk => domain%chunks%list(c))
            list = [c, force_chunk([chunk%owned_columns, chunk%ghost_columns])]
            do i = 1, size(chunk%shared_nodes)
               associate (border => domain%chunks%shared_nodes(:, chunk%shared_nodes(i)))
                  list = [list, force_chunk(border(2):border(3))]
               end associate
            end do
            chunk%contributors = each_once(list)
         end associate
      end do
   end subroutine find_contributors

   !> Assign each held point to the chunk that moves its column
   pure subroutine assign_held_points(domain)
      !> With the columns of all chunks, and held points; the chunks get theirs
      type(domain_type), intent(inout) :: domain

      integer :: c, last(0:size(domain%chunks%list))
      integer, allocatable :: points(:)

      call sort_by_chunk(chunks_of(domain, domain%columns%column_of(domain%supports%held)), &
         & points, last)
      do c = 1, size(domain%chunks%list)
         domain%chunks%list(c)%held = runs_of(domain%supports%held, points(last(c - 1) + 1:last(c)))
      end do
   end subroutine assign_held_points

   !> Places of a list chunk by chunk, in their order in each of them
   pure subroutine sort_by_chunk(chunk, place, last)
      !> Chunk at each place
      integer, intent(in) :: chunk(:)
      !> The places, and where those of each chunk end among them, after those of none
      integer, allocatable, intent(out) :: place(:)
      integer, intent(out) :: last(0:)

      integer :: c, i

      place = sorted_order(chunk)
      last(:) = 0
      do i = 1, size(chunk)
         last(chunk(i)) = last(chunk(i)) + 1
      end do
      do c = 1, ubound(last, 1)
         last(c) = last(c) + last(c - 1)
      end do
   end subroutine sort_by_chunk

   !> Held points that follow each other, in their list as in the arrays of motion: first and last
   !> of each run, (2, runs)
   pure function runs_of(held, points) result(runs)
      !> Places of all held points; some of them, in rising order
      integer, intent(in) :: held(:), points(:)
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
      !> With columns and shared nodes of all chunks
      type(domain_type), intent(in) :: domain
      !> The face
      type(face_type), intent(in) :: surface
      !> Last place of each facet in the list, after that of none
      integer, allocatable, intent(out) :: last(:)
      !> The chunks, facet by facet, each once
      integer, allocatable, intent(out) :: list(:)

      integer :: border(domain%columns%count), force_chunk(column_count(domain)), b, f, i
      integer, allocatable :: here(:)

      force_chunk(:) = chunk_of_columns(domain)
      border(:) = 0
      border(domain%chunks%shared_nodes(1, :)) = [(b, b=1, size(domain%chunks%shared_nodes, 2))]
      allocate (last(0:size(surface%facet, 2)), source=0)
      allocate (list(size(surface%facet)))
      do f = 1, size(surface%facet, 2)
         here = [integer ::]
         do i = 1, size(surface%facet, 1)
            associate (place => surface%freedom(1, surface%facet(i, f)))
               if (place == 0) cycle
               b = domain%columns%column_of(place)
               here = [here, force_chunk(b)]
               if (border(b) == 0) cycle
               here = [here, force_chunk(domain%chunks%shared_nodes(2, &
                  & border(b)):domain%chunks%shared_nodes(3, border(b)))]
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

      columns = (domain%columns%forces - alignment_offset)/domain%columns%height
   end function column_count

   !> Chunk that makes the forces of each column; 0 where another rank does
   pure function chunk_of_columns(domain) result(force_chunk)
      type(domain_type), intent(in) :: domain
      integer :: force_chunk(column_count(domain))
      integer :: c

      force_chunk(:) = 0
      do c = 1, size(domain%chunks%list)
         force_chunk(domain%chunks%list(c)%column) = c
      end do
   end function chunk_of_columns

   !> Chunks that move some columns; 0 where none does
   pure function chunks_of(domain, column) result(chunk)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: column(:)
      integer :: chunk(size(column))

      integer :: c, update_chunk(domain%columns%count)

      update_chunk(:) = 0
      do c = 1, size(domain%chunks%list)
         update_chunk(domain%chunks%list(c)%owned_columns) = c
         update_chunk(domain%chunks%list(c)%ghost_columns) = c
      end do
      chunk(:) = update_chunk(column)
   end function chunks_of

end module plydyn_domain_chunks
