!> Facets beyond the sides of facets.
program test_contact_search_neighbours
   use plydyn_contact_search_neighbours, only : find_neighbours, sides
   use testing, only : begin, check, finish
   implicit none

   !> Three squares in an L, the first in the corner, and one apart
   integer, parameter :: facet(4, 4) = reshape( &
      & [1, 2, 5, 4, 2, 3, 6, 5, 5, 8, 7, 4, 9, 10, 11, 12], [4, 4])
   integer, allocatable :: neighbour(:, :)
   integer :: f, s

   call begin("find_neighbours")
   call find_neighbours(facet, 12, neighbour)
   ! side s runs from corner s to the next
   call check(neighbour(2, 1), 2, "to the right")
   call check(neighbour(4, 2), 1, "and back")
   call check(neighbour(3, 1), 3, "up")
   call check(neighbour(4, 3), 1, "and back down, whichever corner comes first")
   call check(count(neighbour > 0), 4, "all other sides are at the border")
   do f = 1, size(facet, 2)
      do s = 1, sides
         call check(neighbour(s, f) /= f, "nobody is his own neighbour")
      end do
   end do
   call finish()

end program test_contact_search_neighbours
