!> Nodes of the plane whose columns differ by their area only.
module plydyn_domain_node_classes
   use plydyn_base_precision, only : wp
   use plydyn_element_plate, only : plate_type
   use plydyn_element_quad, only : quad_node_area
   implicit none
   private

   public :: find_classes, node_areas

   !> Relative difference below which two numbers are the same
   real(wp), parameter :: same = 1.0e-9_wp

contains

   !> Area that belongs to each node in each part, by quadrature at the nodes, (nodes, parts)
   pure function node_areas(plates, position) result(area)
      !> One plate for each part
      type(plate_type), intent(in) :: plates(:)
      !> Positions of the nodes of the plane, (3, nodes)
      real(wp), intent(in) :: position(:, :)
      real(wp) :: area(size(position, 2), size(plates))

      integer :: e, p

      area(:, :) = 0.0_wp
      do p = 1, size(plates)
         associate (node => plates(p)%node)
            do e = 1, size(node, 2)
               area(node(:, e), p) = area(node(:, e), p) &
                  & + quad_node_area(plates(p)%side, position(1:2, node(:, e)))
            end do
         end associate
      end do
   end function node_areas

   !> Class of each node, counted in the order of their first nodes
   pure subroutine find_classes(key, class, first)
      !> What makes a class, (numbers, nodes)
      real(wp), intent(in) :: key(:, :)
      !> Class of each node
      integer, intent(out) :: class(:)
      !> First node of each class
      integer, allocatable, intent(out) :: first(:)

      integer :: k, n

      allocate (first(0))
      nodes: do n = 1, size(key, 2)
         do k = 1, size(first)
            if (any(abs(key(:, n) - key(:, first(k))) > same*abs(key(:, first(k))))) cycle
            class(n) = k
            cycle nodes
         end do
         first = [first, n]
         class(n) = size(first)
      end do nodes
   end subroutine find_classes

end module plydyn_domain_node_classes
