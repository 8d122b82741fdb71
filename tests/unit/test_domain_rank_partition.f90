!> Ranks of chunks.
program test_domain_rank_partition
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_decomposition, only : decomposition_type, divide_plane
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_rank_partition, only : divide_ranks
   use plydyn_model_model, only : model_type
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   integer, allocatable :: rank(:)

   call begin("divide_ranks")
   rank = ranks_of(2, 2, 3)
   call check(size(rank), 1, "four quads are one chunk, which meets no other")
   call check(rank(1), 0, "and belongs to the first rank")
   ! chunks of 4 by 2 quads in a row
   rank = ranks_of(32, 2, 2)
   call check(size(rank), 8, "a strip is a row of chunks")
   call check(count(rank == 0), 4, "half of them for each rank")
   call check(count(rank(2:) /= rank(:7)), 1, "which meet once")
   call finish()

contains

   !> Rank of each chunk of a rectangle of unit squares
   function ranks_of(along, across, ranks) result(rank)
      !> Quads along x and y, and how many ranks there are
      integer, intent(in) :: along, across, ranks
      integer, allocatable :: rank(:)

      type(decomposition_type) :: division
      type(domain_type) :: domain
      type(error_type), allocatable :: error
      type(model_type) :: model

      model = rectangle_model(rectangle_mesh(2, along, across, real(along, wp), real(across, wp), &
         & 0.0_wp), [0.0_wp], 0.25_wp, [1])
      call build_domain(model, domain, error)
      call check(.not. allocated(error), "the domain is built")
      division = divide_plane(model%mesh, 1)
      call divide_ranks(domain, division, ranks, rank)
   end function ranks_of

end program test_domain_rank_partition
