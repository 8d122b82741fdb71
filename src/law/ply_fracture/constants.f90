!> Constants of a ply whose matrix cracks on planes of fracture, and of the lanes of a batch.
module plydyn_law_ply_fracture_constants
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : law_constants_type, law_type, scalars
   use plydyn_law_ply_batch_shear, only : batch_shear_type
   use plydyn_law_ply_constants, only : damaged_ply_type
   use plydyn_law_ply_crack_band, only : longest_length, modes
   use plydyn_law_ply_elastic, only : ply_stiffness
   use plydyn_law_ply_fibre_lines, only : fibre_lines_type, first_reach
   use plydyn_law_ply_shear_curve, only : first_yield, scaled_curve
   implicit none
   private

   !> Least ratio of the strains at the end and at the onset of softening in uniaxial stress
   real(wp), parameter, public :: snap_ratio = 1.05_wp
   !> Permanent shear strain that is neglected below the first yield stress of a power curve and of
   !> one by points
   real(wp), parameter :: neglected_strain = 1.0e-6_wp
   !> Share of the shear strength below which a curve by points yields at once: a step may take a
   !> point from rest far beyond such a first yield stress
   real(wp), parameter :: early = 0.01_wp
   !> A stress that nothing reaches
   real(wp), parameter :: out_of_reach = 1.0e30_wp
   real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp

   !> Constants of the ply; matrix toughness is of cracks that are opened and that are sheared
   type, public, extends(damaged_ply_type) :: fracture_constants_type
      !> Angle of the plane of fracture in transverse compression, degrees from the plane 1-3
      real(wp) :: fracture_angle = 53.0_wp
      !> Exponent of Benzeggagh and Kenane
      real(wp) :: mode_exponent = 1.45_wp
      !> Coefficient of friction of closed cracks
      real(wp) :: friction = 0.0_wp
      !> Least integrity
      real(wp) :: residual = 1.0e-3_wp
      !> Pressure that crushes the ply through its thickness; 0: none does
      real(wp) :: crush_stress = 0.0_wp
      !> Share of the largest opening of a crack that debris holds, and most opening strain that it
      !> holds
      real(wp) :: debris_share = 0.0_wp, debris_limit = 0.0_wp
   contains
      procedure :: new_batch
      procedure :: set_lane
      procedure :: shows
      procedure :: leave_cracks
      procedure :: cross_strength
      procedure :: pressure_gain
      procedure :: first_yields
      procedure :: yields_at_once
      procedure :: softening_ratio
      procedure :: longest_lengths
      procedure :: snaps_back
   end type fracture_constants_type

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
      !> Energies per area of one line with the end of the law that ends first; lines on which
      !> fibres soften; share of XC that crushed fibres keep
      real(wp) :: fibre_toughness(lanes, 2) = 1.0_wp
      type(fibre_lines_type) :: lines
      real(wp) :: plateau(lanes) = 0.0_wp
      !> nu12 and nu13
      real(wp) :: poisson(lanes, 2) = 0.0_wp
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
      !> First yield stresses in 12, 13, 23, and curves
      real(wp) :: first_yield(lanes, 3) = 1.0_wp
      type(batch_shear_type) :: curves(3)
      !> 1 in lanes that yield at once, so that points that have kept no stress had no shear, else 0
      real(wp) :: at_once(lanes) = 0.0_wp
      !> Pressure that crushes through the thickness
      real(wp) :: crush_stress(lanes) = 1.0_wp
      !> Share of the largest opening that debris holds, and most opening strain
      real(wp) :: debris_share(lanes) = 0.0_wp, debris_limit(lanes) = 0.0_wp
      !> Squares of stresses over those of onset, see `intact_path`: fibres, and their energy;
      !> matrix across and along, and its energy; permanent shear 12, 13, 23; crushing
      real(wp) :: far_fibre(lanes, 2) = 0.0_wp, far_matrix(lanes, 3) = 0.0_wp
      real(wp) :: far_yield(lanes, 3) = 0.0_wp, far_crush(lanes) = 0.0_wp
   contains
      procedure :: set_lane => set_lane_of_batch
   end type fracture_batch_type

   ! the law of a batch uses these constants: a submodule can use the law
   interface
      !> Give a lane its ply
      pure module subroutine set_lane(self, lane, law)
         implicit none
         class(fracture_constants_type), intent(in) :: self
         integer, intent(in) :: lane
         class(law_type), intent(inout) :: law
      end subroutine set_lane

      !> A law without lanes
      module subroutine new_batch(self, law)
         implicit none
         class(fracture_constants_type), intent(in) :: self
         class(law_type), allocatable, intent(out) :: law
      end subroutine new_batch
   end interface

contains

   !> The law has all scalars for the fields
   pure function shows(self)
      class(fracture_constants_type), intent(in) :: self
      logical :: shows(scalars)

      shows(:) = .true.
   end function shows

   !> No plane of fracture opens; fibres break, and shear and pressure leave permanent strain
   pure subroutine leave_cracks(self)
      class(fracture_constants_type), intent(inout) :: self

      self%has_lines = .true.
      self%matrix_toughness(:) = out_of_reach*self%matrix_toughness
   end subroutine leave_cracks

   !> Shear strength across the fibres that gives YC and its angle of fracture (Davila and Camanho,
   !> 2003)
   pure real(wp) function cross_strength(self) result(strength)
      class(fracture_constants_type), intent(in) :: self

      associate (angle => self%fracture_angle*degree)
         strength = self%matrix_strength(2)*cos(angle)*(sin(angle) + cos(angle)/tan(2.0_wp*angle))
      end associate
   end function cross_strength

   !> Shear strength gained per pressure on the plane, over the strength: the same for shear along
   !> the fibres and across them (Puck and Schuermann, 1998; Davila and Camanho, 2003)
   pure real(wp) function pressure_gain(self) result(gain)
      class(fracture_constants_type), intent(in) :: self

      associate (angle => self%fracture_angle*degree)
         gain = -cos(2.0_wp*angle)/(self%matrix_strength(2)*cos(angle)**2)
      end associate
   end function pressure_gain

   !> First yield stresses in 12, 13, 23; out of reach without permanent shear. The curve of 23 is
   !> that of 12 with stresses in the ratio of the strengths
   pure function first_yields(self) result(yields)
      class(fracture_constants_type), intent(in) :: self
      real(wp) :: yields(3)

      yields(:) = min(first_yield(self%curve, self%shear(1), neglected_strain), out_of_reach) &
         & *[1.0_wp, 1.0_wp, self%cross_strength()/self%shear_strength]
   end function first_yields

   !> Whether permanent shear begins so early that a step from rest may go far beyond it
   pure logical function yields_at_once(self)
      class(fracture_constants_type), intent(in) :: self

      real(wp) :: yields(3)

      yields(:) = self%first_yields()
      yields_at_once = yields(1) < early*self%shear_strength
   end function yields_at_once

   !> Least ratio of tractions at the end and at the onset of softening, were the ply not free to
   !> contract: that leaves `snap_ratio` in uniaxial stress
   pure real(wp) function softening_ratio(self) result(ratio)
      class(fracture_constants_type), intent(in) :: self

      real(wp) :: c(6, 6)

      c(:, :) = ply_stiffness(self%young, self%poisson, self%shear)
      ratio = snap_ratio*max(c(2, 2)/self%young(2), c(3, 3)/self%young(3))
   end function softening_ratio

   !> Widest crack band of each mode in uniaxial stress at which softening starts at the strength
   pure function longest_lengths(self) result(longest)
      class(fracture_constants_type), intent(in) :: self
      real(wp) :: longest(modes)

      real(wp) :: sheared

      ! on its plane of fracture, transverse compression is shear over friction
      associate (angle => self%fracture_angle*degree, gii => self%matrix_toughness(2))
         sheared = self%matrix_strength(2)*cos(angle)*(sin(angle) - self%friction*cos(angle))
         longest(1:2) = longest_length(self%young(1), self%fibre_toughness, self%fibre_strength) &
            & *first_reach(self%line_strength, self%line_toughness)/snap_ratio
         longest(2) = longest(2)/(1.0_wp - self%plateau)**2
         longest(3) = longest_length(self%young(2), self%matrix_toughness(1), &
            & self%matrix_strength(1))/snap_ratio
         longest(4) = longest_length(self%shear(3), gii, max(sheared, tiny(sheared))) &
            & /self%softening_ratio()
         longest(5) = longest_length(self%shear(1), gii, self%shear_strength) &
            & /self%softening_ratio()
      end associate
   end function longest_lengths

   !> Modes in which a crack band is so wide that damage starts early
   pure function snaps_back(self, length) result(snaps)
      class(fracture_constants_type), intent(in) :: self
      real(wp), intent(in) :: length(2)
      logical :: snaps(modes)

      real(wp) :: longest(modes)

      longest(:) = self%longest_lengths()
      snaps(:) = [length(1) > longest(:2), length(2) > longest(3:)]
   end function snaps_back

   !> Give a lane its ply; it is the law's own from then on
   pure subroutine set_lane_of_batch(self, lane, ply)
      class(fracture_batch_type), intent(inout) :: self
      integer, intent(in) :: lane
      !> Its ply, checked
      class(fracture_constants_type), intent(in) :: ply

      real(wp) :: c(6, 6), cross, ratio(3)
      integer :: k

      cross = ply%cross_strength()
      c(:, :) = ply_stiffness(ply%young, ply%poisson, ply%shear)
      self%own(lane) = 1.0_wp
      self%whole = all(self%own > 0.0_wp)
      self%stiffness(lane, :) = [c(1, 1:3), c(2, 2:3), c(3, 3)]
      self%shear(lane, :) = ply%shear
      self%compliance(lane) = 1.0_wp/ply%young(1)
      self%give(lane) = 1.0_wp/c(3, 3)
      self%fibre_toughness(lane, :) = ply%fibre_toughness*first_reach(ply%line_strength, &
         & ply%line_toughness)
      call self%lines%set_lane(lane, ply%line_strength, ply%line_toughness)
      self%plateau(lane) = ply%plateau
      self%poisson(lane, :) = ply%poisson(:2)
      self%fibre_limit(lane, :) = 1.0_wp/ply%fibre_strength**2
      self%fibre_energy_limit(lane, :) = 0.5_wp*snap_ratio/(ply%young(1) &
         & *self%fibre_toughness(lane, :))
      associate (tension => ply%matrix_strength(1))
         self%normal_slope(lane) = (cross**2 - tension**2)/(2.0_wp*cross**2*tension)
      end associate
      self%across(lane) = 1.0_wp/cross
      self%along(lane) = 1.0_wp/ply%shear_strength
      self%gain(lane) = ply%pressure_gain()
      if (ply%has_lines) then
         self%normal_slope(lane) = 0.0_wp
         self%across(lane) = 0.0_wp
         self%along(lane) = 0.0_wp
      end if
      self%toughness(lane, :) = ply%matrix_toughness
      self%least_give(lane) = 1.0_wp/minval(ply%matrix_toughness)
      self%mode_exponent(lane) = ply%mode_exponent
      self%least_ratio(lane) = ply%softening_ratio()
      self%friction(lane) = ply%friction
      self%most_damage(lane) = 1.0_wp - ply%residual
      self%first_yield(lane, :) = ply%first_yields()
      ratio(:) = [1.0_wp, 1.0_wp, cross/ply%shear_strength]
      do k = 1, 3
         call self%curves(k)%set_lane(lane, ply%shear(k), scaled_curve(ply%curve, ply%shear(1), &
            & ply%shear(k), ratio(k)))
      end do
      self%crush_stress(lane) = merge(ply%crush_stress, out_of_reach, &
         & ply%crush_stress > 0.0_wp)
      self%debris_share(lane) = ply%debris_share
      self%debris_limit(lane) = ply%debris_limit
      call set_limits(self, lane, ply, c)
   end subroutine set_lane_of_batch

   !> Squares of stresses over those of onset
   pure subroutine set_limits(self, lane, ply, c)
      class(fracture_batch_type), intent(inout) :: self
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
      if (ply%yields_at_once()) then
         ! any shear is near onset
         self%far_yield(lane, :) = out_of_reach
         self%at_once(lane) = 1.0_wp
      end if
      self%far_crush(lane) = 1.0_wp/self%crush_stress(lane)
   end subroutine set_limits

end module plydyn_law_ply_fracture_constants
