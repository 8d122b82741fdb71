!> Chunks of quads or bricks: what a thread takes at a time, and what ranks share out.
!>
!> Chunks are found from the mesh alone, by all ranks alike: they are the same for any number of
!> ranks and threads. The forces of a chunk go to columns that no other chunk adds to: those of its
!> nodes, or, where an earlier chunk has the node, columns of its own behind them. Then every node
!> of a border adds what lies in the columns of the later chunks to its own, in the order of the
!> chunks: the same bits in any run.
!>
!> Columns of nodes are numbered chunk by chunk, in each those last that the latest chunks have too:
!> what a thread moves lies side by side, what two of them look at as well, and no core fetches the
!> columns of another ahead of those that it goes through.
module plydyn_domain_decomposition
   use plydyn_base_precision, only : lanes
   use plydyn_base_sort, only : each_once, sorted_order
   use plydyn_domain_chunks, only : divide_quads, quad_centres
   use plydyn_domain_domain, only : chunk_type
   use plydyn_element_brick_bricks, only : bricks_type
   use plydyn_element_brick_make, only : most_batches
   use plydyn_model_mesh, only : mesh_type
   implicit none
   private

   public :: column_owners, divide_bricks, divide_plane

   !> Elements of a part in the order of their chunks: quads, or batches of bricks
   type, public :: elements_type
      !> Index of each quad in the mesh; of bricks the number of the batch in its part
      integer, allocatable :: element(:)
      !> Last one of each chunk
      integer, allocatable :: last(:)
   end type elements_type

   !> The whole model in chunks. Columns are numbered as one rank alone would number them
   type, public :: decomposition_type
      !> Elements of each part
      type(elements_type), allocatable :: parts(:)
      !> All chunks; `quads` are places in the list of the part's elements
      type(chunk_type), allocatable :: chunks(:)
      !> Columns of nodes, and these with those behind them
      integer :: nodes = 0, columns = 0
      !> Column of each node, or of each group of nodes that share one, and that of each column
      integer, allocatable :: column(:), node(:)
      !> Columns where chunks meet, as in `domain_type`
      integer, allocatable :: shared_nodes(:, :)
   end type decomposition_type

contains

   !> Chunks of the quads of a mesh, part by part
   pure function divide_plane(mesh, parts) result(self)
      type(mesh_type), intent(in) :: mesh
      !> How many parts there are
      integer, intent(in) :: parts
      type(decomposition_type) :: self

      integer, allocatable :: order(:), quad(:)
      integer :: c, i, p

      allocate (self%parts(parts))
      do p = 1, parts
         quad = pack([(i, i=1, size(mesh%quad_id))], mesh%quad_part == p)
         call divide_quads(quad_centres(mesh, quad), order, self%parts(p)%last)
         self%parts(p)%element = quad(order)
      end do
      self%nodes = size(mesh%node_id)
      call list_chunks(self)
      do c = 1, size(self%chunks)
         associate (chunk => self%chunks(c))
            associate (all => mesh%quad_node(:, self%parts(chunk%set)%element( &
               & chunk%elements(1):chunk%elements(2))))
               chunk%column = each_once([reshape(all, [size(all)]), &
                  & mesh%twins_of(reshape(all, [size(all)]))])
            end associate
         end associate
      end do
      call number_columns(self)
      call set_columns(self)
   end function divide_plane

   !> Chunks of bricks, in the order of the deck
   pure function divide_bricks(mesh, bricks) result(self)
      type(mesh_type), intent(in) :: mesh
      !> Bricks of each part
      type(bricks_type), intent(in) :: bricks(:)
      type(decomposition_type) :: self

      integer :: b, batches, c, p

      allocate (self%parts(size(bricks)))
      do p = 1, size(bricks)
         batches = (size(bricks(p)%brick) + lanes - 1)/lanes
         self%parts(p)%element = [(b, b=1, batches)]
         self%parts(p)%last = [(min(b + most_batches - 1, batches), b=1, batches, most_batches)]
      end do
      self%nodes = (size(mesh%node_id) + lanes - 1)/lanes
      call list_chunks(self)
      do c = 1, size(self%chunks)
         associate (chunk => self%chunks(c), brick => bricks(self%chunks(c)%set)%brick)
            associate (all => mesh%brick_node(:, brick(lanes*(chunk%elements(1) - 1) + 1: &
               & min(lanes*chunk%elements(2), size(brick)))))
               chunk%column = each_once(1 + (reshape(all, [size(all)]) - 1)/lanes)
            end associate
         end associate
      end do
      self%column = [(c, c=1, self%nodes)]
      self%node = self%column
      call set_columns(self)
   end function divide_bricks

   !> All chunks, without columns
   pure subroutine list_chunks(self)
      type(decomposition_type), intent(inout) :: self

      integer :: c, first, k, p

      allocate (self%chunks(sum([(size(self%parts(p)%last), p=1, size(self%parts))])))
      c = 0
      do p = 1, size(self%parts)
         first = 1
         do k = 1, size(self%parts(p)%last)
            c = c + 1
            self%chunks(c)%set = p
            self%chunks(c)%elements(:) = [first, self%parts(p)%last(k)]
            first = self%parts(p)%last(k) + 1
         end do
      end do
   end subroutine list_chunks

   !> Number the columns of nodes chunk by chunk, in each by the last chunk that has them; at the
   !> end those of nodes without elements
   pure subroutine number_columns(self)
      !> Its chunks have their nodes in, and the columns of these out
      type(decomposition_type), intent(inout) :: self

      integer :: c, i, last, last_chunk(self%nodes)

      allocate (self%column(self%nodes), self%node(self%nodes), source=0)
      do c = 1, size(self%chunks)
         last_chunk(self%chunks(c)%column) = c
      end do
      last = 0
      do c = 1, size(self%chunks)
         associate (node => self%chunks(c)%column)
            call number_rest(node(sorted_order(last_chunk(node))), self%column, last)
            node(:) = self%column(node)
         end associate
      end do
      call number_rest([(i, i=1, self%nodes)], self%column, last)
      self%node(self%column) = [(i, i=1, self%nodes)]
   end subroutine number_columns

   !> Number those of some nodes that have no number
   pure subroutine number_rest(nodes, number, last)
      integer, intent(in) :: nodes(:)
      integer, intent(inout) :: number(:)
      !> The last number so far
      integer, intent(inout) :: last

      integer :: i

      do i = 1, size(nodes)
         if (number(nodes(i)) > 0) cycle
         last = last + 1
         number(nodes(i)) = last
      end do
   end subroutine number_rest

   !> Give every node of every chunk a column: its own, or the next behind that it has
   pure subroutine set_columns(self)
      !> Its chunks have the columns of their nodes
      type(decomposition_type), intent(inout) :: self

      integer, allocatable :: behind(:), chunks_at(:), next(:)
      integer :: c, i

      allocate (chunks_at(self%nodes), behind(self%nodes), source=0)
      do c = 1, size(self%chunks)
         associate (column => self%chunks(c)%column)
            chunks_at(column) = chunks_at(column) + 1
         end associate
      end do
      self%columns = self%nodes
      allocate (self%shared_nodes(3, count(chunks_at > 1)))
      self%shared_nodes(1, :) = pack([(i, i=1, size(chunks_at))], chunks_at > 1)
      do i = 1, size(self%shared_nodes, 2)
         behind(self%shared_nodes(1, i)) = self%columns + 1
         self%shared_nodes(2, i) = self%columns + 1
         self%columns = self%columns + chunks_at(self%shared_nodes(1, i)) - 1
         self%shared_nodes(3, i) = self%columns
      end do
      next = [(i, i=1, self%nodes)]
      do c = 1, size(self%chunks)
         do i = 1, size(self%chunks(c)%column)
            call take(self%chunks(c)%column(i), next, behind)
         end do
      end do
   end subroutine set_columns

   !> Put the column that is next at a node in place of the node, and turn to the one after it
   pure subroutine take(column, next, behind)
      integer, intent(inout) :: column, next(:)
      integer, intent(in) :: behind(:)

      integer :: node

      node = column
      column = next(node)
      next(node) = merge(behind(node), column + 1, column == node)
   end subroutine take

   !> Rank that adds to each column of forces; the first one has nodes without elements
   pure function column_owners(self, rank_of_chunk) result(owner)
      !> The whole model
      class(decomposition_type), intent(in) :: self
      !> Rank of each chunk
      integer, intent(in) :: rank_of_chunk(:)
      integer, allocatable :: owner(:)
      integer :: c

      allocate (owner(self%columns), source=0)
      do c = 1, size(self%chunks)
         owner(self%chunks(c)%column) = rank_of_chunk(c)
      end do
   end function column_owners

end module plydyn_domain_decomposition
