!> Plasticity with linear hardening, isotropic, kinematic or mixed: *MAT_PLASTIC_KINEMATIC.
!> Without hardening it is perfect plasticity.
module plydyn_law_metal_kinematic
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : law_type
   use plydyn_law_metal_cowper_symonds, only : cowper_symonds_type
   use plydyn_law_metal_plastic, only : metal_constants_type, plastic_type
   implicit none
   private

   !> Constants of a metal with linear hardening, besides the elastic ones
   type, public, extends(metal_constants_type) :: kinematic_constants_type
      !> Yield stress without plastic strain, and slope of stress over total strain beyond it
      real(wp) :: yield = 0.0_wp, tangent = 0.0_wp
      !> Share of hardening that is isotropic: 1 isotropic, 0 kinematic
      real(wp) :: isotropic = 0.0_wp
      !> Rate at which the yield stress is doubled, 0 for none, and the power of its rise
      !> (Cowper and Symonds)
      real(wp) :: rate = 0.0_wp, power = 0.0_wp
   contains
      procedure :: new_batch
      procedure :: set_lane
   end type kinematic_constants_type

   !> Constants of the lanes
   type, public, extends(plastic_type) :: plastic_kinematic_type
      !> Yield stress without plastic strain; rise of the yield stress over effective plastic strain
      real(wp) :: yield(lanes) = 1.0_wp, isotropic(lanes) = 0.0_wp
      !> Rise with the rate
      type(cowper_symonds_type) :: rate
   contains
      procedure :: flow
      procedure :: yield_stress
   end type plastic_kinematic_type

contains

   !> A law without lanes
   subroutine new_batch(self, law)
      class(kinematic_constants_type), intent(in) :: self
      class(law_type), allocatable, intent(out) :: law

      allocate (plastic_kinematic_type :: law)
   end subroutine new_batch

   !> Give a lane of a batch its metal
   pure subroutine set_lane(self, lane, law)
      class(kinematic_constants_type), intent(in) :: self
      integer, intent(in) :: lane
      class(law_type), intent(inout) :: law

      real(wp) :: modulus

      associate (young => self%young(1))
         modulus = young*self%tangent/(young - self%tangent)
      end associate
      select type (law)
      type is (plastic_kinematic_type)
         call law%own_lane(lane, self, onset=self%yield)
         law%yield(lane) = self%yield
         law%isotropic(lane) = self%isotropic*modulus
         law%kinematic(lane) = (1.0_wp - self%isotropic)*modulus
         if (self%rate > 0.0_wp) call law%rate%set_lane(lane, self%rate, self%power)
      end select
   end subroutine set_lane

   !> Increment of effective plastic strain: in closed form where rates do not matter
   pure subroutine flow(self, step, effective, before, increment, resistance)
      class(plastic_kinematic_type), intent(in) :: self
      real(wp), intent(in) :: step, effective(lanes), before(lanes)
      real(wp), intent(out) :: increment(lanes), resistance(lanes)

      real(wp) :: slope, yield
      integer :: l

      if (self%rate%acts) then
         call self%search(step, effective, before, increment, resistance)
         return
      end if
      do l = 1, lanes
         yield = self%yield(l) + self%isotropic(l)*before(l)
         slope = 3.0_wp*self%shear(l) + self%kinematic(l) + self%isotropic(l)
         increment(l) = merge(max(effective(l) - yield, 0.0_wp)/slope, 0.0_wp, self%owns(l))
         resistance(l) = yield + 0.5_wp*self%isotropic(l)*increment(l)
      end do
   end subroutine flow

   !> Yield stress and its slopes
   pure subroutine yield_stress(self, strain, rate, yield, hardening, viscosity)
      class(plastic_kinematic_type), intent(in) :: self
      real(wp), intent(in) :: strain(lanes), rate(lanes)
      real(wp), intent(out) :: yield(lanes), hardening(lanes), viscosity(lanes)

      yield(:) = self%yield + self%isotropic*strain
      hardening(:) = self%isotropic
      viscosity(:) = 0.0_wp
      call self%rate%raise(rate, yield, hardening, viscosity)
   end subroutine yield_stress

end module plydyn_law_metal_kinematic
