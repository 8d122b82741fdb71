!> Constants of an interface that softens, as a deck gives them.
module plydyn_law_cohesive_constants
   use plydyn_base_precision, only : wp
   use plydyn_law_cohesive_toughness, only : benzeggagh_kenane
   implicit none
   private

   !> Constants of an interface as an engineer gives them; pairs are normal, shear
   type, public :: cohesive_constants_type
      !> Traction per opening and per sliding
      real(wp) :: stiffness(2) = 0.0_wp
      !> Tractions N and S at the onset of damage
      real(wp) :: strength(2) = 0.0_wp
      !> Energies G_Ic and G_IIc per crack area
      real(wp) :: toughness(2) = 0.0_wp
      !> Toughness of mixed modes, a law of `toughness.f90`, and its exponent
      integer :: criterion = benzeggagh_kenane
      real(wp) :: exponent = 1.0_wp
      !> Replace the shear stiffness by K_n (G_Ic/G_IIc) (S/N)**2, for which the energy lost depends
      !> on the damage alone and not on the mode (Turon et al. 2010)
      logical :: consistent = .false.
      !> Let the penalty of closed faces fall with the damage to `penalty_floor`, for explicit steps
      !> near the critical one; otherwise it is constant
      logical :: falling_penalty = .false.
      !> Coefficient of friction between failed faces
      real(wp) :: friction = 0.0_wp
      !> Let damage grow by the work of both modes, not by the mode of the present opening
      logical :: by_work = .false.
      !> Growth of the shear strength with the pressure on the faces
      real(wp) :: pressure_gain = 0.0_wp
   end type cohesive_constants_type

end module plydyn_law_cohesive_constants
