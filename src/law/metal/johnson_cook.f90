!> Plasticity with Johnson and Cook's yield stress, without temperature:
!> (A + B strain^n) (1 + C ln(rate/reference)), *MAT_SIMPLIFIED_JOHNSON_COOK.
!> Below the reference rate the rate does not matter.
module plydyn_law_metal_johnson_cook
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : law_type
   use plydyn_law_metal_plastic, only : metal_constants_type, plastic_type
   implicit none
   private

   !> Least plastic strain: keeps slopes finite
   real(wp), parameter :: least_strain = 1.0e-290_wp

   !> Constants of a metal after Johnson and Cook, besides the elastic ones
   type, public, extends(metal_constants_type) :: johnson_cook_constants_type
      !> A: yield stress without plastic strain
      real(wp) :: yield = 0.0_wp
      !> B: its rise up to a plastic strain of 1; n: power of plastic strain
      real(wp) :: factor = 0.0_wp, exponent = 1.0_wp
      !> C: its rise with the logarithm of the rate; rate from which on it rises
      real(wp) :: sensitivity = 0.0_wp, reference_rate = 1.0_wp
   contains
      procedure :: new_batch
      procedure :: set_lane
   end type johnson_cook_constants_type

   !> Constants of the lanes: A, B, n, C and the rate from which on the stress rises
   type, public, extends(plastic_type) :: plastic_johnson_cook_type
      real(wp) :: yield(lanes) = 1.0_wp, factor(lanes) = 0.0_wp, power(lanes) = 1.0_wp
      real(wp) :: sensitivity(lanes) = 0.0_wp, reference(lanes) = 1.0_wp
   contains
      procedure :: yield_stress
   end type plastic_johnson_cook_type

contains

   !> A law without lanes
   subroutine new_batch(self, law)
      class(johnson_cook_constants_type), intent(in) :: self
      class(law_type), allocatable, intent(out) :: law

      allocate (plastic_johnson_cook_type :: law)
   end subroutine new_batch

   !> Give a lane of a batch its metal
   pure subroutine set_lane(self, lane, law)
      class(johnson_cook_constants_type), intent(in) :: self
      integer, intent(in) :: lane
      class(law_type), intent(inout) :: law

      select type (law)
      type is (plastic_johnson_cook_type)
         call law%own_lane(lane, self, onset=self%yield)
         law%yield(lane) = self%yield
         law%factor(lane) = self%factor
         law%power(lane) = self%exponent
         law%sensitivity(lane) = self%sensitivity
         law%reference(lane) = self%reference_rate
      end select
   end subroutine set_lane

   !> Yield stress and its slopes
   pure subroutine yield_stress(self, strain, rate, yield, hardening, viscosity)
      class(plastic_johnson_cook_type), intent(in) :: self
      real(wp), intent(in) :: strain(lanes), rate(lanes)
      real(wp), intent(out) :: yield(lanes), hardening(lanes), viscosity(lanes)

      real(wp) :: fast, power, rise, static
      integer :: l

      do l = 1, lanes
         power = self%factor(l)*max(strain(l), least_strain)**self%power(l)
         static = self%yield(l) + power
         fast = max(rate(l), self%reference(l))
         rise = 1.0_wp + self%sensitivity(l)*log(fast/self%reference(l))
         yield(l) = static*rise
         hardening(l) = power*self%power(l)*rise/max(strain(l), least_strain)
         viscosity(l) = merge(static*self%sensitivity(l)/fast, 0.0_wp, rate(l) > self%reference(l))
      end do
   end subroutine yield_stress

end module plydyn_law_metal_johnson_cook
