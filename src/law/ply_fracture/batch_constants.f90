!> Constants of the ply with planes of fracture over the lanes of a batch.
module plydyn_law_ply_fracture_batch_constants
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_elastic, only : ply_stiffness
   use plydyn_law_ply_fracture_constants, only : fracture_constants_type, out_of_reach, &
      & shear_hardening, shear_power, snap_ratio
   implicit none
   private

   !> Constants of the lanes
   type, public :: fracture_batch_type
      !> 1 in lanes that the law owns, else 0; whether it owns all
      real(wp) :: own(lanes) = 0.0_wp
      logical :: whole = .false.
      !> C11, C12, C13, C22, C23, C33; G12, G13, G23; 1/E1
      real(wp) :: stiffness(lanes, 6) = spread([1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 1.0_wp], &
         & 1, lanes)
      real(wp) :: shear(lanes, 3) = 1.0_wp, compliance(lanes) = 1.0_wp
      !> 1/C33
      real(wp) :: give(lanes) = 1.0_wp
      !> XT and XC; energies per area; share of XC that crushed fibres keep
      real(wp) :: fibre_strength(lanes, 2) = 1.0_wp, fibre_toughness(lanes, 2) = 1.0_wp
      real(wp) :: plateau(lanes) = 0.0_wp
      !> Square of the stress of onset along the fibres, inverse: of the strength, and of the energy
      !> of a crack band of width 1, in tension and in compression
      real(wp) :: fibre_limit(lanes, 2) = 0.0_wp, fibre_energy_limit(lanes, 2) = 0.0_wp
      !> Exposure of a plane, see `plane_exposure`: slope over the normal traction, inverse shear
      !> strengths across and along the fibres, strength gained per pressure over the strength
      real(wp) :: normal_slope(lanes) = 0.0_wp, across(lanes) = 1.0_wp, along(lanes) = 1.0_wp
      real(wp) :: gain(lanes) = 0.0_wp
      !> Energies per area of opened and of sheared cracks, exponent of Benzeggagh and Kenane
      real(wp) :: toughness(lanes, 2) = 1.0_wp, mode_exponent(lanes) = 1.0_wp
      !> 1 over the least of the two
      real(wp) :: least_give(lanes) = 1.0_wp
      !> Least ratio of tractions at the end and at the onset of softening
      real(wp) :: least_ratio(lanes) = 1.0_wp
      !> Coefficient of friction of closed cracks
      real(wp) :: friction(lanes) = 0.0_wp
      !> Largest damage
      real(wp) :: most_damage(lanes) = 0.0_wp
      !> First yield stresses in 12, 13, 23, and slope of the yield stress over the permanent strain
      real(wp) :: first_yield(lanes, 3) = 1.0_wp, hardening(lanes, 3) = 0.0_wp
      !> Power curve: modulus times coefficient, exponent; whether any lane has one
      real(wp) :: coefficient(lanes, 3) = 0.0_wp, exponent(lanes) = 1.0_wp
      logical :: has_power = .false.
      !> Pressure that crushes through the thickness
      real(wp) :: crush_stress(lanes) = 1.0_wp
      !> Share of the largest opening that debris holds, and most opening strain
      real(wp) :: debris_share(lanes) = 0.0_wp, debris_limit(lanes) = 0.0_wp
      !> Squares of stresses over those of onset, see `intact_path`: fibres, and their energy;
      !> matrix across and along, and its energy; permanent shear 12, 13, 23; crushing
      real(wp) :: far_fibre(lanes, 2) = 0.0_wp, far_matrix(lanes, 3) = 0.0_wp
      real(wp) :: far_yield(lanes, 3) = 0.0_wp, far_crush(lanes) = 0.0_wp
   contains
      procedure :: set_lane
      procedure, private :: set_limits
   end type fracture_batch_type

contains

   !> Give a lane its ply; it is the law's own from then on
   pure subroutine set_lane(self, lane, ply)
      class(fracture_batch_type), intent(inout) :: self
      !> Lane
      integer, intent(in) :: lane
      !> Its ply, checked
      class(fracture_constants_type), intent(in) :: ply

      real(wp) :: c(6, 6), cross

      cross = ply%cross_strength()
      c(:, :) = ply_stiffness(ply%young, ply%poisson, ply%shear)
      self%own(lane) = 1.0_wp
      self%whole = all(self%own > 0.0_wp)
      self%stiffness(lane, :) = [c(1, 1:3), c(2, 2:3), c(3, 3)]
      self%shear(lane, :) = ply%shear
      self%compliance(lane) = 1.0_wp/ply%young(1)
      self%give(lane) = 1.0_wp/c(3, 3)
      self%fibre_strength(lane, :) = ply%fibre_strength
      self%fibre_toughness(lane, :) = ply%fibre_toughness
      self%plateau(lane) = ply%plateau
      self%fibre_limit(lane, :) = 1.0_wp/ply%fibre_strength**2
      self%fibre_energy_limit(lane, :) = 0.5_wp*snap_ratio/(ply%young(1)*ply%fibre_toughness)
      associate (tension => ply%matrix_strength(1))
         self%normal_slope(lane) = (cross**2 - tension**2)/(2.0_wp*cross**2*tension)
      end associate
      self%across(lane) = 1.0_wp/cross
      self%along(lane) = 1.0_wp/ply%shear_strength
      self%gain(lane) = ply%pressure_gain()
      self%toughness(lane, :) = ply%matrix_toughness
      self%least_give(lane) = 1.0_wp/minval(ply%matrix_toughness)
      self%mode_exponent(lane) = ply%mode_exponent
      self%least_ratio(lane) = ply%softening_ratio()
      self%friction(lane) = ply%friction
      self%most_damage(lane) = 1.0_wp - ply%residual
      self%first_yield(lane, :) = ply%first_yields()
      if (ply%shear_curve == shear_hardening) self%hardening(lane, :) = ply%hardening*ply%shear
      if (ply%shear_curve == shear_power) then
         self%has_power = .true.
         self%exponent(lane) = ply%exponent
         self%coefficient(lane, :) = ply%shear*ply%coefficient*[1.0_wp, 1.0_wp, &
            & (ply%shear_strength/cross)**ply%exponent]
      end if
      self%crush_stress(lane) = merge(ply%crush_stress, out_of_reach, &
         & ply%crush_stress > 0.0_wp)
      self%debris_share(lane) = ply%debris_share
      self%debris_limit(lane) = ply%debris_limit
      call self%set_limits(lane, ply, c)
   end subroutine set_lane

   !> Squares of stresses over those of onset
   pure subroutine set_limits(self, lane, ply, c)
      class(fracture_batch_type), intent(inout) :: self
      !> Lane
      integer, intent(in) :: lane
      !> Its ply
      class(fracture_constants_type), intent(in) :: ply
      !> Stiffness
      real(wp), intent(in) :: c(6, 6)

      real(wp) :: least

      self%far_fibre(lane, :) = [maxval(self%fibre_limit(lane, :)), &
         & maxval(self%fibre_energy_limit(lane, :))]
      associate (k => self%normal_slope(lane), a => self%across(lane))
         self%far_matrix(lane, 1) = (max(k, 0.0_wp) + sqrt(a**2 + k**2))**2
      end associate
      ! the least stiffness of any plane is no less than that of the plane 2-3 alone
      least = min(0.5_wp*(c(2, 2) + c(3, 3)) - hypot(0.5_wp*(c(2, 2) - c(3, 3)), c(2, 3)), &
         & 2.0_wp*ply%shear(3))*0.5_wp
      least = min(least, ply%shear(1), ply%shear(2))
      self%far_matrix(lane, 2:) = [self%along(lane)**2, &
         & 0.5_wp*self%least_ratio(lane)/(least*minval(ply%matrix_toughness))]
      self%far_yield(lane, :) = (1.0_wp/self%first_yield(lane, :))**2
      self%far_crush(lane) = 1.0_wp/self%crush_stress(lane)
   end subroutine set_limits

end module plydyn_law_ply_fracture_batch_constants
