!> Derived units follow from length, time and mass.
program test_input_units
   use plydyn_input_units, only : derived_units
   use plydyn_model_control, only : units_type
   use testing, only : begin, check, finish
   implicit none

   call begin("derived_units")
   call check_units("MM", "S", "T", "N", "MPa", "mJ")
   call check_units("MM", "S", "TON", "N", "MPa", "mJ")
   call check_units("M", "S", "KG", "N", "Pa", "J")
   call check_units("MM", "MS", "KG", "kN", "GPa", "J")
   call check_units("MM", "MS", "G", "N", "MPa", "mJ")
   call check_units("CM", "US", "G", "1e7 N", "1e11 Pa", "1e5 J")

   call finish()

contains

   !> Units and what they make
   subroutine check_units(length, time, mass, force, stress, energy)
      !> Names on the card
      character(*), intent(in) :: length, time, mass
      !> Names that must follow
      character(*), intent(in) :: force, stress, energy

      type(units_type) :: units

      units = derived_units(length, time, mass)
      call check(units%force == force, length//" "//time//" "//mass//" give "//units%force)
      call check(units%stress == stress, length//" "//time//" "//mass//" give "//units%stress)
      call check(units%energy == energy, length//" "//time//" "//mass//" give "//units%energy)
   end subroutine check_units

end program test_input_units
