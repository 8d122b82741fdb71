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

      integer, allocatable :: from(:), order(:), run(:), to(:)
      integer :: c, k

      call list_meetings(division, from, to)
      order = sorted_order(to)
      order = order(sorted_order(from(order)))
      from = from(order)
      to = to(order)
      ! where a run of the same two chunks ends; a chunk that meets no other has none
      run = pack([(k, k=1, size(order))], [from(2:) /= from(:size(from) - 1) &
         & .or. to(2:) /= to(:size(to) - 1), spread(.true., 1, min(1, size(order)))])
      other = to(run) - 1
      nodes = [(run(k) - merge(0, run(max(1, k - 1)), k == 1), k=1, size(run))]
      first(:) = 0
      do k = 1, size(run)
         first(from(run(k)) + 1) = k
      end do
      do c = 2, size(first)
         first(c) = max(first(c), first(c - 1))
      end do
   end subroutine find_neighbours

   !> Pairs of chunks that meet, each in both orders, once for each node
   subroutine list_meetings(division, from, to)
      type(decomposition_type), intent(in) :: division
      integer, allocatable, intent(out) :: from(:), to(:)

      integer :: b, c, i, k, n
      integer, allocatable :: here(:), owner(:)

      owner = column_owners(division, [(c, c=1, size(division%chunks))])
      associate (shared => division%shared_nodes)
         n = sum((shared(3, :) - shared(2, :) + 2)*(shared(3, :) - shared(2, :) + 1))
         allocate (from(n), to(n))
         n = 0
         do b = 1, size(shared, 2)
            here = owner([shared(1, b), (c, c=shared(2, b), shared(3, b))])
            do i = 1, size(here)
               do k = 1, size(here)
                  if (i == k) cycle
                  n = n + 1
                  from(n) = here(i)
                  to(n) = here(k)
               end do
            end do
         end do
      end associate
   end subroutine list_meetings

   !> Work of each chunk in a step, nanoseconds
   pure function chunk_works(domain, chunks) result(work)
      !> The domain; its groups are known
      type(domain_type), intent(in) :: domain
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
