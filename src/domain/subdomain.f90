!> The share of a rank: its columns and chunks, and what it exchanges with other ranks.
!>
!> A rank has the columns of all nodes that its chunks touch. A node where ranks meet is moved by
!> all of them alike: each gets the force columns of the others, and adds all in the order of the
!> chunks of the whole model (`plydyn_domain_decomposition`). The rank of its first chunk counts it.
module plydyn_domain_subdomain
   use plydyn_domain_chunks, only : assign_nodes, find_contributors, nodes_of_columns
   use plydyn_fem_columns, only : alignment_offset
   use plydyn_domain_decomposition, only : decomposition_type
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_local_to_global, only : local_to_global_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_parallel_halo, only : new_halo
   implicit none
   private

   public :: join_ranks, renumber_chunks, take_chunks, take_columns

   !> What of the whole model a rank has
   type, public :: subdomain_type
      !> Columns and histories of the whole model
      integer :: columns = 0, histories = alignment_offset
      !> Its columns as the whole model numbers them
      integer, allocatable :: column(:)
      !> Its histories: first place here and in the whole model, and length, (3, segments)
      integer, allocatable :: history(:, :)
      !> Whether it counts each of these segments
      logical, allocatable :: counts_history(:)
   end type subdomain_type

contains

   !> Columns of a rank, their nodes, and the nodes that several chunks share
   pure subroutine take_columns(mesh, division, numbering, domain, subdomain)
      type(mesh_type), intent(in) :: mesh
      type(decomposition_type), intent(in) :: division
      type(local_to_global_type), intent(in) :: numbering
      !> Has columns as long as those of the whole model; gets those of the rank
      type(domain_type), intent(inout) :: domain
      !> Gets the columns
      type(subdomain_type), intent(inout) :: subdomain

      integer, allocatable :: node(:)
      integer :: b

      subdomain%columns = division%nodes
      subdomain%column = numbering%here
      domain%chunks%counted = numbering%own
      node = numbering%nodes(size(mesh%node_id))
      node = node(:min(size(node), size(mesh%node_id)))
      call domain%columns%take(size(node), size(subdomain%column), numbering%columns)
      domain%node_id = mesh%node_id(node)
      domain%position = mesh%position(:, node)
      domain%chunks%shared_nodes = division%shared_nodes(:, &
         & pack([(b, b=1, size(division%shared_nodes, 2))], &
         & numbering%column(division%shared_nodes(1, :)) > 0))
      do b = 1, size(domain%chunks%shared_nodes, 2)
         domain%chunks%shared_nodes(:, b) = numbering%column(domain%chunks%shared_nodes(:, b))
      end do
   end subroutine take_columns

   !> Chunks of a rank, as the whole model has them. (`pack` of gfortran 12 leaves the copies the
   !> lists of the originals)
   pure subroutine take_chunks(division, taken, domain)
      type(decomposition_type), intent(in) :: division
      !> Which of its chunks
      logical, intent(in) :: taken(:)
      !> Gets them
      type(domain_type), intent(inout) :: domain

      integer :: c, k

      allocate (domain%chunks%list(count(taken)))
      k = 0
      do c = 1, size(taken)
         if (.not. taken(c)) cycle
         k = k + 1
         domain%chunks%list(k) = division%chunks(c)
      end do
   end subroutine take_chunks

   !> Let the chunks of a rank say where its quads and columns are
   pure subroutine renumber_chunks(numbering, domain)
      type(local_to_global_type), intent(in) :: numbering
      !> Has chunks of the whole model
      type(domain_type), intent(inout) :: domain

      integer :: c, i, last(maxval([0, domain%chunks%list%set]))

      last(:) = 0
      do c = 1, size(domain%chunks%list)
         associate (chunk => domain%chunks%list(c), end => last(domain%chunks%list(c)%set))
            chunk%elements(:) = end + 1 + [0, chunk%elements(2) - chunk%elements(1)]
            end = chunk%elements(2)
            chunk%column(:) = numbering%column(chunk%column)
            chunk%owned_columns = pack(chunk%column, chunk%column <= domain%columns%count)
         end associate
      end do
      call place_ghost_columns(domain, pack([(i, i=1, size(domain%chunks%counted))], &
         & .not. domain%chunks%counted))
      call assign_nodes(domain)
      call find_contributors(domain)
   end subroutine renumber_chunks

   !> What is exchanged with the ranks that this one meets, and the chunks that must be ready for it
   subroutine join_ranks(division, numbering, domain)
      type(decomposition_type), intent(in) :: division
      type(local_to_global_type), intent(in) :: numbering
      !> The domain of the rank; its chunks have their columns
      type(domain_type), intent(inout) :: domain

      integer, allocatable :: received(:, :), sent(:, :)
      logical :: is_sent(size(numbering%owner)), is_outer(size(domain%chunks%list))
      integer :: b, c

      allocate (received(2, 0), sent(2, 0))
      do b = 1, size(division%shared_nodes, 2)
         if (numbering%column(division%shared_nodes(1, b)) == 0) cycle
         call join_border([division%shared_nodes(1, b), (c, c=division%shared_nodes(2, b), &
            & division%shared_nodes(3, b))], numbering%owner, domain%comm%rank, sent, received)
      end do
      is_sent(:) = .false.
      is_sent(numbering%column(sent(2, :))) = .true.
      is_outer(:) = [(any(is_sent(domain%chunks%list(c)%column)), c=1, size(domain%chunks%list))]
      domain%chunks%outer = count(is_outer)
      domain%chunks%order = [pack([(c, c=1, size(is_outer))], is_outer), &
         & pack([(c, c=1, size(is_outer))], .not. is_outer)]
      associate (height => domain%columns%height)
         sent(2, :) = alignment_offset + height*(numbering%column(sent(2, :)) - 1)
         received(2, :) = alignment_offset + height*(numbering%column(received(2, :)) - 1)
         domain%chunks%halo = new_halo(domain%comm%ranks, height, sent, received)
      end associate
   end subroutine join_ranks

   !> Columns of a node that this rank sends to others that have it, or gets from them
   pure subroutine join_border(column, owner, rank, sent, received)
      !> All columns of the node
      integer, intent(in) :: column(:)
      integer, intent(in) :: owner(:), rank
      !> Rank and column, (2, columns)
      integer, allocatable, intent(inout) :: sent(:, :), received(:, :)

      integer :: c, k

      do c = 1, size(column)
         associate (from => owner(column(c)))
            if (from /= rank) then
               received = reshape([received, from, column(c)], [2, size(received, 2) + 1])
               cycle
            end if
         end associate
         do k = 1, size(column)
            associate (to => owner(column(k)))
               if (to == rank .or. any(owner(column(:k - 1)) == to)) cycle
               sent = reshape([sent, to, column(c)], [2, size(sent, 2) + 1])
            end associate
         end do
      end do
   end subroutine join_border

   !> Let every ghost column move with the first chunk that adds to it
   pure subroutine place_ghost_columns(domain, ghosts)
      type(domain_type), intent(inout) :: domain
      !> Columns that another rank counts
      integer, intent(in) :: ghosts(:)

      integer :: c, chunk_of(maxval([0, ghosts])), i
      integer, allocatable :: node(:)

      node = nodes_of_columns(domain)
      chunk_of(:) = 0
      do c = size(domain%chunks%list), 1, -1
         associate (column => domain%chunks%list(c)%column)
            do i = 1, size(column)
               if (column(i) <= domain%columns%count) cycle
               if (node(column(i)) <= size(chunk_of)) chunk_of(node(column(i))) = c
            end do
         end associate
      end do
      do c = 1, size(domain%chunks%list)
         domain%chunks%list(c)%ghost_columns = pack(ghosts, chunk_of(ghosts) == c)
      end do
   end subroutine place_ghost_columns

end module plydyn_domain_subdomain
