!> The bond of HTS40/9772, table 6 of the paper, in mm, N, MPa; and openings of all mixes.
module bond
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type, cohesive_type
   use plydyn_law_cohesive_softening, only : normal, shear
   implicit none
   private

   public :: mixed_directions, table_6

   !> Direction of sliding
   real(wp), parameter, public :: direction(2) = [0.6_wp, -0.8_wp]
   !> Shares of shear in the energy, one a lane
   real(wp), parameter, public :: mixes(lanes) = [0.0_wp, 0.1_wp, 0.2_wp, 0.25_wp, 0.5_wp, &
      & 0.75_wp, 0.8_wp, 1.0_wp]

contains

   !> Table 6
   pure function table_6() result(constants)
      type(cohesive_constants_type) :: constants

      constants%stiffness(:) = [1373.3e3_wp, 493.3e3_wp]
      constants%strength(:) = [62.3_wp, 92.3_wp]
      constants%toughness(:) = [0.28_wp, 0.79_wp]
      constants%exponent = 1.45_wp
   end function table_6

   !> Directions of openings in which shear has the shares `mixes`, of load 1
   pure function mixed_directions(law) result(opening)
      !> The law
      type(cohesive_type), intent(in) :: law
      real(wp) :: opening(lanes, 3)

      real(wp) :: load(lanes), part(lanes, 2)

      part(:, normal) = sqrt((1.0_wp - mixes)/law%stiffness(normal))
      part(:, shear) = sqrt(mixes/law%stiffness(shear))
      load(:) = sqrt(law%onset(normal)*(1.0_wp - mixes) + law%onset(shear)*mixes)
      opening(:, 1) = direction(1)*part(:, shear)/load
      opening(:, 2) = direction(2)*part(:, shear)/load
      opening(:, 3) = part(:, normal)/load
   end function mixed_directions

end module bond
