!> What a rank gets of the whole model, as far as it goes without other ranks.
program test_domain_share
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_columns, only : front
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_share, only : column_owners, share_type, take_share
   use plydyn_model_mesh, only : mesh_type
   use plydyn_parallel_comm, only : comm_type
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   !> From one island to the same point of the other, mm
   real(wp), parameter :: apart = 20.0_wp

   call test_owners()
   call test_one_rank()
   call test_islands()
   call finish()

contains

   !> A column belongs to the rank of the chunk that adds to it
   subroutine test_owners()
      type(domain_type) :: whole
      integer, allocatable :: owner(:)
      integer :: c

      call begin("column_owners")
      call build(rectangle_mesh(3, 12, 8, 12.0_wp, 8.0_wp, 0.0_wp), whole)
      owner = column_owners(whole, [(10*c, c=1, size(whole%chunks))])
      do c = 1, size(whole%chunks)
         call check(count(owner == 10*c), size(whole%chunks(c)%column), "as many as it has")
         call check(all(owner(whole%chunks(c)%column) == 10*c), "the columns of the chunk")
      end do
   end subroutine test_owners

   !> The share of a rank that has all chunks is the whole
   subroutine test_one_rank()
      type(comm_type) :: comm
      type(domain_type) :: domain, whole
      type(share_type) :: share
      integer :: i

      call begin("take_share, all")
      call build(rectangle_mesh(3, 12, 8, 12.0_wp, 8.0_wp, 0.0_wp), whole)
      call take_share(whole, spread(0, 1, size(whole%chunks)), comm, domain, share)
      call check(all(share%column == [(i, i=1, whole%columns%count)]), "all columns")
      call check(all(share%own), "all of them counted")
      call check(all(abs(domain%mass - whole%mass) <= 0.0_wp), "with their masses")
      call check(domain%columns%forces, whole%columns%forces, "and room for all forces")
      call check(all(domain%plates(1)%target == whole%plates(1)%target), "which quads find")
      call check(domain%halo%is_empty(), "nothing to exchange")
   end subroutine test_one_rank

   !> Two plates apart from each other: each rank gets one of them, and nothing is exchanged
   subroutine test_islands()
      type(comm_type) :: comm
      type(domain_type) :: domain, whole
      type(share_type) :: share
      integer, allocatable :: island(:)
      integer :: c, counted, rank
      real(wp) :: mass

      call begin("take_share, islands")
      call build(islands(), whole)
      island = [(merge(0, 1, whole%position(1, whole%plates(1)%node(1, &
         & whole%chunks(c)%quads(1))) < apart), c=1, size(whole%chunks))]
      comm%ranks = 2
      counted = 0
      mass = 0.0_wp
      do rank = 0, 1
         comm%rank = rank
         call take_share(whole, island, comm, domain, share)
         call check(size(domain%chunks), count(island == rank), "the chunks of an island")
         call check(domain%columns%count, whole%columns%count/2, "half of the nodes")
         call check_nodes(whole, domain, share)
         call check_quads(domain)
         call check(domain%halo%is_empty(), "nothing to exchange")
         call check(domain%outer, 0, "no chunk that others wait for")
         counted = counted + count(share%own)
         mass = mass + sum(domain%mass)
      end do
      call check(counted, whole%columns%count, "every node is counted once")
      call check(mass, sum(whole%mass), 1.0e-14_wp*sum(whole%mass), "no mass is lost")
   end subroutine test_islands

   !> Nodes have their numbers, places and masses
   subroutine check_nodes(whole, domain, share)
      type(domain_type), intent(in) :: whole, domain
      type(share_type), intent(in) :: share
      integer :: c, here, there

      call check(all(domain%node_id == whole%node_id(share%column)), "the user's numbers")
      call check(all(abs(domain%position - whole%position(:, share%column)) <= 0.0_wp), &
         & "where they are")
      associate (points => whole%columns%height/3)
         do c = 1, size(share%column)
            here = front + points*(c - 1)
            there = front + points*(share%column(c) - 1)
            call check(all(abs(domain%mass(here + 1:here + points) &
               & - whole%mass(there + 1:there + points)) <= 0.0_wp), "what they weigh")
         end do
      end associate
   end subroutine check_nodes

   !> Quads are numbered one after the other, and read at nodes of the rank
   subroutine check_quads(domain)
      type(domain_type), intent(in) :: domain
      integer :: c, last

      last = 0
      associate (plate => domain%plates(1))
         do c = 1, size(domain%chunks)
            call check(domain%chunks(c)%quads(1), last + 1, "chunks follow each other")
            last = domain%chunks(c)%quads(2)
         end do
         call check(size(plate%node, 2), last, "to the last quad")
         call check(all(plate%node >= 1 .and. plate%node <= domain%columns%count), &
            & "nodes of quads are here")
      end associate
   end subroutine check_quads

   !> Two squares of 4 by 4 quads, far from each other
   function islands() result(mesh)
      type(mesh_type) :: mesh
      type(mesh_type) :: one

      one = rectangle_mesh(3, 4, 4, 4.0_wp, 4.0_wp, 0.0_wp)
      mesh = one
      associate (nodes => size(one%node_id))
         mesh%node_id = [one%node_id, one%node_id + 10*nodes]
         mesh%position = reshape([one%position, one%position], [3, 2*nodes])
         mesh%position(1, nodes + 1:) = mesh%position(1, nodes + 1:) + apart
         mesh%quad_node = reshape([one%quad_node, one%quad_node + nodes], &
            & [size(one%quad_node, 1), 2*size(one%quad_node, 2)])
      end associate
      mesh%quad_id = [one%quad_id, one%quad_id + size(one%quad_id)]
      mesh%quad_part = [one%quad_part, one%quad_part]
   end function islands

   !> A laminate of two plies
   subroutine build(mesh, whole)
      type(mesh_type), intent(in) :: mesh
      type(domain_type), intent(out) :: whole
      type(error_type), allocatable :: error

      call build_domain(rectangle_model(mesh, [0.0_wp, 90.0_wp], 0.25_wp, [2, 2]), whole, error)
      call check(.not. allocated(error), "the domain is built")
   end subroutine build

end program test_domain_share
