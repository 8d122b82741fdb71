!> Derived units follow from length, time and mass.
program test_input_units
   use plydyn_base_precision, only : wp
   use plydyn_input_units, only : derived_units, si_factor
   use plydyn_model_control, only : units_type
   use testing, only : begin, check, finish
   implicit none

   call begin("derived_units")
   call check_units("MM", "S", "T", "N", "MPa", "mJ")
   call check_units("MM", "S", "TON", "N", "MPa", "mJ")
   call check_units("M", "S", "KG", "N", "Pa", "J")
   call check_units("MM", "MS", "KG", "kN", "GPa", "J")
   call check_units("MM", "MS", "G", "N", "MPa", "mJ")
   call check_units("IN", "S", "SLINCH", "lbf", "psi", "in-lbf")
   call check_units("FT", "S", "SLUG", "lbf", "psf", "ft-lbf")
   call check_units("IN", "S", "KG", "-", "-", "-")
   call check_units("CM", "US", "G", "1e7 N", "1e11 Pa", "1e5 J")

   call begin("si_factor")
   ! psi, lbf and in-lbf of the definitions of inch, pound and standard gravity
   associate (customary => derived_units("IN", "S", "SLINCH"))
      call check(near(si_factor(customary, [-1, -2, 1]), 6894.757293168_wp), "a psi in Pa")
      call check(near(si_factor(customary, [1, -2, 1]), 4.4482216152605_wp), "a lbf in N")
      call check(near(si_factor(customary, [2, -2, 1]), 0.112984829027617_wp), "an in-lbf in J")
   end associate
   call check(near(si_factor(derived_units("FT", "S", "SLUG"), [2, -2, 1]), 1.35581794833140_wp), &
      & "a ft-lbf in J")
   call check(near(si_factor(derived_units("MM", "MS", "KG"), [-1, -2, 1]), 1.0e9_wp), &
      & "a GPa in Pa")

   call finish()

contains

   !> Whether two numbers agree to round-off
   pure logical function near(a, b)
      !> The numbers
      real(wp), intent(in) :: a, b

      near = abs(a - b) <= 1.0e-12_wp*abs(b)
   end function near

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
