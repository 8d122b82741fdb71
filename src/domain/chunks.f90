!> Chunks of quads: what a thread takes at a time.
!>
!> Chunks lie close together, and are the same for any number of threads. The forces of a chunk go
!> to columns that no other chunk adds to: those of its nodes, or, where an earlier chunk has the
!> node, columns of its own behind them. Then every node of a border adds what lies in the columns
!> of the later chunks to its own, in the order of the chunks: the same bits in any run.
module plydyn_domain_chunks
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_domain_columns, only : front
   use plydyn_domain_domain, only : chunk_type, domain_type
   implicit none
   private

   public :: divide_quads, give_borders, new_chunks

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

   !> All chunks of a domain, and the columns that take their forces
   subroutine new_chunks(domain)
      !> Plates and interfaces get their targets, the domain its chunks, and its columns their size
      type(domain_type), intent(inout) :: domain

      integer :: c, first, k, p

      allocate (domain%chunks(sum([(size(domain%plates(p)%last), p=1, size(domain%plates))])))
      c = 0
      do p = 1, size(domain%plates)
         first = 1
         do k = 1, size(domain%plates(p)%last)
            c = c + 1
            domain%chunks(c)%plate = p
            domain%chunks(c)%quads(:) = [first, domain%plates(p)%last(k)]
            first = domain%plates(p)%last(k) + 1
         end do
      end do
      call set_targets(domain)
      do k = 1, size(domain%interfaces)
         domain%interfaces(k)%target(:, :) = domain%plates(domain%interfaces(k)%plate)%target
      end do
   end subroutine new_chunks

   !> Give every node of every chunk a column: its own, or the next behind that it has
   subroutine set_targets(domain)
      type(domain_type), intent(inout) :: domain

      integer :: chunks_at(domain%columns%nodes), next(domain%columns%nodes)
      integer :: behind(domain%columns%nodes), c, columns, i

      chunks_at(:) = 0
      do c = 1, size(domain%chunks)
         domain%chunks(c)%column = chunk_nodes(domain, domain%chunks(c))
         chunks_at(domain%chunks(c)%column) = chunks_at(domain%chunks(c)%column) + 1
      end do
      columns = domain%columns%nodes
      behind(:) = 0
      allocate (domain%borders(3, count(chunks_at > 1)))
      domain%borders(1, :) = pack([(i, i=1, size(chunks_at))], chunks_at > 1)
      do i = 1, size(domain%borders, 2)
         behind(domain%borders(1, i)) = columns + 1
         domain%borders(2, i) = columns + 1
         columns = columns + chunks_at(domain%borders(1, i)) - 1
         domain%borders(3, i) = columns
      end do
      domain%columns%forces = front + domain%columns%height*columns
      next(:) = [(i, i=1, size(next))]
      do c = 1, size(domain%chunks)
         associate (chunk => domain%chunks(c), plate => domain%plates(domain%chunks(c)%plate))
            do i = chunk%quads(1), chunk%quads(2)
               plate%target(:, i) = next(plate%node(:, i))
            end do
            do i = 1, size(chunk%column)
               call take(chunk%column(i), next, behind)
            end do
         end associate
      end do
   end subroutine set_targets

   !> Let every chunk add up the borders at the columns that it moves
   pure subroutine give_borders(domain)
      !> With the columns of all chunks; the chunks get their borders
      type(domain_type), intent(inout) :: domain

      integer :: b, c, chunk_of(domain%columns%count), many(size(domain%chunks))

      do c = 1, size(domain%chunks)
         chunk_of(domain%chunks(c)%own) = c
         chunk_of(domain%chunks(c)%guests) = c
      end do
      many(:) = 0
      do b = 1, size(domain%borders, 2)
         c = chunk_of(domain%borders(1, b))
         many(c) = many(c) + 1
      end do
      do c = 1, size(domain%chunks)
         domain%chunks(c)%borders = spread(0, 1, many(c))
      end do
      do b = size(domain%borders, 2), 1, -1
         c = chunk_of(domain%borders(1, b))
         domain%chunks(c)%borders(many(c)) = b
         many(c) = many(c) - 1
      end do
   end subroutine give_borders

   !> Put the column that is next at a node in place of the node, and turn to the one after it
   pure subroutine take(column, next, behind)
      integer, intent(inout) :: column, next(:)
      integer, intent(in) :: behind(:)

      integer :: node

      node = column
      column = next(node)
      next(node) = merge(behind(node), column + 1, column == node)
   end subroutine take

   !> Nodes of a chunk, each once
   pure function chunk_nodes(domain, chunk) result(nodes)
      type(domain_type), intent(in) :: domain
      type(chunk_type), intent(in) :: chunk
      integer, allocatable :: nodes(:)

      logical, allocatable :: is_first(:)
      integer, allocatable :: order(:)

      associate (node => domain%plates(chunk%plate)%node(:, chunk%quads(1):chunk%quads(2)))
         nodes = reshape(node, [size(node)])
      end associate
      order = sorted_order(nodes)
      nodes(:) = nodes(order)
      is_first = [.true., nodes(2:) /= nodes(:size(nodes) - 1)]
      nodes = pack(nodes, is_first)
   end function chunk_nodes

end module plydyn_domain_chunks
