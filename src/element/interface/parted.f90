!> Points of interfaces in a crack zone: both faces at a node may be parted, each by the cracks of
!> its own ply. So a corner of a quad has two points, one for each of its halves beside an edge.
module plydyn_element_interface_parted
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_interface_interfaces, only : interface_type
   use plydyn_element_quad, only : tensor_order
   use plydyn_model_crack_zone, only : corner_direction, crack_zone_type, sees_twin
   use plydyn_model_mesh, only : mesh_type
   implicit none
   private

   public :: part_points

   !> Corners of a quad, and halves of each
   integer, parameter :: corners = 4, halves = 2

contains

   !> Give each corner two points of half its area, each at the columns that the plies have there
   pure subroutine part_points(mesh, zone, ply, local_node, self)
      type(mesh_type), intent(in) :: mesh
      type(crack_zone_type), intent(in) :: zone
      !> Ply below each lane, 0 where there is no interface; the rank's number of each node
      integer, intent(in) :: ply(lanes), local_node(:)
      !> Has its quads
      type(interface_type), intent(inout) :: self

      real(wp), allocatable :: metric(:, :, :), weakness(:, :, :)
      integer :: c, e, f, h, l, node(corners), q
      integer, allocatable :: nodes(:, :)

      allocate (nodes(halves*corners, size(self%quad)), metric(5, halves*corners, size(self%quad)))
      do h = 1, halves
         associate (first => corners*(h - 1) + 1, last => corners*h)
            nodes(first:last, :) = self%node
            metric(:, first:last, :) = self%metric
         end associate
      end do
      metric(5, :, :) = metric(5, :, :)/real(halves, wp)
      call move_alloc(metric, self%metric)
      call move_alloc(nodes, self%node)
      self%target = self%node
      self%twin = self%node
      if (allocated(self%weakness)) then
         weakness = reshape([((self%weakness(:, :, e), h=1, halves), e=1, size(self%quad))], &
            & [lanes, halves*corners, size(self%quad)])
         call move_alloc(weakness, self%weakness)
      end if
      allocate (self%sees(lanes, halves*corners, 2, size(self%quad)), source=0.0_wp)
      do e = 1, size(self%quad)
         node(:) = mesh%quad_node(tensor_order(2), self%quad(e))
         do h = 1, halves
            do c = 1, corners
               if (mesh%twin(node(c)) == 0) cycle
               q = c + corners*(h - 1)
               self%twin(q, e) = local_node(mesh%twin(node(c)))
               do f = 1, 2
                  do l = 1, lanes
                     if (ply(l) == 0) cycle
                     if (sees_twin(zone, ply(l) + f - 1, node(c), corner_direction(zone%edge, c, &
                        & h))) self%sees(l, q, f, e) = 1.0_wp
                  end do
               end do
            end do
         end do
      end do
      self%twin_target = self%twin
   end subroutine part_points

end module plydyn_element_interface_parted
