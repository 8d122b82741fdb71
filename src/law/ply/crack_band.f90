!> Width of the crack band of a smeared crack, and its upper bound.
module plydyn_law_ply_crack_band
   use plydyn_base_precision, only : wp
   implicit none
   private

   public :: band_length, brick_band_length, longest_length

   !> Rules for the width: share of the length of the quad along the direction; length of the Gauss
   !> point's own cell along it; root of the area of that cell; root of the area of the quad
   integer, parameter, public :: rule_band = 1, rule_gauss_point = 2, rule_root_point = 3, &
      & rule_root_quad = 4

   !> Share of the length of a quad of 9 nodes and 3 by 3 points that opens, two points of three,
   !> and of a quad of 4 nodes and 2 by 2 points, both
   real(wp), parameter, public :: share_biquadratic = 13.0_wp/18.0_wp, share_bilinear = 1.0_wp

   !> Width of the band over the radius of an average across it: what a bar that tears with such an
   !> average dissipates, within a tenth where damage ends at 1.3 to 8 times the strain of its onset
   real(wp), parameter, public :: share_average = 1.4_wp

   !> Uniaxial modes of failure, as they are counted and reported
   integer, parameter, public :: modes = 5
   character(*), parameter, public :: mode_names(modes) = [character(18) :: "fibre tension", &
      & "fibre compression", "matrix tension", "matrix compression", "shear"]

   !> Side of the parent square
   real(wp), parameter :: parent_side = 2.0_wp

contains

   !> Width of the band at a Gauss point of a quad
   pure real(wp) function band_length(rule, jacobian, direction, weight, share, area)
      !> One of the rules
      integer, intent(in) :: rule
      !> dx/dxi, dy/dxi in the first column, dx/deta, dy/deta in the second
      real(wp), intent(in) :: jacobian(2, 2)
      !> Unit vector across the crack: the fibres for broken fibres, the normal of them in the plane
      !> for matrix cracks
      real(wp), intent(in) :: direction(2)
      !> Gauss weights of the point along xi and along eta
      real(wp), intent(in) :: weight(2)
      !> Share of the length of the quad that opens, for the first rule
      real(wp), intent(in) :: share
      !> Area of the quad, for the last rule
      real(wp), intent(in) :: area

      real(wp) :: determinant

      determinant = jacobian(1, 1)*jacobian(2, 2) - jacobian(1, 2)*jacobian(2, 1)
      select case (rule)
      case (rule_gauss_point)
         band_length = chord(jacobian, determinant, direction, weight)
      case (rule_root_point)
         band_length = sqrt(weight(1)*weight(2)*abs(determinant))
      case (rule_root_quad)
         band_length = sqrt(area)
      case default
         band_length = share*chord(jacobian, determinant, direction, [parent_side, parent_side])
      end select
   end function band_length

   !> Width of the band at a point of a brick, all points of which open
   pure real(wp) function brick_band_length(rule, slope, direction, normal, side, volume)
      !> One of the rules
      integer, intent(in) :: rule
      !> d(xi, eta, zeta)/d(x, y, z), the first index that of xi, eta, zeta
      real(wp), intent(in) :: slope(3, 3)
      !> Unit vectors across the crack and normal to the ply
      real(wp), intent(in) :: direction(3), normal(3)
      !> Side of the point's own cube in the parent cube
      real(wp), intent(in) :: side
      !> Volumes of the point and of the brick: over their heights they are areas in the ply
      real(wp), intent(in) :: volume(2)

      real(wp) :: across, along

      across = 1.0_wp/maxval(abs(matmul(slope, normal)))
      along = 1.0_wp/maxval(abs(matmul(slope, direction)))
      select case (rule)
      case (rule_gauss_point)
         brick_band_length = side*along
      case (rule_root_point)
         brick_band_length = sqrt(volume(1)/(side*across))
      case (rule_root_quad)
         brick_band_length = sqrt(volume(2)/(parent_side*across))
      case default
         brick_band_length = parent_side*along
      end select
   end function brick_band_length

   !> Length, along a direction, of a rectangle of the parent square through its centre
   pure real(wp) function chord(jacobian, determinant, direction, sides)
      real(wp), intent(in) :: jacobian(2, 2), determinant, direction(2)
      !> Sides of the rectangle along xi and along eta
      real(wp), intent(in) :: sides(2)

      real(wp) :: parent(2)

      ! what a unit of length along the direction is in the parent square
      parent(1) = (jacobian(2, 2)*direction(1) - jacobian(1, 2)*direction(2))/determinant
      parent(2) = (jacobian(1, 1)*direction(2) - jacobian(2, 1)*direction(1))/determinant
      chord = 1.0_wp/maxval(abs(parent)/sides)
   end function chord

   !> Width from which on a stress-strain line in uniaxial stress snaps back
   elemental real(wp) function longest_length(modulus, toughness, strength)
      !> Modulus of the uniaxial test; energy per area of crack; strength
      real(wp), intent(in) :: modulus, toughness, strength

      longest_length = 2.0_wp*modulus*toughness/strength**2
   end function longest_length

end module plydyn_law_ply_crack_band
