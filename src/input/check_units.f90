!> Warnings of numbers that no material, interface or impactor has in the units of the deck.
module plydyn_input_check_units
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_report, only : deck_location_type
   use plydyn_input_catalogue, only : a_material, a_part, an_impactor, an_interface_material, &
      & catalogue_type
   use plydyn_input_units, only : si_factor
   use plydyn_law_ply_constants, only : ply_constants_type
   use plydyn_law_ply_fracture_constants, only : fracture_constants_type
   use plydyn_model_material, only : material_type
   use plydyn_model_control, only : units_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: check_units, of_matrix

   !> Moduli of solids from soft rubber to diamond, Pa
   real(wp), parameter :: least_modulus = 1.0e5_wp, most_modulus = 2.0e12_wp
   !> That of shear is a third of Young's modulus in rubber, and less across fibres
   real(wp), parameter :: least_shear = 0.1_wp*least_modulus
   !> Densities from aerogel to osmium, kg/m3
   real(wp), parameter :: least_density = 1.0_wp, most_density = 2.3e4_wp
   !> Plies from a tenth of a fibre to a wall, m
   real(wp), parameter :: of_plies(2) = [1.0e-6_wp, 1.0_wp]
   !> Weight of the earth, m/s2, and share of it by which it is rounded
   real(wp), parameter :: earth = 9.81_wp, rounded = 0.005_wp
   !> Velocity beyond which nothing here is elastic, m/s
   real(wp), parameter :: most_velocity = 1.0e4_wp
   !> Fracture energies of fibres, from brittle to tough ones with pull-out, J/m2
   real(wp), parameter :: of_fibres(2) = [10.0_wp, 2.0e6_wp]
   !> Fracture energies of matrix and interfaces, from weak to toughened adhesives, J/m2
   real(wp), parameter :: of_matrix(2) = [0.1_wp, 1.0e5_wp]

contains

   !> Look at moduli, densities, fracture energies and velocities
   subroutine check_units(model, catalogue)
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      real(wp) :: density, stress, velocity
      integer :: i

      associate (units => model%control%units)
         stress = si_factor(units, -1, -2, 1)
         density = si_factor(units, -3, 0, 1)
         velocity = si_factor(units, 1, -1, 0)
         do i = 1, size(model%materials)
            associate (material => model%materials(i))
               call look_at_moduli(catalogue, catalogue%registers(a_material)%line(i), &
                  & material%law%young*stress, material%law%shear*stress, units)
               call look(catalogue, catalogue%registers(a_material)%line(i), material%density &
                  & *density, [least_density, most_density], "a density of", "kg/m3", units)
               call look_at_plies(catalogue, catalogue%registers(a_material)%line(i), material, &
                  & units)
            end associate
         end do
         call look_at_thicknesses(model, catalogue)
         call look_at_weights(model, catalogue)
         ! behind those of the deck stand copies that an interface has for itself, with its options
         do i = 1, catalogue%registers(an_interface_material)%count
            if (.not. model%interface_materials(i)%fails) cycle
            call look_at_energies(catalogue, catalogue%registers(an_interface_material)%line(i), &
               & model%interface_materials(i)%constants%toughness, of_matrix, units)
         end do
         do i = 1, size(model%initial_velocities)
            call look(catalogue, model%initial_velocities(i)%line, &
               & norm2(model%initial_velocities(i)%velocity)*velocity, [0.0_wp, most_velocity], &
               & "a velocity of", "m/s", units)
         end do
         do i = 1, size(model%impactors)
            call look(catalogue, catalogue%registers(an_impactor)%line(i), &
               & norm2(model%impactors(i)%velocity)*velocity, [0.0_wp, most_velocity], &
               & "a velocity of", "m/s", units)
         end do
      end associate
   end subroutine check_units

   !> Warn about the first ply of each laminate that is thinner or thicker than any
   subroutine look_at_thicknesses(model, catalogue)
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i, k

      ! bricks have one ply without thickness
      if (size(model%mesh%quad_id) == 0) return
      do i = 1, size(model%parts)
         associate (thickness => model%parts(i)%plies%thickness &
            & *si_factor(model%control%units, 1, 0, 0))
            k = findloc(thickness < of_plies(1) .or. thickness > of_plies(2), .true., 1)
            if (k > 0) call look(catalogue, catalogue%registers(a_part)%line(i), thickness(k), &
               & of_plies, "a ply of a thickness of", "m", model%control%units)
         end associate
      end do
   end subroutine look_at_thicknesses

   !> Warn of the digits of the weight of the earth, 9.81, where units make another number of it
   subroutine look_at_weights(model, catalogue)
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      type(deck_location_type) :: place
      integer :: i

      do i = 1, size(model%body_loads)
         place%line = model%body_loads(i)%line
         call look_at_weight(model%body_loads(i)%scale &
            & *maxval(abs(model%curves(model%body_loads(i)%curve)%y)))
      end do
      do i = 1, size(model%impactors)
         place = catalogue%location(an_impactor, i)
         call look_at_weight(norm2(model%impactors(i)%gravity))
      end do

   contains

      !> An acceleration that has these digits in the deck alone
      subroutine look_at_weight(acceleration)
         real(wp), intent(in) :: acceleration

         real(wp) :: metric

         metric = abs(acceleration)*si_factor(model%control%units, 1, -2, 0)
         if (.not. has_digits(abs(acceleration)) .or. is_near(metric, earth)) return
         call catalogue%report%warn(place, "an acceleration of "//text(metric)//" m/s2 in the " &
            & //"units of the deck", text(earth*abs(acceleration)/metric)//" for the weight of " &
            & //"the earth, or *CONTROL_UNITS with others")
      end subroutine look_at_weight

      !> Whether a number is the weight of the earth but for thousands
      logical function has_digits(number)
         real(wp), intent(in) :: number

         integer :: k

         has_digits = any([(is_near(number, earth*1.0e3_wp**k), k=-3, 3)])
      end function has_digits

      !> Whether two numbers differ by less than what one rounds
      logical function is_near(one, other)
         real(wp), intent(in) :: one, other

         is_near = abs(one - other) < rounded*other
      end function is_near

   end subroutine look_at_weights

   !> Warn about the first modulus out of its range
   subroutine look_at_moduli(catalogue, line, young, shear, units)
      type(catalogue_type), intent(inout) :: catalogue
      !> Line of the definition
      integer, intent(in) :: line
      !> Moduli in Pa
      real(wp), intent(in) :: young(3), shear(3)
      !> Units of the deck
      type(units_type), intent(in) :: units

      integer :: i

      i = findloc(young < least_modulus .or. young > most_modulus, .true., 1)
      if (i > 0) then
         call look(catalogue, line, young(i), [least_modulus, most_modulus], &
            & "a Young's modulus of", "Pa", units)
         return
      end if
      i = findloc(shear < least_shear .or. shear > most_modulus, .true., 1)
      if (i > 0) call look(catalogue, line, shear(i), [least_shear, most_modulus], &
         & "a shear modulus of", "Pa", units)
   end subroutine look_at_moduli

   !> Warn about fracture energies of a ply that is damaged
   subroutine look_at_plies(catalogue, line, material, units)
      type(catalogue_type), intent(inout) :: catalogue
      !> Line of the definition
      integer, intent(in) :: line
      type(material_type), intent(in) :: material
      !> Units of the deck
      type(units_type), intent(in) :: units

      select type (law => material%law)
      class is (ply_constants_type)
         call look_at_energies(catalogue, line, law%fibre_toughness, of_fibres, units)
         call look_at_energies(catalogue, line, law%matrix_toughness, of_matrix, units)
      class is (fracture_constants_type)
         call look_at_energies(catalogue, line, law%fibre_toughness, of_fibres, units)
         call look_at_energies(catalogue, line, law%matrix_toughness, of_matrix, units)
      end select
   end subroutine look_at_plies

   !> Warn about the first of two fracture energies out of its range
   subroutine look_at_energies(catalogue, line, toughness, range, units)
      type(catalogue_type), intent(inout) :: catalogue
      !> Line of the definition
      integer, intent(in) :: line
      !> Energies per area, in the units of the deck
      real(wp), intent(in) :: toughness(2)
      !> Smallest and largest one, J/m2
      real(wp), intent(in) :: range(2)
      !> Units of the deck
      type(units_type), intent(in) :: units

      real(wp) :: energy(2)
      integer :: i

      energy(:) = toughness*si_factor(units, 0, -2, 1)
      i = findloc(energy < range(1) .or. energy > range(2), .true., 1)
      if (i > 0) call look(catalogue, line, energy(i), range, "a fracture energy of", "J/m2", units)
   end subroutine look_at_energies

   !> Warn about a number out of its range
   subroutine look(catalogue, line, number, range, what, unit, units)
      !> Gets the warning
      type(catalogue_type), intent(inout) :: catalogue
      !> Line of the definition
      integer, intent(in) :: line
      !> The number in SI units
      real(wp), intent(in) :: number
      !> Smallest and largest number
      real(wp), intent(in) :: range(2)
      !> What it is, and its SI unit
      character(*), intent(in) :: what, unit
      !> Units of the deck
      type(units_type), intent(in) :: units

      type(deck_location_type) :: place

      if (number >= range(1) .and. number <= range(2)) return
      place%line = line
      call catalogue%report%warn(place, what//" "//text(number)//" "//unit &
         & //" in the units "//trim(units%length)//", "//trim(units%time)//", "//trim(units%mass), &
         & "numbers in these units, or *CONTROL_UNITS with others")
   end subroutine look

end module plydyn_input_check_units
