!> Classical laminate theory: the stiffness of a stack as a plate, for the listing and for checks.
module plydyn_law_ply_laminate
   use plydyn_base_precision, only : wp
   use plydyn_law_constants, only : law_constants_type
   use plydyn_law_ply_elastic, only : strain_rotation
   implicit none
   private

   public :: add_ply_stiffness

   !> Strains of the plane in the order of a laminate, xx, yy, xy, as places in xx, yy, zz, xy, ...
   integer, parameter :: plane(3) = [1, 2, 4]

contains

   !> Add a ply to A (force per length), B (force) and D (force times length) of a laminate
   pure subroutine add_ply_stiffness(ply, angle, face, a, b, d)
      !> Elastic constants of the ply
      class(law_constants_type), intent(in) :: ply
      !> Fibre direction, degrees from the x axis
      real(wp), intent(in) :: angle
      !> Heights of its bottom and top face above the reference plane
      real(wp), intent(in) :: face(2)
      !> Stiffness of the laminate
      real(wp), intent(inout) :: a(3, 3), b(3, 3), d(3, 3)

      real(wp) :: part, q(3, 3), rotation(6, 6), turn(3, 3)

      associate (young => ply%young, poisson => ply%poisson(1))
         part = 1.0_wp/(1.0_wp - poisson**2*young(2)/young(1))
         q(:, :) = 0.0_wp
         q(1, 1) = young(1)*part
         q(2, 2) = young(2)*part
         q(1, 2) = poisson*young(2)*part
         q(2, 1) = q(1, 2)
      end associate
      q(3, 3) = ply%shear(1)
      rotation(:, :) = strain_rotation(angle)
      turn(:, :) = rotation(plane, plane)
      q(:, :) = matmul(transpose(turn), matmul(q, turn))
      a(:, :) = a + q*(face(2) - face(1))
      b(:, :) = b + q*(face(2)**2 - face(1)**2)/2.0_wp
      d(:, :) = d + q*(face(2)**3 - face(1)**3)/3.0_wp
   end subroutine add_ply_stiffness

end module plydyn_law_ply_laminate
