!> Warnings of numbers that no material, interface or impactor has in the units of the deck.
module plydyn_input_check_units
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_report, only : deck_location_type
   use plydyn_input_catalogue, only : a_material, a_part, an_impactor, an_interface_material, &
      & catalogue_type
   use plydyn_input_units, only : si_factor
   use plydyn_law_ply_constants, only : damaged_ply_type
   use plydyn_model_material, only : material_type
   use plydyn_model_control, only : units_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: check_units, of_matrix

   !> A physical quantity, and the smallest and the largest number of it that there is
   type :: quantity_type
      !> Name, and SI unit
      character(18) :: name
      character(5) :: unit
      !> Exponents of length, time and mass
      integer :: exponents(3)
      !> The numbers, in that unit
      real(wp) :: range(2)
   end type quantity_type

   !> Fracture energies of matrix and interfaces, from weak to toughened adhesives, J/m2
   real(wp), parameter :: of_matrix(2) = [0.1_wp, 1.0e5_wp]
   type(quantity_type), parameter :: matrix_toughness = quantity_type("fracture energy", "J/m2", &
      & [0, -2, 1], of_matrix)
   !> Those of fibres, from brittle to tough ones with pull-out
   type(quantity_type), parameter :: fibre_toughness = quantity_type("fracture energy", "J/m2", &
      & [0, -2, 1], [10.0_wp, 2.0e6_wp])
   !> Moduli of solids from soft rubber to diamond; that of shear is a third of Young's modulus in
   !> rubber, and less across fibres
   type(quantity_type), parameter :: young_modulus = quantity_type("Young's modulus", "Pa", &
      & [-1, -2, 1], [1.0e5_wp, 2.0e12_wp])
   type(quantity_type), parameter :: shear_modulus = quantity_type("shear modulus", "Pa", &
      & [-1, -2, 1], [1.0e4_wp, 2.0e12_wp])
   !> Densities from aerogel to osmium
   type(quantity_type), parameter :: mass_density = quantity_type("density", "kg/m3", [-3, 0, 1], &
      & [1.0_wp, 2.3e4_wp])
   !> Plies from a tenth of a fibre to a wall
   type(quantity_type), parameter :: ply_thickness = quantity_type("ply of a thickness", "m", &
      & [1, 0, 0], [1.0e-6_wp, 1.0_wp])
   !> Velocities up to that beyond which nothing here is elastic
   type(quantity_type), parameter :: speed = quantity_type("velocity", "m/s", [1, -1, 0], &
      & [0.0_wp, 1.0e4_wp])
   !> Weight of the earth, m/s2, and share of it by which it is rounded
   real(wp), parameter :: earth = 9.81_wp, rounded = 0.005_wp

contains

   !> Look at moduli, densities, thicknesses, fracture energies and velocities
   subroutine check_units(model, catalogue)
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i

      associate (units => model%control%units)
         do i = 1, size(model%materials)
            call look_at_material(catalogue, catalogue%location(a_material, i), &
               & model%materials(i), units)
         end do
         ! bricks have one ply without thickness
         if (size(model%mesh%quad_id) > 0) then
            do i = 1, size(model%parts)
               call look(catalogue, catalogue%location(a_part, i), &
                  & model%parts(i)%plies%thickness, ply_thickness, units)
            end do
         end if
         call look_at_weights(model, catalogue)
         ! behind those of the deck stand copies that an interface has for itself, with its options
         do i = 1, catalogue%registers(an_interface_material)%count
            if (.not. model%interface_materials(i)%fails) cycle
            call look(catalogue, catalogue%location(an_interface_material, i), &
               & model%interface_materials(i)%constants%toughness, matrix_toughness, units)
         end do
         do i = 1, size(model%initial_velocities)
            call look(catalogue, deck_location_type(line=model%initial_velocities(i)%line), &
               & [norm2(model%initial_velocities(i)%velocity)], speed, units)
         end do
         do i = 1, size(model%impactors)
            call look(catalogue, catalogue%location(an_impactor, i), &
               & [norm2(model%impactors(i)%velocity)], speed, units)
         end do
      end associate
   end subroutine check_units

   !> Warn of the digits of the weight of the earth, 9.81, where units make another number of it
   subroutine look_at_weights(model, catalogue)
      type(model_type), intent(in) :: model
      type(catalogue_type), intent(inout) :: catalogue

      integer :: i

      do i = 1, size(model%body_loads)
         call look_at_weight(deck_location_type(line=model%body_loads(i)%line), &
            & model%body_loads(i)%scale*maxval(abs(model%curves(model%body_loads(i)%curve)%y)))
      end do
      do i = 1, size(model%impactors)
         call look_at_weight(catalogue%location(an_impactor, i), norm2(model%impactors(i)%gravity))
      end do

   contains

      !> An acceleration that has these digits in the deck alone
      subroutine look_at_weight(place, acceleration)
         type(deck_location_type), intent(in) :: place
         real(wp), intent(in) :: acceleration

         real(wp) :: metric

         metric = abs(acceleration)*si_factor(model%control%units, [1, -2, 0])
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

   !> Warn about the first modulus of a material out of its range, its density and, if it is a ply
   !> that is damaged, its fracture energies
   subroutine look_at_material(catalogue, place, material, units)
      type(catalogue_type), intent(inout) :: catalogue
      !> Where the deck has it
      type(deck_location_type), intent(in) :: place
      type(material_type), intent(in) :: material
      type(units_type), intent(in) :: units

      call look(catalogue, place, material%law%young, young_modulus, units)
      if (outlier(material%law%young, young_modulus, units) == 0) call look(catalogue, place, &
         & material%law%shear, shear_modulus, units)
      call look(catalogue, place, [material%density], mass_density, units)
      select type (law => material%law)
      class is (damaged_ply_type)
         call look(catalogue, place, law%fibre_toughness, fibre_toughness, units)
         call look(catalogue, place, law%matrix_toughness, matrix_toughness, units)
      end select
   end subroutine look_at_material

   !> Warn about the first of some numbers that is out of the range of its quantity
   subroutine look(catalogue, place, numbers, quantity, units)
      type(catalogue_type), intent(inout) :: catalogue
      !> Where the deck has them
      type(deck_location_type), intent(in) :: place
      !> The numbers, in the units of the deck
      real(wp), intent(in) :: numbers(:)
      type(quantity_type), intent(in) :: quantity
      type(units_type), intent(in) :: units

      integer :: i

      i = outlier(numbers, quantity, units)
      if (i == 0) return
      call catalogue%report%warn(place, "a "//trim(quantity%name)//" of " &
         & //text(numbers(i)*si_factor(units, quantity%exponents))//" "//trim(quantity%unit) &
         & //" in the units "//trim(units%length)//", "//trim(units%time)//", "//trim(units%mass), &
         & "numbers in these units, or *CONTROL_UNITS with others")
   end subroutine look

   !> Index of the first of some numbers that is out of the range of its quantity; 0 for none
   pure integer function outlier(numbers, quantity, units) result(i)
      !> The numbers, in the units of the deck
      real(wp), intent(in) :: numbers(:)
      type(quantity_type), intent(in) :: quantity
      type(units_type), intent(in) :: units

      associate (factor => si_factor(units, quantity%exponents))
         i = findloc(numbers*factor < quantity%range(1) .or. numbers*factor > quantity%range(2), &
            & .true., 1)
      end associate
   end function outlier

end module plydyn_input_check_units
