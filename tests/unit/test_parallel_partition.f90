!> Graphs cut into parts.
program test_parallel_partition
   use plydyn_parallel_partition, only : divide_graph
   use testing, only : begin, check, finish
   implicit none

   call test_grid()
   call test_weights()
   call test_edges()
   call test_small_graphs()
   call finish()

contains

   !> A square grid falls into parts of like size: each bisection may be one vertex off
   subroutine test_grid()
      integer, parameter :: side = 8
      integer, allocatable :: first(:), neighbour(:), part(:)
      integer :: bisections, off, p, parts, sizes(0:side - 1)

      call begin("divide_graph, grid")
      call make_grid(side, first, neighbour)
      do parts = 1, side
         part = divide_graph(first, neighbour, spread(1, 1, side**2), &
            & spread(1, 1, size(neighbour)), parts)
         sizes(:) = [(count(part == p), p=0, side - 1)]
         call check(all(sizes(:parts - 1) > 0), "every part has vertices")
         call check(sum(sizes(:parts - 1)), side**2, "every vertex has a part")
         bisections = ceiling(log(real(parts))/log(2.0))
         off = maxval(abs(parts*sizes(:parts - 1) - side**2))
         call check(off <= parts*bisections, "parts have like sizes")
      end do
   end subroutine test_grid

   !> A vertex as heavy as all others together is alone
   subroutine test_weights()
      integer, parameter :: vertices = 8
      integer, allocatable :: first(:), neighbour(:), part(:)

      call begin("divide_graph, weights")
      call make_path(vertices, first, neighbour)
      part = divide_graph(first, neighbour, [vertices - 1, spread(1, 1, vertices - 1)], &
         & spread(1, 1, size(neighbour)), 2)
      call check(all(part(2:) == 1 - part(1)), "the heavy vertex is alone")
   end subroutine test_weights

   !> Of two cuts that balance alike the cheap one is made
   subroutine test_edges()
      integer, parameter :: side = 4
      integer, allocatable :: first(:), neighbour(:), part(:)
      integer, allocatable :: cost(:)
      integer :: apart, k, other, v

      call begin("divide_graph, edges")
      call make_grid(side, first, neighbour)
      allocate (cost(size(neighbour)))
      ! edges along a row of the grid are dear and those between rows cheap, then those of columns
      do apart = 1, side, side - 1
         do v = 1, side**2
            do k = first(v) + 1, first(v + 1)
               cost(k) = merge(100, 1, abs(neighbour(k) - (v - 1)) == apart)
            end do
         end do
         part = divide_graph(first, neighbour, spread(1, 1, side**2), cost, 2)
         call check(count(part == 0), side**2/2, "halves")
         other = side + 1 - apart
         do v = 1, 1 + (side - 1)*other, other
            call check(all(part(v:v + (side - 1)*apart:apart) == part(v)), "no dear row is cut")
         end do
      end do
   end subroutine test_edges

   !> No part stays empty, however little there is to divide
   subroutine test_small_graphs()
      integer, parameter :: vertices = 5
      integer, allocatable :: first(:), neighbour(:), part(:)
      integer :: p, parts

      call begin("divide_graph, small graphs")
      call make_path(vertices, first, neighbour)
      part = divide_graph(first, neighbour, spread(1, 1, vertices), &
         & spread(1, 1, size(neighbour)), vertices)
      call check(all([(count(part == p), p=0, vertices - 1)] == 1), "a part for each vertex")
      do parts = 2, vertices
         part = divide_graph(first, neighbour, [1000, spread(1, 1, vertices - 1)], &
            & spread(1, 1, size(neighbour)), parts)
         call check(all([(any(part == p), p=0, parts - 1)]), "a vertex of most of the weight")
         call check(all(part >= 0 .and. part < parts), "no part but those asked for")
      end do
      part = divide_graph(spread(0, 1, vertices + 1), [integer ::], spread(1, 1, vertices), &
         & [integer ::], vertices)
      call check(all([(any(part == p), p=0, vertices - 1)]), "vertices that no edge joins")
   end subroutine test_small_graphs

   !> Vertices in a row
   subroutine make_path(vertices, first, neighbour)
      integer, intent(in) :: vertices
      !> As in `divide_graph`
      integer, allocatable, intent(out) :: first(:), neighbour(:)
      integer :: v

      neighbour = [1, (v - 2, v, v=2, vertices - 1), vertices - 2]
      first = [0, (2*v - 1, v=1, vertices - 1), size(neighbour)]
   end subroutine make_path

   !> Vertices of a square grid, row after row
   subroutine make_grid(side, first, neighbour)
      integer, intent(in) :: side
      !> As in `divide_graph`
      integer, allocatable, intent(out) :: first(:), neighbour(:)
      integer :: i, j, v

      first = [0]
      allocate (neighbour(0))
      do j = 0, side - 1
         do i = 0, side - 1
            v = i + side*j
            if (i > 0) neighbour = [neighbour, v - 1]
            if (i < side - 1) neighbour = [neighbour, v + 1]
            if (j > 0) neighbour = [neighbour, v - side]
            if (j < side - 1) neighbour = [neighbour, v + side]
            first = [first, size(neighbour)]
         end do
      end do
   end subroutine make_grid

end program test_parallel_partition
