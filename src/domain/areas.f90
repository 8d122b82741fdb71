!> Areas of the nodes of the plane.
module plydyn_domain_areas
   use plydyn_base_precision, only : wp
   use plydyn_domain_decomposition, only : decomposition_type
   use plydyn_domain_local_to_global, only : local_to_global_type
   use plydyn_element_quad, only : quad_node_area, tensor_order
   use plydyn_model_mesh, only : mesh_type
   implicit none
   private

   public :: node_areas

contains

   !> Area that belongs to each node in each part, by quadrature at the nodes, (nodes, parts)
   pure function node_areas(mesh, division, numbering) result(area)
      type(mesh_type), intent(in) :: mesh
      !> Its quads, those of other ranks too: they add to nodes where ranks meet
      type(decomposition_type), intent(in) :: division
      !> Numbers of the nodes that the rank has
      type(local_to_global_type), intent(in) :: numbering
      real(wp), allocatable :: area(:, :)

      real(wp) :: all(size(mesh%quad_node, 1))
      integer :: e, here(size(mesh%quad_node, 1)), i, node(size(mesh%quad_node, 1)), p, side

      side = nint(sqrt(real(size(mesh%quad_node, 1), wp)))
      allocate (area(size(numbering%here), size(division%parts)))
      area(:, :) = 0.0_wp
      do p = 1, size(division%parts)
         associate (quads => division%parts(p)%element)
            do e = 1, size(quads)
               node(:) = mesh%quad_node(tensor_order(side), quads(e))
               here(:) = numbering%node(node)
               if (.not. any(here > 0)) cycle
               all(:) = quad_node_area(side, mesh%position(1:2, node))
               do i = 1, size(all)
                  if (here(i) > 0) area(here(i), p) = area(here(i), p) + all(i)
               end do
            end do
         end associate
      end do
   end function node_areas

end module plydyn_domain_areas
