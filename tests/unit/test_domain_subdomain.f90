!> What a rank gets of the whole model, as far as it goes without other ranks.
program test_domain_subdomain
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : begin_domain, build_domain, build_subdomain
   use plydyn_fem_columns, only : alignment_offset
   use plydyn_domain_decomposition, only : decomposition_type
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_memory, only : history_bytes, mesh_bytes
   use plydyn_domain_subdomain, only : subdomain_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   use groups, only : plate_of
   use plydyn_element_plate_layers, only : plate_type
   implicit none

   !> From one island to the same point of the other, mm
   real(wp), parameter :: apart = 20.0_wp

   call test_one_rank()
   call test_islands()
   call test_memory()
   call finish()

contains

   !> The share of a rank that has all chunks is the whole
   subroutine test_one_rank()
      type(decomposition_type) :: division
      type(domain_type) :: domain, whole
      type(plate_type) :: plate
      integer, allocatable :: target(:, :)
      type(subdomain_type) :: share
      integer :: i

      call begin("build_subdomain, all")
      call build(rectangle_mesh(3, 12, 8, 12.0_wp, 8.0_wp, 0.0_wp), whole)
      call share_of(rectangle_mesh(3, 12, 8, 12.0_wp, 8.0_wp, 0.0_wp), [(0, i=1, 1000)], 0, &
         & division, domain, share)
      call check(all(share%column == [(i, i=1, whole%columns%count)]), "all columns")
      call check(all(domain%chunks%counted), "all of them counted")
      call check(all(abs(domain%inertia%mass - whole%inertia%mass) <= 0.0_wp), "with their masses")
      call check(domain%columns%forces, whole%columns%forces, "and room for all forces")
      plate = plate_of(whole, 1)
      target = plate%target
      plate = plate_of(domain, 1)
      call check(all(plate%target == target), "which quads find")
      call check(domain%chunks%outer, 0, "nothing to exchange")
   end subroutine test_one_rank

   !> Two plates apart from each other: each rank gets one of them, and nothing is exchanged
   subroutine test_islands()
      type(decomposition_type) :: division
      type(domain_type) :: domain, whole
      type(plate_type) :: plate
      type(subdomain_type) :: share
      integer, allocatable :: island(:)
      integer :: c, counted, rank
      real(wp) :: mass

      call begin("build_subdomain, islands")
      call build(islands(2), whole)
      plate = plate_of(whole, 1)
      island = [(int(whole%position(1, plate%node(1, whole%chunks%list(c)%elements(1)))/apart), &
         & c=1, size(whole%chunks%list))]
      counted = 0
      mass = 0.0_wp
      do rank = 0, 1
         call share_of(islands(2), island, rank, division, domain, share)
         call check(size(domain%chunks%list), count(island == rank), "the chunks of an island")
         call check(domain%columns%count, whole%columns%count/2, "half of the nodes")
         call check_nodes(whole, domain, share)
         call check_quads(domain)
         call check(domain%chunks%outer, 0, "no chunk that others wait for")
         counted = counted + count(domain%chunks%counted)
         mass = mass + sum(domain%inertia%mass)
      end do
      call check(counted, whole%columns%count, "every node is counted once")
      call check(mass, sum(whole%inertia%mass), 1.0e-14_wp*sum(whole%inertia%mass), &
         & "no mass is lost")
   end subroutine test_islands

   !> What a rank has takes its part of the memory, and no more
   subroutine test_memory()
      integer, parameter :: ranks(3) = [2, 4, 8]
      type(decomposition_type) :: division
      type(domain_type) :: domain, whole
      type(plate_type) :: plate
      type(subdomain_type) :: share
      integer, allocatable :: island(:)
      integer :: c, i, rank
      real(wp) :: part

      call begin("build_subdomain, memory")
      call build(islands(8), whole)
      plate = plate_of(whole, 1)
      island = [(int(whole%position(1, plate%node(1, whole%chunks%list(c)%elements(1)))/apart), &
         & c=1, size(whole%chunks%list))]
      do i = 1, size(ranks)
         part = (mesh_bytes(whole) + history_bytes(whole))/ranks(i)
         do rank = 0, ranks(i) - 1
            call share_of(islands(8), island*ranks(i)/8, rank, division, domain, share)
            ! places in front of the columns are there on every rank
            call check(mesh_bytes(domain) + history_bytes(domain), part, &
               & 8.0_wp*8*alignment_offset, &
               & "a rank has its part")
         end do
      end do
   end subroutine test_memory

   !> Nodes have their numbers, places and masses
   subroutine check_nodes(whole, domain, share)
      type(domain_type), intent(in) :: whole, domain
      type(subdomain_type), intent(in) :: share
      integer :: c, here, there

      call check(all(domain%node_id == whole%node_id(share%column)), "the user's numbers")
      call check(all(abs(domain%position - whole%position(:, share%column)) <= 0.0_wp), &
         & "where they are")
      associate (points => whole%columns%height/3)
         do c = 1, size(share%column)
            here = alignment_offset + points*(c - 1)
            there = alignment_offset + points*(share%column(c) - 1)
            call check(all(abs(domain%inertia%mass(here + 1:here + points) &
               & - whole%inertia%mass(there + 1:there + points)) <= 0.0_wp), "what they weigh")
         end do
      end associate
   end subroutine check_nodes

   !> Quads are numbered one after the other, and read at nodes of the rank
   subroutine check_quads(domain)
      type(domain_type), intent(in) :: domain
      type(plate_type) :: plate
      integer :: c, last

      last = 0
      plate = plate_of(domain, 1)
      do c = 1, size(domain%chunks%list)
         call check(domain%chunks%list(c)%elements(1), last + 1, "chunks follow each other")
         last = domain%chunks%list(c)%elements(2)
      end do
      call check(size(plate%node, 2), last, "to the last quad")
      call check(all(plate%node >= 1 .and. plate%node <= domain%columns%count), &
         & "nodes of quads are here")
   end subroutine check_quads

   !> Squares of 4 by 4 quads, far from each other
   function islands(count) result(mesh)
      integer, intent(in) :: count
      type(mesh_type) :: mesh

      integer :: i
      type(mesh_type) :: one

      one = rectangle_mesh(3, 4, 4, 4.0_wp, 4.0_wp, 0.0_wp)
      mesh = one
      associate (nodes => size(one%node_id), quads => size(one%quad_id), &
         & plane => size(one%quad_node, 1))
         mesh%node_id = [(i, i=1, count*nodes)]
         mesh%quad_id = [(i, i=1, count*quads)]
         mesh%quad_part = spread(1, 1, count*quads)
         mesh%position = reshape([(one%position, i=1, count)], [3, count*nodes])
         mesh%quad_node = reshape([(one%quad_node + nodes*(i - 1), i=1, count)], &
            & [plane, count*quads])
         do i = 1, count
            mesh%position(1, nodes*(i - 1) + 1:nodes*i) = one%position(1, :) + (i - 0.5_wp)*apart
         end do
      end associate
   end function islands

   !> A laminate of two plies
   function model_of(mesh) result(model)
      type(mesh_type), intent(in) :: mesh
      type(model_type) :: model

      model = rectangle_model(mesh, [0.0_wp, 90.0_wp], 0.25_wp, [2, 2])
   end function model_of

   !> All of it
   subroutine build(mesh, whole)
      type(mesh_type), intent(in) :: mesh
      type(domain_type), intent(out) :: whole
      type(error_type), allocatable :: error

      call build_domain(model_of(mesh), whole, error)
      call check(.not. allocated(error), "the domain is built")
   end subroutine build

   !> What one of several ranks has of it
   subroutine share_of(mesh, rank_of_chunk, rank, division, domain, share)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in) :: rank_of_chunk(:), rank
      type(decomposition_type), intent(out) :: division
      type(domain_type), intent(out) :: domain
      type(subdomain_type), intent(out) :: share
      type(error_type), allocatable :: error

      call begin_domain(model_of(mesh), domain, division)
      domain%comm%rank = rank
      call build_subdomain(model_of(mesh), division, rank_of_chunk(:size(division%chunks)), &
         & domain, share, error)
      call check(.not. allocated(error), "the share is built")
   end subroutine share_of

end program test_domain_subdomain
