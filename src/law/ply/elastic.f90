!> Elastic plies: stiffness in ply axes and in the axes of the plate; that of a stack as a plate
!> (classical laminate theory), for the listing and for checks; and the elastic law of a batch, for
!> stacks in which other layers yield or crack.
!>
!> Order of stress and strain: xx, yy, zz, xy, xz, yz, with engineering shear.
module plydyn_law_ply_elastic
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : law_constants_type, law_type
   implicit none
   private

   public :: add_ply_stiffness, ply_stiffness, strain_rotation, turned_stiffness

   !> Strains of the plane in the order of a laminate, xx, yy, xy, as places in xx, yy, zz, xy, ...
   integer, parameter :: plane(3) = [1, 2, 4]

   !> Constants of an elastic ply or metal
   type, public, extends(law_constants_type) :: elastic_constants_type
   contains
      procedure :: new_batch
      procedure :: set_lane
      procedure :: is_elastic
   end type elastic_constants_type

   !> Stiffness of each lane
   type, public, extends(law_type) :: orthotropic_type
      !> C11 C12 C13 C22 C23 C33 C44 C55 C66 in ply axes, (lanes, 9)
      real(wp) :: stiffness(lanes, 9) = 0.0_wp
   contains
      procedure :: update
   end type orthotropic_type

contains

   !> Stiffness of an orthotropic material in its own axes, from the inverse of its compliance
   pure function ply_stiffness(young, poisson, shear) result(stiffness)
      !> E1, E2, E3
      real(wp), intent(in) :: young(3)
      !> nu12, nu13, nu23: strain in the second direction from stress along the first
      real(wp), intent(in) :: poisson(3)
      !> G12, G13, G23
      real(wp), intent(in) :: shear(3)
      real(wp) :: stiffness(6, 6)

      real(wp) :: nu21, nu31, nu32, part
      integer :: i

      associate (nu12 => poisson(1), nu13 => poisson(2), nu23 => poisson(3))
         nu21 = nu12*young(2)/young(1)
         nu31 = nu13*young(3)/young(1)
         nu32 = nu23*young(3)/young(2)
         ! one over the determinant of the normal compliance times E1 E2 E3
         part = 1.0_wp/(1.0_wp - nu12**2*young(2)/young(1) - nu13**2*young(3)/young(1) &
            & - nu23**2*young(3)/young(2) - 2.0_wp*nu12*nu23*nu13*young(3)/young(1))
         stiffness(:, :) = 0.0_wp
         stiffness(1, 1) = young(1)*(1.0_wp - nu23*nu32)*part
         stiffness(2, 2) = young(2)*(1.0_wp - nu13*nu31)*part
         stiffness(3, 3) = young(3)*(1.0_wp - nu12*nu21)*part
         stiffness(1, 2) = young(1)*(nu21 + nu31*nu23)*part
         stiffness(1, 3) = young(1)*(nu31 + nu21*nu32)*part
         stiffness(2, 3) = young(2)*(nu32 + nu12*nu31)*part
      end associate
      stiffness(2, 1) = stiffness(1, 2)
      stiffness(3, 1) = stiffness(1, 3)
      stiffness(3, 2) = stiffness(2, 3)
      do i = 1, 3
         stiffness(3 + i, 3 + i) = shear(i)
      end do
   end function ply_stiffness

   !> Strain in ply axes from strain in the axes of the plate; its transpose turns stress back
   pure function strain_rotation(angle) result(rotation)
      !> Fibre direction, degrees from the x axis
      real(wp), intent(in) :: angle
      real(wp) :: rotation(6, 6)

      real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp
      real(wp) :: c, s

      c = cos(angle*degree)
      s = sin(angle*degree)
      rotation(:, :) = 0.0_wp
      rotation(1, [1, 2, 4]) = [c*c, s*s, c*s]
      rotation(2, [1, 2, 4]) = [s*s, c*c, -c*s]
      rotation(3, 3) = 1.0_wp
      rotation(4, [1, 2, 4]) = [-2.0_wp*c*s, 2.0_wp*c*s, c*c - s*s]
      rotation(5, [5, 6]) = [c, s]
      rotation(6, [5, 6]) = [-s, c]
   end function strain_rotation

   !> Stiffness of a ply in the axes of the plate
   pure function turned_stiffness(ply, angle) result(stiffness)
      !> Its elastic constants
      class(law_constants_type), intent(in) :: ply
      !> Fibre direction, degrees from the x axis
      real(wp), intent(in) :: angle
      real(wp) :: stiffness(6, 6)

      real(wp) :: rotation(6, 6)

      rotation(:, :) = strain_rotation(angle)
      stiffness(:, :) = matmul(transpose(rotation), &
         & matmul(ply_stiffness(ply%young, ply%poisson, ply%shear), rotation))
   end function turned_stiffness

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

   !> A law without lanes
   subroutine new_batch(self, law)
      class(elastic_constants_type), intent(in) :: self
      class(law_type), allocatable, intent(out) :: law

      allocate (orthotropic_type :: law)
   end subroutine new_batch

   !> Give a lane of a batch its material
   pure subroutine set_lane(self, lane, law)
      class(elastic_constants_type), intent(in) :: self
      integer, intent(in) :: lane
      class(law_type), intent(inout) :: law

      real(wp) :: c(6, 6)

      c(:, :) = ply_stiffness(self%young, self%poisson, self%shear)
      select type (law)
      type is (orthotropic_type)
         law%owns(lane) = .true.
         law%stiffness(lane, :) = [c(1, 1:3), c(2, 2:3), c(3, 3), c(4, 4), c(5, 5), c(6, 6)]
      end select
   end subroutine set_lane

   !> The stress is the stiffness times the strain
   pure logical function is_elastic(self)
      class(elastic_constants_type), intent(in) :: self

      is_elastic = .true.
   end function is_elastic

   !> Stress of the strain
   pure subroutine update(self, step, strain, history, stress)
      class(orthotropic_type), intent(in) :: self
      real(wp), intent(in) :: step, strain(lanes, 6)
      real(wp), intent(inout) :: history(lanes, *), stress(lanes, 6)

      real(wp) :: own(lanes, 6)
      integer :: i

      associate (c => self%stiffness, e => strain)
         own(:, 1) = c(:, 1)*e(:, 1) + c(:, 2)*e(:, 2) + c(:, 3)*e(:, 3)
         own(:, 2) = c(:, 2)*e(:, 1) + c(:, 4)*e(:, 2) + c(:, 5)*e(:, 3)
         own(:, 3) = c(:, 3)*e(:, 1) + c(:, 5)*e(:, 2) + c(:, 6)*e(:, 3)
         own(:, 4:6) = c(:, 7:9)*e(:, 4:6)
      end associate
      do i = 1, 6
         stress(:, i) = merge(own(:, i), stress(:, i), self%owns)
      end do
   end subroutine update

end module plydyn_law_ply_elastic
