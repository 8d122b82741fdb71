!> Which facet lies beyond each side of a facet.
module plydyn_contact_search_neighbours
   implicit none
   private

   public :: find_neighbours

   !> Sides of a facet; side s runs from corner s to the next
   integer, parameter, public :: sides = 4

contains

   !> Find the facet beyond each side
   subroutine find_neighbours(facet, points, neighbour)
      !> Points of each facet
      integer, intent(in) :: facet(:, :)
      !> Number of surface points
      integer, intent(in) :: points
      !> Facet beyond each side, 0 at the border
      integer, allocatable, intent(out) :: neighbour(:, :)

      integer, allocatable :: first(:), around(:)
      integer :: f, s

      call gather_facets(facet, points, first, around)
      allocate (neighbour(sides, size(facet, 2)), source=0)
      do f = 1, size(facet, 2)
         do s = 1, sides
            neighbour(s, f) = beyond(facet, around(first(facet(s, f)):first(facet(s, f) + 1) - 1), &
               & facet(s, f), facet(modulo(s, sides) + 1, f))
         end do
      end do
   end subroutine find_neighbours

   !> List the facets around each point that is a corner
   subroutine gather_facets(facet, points, first, around)
      !> Points of each facet
      integer, intent(in) :: facet(:, :)
      !> Number of surface points
      integer, intent(in) :: points
      !> Where the list of each point starts in `around`; one more at the end
      integer, allocatable, intent(out) :: first(:)
      !> Facets, point after point
      integer, allocatable, intent(out) :: around(:)

      integer :: f, p, s
      integer, allocatable :: filled(:)

      allocate (first(points + 1), filled(points), source=0)
      do f = 1, size(facet, 2)
         filled(facet(:sides, f)) = filled(facet(:sides, f)) + 1
      end do
      first(1) = 1
      do p = 1, points
         first(p + 1) = first(p) + filled(p)
      end do
      allocate (around(sides*size(facet, 2)), source=0)
      filled(:) = 0
      do f = 1, size(facet, 2)
         do s = 1, sides
            p = facet(s, f)
            around(first(p) + filled(p)) = f
            filled(p) = filled(p) + 1
         end do
      end do
   end subroutine gather_facets

   !> Facet beyond the side between two corners: it runs through them the other way round
   pure integer function beyond(facet, around, from, to)
      !> Points of each facet
      integer, intent(in) :: facet(:, :)
      !> Facets to look at
      integer, intent(in) :: around(:)
      !> Corners of the side
      integer, intent(in) :: from, to

      integer :: i, s

      beyond = 0
      do i = 1, size(around)
         do s = 1, sides
            if (facet(s, around(i)) == to .and. facet(modulo(s, sides) + 1, around(i)) == from) then
               beyond = around(i)
            end if
         end do
      end do
   end function beyond

end module plydyn_contact_search_neighbours
