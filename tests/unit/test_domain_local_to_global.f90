!> Columns as one rank of several numbers them.
program test_domain_local_to_global
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_domain_decomposition, only : column_owners, divide_plane, decomposition_type
   use plydyn_domain_local_to_global, only : new_local_to_global, local_to_global_type
   use plydyn_model_mesh, only : mesh_type
   use sample, only : rectangle_mesh
   use testing, only : begin, check, finish
   implicit none

   integer, parameter :: ranks = 3
   type(decomposition_type) :: whole
   type(mesh_type) :: mesh
   integer, allocatable :: owner(:), rank_of_chunk(:)
   integer :: c

   call begin("new_local_to_global")
   mesh = rectangle_mesh(3, 12, 8, 12.0_wp, 8.0_wp, 0.0_wp)
   whole = divide_plane(mesh, 1)
   ! chunks dealt out in turn, so that ranks meet wherever chunks do
   rank_of_chunk = [(mod(c, ranks), c=1, size(whole%chunks))]
   owner = column_owners(whole, rank_of_chunk)
   call test_order()
   call test_owners()
   call test_columns()
   call test_borders()
   call test_nodes()
   call finish()

contains

   !> Columns of the whole model go chunk by chunk, each node once; at last in a chunk those that
   !> later ones have too
   subroutine test_order()
      integer :: c, first, i, last, meets(whole%nodes)
      integer, allocatable :: own(:)

      do c = 1, size(whole%chunks)
         associate (quads => whole%chunks(c)%elements)
            do i = quads(1), quads(2)
               meets(whole%column(mesh%quad_node(:, whole%parts(1)%element(i)))) = c
            end do
         end associate
      end do
      last = 0
      do c = 1, size(whole%chunks)
         own = pack(whole%chunks(c)%column, whole%chunks(c)%column <= whole%nodes)
         own = own(sorted_order(own))
         first = last + 1
         last = last + size(own)
         call check(all(own == [(i, i=first, last)]), "behind those of the chunk before")
         call check(meets(first), c, "first what no other chunk has")
         call check(all(meets(first + 1:last) >= meets(first:last - 1)), "then what later have")
      end do
      call check(last, whole%nodes, "all of them")
      call check(all(whole%column(whole%node) == [(i, i=1, whole%nodes)]), "each its node's")
   end subroutine test_order

   !> A column belongs to the rank of the chunk that adds to it
   subroutine test_owners()
      integer, allocatable :: tens(:)
      integer :: c

      tens = column_owners(whole, [(10*c, c=1, size(whole%chunks))])
      do c = 1, size(whole%chunks)
         call check(count(tens == 10*c), size(whole%chunks(c)%column), "as many as it has")
         call check(all(tens(whole%chunks(c)%column) == 10*c), "the columns of the chunk")
      end do
   end subroutine test_owners

   !> A rank has the nodes of its quads and no others, and one rank counts each
   subroutine test_columns()
      type(local_to_global_type) :: numbering
      integer :: c, counted(whole%nodes), i, rank
      logical :: is_touched(whole%nodes)

      counted(:) = 0
      do rank = 0, ranks - 1
         numbering = new_local_to_global(whole, 1, owner, rank)
         is_touched(:) = .false.
         do c = 1, size(whole%chunks)
            if (rank_of_chunk(c) /= rank) cycle
            associate (quads => whole%chunks(c)%elements)
               do i = quads(1), quads(2)
                  is_touched(mesh%quad_node(:, whole%parts(1)%element(i))) = .true.
               end do
            end associate
         end do
         call check(size(numbering%here), count(is_touched), "as many as its quads touch")
         call check(all(is_touched(numbering%nodes(whole%nodes))), "the nodes of its quads")
         call check(all(numbering%column(numbering%here) == [(i, i=1, size(numbering%here))]), &
            & "numbered in the order of the whole model")
         associate (own => pack(numbering%nodes(whole%nodes), numbering%own))
            counted(own) = counted(own) + 1
         end associate
      end do
      call check(all(counted == 1), "every node is counted by one rank")
   end subroutine test_columns

   !> Where a rank has a node, it has room for the columns of all chunks that meet there
   subroutine test_borders()
      type(local_to_global_type) :: numbering
      integer :: b, behind, c, i, rank
      integer, allocatable :: taken(:)

      do rank = 0, ranks - 1
         numbering = new_local_to_global(whole, 1, owner, rank)
         behind = 0
         do b = 1, size(whole%shared_nodes, 2)
            associate (column => numbering%column, border => whole%shared_nodes(:, b))
               if (column(border(1)) == 0) then
                  call check(all(column(border(2):border(3)) == 0), "none of a node elsewhere")
                  cycle
               end if
               behind = behind + border(3) - border(2) + 1
               call check(all(column(border(2):border(3)) == column(border(2)) &
                  & + [(c, c=0, border(3) - border(2))]), "columns of a node lie together")
            end associate
         end do
         taken = pack(numbering%column, numbering%column > 0)
         call check(size(taken), size(numbering%here) + behind, "nodes and what is behind them")
         call check(size(taken), numbering%columns, "are all there are")
         call check(all([(any(taken == i), i=1, size(taken))]), "without gaps")
      end do
   end subroutine test_borders

   !> Nodes of the whole model and of a rank are the same ones, side by side in a column or not
   subroutine test_nodes()
      integer, parameter :: nodes = 21, width = 8
      type(decomposition_type) :: solid
      type(local_to_global_type) :: numbering
      integer :: here(whole%nodes), i, rank

      do rank = 0, ranks - 1
         numbering = new_local_to_global(whole, 1, owner, rank)
         associate (nodes => numbering%nodes(whole%nodes))
            call check(all(numbering%column_of(nodes) == numbering%here), "each has its column")
            call check(all(numbering%node(nodes) == [(i, i=1, size(nodes))]), &
               & "above a plane nodes are numbered as their columns")
            here(:) = 0
            here(nodes) = [(i, i=1, size(nodes))]
         end associate
         call check(all(numbering%only([(i, i=1, whole%nodes)]) == pack(here, here > 0)), &
            & "nodes elsewhere are left out")
      end do
      solid%nodes = 3
      solid%columns = 3
      solid%column = [1, 2, 3]
      solid%node = solid%column
      allocate (solid%shared_nodes(3, 0))
      numbering = new_local_to_global(solid, width, [0, 1, 0], 0)
      call check(all(numbering%node([1, 8, 9, 16, 17, 21]) == [1, 8, 0, 0, 9, 13]), &
         & "the second column is another rank's")
      call check(all(numbering%nodes(nodes) == [(i, i=1, 8), (i, i=17, 21), 21, 21, 21]), &
         & "the last node fills the last column")
   end subroutine test_nodes

end program test_domain_local_to_global
