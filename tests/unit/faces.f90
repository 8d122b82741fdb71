!> Interfaces between the layers over a distorted plate.
module faces
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_interface_interfaces, only : interface_type, set_plane
   use plydyn_model_mesh, only : mesh_type
   use sample, only : rectangle_mesh
   implicit none
   private

   public :: lay_interfaces

   !> Area of the plate
   real(wp), parameter, public :: area = 24.0_wp

contains

   !> Interfaces above the lowest layers of a stack, which has no law yet
   subroutine lay_interfaces(side, levels, joints, nodal, adjacent, self, mesh)
      !> Nodes along a side of a quad, thickness nodes of a layer, interfaces
      integer, intent(in) :: side, levels, joints
      !> Points at the nodes in place of Gauss points; layers that lie in neighbouring lanes
      logical, intent(in) :: nodal, adjacent
      !> The interfaces
      type(interface_type), intent(out) :: self
      !> The plate
      type(mesh_type), intent(out) :: mesh

      integer :: i, l

      mesh = rectangle_mesh(side, 3, 2, 6.0_wp, 4.0_wp, 0.06_wp)
      self%lower(:joints) = [(l, l=1, joints)]
      self%present(:joints) = 1.0_wp
      self%adjacent = adjacent
      self%below%first(:) = [(l + lanes*(levels - 1), l=1, lanes)]
      self%above%first(:) = [(l + 1, l=1, lanes)]
      self%below%stride(:) = lanes*levels
      self%above%stride(:) = lanes*levels
      self%below%step(:) = 3*lanes*levels
      self%above%step(:) = 3*lanes*levels
      self%side = side
      self%nodal = nodal
      call set_plane(self, mesh, [(i, i=1, size(mesh%quad_id))], [(i, i=1, size(mesh%node_id))])
   end subroutine lay_interfaces

end module faces
