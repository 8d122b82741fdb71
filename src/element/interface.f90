!> Elastic springs between the faces of two layers, for linear kinematics: the traction on the faces
!> is the stiffness times the jump of the displacement, integrated at the Gauss points of the plane.
module plydyn_element_interface
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: add_spring_forces

   !> One interface over all quads of a part
   type, public :: interface_type
      !> Layers below and above
      integer :: lower = 0, upper = 0
      !> Stiffness along x, y, z: traction per jump
      real(wp) :: stiffness(3) = 0.0_wp
      !> Places in the arrays of motion of the displacement along x at the nodes of each quad, on
      !> the lower and the upper face; (side**2, quads)
      integer, allocatable :: lower_point(:, :), upper_point(:, :)
      !> From a point's displacement along x to that along y, below and above
      integer :: lower_stride = 0, upper_stride = 0
      !> Shape functions at the Gauss points, (points, nodes)
      real(wp), allocatable :: shape(:, :)
      !> Area of each Gauss point, (side**2, quads)
      real(wp), allocatable :: area(:, :)
   end type interface_type

contains

   !> Subtract the forces of the springs on both faces
   pure subroutine add_spring_forces(self, displacement, force)
      !> The interface
      type(interface_type), intent(in) :: self
      !> Displacement of all points
      real(wp), intent(in) :: displacement(:)
      !> Force on all points
      real(wp), intent(inout) :: force(:)

      real(wp) :: jump(size(self%shape, 2)), traction(size(self%shape, 2))
      integer :: below(size(jump)), above(size(jump)), c, e

      do e = 1, size(self%area, 2)
         do c = 1, 3
            below(:) = self%lower_point(:, e) + (c - 1)*self%lower_stride
            above(:) = self%upper_point(:, e) + (c - 1)*self%upper_stride
            jump(:) = displacement(above) - displacement(below)
            traction(:) = self%stiffness(c)*self%area(:, e)*matmul(self%shape, jump)
            jump(:) = matmul(traction, self%shape)
            force(below) = force(below) + jump
            force(above) = force(above) - jump
         end do
      end do
   end subroutine add_spring_forces

end module plydyn_element_interface
