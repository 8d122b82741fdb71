!> Columns as one rank of several numbers them.
program test_domain_numbering
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_columns, only : front
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_numbering, only : new_numbering, numbering_type
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   integer, parameter :: ranks = 3
   type(domain_type) :: whole
   type(error_type), allocatable :: error
   integer, allocatable :: owner(:), rank_of_chunk(:)

   call begin("new_numbering")
   call build_domain(rectangle_model(rectangle_mesh(3, 12, 8, 12.0_wp, 8.0_wp, 0.0_wp), &
      & [0.0_wp, 90.0_wp], 0.25_wp, [2, 2]), whole, error)
   call check(.not. allocated(error), "the domain is built")
   call make_owners()
   call test_columns()
   call test_borders()
   call test_places()
   call finish()

contains

   !> Chunks dealt out in turn, so that ranks meet wherever chunks do
   subroutine make_owners()
      integer :: c

      rank_of_chunk = [(mod(c, ranks), c=1, size(whole%chunks))]
      allocate (owner((whole%columns%forces - front)/whole%columns%height))
      owner(:) = -1
      do c = 1, size(whole%chunks)
         owner(whole%chunks(c)%column) = rank_of_chunk(c)
      end do
      call check(all(owner >= 0), "every column has an owner")
   end subroutine make_owners

   !> A rank has the nodes of its quads and no others, and one rank counts each
   subroutine test_columns()
      type(numbering_type) :: numbering
      integer :: c, counted(whole%columns%count), i, rank
      logical :: is_touched(whole%columns%count)

      counted(:) = 0
      do rank = 0, ranks - 1
         numbering = new_numbering(whole, owner, rank)
         is_touched(:) = .false.
         do c = 1, size(whole%chunks)
            if (rank_of_chunk(c) /= rank) cycle
            associate (quads => whole%chunks(c)%quads)
               do i = quads(1), quads(2)
                  is_touched(whole%plates(1)%node(:, i)) = .true.
               end do
            end associate
         end do
         call check(size(numbering%here), count(is_touched), "as many as its quads touch")
         call check(all(is_touched(numbering%here)), "the nodes of its quads")
         call check(all(numbering%column(numbering%here) == [(i, i=1, size(numbering%here))]), &
            & "numbered in the order of the whole model")
         associate (own => pack(numbering%here, numbering%own))
            counted(own) = counted(own) + 1
         end associate
      end do
      call check(all(counted == 1), "every node is counted by one rank")
   end subroutine test_columns

   !> Where a rank has a node, it has room for the columns of all chunks that meet there
   subroutine test_borders()
      type(numbering_type) :: numbering
      integer :: b, behind, c, i, rank
      integer, allocatable :: taken(:)

      do rank = 0, ranks - 1
         numbering = new_numbering(whole, owner, rank)
         behind = 0
         do b = 1, size(whole%borders, 2)
            associate (column => numbering%column, border => whole%borders(:, b))
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
         call check(all([(any(taken == i), i=1, size(taken))]), "without gaps")
      end do
   end subroutine test_borders

   !> Places of the whole model and of a rank name the same points
   subroutine test_places()
      type(numbering_type) :: numbering
      integer :: c, direction, k, rank
      logical, allocatable :: is_taken(:)

      do rank = 0, ranks - 1
         numbering = new_numbering(whole, owner, rank)
         associate (height => whole%columns%height, here => numbering%here)
            allocate (is_taken(front + height*size(here)))
            is_taken(:) = .false.
            do k = front + 1, whole%columns%freedoms
               c = (k - front - 1)/height + 1
               call check(numbering%has(k) .eqv. any(here == c), "has the places of its nodes")
               call check(numbering%counts(k) .eqv. owner(c) == rank, "counts those that it owns")
               if (numbering%has(k)) is_taken(numbering%place(k)) = .true.
            end do
            call check(all(is_taken(front + 1:)), "every place is that of a point")
            deallocate (is_taken)
            do c = 1, size(here)
               call check(numbering%node(here(c)), c, "nodes are numbered as their columns")
               do direction = 0, 2
                  k = front + height*(here(c) - 1) + direction*height/3 + 1
                  call check(numbering%place(k), front + height*(c - 1) + direction*height/3 + 1, &
                     & "a point keeps its place in the column")
               end do
               k = front + height/3*(here(c) - 1) + 1
               call check(numbering%mass_place(k), front + height/3*(c - 1) + 1, "so has its mass")
            end do
         end associate
      end do
   end subroutine test_places

end program test_domain_numbering
