!> The share of a rank: the domain of its chunks, cut out of that of the whole model.
!>
!> A rank has the columns of all nodes that its chunks touch. A node where ranks meet is moved by
!> all of them alike: each gets the force columns of the others, and adds all in the order of the
!> chunks of the whole model (`plydyn_domain_chunks`). It is counted by the rank of its first chunk.
module plydyn_domain_share
   use plydyn_base_precision, only : wp
   use plydyn_domain_chunks, only : give_borders
   use plydyn_domain_columns, only : columns_type, front
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_numbering, only : new_numbering, numbering_type
   use plydyn_domain_share_elements, only : take_bricks, take_interfaces, take_plates
   use plydyn_domain_share_points, only : take_inertia, take_loads, take_supports, &
      & take_surfaces, take_velocities
   use plydyn_parallel_comm, only : comm_type
   use plydyn_parallel_halo, only : new_halo
   implicit none
   private

   public :: column_owners, own_all, take_share

   !> What of the whole model a rank has
   type, public :: share_type
      !> Its columns as the whole model numbers them, and whether it counts each
      integer, allocatable :: column(:)
      logical, allocatable :: own(:)
      !> Its histories: first place here and in the whole model, and length, (3, pieces)
      integer, allocatable :: history(:, :)
      !> Its supports as places in the list of those of the whole model, and whether it counts each
      integer, allocatable :: support(:)
      logical, allocatable :: own_support(:)
   end type share_type

contains

   !> Let one rank count all
   pure subroutine own_all(domain)
      !> The domain, built
      type(domain_type), intent(inout) :: domain
      integer :: c, i

      do c = 1, size(domain%chunks)
         associate (chunk => domain%chunks(c))
            chunk%own = pack(chunk%column, chunk%column <= domain%columns%count)
            allocate (chunk%guests(0))
         end associate
      end do
      call give_borders(domain)
      domain%order = [(c, c=1, size(domain%chunks))]
      do i = 1, size(domain%loads)
         domain%loads(i)%own = spread(.true., 1, size(domain%loads(i)%last))
      end do
      do i = 1, size(domain%motions)
         domain%motions(i)%own = spread(.true., 1, size(domain%motions(i)%freedom))
      end do
      do i = 1, size(domain%surfaces)
         associate (surface => domain%surfaces(i))
            surface%here = [(c, c=1, size(surface%node))]
            surface%own = spread(.true., 1, size(surface%node))
            surface%counts = [size(surface%node)]
            surface%of_ranks = surface%here
         end associate
      end do
      domain%moved_links%own = spread(.true., 1, size(domain%moved_links%inertia))
      domain%held_links%own = spread(.true., 1, size(domain%held_links%inertia))
   end subroutine own_all

   !> Rank that adds to each column of forces; -1 where no chunk does
   pure function column_owners(whole, rank_of_chunk) result(owner)
      !> The whole model
      type(domain_type), intent(in) :: whole
      !> Rank of each chunk
      integer, intent(in) :: rank_of_chunk(:)
      integer, allocatable :: owner(:)
      integer :: c

      allocate (owner((whole%columns%forces - front)/whole%columns%height))
      owner(:) = -1
      do c = 1, size(whole%chunks)
         owner(whole%chunks(c)%column) = rank_of_chunk(c)
      end do
   end function column_owners

   !> The domain of a rank
   subroutine take_share(whole, rank_of_chunk, comm, domain, share)
      !> The whole model
      type(domain_type), intent(in) :: whole
      !> Rank of each chunk
      integer, intent(in) :: rank_of_chunk(:)
      !> The ranks
      type(comm_type), intent(in) :: comm
      !> Its domain
      type(domain_type), intent(out) :: domain
      !> What it has of the whole
      type(share_type), intent(out) :: share

      type(numbering_type) :: numbering
      integer, allocatable :: owner(:)
      integer :: c, i

      owner = column_owners(whole, rank_of_chunk)
      numbering = new_numbering(whole, owner, comm%rank)
      domain = whole
      domain%comm = comm
      call take_columns(whole, numbering, domain)
      call take_chunks(whole, rank_of_chunk == comm%rank, domain)
      allocate (share%history(3, 0))
      domain%histories = front
      call take_plates(whole, numbering, domain, share%history)
      call take_interfaces(whole, numbering, domain, share%history)
      call take_bricks(whole, numbering, domain, share%history)
      call renumber_chunks(whole, numbering, domain)
      call take_supports(whole, numbering, domain, share%support, share%own_support)
      call take_loads(whole, numbering, domain)
      call take_velocities(whole, numbering, domain)
      call take_surfaces(whole, numbering, owner, comm%ranks, domain)
      call take_inertia(whole, numbering, domain)
      share%column = numbering%here
      share%own = numbering%own
      do c = 1, size(domain%chunks)
         domain%chunks(c)%own = pack(domain%chunks(c)%column, &
            & domain%chunks(c)%column <= size(share%column))
      end do
      call place_guests(domain, pack([(i, i=1, size(share%own))], .not. share%own))
      call give_borders(domain)
      call join_ranks(whole, numbering, owner, domain)
   end subroutine take_share

   !> What is exchanged with the ranks that this one meets, and the chunks that must be ready for it
   subroutine join_ranks(whole, numbering, owner, domain)
      type(domain_type), intent(in) :: whole
      type(numbering_type), intent(in) :: numbering
      !> Rank that adds to each column
      integer, intent(in) :: owner(:)
      type(domain_type), intent(inout) :: domain

      integer, allocatable :: received(:, :), sent(:, :)
      logical :: is_sent(size(owner)), is_outer(size(domain%chunks))
      integer :: b, c

      allocate (received(2, 0), sent(2, 0))
      do b = 1, size(whole%borders, 2)
         if (numbering%column(whole%borders(1, b)) == 0) cycle
         call join_border([whole%borders(1, b), (c, c=whole%borders(2, b), whole%borders(3, b))], &
            & owner, domain%comm%rank, sent, received)
      end do
      is_sent(:) = .false.
      is_sent(numbering%column(sent(2, :))) = .true.
      is_outer(:) = [(any(is_sent(domain%chunks(c)%column)), c=1, size(domain%chunks))]
      domain%outer = count(is_outer)
      domain%order = [pack([(c, c=1, size(is_outer))], is_outer), &
         & pack([(c, c=1, size(is_outer))], .not. is_outer)]
      associate (height => domain%columns%height)
         sent(2, :) = front + height*(numbering%column(sent(2, :)) - 1)
         received(2, :) = front + height*(numbering%column(received(2, :)) - 1)
         domain%halo = new_halo(domain%comm%ranks, height, sent, received)
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

   !> Some chunks, as they are. (`pack` of gfortran 12 leaves the copies the lists of the originals)
   pure subroutine take_chunks(whole, taken, domain)
      type(domain_type), intent(in) :: whole
      logical, intent(in) :: taken(:)
      type(domain_type), intent(inout) :: domain
      integer :: c, k

      deallocate (domain%chunks)
      allocate (domain%chunks(count(taken)))
      k = 0
      do c = 1, size(taken)
         if (.not. taken(c)) cycle
         k = k + 1
         domain%chunks(k) = whole%chunks(c)
      end do
   end subroutine take_chunks

   !> Columns, their nodes and masses, and the borders between chunks
   subroutine take_columns(whole, numbering, domain)
      type(domain_type), intent(in) :: whole
      type(numbering_type), intent(in) :: numbering
      type(domain_type), intent(inout) :: domain

      integer, allocatable :: node(:)
      integer :: b, c, i, n

      associate (columns => domain%columns, here => numbering%here, &
         & abreast => whole%columns%abreast)
         columns%count = size(here)
         node = [((min(abreast*(here(c) - 1) + i, whole%columns%nodes), i=1, abreast), &
            & c=1, size(here))]
         columns%nodes = size(node)
         columns%freedoms = front + columns%height*columns%count
         columns%masses = front + columns%height/3*columns%count
         columns%forces = front + columns%height*maxval(numbering%column)
         domain%node_id = whole%node_id(node)
         domain%position = whole%position(:, node)
         domain%mass = whole_masses(columns, here, whole%mass)
         domain%inverse_mass = whole_masses(columns, here, whole%inverse_mass)
      end associate
      domain%borders = whole%borders(:, pack([(b, b=1, size(whole%borders, 2))], &
         & numbering%column(whole%borders(1, :)) > 0))
      do b = 1, size(domain%borders, 2)
         do n = 1, size(domain%borders, 1)
            domain%borders(n, b) = numbering%column(domain%borders(n, b))
         end do
      end do
      domain%ties = whole%ties
      domain%far_ties = whole%far_ties(:, pack([(i, i=1, size(whole%far_ties, 2))], &
         & numbering%has(whole%far_ties(1, :))))
      domain%far_ties(:, :) = numbering%place(domain%far_ties)
   end subroutine take_columns

   !> Masses of some columns
   pure function whole_masses(columns, here, mass) result(masses)
      type(columns_type), intent(in) :: columns
      integer, intent(in) :: here(:)
      real(wp), intent(in) :: mass(:)
      real(wp) :: masses(columns%masses)
      integer :: i

      masses(:front) = 0.0_wp
      associate (height => columns%height/3)
         do i = 1, size(here)
            masses(front + height*(i - 1) + 1:front + height*i) = &
               & mass(front + height*(here(i) - 1) + 1:front + height*here(i))
         end do
      end associate
   end function whole_masses

   !> Let the chunks of a rank say where its quads and columns are
   pure subroutine renumber_chunks(whole, numbering, domain)
      type(domain_type), intent(in) :: whole
      type(numbering_type), intent(in) :: numbering
      type(domain_type), intent(inout) :: domain

      integer :: c, last(max(size(whole%plates), size(whole%bricks)))

      last(:) = 0
      do c = 1, size(domain%chunks)
         associate (chunk => domain%chunks(c), end => last(domain%chunks(c)%plate))
            chunk%quads(:) = end + 1 + [0, chunk%quads(2) - chunk%quads(1)]
            end = chunk%quads(2)
            chunk%column(:) = numbering%column(chunk%column)
         end associate
      end do
   end subroutine renumber_chunks

   !> Let every guest move with the first chunk that adds to it
   pure subroutine place_guests(domain, guests)
      type(domain_type), intent(inout) :: domain
      !> Columns that another rank counts
      integer, intent(in) :: guests(:)

      integer :: b, c, chunk_of(maxval([0, guests])), i, node_of(domain%columns%count + 1: &
         & (domain%columns%forces - front)/domain%columns%height)

      do b = 1, size(domain%borders, 2)
         node_of(domain%borders(2, b):domain%borders(3, b)) = domain%borders(1, b)
      end do
      chunk_of(:) = 0
      do c = size(domain%chunks), 1, -1
         associate (column => domain%chunks(c)%column)
            do i = 1, size(column)
               if (column(i) <= domain%columns%count) cycle
               if (node_of(column(i)) <= size(chunk_of)) chunk_of(node_of(column(i))) = c
            end do
         end associate
      end do
      do c = 1, size(domain%chunks)
         domain%chunks(c)%guests = pack(guests, chunk_of(guests) == c)
      end do
   end subroutine place_guests

end module plydyn_domain_share
