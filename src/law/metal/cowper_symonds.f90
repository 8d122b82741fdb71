!> Yield stress that rises with the rate of plastic strain, after Cowper and Symonds.
!>
!> The rise is (rate/reference)^(1/power), either of the whole static yield stress or of a stress
!> given once. The rate is that of effective plastic strain (LS-DYNA's VP = 1).
module plydyn_law_metal_cowper_symonds
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   !> Least rate: keeps slopes finite
   real(wp), parameter :: least_rate = 1.0e-290_wp

   !> Constants of a batch; lanes that are not set do not feel the rate
   type, public :: cowper_symonds_type
      !> Whether any lane feels the rate
      logical :: acts = .false.
      !> Rate at which the rise is one (LS-DYNA's C or SRC); one over the power (LS-DYNA's P or SRP)
      real(wp) :: reference(lanes) = 1.0_wp, exponent(lanes) = 1.0_wp
      !> Share of the static yield stress that rises: 1 or 0; stress that rises besides
      real(wp) :: share(lanes) = 0.0_wp, basis(lanes) = 0.0_wp
   contains
      procedure :: set_lane
      procedure :: raise
   end type cowper_symonds_type

contains

   !> Set the constants of a lane
   pure subroutine set_lane(self, lane, reference, power, basis)
      class(cowper_symonds_type), intent(inout) :: self
      !> Place in the batch
      integer, intent(in) :: lane
      !> Rate at which the rise is one, positive; power of the stress, positive
      real(wp), intent(in) :: reference, power
      !> Stress that rises; without it the whole static yield stress does
      real(wp), intent(in), optional :: basis

      self%acts = .true.
      self%reference(lane) = reference
      self%exponent(lane) = 1.0_wp/power
      self%share(lane) = 1.0_wp
      self%basis(lane) = 0.0_wp
      if (present(basis)) then
         self%share(lane) = 0.0_wp
         self%basis(lane) = basis
      end if
   end subroutine set_lane

   !> Raise a yield stress to that of the rate
   pure subroutine raise(self, rate, yield, hardening, viscosity)
      class(cowper_symonds_type), intent(in) :: self
      !> Rate of effective plastic strain
      real(wp), intent(in) :: rate(lanes)
      !> Yield stress, and its derivative by effective plastic strain
      real(wp), intent(inout) :: yield(lanes), hardening(lanes)
      !> Derivative of the yield stress by the rate
      real(wp), intent(inout) :: viscosity(lanes)

      real(wp) :: rising, rise
      integer :: l

      do l = 1, lanes
         rising = self%share(l)*yield(l) + self%basis(l)
         rise = (max(rate(l), least_rate)/self%reference(l))**self%exponent(l)
         yield(l) = yield(l) + rising*rise
         hardening(l) = hardening(l)*(1.0_wp + self%share(l)*rise)
         viscosity(l) = viscosity(l)*(1.0_wp + self%share(l)*rise) &
            & + rising*rise*self%exponent(l)/max(rate(l), least_rate)
      end do
   end subroutine raise

end module plydyn_law_metal_cowper_symonds
