!> Stiffness of a damaged ply: an orthotropic compliance whose moduli E1 and E2 are reduced to the
!> parts R1 and R2 that remain, and whose Poisson terms are not reduced.
module plydyn_law_secant
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_elastic, only : ply_stiffness
   implicit none
   private

   !> Elastic constants of the lanes, and products of them
   type, public :: secant_type
      !> E1, E2, E3 and G12, G13, G23
      real(wp) :: young(lanes, 3) = 1.0_wp, shear(lanes, 3) = 1.0_wp
      !> 1/E1, 1/E2 without damage
      real(wp) :: compliance(lanes, 2) = 1.0_wp
      !> C11, C12, C13, C22, C23, C33 without damage
      real(wp) :: intact(lanes, 6) = 0.0_wp
      !> nu12*nu21, nu13*nu31, nu23*nu32
      real(wp) :: pair(lanes, 3) = 0.0_wp
      !> nu31, nu32, and what the other part adds to them: nu21*nu32, nu12*nu31
      real(wp) :: across(lanes, 4) = 0.0_wp
      !> nu21 + nu31*nu23, and 2*nu21*nu32*nu13
      real(wp) :: plane(lanes) = 0.0_wp, triple(lanes) = 0.0_wp
   contains
      procedure :: set_lane
      procedure :: intact_stress
      procedure :: damaged_stress
   end type secant_type

contains

   !> Give a lane its constants
   pure subroutine set_lane(self, lane, young, poisson, shear)
      class(secant_type), intent(inout) :: self
      !> Lane
      integer, intent(in) :: lane
      !> E1, E2, E3
      real(wp), intent(in) :: young(3)
      !> nu12, nu13, nu23: strain in the second direction from stress along the first
      real(wp), intent(in) :: poisson(3)
      !> G12, G13, G23
      real(wp), intent(in) :: shear(3)

      real(wp) :: c(6, 6), nu21, nu31, nu32

      nu21 = poisson(1)*young(2)/young(1)
      nu31 = poisson(2)*young(3)/young(1)
      nu32 = poisson(3)*young(3)/young(2)
      c(:, :) = ply_stiffness(young, poisson, shear)
      self%young(lane, :) = young
      self%shear(lane, :) = shear
      self%compliance(lane, :) = 1.0_wp/young(1:2)
      self%intact(lane, :) = [c(1, 1), c(1, 2), c(1, 3), c(2, 2), c(2, 3), c(3, 3)]
      self%pair(lane, :) = poisson*[nu21, nu31, nu32]
      self%across(lane, :) = [nu31, nu32, nu21*nu32, poisson(1)*nu31]
      self%plane(lane) = nu21 + nu31*poisson(3)
      self%triple(lane) = 2.0_wp*nu21*nu32*poisson(2)
   end subroutine set_lane

   !> Normal stresses of a point without damage
   pure subroutine intact_stress(self, strain, stress)
      class(secant_type), intent(in) :: self
      !> Strains 11, 22, 33
      real(wp), intent(in) :: strain(lanes, 3)
      !> Stresses 11, 22, 33
      real(wp), intent(out) :: stress(lanes, 3)

      integer :: l

      associate (c => self%intact, e => strain)
         !$omp simd
         do l = 1, lanes
            stress(l, 1) = c(l, 1)*e(l, 1) + c(l, 2)*e(l, 2) + c(l, 3)*e(l, 3)
            stress(l, 2) = c(l, 2)*e(l, 1) + c(l, 4)*e(l, 2) + c(l, 5)*e(l, 3)
            stress(l, 3) = c(l, 3)*e(l, 1) + c(l, 5)*e(l, 2) + c(l, 6)*e(l, 3)
         end do
      end associate
   end subroutine intact_stress

   !> Normal stresses of a point with damage, on the material that remains: multiply the first by R1
   !> and the second by R2 to have the stresses of the ply
   pure subroutine damaged_stress(self, strain, remains, stress)
      class(secant_type), intent(in) :: self
      !> Strains 11, 22, 33
      real(wp), intent(in) :: strain(lanes, 3)
      !> R1 and R2
      real(wp), intent(in) :: remains(lanes, 2)
      !> Stress 11 over R1, stress 22 over R2, stress 33
      real(wp), intent(out) :: stress(lanes, 3)

      real(wp) :: nu31, nu32, part, r1, r2, r12
      integer :: l

      associate (young => self%young, pair => self%pair, across => self%across, &
         & plane => self%plane, triple => self%triple, e => strain)
         !$omp simd private(nu31, nu32, part, r1, r2, r12)
         do l = 1, lanes
            r1 = remains(l, 1)
            r2 = remains(l, 2)
            r12 = r1*r2
            part = 1.0_wp/(1.0_wp - r2*pair(l, 3) - r1*pair(l, 2) &
               & - r12*(pair(l, 1) + triple(l)))
            nu31 = across(l, 1) + r2*across(l, 3)
            nu32 = across(l, 2) + r1*across(l, 4)
            stress(l, 1) = young(l, 1)*part*((1.0_wp - r2*pair(l, 3))*e(l, 1) &
               & + r2*plane(l)*e(l, 2) + nu31*e(l, 3))
            stress(l, 2) = part*(r1*young(l, 1)*plane(l)*e(l, 1) &
               & + young(l, 2)*((1.0_wp - r1*pair(l, 2))*e(l, 2) + nu32*e(l, 3)))
            stress(l, 3) = part*(r1*young(l, 1)*nu31*e(l, 1) + r2*young(l, 2)*nu32*e(l, 2) &
               & + young(l, 3)*(1.0_wp - r12*pair(l, 1))*e(l, 3))
         end do
      end associate
   end subroutine damaged_stress

end module plydyn_law_secant
