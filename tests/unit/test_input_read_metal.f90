!> Metals have the constants of their cards, the curves and the tables that they refer to.
program test_input_read_metal
   use decks, only : read_lines, with_material
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_model_material, only : law_plastic_curve, law_plastic_johnson_cook, &
      & law_plastic_kinematic
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_input_read_metal.k"
   !> A metal with table 8, and two curves of yield stress
   character(*), parameter :: with_table = "*MAT_024|5,7.8e-9,2.6e5,0.3|0.,0.,8,0,1.|"
   character(*), parameter :: two_curves = "*DEFINE_CURVE|3,|0.,300.|.1,310.|" &
      & //"*DEFINE_CURVE|2,|0.,320.|.2,330.|"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages

   call begin("read_mat_plastic_kinematic")
   call read_with("*MAT_PLASTIC_KINEMATIC_TITLE|steel|5,7.8e-9,2.6e5,0.3,300.,1.0e3,0.25|40.,5.|")
   call check(.not. allocated(error), "is read")
   associate (material => model%materials(1))
      call check(material%law == law_plastic_kinematic, "law")
      call check(material%shear, spread(1.0e5_wp, 1, 3), 1.0e-9_wp, "G = E/2(1 + nu)")
      call check([material%plasticity%yield, material%plasticity%tangent], [300.0_wp, 1.0e3_wp], &
         & 0.0_wp, "yield stress and slope beyond")
      call check([material%plasticity%isotropic, material%plasticity%rate, &
         & material%plasticity%power], [0.25_wp, 40.0_wp, 5.0_wp], 0.0_wp, "share, rate, power")
   end associate
   call read_with("*MAT_003|5,7.8e-9,2.6e5,0.3,300.|")
   call check(.not. allocated(error), "perfect plasticity is one card")
   call check(model%materials(1)%plasticity%rate, 0.0_wp, 0.0_wp, "without effect of the rate")
   call read_with("*MAT_003|5,7.8e-9,2.6e5,0.3,300.,2.6e5|")
   call check_error(error, "ETAN cannot be 260000", "a slope of Young's modulus")
   call read_with("*MAT_003|5,7.8e-9,2.6e5,0.3,300.|40.,|")
   call check_error(error, "SRP is missing", "a rate without power")
   call read_with("*MAT_003|5,7.8e-9,2.6e5,0.3,0.|")
   call check_error(error, "SIGY cannot be 0", "no yield stress")

   call begin("read_mat_simplified_johnson_cook")
   call read_with("*MAT_SIMPLIFIED_JOHNSON_COOK|5,7.8e-9,2.6e5,0.3,1.|" &
      & //"300.,400.,0.4,0.02,1.e17,0.,0.,10.|")
   call check(.not. allocated(error), "is read")
   associate (plasticity => model%materials(1)%plasticity)
      call check(model%materials(1)%law == law_plastic_johnson_cook, "law")
      call check([plasticity%yield, plasticity%factor, plasticity%exponent], &
         & [300.0_wp, 400.0_wp, 0.4_wp], 0.0_wp, "A, B, N")
      call check([plasticity%sensitivity, plasticity%reference_rate], [0.02_wp, 10.0_wp], 0.0_wp, &
         & "C, EPSO")
   end associate
   call read_with("*MAT_098|5,7.8e-9,2.6e5,0.3|300.,400.,0.4,0.02|")
   call check_error(error, "VP is not 1, and C makes the rate matter", "a rate of total strain")
   call read_with("*MAT_098|5,7.8e-9,2.6e5,0.3|300.,400.,|")
   call check_error(error, "N is missing", "hardening without power")
   call read_with("*MAT_098|5,7.8e-9,2.6e5,0.3|300.,400.,0.4,0.,0.5|")
   call check_error(error, "PSFAIL", "failure")

   call begin("read_mat_piecewise_linear_plasticity")
   call read_with("*MAT_PIECEWISE_LINEAR_PLASTICITY|5,7.8e-9,2.6e5,0.3,300.,2.6e4|")
   call check(.not. allocated(error), "is read from SIGY and ETAN")
   associate (plasticity => model%materials(1)%plasticity)
      call check(model%materials(1)%law == law_plastic_curve, "law")
      call check(plasticity%curves(1)%at(0.09_wp), 300.0_wp + 0.09_wp*2.6e4_wp/0.9_wp, 1.0e-9_wp, &
         & "hardening by E ETAN/(E - ETAN)")
   end associate
   call read_with("*MAT_024|5,7.8e-9,2.6e5,0.3,0.,0.,1.e21|0.,0.,0,0,0.|0.,.1,.3,0.,0.,0.,0.,0.|" &
      & //"300.,350.,370.,0.,0.,0.,0.,0.|")
   call check(.not. allocated(error), "is read from points")
   associate (curve => model%materials(1)%plasticity%curves(1))
      call check(curve%x, [0.0_wp, 0.1_wp, 0.3_wp], 0.0_wp, "EPS up to the last")
      call check(curve%y, [300.0_wp, 350.0_wp, 370.0_wp], 0.0_wp, "ES of these")
   end associate
   call read_with("*MAT_024|5,7.8e-9,2.6e5,0.3|0.,0.|.1,.3|300.,350.|")
   call check_error(error, "the yield stress starts at the plastic strain 0.1", "no first point")
   call read_with("*MAT_024|5,7.8e-9,2.6e5,0.3|0.,0.|0.,.3,.2|300.,350.,370.|")
   call check_error(error, "the plastic strain does not increase", "points in disorder")
   call read_with("*MAT_024|5,7.8e-9,2.6e5,0.3|0.,0.|0.,.3|300.,0.|")
   call check_error(error, "the yield stress is 0 somewhere", "a point without stress")
   call read_with("*MAT_024|5,7.8e-9,2.6e5,0.3|")
   call check_error(error, "SIGY is missing", "no yield stress at all")
   call read_with("*MAT_024|5,7.8e-9,2.6e5,0.3,300.|40.,5.|")
   call check_error(error, "VP is not 1, and C makes the rate matter", "a rate of total strain")
   call read_with("*MAT_024|5,7.8e-9,2.6e5,0.3,300.,0.,0.5|")
   call check_error(error, "FAIL", "failure")

   call begin("read_define_table")
   call read_with(with_table//"*DEFINE_TABLE|8,2.,1.|1.,|4.,|"//two_curves)
   call check(.not. allocated(error), "curves behind the table are its own")
   associate (plasticity => model%materials(1)%plasticity)
      call check(plasticity%rates, [4.0_wp, 10.0_wp], 0.0_wp, "values SFA (VALUE + OFFA)")
      call check(all(plasticity%curves(:)%id == [3, 2]), "the first is that of the first value")
      call check(.not. plasticity%logarithmic, "rates as they are")
   end associate
   call read_with(with_table//two_curves//"*DEFINE_TABLE_2D|8,|-1.,2|2.,3|")
   call check(.not. allocated(error), "a table that names its curves")
   associate (plasticity => model%materials(1)%plasticity)
      call check(plasticity%logarithmic, "logarithms where the first is below 0")
      call check(plasticity%rates, exp([-1.0_wp, 2.0_wp]), 1.0e-15_wp, "of the rates")
      call check(all(plasticity%curves(:)%id == [2, 3]), "the curves named")
   end associate
   call read_with(with_table//two_curves//"*DEFINE_TABLE|8,|1.,|4.,|")
   call check_error(error, "the table has 2 values, but 0 curves follow it", "curves before it")
   call read_with(with_table//"*DEFINE_TABLE|8,|4.,|1.,|"//two_curves)
   call check_error(error, "the value does not increase", "values in disorder")
   call read_with(with_table//two_curves//"*DEFINE_TABLE_2D|2,|1.,2|2.,3|")
   call check_error(error, "curve or table 2 is defined twice", "a number that a curve has")
   call read_with("*MAT_001|5,7.8e-9,2.6e5,0.3|"//two_curves//"*DEFINE_TABLE_2D|8,|1.,2|2.,3|")
   call check_error(error, "table 8 is never used", "a table that no material uses")
   call read_with("*MAT_024|5,7.8e-9,2.6e5,0.3|0.,0.,8|")
   call check_error(error, "curve 8 is not defined", "a curve that is missing")
   call finish()

contains

   !> Read the plate with another material
   subroutine read_with(material)
      !> Lines of the material
      character(*), intent(in) :: material

      call read_lines(path, with_material(material), model, messages, error)
   end subroutine read_with

end program test_input_read_metal
