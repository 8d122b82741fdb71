!> Numbers out of all proportion make a warning.
program test_input_check_units
   use plydyn_base_precision, only : wp
   use plydyn_deck_report, only : severity_warning
   use plydyn_input_catalogue, only : a_material, an_impactor, catalogue_type, new_catalogue
   use plydyn_input_check_units, only : check_units
   use plydyn_input_units, only : derived_units
   use plydyn_law_ply_orthotropic, only : elastic_constants_type
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, finish
   implicit none

   call begin("check_units")
   call check(warnings("MM", "S", "T", 1.4e5_wp, 1.6e-9_wp, -5.0e3_wp), 0, "mm, s, t")
   call check(warnings("M", "S", "KG", 1.4e11_wp, 1600.0_wp, -5.0_wp), 0, "m, s, kg")
   call check(warnings("MM", "MS", "G", 1.4e5_wp, 1.6e-3_wp, -5.0_wp), 0, "mm, ms, g")
   call check(warnings("M", "S", "KG", 1.4e5_wp, 1600.0_wp, -5.0_wp), 0, &
      & "a soft material is one")
   call check(warnings("MM", "S", "T", 1.4e11_wp, 1.6e-9_wp, -5.0e3_wp), 1, &
      & "E in Pa among mm, s, t")
   call check(warnings("MM", "S", "T", 1.4e5_wp, 1600.0_wp, -5.0e3_wp), 1, "kg/m3 among mm, s, t")
   call check(warnings("M", "S", "KG", 1.4e11_wp, 1600.0_wp, -5.0e4_wp), 1, "mm/s among m, s, kg")
   call check(warnings("MM", "S", "T", 1.4e5_wp, 1.6e-9_wp, -5.0e3_wp, 5.0e9_wp), 1, &
      & "G12 in Pa among mm, s, t")

   call finish()

contains

   !> Number of warnings that a material and an impactor make
   integer function warnings(length, time, mass, young, density, velocity, shear)
      !> Names of units
      character(*), intent(in) :: length, time, mass
      !> Numbers in these units
      real(wp), intent(in) :: young, density, velocity
      !> Shear modulus in the plane 12, that of an isotropic material if absent
      real(wp), intent(in), optional :: shear

      type(elastic_constants_type) :: law
      type(catalogue_type) :: catalogue
      type(model_type) :: model

      catalogue = new_catalogue()
      allocate (model%materials(1), model%impactors(1))
      call catalogue%registers(a_material)%add(1, 1)
      call catalogue%registers(an_impactor)%add(1, 1)
      model%control%units = derived_units(length, time, mass)
      law%young(:) = young
      law%shear(:) = 0.4_wp*young
      if (present(shear)) law%shear(1) = shear
      allocate (model%materials(1)%law, source=law)
      model%materials(1)%density = density
      model%impactors(1)%velocity(3) = velocity
      call check_units(model, catalogue)
      warnings = catalogue%report%count(severity_warning)
   end function warnings

end program test_input_check_units
