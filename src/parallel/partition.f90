!> Graph partitioning by METIS (Karypis and Kumar, 1998).
module plydyn_parallel_partition
   use, intrinsic :: iso_c_binding, only : c_int, c_null_ptr, c_ptr
   implicit none
   private

   public :: divide_graph

   interface
      !> Recursive bisection of METIS 5
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

   !> Return value of METIS on success
   integer(c_int), parameter :: metis_ok = 1_c_int
   !> Vertices per part below which METIS may return empty parts, and prints a message
   integer, parameter :: least_vertices = 4

contains

   !> Part of each vertex, from 0: balanced weight, small edge cut, no empty part
   function divide_graph(first, neighbour, weight, edge_weight, parts) result(part)
      !> Offset of each vertex's first neighbour, from 0, and the end of the last list
      integer, intent(in) :: first(:)
      !> Neighbours, from 0
      integer, intent(in) :: neighbour(:)
      !> Work of each vertex, and communication cost of each edge
      integer, intent(in) :: weight(:), edge_weight(:)
      !> Number of parts, at most that of vertices
      integer, intent(in) :: parts
      integer :: part(size(weight))

      integer(c_int) :: cut, found(size(weight)), status
      integer :: p

      if (parts == 1 .or. size(weight) < least_vertices*parts) then
         part(:) = consecutive_parts(weight, parts)
         return
      end if
      status = metis_part(size(weight), 1_c_int, first, neighbour, weight, c_null_ptr, &
         & edge_weight, parts, c_null_ptr, c_null_ptr, c_null_ptr, cut, found)
      part(:) = found
      if (status /= metis_ok .or. any([(all(part /= p), p=0, parts - 1)])) then
         part(:) = consecutive_parts(weight, parts)
      end if
   end function divide_graph

   !> Parts of consecutive vertices, for graphs so small that METIS would leave a part empty
   pure function consecutive_parts(weight, parts) result(part)
      integer, intent(in) :: weight(:), parts
      integer :: part(size(weight))

      real :: before
      integer :: v

      before = 0.0
      do v = 1, size(weight)
         part(v) = int(parts*(before + 0.5*weight(v))/sum(real(weight)))
         before = before + weight(v)
      end do
      ! no part is skipped, and vertices are left for the last parts
      part(1) = 0
      do v = 2, size(weight)
         part(v) = max(min(part(v), part(v - 1) + 1), parts - 1 - (size(weight) - v))
      end do
   end function consecutive_parts

end module plydyn_parallel_partition
