!> Numbers out of all proportion make a warning.
program test_input_check_units
   use plydyn_base_precision, only : wp
   use plydyn_deck_report, only : severity_warning
   use plydyn_input_catalogue, only : a_material, an_impactor, &
      & an_interface_material, catalogue_type, new_catalogue
   use plydyn_input_check_units, only : check_units
   use plydyn_input_units, only : derived_units
   use plydyn_law_law, only : law_constants_type
   use plydyn_law_ply_constants, only : ply_constants_type
   use plydyn_law_ply_fracture_constants, only : fracture_constants_type
   use plydyn_law_ply_elastic, only : elastic_constants_type
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
   call fracture_energies()

   call finish()

contains

   !> J/m2 in a deck in mm, s, t, where N/mm is right; kJ/m2 is the same as N/mm
   subroutine fracture_energies()
      type(ply_constants_type) :: law
      type(fracture_constants_type) :: fracture

      law%fibre_toughness(:) = [91.6_wp, 79.9_wp]
      law%matrix_toughness(:) = [0.277_wp, 1.1_wp]
      call check(warnings_of(law, [0.28_wp, 0.79_wp]), 0, "fracture energies in N/mm")
      call check(warnings_of(law, [280.0_wp, 790.0_wp]), 1, "GIC in J/m2 of an interface")
      law%matrix_toughness(:) = [277.0_wp, 1100.0_wp]
      call check(warnings_of(law, [0.28_wp, 0.79_wp]), 1, "those of a matrix")
      law%matrix_toughness(:) = [0.277_wp, 1.1_wp]
      law%fibre_toughness(:) = 1000.0_wp*law%fibre_toughness
      call check(warnings_of(law, [0.28_wp, 0.79_wp]), 1, "those of fibres")
      fracture%fibre_toughness(:) = [91.6_wp, 79.9_wp]
      fracture%matrix_toughness(:) = [0.277_wp, 788.0_wp]
      call check(warnings_of(fracture, [0.28_wp, 0.79_wp]), 1, "those of planes of fracture")
   end subroutine fracture_energies

   !> Number of warnings that a damaged ply and an interface make in mm, s, t
   integer function warnings_of(law, toughness)
      !> The ply
      class(law_constants_type), intent(in) :: law
      !> Fracture energies of the interface
      real(wp), intent(in) :: toughness(2)

      type(catalogue_type) :: catalogue
      type(model_type) :: model
      integer :: i

      catalogue = new_catalogue()
      ! the second one is a copy with options of an interface, which the deck does not define
      allocate (model%materials(1), model%interface_materials(2), model%impactors(0))
      allocate (model%mesh%quad_id(0), model%body_loads(0), model%initial_velocities(0))
      call catalogue%registers(a_material)%add(1, 1)
      call catalogue%registers(an_interface_material)%add(1, 1)
      model%control%units = derived_units("MM", "S", "T")
      allocate (model%materials(1)%law, source=law)
      model%materials(1)%law%young(:) = 1.4e5_wp
      model%materials(1)%law%shear(:) = 5.0e3_wp
      model%materials(1)%density = 1.6e-9_wp
      model%interface_materials(:)%fails = .true.
      do i = 1, size(model%interface_materials)
         model%interface_materials(i)%constants%toughness(:) = toughness
      end do
      call check_units(model, catalogue)
      warnings_of = catalogue%report%count(severity_warning)
   end function warnings_of

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
      allocate (model%materials(1), model%interface_materials(0), model%impactors(1))
      allocate (model%mesh%quad_id(0), model%body_loads(0), model%initial_velocities(0))
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
