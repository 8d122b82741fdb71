!> Lengths of the process zone of an interface, and constants that a mesh can resolve.
module plydyn_law_cohesive_process_zone_length
   use plydyn_base_precision, only : wp
   use plydyn_law_cohesive_softening, only : normal, shear
   implicit none
   private

   public :: fitting_strength, slender_zone, strength_factor, stiffness_ratio, zone_length, &
      & zone_lengths

   real(wp), parameter :: pi = acos(-1.0_wp)

   !> Share of E G_c/strength**2 that a zone has in a large body (Rice; Falk et al.)
   real(wp), parameter :: zone_of_rice = 9.0_wp*pi/32.0_wp

   !> Points that a zone must span
   integer, parameter, public :: least_points = 3

   !> Stiffness that an interface needs, in moduli over the thickness of what it joins, for its own
   !> compliance not to matter
   real(wp), parameter, public :: least_stiffness_ratio = 50.0_wp

contains

   !> Length of the zone in a body that is large beside it
   elemental real(wp) function zone_length(young, toughness, strength)
      !> Modulus across the interface; energy per crack area and strength of the mode
      real(wp), intent(in) :: young, toughness, strength

      zone_length = zone_of_rice*young*toughness/strength**2
   end function zone_length

   !> Lengths of the zones of opening and of sliding between thin layers (Yang and Cox)
   pure function slender_zone(young, thickness, toughness, strength) result(length)
      !> Modulus along the layers; thickness of the thinner one
      real(wp), intent(in) :: young, thickness
      !> Energies per crack area and strengths, normal and shear
      real(wp), intent(in) :: toughness(2), strength(2)
      real(wp) :: length(2)

      length(normal) = (young*toughness(normal)*thickness**3/strength(normal)**2)**0.25_wp
      length(shear) = sqrt(young*toughness(shear)*thickness)/strength(shear)
   end function slender_zone

   !> Lengths of the zones of opening and of sliding: the smaller of a large body's and of thin
   !> layers'
   pure function zone_lengths(across, along, thickness, toughness, strength) result(length)
      !> Modulus across the interface, and along the layers
      real(wp), intent(in) :: across, along
      !> Thickness of the thinner layer; energies per crack area and strengths, normal and shear
      real(wp), intent(in) :: thickness, toughness(2), strength(2)
      real(wp) :: length(2)

      length(:) = min(zone_length(across, toughness, strength), &
         & slender_zone(along, thickness, toughness, strength))
   end function zone_lengths

   !> Strength whose zone in a large body spans `least_points` (Turon et al. 2007)
   elemental real(wp) function fitting_strength(young, toughness, spacing) result(strength)
      !> Modulus across the interface; energy per crack area of the mode; length between points
      real(wp), intent(in) :: young, toughness, spacing

      strength = sqrt(zone_of_rice*young*toughness/(real(least_points, wp)*spacing))
   end function fitting_strength

   !> Factor by which both strengths must fall for the zones of both modes to span `least_points`;
   !> one factor for both keeps the mix of modes. 1 where they do already
   pure real(wp) function strength_factor(young, toughness, strength, spacing) result(factor)
      !> Modulus across the interface; energies per crack area and strengths, normal and shear;
      !> length between points
      real(wp), intent(in) :: young, toughness(2), strength(2), spacing

      factor = min(1.0_wp, minval(fitting_strength(young, toughness, spacing)/strength))
   end function strength_factor

   !> Stiffness of an interface in moduli over thickness; see `least_stiffness_ratio`
   elemental real(wp) function stiffness_ratio(stiffness, young, thickness) result(ratio)
      !> Normal stiffness; modulus across the interface; thickness of the thinner layer
      real(wp), intent(in) :: stiffness, young, thickness

      ratio = stiffness*thickness/young
   end function stiffness_ratio

end module plydyn_law_cohesive_process_zone_length
