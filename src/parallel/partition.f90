!> Who gets what: a graph cut into parts by METIS (Karypis and Kumar, 1998).
module plydyn_parallel_partition
   use, intrinsic :: iso_c_binding, only : c_int, c_null_ptr, c_ptr
   implicit none
   private

   public :: divide_graph

   interface
      !> Recursive bisection, as METIS 5 has it
      integer(c_int) function metis_part(vertices, constraints, first, neighbour, weight, sizes, &
         & edge_weight, parts, targets, tolerance, options, cut, part) &
         & bind(c, name="METIS_PartGraphRecursive")
         import :: c_int, c_ptr
         implicit none
         integer(c_int), intent(in) :: vertices, constraints, first(*), neighbour(*), weight(*)
         type(c_ptr), value :: sizes
         integer(c_int), intent(in) :: edge_weight(*), parts
         type(c_ptr), value :: targets, tolerance, options
         integer(c_int), intent(out) :: cut, part(*)
      end function metis_part
   end interface

   !> What METIS answers when all is well
   integer(c_int), parameter :: metis_ok = 1_c_int
   !> Vertices for each part below which METIS may leave one empty, and says so on the screen
   integer, parameter :: fewest = 4

contains

   !> Part of each vertex, from 0: parts of like weight that few edges join, none of them empty
   function divide_graph(first, neighbour, weight, edge_weight, parts) result(part)
      !> Place of each vertex's first neighbour, from 0, and the end behind the last
      integer, intent(in) :: first(:)
      !> Neighbours, from 0
      integer, intent(in) :: neighbour(:)
      !> Work of each vertex, and what each edge costs that is cut
      integer, intent(in) :: weight(:), edge_weight(:)
      !> How many parts; no more than vertices
      integer, intent(in) :: parts
      integer :: part(size(weight))

      integer(c_int) :: cut, found(size(weight)), status
      integer :: p

      if (parts == 1 .or. size(weight) < fewest*parts) then
         part(:) = in_a_row(weight, parts)
         return
      end if
      status = metis_part(size(weight), 1_c_int, first, neighbour, weight, c_null_ptr, &
         & edge_weight, parts, c_null_ptr, c_null_ptr, c_null_ptr, cut, found)
      part(:) = found
      if (status /= metis_ok .or. any([(all(part /= p), p=0, parts - 1)])) then
         part(:) = in_a_row(weight, parts)
      end if
   end function divide_graph

   !> Parts of vertices one after the other: for graphs so small that METIS leaves a part empty
   pure function in_a_row(weight, parts) result(part)
      integer, intent(in) :: weight(:), parts
      integer :: part(size(weight))

      real :: before
      integer :: v

      before = 0.0
      do v = 1, size(weight)
         part(v) = int(parts*(before + 0.5*weight(v))/sum(real(weight)))
         before = before + weight(v)
      end do
      ! no part is left out, and the last ones have a vertex each at least
      part(1) = 0
      do v = 2, size(weight)
         part(v) = max(min(part(v), part(v - 1) + 1), parts - 1 - (size(weight) - v))
      end do
   end function in_a_row

end module plydyn_parallel_partition
