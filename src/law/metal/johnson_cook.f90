!> Plasticity with Johnson and Cook's yield stress, without temperature:
!> (A + B strain^n) (1 + C ln(rate/reference)), *MAT_SIMPLIFIED_JOHNSON_COOK.
!> Below the reference rate the rate does not matter.
module plydyn_law_metal_johnson_cook
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : law_type
   use plydyn_law_metal_constants, only : metal_constants_type
   use plydyn_law_metal_plastic, only : plastic_type
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
      procedure :: set_lane => set_lane_of_batch
   end type johnson_cook_constants_type

   !> Constants of the lanes
   type, public, extends(plastic_type) :: plastic_johnson_cook_type
      !> A: yield stress without plastic strain
      real(wp) :: yield(lanes) = 1.0_wp
      !> B: rise of the yield stress up to a plastic strain of one
      real(wp) :: factor(lanes) = 0.0_wp
      !> n: power of plastic strain
      real(wp) :: power(lanes) = 1.0_wp
      !> C: rise by the logarithm of the rate
      real(wp) :: sensitivity(lanes) = 0.0_wp
      !> Rate from which on it rises
      real(wp) :: reference(lanes) = 1.0_wp
   contains
      procedure :: set_lane
      procedure :: set_rate
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
   pure subroutine set_lane_of_batch(self, lane, law)
      class(johnson_cook_constants_type), intent(in) :: self
      integer, intent(in) :: lane
      class(law_type), intent(inout) :: law

      select type (law)
      type is (plastic_johnson_cook_type)
         call law%set_lane(lane, self%young(1), self%poisson(1), self%yield, self%factor, &
            & self%exponent)
         call law%set_rate(lane, self%sensitivity, self%reference_rate)
      end select
   end subroutine set_lane_of_batch

   !> Give a lane to this law
   pure subroutine set_lane(self, lane, young, poisson, yield, factor, power)
      class(plastic_johnson_cook_type), intent(inout) :: self
      !> Place in the batch; Young's modulus and Poisson's ratio
      integer, intent(in) :: lane
      real(wp), intent(in) :: young, poisson
      !> A, positive
      real(wp), intent(in) :: yield
      !> B, not negative
      real(wp), intent(in) :: factor
      !> n, positive
      real(wp), intent(in) :: power

      call self%own_lane(lane, young, poisson, onset=yield)
      self%yield(lane) = yield
      self%factor(lane) = factor
      self%power(lane) = power
   end subroutine set_lane

   !> Let the yield stress of a lane rise with the rate
   pure subroutine set_rate(self, lane, sensitivity, reference)
      class(plastic_johnson_cook_type), intent(inout) :: self
      !> Place in the batch
      integer, intent(in) :: lane
      !> C, not negative
      real(wp), intent(in) :: sensitivity
      !> Rate from which on the yield stress rises, positive
      real(wp), intent(in) :: reference

      self%sensitivity(lane) = sensitivity
      self%reference(lane) = reference
   end subroutine set_rate

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
