!> Names of derived units, from those of length, time and mass.
module plydyn_input_units
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text, upper_case
   use plydyn_model_control, only : units_type
   implicit none
   private

   public :: derived_units, si_factor

   !> Names of lengths, times and masses that a deck may use
   character(*), parameter :: names(*) = [character(8) :: "M", "MM", "CM", "UM", "S", "SEC", "MS", &
      & "US", "KG", "G", "MG", "T", "TON", "MTRC_TON", "IN", "FT", "SLUG", "SLINCH"]
   !> Those of the metric system stand first
   integer, parameter :: metric = 14
   !> Power of ten of each against m, s, kg; 0 for those that have none
   integer, parameter :: powers(*) = [0, -3, -2, -6, 0, 0, -3, -6, 0, -3, -6, 3, 3, 3, 0, 0, 0, 0]
   !> An inch and twelve of them in m; a pound in kg; a slug is moved by a pound of force by 1 ft/s2
   real(wp), parameter :: inch = 0.0254_wp, feet = 12*inch, pound = 0.45359237_wp, &
      & slug = pound*9.80665_wp/feet
   !> Each in m, s, kg
   real(wp), parameter :: factors(*) = [10.0_wp**powers(:metric), inch, feet, slug, 12*slug]
   !> Names as they are printed
   character(*), parameter :: printed(*) = [character(8) :: "m", "mm", "cm", "um", "s", "s", "ms", &
      & "us", "kg", "g", "mg", "t", "t", "t", "in", "ft", "slug", "slinch"]
   !> Prefixes in steps of a thousand, from 1e-9 to 1e12
   character(*), parameter :: prefixes(-3:4) = ["n", "u", "m", " ", "k", "M", "G", "T"]

contains

   !> All names of units
   pure function derived_units(length, time, mass) result(units)
      !> Names in capitals
      character(*), intent(in) :: length, time, mass
      type(units_type) :: units

      integer :: l, m, t

      l = findname(length)
      t = findname(time)
      m = findname(mass)
      if (min(l, t, m) == 0) return
      units%length = printed(l)
      units%time = printed(t)
      units%mass = printed(m)
      if (max(l, m) > metric) then
         call name_customary(units)
         return
      end if
      associate (force => powers(m) + powers(l) - 2*powers(t))
         units%force = with_prefix(force, "N")
         units%stress = with_prefix(force - 2*powers(l), "Pa")
         units%energy = with_prefix(force + powers(l), "J")
      end associate
   end function derived_units

   !> Names of force, stress and energy in inches and slinches, or feet and slugs; others
   !> have none
   pure subroutine name_customary(units)
      !> With length, time and mass
      type(units_type), intent(inout) :: units

      character(8) :: names(3)

      select case (trim(units%length)//" "//trim(units%time)//" "//trim(units%mass))
      case ("in s slinch")
         names(:) = [character(8) :: "lbf", "psi", "in-lbf"]
      case ("ft s slug")
         names(:) = [character(8) :: "lbf", "psf", "ft-lbf"]
      case default
         names(:) = "-"
      end select
      units%force = names(1)
      units%stress = names(2)
      units%energy = names(3)
   end subroutine name_customary

   !> What a quantity in these units is multiplied by to be in m, s, kg
   pure real(wp) function si_factor(units, exponents) result(factor)
      !> Names as they are printed
      type(units_type), intent(in) :: units
      !> Exponents of length, time and mass in the quantity
      integer, intent(in) :: exponents(3)

      factor = factors(findname(upper_case(trim(units%length))))**exponents(1) &
         & *factors(findname(upper_case(trim(units%time))))**exponents(2) &
         & *factors(findname(upper_case(trim(units%mass))))**exponents(3)
   end function si_factor

   !> Place of a name in the list; 0 if it is not there
   pure integer function findname(name) result(i)
      !> Name in capitals
      character(*), intent(in) :: name

      do i = size(names), 1, -1
         if (names(i) == name) return
      end do
   end function findname

   !> A unit times a power of ten
   pure function with_prefix(power, unit) result(name)
      integer, intent(in) :: power
      character(*), intent(in) :: unit
      character(8) :: name

      if (modulo(power, 3) == 0 .and. power/3 >= -3 .and. power/3 <= 4) then
         name = trim(prefixes(power/3))//unit
      else
         name = "1e"//text(power)//" "//unit
      end if
   end function with_prefix

end module plydyn_input_units
