!> Secant stiffness of a damaged ply. Damage multiplies the moduli E1 and E2 of the orthotropic
!> compliance by the integrities R1 and R2, and leaves its Poisson terms. It multiplies G12 by both,
!> and G13 and G23, unless it leaves them, by one each.
module plydyn_law_ply_secant
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_elastic, only : ply_stiffness
   implicit none
   private

   !> Elastic constants of the lanes. The stiffness of normal stress is, times
   !> D = 1 - R1*pair1 - R2*pair2 - R1*R2*pair3:
   !> R1*(c11(1) - R2*c11(2)), R2*(c22(1) - R1*c22(2)), c33(1) - R1*R2*c33(2) on the diagonal and
   !> R1*R2*c12, R1*(c13(1) + R2*c13(2)), R2*(c23(1) + R1*c23(2)) beside it
   type, public :: secant_type
      !> G12, G13, G23
      real(wp) :: shear(lanes, 3) = 1.0_wp
      !> G13 and G23: the parts that damage does not reduce and that it reduces
      real(wp) :: g_intact(lanes, 2) = 0.0_wp, g_degraded(lanes, 2) = 0.0_wp
      !> 1/E1, 1/E2 without damage
      real(wp) :: compliance(lanes, 2) = 1.0_wp
      !> C11, C12, C13, C22, C23, C33 without damage
      real(wp) :: intact(lanes, 6) = 0.0_wp
      !> nu13*nu31, nu23*nu32, nu12*nu21 + 2*nu21*nu32*nu13
      real(wp), dimension(lanes, 3), private :: pair = 0.0_wp
      !> As said above
      real(wp), dimension(lanes, 2), private :: c11 = 0.0_wp, c22 = 0.0_wp, c33 = 0.0_wp
      real(wp), dimension(lanes, 2), private :: c13 = 0.0_wp, c23 = 0.0_wp
      real(wp), dimension(lanes), private :: c12 = 0.0_wp
   contains
      procedure :: set_lane
      procedure :: keep_across
      procedure :: intact_stress
      procedure :: damaged_stress
      procedure :: degrade_stress
   end type secant_type

contains

   !> Give a lane its constants
   pure subroutine set_lane(self, lane, young, poisson, shear)
      class(secant_type), intent(inout) :: self
      integer, intent(in) :: lane
      !> As in `ply_stiffness`
      real(wp), intent(in) :: young(3), poisson(3), shear(3)

      real(wp) :: c(6, 6), nu21, nu31, nu32

      nu21 = poisson(1)*young(2)/young(1)
      nu31 = poisson(2)*young(3)/young(1)
      nu32 = poisson(3)*young(3)/young(2)
      c(:, :) = ply_stiffness(young, poisson, shear)
      self%shear(lane, :) = shear
      self%g_intact(lane, :) = 0.0_wp
      self%g_degraded(lane, :) = shear(2:3)
      self%compliance(lane, :) = 1.0_wp/young(1:2)
      self%intact(lane, :) = [c(1, 1), c(1, 2), c(1, 3), c(2, 2), c(2, 3), c(3, 3)]
      associate (nu12 => poisson(1), nu13 => poisson(2), nu23 => poisson(3))
         self%pair(lane, :) = [nu13*nu31, nu23*nu32, nu12*nu21 + 2.0_wp*nu21*nu32*nu13]
         self%c11(lane, :) = young(1)*[1.0_wp, nu23*nu32]
         self%c22(lane, :) = young(2)*[1.0_wp, nu13*nu31]
         self%c33(lane, :) = young(3)*[1.0_wp, nu12*nu21]
         self%c12(lane) = young(1)*(nu21 + nu31*nu23)
         self%c13(lane, :) = young(1)*[nu31, nu21*nu32]
         self%c23(lane, :) = young(2)*[nu32, nu12*nu31]
      end associate
   end subroutine set_lane

   !> Let damage leave G13 and G23 of a lane that has its constants
   pure subroutine keep_across(self, lane)
      class(secant_type), intent(inout) :: self
      integer, intent(in) :: lane

      self%g_intact(lane, :) = self%shear(lane, 2:3)
      self%g_degraded(lane, :) = 0.0_wp
   end subroutine keep_across

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

   !> Effective normal stresses of a damaged point: the stresses of the ply are the first times R1,
   !> the second times R2, and the third
   pure subroutine damaged_stress(self, strain, integrity, stress)
      class(secant_type), intent(in) :: self
      !> Strains 11, 22, 33; R1 and R2
      real(wp), intent(in) :: strain(lanes, 3), integrity(lanes, 2)
      !> Stress 11 over R1, stress 22 over R2, stress 33
      real(wp), intent(out) :: stress(lanes, 3)

      real(wp) :: k13, k23, part, r1, r2, r12
      integer :: l

      associate (pair => self%pair, c11 => self%c11, c22 => self%c22, c33 => self%c33, &
         & c12 => self%c12, c13 => self%c13, c23 => self%c23, e => strain)
         !$omp simd private(k13, k23, part, r1, r2, r12)
         do l = 1, lanes
            r1 = integrity(l, 1)
            r2 = integrity(l, 2)
            r12 = r1*r2
            part = 1.0_wp/(1.0_wp - r1*pair(l, 1) - r2*pair(l, 2) - r12*pair(l, 3))
            k13 = c13(l, 1) + r2*c13(l, 2)
            k23 = c23(l, 1) + r1*c23(l, 2)
            stress(l, 1) = part*((c11(l, 1) - r2*c11(l, 2))*e(l, 1) + r2*c12(l)*e(l, 2) &
               & + k13*e(l, 3))
            stress(l, 2) = part*(r1*c12(l)*e(l, 1) + (c22(l, 1) - r1*c22(l, 2))*e(l, 2) &
               & + k23*e(l, 3))
            stress(l, 3) = part*(r1*k13*e(l, 1) + r2*k23*e(l, 2) &
               & + (c33(l, 1) - r12*c33(l, 2))*e(l, 3))
         end do
      end associate
   end subroutine damaged_stress

   !> Stress of a ply, from its effective normal stresses
   pure subroutine degrade_stress(self, e, shear, normal, sheared, s)
      class(secant_type), intent(in) :: self
      !> Strain, size of the shear stress 12 before damage
      real(wp), intent(in) :: e(lanes, 6), shear(lanes)
      !> R1 and R2 for normal stress, and for shear
      real(wp), intent(in) :: normal(lanes, 2), sheared(lanes, 2)
      !> Effective normal stresses in, stress out
      real(wp), intent(inout) :: s(lanes, 6)

      real(wp) :: r1, r2
      integer :: l

      associate (intact => self%g_intact, degraded => self%g_degraded)
         !$omp simd private(r1, r2)
         do l = 1, lanes
            r1 = sheared(l, 1)
            r2 = sheared(l, 2)
            s(l, 1) = normal(l, 1)*s(l, 1)
            s(l, 2) = normal(l, 2)*s(l, 2)
            s(l, 4) = r1*r2*sign(shear(l), e(l, 4))
            s(l, 5) = (intact(l, 1) + r1*degraded(l, 1))*e(l, 5)
            s(l, 6) = (intact(l, 2) + r2*degraded(l, 2))*e(l, 6)
         end do
      end associate
   end subroutine degrade_stress

end module plydyn_law_ply_secant
