!> Plasticity with linear hardening, isotropic, kinematic or mixed: *MAT_PLASTIC_KINEMATIC.
!> Without hardening it is perfect plasticity.
module plydyn_law_metal_kinematic
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : law_type
   use plydyn_law_metal_cowper_symonds, only : cowper_symonds_type
   use plydyn_law_metal_constants, only : metal_constants_type
   use plydyn_law_metal_plastic, only : plastic_type
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
      procedure :: set_lane => set_lane_of_batch
   end type kinematic_constants_type

   !> Constants of the lanes
   type, public, extends(plastic_type) :: plastic_kinematic_type
      !> Yield stress without plastic strain
      real(wp) :: yield(lanes) = 1.0_wp
      !> Rise of the yield stress over effective plastic strain
      real(wp) :: isotropic(lanes) = 0.0_wp
      !> Rise with the rate
      type(cowper_symonds_type) :: rate
   contains
      procedure :: set_lane
      procedure :: set_rate
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
   pure subroutine set_lane_of_batch(self, lane, law)
      class(kinematic_constants_type), intent(in) :: self
      integer, intent(in) :: lane
      class(law_type), intent(inout) :: law

      select type (law)
      type is (plastic_kinematic_type)
         call law%set_lane(lane, self%young(1), self%poisson(1), self%yield, self%tangent, &
            & self%isotropic)
         if (self%rate > 0.0_wp) call law%set_rate(lane, self%rate, self%power)
      end select
   end subroutine set_lane_of_batch

   !> Give a lane to this law
   pure subroutine set_lane(self, lane, young, poisson, yield, tangent, beta)
      class(plastic_kinematic_type), intent(inout) :: self
      !> Place in the batch; Young's modulus and Poisson's ratio
      integer, intent(in) :: lane
      real(wp), intent(in) :: young, poisson
      !> Yield stress, positive
      real(wp), intent(in) :: yield
      !> Slope of stress over total strain beyond yield in tension, below Young's modulus
      real(wp), intent(in) :: tangent
      !> Share of hardening that is isotropic: 1 isotropic, 0 kinematic
      real(wp), intent(in) :: beta

      real(wp) :: modulus

      call self%own_lane(lane, young, poisson, onset=yield)
      modulus = young*tangent/(young - tangent)
      self%yield(lane) = yield
      self%isotropic(lane) = beta*modulus
      self%kinematic(lane) = (1.0_wp - beta)*modulus
   end subroutine set_lane

   !> Let the whole yield stress of a lane rise with the rate
   pure subroutine set_rate(self, lane, reference, power)
      class(plastic_kinematic_type), intent(inout) :: self
      !> Place in the batch
      integer, intent(in) :: lane
      !> Rate at which the yield stress is twice the static one (SRC), positive
      real(wp), intent(in) :: reference
      !> Power of the rise (SRP), positive
      real(wp), intent(in) :: power

      call self%rate%set_lane(lane, reference, power)
   end subroutine set_rate

   !> Increment of effective plastic strain: in closed form where rates do not matter
   pure subroutine flow(self, step, effective, before, increment, resistance)
      class(plastic_kinematic_type), intent(in) :: self
      real(wp), intent(in) :: step
      real(wp), intent(in) :: effective(lanes)
      real(wp), intent(in) :: before(lanes)
      real(wp), intent(out) :: increment(lanes)
      real(wp), intent(out) :: resistance(lanes)

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
