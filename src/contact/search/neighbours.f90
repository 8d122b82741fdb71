!> Sides of facets: the facet across each of them, and the points on it.
module plydyn_contact_search_neighbours
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: find_neighbours, point_of_side

   !> Sides of a facet; side s runs from corner s to the next
   integer, parameter, public :: sides = 4

contains

   !> Local coordinates of a point of a side
   pure function point_of_side(side, along) result(local)
      !> Side of the facet
      integer, intent(in) :: side
      !> Coordinate along it, from -1 to 1 counter-clockwise
      real(wp), intent(in) :: along
      real(wp) :: local(2)

      select case (side)
      case (1)
         local(:) = [along, -1.0_wp]
      case (2)
         local(:) = [1.0_wp, along]
      case (3)
         local(:) = [-along, 1.0_wp]
      case default
         local(:) = [-1.0_wp, -along]
      end select
   end function point_of_side

   !> Find the facet across each side
   subroutine find_neighbours(facet, points, neighbour)
      !> Points of each facet
      integer, intent(in) :: facet(:, :)
      !> Number of surface points
      integer, intent(in) :: points
      !> Facet across each side, 0 at a free edge
      integer, allocatable, intent(out) :: neighbour(:, :)

      integer, allocatable :: first(:), around(:)
      integer :: f, s

      call list_facets(facet, points, first, around)
      allocate (neighbour(sides, size(facet, 2)), source=0)
      do f = 1, size(facet, 2)
         do s = 1, sides
            neighbour(s, f) = facet_across(facet, around(first(facet(s, f)): &
               & first(facet(s, f) + 1) - 1), facet(s, f), facet(modulo(s, sides) + 1, f))
         end do
      end do
   end subroutine find_neighbours

   !> List the facets around each corner point
   subroutine list_facets(facet, points, first, around)
      !> Points of each facet
      integer, intent(in) :: facet(:, :)
      !> Number of surface points
      integer, intent(in) :: points
      !> First entry of each point in `around`; one more at the end
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
   end subroutine list_facets

   !> Facet across the side between two corners: the one that has them in the opposite order
   pure integer function facet_across(facet, around, from, to)
      !> Points of each facet
      integer, intent(in) :: facet(:, :)
      !> Facets to search
      integer, intent(in) :: around(:)
      !> Corners of the side
      integer, intent(in) :: from, to

      integer :: i, s

      facet_across = 0
      do i = 1, size(around)
         do s = 1, sides
            if (facet(s, around(i)) == to .and. facet(modulo(s, sides) + 1, around(i)) == from) then
               facet_across = around(i)
            end if
         end do
      end do
   end function facet_across

end module plydyn_contact_search_neighbours
