!> Curves of the shear of a ply up to the first matrix crack: stress over total strain in monotone
!> loading.
module plydyn_law_ply_shear_curve
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   implicit none
   private

   public :: new_exponential_curve, new_hardening_curve, new_power_curve, new_table_curve, &
      & check_curve, first_yield, scaled_curve, table_slopes

   !> Shapes of a curve
   integer, parameter, public :: shape_line = 0, shape_exponential = 1, shape_table = 2, &
      & shape_power = 3

   !> Curve of one material; by default a line
   type, public :: shear_curve_type
      !> One of the shapes
      integer :: shape = shape_line
      !> Stress that an exponential curve tends to
      real(wp) :: asymptote = 0.0_wp
      !> Coefficient, stress to the power of 1 - exponent, and exponent of Ramberg and Osgood:
      !> strain = (stress + coefficient*stress**exponent)/modulus
      real(wp) :: coefficient = 0.0_wp, exponent = 1.0_wp
      !> Points of a table; the first is the origin, behind the last the last line goes on
      real(wp), allocatable :: strain(:), stress(:)
   end type shear_curve_type

   !> Share by which a slope may exceed the modulus: the digits of a table
   real(wp), parameter :: slope_tolerance = 0.01_wp
   !> Round-off of what a line of a table gives beyond the elastic strain, as a share of that
   real(wp), parameter :: elastic_give = 1.0e-12_wp
   !> Halvings that find the asymptote to the last digit
   integer, parameter :: halvings = 60

contains

   !> Exponential curve that reaches the strength at a given strain:
   !> stress = asymptote*(1 - exp(-modulus*strain/asymptote))
   pure function new_exponential_curve(modulus, strength, ultimate) result(curve)
      !> Shear modulus at the origin; shear strength
      real(wp), intent(in) :: modulus, strength
      !> Strain at which the strength is reached, larger than strength/modulus
      real(wp), intent(in) :: ultimate
      type(shear_curve_type) :: curve

      real(wp) :: low, middle, high
      integer :: i

      ! strength over asymptote, between that of a line and that of a curve without end
      low = 0.0_wp
      high = 1.0_wp
      do i = 1, halvings
         middle = 0.5_wp*(low + high)
         if (1.0_wp - exp(-middle*modulus*ultimate/strength) > middle) then
            low = middle
         else
            high = middle
         end if
      end do
      curve%shape = shape_exponential
      curve%asymptote = strength/high
   end function new_exponential_curve

   !> Curve of straight lines through measured points
   pure function new_table_curve(strain, stress) result(curve)
      !> Strains, growing from zero; stresses at them
      real(wp), intent(in) :: strain(:), stress(:)
      type(shear_curve_type) :: curve

      curve = shear_curve_type(shape_table, strain=strain, stress=stress)
   end function new_table_curve

   !> Curve of Ramberg and Osgood
   pure function new_power_curve(coefficient, exponent) result(curve)
      !> Coefficient, stress to the power of 1 - exponent; exponent, larger than 1
      real(wp), intent(in) :: coefficient, exponent
      type(shear_curve_type) :: curve

      curve = shear_curve_type(shape_power, coefficient=coefficient, exponent=exponent)
   end function new_power_curve

   !> Curve that hardens linearly from a first yield stress on
   pure function new_hardening_curve(modulus, yield, hardening) result(curve)
      !> Shear modulus at the origin; first yield stress
      real(wp), intent(in) :: modulus, yield
      !> Slope of the yield stress over the permanent strain, as a share of the modulus
      real(wp), intent(in) :: hardening
      type(shear_curve_type) :: curve

      curve = new_table_curve(yield/modulus*[0.0_wp, 1.0_wp, 2.0_wp], &
         & yield*[0.0_wp, 1.0_wp, 1.0_wp + hardening/(1.0_wp + hardening)])
   end function new_hardening_curve

   !> Curve of another shear with the same permanent strains, at stresses in a ratio
   pure function scaled_curve(curve, modulus, other, ratio) result(scaled)
      !> A table, a power curve or a line
      type(shear_curve_type), intent(in) :: curve
      !> Its modulus, and that of the other shear; stress of the other over that of the first
      real(wp), intent(in) :: modulus, other, ratio
      type(shear_curve_type) :: scaled

      integer :: i

      scaled = curve
      scaled%coefficient = curve%coefficient*other/modulus*ratio**(-curve%exponent)
      if (curve%shape /= shape_table) return
      associate (slopes => table_slopes(curve%strain, curve%stress, modulus))
         do i = 1, size(slopes)
            scaled%stress(i + 1) = scaled%stress(i) &
               & + ratio*slopes(i)*(curve%strain(i + 1) - curve%strain(i))
            scaled%strain(i + 1) = scaled%strain(i) + (curve%strain(i + 1) - curve%strain(i)) &
               & *(1.0_wp - slopes(i)*(1.0_wp/modulus - ratio/other))
         end do
      end associate
   end function scaled_curve

   !> Stress from which a curve leaves permanent strain: the end of what is elastic of a table, else
   !> where it has left some that may be neglected; huge where it never does
   pure real(wp) function first_yield(curve, modulus, neglected) result(stress)
      !> A table, a power curve or a line
      type(shear_curve_type), intent(in) :: curve
      !> Its modulus; permanent strain that is neglected
      real(wp), intent(in) :: modulus, neglected

      real(wp) :: give, rise
      integer :: i

      stress = huge(stress)
      if (curve%shape == shape_line) return
      if (curve%shape == shape_power) then
         stress = (neglected*modulus/curve%coefficient)**(1.0_wp/curve%exponent)
         return
      end if
      stress = 0.0_wp
      associate (slopes => table_slopes(curve%strain, curve%stress, modulus))
         do i = 1, size(slopes)
            give = 1.0_wp/slopes(i) - 1.0_wp/modulus
            rise = slopes(i)*(curve%strain(i + 1) - curve%strain(i))
            if (give > elastic_give/modulus) exit
            stress = stress + rise
         end do
         if (i > size(slopes)) stress = huge(stress)
         if (i == 1) stress = min(neglected/give, rise)
      end associate
   end function first_yield

   !> Slopes of a table from point to point: at most the modulus, with which it unloads. What little
   !> more a slope may have is left out, and the next ones make up for it
   pure function table_slopes(strain, stress, modulus) result(slopes)
      !> Points, from the origin on; shear modulus
      real(wp), intent(in) :: strain(:), stress(:), modulus
      real(wp) :: slopes(size(strain) - 1)

      real(wp) :: reached
      integer :: i

      reached = 0.0_wp
      do i = 1, size(slopes)
         associate (length => strain(i + 1) - strain(i))
            slopes(i) = min((stress(i + 1) - reached)/length, modulus)
            reached = reached + slopes(i)*length
         end associate
      end do
   end function table_slopes

   !> Refuse a curve that cannot be: it must leave the origin with the modulus, never be steeper,
   !> and reach the strength
   subroutine check_curve(curve, modulus, strength, error)
      type(shear_curve_type), intent(in) :: curve
      !> Shear modulus; shear strength
      real(wp), intent(in) :: modulus, strength
      !> Says what is wrong with it
      type(error_type), allocatable, intent(out) :: error

      select case (curve%shape)
      case (shape_line)
         return
      case (shape_exponential)
         if (curve%asymptote > strength) return
         call fail(error, exit_input, "the shear curve tends to "//text(curve%asymptote) &
            & //" and never reaches the strength "//text(strength)//": it must reach it at a" &
            & //" strain larger than strength over modulus")
      case (shape_table)
         call check_table(curve%strain, curve%stress, modulus, error)
      case default
         if (curve%coefficient > 0.0_wp .and. curve%exponent > 1.0_wp) return
         call fail(error, exit_input, "a shear curve of Ramberg and Osgood needs a coefficient" &
            & //" above 0 and an exponent above 1")
      end select
   end subroutine check_curve

   !> Refuse a table that does not start at the origin, or is not rising, or too steep
   subroutine check_table(strain, stress, modulus, error)
      real(wp), intent(in) :: strain(:), stress(:), modulus
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: slope
      integer :: i

      if (size(strain) < 2 .or. size(strain) /= size(stress)) then
         call fail(error, exit_input, "a shear curve needs two points or more")
         return
      end if
      if (abs(strain(1)) > 0.0_wp .or. abs(stress(1)) > 0.0_wp) then
         call fail(error, exit_input, "a shear curve must start at strain 0 and stress 0")
         return
      end if
      do i = 2, size(strain)
         if (strain(i) <= strain(i - 1) .or. stress(i) <= stress(i - 1)) then
            call fail(error, exit_input, "point "//text(i)//" of the shear curve must lie above" &
               & //" and to the right of the one before")
            return
         end if
         slope = (stress(i) - stress(i - 1))/(strain(i) - strain(i - 1))
         if (slope > (1.0_wp + slope_tolerance)*modulus) then
            call fail(error, exit_input, "the shear curve rises by "//text(slope) &
               & //" before point "//text(i)//", more than the modulus "//text(modulus))
            return
         end if
      end do
   end subroutine check_table

end module plydyn_law_ply_shear_curve
