!> Points around those of a rank: all that may be averaged with them, in the order of the model.
program test_domain_neighbourhood
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : begin_domain, build_domain
   use plydyn_domain_decomposition, only : decomposition_type
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_neighbourhood, only : neighbourhood_type, new_neighbourhood
   use plydyn_model_model, only : model_type
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   use groups, only : plate_of
   use plydyn_element_plate_layers, only : plate_type
   implicit none

   !> Ranks, and how far points are averaged: about one quad
   integer, parameter :: ranks = 3
   real(wp), parameter :: reach = 1.1_wp
   type(decomposition_type) :: division
   type(plate_type) :: plate
   type(domain_type) :: domain, whole
   type(error_type), allocatable :: error
   type(model_type) :: model
   type(neighbourhood_type) :: everywhere, nothing
   integer, allocatable :: rank_of_chunk(:)
   integer :: c, rank

   model = rectangle_model(rectangle_mesh(3, 12, 8, 12.0_wp, 8.0_wp, 0.03_wp), [0.0_wp], &
      & 0.25_wp, [1])
   call begin_domain(model, domain, division)
   rank_of_chunk = [(mod(c, ranks), c=1, size(division%chunks))]
   call build_domain(model, whole, error)

   call begin("one rank")
   everywhere = new_neighbourhood(model%mesh, division, 0*rank_of_chunk, 0, 1, &
      & plate_of(domain, 1), &
      & reach)
   call check(size(everywhere%rank), 96, "has all quads")
   plate = plate_of(whole, 1)
   call check(all_same(reshape(plate%metric(5, :, :), [9*96]), everywhere%area), &
      & "in the order of its plate")

   do rank = 0, ranks - 1
      call test_rank(rank)
   end do

   call begin("no quads")
   nothing = around(ranks)
   call check(size(nothing%area), 0, "no neighbours")
   call finish()

contains

   !> What a rank knows
   function around(rank) result(self)
      integer, intent(in) :: rank
      type(neighbourhood_type) :: self

      self = new_neighbourhood(model%mesh, division, rank_of_chunk, rank, 1, plate_of(domain, 1), &
         & reach)
   end function around

   !> A rank knows its own quads and their neighbours, as all others do
   subroutine test_rank(rank)
      integer, intent(in) :: rank

      type(neighbourhood_type) :: near
      integer :: i, j, next, own
      integer, allocatable :: known(:)

      call begin("several ranks")
      near = around(rank)
      ! its points among all
      allocate (known(size(near%area)))
      next = 1
      do i = 1, size(known)
         do while (any(abs(near%position(:, i) - everywhere%position(:, next)) > 0.0_wp))
            next = next + 1
         end do
         known(i) = next
      end do
      call check(all_same(near%area, everywhere%area(known)), &
         & "points are in the order of the model")
      own = 0
      do i = 1, size(known)
         if (near%rank_of(i) /= rank) cycle
         own = own + 1
         call check(near%own_point(i), own, "its own are numbered one after the other")
         do j = 1, size(everywhere%area)
            if (norm2(everywhere%position(:, j) - near%position(:, i)) > reach) cycle
            call check(any(known == j), "no point within reach is missing")
         end do
      end do
      call check(own, 9*sum(division%chunks%elements(2) - division%chunks%elements(1) + 1, &
         & rank_of_chunk == rank), "all of its own are there")
      call check(all(near%own_point(pack([(i, i=1, size(known))], &
         & near%rank_of([(i, i=1, size(known))]) /= rank)) == 0), "others are not its own")
   end subroutine test_rank

   !> Whether two lists are the same to the last bit
   pure logical function all_same(one, other)
      real(wp), intent(in) :: one(:), other(:)

      all_same = size(one) == size(other)
      if (all_same) all_same = all(abs(one - other) <= 0.0_wp)
   end function all_same

end program test_domain_neighbourhood
