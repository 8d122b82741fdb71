!> Metals have the constants of their cards, the curves and the tables that they refer to.
program test_input_metal
   use decks, only : read_lines, with_material
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_law_metal_johnson_cook, only : johnson_cook_constants_type
   use plydyn_law_metal_kinematic, only : kinematic_constants_type
   use plydyn_law_metal_tabulated, only : stress_at, tabulated_constants_type
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_input_metal.k"
   !> A metal with table 8, and two curves of yield stress
   character(*), parameter :: with_table = "*MAT_024|5,7.8e-9,2.6e5,0.3|0.,0.,8,0,1.|"
   character(*), parameter :: two_curves = "*DEFINE_CURVE|3,|0.,300.|.1,310.|" &
      & //"*DEFINE_CURVE|2,|0.,320.|.2,330.|"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages
   type(kinematic_constants_type) :: kinematic
   type(johnson_cook_constants_type) :: johnson_cook
   type(tabulated_constants_type) :: tabulated

   call begin("read_mat_plastic_kinematic")
   call read_with("*MAT_PLASTIC_KINEMATIC_TITLE|steel|5,7.8e-9,2.6e5,0.3,300.,1.0e3,0.25|40.,5.|")
   call check(.not. allocated(error), "is read")
   call take_law()
   call check(kinematic%shear, spread(1.0e5_wp, 1, 3), 1.0e-9_wp, "G = E/2(1 + nu)")
   call check([kinematic%yield, kinematic%tangent], [300.0_wp, 1.0e3_wp], 0.0_wp, &
      & "yield stress and slope beyond")
   call check([kinematic%isotropic, kinematic%rate, kinematic%power], &
      & [0.25_wp, 40.0_wp, 5.0_wp], 0.0_wp, "share, rate, power")
   call read_with("*MAT_003|5,7.8e-9,2.6e5,0.3,300.|")
   call check(.not. allocated(error), "perfect plasticity is one card")
   call take_law()
   call check(kinematic%rate, 0.0_wp, 0.0_wp, "without effect of the rate")
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
   call take_law()
   call check([johnson_cook%yield, johnson_cook%factor, johnson_cook%exponent], &
      & [300.0_wp, 400.0_wp, 0.4_wp], 0.0_wp, "A, B, N")
   call check([johnson_cook%sensitivity, johnson_cook%reference_rate], [0.02_wp, 10.0_wp], &
      & 0.0_wp, "C, EPSO")
   call read_with("*MAT_098|5,7.8e-9,2.6e5,0.3|300.,400.,0.4,0.02|")
   call check_error(error, "VP is not 1, and C makes the rate matter", "a rate of total strain")
   call read_with("*MAT_098|5,7.8e-9,2.6e5,0.3|300.,400.,|")
   call check_error(error, "N is missing", "hardening without power")
   call read_with("*MAT_098|5,7.8e-9,2.6e5,0.3|300.,400.,0.4,0.,0.5|")
   call check_error(error, "PSFAIL", "failure")

   call begin("read_mat_piecewise_linear_plasticity")
   call read_with("*MAT_PIECEWISE_LINEAR_PLASTICITY|5,7.8e-9,2.6e5,0.3,300.,2.6e4|")
   call check(.not. allocated(error), "is read from SIGY and ETAN")
   call take_law()
   call check(stress_at(tabulated%curves(1), 0.09_wp), 300.0_wp + 0.09_wp*2.6e4_wp/0.9_wp, &
      & 1.0e-9_wp, "hardening by E ETAN/(E - ETAN)")
   call read_with("*MAT_024|5,7.8e-9,2.6e5,0.3,0.,0.,1.e21|0.,0.,0,0,0.|0.,.1,.3,0.,0.,0.,0.,0.|" &
      & //"300.,350.,370.,0.,0.,0.,0.,0.|")
   call check(.not. allocated(error), "is read from points")
   call take_law()
   associate (curve => tabulated%curves(1))
      call check(curve%strain, [0.0_wp, 0.1_wp, 0.3_wp], 0.0_wp, "EPS up to the last")
      call check(curve%stress, [300.0_wp, 350.0_wp, 370.0_wp], 0.0_wp, "ES of these")
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
   call take_law()
   call check(tabulated%curves(:)%rate, [4.0_wp, 10.0_wp], 0.0_wp, "values SFA (VALUE + OFFA)")
   call check([tabulated%curves(1)%stress, tabulated%curves(2)%stress], &
      & [300.0_wp, 310.0_wp, 320.0_wp, 330.0_wp], 0.0_wp, "the first is that of the first value")
   call check(.not. tabulated%logarithmic, "rates as they are")
   call read_with(with_table//two_curves//"*DEFINE_TABLE_2D|8,|-1.,2|2.,3|")
   call check(.not. allocated(error), "a table that names its curves")
   call take_law()
   call check(tabulated%logarithmic, "logarithms where the first is below 0")
   call check(tabulated%curves(:)%rate, exp([-1.0_wp, 2.0_wp]), 1.0e-15_wp, "of the rates")
   call check([tabulated%curves(1)%stress, tabulated%curves(2)%stress], &
      & [320.0_wp, 330.0_wp, 300.0_wp, 310.0_wp], 0.0_wp, "the curves named")
   call read_with(with_table//two_curves//"*DEFINE_TABLE|8,|1.,|4.,|")
   call check_error(error, "the table has 2 values, but 0 curves behind it", "curves before it")
   call read_with(with_table//"*DEFINE_TABLE|8,|"//two_curves)
   call check_error(error, "*DEFINE_TABLE: card 2 is missing", "no values")
   call check(index(error%message, "behind it") == 0, "of which none lacks a curve")
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

   !> Take the constants of the first material, which must be of one of the laws of metals
   subroutine take_law()
      kinematic = kinematic_constants_type()
      johnson_cook = johnson_cook_constants_type()
      tabulated = tabulated_constants_type()
      select type (law => model%materials(1)%law)
      type is (kinematic_constants_type)
         kinematic = law
      type is (johnson_cook_constants_type)
         johnson_cook = law
      type is (tabulated_constants_type)
         tabulated = law
      class default
         call check(.false., "is a metal")
      end select
   end subroutine take_law

end program test_input_metal
