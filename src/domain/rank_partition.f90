!> Which rank gets which chunk.
module plydyn_domain_rank_partition
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_domain_domain, only : chunk_type, domain_type
   use plydyn_domain_decomposition, only : column_owners, decomposition_type
   use plydyn_parallel_partition, only : divide_graph
   implicit none
   private

   public :: divide_ranks

contains

   !> Rank of each chunk, from 0: like work for all ranks, and few nodes where they meet. Of more
   !> ranks than chunks the last ones have nothing to do
   subroutine divide_ranks(domain, division, ranks, rank_of_chunk)
      !> The domain; its groups are known
      type(domain_type), intent(in) :: domain
      !> Its chunks
      type(decomposition_type), intent(in) :: division
      !> How many ranks there are
      integer, intent(in) :: ranks
      !> Rank of each chunk
      integer, allocatable, intent(out) :: rank_of_chunk(:)

      integer :: first(size(division%chunks) + 1)
      integer, allocatable :: nodes(:), other(:)

      call find_neighbours(division, first, other, nodes)
      rank_of_chunk = divide_graph(first, other, chunk_works(domain, division%chunks), nodes, &
         & min(ranks, size(division%chunks)))
   end subroutine divide_ranks

   !> Chunks that meet, and in how many nodes
   subroutine find_neighbours(division, first, other, nodes)
      type(decomposition_type), intent(in) :: division
      !> As in `divide_graph`
      integer, intent(out) :: first(:)
      integer, allocatable, intent(out) :: other(:), nodes(:)

      integer, allocatable :: begin(:), met(:), run(:)
      integer :: c, k

      call list_meetings(division, begin, met)
      allocate (other(0), nodes(0))
      first(1) = 0
      do c = 1, size(division%chunks)
         associate (here => met(begin(c):begin(c + 1) - 1))
            here(:) = here(sorted_order(here))
            ! where a run of the same chunk ends
            run = pack([(k, k=1, size(here))], [here(2:) /= here(:size(here) - 1), &
               & spread(.true., 1, min(1, size(here)))])
            other = [other, here(run) - 1]
            ! a chunk that meets no other has no run
            nodes = [nodes, (run(k) - merge(0, run(max(1, k - 1)), k == 1), k=1, size(run))]
         end associate
         first(c + 1) = size(other)
      end do
   end subroutine find_neighbours

   !> The other chunks that each chunk meets, once for each node
   subroutine list_meetings(division, begin, met)
      type(decomposition_type), intent(in) :: division
      !> Where the list of each chunk begins, and the end behind the last
      integer, allocatable, intent(out) :: begin(:)
      !> The lists
      integer, allocatable, intent(out) :: met(:)

      integer :: b, c, i, k, next(size(division%chunks))
      integer, allocatable :: here(:), owner(:)

      owner = column_owners(division, [(c, c=1, size(division%chunks))])
      allocate (begin(size(division%chunks) + 1))
      next(:) = 0
      do b = 1, size(division%shared_nodes, 2)
         here = owner(columns_of(division%shared_nodes(:, b)))
         next(here) = next(here) + size(here) - 1
      end do
      begin(1) = 1
      do c = 1, size(next)
         begin(c + 1) = begin(c) + next(c)
      end do
      allocate (met(begin(size(begin)) - 1))
      next(:) = begin(:size(next))
      do b = 1, size(division%shared_nodes, 2)
         here = owner(columns_of(division%shared_nodes(:, b)))
         do i = 1, size(here)
            do k = 1, size(here)
               if (i == k) cycle
               met(next(here(i))) = here(k)
               next(here(i)) = next(here(i)) + 1
            end do
         end do
      end do
   end subroutine list_meetings

   !> All columns of a border: the node's own and those behind
   pure function columns_of(border) result(column)
      !> As in `domain_type`
      integer, intent(in) :: border(3)
      integer :: column(border(3) - border(2) + 2)
      integer :: c

      column(:) = [border(1), (c, c=border(2), border(3))]
   end function columns_of

   !> Work of each chunk in a step, nanoseconds
   pure function chunk_works(domain, chunks) result(work)
      !> The domain; its groups are known
      type(domain_type), intent(in) :: domain
      !> The chunks
      type(chunk_type), intent(in) :: chunks(:)
      integer :: work(size(chunks))

      real(wp) :: element
      integer :: c, g

      do c = 1, size(chunks)
         element = 0.0_wp
         do g = 1, size(domain%groups)
            associate (group => domain%groups(g)%item)
               if (group%set == chunks(c)%set) element = element + group%work
            end associate
         end do
         work(c) = max(1, nint(element*(chunks(c)%elements(2) - chunks(c)%elements(1) + 1)))
      end do
   end function chunk_works

end module plydyn_domain_rank_partition
